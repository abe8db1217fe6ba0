//! Shapes of causes as columns: what each would add to the judged channel, and how far its own
//! parameters could bend that.

use rayon::prelude::*;

use super::gram::Gram;
use crate::causes::{Cause, Scale};
use crate::identify::nonnegative::Normal;
use crate::identify::rows::Rows;
use crate::identify::summed::Summed;
use crate::identify::weighing::Weighing;
use crate::identify::{Prediction, Problem, size_of};
use crate::joint::effect::Acting;

/// One cause with one set of values.
#[derive(Debug, Clone)]
pub struct Shape {
    /// The cause.
    pub cause: &'static dyn Cause,
    /// The law and its values.
    pub acting: Acting,
    /// True where the values are fitted ones, not those at which a search starts.
    pub fitted: bool,
    /// First of its columns, counted over all shapes: the signature itself.
    pub first: usize,
    /// Count of its columns: the signature, and one for each further parameter.
    pub columns: usize,
}

impl Shape {
    /// Columns among those of all shapes, behind `before` columns of the dictionary, with marks
    /// for those that may not turn negative.
    pub fn members(&self, before: usize) -> Vec<(usize, bool)> {
        (0..self.columns)
            .map(|k| (before + self.first + k, k == 0 && self.one_sided()))
            .collect()
    }

    /// True where the size has one sign only.
    fn one_sided(&self) -> bool {
        let mut sizes = self.acting.effect.parameters().iter().filter_map(|p| {
            let zero = p.vanishes_at?;
            Some(zero == p.lower || zero == p.upper)
        });
        matches!((sizes.next(), sizes.next()), (Some(true), None))
    }

    /// Parameters that get a column of their own: all but the first that carries the size, and refinements
    /// that this shape lacks.
    fn bends(&self) -> Vec<usize> {
        let parameters = self.acting.effect.parameters();
        let values = &self.acting.values;
        let mut both = parameters.iter().zip(values);
        let size = both.position(|(p, value)| p.vanishes_at.is_some_and(|zero| zero != *value));
        (0..parameters.len())
            .filter(|&p| Some(p) != size && parameters[p].neutral != Some(values[p]))
            .collect()
    }

    /// The effect with parameter `p` moved by a tenth.
    fn bent(&self, p: usize) -> Acting {
        let parameter = &self.acting.effect.parameters()[p];
        let mut acting = self.acting.clone();
        let value = acting.values[p];
        let mut step = 0.1 * size_of(&acting, p);
        if value + step > parameter.upper {
            step = -step;
        }
        acting.values[p] = value + step;
        acting
    }
}

/// Every start of the given causes, and the fitted ones, numbered through.
pub fn shapes(
    causes: &[&'static dyn Cause],
    scale: &Scale,
    fitted: &[(&'static dyn Cause, Acting)],
) -> Vec<Shape> {
    let starts = causes.iter().flat_map(|&cause| {
        let values = cause.starts(scale).into_iter();
        values.map(move |values| {
            (
                cause,
                Acting {
                    effect: cause.effect(),
                    values,
                },
                false,
            )
        })
    });
    let known = fitted
        .iter()
        .map(|(cause, acting)| (*cause, acting.clone(), true));
    let mut first = 0;
    known
        .chain(starts)
        .map(|(cause, acting, fitted)| {
            let mut shape = Shape {
                cause,
                acting,
                fitted,
                first,
                columns: 1,
            };
            shape.columns += shape.bends().len();
            first += shape.columns;
            shape
        })
        .collect()
}

/// What the effect adds to the judged channel of every record. A signature that is no number is none: it
/// would spoil every product it enters.
pub fn signature(
    problem: &Problem,
    coefficients: &[f64],
    acting: &Acting,
    without: &[Prediction],
) -> Vec<Vec<f64>> {
    let effects = std::slice::from_ref(acting);
    let mut gained = problem.gained((coefficients, without), effects, acting);
    let spoilt = gained.iter_mut().flatten().filter(|x| !x.is_finite());
    spoilt.for_each(|x| *x = 0.0);
    gained
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Columns of all shapes: per column, per record.
pub fn columns(problem: &Problem, coefficients: &[f64], shapes: &[Shape]) -> Vec<Vec<Vec<f64>>> {
    let without = problem.predict(coefficients, &[]);
    shapes
        .par_iter()
        .flat_map_iter(|shape| {
            let own = signature(problem, coefficients, &shape.acting, &without);
            let bends: Vec<Vec<Vec<f64>>> = shape
                .bends()
                .into_iter()
                .map(|p| {
                    let bent = signature(problem, coefficients, &shape.bent(p), &without);
                    bent.iter()
                        .zip(&own)
                        .map(|(a, b)| difference(a, b))
                        .collect()
                })
                .collect();
            std::iter::once(own).chain(bends).collect::<Vec<_>>()
        })
        .collect()
}

/// Whitened products of the dictionary's and the shapes' columns.
pub fn products(problem: &Problem, coefficients: &[f64], extra: &[Vec<Vec<f64>>]) -> Gram {
    let columns = problem.operators.columns();
    let records = problem.records.len();
    let kept = columns + extra.len();
    let size = kept + records;
    let parts: Vec<Normal> = (0..records)
        .into_par_iter()
        .map(|k| {
            let mut summed = Summed::new(size);
            let mut weighing = Weighing::new(&problem.records[k], size + 1);
            let mut row = vec![0.0; size + 1];
            let mut rows = Rows::default();
            problem.pass(k, coefficients, &[], |i, march, step| {
                rows.next(march, step, &mut row[..columns]);
                let Some(i) = i else { return };
                let values = row[columns..kept].iter_mut().zip(extra);
                values.for_each(|(value, column)| *value = column[k][i]);
                row[kept + k] = 1.0;
                if let Some(white) = weighing.weigh(i, &row) {
                    summed.add(white);
                }
            });
            summed.finish()
        })
        .collect();
    let mut sum = Normal::new(size);
    parts.iter().for_each(|part| sum.merge(part));
    sum.mirror();
    Gram::without_offsets(&sum, kept)
}
