//! The model linearised at a fit: its normal equations, and how far what a linear combination of the
//! unknowns owes to the samples scatters.

use super::fit::{bounded, normal};
use super::nonnegative::Normal;
use super::problem::{Prediction, Problem};
use super::rows::each_row;
use super::slopes::{Slope, slopes};
use crate::joint::effect::Acting;

/// Counts of equal stretches the samples are cut into.
///
/// A misfit of the law repeats over a cycle or lasts for a block of them; which, nobody knows.
/// Fewer stretches would leave too few to estimate a variance from, more are shorter than a cycle.
const STRETCHES: [usize; 4] = [12, 24, 48, 96];

/// Stretches that an interval's factor is taken from: `Student(STRETCHES_OF_FACTOR − 1)`.
pub const STRETCHES_OF_FACTOR: usize = 24;

/// Share of the noise's variance below which no law is claimed to be right: a tenth of its rms, to
/// which the grid of thresholds is made.
pub const RIGHT_TO: f64 = 0.01;

/// One Gauss–Newton step from a fit. Unknowns are the coefficients of the dictionary, the offsets
/// of the records, and the moves of the effects' values in units of their differences' steps.
pub struct Linearised<'a> {
    problem: &'a Problem,
    coefficients: &'a [f64],
    effects: &'a [Acting],
    at: Vec<Prediction>,
    /// What a small change of each effect's value does to the prediction.
    pub(super) slopes: Vec<Slope>,
    /// Normal equations of all unknowns.
    pub(super) normal: Normal,
    /// Their solution.
    pub(super) solution: Vec<f64>,
    /// Its misfit.
    pub(super) misfit: f64,
}

/// What one linear combination of the unknowns owes to the samples.
pub struct Influence {
    column: Vec<f64>,
    /// Its variance in white noise of the size that the weights were made for.
    pub variance: f64,
}

impl Influence {
    /// How far an unknown goes along with the combination.
    pub(super) fn of(&self, unknown: usize) -> f64 {
        self.column[unknown]
    }
}

impl<'a> Linearised<'a> {
    /// At the given coefficients and effects.
    pub fn new(problem: &'a Problem, coefficients: &'a [f64], effects: &'a [Acting]) -> Self {
        let at = problem.predict(coefficients, effects);
        let slopes = slopes(problem, coefficients, effects, &at);
        let mut step = Linearised {
            problem,
            coefficients,
            effects,
            normal: normal(problem, coefficients, effects, &at, &slopes),
            at,
            slopes,
            solution: Vec::new(),
            misfit: 0.0,
        };
        step.solution = step.normal.solve(&step.bounded());
        step.misfit = step.normal.misfit(&step.solution);
        step
    }

    /// Which unknowns may not be negative.
    pub(super) fn bounded(&self) -> Vec<bool> {
        bounded(self.problem, &self.normal)
    }

    /// Place of the first slope among the unknowns.
    pub(super) fn first(&self) -> usize {
        self.normal.size - self.slopes.len()
    }

    /// The influence of one unknown.
    pub(super) fn influence_of(&self, unknown: usize) -> Influence {
        let mut direction = vec![0.0; self.normal.size];
        direction[unknown] = 1.0;
        self.influence(&direction)
    }

    /// Takes an unknown for known.
    pub(super) fn hold(&mut self, unknown: usize) {
        self.normal.hold(unknown);
        self.solution = self.normal.solve(&self.bounded());
        self.misfit = self.normal.misfit(&self.solution);
    }

    /// The influence of a direction among the unknowns, those at their bounds staying there.
    pub(super) fn influence(&self, direction: &[f64]) -> Influence {
        let mut members = self.normal.clone();
        let at_bound = self.bounded().into_iter().zip(&self.solution);
        let held = at_bound.map(|(bounded, &value)| bounded && value <= 0.0);
        held.enumerate()
            .filter(|(_, held)| *held)
            .for_each(|(i, _)| members.hold(i));
        for (i, right) in members.right.iter_mut().enumerate() {
            let free = members.gram[i * members.size + i] > 0.0;
            *right = if free { direction[i] } else { 0.0 };
        }
        let column = members.solve(&vec![false; members.size]);
        let variance = column.iter().zip(direction).map(|(c, d)| c * d).sum();
        Influence { column, variance }
    }

    /// Every whitened row with its target; the first number counts the weighted samples.
    fn rows(&self, mut each: impl FnMut(usize, &[f64], f64)) {
        let model = (self.coefficients, self.effects);
        let mut seen = 0;
        for (k, at) in self.at.iter().enumerate() {
            each_row(self.problem, k, model, at, &self.slopes, |row| {
                if let Some((target, row)) = row.split_last() {
                    each(seen, row, *target);
                }
                seen += 1;
            });
        }
    }

    /// Variance of each combination over that of [`Influence::variance`], at least 1.
    ///
    /// The largest of 1, χ² per sample, and, for each cut of the samples into stretches b, the
    /// sandwich over the white variance, `Σ_b (Σ_{i∈b} g·x_i r_i)²/(aᵀA⁻¹a)` with `g = A⁻¹a` (Liang
    /// and Zeger's cluster-robust variance). What no residual shows is added: a misfit of a
    /// tenth of the noise that lasts for the shortest of the stretches.
    pub(super) fn inflation(&self, influences: &[Influence]) -> Vec<f64> {
        let rows = self.problem.rows().max(1);
        let finest = STRETCHES[STRETCHES.len() - 1];
        let mut scores = vec![vec![0.0; finest]; influences.len()];
        self.rows(|seen, row, target| {
            let fitted: f64 = row.iter().zip(&self.solution).map(|(x, s)| x * s).sum();
            let stretch = (seen * finest / rows).min(finest - 1);
            for (score, influence) in scores.iter_mut().zip(influences) {
                let weight: f64 = row.iter().zip(&influence.column).map(|(x, g)| x * g).sum();
                score[stretch] += weight * (target - fitted);
            }
        });
        let sandwich = |score: &[f64], count: usize| -> f64 {
            let stretches = score.chunks(finest / count);
            stretches.map(|s| s.iter().sum::<f64>().powi(2)).sum()
        };
        let lasting = lasting(self.problem, RIGHT_TO);
        let least = (self.misfit / rows as f64).max(1.0);
        scores
            .iter()
            .zip(influences)
            .map(|(score, influence)| {
                let cuts = STRETCHES.map(|count| sandwich(score, count) / influence.variance);
                cuts.into_iter().fold(least, f64::max) + lasting
            })
            .collect()
    }
}

/// Variance, over that of white noise, that a misfit of so large a share of the noise's variance
/// adds when it lasts for the shortest of the stretches. Correlated neighbours count as fewer samples.
pub fn lasting(problem: &Problem, share: f64) -> f64 {
    let samples = problem.independent_rows();
    share * samples / STRETCHES[STRETCHES.len() - 1] as f64
}
