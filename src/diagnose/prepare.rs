//! Before any fit: the noise of the records, and what is held out.

use super::first_noise;
use super::gridded::{fitted, resolve};
use super::mains_phase;
use super::sizes::sizes;
use super::striking::strike_residuals;
use crate::causes::Scale;
use crate::identify::beginning::{Beginning, early};
use crate::identify::{Fit, Form, Problem, baseline};
use crate::record::Record;
use crate::record::noise::{Noise, from_residual};
use crate::record::resolution::resolution;
use crate::record::split::{Fitted, held_out, held_out_elsewhere};

/// Records ready for the search.
#[derive(Debug, Clone)]
pub struct Bench {
    /// All samples weighted, for the final joint.
    pub whole: Problem,
    /// Held-out samples without weight, for naming and for the gain.
    pub train: Problem,
    /// Held-out marks per record.
    pub held: Vec<Vec<bool>>,
    /// What they leave to the fit that is set aside as a rule.
    pub fitted: Fitted,
    /// Samples that stand alone, per record: replaced by what their neighbours say, and no witness.
    pub struck: Vec<Vec<bool>>,
    /// Noise of the judged channel per record.
    pub noise: Vec<Noise>,
    /// Least deviation that noise of that channel is taken for, per record: what it resolves.
    pub resolution: Vec<f64>,
    /// Sizes for the starts of the search.
    pub scale: Scale,
    /// True where the drive of a record is read with noise, which no model answers as the joint did.
    pub noisy_drive: bool,
    /// True of records whose drive was read anew without noise.
    pub calmed: Vec<bool>,
    /// First samples of each record that are no witnesses: what they answer hangs on loads before them.
    pub unsure: Vec<usize>,
    /// True where sets without a cause that wears the joint were searched before, of joints made anew, which they leave as
    /// much of.
    pub wearing_sets: bool,
}

/// Share of the noise's variance that a law only nearly right may leave: a third of the noise in rms.
const NEARLY_RIGHT: f64 = 0.1;

/// Samples below which the noise of a record is read off all of it.
const FEW: usize = 64;

/// Standard deviations that the noise's variance may lie off.
const SCATTER: f64 = 3.0;

/// Prepares records with their beginnings in a form: first unweighted baseline, noise, weights, marks.
pub fn prepare(form: Form, records: &[Record], beginnings: &[Beginning]) -> Bench {
    let (mut whole, mut first) = fitted(Problem::begun(form, records, beginnings));
    let marks = |record: &Record| {
        let mut struck = vec![false; record.len()];
        record.alone.iter().for_each(|&i| struck[i] = true);
        struck
    };
    let mut struck: Vec<Vec<bool>> = records.iter().map(marks).collect();
    if strike_residuals(&mut whole, &first, &mut struck) {
        first = baseline(&whole);
    }
    if records.iter().all(|r| r.time.is_some()) {
        mains_phase::align(&mut whole, &first);
    }
    let resolution: Vec<f64> = records
        .iter()
        .map(|record| resolution(form.channels(record).1))
        .collect();
    let noise = first_noise::told(&whole, &first, (&resolution, records));
    let held: Vec<Vec<bool>> = (0..whole.records.len())
        .map(|k| held_out(whole.channels(k).0))
        .collect();
    let scale = sizes(&whole, &first);
    let train = whole.clone();
    let mut bench = Bench {
        whole,
        train,
        held,
        fitted: Fitted::default(),
        struck,
        noise: Vec::new(),
        resolution,
        scale,
        noisy_drive: records.iter().any(|r| r.noisy_drive),
        calmed: records.iter().map(|r| r.calmed).collect(),
        unsure: vec![0; records.len()],
        wearing_sets: false,
    };
    for (k, beginning) in beginnings.iter().enumerate() {
        if beginning.is_sought() {
            bench.unsure[k] = early(bench.whole.channels(k).0);
        }
    }
    // A joint that remembers where it was turned is as worn as it was left.
    if beginnings.iter().any(|b| b.goes_on) {
        bench.wear_on();
    }
    bench.weigh(noise);
    resolve(&mut bench);
    bench
}

impl Bench {
    /// From now on a mass that moves with the joint is marched in so many parts of a step, or its share of the force is
    /// taken off in so many turns.
    pub fn haul(&mut self, (parts, turns): (u32, usize)) {
        for problem in [&mut self.whole, &mut self.train] {
            (problem.hauling, problem.turns) = (parts, turns);
        }
    }

