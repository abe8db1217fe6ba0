//! A prepared record with fewer samples: a densely sampled cycle says no more than a well sampled one.

use super::operators::Form;
use super::prepared::Prepared;
use super::problem::Problem;
use crate::record::colour::Colour;
use crate::record::cycles::cycles;
use crate::record::mains::NOMINAL;

/// Fewest samples per cycle that thinning leaves.
const PER_CYCLE: usize = 40;

/// Part of the thinned rate by which an alias has to stay away from rest and from half that rate, where one of a sine's
/// two parts vanishes at every sample.
const APART: f64 = 0.05;

/// Counts of samples tried beyond the one asked for.
const TRIED: usize = 4;

/// Part of the independent samples that is as good as all of them.
const AS_MUCH: f64 = 0.9;

/// True where a hum of the mains is seen in both its parts by every `every`-th of samples `Δt` apart, if it is by all.
fn shows_mains(every: usize, sample: f64) -> bool {
    let shows = |f: f64, every: usize| {
        let twice = 2.0 * (f * sample * every as f64).fract();
        (twice - twice.round()).abs() > 2.0 * APART
    };
    NOMINAL.into_iter().all(|f| shows(f, every) || !shows(f, 1))
}

impl Problem {
    /// The records with every few samples only, so that about `enough` independent ones are left and no fewer than `samples`
    /// of any, each weighing what it does here; `None` where no record has that many to spare.
    ///
    /// Peaks between samples stay where all samples have shown them, and so do turning points. Of noise whose neighbours
    /// correlate by `a` every `m`-th samples do by `aᵐ`: of slow noise few samples say as much as all.
    pub fn coarser(&self, (enough, samples): (usize, usize)) -> Option<Problem> {
        let form = self.operators.form;
        let wanted = (enough as f64 / self.independent_rows()).min(AS_MUCH);
        let spared = self.rows() / samples;
        let every = |r: &Prepared| {
            let stays = |every: usize| share(r.colour, every) >= wanted;
            let seen = |every: &usize| stays(*every) && shows_mains(*every, r.mean_step());
            let most = r.sparsest(form).min(spared);
            (1..=most).rev().find(seen).unwrap_or(1)
        };
        let every: Vec<usize> = self.records.iter().map(every).collect();
        if every.iter().all(|every| *every < 2) {
            return None;
        }
        let mut coarse = self.clone();
        for (record, every) in coarse.records.iter_mut().zip(every) {
            let length = record.time.len();
            record.pick(&record.few(form, (0, every, length)));
            // weight = 1/innovation
            let before = record.colour;
            record.colour = before.apart(every);
            let gains = before.innovation() / record.colour.innovation();
            record.weight.iter_mut().for_each(|w| *w *= gains);
        }
        Some(coarse)
    }
}

/// Part of the independent samples that every `every`-th sample keeps.
fn share(colour: Colour, every: usize) -> f64 {
    colour.apart(every).independence() / (every as f64 * colour.independence())
}

impl Prepared {
    /// Most samples of which one may stay, so that [`PER_CYCLE`] are left of the shortest cycle; `None` without cycles.
    pub(super) fn sparsest_of_cycles(&self, form: Form) -> Option<usize> {
        let cycles = cycles(self.channels(form).0);
        let shortest = cycles.iter().map(|c| c.len()).min()?;
        Some((shortest / PER_CYCLE).max(1))
    }

    /// The same, of a record without cycles as of one.
    fn sparsest(&self, form: Form) -> usize {
        let as_one = || (self.time.len() / PER_CYCLE).max(1);
        self.sparsest_of_cycles(form).unwrap_or_else(as_one)
    }

    /// Mean distance of samples \[s\].
    fn mean_step(&self) -> f64 {
        self.length() / (self.time.len().max(2) - 1) as f64
    }

    /// Of how many samples one may stay of the `wanted`: cycles keep enough, and a hum of the mains is seen; where
    /// so few do not show it somewhat more are taken, if any do.
    pub fn every(&self, form: Form, wanted: usize) -> usize {
        let every = wanted.min(self.sparsest(form)).max(1);
        let seen = |every: &usize| shows_mains(*every, self.mean_step());
        (every..every + TRIED).find(seen).unwrap_or(every)
    }

