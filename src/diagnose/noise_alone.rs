//! What noise of the drive alone would make of a cause: records drawn as these are, but for it.

use super::drive::{drive_noise, residuals, without_drive_noise};
use super::prepare::{Bench, prepare};
use super::search::Found;
use super::smooth_drive::felt;
use super::trials::{alarm, dispersion};
use crate::identify::beginning::Beginning;
use crate::identify::{Fit, Form, Problem, refit};
use crate::record::Record;
use crate::record::calm::fastest;
use crate::record::cycles::rms;
use crate::record::resolution::step_of_drive;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// What the noise of a drive adds, in variances of the judged channel's, from which it may pass for a cause.
const MAY: f64 = 1.0;

/// Correlation of neighbours in what a model leaves from which that may be of the drive's noise as well.
const SLOW: f64 = 0.3;

/// Times as much as of noise that a cause has to take. Judged: of clean records causes took 1.0 to 1.5 times the most of
/// several draws, of records with a cause ten times and more.
const TIMES: f64 = 2.0;

/// Times what noise adds as its fastest part tells, `(1 + a)/(1 − a)` of neighbours that go together by 0.9: no cause takes
/// more of it.
const LOUDER: f64 = 20.0;

/// Draws of each kind of noise. Calming takes the noise of some and not of others: where it does of half of them, it does of
/// all by one in sixty.
const DRAWN: u64 = 6;

/// Share of what a model leaves, in variance, that is noise of the judged channel itself, at least.
const OWN: f64 = 0.1;

/// What was found without the causes that take no more of the records than of such as noise of the drive makes without
/// them: whatever smooths a noisy drive, or follows how fast it changes, explains some of its noise.
///
/// A parametric bootstrap of the null hypothesis (Efron and Tibshirani 1993, 16.6) for each cause beside the others. The
/// noise is as loud in its fastest part as that of the drive; where what is left is slow, slow noise of either channel is
/// drawn in turn. Checked by the tests below.
pub(super) fn beyond_noise(records: &[Record], bench: &Bench, found: Found) -> Found {
    let form = bench.train.operators.form;
    let noise = unfelt_noise(form, records);
    if is_quiet(&noise) {
        return found;
    }
    let drives = Drives {
        records,
        bench,
        noise,
    };
    let mut found = found;
    loop {
        let places = 0..found.best.effects.len();
        let by_noise = places
            .filter(|k| drives.takes_as_much(&found, *k))
            .collect();
        let left = found.clone().without(bench, by_noise);
        if left.best.effects.len() == found.best.effects.len() {
            return left;
        }
        found = left;
    }
}

/// Noise of each drive, and what it may add to the misfit; none that the joint felt, which is told of the drives as they were
/// read: of calmed ones a model makes nothing of their noise.
fn unfelt_noise(form: Form, records: &[Record]) -> Vec<[f64; 2]> {
    let mut noise: Vec<[f64; 2]> = records.iter().map(|r| drive_noise(form, r)).collect();
    if is_quiet(&noise) {
        return noise;
    }
    let residuals = residuals(form, records);
    for ((noise, record), residual) in noise.iter_mut().zip(records).zip(&residuals) {
        let (drive, judged) = form.channels(record);
        if felt(drive, judged, residual) {
            *noise = [0.0; 2];
        }
    }
    noise
}

fn is_quiet(noise: &[[f64; 2]]) -> bool {
    noise.iter().all(|[_, adds]| *adds < MAY)
}

/// Records whose drives are noisy.
struct Drives<'a> {
    records: &'a [Record],
    bench: &'a Bench,
    /// Noise of each drive, and what it may add to the misfit.
    noise: Vec<[f64; 2]>,
}

