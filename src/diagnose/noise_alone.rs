//! What noise of the drive alone would make of a cause, or leave: records drawn as these are, but for it.

use super::drawn_drives::{DRAWN, Draw, Drives};
use super::prepare::Bench;
use super::search::Found;
use super::structure::structure;
use super::trials::{alarm, dispersion};
use crate::identify::{Fit, Problem, refit};
use rayon::prelude::*;

/// Times as much as of noise that a cause has to take. Judged: of clean records causes took 1.0 to 1.5 times the most of
/// several draws, of records with a cause ten times and more.
const TIMES: f64 = 2.0;

/// Times what noise adds as its fastest part tells, `(1 + a)/(1 − a)` of neighbours that go together by 0.9: no cause takes
/// more of it.
const LOUDER: f64 = 20.0;

/// Times that noise which nothing but the best model tells is told by what that leaves.
const ROUNDS: usize = 2;

/// What noise of the drives leaves, at most, of records that have nothing else.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct OfNoise {
    /// Share of the noise's variance that means over bins share, as [`Structure::share`](super::structure::Structure).
    pub(super) share: f64,
    /// Mean whitened square beyond that of the noise.
    pub(super) beyond: f64,
}

impl OfNoise {
    /// True where a share is no more than noise leaves, or may.
    pub(super) fn leaves_as_structured(&self, share: f64) -> bool {
        share < TIMES * self.share
    }

    /// The same of a mean whitened square.
    pub(super) fn leaves_as_much(&self, square: f64) -> bool {
        square - 1.0 < TIMES * self.beyond
    }
}

/// What was found without the causes that take no more of the records than of such as noise of the drive makes without
/// them: whatever smooths a noisy drive, or follows how fast it changes, explains some of its noise.
///
/// A parametric bootstrap of the null hypothesis (Efron and Tibshirani 1993, 16.6) for each cause beside the others. The
/// noise is as loud in its fastest part as that of the drive; where what is left is slow, slow noise of either channel is
/// drawn in turn. Checked by the tests below.
pub(super) fn beyond_noise(drives: Option<&Drives>, bench: &Bench, found: Found) -> Found {
    let Some(drives) = drives else {
        return found;
    };
    let mut found = found;
    loop {
        let places = 0..found.best.effects.len();
        let by_noise = |k: &usize| {
            let without = found.clone().without(bench, vec![*k]).best;
            drives.make_as_much((&without, &found.best))
        };
        let left = found
            .clone()
            .without(bench, places.filter(by_noise).collect());
        if left.best.effects.len() == found.best.effects.len() {
            return left;
        }
        found = left;
    }
}

