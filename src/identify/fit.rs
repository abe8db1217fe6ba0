//! The joint refit: dictionary coefficients, offsets and effect parameters together, by
//! Gauss–Newton steps on the exact march with non-negative coefficients (variable projection after
//! Kaufman: the dictionary is linear, only effect parameters are stepped).

use super::nonnegative::Normal;
use super::problem::{Prediction, Problem, Weighing};
use crate::joint::effect::Acting;

/// A fitted model.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Elastic coefficient first, then one per threshold; all non-negative.
    pub coefficients: Vec<f64>,
    /// One offset of the judged channel per record.
    pub offsets: Vec<f64>,
    /// Effects with their fitted values.
    pub effects: Vec<Acting>,
    /// Whitened sum of squares over the weighted samples.
    pub misfit: f64,
    /// Standard errors of the effects' values in units of the noise, by effect; infinite where the
    /// data do not bound a value.
    pub errors: Vec<Vec<f64>>,
}

impl Fit {
    /// Predictions of every record, offsets included.
    pub fn predict(&self, problem: &Problem) -> Vec<Prediction> {
        let mut predictions = problem.predict(&self.coefficients, &self.effects);
        for (prediction, offset) in predictions.iter_mut().zip(&self.offsets) {
            prediction.judged.iter_mut().for_each(|y| *y += offset);
        }
        predictions
    }
}

/// Most Gauss–Newton steps of one refit.
const STEPS: usize = 10;

/// Relative fall of the misfit below which a refit ends.
const SETTLED: f64 = 1e-6;

/// The baseline: any Masing joint, no effect. Convex, so its minimum is the global one.
pub fn baseline(problem: &Problem) -> Fit {
    let zero = vec![0.0; problem.operators.columns()];
    let once = Steps {
        most: 1,
        ..Steps::full()
    };
    refine(problem, zero, Vec::new(), once)
}

/// Refits everything from the given start.
pub fn refit(problem: &Problem, start: &Fit, effects: Vec<Acting>) -> Fit {
    let steps = Steps::full();
    refine(problem, start.coefficients.clone(), effects, steps)
}

/// Refits as [`refit`] does, as long as there is a prospect of a misfit below `bound`.
pub fn refit_below(problem: &Problem, start: &Fit, effects: Vec<Acting>, bound: f64) -> Fit {
    let steps = Steps {
        bound,
        ..Steps::full()
    };
    refine(problem, start.coefficients.clone(), effects, steps)
}

/// When a refit ends.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Steps {
    most: usize,
    /// A refit that would need [`PROSPECT`] more steps like its last one to come below this misfit
    /// is given up.
    bound: f64,
}

/// Steps like the last one that a refit is credited with: Gauss–Newton steps shrink.
const PROSPECT: f64 = 4.0;

impl Steps {
    fn full() -> Steps {
        Steps {
            most: STEPS,
            bound: f64::INFINITY,
        }
    }
}

fn refine(
    problem: &Problem,
    mut coefficients: Vec<f64>,
    mut effects: Vec<Acting>,
    steps: Steps,
) -> Fit {
    let columns = problem.operators.columns();
    let predictions = problem.predict(&coefficients, &effects);
    let (mut misfit, mut offsets) = problem.misfit(&predictions);
    let mut errors: Vec<Vec<f64>> = effects
        .iter()
        .map(|a| vec![f64::INFINITY; a.values.len()])
        .collect();
    let mut predictions = predictions;
    for round in 0..steps.most {
        let slopes = slopes(problem, &coefficients, &effects, &predictions);
        let normal = normal(problem, &coefficients, &effects, &predictions, &slopes);
        let records = problem.records.len();
        let mut bounded = vec![true; normal.size];
        bounded[columns..].iter_mut().for_each(|b| *b = false);
        let solution = normal.solve(&bounded);
        errors = standard_errors(&normal, &solution, columns, records, &effects, &slopes);
        let moves = &solution[columns + records..];
        let mut accepted = false;
        let mut length = 1.0;
        for _ in 0..6 {
            let trial_coefficients: Vec<f64> = coefficients
                .iter()
                .zip(&solution)
                .map(|(from, to)| from + length * (to - from))
                .collect();
            let trial_effects = moved(&effects, &slopes, moves, length);
            let trial = problem.predict(&trial_coefficients, &trial_effects);
            let (trial_misfit, trial_offsets) = problem.misfit(&trial);
            if trial_misfit.is_finite() && (trial_misfit < misfit || round == 0 && steps.most == 1)
            {
                let fall = misfit - trial_misfit;
                accepted = fall > SETTLED * misfit && trial_misfit - PROSPECT * fall < steps.bound;
                coefficients = trial_coefficients;
                effects = trial_effects;
                predictions = trial;
                misfit = trial_misfit;
                offsets = trial_offsets;
                break;
            }
            length *= 0.4;
        }
        if !accepted {
            break;
        }
    }
    Fit {
        coefficients,
        offsets,
        effects,
        misfit,
        errors,
    }
}

