//! Bounded nonlinear least squares (Levenberg–Marquardt).

use nalgebra::{DMatrix, DVector};

/// One free number of a fit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Free {
    /// Start value.
    pub start: f64,
    /// Smallest admissible value.
    pub lower: f64,
    /// Largest admissible value.
    pub upper: f64,
    /// Step of the difference quotients; the scale on which the model bends is thousands of it.
    pub step: f64,
}

/// Where a fit ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// Best values.
    pub at: Vec<f64>,
    /// Residuals there.
    pub residual: Vec<f64>,
    /// d residual / d value there, one column per free number.
    pub jacobian: DMatrix<f64>,
    /// Count of iterations.
    pub iterations: usize,
    /// False where the iterations ran out before the steps vanished.
    pub converged: bool,
}

impl Minimum {
    /// Sum of squares.
    pub fn misfit(&self) -> f64 {
        self.residual.iter().map(|r| r * r).sum()
    }
}

/// A column smaller than this (rms, residuals being of order one) is rounding, not sensitivity:
/// scaled by its norm it would send its number anywhere.
const BLIND: f64 = 1e-9;

/// Least sum of squares of `residuals` within the bounds; `None` where the start has no residuals.
///
/// A value on its bound whose gradient points outwards is held there for the step (projected
/// Marquardt); a step to a place without residuals is refused and shortened. Columns are scaled
/// by their norm, so units of the numbers do not matter; residuals should be of order one at most.
pub fn minimise(
    free: &[Free],
    most_iterations: usize,
    residuals: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
) -> Option<Minimum> {
    let mut at: Vec<f64> = free
        .iter()
        .map(|f| f.start.clamp(f.lower, f.upper))
        .collect();
    let mut residual = residuals(&at)?;
    let mut jacobian = differences(free, &at, &residual, residuals);
    let mut damping = 1e-3;
    let mut converged = false;
    let mut iterations = 0;
    let blind = residual.len() as f64 * BLIND.powi(2);
    while iterations < most_iterations && !converged {
        iterations += 1;
        let r = DVector::from_column_slice(&residual);
        let misfit = r.norm_squared();
        let gradient = jacobian.tr_mul(&r);
        let normal = jacobian.tr_mul(&jacobian);
        let held: Vec<bool> = (0..free.len())
            .map(|j| {
                (at[j] <= free[j].lower && gradient[j] > 0.0)
                    || (at[j] >= free[j].upper && gradient[j] < 0.0)
                    || normal[(j, j)] <= blind
            })
            .collect();
        let place = Place {
            free,
            at: &at,
            misfit,
            normal,
            gradient,
            held,
        };
        let Some((next, next_residual)) = place.improved(&mut damping, residuals) else {
            converged = true;
            break;
        };
        let gained = misfit - next_residual.iter().map(|r| r * r).sum::<f64>();
        let moved = (0..free.len())
            .map(|j| (next[j] - at[j]).abs() / free[j].step)
            .fold(0.0, f64::max);
        // A step far below that of the difference quotients, or no gain to speak of.
        converged = moved < 1e-3 || gained <= 1e-12 * misfit;
        (at, residual) = (next, next_residual);
        jacobian = differences(free, &at, &residual, residuals);
    }
    Some(Minimum {
        at,
        residual,
        jacobian,
        iterations,
        converged,
    })
}

/// Where a step starts.
struct Place<'a> {
    free: &'a [Free],
    at: &'a [f64],
    misfit: f64,
    normal: DMatrix<f64>,
    gradient: DVector<f64>,
    /// Numbers that stay for this step.
    held: Vec<bool>,
}

