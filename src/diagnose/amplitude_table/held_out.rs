//! Prediction of levels that no fit has seen.

use super::effects::Shown;
use super::levels::Levels;
use super::model::{Predicted, fit};
use super::scatter::Scatter;
use crate::diagnose::bootstrap::interval;
use crate::diagnose::findings::Errors;
use crate::identify::seed::APART;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// One level left out, as the others predict it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unseen {
    /// Which row.
    pub row: usize,
    /// Square of its residuals in units of the noise, and their count.
    pub square: f64,
    /// Count of residuals.
    pub count: f64,
    /// Relative error of the loss.
    pub loss: f64,
    /// Relative error of the stiffness, where there is one.
    pub stiffness: Option<f64>,
}

/// Largest ratio of the two neighbours of a level that may be left out: across a wider gap a joint
/// of any density is bound by nothing.
const BRACKET: f64 = 3.0;
/// Fewest levels that are left out; with fewer all inner ones are.
const FEWEST: usize = 3;

/// Every level between near neighbours left out in turn, with its repeats; never the smallest nor the largest.
pub fn unseen(levels: &Levels, noise: &Scatter, effects: &[Shown]) -> Vec<Unseen> {
    let count = levels.rows.len();
    let apart = |i: usize, j: usize| {
        let ratio = levels.rows[i].amplitude / levels.rows[j].amplitude;
        ratio.ln().abs() > APART
    };
    // Repeats of a level are no neighbours of it, and those of the smallest and the largest are these.
    let below = |i: usize| (0..i).rev().find(|&j| apart(i, j));
    let above = |i: usize| (i + 1..count).find(|&j| apart(i, j));
    let ratio = |(below, above): (usize, usize)| {
        levels.rows[above].amplitude / levels.rows[below].amplitude
    };
    let inner = (0..count).filter_map(|i| Some((i, below(i).zip(above(i))?)));
    let inner: Vec<(usize, f64)> = inner.map(|(i, about)| (i, ratio(about))).collect();
    let near = inner.iter().filter(|(_, ratio)| *ratio <= BRACKET);
    let mut picked: Vec<usize> = near.map(|(i, _)| *i).collect();
    if picked.len() < FEWEST {
        picked = inner.iter().map(|(i, _)| *i).collect();
    }
    picked
        .into_iter()
        .map(|out| {
            let kept: Vec<bool> = (0..count).map(|i| apart(i, out)).collect();
            let predicted = fit(levels, noise, effects, &kept).predict(&levels.rows[out], levels);
            against(levels, out, &predicted, noise)
        })
        .collect()
}

/// Residuals of one level.
pub fn against(levels: &Levels, row: usize, predicted: &Predicted, noise: &Scatter) -> Unseen {
    let measured = &levels.rows[row];
    let loss = predicted.loss / measured.loss - 1.0;
    let pair = predicted.stiffness.zip(measured.stiffness);
    let stiffness = pair.map(|(model, measured)| model / measured - 1.0);
    Unseen {
        row,
        square: (loss / noise.loss).powi(2)
            + stiffness.map_or(0.0, |error| (error / noise.stiffness).powi(2)),
        count: 1.0 + f64::from(u8::from(stiffness.is_some())),
        loss,
        stiffness,
    }
}

/// rms in units of the noise, mean relative errors of loss and stiffness; intervals by levels drawn
/// with replacement.
pub fn errors(seen: &[Unseen], unseen: &[Unseen]) -> Errors {
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len().max(1) as f64;
    let losses: Vec<f64> = unseen.iter().map(|level| level.loss.abs()).collect();
    let slopes = unseen.iter().filter_map(|level| level.stiffness);
    let slopes: Vec<f64> = slopes.map(f64::abs).collect();
    Errors {
        train_rms: rms(seen),
        held_out_rms: rms(unseen),
        held_out_interval: interval(unseen, rms),
        dissipation_error: Some(mean(&losses)),
        dissipation_interval: interval(&losses, mean),
        stiffness_error: (!slopes.is_empty()).then(|| mean(&slopes)),
        stiffness_interval: interval(&slopes, mean),
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