/// One derivative column: effect, parameter, step of the difference, values per record.
pub(super) struct Slope {
    effect: usize,
    parameter: usize,
    unit: f64,
    pub(super) values: Vec<Vec<f64>>,
}

pub(super) fn slopes(
    problem: &Problem,
    coefficients: &[f64],
    effects: &[Acting],
    at: &[Prediction],
) -> Vec<Slope> {
    let mut slopes = Vec::new();
    for (e, acting) in effects.iter().enumerate() {
        for (p, parameter) in acting.effect.parameters().iter().enumerate() {
            let value = acting.values[p];
            let mut unit = 1e-4
                * value
                    .abs()
                    .max(1e-6 * (parameter.upper - parameter.lower).min(1.0));
            if value + unit > parameter.upper {
                unit = -unit;
            }
            let mut shifted = effects.to_vec();
            shifted[e].values[p] = value + unit;
            let values: Vec<Vec<f64>> = problem
                .predict(coefficients, &shifted)
                .iter()
                .zip(at)
                .map(|(a, b)| a.judged.iter().zip(&b.judged).map(|(x, y)| x - y).collect())
                .collect();
            if values.iter().flatten().any(|v| *v != 0.0) {
                slopes.push(Slope {
                    effect: e,
                    parameter: p,
                    unit,
                    values,
                });
            }
        }
    }
    slopes
}

/// Normal equations of the linearised model: coefficients, offsets, moves of the parameters.
fn normal(
    problem: &Problem,
    coefficients: &[f64],
    effects: &[Acting],
    at: &[Prediction],
    slopes: &[Slope],
) -> Normal {
    let columns = problem.operators.columns();
    let records = problem.records.len();
    let size = columns + records + slopes.len();
    let mut normal = Normal::new(size);
    for k in 0..records {
        let record = &problem.records[k];
        let (_, measured) = problem.channels(k);
        let mut weighing = Weighing::new(record, size + 1);
        let mut row = vec![0.0; size + 1];
        problem.pass(k, coefficients, effects, |i, march, step| {
            march.row(step, &mut row[..columns]);
            row[columns + k] = 1.0;
            for (value, slope) in row[columns + records..size].iter_mut().zip(slopes) {
                *value = slope.values[k][i];
            }
            let linear: f64 = row[..columns]
                .iter()
                .zip(coefficients)
                .map(|(x, c)| x * c)
                .sum();
            row[size] = measured[i] - at[k].judged[i] + linear;
            if let Some(white) = weighing.weigh(i, &row) {
                normal.add(&white[..size], white[size]);
            }
        });
    }
    normal.mirror();
    normal
}

/// Effects after a step along the moves, kept inside their bounds.
fn moved(effects: &[Acting], slopes: &[Slope], moves: &[f64], length: f64) -> Vec<Acting> {
    let mut moved = effects.to_vec();
    for (slope, step) in slopes.iter().zip(moves) {
        let parameter = &effects[slope.effect].effect.parameters()[slope.parameter];
        let value = &mut moved[slope.effect].values[slope.parameter];
        *value = (*value + length * step * slope.unit).clamp(parameter.lower, parameter.upper);
    }
    moved
}

fn standard_errors(
    normal: &Normal,
    solution: &[f64],
    columns: usize,
    records: usize,
    effects: &[Acting],
    slopes: &[Slope],
) -> Vec<Vec<f64>> {
    let members: Vec<usize> = (0..normal.size)
        .filter(|&i| i >= columns || solution[i] > 0.0)
        .collect();
    let variances = normal.variances(&members);
    let mut errors: Vec<Vec<f64>> = effects
        .iter()
        .map(|a| vec![f64::INFINITY; a.values.len()])
        .collect();
    for (k, slope) in slopes.iter().enumerate() {
        let place = members.iter().position(|&i| i == columns + records + k);
        if let Some(place) = place {
            errors[slope.effect][slope.parameter] =
                variances[place].max(0.0).sqrt() * slope.unit.abs();
        }
    }
    errors
}
