//! Any Masing joint with the effects that an amplitude table can show, as one non-negative least
//! squares problem over its levels.

use super::effects::Shown;
use super::levels::{Level, Levels, Over};
use super::scatter::Scatter;
use crate::identify::nonnegative::Normal;

/// Thresholds of the dictionary.
const THRESHOLDS: usize = 26;
/// Modal masses looked at, over six decades, and steps of the refinement.
const MASSES: i32 = 24;
const REFINEMENTS: usize = 14;

/// A fitted joint: elastic part, sliders, effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// w_0 \[N/m\] (stop form) or c_0 \[m/N\] (play form).
    pub elastic: f64,
    /// d_j \[m\] or r_j \[N\].
    pub threshold: Vec<f64>,
    /// w_j \[N/m\] or c_j \[m/N\].
    pub weight: Vec<f64>,
    /// Effects with their size.
    pub effects: Vec<(Shown, f64)>,
    /// Modal mass \[kg\] by which stiffness was scaled; 1 where stiffness is absolute.
    pub mass: f64,
    /// Sum of squares of the residuals in units of the noise.
    pub misfit: f64,
}

/// Predicted loss \[J\] and stiffness (in the levels' own unit) of a level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Predicted {
    /// Loss per cycle.
    pub loss: f64,
    /// Secant stiffness, where there is one to predict.
    pub stiffness: Option<f64>,
}

/// The thresholds for a range of amplitudes: logarithmic, from a quarter of the smallest to the
/// largest.
fn thresholds((smallest, largest): (f64, f64)) -> Vec<f64> {
    let from = (0.25 * smallest).ln();
    let step = (largest.ln() - from) / THRESHOLDS as f64;
    (0..THRESHOLDS)
        .map(|j| (from + step * j as f64).exp())
        .collect()
}

/// Loss per unit weight of a slider or play, `4 d (X − d)₊`.
fn slider_loss(threshold: f64, amplitude: f64) -> f64 {
    4.0 * threshold * (amplitude - threshold).max(0.0)
}

/// Secant stiffness per unit weight of a slider at amplitude X: peak over peak `min(1, d/X)`; of the
/// first harmonic `(ψ − sin ψ cos ψ)/π` with `cos ψ = 1 − 2d/X`.
fn slider_stiffness(threshold: f64, amplitude: f64, harmonic: bool) -> f64 {
    let share = threshold / amplitude;
    if share >= 1.0 {
        1.0
    } else if harmonic {
        let cosine = 1.0 - 2.0 * share;
        (cosine.acos() - (1.0 - cosine * cosine).sqrt() * cosine) / std::f64::consts::PI
    } else {
        share
    }
}

/// The best joint with the given effects on the levels marked in `kept`.
pub fn fit(levels: &Levels, noise: &Scatter, effects: &[Shown], kept: &[bool]) -> Model {
    if !levels.mass_unknown {
        return fit_at(levels, noise, effects, kept, 1.0);
    }
    // ω² of a joint that lost only what it lost bounds the mass from below: K ≥ π D/(4 X²).
    let scale = levels.rows.iter().filter_map(|row| {
        row.stiffness
            .map(|square| row.loss / (row.amplitude.powi(2) * square))
    });
    let scale = scale.fold(0.0, f64::max);
    let at = |log: f64| fit_at(levels, noise, effects, kept, scale * 10f64.powf(log));
    let step = 6.0 / f64::from(MASSES);
    let coarse = (0..=MASSES).map(|i| f64::from(i) * step - 1.0);
    let (mut centre, mut best) = (0.0, at(0.0));
    for log in coarse {
        let model = at(log);
        if model.misfit < best.misfit {
            (centre, best) = (log, model);
        }
    }
    let mut width = step;
    for _ in 0..REFINEMENTS {
        width *= 0.6;
        for log in [centre - width, centre + width] {
            let model = at(log);
            if model.misfit < best.misfit {
                (centre, best) = (log, model);
            }
        }
    }
    best
}

