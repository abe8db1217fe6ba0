//! Passes through the records of a problem: by what drives each, as it was measured or without what the measuring chain
//! added to it.

use super::march::{Cells, March, Step, Wear};
use super::operators::Form;
use super::prepared::Prepared;
use super::problem::{Prediction, Problem};
use super::turns::{Resonance, Turns};
use super::undone::{corrected, true_input, true_turns};
use super::walk::walk;
use crate::joint::effect::{Acting, Place, Trajectory};
use crate::record::peaks::Between;
use rayon::prelude::*;

impl Problem {
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
        let model = (coefficients, effects, Cells::All);
        let (prediction, _) = self.marched(k, model, &self.wear_before(k, model), each);
        prediction
    }

    /// The final pass of [`Problem::pass`] alone, by what drove the march that predicted record `k` with the same model.
    pub(super) fn pass_again(
        &self,
        k: usize,
        (coefficients, effects, at): (&[f64], &[Acting], &Prediction),
        each: impl FnMut(Option<usize>, &March, Step),
    ) {
        let model = (coefficients, effects, Cells::All);
        let Some(driven) = &at.driven else {
            self.pass(k, coefficients, effects, each);
            return;
        };
        let before = (&self.wear_before(k, model), &self.turned(k, effects)[..]);
        self.driven(k, model, before, driven, each);
    }

    /// True where an effect of a record depends on what the records before it were.
    fn follows_records(&self, effects: &[Acting]) -> bool {
        let goes_on = self.records.iter().any(|r| r.beginning.goes_on);
        let limits = |a: &Acting| goes_on && a.acts_at(Place::SlipLimit);
        let lasts = |a: &Acting| a.effect.wears();
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
        model: (&[f64], &[Acting], Cells),
        wear: &Wear,
        mut each: impl FnMut(Option<usize>, &March, Step),
    ) -> (Prediction, Wear) {
        let record = &self.records[k];
        let form = self.operators.form;
        let (in_turns, correcting) = self.correcting(model.1);
        let mut truth = Trajectory {
            time: record.time.clone(),
            force: record.force.clone(),
            displacement: record.displacement.clone(),
            begins: self.records[..k].iter().map(Prepared::length).sum(),
            test: k,
            kinks: Vec::new(),
        };
        let mut driven = true_input((form, record), model.1, &correcting, &mut truth);
        if form == Form::Stop {
            truth.kinks.clone_from(&driven.1.kinks);
        }
        let turned = self.turned(k, model.1);
        let mut turns = Turns::new(if in_turns.is_empty() { 1 } else { self.turns });
        let as_read = (!turns.end()).then(|| driven.clone());
        let worn = loop {
            let worn = self.driven(k, model, (wear, &turned), &driven, |i, march, step| {
                if let Some(i) = i {
                    truth.force[i] = step.force;
                    truth.displacement[i] = step.displacement;
                }
                if turns.end() {
                    each(i, march, step);
                }
            });
            let (false, Some((read, found))) = (turns.end(), &as_read) else {
                break worn;
            };
            let mut added = vec![0.0; record.time.len()];
            for acting in &in_turns {
                let one = acting.effect.in_turns(&acting.values, &truth);
                added.iter_mut().zip(&one).for_each(|(sum, a)| *sum += a);
            }
            let masses = in_turns.iter().filter_map(|a| a.effect.driven(&a.values));
            let resonance = Resonance::of(masses.sum(), &truth);
            let correction = turns.take(&added, resonance);
            driven = corrected(&record.time, (read, found), correction);
        };
        let prediction = Prediction {
            judged: self.judged(&truth, model.1),
            truth,
            driven: Some(driven),
        };
        (prediction, worn)
    }

    /// The effects by which the measured input is corrected: in turns, by what the march gives, and those at once.
    fn correcting(&self, effects: &[Acting]) -> (Vec<Acting>, Vec<Acting>) {
        let place = self.operators.form.input_place();
        let corrects = |a: &&Acting| a.acts_at(place) && !self.is_marched(a);
        let correcting = effects.iter().filter(corrects).cloned();
        correcting.partition(|a| a.effect.follows_motion())
    }

    /// Readings at which the load turned before record `k`, as the joint had them.
    fn turned(&self, k: usize, effects: &[Acting]) -> Vec<f64> {
        let (_, correcting) = self.correcting(effects);
        let readings = &self.records[k].beginning.turned;
        true_turns(self.operators.form, readings, &correcting)
    }

    /// One march through record `k` by what drives it, from what was before; the joint as worn as that leaves it.
    fn driven(
        &self,
        k: usize,
        (coefficients, effects, cells): (&[f64], &[Acting], Cells),
        (wear, turned): (&Wear, &[f64]),
        (input, between): &(Vec<f64>, Between),
        each: impl FnMut(Option<usize>, &March, Step),
    ) -> Wear {
        let (record, operators) = (&self.records[k], &self.operators);
        let goes_on = record.beginning.goes_on;
        let new = Wear::default();
        let wear = if self.is_made_anew(k) { &new } else { wear };
        let cells = (cells, self.hauling);
        let mut march = March::new(operators, coefficients, effects, cells).worn(wear, goes_on);
        walk(record, (turned, input, between), &mut march, each);
        march.wear()
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::rows::tests::Beside;
    use crate::identify::{Fit, baseline, suited};
    use crate::joint::effect::{Effect, Situation, SlipLimit};
    use crate::joint::parameters::Parameter;
    use crate::record::Record;

    fn driven_by_a_sine(samples: u32) -> Record {
        let force: Vec<f64> = (0..samples).map(|i| (0.1 * f64::from(i)).sin()).collect();
        Record {
            displacement: vec![0.0; force.len()],
            force,
            ..Record::default()
        }
    }

    /// The largest difference of two channels.
    fn differ(one: &[f64], other: &[f64]) -> f64 {
        let both = one.iter().zip(other);
        both.fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()))
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
        let record = driven_by_a_sine(150);
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
        let record = driven_by_a_sine(200);
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

    /// Of stops a fit whose effects reached some cells holds stiffness there, and what was measured may be all the same: a
    /// model without the effects, and a fit from there, lose none of it.
    #[test]
    fn stops_that_nothing_reaches_are_elastic() {
        let Record {
            force: displacement,
            ..
        } = driven_by_a_sine(200);
        let force = displacement.iter().map(|u| 3.0 * u).collect();
        let record = Record {
            force,
            displacement,
            ..Record::default()
        };
        let problem = Problem::new(Form::Stop, &[record]);
        let cells = problem.operators.edges.len();
        let mut beyond = vec![0.0; problem.operators.columns()];
        (beyond[0], beyond[1 + cells]) = (1.0, 2.0);
        let (_, measured) = problem.channels(0);
        let predicted = &problem.predict(&beyond, &[])[0].judged;
        assert!(differ(predicted, measured) < 1e-12);
        let fit = Fit {
            coefficients: beyond,
            ..baseline(&problem)
        };
        let suited = suited(&problem, &fit, Vec::new());
        let stiffness: f64 = suited.coefficients.iter().sum();
        assert!((stiffness - 3.0).abs() < 1e-6, "{stiffness}");
    }

    /// What follows the motion needs the repeated pass, what follows the force alone does not.
    #[test]
    fn what_a_load_cell_adds_is_taken_off_the_force_that_drives() {
        let record = driven_by_a_sine(200);
        let force = record.force.clone();
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

    /// Its last turn, that is, and nothing of the measured input.
    #[test]
    fn a_pass_again_is_driven_by_what_the_prediction_was() {
        let record = driven_by_a_sine(200);
        let problem = Problem::new(Form::Play, &[record]);
        let mut coefficients = vec![0.0; problem.operators.columns()];
        (coefficients[0], coefficients[30]) = (2.0, 3.0);
        let effects = [Acting {
            effect: &Gain { motion: true },
            values: vec![0.1],
        }];
        let mut at = problem.predict(&coefficients, &effects).remove(0);
        let again = |at: &Prediction| {
            let mut displacement = Vec::new();
            let model = (&coefficients[..], &effects[..], at);
            problem.pass_again(0, model, |i, _, step| {
                displacement.extend(i.map(|_| step.displacement));
            });
            displacement
        };
        assert!(differ(&again(&at), &at.truth.displacement) < 1e-12);
        if let Some((input, between)) = &mut at.driven {
            input.iter_mut().for_each(|force| *force *= 0.5);
            between.peaks.clear();
        }
        assert!(differ(&again(&at), &at.truth.displacement) > 0.5);
        at.driven = None;
        assert!(differ(&again(&at), &at.truth.displacement) < 1e-12);
    }
}