    /// Takes the records from now on for tests of a joint one after the other, which wears on from each to the next.
    pub fn wear_on(&mut self) {
        self.whole.wears_on = true;
        self.train.wears_on = true;
    }

    /// Sets other cycles aside from now on, so that the fit sees what it has to.
    pub fn fit_also(&mut self, fitted: Fitted) {
        for (k, held) in self.held.iter_mut().enumerate() {
            *held = held_out_elsewhere(self.whole.channels(k).0, fitted);
        }
        self.fitted = fitted;
        self.weigh(self.noise.clone());
    }

    /// True for a sample that no fit has seen and that is a witness.
    pub fn is_unseen(&self, record: usize, sample: usize) -> bool {
        self.held[record][sample] && self.whole.records[record].counts(sample)
    }

    /// True where repeated cycles gave the noise of every record.
    pub fn noise_is_repeated(&self) -> bool {
        self.noise.iter().all(|n| n.repeated)
    }

    /// True where the noise of a record is what a model left and so slow that it may be the model's error.
    pub fn noise_may_be_structure(&self) -> bool {
        self.noise
            .iter()
            .any(|n| !n.repeated && n.is_rather_structure())
    }

    /// Sum of the logarithms of the noise's innovations squared, over the weighted samples.
    pub fn innovations(&self) -> f64 {
        let weights = self.train.records.iter().flat_map(|r| &r.weight);
        let weighted = weights.filter(|w| **w > 0.0);
        weighted.map(|w| -2.0 * w.ln()).sum()
    }

    /// Square of the noise's innovations, their geometric mean over the weighted samples, in units of the judged channel.
    pub fn innovation_square(&self) -> f64 {
        (self.innovations() / self.train.rows().max(1) as f64).exp()
    }

    /// True where a record shows less noise than its channel resolves: what laws are wrong by is seen beside it.
    pub fn is_finer_than_read(&self, record: usize) -> bool {
        self.noise[record].deviation <= self.resolution[record]
    }

    /// True where no record shows more noise than its channel resolves.
    pub fn is_read_to_the_end(&self) -> bool {
        (0..self.noise.len()).all(|k| self.is_finer_than_read(k))
    }

    /// Largest mean whitened square that a model without error may leave, where repeated cycles gave
    /// the noise, and it is no finer than its channel: one, what the estimate of the noise's variance scatters by, and what laws that are
    /// only nearly right may leave.
    pub fn most_left(&self) -> Option<f64> {
        if (0..self.noise.len()).any(|k| self.is_finer_than_read(k)) {
            return None;
        }
        self.noise_is_repeated()
            .then_some(1.0 + NEARLY_RIGHT + SCATTER * self.noise_error())
    }

    /// Standard error of what noise leaves of all rows, as a share of it: `n` samples tell a variance to `√(2/n)`,
    /// `√(2 (1 + a²) / ((1 − a²) n))` where first-order noise correlates by `a`, and every estimate is wrong alike in all rows that are weighed by it, of records
    /// that borrow it as well.
    pub fn noise_error(&self) -> f64 {
        let mut told: Vec<(&Noise, f64)> = Vec::new();
        for (noise, record) in self.noise.iter().zip(&self.train.records) {
            let rows = record.rows() as f64;
            let same =
                |n: &Noise| n.repeated && n.samples == noise.samples && n.colour == noise.colour;
            match told.iter_mut().find(|(n, _)| same(n)) {
                Some((_, all)) => *all += rows,
                None => told.push((noise, rows)),
            }
        }
        let whole: f64 = told.iter().map(|(_, rows)| rows).sum();
        let square = |(noise, rows): &(&Noise, f64)| {
            let independent = noise.told_by() * noise.colour.independence_of_squares();
            (rows / whole.max(1.0)).powi(2) * 2.0 / independent.max(1.0)
        };
        told.iter().map(square).sum::<f64>().sqrt()
    }

    /// Misfit that causes have to take away at least, beyond an alarm: what laws are wrong by beside the noise of a drive, and
    /// as many alarms as noise of another kind than first-order is louder where it is loudest.
    pub fn least_taken(&self, alarm: f64) -> f64 {
        let driven = match self.noisy_drive {
            true => NEARLY_RIGHT * self.train.rows() as f64,
            false => 0.0,
        };
        let coloured = self.noise.iter().map(Noise::coloured);
        let coloured = coloured.filter(|times| *times > 1.0).map(|t| t * alarm);
        coloured.fold(driven, f64::max)
    }

