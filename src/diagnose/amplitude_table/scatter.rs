//! Noise of a table without a model: the scatter of its columns about a smooth curve.

use super::levels::Levels;
use crate::identify::seed::APART;

/// Relative standard deviations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scatter {
    /// Of the loss.
    pub loss: f64,
    /// Of the stiffness.
    pub stiffness: f64,
    /// Count of levels they were read from.
    pub count: usize,
}

/// No column of a table is taken as more exact than this, relative: reading of a loop's area.
pub const LEAST_LOSS: f64 = 2e-3;
/// The same for stiffness or frequency squared.
pub const LEAST_STIFFNESS: f64 = 2e-4;

/// Each inner level against the cubic through its four neighbours, over the logarithm of the
/// amplitude: for independent relative errors the difference has `1 + Σ w²` times their variance.
/// What curvature is left in it counts as noise, so that the diagnosis errs towards silence.
pub fn scatter(levels: &Levels) -> Scatter {
    let x: Vec<f64> = levels.rows.iter().map(|row| row.amplitude.ln()).collect();
    let loss: Vec<f64> = levels.rows.iter().map(|row| row.loss.ln()).collect();
    let stiffness: Option<Vec<f64>> = levels
        .rows
        .iter()
        .map(|row| row.stiffness.map(f64::ln))
        .collect();
    let (of_loss, count) = about_cubic(&x, &loss);
    let of_stiffness = stiffness.map_or(0.0, |y| about_cubic(&x, &y).0);
    if count == 0 {
        return ASSUMED;
    }
    Scatter {
        loss: of_loss.max(LEAST_LOSS),
        stiffness: of_stiffness.max(LEAST_STIFFNESS),
        count,
    }
}

/// Where no level has two others on either side.
const ASSUMED: Scatter = Scatter {
    loss: 0.02,
    stiffness: 0.002,
    count: 0,
};

/// The two nearest levels on one side, apart from each other and from level `i`.
fn nearest(x: &[f64], i: usize, side: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut last = i;
    let mut found = Vec::new();
    for j in side {
        if (x[j] - x[last]).abs() > APART && found.len() < 2 {
            found.push(j);
            last = j;
        }
    }
    found
}

fn about_cubic(x: &[f64], y: &[f64]) -> (f64, usize) {
    let (mut sum, mut count) = (0.0, 0);
    for i in 0..x.len() {
        let mut around = nearest(x, i, (0..i).rev());
        around.extend(nearest(x, i, i + 1..x.len()));
        if around.len() < 4 {
            continue;
        }
        let weight = |a: usize| -> f64 {
            let others = around.iter().filter(|&&b| b != a);
            others.map(|&b| (x[i] - x[b]) / (x[a] - x[b])).product()
        };
        let weights: Vec<f64> = around.iter().map(|&a| weight(a)).collect();
        let there: f64 = around.iter().zip(&weights).map(|(&a, w)| w * y[a]).sum();
        let variance = 1.0 + weights.iter().map(|w| w * w).sum::<f64>();
        sum += (y[i] - there).powi(2) / variance;
        count += 1;
    }
    ((sum / count.max(1) as f64).sqrt(), count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_curve_has_no_scatter_and_noise_has_its_own() {
        let x: Vec<f64> = (0..60).map(|i| 0.1 * f64::from(i)).collect();
        let smooth: Vec<f64> = x.iter().map(|x| 1.0 + 2.5 * x - 0.1 * x * x).collect();
        assert!(about_cubic(&x, &smooth).0 < 1e-12);
        // Alternating ± 1 is all scatter: 2 of it against 1 + 34/18 of variance … at least its own size.
        let rough: Vec<f64> = (0..60)
            .map(|i| if i % 2 == 0 { 1.0 } else { -1.0 })
            .collect();
        assert!(about_cubic(&x, &rough).0 > 1.0);
    }
}
