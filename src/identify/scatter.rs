//! How far fitted values of effects may be off: what noise, misfit that goes on for a while and the
//! grid of thresholds make of them.

use super::finer::finer;
use super::fit::{Fit, Slope, slopes};
use super::nonnegative::Normal;
use super::problem::{Prediction, Problem, Weighing};
use crate::joint::effect::Acting;

/// Scatter of the values of the effects of a fit, by effect and parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Scatter {
    /// Standard deviation; infinite where the data do not bound a value.
    pub deviations: Vec<Vec<f64>>,
    /// Variance over that of white noise of the given size, never below 1: misfit that neighbours
    /// share, and noise that is larger or slower than it was taken for.
    pub inflation: f64,
}

/// Counts of equal stretches the samples are cut into.
///
/// A misfit of the law repeats over a cycle or lasts for a block of them; which, nobody knows.
/// Fewer stretches would leave too few to estimate a variance from, more are shorter than a cycle.
const STRETCHES: [usize; 4] = [12, 24, 48, 96];

/// Share of the noise's variance below which no law is claimed to be right: a tenth of its rms, to
/// which the grid of thresholds is made.
const RIGHT_TO: f64 = 0.01;

/// Stretches that the interval's factor is taken from: `Student(STRETCHES_OF_FACTOR − 1)`.
pub const STRETCHES_OF_FACTOR: usize = 24;

/// Scatter of every value of the fit's effects.
///
/// The covariance is that of least squares at the fit, `A⁻¹` with the normal matrix A of all unknowns
/// that are off their bounds, times the largest of: 1; χ² per sample; and, for each cut of the
/// samples into stretches b, the sandwich over the white one, `Σ_b (Σ_{i∈b} g·x_i r_i)²/(gᵀAg)` with
/// `g = A⁻¹e`, rows `x_i` and residuals `r_i` in units of the noise (Liang and Zeger's
/// cluster-robust variance). What no residual shows is added: the variance of a misfit of a tenth of the
/// noise that lasts for the shortest of those stretches, and the square of the move that a grid of
/// half the spacing gives the value, to first order: the grid is nothing that the data chose.
///
/// Checked in the tests below and, over hundreds of drawn cases, by the scorecard's coverage.
pub fn scatter(problem: &Problem, fit: &Fit) -> Scatter {
    let unknown = || -> Vec<Vec<f64>> {
        let effects = fit.effects.iter();
        effects
            .map(|a| vec![f64::INFINITY; a.values.len()])
            .collect()
    };
    let mut scatter = Scatter {
        deviations: unknown(),
        inflation: 1.0,
    };
    if fit.effects.is_empty() {
        return scatter;
    }
    let (problem, coefficients) = finer(problem, &fit.coefficients);
    let step = Step::of(&problem, &coefficients, &fit.acting());
    let sums = step.sums(&problem);
    let lasting = RIGHT_TO * effective(&problem) / STRETCHES[STRETCHES.len() - 1] as f64;
    for (k, influence) in step.influences.iter().enumerate() {
        let Slope {
            effect,
            parameter,
            unit,
            ..
        } = step.derivatives[k];
        if effect >= fit.effects.len() {
            continue;
        }
        let white = influence.variance;
        let most = sums[k].iter().fold(1.0_f64, |most, s| most.max(s / white));
        let most = most.max(step.left / problem.rows().max(1) as f64);
        scatter.inflation = scatter.inflation.max(most);
        let square = white * (most + lasting) + step.moves[k].powi(2);
        if square.is_finite() && white > 0.0 {
            scatter.deviations[effect][parameter] = square.sqrt() * unit.abs();
        }
    }
    scatter
}

/// Count of independent samples: correlated neighbours count as fewer.
fn effective(problem: &Problem) -> f64 {
    let records = problem.records.iter();
    records
        .map(|r| {
            let rows = r.weight.iter().filter(|w| **w > 0.0).count() as f64;
            rows * (1.0 - r.autoregression) / (1.0 + r.autoregression)
        })
        .sum()
}

/// One Gauss–Newton step from a fit, with what each unknown owes to each sample.
struct Step {
    coefficients: Vec<f64>,
    effects: Vec<Acting>,
    /// Solution of the linearised problem.
    solution: Vec<f64>,
    /// Misfit of that solution.
    left: f64,
    /// Per derivative column: the move, in units of that step.
    moves: Vec<f64>,
    influences: Vec<Influence>,
    /// Prediction the step starts from, and its derivatives.
    at: Vec<Prediction>,
    derivatives: Vec<Slope>,
}

