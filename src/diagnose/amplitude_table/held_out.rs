//! Prediction of levels that no fit has seen.

use super::effects::Shown;
use super::levels::Levels;
use super::model::{Predicted, fit};
use super::scatter::Scatter;
use crate::diagnose::findings::Errors;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// One level left out, as the others predict it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unseen {
    /// Square of its residuals in units of the noise, and their count.
    pub square: f64,
    /// Count of residuals.
    pub count: f64,
    /// Relative error of the loss.
    pub loss: f64,
    /// Relative error of the stiffness, where there is one.
    pub stiffness: Option<f64>,
}

/// Every level but the smallest and the largest left out in turn: a joint of any density is not
/// bound beyond the amplitudes that it was fitted to.
pub fn unseen(levels: &Levels, noise: &Scatter, effects: &[Shown]) -> Vec<Unseen> {
    let count = levels.rows.len();
    (1..count.saturating_sub(1))
        .map(|out| {
            let kept: Vec<bool> = (0..count).map(|i| i != out).collect();
            let row = &levels.rows[out];
            let predicted = fit(levels, noise, effects, &kept).predict(row, levels);
            against(row.loss, row.stiffness, &predicted, noise)
        })
        .collect()
}

/// Residuals of one level.
pub fn against(
    loss: f64,
    stiffness: Option<f64>,
    predicted: &Predicted,
    noise: &Scatter,
) -> Unseen {
    let loss = predicted.loss / loss - 1.0;
    let stiffness = predicted
        .stiffness
        .zip(stiffness)
        .map(|(model, measured)| model / measured - 1.0);
    Unseen {
        square: (loss / noise.loss).powi(2)
            + stiffness.map_or(0.0, |error| (error / noise.stiffness).powi(2)),
        count: 1.0 + f64::from(u8::from(stiffness.is_some())),
        loss,
        stiffness,
    }
}

/// rms in units of the noise, and mean relative error of the loss.
pub fn errors(seen: &[Unseen], unseen: &[Unseen]) -> Errors {
    Errors {
        train_rms: rms(seen),
        held_out_rms: rms(unseen),
        dissipation_error: Some(
            unseen.iter().map(|level| level.loss.abs()).sum::<f64>() / unseen.len().max(1) as f64,
        ),
    }
}

fn rms(levels: &[Unseen]) -> f64 {
    let square: f64 = levels.iter().map(|level| level.square).sum();
    let count: f64 = levels.iter().map(|level| level.count).sum();
    (square / count.max(1.0)).sqrt()
}

/// Draws of levels for the interval of a ratio.
const DRAWS: usize = 2000;

/// Held-out rms after over before with its 95 % interval: levels drawn with replacement.
pub fn ratio(before: &[Unseen], after: &[Unseen]) -> (f64, Option<(f64, f64)>) {
    let of = |picked: &[usize]| {
        let sum = |levels: &[Unseen]| picked.iter().map(|&i| levels[i].square).sum::<f64>();
        (sum(after) / sum(before)).sqrt()
    };
    let all: Vec<usize> = (0..before.len()).collect();
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut drawn: Vec<f64> = (0..DRAWS)
        .map(|_| {
            let picked: Vec<usize> = all
                .iter()
                .map(|_| random.random_range(0..all.len()))
                .collect();
            of(&picked)
        })
        .filter(|ratio| ratio.is_finite())
        .collect();
    drawn.sort_by(f64::total_cmp);
    let at = |share: f64| drawn.get((share * drawn.len() as f64) as usize).copied();
    (of(&all), at(0.025).zip(at(0.975)))
}
