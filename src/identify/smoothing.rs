//! A fit's dictionary made as smooth as its data allow: non-negative least squares follow the noise with
//! every coefficient they have, and what they follow too closely they predict the worse.

use rayon::prelude::*;

use super::fit::{Fit, normal};
use super::nonnegative::Normal;
use super::problem::Problem;
use super::slopes::{moved, slopes};

/// Weights of smoothness that are tried, from one that only carries the density on into cells that no
/// sample reaches.
const WEIGHTS: [f64; 9] = [1e-3, 1e-2, 0.1, 1.0, 3.0, 10.0, 30.0, 100.0, 1000.0];

/// Cells to either side over which a density is averaged.
const AROUND: usize = 3;

/// Share of the mean density below which no local one counts: empty cells have no scale of their own.
const LEAST: f64 = 1e-3;

/// The fit with the weight `τ` on `Σ ((d_{j+1} − d_j)/d̄_j)²`, `d_j` the density of cell `j` and `d̄_j` its mean
/// around it, that is expected to predict best: of least `χ²/s + 2 tr((XᵀX + τP)⁻¹XᵀX)` (Mallows' C_p), `s` the
/// excess dispersion. The effects' values take one step with it.
///
/// The fit itself where no weight is expected to predict better, or where what was expected does not come
/// true. Checked by the tests below.
pub fn smoothed(problem: &Problem, fit: &Fit) -> Fit {
    let columns = problem.operators.columns();
    let effects = fit.acting();
    let at = problem.predict(&fit.coefficients, &effects);
    let slopes = slopes(problem, &fit.coefficients, &effects, &at);
    let plain = normal(problem, &fit.coefficients, &effects, &at, &slopes);
    let mut bounded = vec![true; plain.size];
    bounded[columns..].iter_mut().for_each(|b| *b = false);
    let dispersion = (fit.misfit / problem.rows().max(1) as f64).max(1.0);
    let risk = |misfit: f64, freedom: f64| misfit / dispersion + 2.0 * freedom;
    let tried = |weight: f64| {
        let mut rough = plain.clone();
        penalise(&mut rough, problem, fit, weight);
        let solution = rough.solve(&bounded);
        let freedom = freedom(&plain, &rough, &bounded, &solution);
        (risk(plain.misfit(&solution), freedom), freedom, solution)
    };
    let as_it_is = tried(0.0).0;
    let smooth: Vec<_> = WEIGHTS.into_par_iter().map(tried).collect();
    let least = smooth.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, freedom, solution)) = least else {
        return fit.clone();
    };
    let coefficients = solution[..columns].to_vec();
    let first = columns + problem.records.len();
    let mut effects = moved(&effects, &slopes, &solution[first..]);
    let (misfit, offsets) = problem.misfit(&problem.predict(&coefficients, &effects));
    if risk(misfit, freedom) >= as_it_is {
        return fit.clone();
    }
    let series = fit.series.and_then(|_| effects.pop());
    Fit {
        coefficients,
        offsets,
        effects,
        series: series.map(|spring| spring.values[0]),
        misfit,
    }
}

/// Adds the weighted roughness of the density over the cells within the input's range.
fn penalise(normal: &mut Normal, problem: &Problem, fit: &Fit, weight: f64) {
    let edges = &problem.operators.edges;
    let count = edges.len();
    let edge = |j: usize| if j == 0 { 0.0 } else { edges[j - 1] };
    let width = |j: usize| edge(j + 1) - edge(j);
    let density = |from: usize, to: usize| {
        let mass: f64 = fit.coefficients[1 + from..=1 + to].iter().sum();
        mass / (edge(to + 1) - edge(from))
    };
    if count < 2 || density(0, count - 1) <= 0.0 {
        return;
    }
    let least = LEAST * density(0, count - 1);
    for j in (0..count - 1).filter(|&j| width(j) > 0.0 && width(j + 1) > 0.0) {
        let around = density(j.saturating_sub(AROUND), (j + 1 + AROUND).min(count - 1)).max(least);
        let (lower, upper) = (1.0 / (width(j) * around), 1.0 / (width(j + 1) * around));
        let row = [(1 + j, -lower), (2 + j, upper)];
        for (i, a) in row {
            for (k, b) in row {
                normal.gram[i * normal.size + k] += weight * a * b;
            }
        }
    }
}

