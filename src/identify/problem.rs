//! All records of one joint on one common grid: what a model predicts of them, and what it leaves.

use super::beginning::Beginning;
use super::march::{Cells, March, Step, Wear, added};
use super::operators::{Form, Operators};
use super::prepared::Prepared;
use super::turns::{Resonance, Turns};
use super::undone::{corrected, true_input, true_turns};
use super::walk::walk;
use super::weighing::whiten;
use crate::joint::effect::{Acting, Place, Trajectory};
use crate::record::Record;
use crate::record::noise::independence;
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

    /// Marches through record `k`; `each` sees every accepted step of the final pass, `None` at the
    /// peaks between samples.
    ///
    /// An effect on the input's own channel needs the truth to be corrected. What a sensor does to the
    /// displacement follows from that alone, see [`true_input`]; a mass that the load cell reads is marched with the
    /// joint; for what else it adds the pass is repeated from the truth of the one before it: the correction is
    /// small against the input and the repetition contracts.
    pub fn pass(
        &self,
        k: usize,
        coefficients: &[f64],
        effects: &[Acting],
        each: impl FnMut(Option<usize>, &March, Step),
    ) -> Prediction {
        let wear = self.wear_before(k, (coefficients, effects, Cells::All));
        let (prediction, _) = self.marched(k, (coefficients, effects, Cells::All), &wear, each);
        prediction
    }

    /// True where an effect of a record depends on what the records before it were.
    fn follows_records(&self, effects: &[Acting]) -> bool {
        let goes_on = self.records.iter().any(|r| r.beginning.goes_on);
        let limits = |a: &Acting| goes_on && a.acts_at(Place::SlipLimit);
        let lasts = |a: &Acting| a.effect.lasting() > 0;
        self.wears_on && effects.iter().any(|a| lasts(a) || limits(a))
    }

    /// True for a record of a joint that was made for it, where others go on.
    fn is_made_anew(&self, k: usize) -> bool {
        let on = |record: &Prepared| record.beginning.goes_on;
        self.records.iter().any(on) && !on(&self.records[k])
    }

    fn wear_before(&self, k: usize, model: (&[f64], &[Acting], Cells)) -> Wear {
        let before = match self.follows_records(model.1) {
            true => 0..k,
            false => 0..0,
        };
        before.fold(Wear::default(), |wear, earlier| {
            self.marched(earlier, model, &wear, |_, _, _| {}).1
        })
    }

    fn marched(
        &self,
        k: usize,
        (coefficients, effects, cells): (&[f64], &[Acting], Cells),
        wear: &Wear,
        mut each: impl FnMut(Option<usize>, &March, Step),
    ) -> (Prediction, Wear) {
        let record = &self.records[k];
        let new = Wear::default();
        let wear = if self.is_made_anew(k) { &new } else { wear };
        let input_place = self.operators.form.input_place();
        let corrects = |a: &&Acting| a.acts_at(input_place) && !self.is_marched(a);
        let (in_turns, correcting): (Vec<Acting>, Vec<Acting>) = effects
            .iter()
            .filter(corrects)
            .cloned()
            .partition(|a| a.effect.follows_motion());
        let mut truth = Trajectory {
            time: record.time.clone(),
            force: record.force.clone(),
            displacement: record.displacement.clone(),
            begins: self.records[..k].iter().map(Prepared::length).sum(),
            test: k,
        };
        let (mut input, mut between) = true_input(
            (self.operators.form, record),
            effects,
            &correcting,
            &mut truth,
        );
        let turned = true_turns(self.operators.form, &record.beginning.turned, &correcting);
        let mut worn;
        let mut turns = Turns::new(if in_turns.is_empty() { 1 } else { self.turns });
        let as_read = (!turns.end()).then(|| (input.clone(), between.clone()));
        loop {
            let mut march = March::new(
                &self.operators,
                coefficients,
                effects,
                (cells, self.hauling),
            )
            .worn(wear, record.beginning.goes_on);
            walk(
                record,
                (&turned, &input, &between),
                &mut march,
                |i, march, step| {
                    if let Some(i) = i {
                        truth.force[i] = step.force;
                        truth.displacement[i] = step.displacement;
                    }
                    if turns.end() {
                        each(i, march, step);
                    }
                },
            );
            worn = march.wear();
            let (false, Some((read, found))) = (turns.end(), &as_read) else {
                break;
            };
            let mut added = vec![0.0; record.time.len()];
            for acting in &in_turns {
                let one = acting.effect.in_turns(&acting.values, &truth);
                added.iter_mut().zip(&one).for_each(|(sum, a)| *sum += a);
            }
            let masses = in_turns.iter().filter_map(|a| a.effect.driven(&a.values));
            let resonance = Resonance::of(masses.sum(), &truth);
            let correction = turns.take(&added, resonance);
            (input, between) = corrected(&record.time, (read, found), correction);
        }
        let judged = self.judged(&truth, effects);
        (Prediction { judged, truth }, worn)
    }

    /// Predictions of every record.
    pub fn predict(&self, coefficients: &[f64], effects: &[Acting]) -> Vec<Prediction> {
        let model = (coefficients, effects, Cells::Weighted);
        let march = |k: usize, wear: &Wear| self.marched(k, model, wear, |_, _, _| {});
        let records = 0..self.records.len();
        if self.follows_records(effects) {
            let next = |wear: &mut Wear, k: usize| {
                let (prediction, worn) = march(k, wear);
                *wear = worn;
                Some(prediction)
            };
            return records.scan(Wear::default(), next).collect();
        }
        let each = records.into_par_iter();
        each.map(|k| march(k, &Wear::default()).0).collect()
    }

    /// True for what the measuring chain does that the march takes along where force drives: a mass moves with the
    /// joint, and of a displacement that comes late the force is read as late.
    fn is_marched(&self, acting: &Acting) -> bool {
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
    fn judged(&self, truth: &Trajectory, effects: &[Acting]) -> Vec<f64> {
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
            let mut before = None;
            let stand_off = self.stand_off(k, prediction);
            for ((&y, &p), &w) in measured.iter().zip(&prediction.judged).zip(&record.weight) {
                let residual = y - p - stand_off;
                let (z, one) = whiten(record.autoregression, residual, before);
                before = (w > 0.0).then_some(residual);
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
    /// `n (1 − a)/(1 + a)`.
    pub fn independent_rows(&self) -> f64 {
        let of = |r: &Prepared| {
            let rows = r.weight.iter().filter(|w| **w > 0.0).count() as f64;
            rows * independence(r.autoregression)
        };
        self.records.iter().map(of).sum()
    }

    /// Count of samples with weight.
    pub fn rows(&self) -> usize {
        self.records.iter().map(Prepared::rows).sum()
    }
}

/// Parts of a step in which a mass is looked for: in whole steps it answers too early what shows in single samples.
const HAULING: u32 = 2;

/// Passes through a record whose input is corrected by what the march gives, in which a cause is looked for.
const TURNS: usize = 3;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::rows::tests::Beside;
    use crate::joint::effect::{Effect, Situation, SlipLimit};
    use crate::joint::parameters::Parameter;

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

    /// A load cell that reads too much; by what its law says it follows.
    struct Gain {
        motion: bool,
    }

    impl Effect for Gain {
        fn name(&self) -> &'static str {
            "gain"
        }
        fn place(&self) -> Place {
            Place::ForceChannel
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn follows_motion(&self) -> bool {
            self.motion
        }
        fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
            truth.force.iter().map(|force| values[0] * force).collect()
        }
    }

    /// Limits that fall with time, by as much as if some had passed before.
    struct Wearing;

    impl Effect for Wearing {
        fn name(&self) -> &'static str {
            "wearing"
        }
        fn place(&self) -> Place {
            Place::SlipLimit
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn memory(&self) -> usize {
            1
        }
        fn lasting(&self) -> usize {
            1
        }
        fn remember(&self, _values: &[f64], now: &Situation, memory: &mut [f64]) {
            memory[0] += now.step;
        }
        fn slip_limit(&self, values: &[f64], _last: &Situation, memory: &[f64]) -> SlipLimit {
            let limit = 1.0 - 1e-3 * (values[0] + memory[0]);
            SlipLimit::either_way(limit)
        }
    }

    #[test]
    fn a_record_begins_as_worn_as_those_before_it_left_the_joint() {
        let force: Vec<f64> = (0..150).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let record = Record {
            name: "worn".to_string(),
            displacement: vec![0.0; force.len()],
            force,
            ..Record::default()
        };
        let mut problem = Problem::new(Form::Play, &[record.clone(), record.clone(), record]);
        let mut coefficients = vec![0.0; problem.operators.columns()];
        (coefficients[0], coefficients[20], coefficients[30]) = (1.0, 2.0, 3.0);
        let from = |passed: f64| {
            [Acting {
                effect: &Wearing,
                values: vec![passed],
            }]
        };
        let made_new = |k: usize, passed: f64| {
            let all = problem.predict(&coefficients, &from(passed));
            all[k].judged.clone()
        };
        let expected = [made_new(0, 0.0), made_new(1, 149.0), made_new(2, 298.0)];
        let differ = |one: &[f64], other: &[f64]| {
            let both = one.iter().zip(other);
            both.fold(0.0_f64, |most, (x, y)| most.max((x - y).abs()))
        };
        assert!(differ(&expected[1], &expected[0]) > 0.1);
        problem.wears_on = true;
        let predicted = problem.predict(&coefficients, &from(0.0));
        for (k, (predicted, expected)) in predicted.iter().zip(&expected).enumerate() {
            assert!(differ(&predicted.judged, expected) < 1e-12, "{k}");
            let passed = problem.pass(k, &coefficients, &from(0.0), |_, _, _| {});
            assert!(differ(&passed.judged, expected) < 1e-12, "{k}");
        }
    }

    #[test]
    fn beside_a_spring_that_softens_the_network_carries_more_than_the_force() {
        let force: Vec<f64> = (0..200).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let record = Record {
            name: "softening".to_string(),
            displacement: vec![0.0; force.len()],
            force,
            ..Record::default()
        };
        static BESIDE: Beside = Beside(Place::BesideJoint);
        let problem = Problem::new(Form::Play, &[record]);
        let cells = problem.operators.edges.len();
        let largest = |softer: f64, beyond: f64| {
            let mut coefficients = vec![0.0; problem.operators.columns()];
            (coefficients[0], coefficients[1 + cells]) = (1.0, beyond);
            let softening = Acting {
                effect: &BESIDE,
                values: vec![0.0, -softer, 0.0],
            };
            let predicted = &problem.predict(&coefficients, &[softening])[0];
            let judged = predicted.judged.iter();
            judged.fold(0.0_f64, |most, u| most.max(u.abs()))
        };
        // The first cell beyond the range of the force has its thresholds from 1.015 to 1.105 of it.
        assert_eq!(largest(0.0, 1.0), largest(0.0, 0.0));
        let (held, slipped) = (largest(0.1, 0.0), largest(0.1, 1.0));
        assert!((held - 1.0 / 0.9).abs() < 1e-3, "{held}");
        // Of the four the mean plays: 1.11 less 1.06 where all of them slip, and what that softens.
        assert!(slipped - held > 0.05, "{held}, {slipped}");
    }

    /// What follows the motion needs the repeated pass, what follows the force alone does not.
    #[test]
    fn what_a_load_cell_adds_is_taken_off_the_force_that_drives() {
        let force: Vec<f64> = (0..200).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let record = Record {
            name: "gain".to_string(),
            displacement: vec![0.0; force.len()],
            force: force.clone(),
            ..Record::default()
        };
        let problem = Problem::new(Form::Play, &[record]);
        let mut coefficients = vec![0.0; problem.operators.columns()];
        coefficients[0] = 2.0;
        // Each round leaves a tenth of what the one before did; a march is worth three of them.
        static ALONE: Gain = Gain { motion: false };
        static IN_TURNS: Gain = Gain { motion: true };
        for (effect, within) in [(&ALONE, 1e-7), (&IN_TURNS, 2.1e-3)] {
            let values = vec![0.1];
            let predicted = &problem.predict(&coefficients, &[Acting { effect, values }])[0];
            for (judged, force) in predicted.judged.iter().zip(&force) {
                assert!((judged - 2.0 * force / 1.1).abs() < within);
            }
        }
    }
}