    /// Every sample before `whole`, then each `every`-th and every turning point up to `length`.
    fn few(&self, form: Form, (whole, every, length): (usize, usize, usize)) -> Vec<usize> {
        let (input, _) = self.channels(form);
        let turns = |i: usize| {
            i > 0
                && i + 1 < length
                && (input[i] - input[i - 1]) * (input[i + 1] - input[i]) < 0.0
                && every > 1
        };
        let stays = |&i: &usize| {
            i < whole || i.is_multiple_of(every) || turns(i) && turns_far(input, i, every)
        };
        (0..length).filter(stays).collect()
    }

    /// Leaves the samples of these indices.
    fn pick(&mut self, indices: &[usize]) {
        let pick = |channel: &[f64]| indices.iter().map(|&i| channel[i]).collect::<Vec<f64>>();
        self.between.thin(indices, &self.time);
        self.time = pick(&self.time);
        self.force = pick(&self.force);
        self.displacement = pick(&self.displacement);
        self.weight = pick(&self.weight);
        self.steps = std::iter::once(0.0)
            .chain(self.time.windows(2).map(|pair| pair[1] - pair[0]))
            .collect();
    }

    /// Every sample before `whole`, then each `every`-th and every turning point up to `length`.
    pub fn thin(&mut self, form: Form, (whole, every, length): (usize, usize, usize)) {
        let weighs = |i: usize| (i, if i < whole { 1 } else { every });
        let few = self.few(form, (whole, every, length)).into_iter();
        let kept: Vec<(usize, usize)> = few.map(weighs).collect();
        self.keep(&kept);
    }

    /// Leaves the given samples, each standing for as many: where one stands for more than itself, noise counts as
    /// white, `σ² (1+a)/((1−a) m)` of first-order noise.
    pub fn keep(&mut self, kept: &[(usize, usize)]) {
        let indices: Vec<usize> = kept.iter().map(|(i, _)| *i).collect();
        let colour = self.colour;
        self.pick(&indices);
        if kept.iter().any(|(_, every)| *every > 1) {
            // weight = 1/innovation
            for (weight, (_, every)) in self.weight.iter_mut().zip(kept) {
                *weight *= colour.innovation() * (colour.independence() * *every as f64).sqrt();
            }
            self.colour = Colour::WHITE;
        }
    }
}

