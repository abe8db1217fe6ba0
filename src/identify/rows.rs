//! Rows of the dictionary along a pass, with what each carries on to later ones.

use super::inertia::Motion;
use super::march::{March, Step};
use super::problem::{Prediction, Problem};
use super::remembered::Remembered;
use super::slopes::Slope;
use super::weighing::Weighing;
use crate::joint::effect::Acting;

/// The rows of the last two steps, and what the operators remember.
#[derive(Debug, Clone, Default)]
pub struct Rows {
    before: [Vec<f64>; 2],
    /// Of the motion of a mass.
    motion: Vec<Motion>,
    remembered: Remembered,
    outputs: Vec<f64>,
}

impl Rows {
    /// Row at the end of the last step, `D_i = share Q_i + Σ_k carried_k D_{i−k}` with Q the operators' outputs and
    /// what they remember: d judged / d coefficient. Checked against differences of whole passes below.
    pub fn next(&mut self, march: &March, step: Step, row: &mut [f64]) {
        march.outputs(row);
        let feeds_back = march.feeds_back();
        if feeds_back {
            self.remembered.add(march, row);
            self.outputs.clear();
            self.outputs.extend_from_slice(row);
            let lagging = self.before.iter().zip(step.lagging);
            for (before, share) in lagging.filter(|(_, share)| *share != 0.0) {
                let both = self.outputs.iter_mut().zip(before);
                both.for_each(|(output, earlier)| *output += share * earlier);
            }
        }
        row.iter_mut().for_each(|value| *value *= step.share);
        if march.carries() {
            self.carry(march, step, row);
        }
        if feeds_back {
            self.remembered.end(step, &self.outputs, row);
        }
    }

    fn carry(&mut self, march: &March, step: Step, row: &mut [f64]) {
        for (before, share) in self.before.iter().zip(step.carried) {
            for (value, earlier) in row.iter_mut().zip(before) {
                *value += share * earlier;
            }
        }
        if march.hauls() {
            self.motion.resize(row.len(), Motion::default());
            for (value, motion) in row.iter_mut().zip(&mut self.motion) {
                let both = motion.iter().zip(step.hauled.by_motion);
                *value += both.map(|(m, share)| m * share).sum::<f64>();
                *motion = step.hauled.stride.end(*motion, *value);
            }
        }
        self.before.swap(0, 1);
        self.before[0].clear();
        self.before[0].extend_from_slice(row);
    }
}

