//! Tones that stand out in what a model leaves: what rings, rings at its own frequency.

use std::f64::consts::{PI, TAU};

/// Frequencies that are told at most.
const TONES: usize = 2;

/// Ratio of neighbouring frequencies that are looked at.
const STEP: f64 = 1.02;

/// Highest frequency looked at, as a share of half the sampling rate.
const HIGHEST: f64 = 0.8;

/// Angular frequencies above `from` \[rad/s\] at which the power of the values has a peak, the loudest first;
/// samples are `step` \[s\] apart.
pub fn ringing(step: f64, values: &[f64], from: f64) -> Vec<f64> {
    let to = HIGHEST * PI / step;
    if !(from > 0.0 && from.is_finite() && to.is_finite()) || values.len() < 8 {
        return Vec::new();
    }
    // Over longer pieces a tone would fall between two of the frequencies.
    let piece = |w: f64| ((TAU / (w * (STEP - 1.0)) / step) as usize).max(8);
    let mut frequencies = Vec::new();
    let mut frequency = from;
    while frequency < to {
        frequencies.push(frequency);
        frequency *= STEP;
    }
    let powers: Vec<f64> = frequencies
        .iter()
        .map(|w| {
            values
                .chunks(piece(*w))
                .map(|piece| power(piece, w * step))
                .sum()
        })
        .collect();
    let mut peaks: Vec<usize> = (1..powers.len().saturating_sub(1))
        .filter(|&i| powers[i] > powers[i - 1] && powers[i] >= powers[i + 1])
        .collect();
    peaks.sort_by(|&a, &b| powers[b].total_cmp(&powers[a]));
    peaks.truncate(TONES);
    peaks.into_iter().map(|i| frequencies[i]).collect()
}

/// `|Σ x_i exp(−jωi)|²` by Goertzel's recurrence.
fn power(values: &[f64], angle: f64) -> f64 {
    let twice = 2.0 * angle.cos();
    let (mut last, mut before) = (0.0, 0.0);
    for value in values {
        (last, before) = (value + twice * last - before, last);
    }
    last * last + before * before - twice * last * before
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tones_are_told_among_slow_motion_and_noise() {
        let step = 1e-3;
        let values: Vec<f64> = (0..5000)
            .map(|i| f64::from(i) * step)
            .map(|t| {
                let rough = 0.2 * (1e5 * t * t).sin();
                3.0 * (20.0 * t).sin() + (411.0 * t).sin() + 0.5 * (150.0 * t).cos() + rough
            })
            .collect();
        let found = ringing(step, &values, 60.0);
        let near = |found: f64, tone: f64| (found / tone).ln().abs() < STEP.ln();
        assert!(near(found[0], 411.0) && near(found[1], 150.0), "{found:?}");
        assert!(ringing(step, &values, f64::NAN).is_empty());
        assert!(ringing(step, &values[..5], 60.0).is_empty());
    }
}