/// Column of `A⁻¹` that belongs to one unknown, and its own variance.
struct Influence {
    column: Vec<f64>,
    variance: f64,
}

impl Step {
    fn of(problem: &Problem, coefficients: &[f64], effects: &[Acting]) -> Step {
        let columns = problem.operators.columns();
        let first = columns + problem.records.len();
        let at = problem.predict(coefficients, effects);
        let mut step = Step {
            coefficients: coefficients.to_vec(),
            effects: effects.to_vec(),
            solution: Vec::new(),
            left: 0.0,
            moves: Vec::new(),
            influences: Vec::new(),
            derivatives: slopes(problem, coefficients, effects, &at),
            at,
        };
        let mut normal = None;
        step.rows(problem, |size, _, row, target| {
            let normal = normal.get_or_insert_with(|| Normal::new(size));
            normal.add(row, target);
        });
        let Some(mut normal) = normal else {
            return step;
        };
        normal.mirror();
        let mut bounded = vec![true; normal.size];
        bounded[columns..].iter_mut().for_each(|b| *b = false);
        step.solution = normal.solve(&bounded);
        step.left = normal.misfit(&step.solution);
        let free = vec![false; normal.size];
        let mut members = normal.clone();
        (0..columns)
            .filter(|&i| step.solution[i] <= 0.0)
            .for_each(|i| members.hold(i));
        for k in 0..step.derivatives.len() {
            step.moves.push(step.solution[first + k]);
            members.right = vec![0.0; members.size];
            members.right[first + k] = 1.0;
            let column = members.solve(&free);
            let variance = column[first + k];
            step.influences.push(Influence { column, variance });
        }
        step
    }

    /// Every whitened row with its target: count of unknowns, place among the weighted samples.
    fn rows(&self, problem: &Problem, mut each: impl FnMut(usize, usize, &[f64], f64)) {
        let columns = problem.operators.columns();
        let records = problem.records.len();
        let (at, slopes) = (&self.at, &self.derivatives);
        let size = columns + records + slopes.len();
        let mut seen = 0;
        for k in 0..records {
            let record = &problem.records[k];
            let (_, measured) = problem.channels(k);
            let mut weighing = Weighing::new(record, size + 1);
            let mut row = vec![0.0; size + 1];
            problem.pass(k, &self.coefficients, &self.effects, |i, march, step| {
                march.row(step, &mut row[..columns]);
                row[columns + k] = 1.0;
                for (value, slope) in row[columns + records..size].iter_mut().zip(slopes) {
                    *value = slope.values[k][i];
                }
                let linear: f64 = row[..columns]
                    .iter()
                    .zip(&self.coefficients)
                    .map(|(x, c)| x * c)
                    .sum();
                row[size] = measured[i] - at[k].judged[i] + linear;
                if let Some(white) = weighing.weigh(i, &row) {
                    each(size, seen, &white[..size], white[size]);
                    seen += 1;
                }
            });
        }
    }

    /// For each derivative column the sandwich's variance at each cut of [`STRETCHES`].
    fn sums(&self, problem: &Problem) -> Vec<[f64; STRETCHES.len()]> {
        let rows = problem.rows().max(1);
        let finest = STRETCHES[STRETCHES.len() - 1];
        let mut scores = vec![vec![0.0; finest]; self.influences.len()];
        self.rows(problem, |_, seen, row, target| {
            let fitted: f64 = row.iter().zip(&self.solution).map(|(x, s)| x * s).sum();
            let stretch = (seen * finest / rows).min(finest - 1);
            for (score, influence) in scores.iter_mut().zip(&self.influences) {
                let weight: f64 = row.iter().zip(&influence.column).map(|(x, g)| x * g).sum();
                score[stretch] += weight * (target - fitted);
            }
        });
        let variance = |score: &Vec<f64>, count: usize| -> f64 {
            let stretches = score.chunks(finest / count);
            stretches.map(|s| s.iter().sum::<f64>().powi(2)).sum()
        };
        scores
            .iter()
            .map(|score| STRETCHES.map(|count| variance(score, count)))
            .collect()
    }
}
