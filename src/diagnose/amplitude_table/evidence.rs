//! Which effect takes how much of the misfit, held against the same on tables that have none.

use super::effects::{Shown, shown_by};
use super::levels::{Levels, Over};
use super::model::{Model, fit};
use super::scatter::{Scatter, scatter};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

/// Tables simulated from the baseline.
const TABLES: u64 = 160;
/// Which of their sorted values is the threshold: the second largest, about 1 % false alarms.
const EXCEEDED: usize = 1;

/// Thresholds of this very table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thresholds {
    /// Misfit of the baseline beyond which something is wrong.
    pub misfit: f64,
    /// Fall of the misfit over what is left of it beyond which an effect is there.
    pub share: f64,
}

/// One effect tried beside those already named.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The effect, at its best shape.
    pub shown: Shown,
    /// The model with it.
    pub model: Model,
    /// Fall of the misfit, in noise variances.
    pub fall: f64,
}

impl Trial {
    /// Fall of the misfit over what is left of it, plus the variance of one reading: as in an F test
    /// the noise cancels, which the few levels of a table tell poorly.
    pub fn share(&self) -> f64 {
        self.fall / (self.model.misfit + 1.0)
    }
}

/// The best shape of every effect, largest fall first.
pub fn trials(levels: &Levels, noise: &Scatter, named: &[Shown], before: &Model) -> Vec<Trial> {
    let kept = vec![true; levels.rows.len()];
    let mut found: Vec<Trial> = Vec::new();
    for shown in shown_by(levels) {
        if named.iter().any(|other| other.name() == shown.name()) {
            continue;
        }
        let together: Vec<Shown> = named.iter().copied().chain([shown]).collect();
        let model = fit(levels, noise, &together, &kept);
        let fall = before.misfit - model.misfit;
        let trial = Trial { shown, model, fall };
        match found
            .iter_mut()
            .find(|other| other.shown.name() == shown.name())
        {
            Some(other) if other.fall < fall => *other = trial,
            Some(_) => {}
            None => found.push(trial),
        }
    }
    found.sort_by(|a, b| b.fall.total_cmp(&a.fall));
    found
}

/// What chance alone gives: the same estimate of the noise, baseline and trials on tables simulated
/// from the fitted baseline with the fitted noise at these very levels. The seed is fixed, so that
/// one table has one diagnosis.
pub fn thresholds(levels: &Levels, noise: &Scatter, baseline: &Model) -> Thresholds {
    let kept = vec![true; levels.rows.len()];
    let simulated: Vec<(f64, f64)> = (0..TABLES)
        .into_par_iter()
        .map(|seed| {
            let table = simulate(levels, noise, baseline, seed);
            let noise = scatter(&table);
            let base = fit(&table, &noise, &[], &kept);
            let tried = trials(&table, &noise, &[], &base);
            let share = tried.first().map_or(0.0, Trial::share);
            (base.misfit, share)
        })
        .collect();
    let quantile = |of: &dyn Fn(&(f64, f64)) -> f64| {
        let mut values: Vec<f64> = simulated.iter().map(of).collect();
        values.sort_by(|a, b| b.total_cmp(a));
        values[EXCEEDED]
    };
    Thresholds {
        misfit: quantile(&|pair| pair.0),
        share: quantile(&|pair| pair.1),
    }
}

/// A table as the model predicts it, with independent relative errors.
pub fn simulate(levels: &Levels, noise: &Scatter, model: &Model, seed: u64) -> Levels {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut normal = move || -> f64 {
        let radius = (-2.0 * (1.0 - random.random::<f64>()).ln()).sqrt();
        radius * (std::f64::consts::TAU * random.random::<f64>()).cos()
    };
    let mut table = levels.clone();
    for row in &mut table.rows {
        let predicted = model.predict(row, levels);
        row.loss = predicted.loss.max(1e-6 * row.loss) * (noise.loss * normal()).exp();
        if let (Some(stiffness), Over::Displacement) = (predicted.stiffness, levels.over) {
            row.stiffness = Some(stiffness * (noise.stiffness * normal()).exp());
        }
    }
    table
}