/// Effective count of fitted values, `tr((XᵀX + τP)⁻¹XᵀX)` over the unknowns that are not held at zero.
fn freedom(plain: &Normal, rough: &Normal, bounded: &[bool], solution: &[f64]) -> f64 {
    let size = plain.size;
    let passive: Vec<usize> = (0..size)
        .filter(|&i| !bounded[i] || solution[i] > 0.0)
        .collect();
    let factor = rough.factor(&passive);
    let own = |(place, &i): (usize, &usize)| {
        let cross = &plain.gram[i * size..(i + 1) * size];
        factor.solve(cross).map(|x| x[place])
    };
    passive.iter().enumerate().filter_map(own).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::{Form, Prepared, baseline};
    use crate::record::Record;

    fn amplitudes(t: f64, reached: f64) -> f64 {
        reached * (0.3 + 0.07 * t.floor()).min(1.0) * (std::f64::consts::TAU * t).sin()
    }

    /// A joint of even density under ten cycles that grow to `reached`, on the grid of one that grows to 100.
    fn problem(reached: f64) -> (Problem, Vec<f64>) {
        let record = |reached: f64| {
            let time: Vec<f64> = (0..1000).map(|i| 0.01 * f64::from(i)).collect();
            Record {
                force: time.iter().map(|&t| amplitudes(t, reached)).collect(),
                displacement: vec![0.0; time.len()],
                time: Some(time),
                ..Record::default()
            }
        };
        let mut problem = Problem::new(Form::Play, &[record(100.0)]);
        problem.records = vec![Prepared::new(&record(reached), Form::Play)];
        let mut coefficients = vec![0.0; problem.operators.columns()];
        coefficients[0] = 1.0;
        let mut before = 0.0;
        for (coefficient, &edge) in coefficients[1..].iter_mut().zip(&problem.operators.edges) {
            *coefficient = 0.02 * (edge - before);
            before = edge;
        }
        (problem, coefficients)
    }

    /// Mean square of what a fit predicts wrongly of the joint itself, plain and smoothed, under white noise
    /// of the weights' own size.
    fn wrong_by(seed: u64) -> (f64, f64) {
        let (mut problem, joint) = problem(100.0);
        let truth = problem.predict(&joint, &[])[0].judged.clone();
        let mut state = seed;
        let mut random = || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        // Of twelve even variables the sum has a variance of one.
        let noisy = truth
            .iter()
            .map(|y| y + (0..12).map(|_| random()).sum::<f64>());
        problem.records[0].displacement = noisy.collect();
        let fit = baseline(&problem);
        let wrong = |fit: &Fit| {
            let predicted = fit.predict(&problem);
            let both = predicted[0].judged.iter().zip(&truth);
            both.map(|(p, t)| (p - t).powi(2)).sum::<f64>() / truth.len() as f64
        };
        (wrong(&fit), wrong(&smoothed(&problem, &fit)))
    }

    #[test]
    fn a_smoothed_joint_follows_the_noise_less() {
        let (plain, smooth) = (1..=12)
            .map(wrong_by)
            .fold((0.0, 0.0), |sum, one| (sum.0 + one.0, sum.1 + one.1));
        // Of a dozen values that noise alone decides, at least a third are spared.
        assert!(smooth < 0.67 * plain, "{smooth} of {plain}");
    }

    #[test]
    fn cells_that_no_sample_reaches_carry_the_density_on() {
        let (mut problem, joint) = problem(60.0);
        problem.records[0].displacement = problem.predict(&joint, &[])[0].judged.clone();
        let fit = baseline(&problem);
        let smooth = smoothed(&problem, &fit);
        let cells = problem.operators.edges.len();
        assert_eq!(fit.coefficients[cells], 0.0);
        let (found, hidden) = (smooth.coefficients[cells], joint[cells]);
        assert!(
            (found / hidden - 1.0).abs() < 0.1,
            "{found}, {hidden} hidden"
        );
    }

    #[test]
    fn a_record_without_slip_stays_as_it_is() {
        let (mut problem, mut joint) = problem(100.0);
        joint[1..].fill(0.0);
        problem.records[0].displacement = problem.predict(&joint, &[])[0].judged.clone();
        let fit = baseline(&problem);
        assert_eq!(smoothed(&problem, &fit).coefficients[1..], joint[1..]);
    }
}
