//! The true input behind a measured one.

use super::march::added;
use crate::joint::effect::{Acting, Place, Trajectory};
use crate::record::peaks::Between;

/// Rounds in which what a sensor added to the displacement is taken off, at most.
const MOST_ROUNDS: usize = 8;

/// What sensors added to a measured displacement; leaves the true one in `truth`.
///
/// What depends on the past alone is undone ever better (a slow loss of an amplifier by the factorial of
/// the rounds); where the correction no longer falls, it is noise that is raised, and the last is kept.
pub(super) fn undone(effects: &[Acting], truth: &mut Trajectory, measured: &[f64]) -> Vec<f64> {
    let mut last = vec![0.0; measured.len()];
    let mut change = f64::INFINITY;
    for _ in 0..MOST_ROUNDS {
        let Some(next) = added(effects, Place::DisplacementChannel, truth) else {
            return last;
        };
        let moves = next.iter().zip(&last).map(|(a, b)| (a - b).abs());
        let moved = moves.fold(0.0, f64::max);
        if moved >= change || moved == 0.0 {
            return last;
        }
        let samples = truth.displacement.iter_mut().zip(measured).zip(&next);
        samples.for_each(|((u, m), a)| *u = m - a);
        (last, change) = (next, moved);
    }
    last
}

/// An input, and what it does between samples, without what was added.
pub(super) fn corrected(measured: &[f64], between: &Between, added: &[f64]) -> (Vec<f64>, Between) {
    let input = measured.iter().zip(added).map(|(m, a)| m - a).collect();
    let mut between = between.clone();
    for peak in &mut between.peaks {
        peak.value -= 0.5 * (added[peak.before - 1] + added[peak.before]);
    }
    (input, between)
}