fn fit_at(levels: &Levels, noise: &Scatter, effects: &[Shown], kept: &[bool], mass: f64) -> Model {
    let threshold = thresholds(levels.range());
    let size = 1 + threshold.len() + effects.len();
    let mut normal = Normal::new(size);
    let mut rows = Vec::new();
    for (row, _) in levels.rows.iter().zip(kept).filter(|(_, kept)| **kept) {
        let scale = 1.0 / (row.loss * noise.loss);
        let mut columns = vec![0.0; size];
        for (column, d) in columns[1..].iter_mut().zip(&threshold) {
            *column = scale * slider_loss(*d, row.amplitude);
        }
        for (column, shown) in columns[1 + threshold.len()..].iter_mut().zip(effects) {
            *column = scale * shown.loss(row);
        }
        rows.push((columns, 1.0 / noise.loss));
        let (Some(stiffness), Over::Displacement) = (row.stiffness, levels.over) else {
            continue;
        };
        let scale = 1.0 / (stiffness * mass * noise.stiffness);
        let mut columns = vec![scale; size];
        for (column, d) in columns[1..].iter_mut().zip(&threshold) {
            *column = scale * slider_stiffness(*d, row.amplitude, levels.harmonic);
        }
        for (column, shown) in columns[1 + threshold.len()..].iter_mut().zip(effects) {
            *column = scale * shown.stiffness(row, levels.harmonic);
        }
        rows.push((columns, 1.0 / noise.stiffness));
    }
    for (columns, target) in &rows {
        normal.add(columns, *target);
    }
    for columns in smoothness(levels, &threshold, size) {
        normal.add(&columns, 0.0);
    }
    normal.mirror();
    let mut bounded = vec![true; size];
    for (bound, shown) in bounded[1 + threshold.len()..].iter_mut().zip(effects) {
        *bound = !shown.is_signed();
    }
    let x = normal.solve(&bounded);
    let misfit = rows
        .iter()
        .map(|(columns, target)| {
            let sum: f64 = columns.iter().zip(&x).map(|(a, b)| a * b).sum();
            (sum - target).powi(2)
        })
        .sum();
    let sizes = &x[1 + threshold.len()..];
    Model {
        elastic: x[0],
        weight: x[1..=threshold.len()].to_vec(),
        effects: effects.iter().copied().zip(sizes.iter().copied()).collect(),
        threshold,
        mass,
        misfit,
    }
}

/// A table has fewer rows than the dictionary thresholds: of all joints that fit it the smoothest is
/// taken, in the sense of second differences of the density over the power law of the mean slope,
/// `v_j = w_j / d_j^(χ+1)`. A second difference as large as the mean weighs as much as one standard
/// deviation of one reading.
fn smoothness(levels: &Levels, threshold: &[f64], size: usize) -> Vec<Vec<f64>> {
    let (Some(first), Some(last)) = (levels.rows.first(), levels.rows.last()) else {
        return Vec::new();
    };
    let slope = (last.loss / first.loss).ln() / (last.amplitude / first.amplitude).ln();
    let power = if slope.is_finite() {
        slope.clamp(1.0, 6.0) - 2.0
    } else {
        0.0
    };
    let law: Vec<f64> = threshold
        .iter()
        .map(|d| (d / last.amplitude).powf(power))
        .collect();
    let whole: f64 = threshold
        .iter()
        .zip(&law)
        .map(|(d, w)| w * slider_loss(*d, last.amplitude))
        .sum();
    let mean = last.loss / whole;
    (1..threshold.len() - 1)
        .map(|j| {
            let mut columns = vec![0.0; size];
            for (at, factor) in [(j - 1, 1.0), (j, -2.0), (j + 1, 1.0)] {
                columns[1 + at] = factor / (mean * law[at]);
            }
            columns
        })
        .collect()
}

impl Model {
    /// What the model says of a level.
    pub fn predict(&self, row: &Level, levels: &Levels) -> Predicted {
        let sliders = || self.threshold.iter().zip(&self.weight);
        let slip: f64 = sliders()
            .map(|(d, w)| w * slider_loss(*d, row.amplitude))
            .sum();
        let beside: f64 = self
            .effects
            .iter()
            .map(|(shown, size)| size * shown.loss(row))
            .sum();
        let stiffness = row
            .stiffness
            .filter(|_| levels.over == Over::Displacement)
            .map(|_| {
                let network: f64 = sliders()
                    .map(|(d, w)| w * slider_stiffness(*d, row.amplitude, levels.harmonic))
                    .sum();
                let beside: f64 = self
                    .effects
                    .iter()
                    .map(|(shown, size)| size * shown.stiffness(row, levels.harmonic))
                    .sum();
                (self.elastic + network + beside) / self.mass
            });
        Predicted {
            loss: slip + beside,
            stiffness,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_harmonic_of_a_slider_follows_its_loop() {
        // Quadrature of the loop of one slider (w = 1) under X cos θ.
        let (threshold, amplitude) = (0.3, 1.0);
        let count = 200_000;
        let mut anchor = amplitude - threshold;
        let (mut cosine, mut loss) = (0.0, 0.0);
        for step in 1..=2 * count {
            let phase = std::f64::consts::TAU * f64::from(step) / f64::from(count);
            let u = amplitude * phase.cos();
            anchor = f64::max(anchor, u - threshold).min(u + threshold);
            if step > count {
                let force = u - anchor;
                cosine += force * phase.cos() / f64::from(count) * 2.0;
                loss += force * -amplitude * phase.sin() * std::f64::consts::TAU / f64::from(count);
            }
        }
        assert!((slider_stiffness(threshold, amplitude, true) - cosine / amplitude).abs() < 1e-4);
        assert!((slider_loss(threshold, amplitude) - loss).abs() < 1e-4);
    }
}