/// True where a sample is the extreme of its neighbourhood and no wiggle of the noise.
fn turns_far(input: &[f64], i: usize, reach: usize) -> bool {
    let (from, to) = (i.saturating_sub(reach), (i + reach).min(input.len() - 1));
    let around = &input[from..=to];
    around.iter().all(|x| *x <= input[i]) || around.iter().all(|x| *x >= input[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Record;

    /// Ten cycles of a hundred samples, with turns at 25 and 75 of each.
    fn prepared() -> Prepared {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / 100.0;
        let force: Vec<f64> = (0..1000).map(|i| angle(i).sin()).collect();
        let record = Record {
            displacement: vec![0.0; force.len()],
            time: Some((0..1000).map(|i| 0.01 * i as f64).collect()),
            force,
            ..Record::default()
        };
        Prepared::new(&record, Form::Play)
    }

    #[test]
    fn a_thinned_record_keeps_its_beginning_its_turns_and_its_weight() {
        let mut few = prepared();
        few.colour = Colour::first_order(0.5);
        few.thin(Form::Play, (100, 7, 1000));
        let tenth = |i: f64| (100.0 * i).round() as usize;
        let kept: Vec<usize> = few.time.iter().map(|t| tenth(*t)).collect();
        assert!((0..100).all(|i| kept[i] == i));
        let turns = (1..10).flat_map(|cycle| [100 * cycle + 25, 100 * cycle + 75]);
        assert!(
            turns.into_iter().all(|turn| kept.contains(&turn)),
            "{kept:?}"
        );
        assert!(kept.len() < 100 + 900 / 7 + 40, "{}", kept.len());
        let passed: f64 = few.steps.iter().sum();
        assert!((passed - (few.time[kept.len() - 1] - few.time[0])).abs() < 1e-12);
        // Noise of this correlation weighs a quarter as white noise, and as often as the sample stands for others.
        let squares = |from: usize| few.weight[from].powi(2);
        assert!((squares(0) - 0.25).abs() < 1e-12 && (squares(100) - 0.25 * 7.0).abs() < 1e-12);
        assert_eq!(few.colour, Colour::WHITE);
    }

    #[test]
    fn a_hum_is_not_thinned_away() {
        // At 200 Hz every second sample of 50 Hz is the same but for its sign, and every fourth wholly the same.
        let shown = |every: usize, sample: f64| (every..).find(|e| shows_mains(*e, sample));
        assert_eq!(shown(2, 1.0 / 200.0), Some(3));
        assert_eq!(shown(4, 1.0 / 200.0), Some(7));
        assert_eq!(shown(2, 1.0 / 203.0), Some(3));
        assert_eq!(shown(2, 1.0 / 1000.0), Some(2));
        // At 200 Hz 60 Hz is not seen in every tenth sample, and not in any of those without a time that means seconds.
        assert!(
            !shows_mains(10, 1.0 / 200.0) && shows_mains(1, 1.0 / 200.0) && shows_mains(3, 1.0)
        );
    }

    /// Four thousand samples of which a thousand are enough: every fourth, the tips and peaks where all samples have them, and
    /// the same misfit per row of a joint that answers as it did; too few, or too few of a cycle, are not thinned.
    #[test]
    fn few_of_many_samples_leave_the_same_of_every_row() {
        let mut noise = crate::record::noise::tests::drawn(20261128);
        let mut record = Record {
            name: "dense".to_string(),
            force: (0..4000).map(|i| (0.02 * f64::from(i)).sin()).collect(),
            time: Some((0..4000).map(|i| 1e-3 * f64::from(i)).collect()),
            ..Record::default()
        };
        let joint = |problem: &Problem| -> Vec<f64> {
            let columns = 0..problem.operators.columns();
            columns.map(|i| if i == 0 { 1e-8 } else { 1e-10 }).collect()
        };
        let answered = Record {
            displacement: vec![0.0; 4000],
            ..record.clone()
        };
        let mut problem = Problem::new(Form::Play, &[answered]);
        let exact = problem.predict(&joint(&problem), &[])[0].judged.clone();
        record.displacement = exact.iter().map(|u| u + 1e-10 * noise()).collect();
        problem = Problem::new(Form::Play, &[record]);
        problem.records[0].weight.fill(1e10);
        let few = problem.coarser((1000, 1000)).unwrap();
        let per_row = |p: &Problem| p.misfit(&p.predict(&joint(p), &[])).0 / p.rows() as f64;
        assert!((1000..1060).contains(&few.rows()), "{}", few.rows());
        // A thousand squares scatter by 4 % of their mean, or less.
        let apart = per_row(&few) / per_row(&problem) - 1.0;
        assert!(apart.abs() < 0.12, "{apart}");
        assert_eq!(
            few.records[0].between.peaks.len(),
            problem.records[0].between.peaks.len()
        );
        assert_eq!(problem.coarser((2001, 2001)), None);
        // Of a cycle of 314 samples no more than seven may go for one that stays.
        assert!(problem.coarser((10, 10)).unwrap().rows() > 4000 / 8);
        // Slow noise says less by more samples, and as much by few of them.
        problem.records[0].colour = Colour::first_order(0.2);
        let slow = problem.coarser((1000, 500)).unwrap();
        assert!((1300..1420).contains(&slow.rows()), "{}", slow.rows());
        assert!((slow.records[0].colour.slow - 0.2_f64.powi(3)).abs() < 1e-15);
        // 1/innovation of neighbours becomes that of samples three apart.
        let weight = slow.records[0].weight[1] / 1e10;
        assert!((weight - (0.96_f64 / (1.0 - 0.2_f64.powi(6))).sqrt()).abs() < 1e-12);
        problem.records[0].colour = Colour::first_order(0.9);
        let slow = problem.coarser((1000, 1000)).unwrap();
        assert!(slow.independent_rows() > 0.9 * problem.independent_rows());
        assert!(slow.rows() < 1400, "{}", slow.rows());
        // Of noise whose neighbours say the opposite every other sample says much less.
        problem.records[0].colour = Colour::first_order(-0.9);
        assert_eq!(problem.coarser((10_000, 10_000)), None);
    }
}
