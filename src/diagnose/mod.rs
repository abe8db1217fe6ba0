//! Evidence, joint refits and the held-out verdict: what is wrong, why, and what it gains.

pub mod amplitude_table;
mod assembled;
mod backwards;
mod beside;
pub mod bootstrap;
mod catalogue;
mod coarsely;
mod compared;
mod curves;
mod drawn_drives;
mod drive;
mod driven;
pub mod experiment;
pub mod findings;
mod finely;
mod first_noise;
mod first_turns;
mod forms;
mod full_slip;
pub mod gain;
mod gridded;
mod growing;
mod however_begun;
mod however_worn;
pub mod intervals;
mod investigation;
pub mod joint_parameters;
pub mod judged_channel;
mod noise_alone;
mod noise_of_all;

pub mod left_out;
pub mod levels;
mod loud;
mod mains_phase;
mod other_form;
mod outsiders;
mod places;
pub mod prepare;
mod probability;
mod ready;
mod refinements;
mod rule;
pub mod search;
mod searched;
mod sizes;
mod smooth_drive;
mod sober;
mod striking;
pub mod structure;
mod taught;
mod tested;
mod tone;
pub mod trials;
mod unseen_events;
mod verdict;
mod virgin;
mod whereabouts;
mod words;

pub use experiment::Options;
pub use findings::Findings;

use assembled::assembled;
use drive::without_drive_noise;
use experiment::dummy::Settled;
use investigation::Investigation;
use other_form::{Seen, seen_from_both};
use ready::ready;
use unseen_events::investigated;

use crate::joint::JointError;
use crate::record::Record;
use crate::record::outliers::struck_out;

/// Diagnoses the records of one joint.
///
/// Noise first, then the baseline, then the search for causes on the samples that are not held
/// out, then the gain on those that are; the joint that is handed out is refitted on everything.
///
/// # Errors
/// [`JointError`] where the records hold no joint at all (no stiffness).
pub fn diagnose(records: &[Record], progress: impl FnMut(&str)) -> Result<Findings, JointError> {
    diagnose_with(records, &Options::default(), progress)
}

/// Diagnoses with what is known besides the records: limits of the rig, a dummy.
///
/// # Errors
/// As [`diagnose`].
pub fn diagnose_with(
    records: &[Record],
    options: &Options,
    mut progress: impl FnMut(&str),
) -> Result<Findings, JointError> {
    let timed = records.iter().all(|r| r.time.is_some());
    let all: usize = records.iter().map(Record::len).sum();
    let given: Vec<usize> = records.iter().map(Record::len).collect();
    let ready = ready(records);
    let (records, form) = (ready.records.as_slice(), ready.form);
    let used: usize = records.iter().map(Record::len).sum();
    let calm = without_drive_noise(form, records);
    let investigation = investigated((form, &calm), timed, &mut progress);
    let seen = Seen::once(form, calm, investigation);
    let seen = seen_from_both(records, seen, timed, &mut progress);
    let unseen = words::of_other_form(&seen.unseen, seen.form);
    let (calm, Investigation { bench, found }) = (seen.calm, seen.investigation);
    progress("measuring the gain on held-out cycles");
    let settled = match &options.dummy {
        Some(dummy) => experiment::dummy::settle(&bench, found, &struck_out(dummy)),
        None => Settled::without_dummy(found),
    };
    let (mut findings, found, whole) = assembled(records, &bench, settled.found, settled.against)?;
    findings.outlook.dummy = settled.said;
    let said = findings.records.iter_mut().zip(given);
    said.for_each(|((_, samples, _), given)| *samples = given);
    findings.notes.extend(unseen);
    if !ready.uneven.is_empty() {
        findings.notes.push(words::was_uneven(&ready.uneven));
    }
    if calm != records {
        findings.notes.push(
            "The driving channel is noisy, which the joint did not feel: it was read with what the baseline leaves and smoothed where it is smooth within its noise, or drawn where it goes straight from turn to turn."
                .to_string(),
        );
    }
    if used < all {
        findings.notes.push(format!(
            "{used} of the {all} samples were used: a cycle keeps a hundred or more in the mean, and its turning points."
        ));
    }
    progress("looking ahead: what can be told apart, and by which experiment");
    experiment::look_ahead(&mut findings, &bench, &found, &whole, timed, options);
    Ok(findings)
}