    /// Weighs every sample by the given noise, held-out ones not at all in `train`.
    pub fn weigh(&mut self, noise: Vec<Noise>) {
        for (k, noise) in noise.iter().enumerate() {
            let innovation = noise.innovation();
            for (problem, keep) in [(&mut self.whole, true), (&mut self.train, false)] {
                let record = &mut problem.records[k];
                record.colour = noise.colour;
                let marks = self.held[k].iter().zip(&self.struck[k]);
                for (i, (weight, (held, struck))) in record.weight.iter_mut().zip(marks).enumerate()
                {
                    let counts = !struck && (keep || !held) && i >= self.unsure[k];
                    *weight = if counts { 1.0 / innovation } else { 0.0 };
                }
            }
        }
        self.noise = noise;
    }

    /// Weighs by what the given fit leaves where nothing repeats.
    pub fn weigh_what_is_left(&mut self, fit: &Fit) {
        if !self.noise_is_repeated() {
            let noise = self.noise_from(fit);
            self.weigh(noise);
        }
    }

    /// Noise read off the residual of the given fit, for records in which nothing repeats: what
    /// the best model leaves is noise until a test of structure says otherwise.
    pub fn noise_from(&self, fit: &Fit) -> Vec<Noise> {
        let residuals = fit.residuals(&self.whole);
        (0..self.whole.records.len())
            .map(|k| {
                if self.noise[k].repeated {
                    return self.noise[k];
                }
                let (input, left) = self.witnesses(k, &residuals[k]);
                let slow = first_noise::unlike_the_load(self.calmed[k], &input, &left);
                let noise = slow.unwrap_or_else(|| from_residual(&left));
                Noise {
                    deviation: noise.deviation.max(self.resolution[k]),
                    ..noise
                }
            })
            .collect()
    }

    /// The drive, and what is left, of the samples of record `k` that a fit answers for, held-out ones included; of all
    /// where those are too few.
    fn witnesses(&self, k: usize, residual: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let (input, _) = self.whole.channels(k);
        let all = || input.iter().copied().zip(residual.iter().copied());
        let marks = all().zip(&self.struck[k]).enumerate();
        let own = marks.filter(|(i, (_, struck))| *i >= self.unsure[k] && !**struck);
        let own: (Vec<f64>, Vec<f64>) = own.map(|(_, (both, _))| both).unzip();
        match own.1.len() < FEW {
            true => all().unzip(),
            false => own,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::gridded::tests::slid;
    use crate::record::noise::tests::drawn;
    use crate::record::repeats::from_repeats;

    /// Cycles of 37.3 samples of a bent spring: no cycle is sampled like the one before, and what lies between samples is
    /// not straight.
    #[test]
    fn what_interpolation_misses_of_a_bent_response_is_no_noise() {
        let mut noise = drawn(20261126);
        let time: Vec<f64> = (0..1500).map(|i| 0.01 * f64::from(i)).collect();
        let phase = |i: usize| i as f64 * std::f64::consts::TAU / 37.3;
        let loud = 3e-4;
        let limits: Vec<f64> = (1..=20).map(|j| 0.05 * f64::from(j)).collect();
        let displacement: Vec<f64> = (0..1500).map(|i| 1.1 * phase(i).sin()).collect();
        let quiet = slid(&limits, &displacement);
        let mut answer = |f: &f64| f / 20.0 + loud * 12.0_f64.sqrt() * (noise() - 0.5);
        let record = Record {
            name: "bent".to_string(),
            force: quiet.iter().map(&mut answer).collect(),
            displacement,
            time: Some(time),
            ..Record::default()
        };
        let raw = from_repeats(&record.displacement, &record.force).unwrap();
        let bench = prepare(Form::Stop, &[record], &[Beginning::default()]);
        let told = bench.noise[0].deviation;
        assert!(told < 0.9 * raw.deviation, "{told} of {raw:?}");
    }
    /// Noise that one record tells and another borrows is wrong in both by the same.
    #[test]
    fn noise_that_is_lent_is_told_no_better() {
        let mut bench = crate::diagnose::search::tests::dashpot(20261128);
        let told = bench.noise_error();
        let (noise, record) = (bench.noise[0], bench.train.records[0].clone());
        bench.noise.push(noise);
        bench.train.records.push(record);
        assert!((bench.noise_error() - told).abs() < 1e-12);
        // Two that know nothing of each other are better by √2.
        bench.noise[1].samples += 1;
        let both = bench.noise_error();
        assert!(
            (both * 2.0_f64.sqrt() / told - 1.0).abs() < 1e-3,
            "{both} {told}"
        );
    }
}