impl Drives<'_> {
    /// True where a set with a law takes no more beyond one without than noise of the drives gives it.
    pub(super) fn make_as_much(&self, (without, with): (&Fit, &Fit)) -> bool {
        let takes = without.misfit - with.misfit - alarm(&self.bench.train);
        let adds = self.adds();
        // White noise adds what its fastest part tells, slow noise more.
        let kinds: &[(bool, f64)] = if self.may_be_slow() {
            &[(false, TIMES), (true, LOUDER)]
        } else {
            &[(false, TIMES)]
        };
        let may = kinds.iter().filter(|(_, most)| takes < most * adds);
        may.into_iter().any(|&(slow, _)| {
            let of_noise = |seed: u64| self.fall((without, with), (slow, seed));
            let draws = (0..DRAWN).into_par_iter();
            draws.any(|seed| takes < TIMES * of_noise(seed))
        })
    }

    /// Misfit that a set with a cause takes beyond one without of records that are as the one without has them, by what that
    /// leaves of a row: their noise is told anew, where no cycle tells it from neighbours, and of slow noise those tell little.
    fn fall(&self, (without, with): (&Fit, &Fit), draw: Draw) -> f64 {
        let of_noise = self.read_anew(without, draw);
        // The thresholds are those of the fits.
        let problem = Problem {
            records: of_noise.train.records,
            ..self.bench.train.clone()
        };
        let [without, with] = [without, with].map(|fit| refit(&problem, fit, fit.effects.clone()));
        (without.misfit - with.misfit) / dispersion(&problem, &without)
    }

    /// What a set leaves, at most of several draws, of records that are as it has them but for noise of the drives.
    pub(super) fn leave(&self, set: &Fit) -> OfNoise {
        let slow = [false, true]
            .into_iter()
            .take(1 + usize::from(self.may_be_slow()));
        let draws: Vec<Draw> = slow
            .flat_map(|slow| (0..DRAWN).map(move |seed| (slow, seed)))
            .collect();
        let left = draws.into_par_iter().map(|draw| self.left(set, draw));
        left.reduce(OfNoise::default, |a, b| OfNoise {
            share: a.share.max(b.share),
            beyond: a.beyond.max(b.beyond),
        })
    }

    fn left(&self, set: &Fit, draw: Draw) -> OfNoise {
        let mut of_noise = self.read_anew(set, draw);
        let Bench { whole, train, .. } = self.bench;
        for (problem, own) in [(&mut of_noise.whole, whole), (&mut of_noise.train, train)] {
            *problem = Problem {
                records: std::mem::take(&mut problem.records),
                ..own.clone()
            };
        }
        if !of_noise.noise_is_repeated() {
            for _ in 0..ROUNDS {
                let first = refit(&of_noise.train, set, set.effects.clone());
                of_noise.weigh_what_is_left(&first);
            }
        }
        let whole = &of_noise.whole;
        let fit = refit(whole, set, set.effects.clone());
        OfNoise {
            share: structure(whole, &fit.predict(whole), &of_noise.noise).share,
            beyond: fit.misfit / whole.rows().max(1) as f64 - 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::diagnose;
    use crate::diagnose::drawn_drives::tests::falling;
    use crate::diagnose::drive::without_drive_noise;
    use crate::diagnose::findings::Verdict;
    use crate::diagnose::gridded::tests::slid;
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::joint::effect::Acting;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// Names of causes, and whether one is said to be noise.
    fn named(record: Record) -> (Vec<String>, bool) {
        let found = diagnose(&[record], |_| {}).unwrap();
        let causes = found.causes.into_iter();
        let said = found
            .notes
            .iter()
            .any(|n| n.contains("makes as much of it"));
        (causes.map(|c| c.name).collect(), said)
    }

    /// Calming takes what a cause would live on of most draws; of the last two it leaves some.
    #[test]
    fn noise_in_the_drive_is_no_cause() {
        let mut all_said = false;
        for seed in [1, 2, 6, 25] {
            let (causes, said) = named(falling(seed, 0));
            assert!(causes.is_empty(), "{seed}: {causes:?}");
            all_said |= said;
        }
        assert!(all_said, "nothing was taken back");
    }

    /// Cycles of 148 samples at four levels of the displacement, of a joint of 60 sliders the farther apart the harder, with noise
    /// as loud in both channels; on the way back the force lacks such a share of itself where it is large.
    fn stepped(seed: u64, smaller: f64) -> Record {
        let mut random = drawn(seed);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let limits: Vec<f64> = (1..=60).map(|j| 4e-4 * f64::from(j * j)).collect();
        let swings = |i: usize| {
            let level = [0.3, 0.5, 0.75, 1.0][(i / 888).min(3)];
            level * (std::f64::consts::TAU * i as f64 / 148.0).sin()
        };
        let displacement: Vec<f64> = (0..3552).map(swings).collect();
        let force = slid(&limits, &displacement);
        let largest = force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        let odd = |(i, f): (usize, f64)| {
            let back = (std::f64::consts::TAU * i as f64 / 148.0).cos() < 0.0;
            f - if back {
                smaller * largest * (f / largest).powi(4)
            } else {
                0.0
            }
        };
        let force = force.into_iter().enumerate().map(odd);
        Record {
            name: "stepped".to_string(),
            force: force.map(|f| f + 0.004 * largest * white()).collect(),
            displacement: displacement.iter().map(|u| u + 0.004 * white()).collect(),
            time: Some((0..3552).map(|i| 4e-3 * i as f64).collect()),
            ..Record::default()
        }
    }

    /// Play by play the noise of a drive moves what a joint remembers until the next turn, which repeats with the load.
    #[test]
    fn what_noise_of_the_drive_leaves_is_no_structure() {
        for (smaller, by_noise) in [(0.0, true), (0.1, false)] {
            let records = [stepped(1, smaller)];
            let calm = without_drive_noise(Form::Play, &records);
            let bench = prepare(Form::Play, &calm, &[Beginning::default()]);
            let plain = baseline(&bench.whole);
            let left = structure(&bench.whole, &plain.predict(&bench.whole), &bench.noise);
            assert!(left.goes_with_the_load() && left.share > 0.02);
            let of_noise = Drives::of(&records, &bench).unwrap().leave(&plain);
            assert_eq!(
                of_noise.leaves_as_structured(left.share),
                by_noise,
                "{of_noise:?} {left:?}"
            );
            let square = plain.misfit / bench.whole.rows() as f64;
            assert_eq!(
                of_noise.leaves_as_much(square),
                by_noise,
                "{of_noise:?} {square}"
            );
        }
    }

    #[test]
    fn records_with_noise_in_both_channels_are_clean() {
        for seed in [1, 3] {
            let found = diagnose(&[stepped(seed, 0.0)], |_| {}).unwrap();
            assert_eq!(found.verdict, Verdict::Clean, "{seed}: {}", found.summary);
            let said = |n: &String| n.contains("driving channel alone leaves");
            assert!(found.notes.iter().any(said), "{seed}: {:?}", found.notes);
        }
    }

    #[test]
    fn a_cause_beside_noise_in_the_drive_is_one() {
        let (causes, said) = named(falling(1, 3));
        assert!(causes == ["sensor_delay"] && !said, "{causes:?}");
    }

    /// A sweep, in which no cycle tells the noise, in slow noise of the displacement and a little of the force: what neighbours
    /// alone tell of that is a fifth of it.
    #[test]
    fn slow_noise_that_no_cycle_tells_makes_no_more_of_a_cause() {
        let mut random = drawn(20_261_129);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let mut slow = 0.0;
        let mut record = Record {
            name: "sweep".to_string(),
            time: Some((0..3000).map(|i| 1e-3 * f64::from(i)).collect()),
            ..Record::default()
        };
        for i in 0..3000 {
            let t = f64::from(i);
            let load = (std::f64::consts::TAU * t * (1.0 + t / 1000.0) / 600.0).sin();
            slow = 0.95 * slow + 0.3122 * white();
            record.displacement.push(load + 0.02 * slow + 2e-5 * t);
            record.force.push(load + 1e-3 * white());
        }
        let records = std::slice::from_ref(&record);
        let mut bench = prepare(Form::Play, records, &[Beginning::default()]);
        for _ in 0..2 {
            bench.weigh_what_is_left(&baseline(&bench.train));
        }
        assert!(!bench.noise_is_repeated());
        let without = baseline(&bench.train);
        let acting = Acting {
            effect: find("displacement_drift").unwrap().effect(),
            values: vec![2e-5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        };
        let with = refit(&bench.train, &without, vec![acting]);
        let drives = Drives::of(records, &bench).unwrap();
        let fall = (0..DRAWN).map(|seed| drives.fall((&without, &with), (false, seed)));
        let fall: Vec<f64> = fall.collect();
        // χ²₃, in one of a thousand 16.3, of noise that goes together by 0.95 taken for white: (1 + a)/(1 − a) times as much.
        assert!(fall.iter().sum::<f64>() < 16.3 * 39.0, "{fall:?}");
    }

    /// Draws are met by the thresholds that the records were, be there more of them.
    #[test]
    fn records_that_need_other_thresholds_are_drawn_as_well() {
        let record = falling(1, 3);
        let mut bench = prepare(
            Form::Stop,
            std::slice::from_ref(&record),
            &[Beginning::default()],
        );
        let evenly = vec![1.0; bench.train.operators.columns()];
        for problem in [&mut bench.whole, &mut bench.train] {
            problem.operators = problem.operators.adapted(&evenly, 90);
        }
        let without = baseline(&bench.train);
        let acting = Acting {
            effect: find("sensor_delay").unwrap().effect(),
            values: vec![0.0, 0.0, 1e-3],
        };
        let with = refit(&bench.train, &without, vec![acting]);
        let drives = Drives::of(std::slice::from_ref(&record), &bench).unwrap();
        let takes = without.misfit - with.misfit;
        let of_noise = drives.fall((&without, &with), (false, 0));
        assert!(
            of_noise >= 0.0 && of_noise < 0.2 * takes,
            "{of_noise} of {takes}"
        );
    }
}
