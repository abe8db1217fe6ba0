//! All records of one joint on one common grid: what a model predicts of them, and what it leaves.

use super::beginning::Beginning;
use super::march::added;
use super::operators::{Form, Operators};
use super::prepared::Prepared;
use crate::joint::effect::{Acting, Trajectory};
use crate::record::Record;
use crate::record::colour::White;
use crate::record::peaks::Between;
use rayon::prelude::*;

/// All records of one joint, judged in one form on one grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Form and thresholds.
    pub operators: Operators,
    /// The records.
    pub records: Vec<Prepared>,
    /// Parts of every step in which a mass moves with the joint.
    pub hauling: u32,
    /// Passes at most through a record whose input is corrected by what the march gives.
    pub turns: usize,
    /// True where the records are tests of a joint one after the other, which wears on from each to the next; false
    /// where it was made new between them.
    pub wears_on: bool,
}

/// Prediction of one record by one model, without the record's offset.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Prediction {
    /// Judged channel, measuring chain included.
    pub judged: Vec<f64>,
    /// True force and displacement behind it.
    pub truth: Trajectory,
    /// What drove the march: the true input, and what it did between samples; `None` where nothing was marched.
    pub driven: Option<(Vec<f64>, Between)>,
}

impl Prediction {
    /// Of a joint that answers nothing, the judged channel alone.
    pub(super) fn of_nothing(record: &Prepared) -> Prediction {
        Prediction {
            judged: vec![0.0; record.time.len()],
            ..Prediction::default()
        }
    }
}

impl Problem {
    /// Prepares records of virgin joints.
    pub fn new(form: Form, records: &[Record]) -> Problem {
        let virgin = vec![Beginning::default(); records.len()];
        Problem::begun(form, records, &virgin)
    }

    /// Prepares records with their beginnings.
    pub fn begun(form: Form, records: &[Record], beginnings: &[Beginning]) -> Problem {
        let both = records.iter().zip(beginnings);
        let prepared = both.map(|(record, beginning)| {
            let mut prepared = Prepared::new(record, form);
            prepared.begin(form, beginning);
            prepared
        });
        Problem::of(form, prepared.collect())
    }

    /// Records on a grid that covers the largest input of any of them.
    pub(super) fn of(form: Form, records: Vec<Prepared>) -> Problem {
        let range = records
            .iter()
            .flat_map(|p| p.channels(form).0)
            .fold(0.0_f64, |a, &b| a.max(b.abs()));
        Problem {
            operators: Operators::grid(form, range),
            records,
            hauling: HAULING,
            turns: TURNS,
            wears_on: false,
        }
    }

    /// Measured input and measured judged channel of record `k`.
    pub fn channels(&self, k: usize) -> (&[f64], &[f64]) {
        self.records[k].channels(self.operators.form)
    }

    /// True for what the measuring chain does that the march takes along where force drives: a mass moves with the
    /// joint, and of a displacement that comes late the force is read as late.
    pub(super) fn is_marched(&self, acting: &Acting) -> bool {
        let Acting { effect, values } = acting;
        let late = effect.lateness(values).is_some();
        self.hauls(acting) || self.operators.form == Form::Play && late
    }

    /// True where an effect is a mass that moves with the joint.
    pub fn hauls(&self, acting: &Acting) -> bool {
        let Acting { effect, values } = acting;
        self.operators.form == Form::Play && effect.inertia(values).is_some()
    }

    /// The judged channel as the measuring chain gives it.
    pub(super) fn judged(&self, truth: &Trajectory, effects: &[Acting]) -> Vec<f64> {
        let mut judged = match self.operators.form {
            Form::Play => truth.displacement.clone(),
            Form::Stop => truth.force.clone(),
        };
        let place = self.operators.form.judged_place();
        let adds = |a: &&Acting| a.acts_at(place) && !self.is_marched(a);
        let adding: Vec<Acting> = effects.iter().filter(adds).cloned().collect();
        if let Some(added) = added(&adding, place, truth) {
            judged.iter_mut().zip(&added).for_each(|(y, a)| *y += a);
        }
        judged
    }

    /// What the judged channels of `at` gain by other effects, of which the one `changed` alone differs; where that
    /// acts on the judged channel, the march is the same.
    pub fn gained(
        &self,
        (coefficients, at): (&[f64], &[Prediction]),
        effects: &[Acting],
        changed: &Acting,
    ) -> Vec<Vec<f64>> {
        let judged = self.operators.form.judged_place();
        let same = changed.places().all(|own| own == judged) && !self.is_marched(changed);
        let judged = match same {
            true => at
                .par_iter()
                .map(|p| self.judged(&p.truth, effects))
                .collect(),
            false => {
                let predictions = self.predict(coefficients, effects).into_iter();
                predictions.map(|p| p.judged).collect::<Vec<_>>()
            }
        };
        let pairs = judged.iter().zip(at);
        pairs
            .map(|(new, old)| new.iter().zip(&old.judged).map(|(x, y)| x - y).collect())
            .collect()
    }

