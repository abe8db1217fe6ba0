//! Rows of the dictionary along a pass, with what each carries on to later ones.

use super::inertia::Motion;
use super::march::{March, Step};
use super::problem::{Prediction, Problem};
use super::slopes::Slope;
use super::weighing::Weighing;
use crate::joint::effect::Acting;

/// The rows of the last two steps.
#[derive(Debug, Clone, Default)]
pub struct Rows {
    before: [Vec<f64>; 2],
    /// Of the motion of a mass.
    motion: Vec<Motion>,
}

impl Rows {
    /// Row at the end of the last step, `D_i = share P_i + Σ_k carried_k D_{i−k}` with P the operators'
    /// outputs: d judged / d coefficient, but for what a moved input does to the operators' memory.
    /// Checked against differences of whole passes below.
    pub fn next(&mut self, march: &March, step: Step, row: &mut [f64]) {
        march.row(step, row);
        if !march.carries() {
            return;
        }
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
/// per record, moves of the effects' values.
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
    problem.pass(k, coefficients, effects, |i, march, step| {
        rows.next(march, step, &mut row[..columns]);
        let Some(i) = i else { return };
        row[columns + k] = 1.0;
        for (value, slope) in row[first..size].iter_mut().zip(slopes) {
            *value = slope.values[k][i];
        }
        let linear: f64 = row[..columns]
            .iter()
            .zip(coefficients)
            .map(|(x, c)| x * c)
            .sum();
        row[size] = measured[i] - at.judged[i] + linear;
        if let Some(white) = weighing.weigh(i, &row) {
            each(white);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::Form;
    use crate::identify::inertia::tests::Mass;
    use crate::joint::effect::{Effect, Place, Response};
    use crate::joint::parameters::Parameter;
    use crate::record::Record;

    struct Dashpot;

    impl Effect for Dashpot {
        fn name(&self) -> &'static str {
            "dashpot"
        }
        fn place(&self) -> Place {
            Place::BesideJoint
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn beside_joint(&self, values: &[f64], _displacement: f64, velocity: f64) -> Response {
            Response {
                value: values[0] * velocity,
                slope: 0.0,
                damping: values[0],
            }
        }
    }

    /// With a dashpot whose force is a third of the joint's, or a mass, sampled four hundred times a cycle, the
    /// rows are the derivatives of the displacement; without what is carried on they are `off` by a good part of
    /// themselves. A mass rings on, so that the operators' memory takes more part beside it unless they slip less.
    #[test]
    fn rows_beside_a_dashpot_or_a_mass_are_derivatives_of_the_pass() {
        rows_are_derivatives((&Dashpot, 5e6), 1e-10, 0.5);
        rows_are_derivatives((&Mass, 4e5), 1e-11, 0.1);
    }

    fn rows_are_derivatives((effect, value): (&'static dyn Effect, f64), slip: f64, off: f64) {
        let time: Vec<f64> = (0..1200).map(|i| 0.0025 * f64::from(i)).collect();
        let force: Vec<f64> = time
            .iter()
            .map(|t| 100.0 * (std::f64::consts::TAU * t).sin())
            .collect();
        let record = Record {
            name: "sine".into(),
            displacement: vec![0.0; time.len()],
            time: Some(time),
            force,
            ..Record::default()
        };
        let problem = Problem::new(Form::Play, &[record]);
        let columns = problem.operators.columns();
        // Elastic but for a little slip, so that the operators' memory hardly takes part.
        let mut coefficients = vec![0.0; columns];
        (coefficients[0], coefficients[5], coefficients[20]) = (1e-8, slip, slip);
        let effects = [Acting {
            effect,
            values: vec![value],
        }];
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
                march.row(step, &mut row);
                let at_once = row[column];
                rows.next(march, step, &mut row);
                let Some(i) = i else { return };
                let difference = (other[0].judged[i] - at[0].judged[i]) / change;
                wrong = wrong.max((row[column] - difference).abs());
                bare = bare.max((at_once - difference).abs());
                size = size.max(difference.abs());
            });
            assert!(
                wrong < 0.02 * size,
                "{}, column {column}: {wrong} of {size}",
                effect.name()
            );
            assert!(
                bare > off * size,
                "{}, column {column}: {bare} of {size}",
                effect.name()
            );
        }
    }
}
