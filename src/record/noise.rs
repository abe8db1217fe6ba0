//! The noise of a channel, without a model where cycles of the drive repeat.

use super::cycles::{Cycle, alike, cycles};

/// Noise of one channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Standard deviation, in the channel's unit.
    pub deviation: f64,
    /// Correlation of neighbouring samples, 0 … 0.99.
    pub autoregression: f64,
    /// Samples it was estimated from.
    pub samples: usize,
    /// True where repeated cycles gave it; false where it is read off the fastest variations.
    pub repeated: bool,
}

/// Noise from steady cycles: second differences over three equal cycles of the drive, so that a
/// uniform change from cycle to cycle (drift, wear) cancels as well as the response itself.
///
/// `response(t−T) − 2 response(t) + response(t+T)` has `4 + 2s` times the noise's variance, with
/// `s` the sum of squares of the interpolation weights. `None` where fewer than 150 samples lie in
/// such triples.
pub fn from_repeats(drive: &[f64], response: &[f64]) -> Option<Noise> {
    let found = cycles(drive);
    let mut differences: Vec<Vec<f64>> = Vec::new();
    for triple in found.windows(3) {
        if !alike(&triple[0], &triple[1]) || !alike(&triple[1], &triple[2]) {
            continue;
        }
        let back = -shift(
            drive,
            &triple[1],
            triple[0].start as f64 - triple[1].start as f64,
        );
        let forth = shift(
            drive,
            &triple[1],
            triple[2].start as f64 - triple[1].start as f64,
        );
        let amplitude = triple[1].amplitude;
        let mut part = Vec::new();
        let mut same = 0.0_f64;
        for i in triple[1].start..triple[1].end {
            let (Some((before, one)), Some((after, other))) = (
                interpolate(response, i as f64 - back),
                interpolate(response, i as f64 + forth),
            ) else {
                continue;
            };
            let load = interpolate(drive, i as f64 - back).map_or(0.0, |v| v.0) - 2.0 * drive[i]
                + interpolate(drive, i as f64 + forth).map_or(0.0, |v| v.0);
            same = same.max(load.abs());
            part.push((before - 2.0 * response[i] + after) / (4.0 + one + other).sqrt());
        }
        if same < 0.02 * amplitude && part.len() > 8 {
            differences.push(part);
        }
    }
    let samples: usize = differences.iter().map(Vec::len).sum();
    if samples < 150 {
        return None;
    }
    let (deviation, autoregression) = moments(&differences);
    Some(Noise {
        deviation,
        autoregression,
        samples,
        repeated: true,
    })
}

/// Noise of a residual that nothing repeats in: its own variance and correlation of neighbours.
pub fn from_residual(residual: &[f64]) -> Noise {
    let (deviation, autoregression) = moments(&[residual.to_vec()]);
    Noise {
        deviation,
        autoregression,
        samples: residual.len(),
        repeated: false,
    }
}

/// Noise from the fastest variations only, taken as white: third differences,
/// `Var = 20 σ²`, over which any smooth response cancels.
pub fn from_differences(residual: &[f64]) -> Noise {
    let mut squares: Vec<f64> = residual
        .windows(4)
        .map(|w| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).powi(2) / 20.0)
        .collect();
    // The median of χ²₁ is 0.4549: kinks at reversals are outliers to it.
    squares.sort_by(f64::total_cmp);
    let median = squares.get(squares.len() / 2).copied().unwrap_or(0.0);
    Noise {
        deviation: (median / 0.4549).sqrt(),
        autoregression: 0.0,
        samples: residual.len(),
        repeated: false,
    }
}

/// Standard deviation and lag-one correlation, the latter without the bias of short parts.
fn moments(parts: &[Vec<f64>]) -> (f64, f64) {
    let (mut square, mut product, mut count, mut pairs) = (0.0, 0.0, 0.0, 0.0);
    for part in parts {
        square += part.iter().map(|v| v * v).sum::<f64>();
        count += part.len() as f64;
        product += part.windows(2).map(|w| w[0] * w[1]).sum::<f64>();
        pairs += (part.len().max(1) - 1) as f64;
    }
    if square <= 0.0 || pairs <= 0.0 {
        return (0.0, 0.0);
    }
    let correlation = (product / pairs) / (square / count);
    // A correlation within two standard errors of zero is taken as none.
    let significant = correlation > 2.0 / count.sqrt();
    (
        (square / count).sqrt(),
        if significant {
            correlation.min(0.99)
        } else {
            0.0
        },
    )
}

/// Shift in samples, near `guess`, at which the drive repeats the given cycle best
/// (Gauss–Newton on the sum of squared differences).
fn shift(drive: &[f64], cycle: &Cycle, guess: f64) -> f64 {
    let mut shift = guess;
    for _ in 0..6 {
        let (mut product, mut norm) = (0.0, 0.0);
        for i in cycle.start..cycle.end {
            let at = i as f64 + shift;
            if let (Some((here, _)), Some((ahead, _)), Some((behind, _))) = (
                interpolate(drive, at),
                interpolate(drive, at + 0.5),
                interpolate(drive, at - 0.5),
            ) {
                let slope = ahead - behind;
                product += slope * (drive[i] - here);
                norm += slope * slope;
            }
        }
        let step = if norm > 0.0 {
            (product / norm).clamp(-2.0, 2.0)
        } else {
            0.0
        };
        shift += step;
        if step.abs() < 1e-6 {
            break;
        }
    }
    // A drive sampled in step with its period repeats to the sample: no interpolation then.
    if (shift - shift.round()).abs() < 1e-3 {
        shift.round()
    } else {
        shift
    }
}

/// Cubic Lagrange interpolation at a fractional index, and the sum of squares of its weights.
fn interpolate(channel: &[f64], at: f64) -> Option<(f64, f64)> {
    let base = at.floor();
    let s = at - base;
    let base = base as isize;
    if base < 1 || base + 2 >= channel.len() as isize {
        return None;
    }
    let b = base as usize;
    let weights = [
        -s * (s - 1.0) * (s - 2.0) / 6.0,
        (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
        -(s + 1.0) * s * (s - 2.0) / 2.0,
        (s + 1.0) * s * (s - 1.0) / 6.0,
    ];
    let value = weights
        .iter()
        .zip(&channel[b - 1..b + 3])
        .map(|(w, y)| w * y)
        .sum();
    Some((value, weights.iter().map(|w| w * w).sum()))
}
