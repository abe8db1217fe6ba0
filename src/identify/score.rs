//! The score test: what each effect, still vanishingly small, would take off the misfit when the
//! baseline is refitted with it. One pass of the dictionary serves a whole batch of effects.

use super::fit::Fit;
use super::nonnegative::Normal;
use super::problem::{Prediction, Problem};
use super::rows::Rows;
use super::slopes::{Slope, slopes};
use super::summed::Summed;
use super::weighing::Weighing;
use crate::joint::effect::Acting;
use rayon::prelude::*;

/// The score of one starting shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Score {
    /// The effect at its estimated first-order size, inside its bounds.
    pub acting: Acting,
    /// Fall of the whitened sum of squares, to first order; zero where the size that fits lies
    /// outside the bounds.
    pub fall: f64,
}

/// Effects whose columns are held in memory at a time, and share one pass of the dictionary.
const BATCH: usize = 32;

/// The current model, with what every batch needs of it.
struct Current<'a> {
    fit: &'a Fit,
    acting: Vec<Acting>,
    at: Vec<Prediction>,
    slopes: Vec<Slope>,
}

/// Scores every starting shape against the current model.
pub fn scores(problem: &Problem, current: &Fit, starts: &[Acting]) -> Vec<Score> {
    let acting = current.acting();
    let at = problem.predict(&current.coefficients, &acting);
    let current = Current {
        fit: current,
        slopes: slopes(problem, &current.coefficients, &acting, &at),
        acting,
        at,
    };
    let batches = starts.par_chunks(BATCH);
    batches
        .flat_map_iter(|batch| score_batch(problem, &current, batch))
        .collect()
}

fn score_batch(problem: &Problem, current: &Current, batch: &[Acting]) -> Vec<Score> {
    let Current {
        fit,
        acting,
        at,
        slopes,
    } = current;
    let records = problem.records.len();
    let columns = problem.operators.columns();
    let held: usize = acting.iter().map(|a| a.values.len()).sum();
    let size = columns + records + held;
    let extras: Vec<Vec<Vec<f64>>> = batch
        .iter()
        .map(|tried| {
            let mut effects = acting.clone();
            effects.push(tried.clone());
            problem.gained((&fit.coefficients, at), &effects, tried)
        })
        .collect();
    let all = size + batch.len();
    let parts: Vec<Normal> = (0..records)
        .into_par_iter()
        .map(|k| {
            let (_, measured) = problem.channels(k);
            let mut weighing = Weighing::new(&problem.records[k], all + 1);
            let mut row = vec![0.0; all + 1];
            let mut rows = Rows::default();
            let mut summed = Summed::new(all);
            let model = (&fit.coefficients[..], &acting[..], &at[k]);
            problem.pass_again(k, model, |i, march, step| {
                rows.next(march, step, &mut row[..columns]);
                let Some(i) = i else { return };
                row[columns + k] = 1.0;
                for (value, slope) in row[columns + records..size].iter_mut().zip(slopes) {
                    *value = slope.values[k][i];
                }
                for (value, extra) in row[size..].iter_mut().zip(&extras) {
                    *value = extra[k][i];
                }
                row[all] = measured[i] - at[k].judged[i] - fit.offsets[k];
                if let Some(white) = weighing.weigh(i, &row) {
                    summed.add(white);
                }
            });
            summed.finish()
        })
        .collect();
    let mut together = Normal::new(all);
    parts.iter().for_each(|part| together.merge(part));
    together.mirror();
    let common = together.leading(size);
    let tried = |b: usize| {
        let i = size + b;
        let line = &together.gram[i * all..(i + 1) * all];
        (&line[..size], (line[i], together.right[i]))
    };
    // Unknowns are moves away from the current fit, where the gradient over its positive
    // coefficients vanishes: only those may move freely, the others stay at zero.
    let free: Vec<usize> = (0..size)
        .filter(|&i| i >= columns || fit.coefficients[i] > 0.0)
        .filter(|&i| common.gram[i * size + i] > 0.0)
        .collect();
    let factor = common.factor(&free);
    batch
        .iter()
        .enumerate()
        .map(|(b, acting)| {
            let (cross, own) = tried(b);
            one(acting, factor.project(cross, &common.right), own)
        })
        .collect()
}

/// The score of a shape of which the current model's unknowns explain so much, of its square `own.0` and of its product
/// with the target `own.1`.
fn one(acting: &Acting, explained: Option<(f64, f64)>, own: (f64, f64)) -> Score {
    let nothing = Score {
        acting: acting.clone(),
        fall: 0.0,
    };
    if own.0 <= 0.0 {
        return nothing;
    }
    let Some((explained, along)) = explained else {
        return nothing;
    };
    let norm = own.0 - explained;
    if norm <= 1e-9 * own.0 {
        return nothing;
    }
    let product = own.1 - along;
    let size = product / norm;
    let mut scaled = acting.clone();
    for (value, parameter) in scaled.values.iter_mut().zip(acting.effect.parameters()) {
        // Of two forms of a law the one that is not tried stays at nothing.
        if let Some(zero) = parameter.vanishes_at.filter(|zero| zero != value) {
            let wanted = zero + size * (*value - zero);
            // A mass is begun no smaller than its start.
            let least = acting.effect.inertia(&acting.values);
            let wanted = least.map_or(wanted, |mass| wanted.max(mass));
            *value = wanted.clamp(parameter.lower, parameter.upper);
            if *value == zero {
                return nothing;
            }
        }
    }
    Score {
        acting: scaled,
        fall: product * product / norm,
    }
}