    /// Measured less predicted at the first sample that counts: a sensor a millimetre off whose noise is a nanometre would
    /// take six of the digits of every square, so it is taken off before.
    pub(super) fn stand_off(&self, k: usize, prediction: &Prediction) -> f64 {
        let (_, measured) = self.channels(k);
        let mut counted = (0..measured.len()).filter(|&i| self.records[k].counts(i));
        let first = counted.next();
        first.map_or(0.0, |i| measured[i] - prediction.judged[i])
    }

    /// Whitened sum of squares of measured − predicted with each record's best offset, and those
    /// offsets.
    pub fn misfit(&self, predictions: &[Prediction]) -> (f64, Vec<f64>) {
        let mut total = 0.0;
        let mut offsets = Vec::with_capacity(predictions.len());
        for (k, prediction) in predictions.iter().enumerate() {
            let (_, measured) = self.channels(k);
            let record = &self.records[k];
            let (mut squares, mut product, mut norm) = (0.0, 0.0, 0.0);
            let mut whitening = record.colour.whitening();
            let (mut left, mut constant) = (White::default(), White::default());
            let mut anew = true;
            let stand_off = self.stand_off(k, prediction);
            for ((&y, &p), &w) in measured.iter().zip(&prediction.judged).zip(&record.weight) {
                let residual = y - p - stand_off;
                let step = whitening.step(anew);
                let (z, one) = (left.next(&step, residual), constant.next(&step, 1.0));
                anew = w <= 0.0;
                squares += (w * z).powi(2);
                product += w * w * z * one;
                norm += (w * one).powi(2);
            }
            let offset = if norm > 0.0 { product / norm } else { 0.0 };
            let left = squares - offset * product;
            // A prediction that is no number is the worst there is, never a perfect one.
            total += if left.is_finite() {
                left.max(0.0)
            } else {
                f64::INFINITY
            };
            offsets.push(stand_off + offset);
        }
        (total, offsets)
    }

    /// Samples with weight that count for a mean: correlated neighbours count as fewer,
    /// `n (1 − a)/(1 + a)` of first-order noise.
    pub fn independent_rows(&self) -> f64 {
        let of = |r: &Prepared| {
            let rows = r.weight.iter().filter(|w| **w > 0.0).count() as f64;
            rows * r.colour.independence()
        };
        self.records.iter().map(of).sum()
    }

    /// Count of samples with weight.
    pub fn rows(&self) -> usize {
        self.records.iter().map(Prepared::rows).sum()
    }
}

/// Parts of a step in which a mass is looked for: in whole steps it answers too early what shows in single samples.
pub const HAULING: u32 = 2;

/// Passes through a record whose input is corrected by what the march gives, in which a cause is looked for.
pub const TURNS: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;

    /// A sensor a billion times its noise away from zero leaves what it leaves at zero, and one offset takes that away.
    #[test]
    fn a_sensor_that_stands_off_takes_no_digits() {
        let mut noise = crate::record::noise::tests::drawn(20261127);
        let mut record = Record {
            name: "probe".to_string(),
            force: (0..1000).map(|i| (0.05 * f64::from(i)).sin()).collect(),
            time: Some((0..1000).map(|i| 0.01 * f64::from(i)).collect()),
            ..Record::default()
        };
        let answer = |f: &f64| 1e-7 * (f + 0.2 * f.powi(3)) + 1e-9 * noise();
        record.displacement = record.force.iter().map(answer).collect();
        let mut fits = [0.0, 1.0].map(|zero| {
            let mut off = record.clone();
            off.displacement.iter_mut().for_each(|u| *u += zero);
            let mut problem = Problem::new(Form::Play, &[off]);
            problem.records[0].weight.fill(1e9);
            let fit = crate::identify::baseline(&problem);
            (fit.misfit, fit.offsets[0])
        });
        fits.sort_by(|a, b| a.1.total_cmp(&b.1));
        let [near, far] = fits;
        assert!((far.0 / near.0 - 1.0).abs() < 1e-3, "{near:?} {far:?}");
        assert!((far.1 - near.1 - 1.0).abs() < 1e-10, "{near:?} {far:?}");
    }
}