/// Every whitened row of the model of record `k`, linearised, its target last: coefficients, an offset
/// per record beyond what it [stands off](Problem::stand_off) by, moves of the effects' values.
pub(super) fn each_row(
    problem: &Problem,
    k: usize,
    (coefficients, effects): (&[f64], &[Acting]),
    at: &Prediction,
    slopes: &[Slope],
    mut each: impl FnMut(&[f64]),
) {
    let columns = problem.operators.columns();
    let first = columns + problem.records.len();
    let size = first + slopes.len();
    let (_, measured) = problem.channels(k);
    let mut weighing = Weighing::new(&problem.records[k], size + 1);
    let mut row = vec![0.0; size + 1];
    let mut rows = Rows::default();
    let stand_off = problem.stand_off(k, at);
    problem.pass_again(k, (coefficients, effects, at), |i, march, step| {
        rows.next(march, step, &mut row[..columns]);
        let Some(i) = i else { return };
        row[columns + k] = 1.0;
        for (value, slope) in row[first..size].iter_mut().zip(slopes) {
            *value = slope.values[k][i];
        }
        let cells = row[1..columns].iter().zip(&coefficients[1..]);
        let linear = row[0] * march.elastic() + cells.map(|(x, c)| x * c).sum::<f64>();
        row[size] = measured[i] - at.judged[i] - stand_off + linear;
        if let Some(white) = weighing.weigh(i, &row) {
            each(white);
        }
    });
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::identify::Form;
    use crate::identify::inertia::tests::Mass;
    use crate::joint::effect::{Effect, Place, Response};
    use crate::joint::parameters::Parameter;
    use crate::record::Record;

    /// A dashpot, a spring and a cubic one beside the joint, a dashpot beside its slip, or a spring in its load path.
    pub(in crate::identify) struct Beside(pub Place);

    impl Effect for Beside {
        fn name(&self) -> &'static str {
            "beside"
        }
        fn place(&self) -> Place {
            self.0
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn beside_joint(&self, values: &[f64], displacement: f64, velocity: f64) -> Response {
            let square = displacement * displacement;
            Response {
                value: values[0] * velocity + (values[1] + values[2] * square) * displacement,
                slope: values[1] + 3.0 * values[2] * square,
                damping: values[0],
            }
        }
        fn beside_slip(&self, values: &[f64], (_, rate): (f64, f64), _memory: &[f64]) -> Response {
            Response {
                value: values[0] * rate,
                slope: 0.0,
                damping: values[0],
            }
        }
        fn spring(&self, values: &[f64], force: f64) -> Response {
            Response {
                value: values[0] * force,
                slope: values[0],
                damping: 0.0,
            }
        }
    }

    /// Beside a dashpot whose force is a third of the joint's, a spring that softens by a fifth of it, a mass, or with a
    /// spring in the load path, one that stiffens it included, sampled four hundred times a cycle, the rows are the derivatives of a joint that slips
    /// all the way; what a step answers at once alone is off by a good part of them.
    #[test]
    fn rows_of_a_joint_with_something_beside_it_are_derivatives_of_the_pass() {
        static BESIDE: Beside = Beside(Place::BesideJoint);
        static IN_PATH: Beside = Beside(Place::Spring);
        static BESIDE_SLIP: Beside = Beside(Place::BesideSlip);
        rows_are_derivatives(Form::Play, &[(&BESIDE, &[5e6, 0.0, 0.0])]);
        rows_are_derivatives(Form::Play, &[(&BESIDE, &[0.0, 0.0, -2e18])]);
        rows_are_derivatives(Form::Play, &[(&Mass, &[4e5])]);
        rows_are_derivatives(Form::Stop, &[(&IN_PATH, &[4e-9])]);
        rows_are_derivatives(Form::Stop, &[(&IN_PATH, &[-5e-10])]);
        rows_are_derivatives(Form::Play, &[(&BESIDE_SLIP, &[5e6]), (&IN_PATH, &[4e-9])]);
        rows_are_derivatives(Form::Stop, &[(&BESIDE_SLIP, &[5e6]), (&IN_PATH, &[4e-9])]);
    }

    fn rows_are_derivatives(form: Form, acting: &[(&'static dyn Effect, &[f64])]) {
        let time: Vec<f64> = (0..1200).map(|i| 0.0025 * f64::from(i)).collect();
        let wave = |largest: f64| -> Vec<f64> {
            let at = |t: &f64| largest * (0.7 + 0.1 * t) * (std::f64::consts::TAU * t).sin();
            time.iter().map(at).collect()
        };
        let record = Record {
            name: "sine".into(),
            displacement: wave(3e-6),
            force: wave(100.0),
            time: Some(time),
            ..Record::default()
        };
        let problem = Problem::new(form, &[record]);
        let columns = problem.operators.columns();
        let each = match form {
            Form::Play => 2e-10,
            Form::Stop => 5e6,
        };
        let mut coefficients = vec![each; columns];
        coefficients[0] = 40.0 * each;
        let effect = |&(effect, values): &(&'static dyn Effect, &[f64])| Acting {
            effect,
            values: values.to_vec(),
        };
        let effects: Vec<Acting> = acting.iter().map(effect).collect();
        let at = problem.predict(&coefficients, &effects);
        for column in [0, 5, 20] {
            let change = 1e-4 * coefficients[column];
            let mut moved = coefficients.clone();
            moved[column] += change;
            let other = problem.predict(&moved, &effects);
            let mut rows = Rows::default();
            let mut row = vec![0.0; columns];
            let (mut wrong, mut size, mut bare) = (0.0_f64, 0.0_f64, 0.0_f64);
            problem.pass(0, &coefficients, &effects, |i, march, step| {
                march.outputs(&mut row);
                let at_once = step.share * row[column];
                rows.next(march, step, &mut row);
                let Some(i) = i else { return };
                let difference = (other[0].judged[i] - at[0].judged[i]) / change;
                wrong = wrong.max((row[column] - difference).abs());
                bare = bare.max((at_once - difference).abs());
                size = size.max(difference.abs());
            });
            let what = format!("{form:?} {effects:?} {column}: {wrong}, {bare} of {size}");
            assert!(wrong < 0.002 * size, "{what}");
            assert!(bare > 0.05 * size, "{what}");
        }
    }
}
