//! Evidence, joint refits and the held-out verdict: what is wrong, why, and what it gains.

pub mod amplitude_table;
mod backwards;
pub mod bootstrap;
mod catalogue;
mod coarsely;
mod curves;
mod drive;
mod driven;
pub mod experiment;
pub mod findings;
mod finely;
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
pub mod search;
mod searched;
mod sizes;
mod smooth_drive;
mod striking;
pub mod structure;
mod taught;
mod tested;
mod tone;
pub mod trials;
mod unseen_events;
mod verdict;
mod whereabouts;
mod words;

pub use experiment::Options;
pub use findings::Findings;

use drive::without_drive_noise;
use experiment::dummy::Settled;
use findings::{NoiseFinding, Unexplained, Verdict};
use investigation::Investigation;
use other_form::{Seen, seen_from_both};
use prepare::Bench;
use ready::ready;
use search::Found;
use structure::structure;
use tested::Prospect;
use unseen_events::investigated;

use crate::identify::{Fit, baseline, exported, refit, smoothed};
use crate::joint::JointError;
use crate::record::Record;
use crate::record::noise::independence;
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
    let (mut findings, found, whole) = assemble(records, &bench, settled.found, settled.against)?;
    findings.outlook.dummy = settled.said;
    let said = findings.records.iter_mut().zip(given);
    said.for_each(|((_, samples, _), given)| *samples = given);
    findings.notes.extend(unseen);
    if !ready.uneven.is_empty() {
        findings.notes.push(words::was_uneven(&ready.uneven));
    }
    if calm != records {
        findings.notes.push(
            "The driving channel is noisy, which the joint did not feel: it was read with what the baseline leaves, or smoothed where it is smooth within its noise, or drawn where it goes straight from turn to turn."
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

/// Share of the judged channel's variance that a joint has to answer to be one, where no repeated cycles tell the noise.
const FOLLOWS: f64 = 0.5;

/// Share of the misfit beyond the noise that a named set must at least take away: one that takes
/// less is the least bad of wrong explanations.
const TAKES: f64 = 0.25;

/// Takes back names that leave nearly all of the misfit where it was, on the samples of the fit, and
/// structure in it: without, the noise is larger than it was taken for. Those that take away no more than noise of a drive
/// may bring, or noise of another kind than first-order, and those that one law outside the catalogue stands for, are taken
/// back as well.
fn sober(bench: &Bench, found: Found, timed: bool) -> Found {
    let rows = bench.train.rows() as f64;
    let predictions = found.best.predict(&bench.train);
    let left = structure(&bench.train, &predictions, &bench.noise);
    // What is beyond noise whose variance is known to its own scatter only, and what is structure in any case.
    let noise = rows * bench.most_left().unwrap_or(1.0);
    let beyond = (found.baseline.misfit - noise).max(left.share * rows);
    let taken = found.baseline.misfit - found.best.misfit;
    let takes_little = taken < TAKES * beyond && left.is_seen();
    let all = (0..found.best.effects.len()).collect();
    match takes_little || taken < bench.least_taken(trials::alarm(&bench.train)) {
        true => found.without(bench, all),
        false => {
            let stood_for = outsiders::stood_for(bench, &found, timed);
            found.without(bench, stood_for)
        }
    }
}

fn assemble(
    records: &[Record],
    bench: &Bench,
    found: Found,
    against: Vec<String>,
) -> Result<(Findings, Found, Fit), JointError> {
    let timed = records.iter().all(|r| r.time.is_some());
    let named = found.best.effects.len();
    let kept = sober(bench, found, timed);
    let mut by_noise: Vec<&str> = kept.best.effects.iter().map(|a| a.effect.name()).collect();
    let sober = noise_alone::beyond_noise(records, bench, kept);
    by_noise.retain(|name| sober.best.effect(name).is_none());
    let taken_back = sober.best.effects.len() < named;
    let (found, whole_base) = rayon::join(
        || sober.clone().smoothed(bench),
        || smoothed(&bench.whole, &baseline(&bench.whole)),
    );
    let before = found.baseline.predict(&bench.train);
    let after = found.best.predict(&bench.train);
    let gain = gain::ratio(bench, &before, &after);
    let whole = match found.best.effects.is_empty() {
        true => whole_base.clone(),
        false => {
            let whole = refit(&bench.whole, &found.best, found.best.effects.clone());
            smoothed(&bench.whole, &whole)
        }
    };
    let structure_before = structure(
        &bench.whole,
        &whole_base.predict(&bench.whole),
        &bench.noise,
    );
    let modelled = whole.predict(&bench.whole);
    let structure_after = structure(&bench.whole, &modelled, &bench.noise);
    let follows = gain::follows(bench, &modelled);
    // Where nothing tells the noise but what is left, a joint that answers nothing leaves "noise" alone.
    let goes_together = bench.noise_is_repeated() || follows > FOLLOWS;
    let chi = match goes_together {
        true => whole.misfit / bench.whole.rows().max(1) as f64,
        false => f64::INFINITY,
    };
    let named = !whole.effects.is_empty();
    let of_before = |share: f64| match structure_before.share > 0.0 {
        true => (share / structure_before.share).clamp(0.0, 1.0),
        false => 0.0,
    };
    let left = of_before(structure_after.share);
    // Noise alone leaves a share as large as its standard error now and then, and beside a small effect
    // that is a large part of it.
    let beyond_noise = of_before(structure_after.share - structure_after.error);
    let mut doubles = against;
    doubles.extend(outsiders::doubles(&whole, &modelled));
    let (outsiders, (left_out, parameters)) = rayon::join(
        // A law outside is refitted as the search refits: smoothed, what was found would leave more than it did.
        || outsiders::outsiders(bench, &sober, (timed, taken_back)),
        || {
            rayon::join(
                || left_out::left_out(bench, &whole),
                || {
                    let joint = exported::joint(&bench.whole.operators, &whole)?;
                    let told = joint_parameters::joint_parameters(&bench.whole, &whole, &joint);
                    Ok((joint, told))
                },
            )
        },
    );
    let (joint, (joint_parameters, said)) = parameters?;
    let outside = !outsiders.is_empty();
    doubles.extend(outsiders);
    if named && !left_out::bears_out(&left_out) {
        doubles.push(words::only_between(&whole.effects));
    }
    // What a load repeats has its pitch, and is no tone of another's.
    let toned = match structure_after.goes_with_the_load() {
        true => None,
        false => tone::tone(&bench.whole, &modelled, &bench.noise),
    };
    doubles.extend(toned.map(|tone| words::toned(&records[tone.record], &tone)));
    // Of a few cycles a bootstrap draws some that show nothing of what happens once.
    let likelier = || Prospect::of(bench, &found.baseline, &found.best).is_likelier();
    let proven = gain.1.map_or(gain.0, |(_, upper)| upper) < 1.0 || gain.0 < 1.0 && likelier();
    let verdict = verdict::verdict(
        named.then(|| {
            proven && !bench.noise_may_be_structure() && doubles.is_empty() && follows > FOLLOWS
        }),
        &structure_before,
        &structure_after,
        (bench.most_left(), bench.is_read_to_the_end()),
        chi,
        (
            // Trials are as the search left them; a smoothed baseline leaves more than the one they began from.
            probability::unlisted(&bench.train, &sober, beyond_noise),
            toned.is_some(),
            outside,
        ),
    );
    let causes = catalogue::named(bench, &found, &whole);
    let (left, beyond_noise) = match verdict {
        Verdict::Clean => (0.0, 0.0),
        // Nothing takes any of it away, however random it looks.
        Verdict::Unexplained if !named => (1.0, 1.0),
        // Who says that noise alone is left counts no share of it as more.
        Verdict::Explained => (beyond_noise, beyond_noise),
        _ => (left, beyond_noise),
    };
    let candidates = catalogue::candidates(bench, &sober, &before, beyond_noise);
    let astray = (!goes_together).then(|| words::goes_astray(follows));
    let mut notes: Vec<String> = astray.into_iter().collect();
    notes.extend(words::notes(records, bench, &whole.effects));
    notes.extend(words::of_drive_noise(&by_noise));
    notes.extend(said);
    notes.extend(whereabouts::of_jumps(records, &whole.effects));
    let (judged, unit) = bench.whole.operators.form.judged();
    let mut findings = Findings {
        verdict,
        summary: String::new(),
        judged: judged.to_string(),
        unit: unit.to_string(),
        records: records
            .iter()
            .map(|r| (r.name.clone(), r.len(), String::new()))
            .collect(),
        held_out: gain::stretches(bench),
        causes,
        candidates,
        noise: noise(bench, unit),
        baseline: gain::errors(bench, &before),
        extended: gain::errors(bench, &after),
        gain,
        levels: levels::levels(bench, &before, &after, timed),
        left_out,
        unexplained: Unexplained {
            share: left,
            places: match verdict {
                Verdict::Clean | Verdict::Explained => Vec::new(),
                // Of what noise may leave there are no places.
                _ if !structure_after.is_seen() => Vec::new(),
                _ => whereabouts::of_structure(records, bench, &structure_after),
            },
            doubles: match verdict {
                Verdict::Clean => Vec::new(),
                _ => doubles,
            },
        },
        not_identifiable: words::not_identifiable(
            records,
            joint_parameters::bounds_slip_force(&joint_parameters),
        ),
        next_experiment: None,
        joint_parameters,
        notes,
        joint,
        curves: curves::curves(bench, &before, &after),
        outlook: experiment::Outlook::default(),
    };
    findings.next_experiment = words::next_experiment(&findings);
    findings.summary = words::summary(&findings);
    Ok((findings, found, whole))
}

fn noise(bench: &Bench, unit: &str) -> NoiseFinding {
    let count = bench.noise.len().max(1) as f64;
    let rms = (bench.noise.iter().map(|n| n.deviation.powi(2)).sum::<f64>() / count).sqrt();
    let autoregression = bench.noise.iter().map(|n| n.autoregression).sum::<f64>() / count;
    let rows = bench.whole.rows() as f64;
    NoiseFinding {
        rms,
        unit: unit.to_string(),
        autoregression,
        method: if bench.noise_is_repeated() {
            "differences of cycles that repeat or change steadily, no model".to_string()
        } else {
            "residual of the best model, because too few cycles repeat".to_string()
        },
        effective_samples: rows * independence(autoregression),
    }
}