impl Drives<'_> {
    /// True where a cause of the set takes no more than noise of the drives gives it.
    fn takes_as_much(&self, found: &Found, k: usize) -> bool {
        let (train, best) = (&self.bench.train, &found.best);
        let without = found.clone().without(self.bench, vec![k]).best;
        let takes = without.misfit - best.misfit - alarm(train);
        let adds = self.noise.iter().map(|[_, adds]| adds).sum::<f64>();
        let slow = self.bench.noise.iter().any(|n| n.autoregression > SLOW);
        // White noise adds what its fastest part tells, slow noise more.
        let kinds: &[(bool, f64)] = if slow {
            &[(false, TIMES), (true, LOUDER)]
        } else {
            &[(false, TIMES)]
        };
        let may = kinds.iter().filter(|(_, most)| takes < most * adds);
        may.into_iter().any(|&(slow, _)| {
            let of_noise = |seed: u64| self.fall((&without, best), (slow, seed));
            let draws = (0..DRAWN).into_par_iter();
            draws.any(|seed| takes < TIMES * of_noise(seed))
        })
    }

    /// Misfit that a set with a cause takes beyond one without of records that are as the one without has them, by what that
    /// leaves of a row: their noise is told anew, where no cycle tells it from neighbours, and of slow noise those tell little.
    fn fall(&self, (without, with): (&Fit, &Fit), (slow, seed): (bool, u64)) -> f64 {
        let form = self.bench.train.operators.form;
        let drawn = self.drawn(without, (slow, seed));
        let begun = self.bench.train.records.iter();
        let beginnings: Vec<Beginning> = begun.map(|r| r.beginning.clone()).collect();
        let mut of_noise = prepare(form, &without_drive_noise(form, &drawn), &beginnings);
        of_noise.fit_also(self.bench.fitted);
        // The thresholds are those of the fits.
        let problem = Problem {
            records: of_noise.train.records,
            ..self.bench.train.clone()
        };
        let [without, with] = [without, with].map(|fit| refit(&problem, fit, fit.effects.clone()));
        (without.misfit - with.misfit) / dispersion(&problem, &without)
    }

    /// The records as a model has them, with noise in the drive of which the joint felt nothing.
    fn drawn(&self, model: &Fit, (slow, seed): (bool, u64)) -> Vec<Record> {
        let mut random = ChaCha8Rng::seed_from_u64(20_010_811 + seed);
        let whole = &self.bench.whole;
        let (predicted, left) = (model.predict(whole), model.residuals(whole));
        let one = |(k, record): (usize, &Record)| {
            let alike = self.bench.noise[k].autoregression;
            let (of_drive, of_judged) = if slow { (alike, 0.0) } else { (0.0, alike) };
            let left = rms(&left[k]);
            let prepared = &whole.records[k];
            let (drive, judged) = (whole.channels(k).0, &predicted[k].judged);
            let true_drive: Vec<f64> = drive.iter().map(|x| x + prepared.beginning.zero).collect();
            let channels = whole.operators.form.channels(record);
            let (read, answered) = match step_of_drive(channels.0, channels.1) {
                Some(step) => {
                    let read = true_drive.iter().map(|x| (x / step).round() * step);
                    (read.collect(), 0.0)
                }
                None => self.with_noise((k, record), &true_drive, (of_drive, left), &mut random),
            };
            let own = (left * left - answered * answered).max(OWN * left * left);
            let noise = coloured(&mut random, judged.len(), of_judged, own.sqrt());
            let judged = judged.iter().zip(noise).map(|(y, f)| y + f).collect();
            let mut drawn = record.clone();
            let (of_drive, of_judged) = whole.operators.form.channels_mut(&mut drawn);
            (*of_drive, *of_judged) = (read, judged);
            drawn
        };
        self.records.iter().enumerate().map(one).collect()
    }

    /// A drive as its channel reads it, and what a model answers to the noise, at most what it leaves.
    fn with_noise(
        &self,
        (k, record): (usize, &Record),
        drive: &[f64],
        (alike, left): (f64, f64),
        random: &mut ChaCha8Rng,
    ) -> (Vec<f64>, f64) {
        let [loud, adds] = self.noise[k];
        let (_, judged) = self.bench.train.operators.form.channels(record);
        let steepest = (adds / drive.len() as f64).sqrt() * fastest(judged) / loud;
        let noise = coloured(random, drive.len(), alike, 1.0);
        let loud = (loud / fastest(&noise)).min(left / steepest);
        let read = drive.iter().zip(&noise).map(|(x, e)| x + loud * e);
        (read.collect(), steepest * loud)
    }
}

