//! The true input behind a measured one.

use super::late::{lateness, read_ahead};
use super::march::added;
use super::operators::Form;
use super::problem::Prepared;
use crate::joint::effect::{Acting, Place, Trajectory};
use crate::record::peaks::Between;

/// Rounds in which what a sensor added to the displacement is taken off, at most.
const MOST_ROUNDS: usize = 8;

/// The input that a joint had, as far as it follows from the measured one alone, and what it did between samples;
/// the true displacement is left in `truth` where that is the input.
///
/// What sensors add to a prescribed displacement is taken off, by the effects that are `correcting` it. Of a
/// displacement that comes late under a prescribed force, the joint's answer is that to the force as late.
pub(super) fn true_input(
    (form, record): (Form, &Prepared),
    effects: &[Acting],
    correcting: &[Acting],
    truth: &mut Trajectory,
) -> (Vec<f64>, Between) {
    let (measured, _) = record.channels(form);
    let as_measured = || (measured.to_vec(), record.between.clone());
    match form {
        Form::Play => {
            let times = effects.iter().filter_map(|a| a.effect.lateness(&a.values));
            let late: f64 = times.sum();
            match late == 0.0 {
                true => as_measured(),
                false => read_ahead(record, measured, -late),
            }
        }
        Form::Stop if correcting.is_empty() => as_measured(),
        Form::Stop => {
            let read = match lateness(correcting) {
                Some(late) => read_ahead(record, measured, late),
                None => {
                    let added = undone(correcting, truth, measured);
                    corrected(measured, &record.between, &added)
                }
            };
            truth.displacement.clone_from(&read.0);
            read
        }
    }
}

/// What sensors added to a measured displacement; leaves the true one in `truth`.
///
/// What depends on the past alone is undone ever better (a slow loss of an amplifier by the factorial of
/// the rounds); where the correction no longer falls, it is noise that is raised, and the last is kept.
fn undone(effects: &[Acting], truth: &mut Trajectory, measured: &[f64]) -> Vec<f64> {
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