impl Place<'_> {
    /// The first damped step that lowers the misfit.
    fn improved(
        &self,
        damping: &mut f64,
        residuals: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
    ) -> Option<(Vec<f64>, Vec<f64>)> {
        if self.held.iter().all(|&h| h) {
            return None;
        }
        while *damping < 1e16 {
            if let Some(next) = self.bounded_step(*damping)
                && let Some(residual) = residuals(&next)
            {
                let reached: f64 = residual.iter().map(|r| r * r).sum();
                if reached < self.misfit {
                    *damping = (*damping * 0.1).max(1e-14);
                    return Some((next, residual));
                }
            }
            *damping *= 10.0;
        }
        *damping = 1e-3;
        None
    }

    /// The damped step within the bounds: a value that would leave goes to its bound, and the others
    /// are solved for again with it there. Cutting the step off instead would leave the valley.
    fn bounded_step(&self, damping: f64) -> Option<Vec<f64>> {
        let Place {
            free,
            at,
            normal,
            gradient,
            held,
            ..
        } = self;
        let mut step = vec![0.0; at.len()];
        let mut fixed = held.to_vec();
        loop {
            let moving: Vec<usize> = (0..at.len()).filter(|&j| !fixed[j]).collect();
            let n = moving.len();
            if n == 0 {
                break;
            }
            let scale: Vec<f64> = moving.iter().map(|&j| normal[(j, j)].sqrt()).collect();
            let mut damped = DMatrix::from_fn(n, n, |a, b| {
                normal[(moving[a], moving[b])] / (scale[a] * scale[b])
            });
            for a in 0..n {
                damped[(a, a)] += damping;
            }
            let right = DVector::from_fn(n, |a, _| {
                let of_fixed: f64 = (0..at.len())
                    .filter(|&j| fixed[j])
                    .map(|j| normal[(moving[a], j)] * step[j])
                    .sum();
                -(gradient[moving[a]] + of_fixed) / scale[a]
            });
            let solved = damped.cholesky()?.solve(&right);
            let mut left = false;
            for (a, &j) in moving.iter().enumerate() {
                let wanted = at[j] + solved[a] / scale[a];
                let bound = wanted.clamp(free[j].lower, free[j].upper);
                step[j] = bound - at[j];
                if bound != wanted {
                    fixed[j] = true;
                    left = true;
                }
            }
            if !left {
                break;
            }
        }
        Some(at.iter().zip(&step).map(|(a, s)| a + s).collect())
    }
}

/// d residual / d value at a place; `None` where it has no residuals.
pub fn jacobian(
    free: &[Free],
    at: &[f64],
    residuals: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
) -> Option<DMatrix<f64>> {
    residuals(at).map(|residual| differences(free, at, &residual, residuals))
}

/// Central differences; one-sided where the other side is out of bounds or has no residuals.
fn differences(
    free: &[Free],
    at: &[f64],
    residual: &[f64],
    residuals: &dyn Fn(&[f64]) -> Option<Vec<f64>>,
) -> DMatrix<f64> {
    let mut jacobian = DMatrix::zeros(residual.len(), free.len());
    for (j, number) in free.iter().enumerate() {
        let side = |sign: f64| {
            let mut there = at.to_vec();
            there[j] = (at[j] + sign * number.step).clamp(number.lower, number.upper);
            let moved = there[j] - at[j];
            if moved == 0.0 {
                None
            } else {
                residuals(&there).map(|r| (r, moved))
            }
        };
        let here = || (residual.to_vec(), 0.0);
        let (above, up) = side(1.0).unwrap_or_else(here);
        let (below, down) = side(-1.0).unwrap_or_else(here);
        if up == down {
            continue;
        }
        for i in 0..residual.len() {
            jacobian[(i, j)] = (above[i] - below[i]) / (up - down);
        }
    }
    jacobian
}

#[cfg(test)]
mod tests {
    use super::*;

    fn free(start: f64, lower: f64, upper: f64) -> Free {
        Free {
            start,
            lower,
            upper,
            step: 1e-6,
        }
    }

    #[test]
    fn a_curved_valley_is_followed_to_its_end() {
        let rosenbrock = |x: &[f64]| Some(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]]);
        let found = minimise(
            &[free(-1.2, -5.0, 5.0), free(1.0, -5.0, 5.0)],
            100,
            &rosenbrock,
        )
        .expect("it has a start");
        assert!(found.converged);
        assert!((found.at[0] - 1.0).abs() < 1e-8 && (found.at[1] - 1.0).abs() < 1e-8);
    }

    #[test]
    fn a_bound_holds_one_value_while_the_other_moves_on() {
        let plane = |x: &[f64]| Some(vec![x[0] - 3.0 + 0.5 * x[1], x[1] - 1.0]);
        let found =
            minimise(&[free(0.0, -1.0, 1.0), free(0.0, -9.0, 9.0)], 100, &plane).expect("a start");
        // With x_0 = 1: minimise (0.5 y − 2)² + (y − 1)², y = 1.6.
        assert_eq!(found.at[0], 1.0);
        assert!((found.at[1] - 1.6).abs() < 1e-8);
    }
}