/// Noise of a deviation whose neighbours go together.
fn coloured(random: &mut ChaCha8Rng, count: usize, alike: f64, deviation: f64) -> Vec<f64> {
    let mut last = 0.0;
    let mut next = || {
        // Twelve uniform numbers have the variance one, and a sum that is nearly normal.
        let white = (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        last = alike * last + (1.0 - alike * alike).sqrt() * white;
        deviation * last
    };
    (0..count).map(|_| next()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::diagnose;
    use crate::diagnose::gridded::tests::slid;
    use crate::identify::baseline;
    use crate::joint::effect::Acting;
    use crate::record::noise::tests::drawn;

    /// Cycles of 79 samples that fall, slow noise in the displacement that drives and noise as loud in the force, which a
    /// cell reads so many samples late.
    fn falling(seed: u64, late: usize) -> Record {
        let mut random = drawn(seed);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let limits: Vec<f64> = (1..=40).map(|j| 0.03 * f64::from(j)).collect();
        let swings = |i: usize| {
            let t = i as f64;
            (0.3 + 0.7 * (-t / 900.0).exp()) * (std::f64::consts::TAU * t / 79.0).sin()
        };
        let displacement: Vec<f64> = (0..2000).map(swings).collect();
        let force = slid(&limits, &displacement);
        let largest = force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        let mut slow = 0.0;
        let mut read = |x: &f64| {
            slow = 0.66 * slow + 0.75 * white();
            x + 0.015 * slow
        };
        let displacement = displacement.iter().map(&mut read).collect();
        let at = |i: usize| force[i.saturating_sub(late)];
        Record {
            name: "falling".to_string(),
            force: (0..2000)
                .map(|i| at(i) + 0.009 * largest * white())
                .collect(),
            displacement,
            time: Some((0..2000).map(|i| 4e-4 * i as f64).collect()),
            ..Record::default()
        }
    }

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

    #[test]
    fn noise_in_the_drive_is_no_cause() {
        let mut all_said = false;
        for seed in 1..=4 {
            let (causes, said) = named(falling(seed, 0));
            assert!(causes.is_empty(), "{seed}: {causes:?}");
            all_said |= said;
        }
        assert!(all_said, "nothing was taken back");
    }

    #[test]
    fn a_cause_beside_noise_in_the_drive_is_one() {
        let (causes, said) = named(falling(1, 3));
        assert!(causes == ["sensor_delay"] && !said, "{causes:?}");
    }

    /// Noise of a channel is not felt, be a drive that is calmed without it.
    #[test]
    fn noise_that_was_read_alone_is_not_felt() {
        for seed in 1..=4 {
            let record = [falling(seed, 0)];
            let [_, adds] = unfelt_noise(Form::Stop, &record)[0];
            assert!(adds > MAY, "{seed}: {adds}");
            let calm = without_drive_noise(Form::Stop, &record);
            assert_ne!(calm[0].displacement, record[0].displacement);
        }
        // A joint that moves as its displacement is read feels all of it.
        let read = falling(1, 0);
        let felt = Record {
            force: slid(&[0.5, 1.0], &read.displacement),
            ..read
        };
        assert_eq!(unfelt_noise(Form::Stop, &[felt]), [[0.0; 2]]);
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
        let drives = Drives {
            records,
            bench: &bench,
            noise: vec![drive_noise(Form::Play, &record)],
        };
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
        let drives = Drives {
            records: std::slice::from_ref(&record),
            bench: &bench,
            noise: vec![drive_noise(Form::Stop, &record)],
        };
        let takes = without.misfit - with.misfit;
        let of_noise = drives.fall((&without, &with), (false, 0));
        assert!(
            of_noise >= 0.0 && of_noise < 0.2 * takes,
            "{of_noise} of {takes}"
        );
    }
}
