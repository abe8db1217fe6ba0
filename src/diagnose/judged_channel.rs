//! Which channel drives and which is judged: the form of the problem.

use crate::identify::Form;
use crate::record::Record;
use crate::record::calm::fastest;
use crate::record::cycles::{rms, span};
use crate::record::mains::beneath_mains;
use crate::record::noise::from_differences;
use crate::record::repeats::from_repeats;
use crate::record::resolution::resolution;
use std::cmp::Ordering;

/// Ratio of largest to smallest secant compliance beyond which the force-driven form is
/// ill-conditioned (compliance grows without bound at full slip).
const DEEP_SLIP: f64 = 8.0;

/// Chooses the form: the channel with less noise is the input, unless the joint slips so deeply
/// that displacement has to be.
pub fn form(records: &[Record]) -> Form {
    if records.iter().any(|r| compliance_ratio(r) > DEEP_SLIP) {
        return Form::Stop;
    }
    let (mut force, mut displacement) = (0.0, 0.0);
    for record in records {
        let noise = |channel: &[f64]| {
            // A hum on a prescribed displacement is the sensor's: it says nothing of who drives.
            let fast = match &record.time {
                Some(time) => beneath_mains(time, channel),
                None => from_differences(channel),
            };
            // Nor is what a few samples of a smooth channel bend by.
            let fast = fast.deviation.min(fastest(channel));
            let repeated = from_repeats(&record.force, channel)
                .or_else(|| from_repeats(&record.displacement, channel));
            // What drifts or jumps from cycle to cycle is no noise; what is sharp in every cycle neither.
            let noise = repeated.map_or(fast, |noise| noise.deviation.min(fast));
            // What repeats to the last digit was still read by a converter.
            noise.max(resolution(channel)) / rms(channel)
        };
        force += noise(&record.force);
        displacement += noise(&record.displacement);
    }
    let alike = (force / displacement).max(displacement / force) < ALIKE;
    if alike && let Some(drives) = commanded(records) {
        return drives;
    }
    // Of two that show no noise at all neither is the more.
    if displacement >= force * (1.0 - f64::EPSILON.sqrt()) {
        Form::Play
    } else {
        Form::Stop
    }
}

/// Ratio of the channels' fast noise up to which it does not tell which of them drives: of slow noise, which only
/// cycles that repeat show whole, a third is fast.
const ALIKE: f64 = 3.0;

/// The form in which the channel that repeats by itself drives: what answers it repeats up to its noise alone.
/// `None` where neither or both do.
fn commanded(records: &[Record]) -> Option<Form> {
    let repeats = |form: Form| {
        let judged = records.iter().filter(|record| {
            let (drive, response) = form.channels(record);
            from_repeats(drive, response).is_some()
        });
        judged.count()
    };
    match repeats(Form::Play).cmp(&repeats(Form::Stop)) {
        Ordering::Greater => Some(Form::Play),
        Ordering::Less => Some(Form::Stop),
        Ordering::Equal => None,
    }
}

/// Largest over smallest secant compliance, from the peaks of the loops: the smallest from the
/// steepest tenth of local slopes, the largest from the overall range.
pub fn compliance_ratio(record: &Record) -> f64 {
    let (force, displacement) = (span(&record.force), span(&record.displacement));
    if !(force > 0.0 && displacement > 0.0) {
        return 1.0;
    }
    // Slopes over pieces of a twentieth of the force range, so that noise matters little.
    let mut slopes = Vec::new();
    let mut from = 0;
    for i in 1..record.len() {
        let rise = record.force[i] - record.force[from];
        if rise.abs() > 0.05 * force {
            slopes.push((record.displacement[i] - record.displacement[from]) / rise);
            from = i;
        }
    }
    slopes.retain(|s| *s > 0.0);
    if slopes.is_empty() {
        return 1.0;
    }
    slopes.sort_by(f64::total_cmp);
    let stiff = slopes[slopes.len() / 10];
    displacement / force / stiff
}
