//! Findings from what was found: what is kept of it, what it leaves, what else may be at work, and the verdict.

use super::compared::Compared;
use super::drawn_drives::Drives;
use super::experiment::Outlook;
use super::findings::{Estimate, Findings, NoiseFinding, Unexplained, Verdict};
use super::joint_parameters::{bounds_slip_force, joint_parameters};
use super::left_out::{LeftOut, bears_out, left_out};
use super::noise_alone::OfNoise;
use super::outsiders::{doubles, outsiders};
use super::prepare::Bench;
use super::probability::unlisted;
use super::search::Found;
use super::sober::Kept;
use super::tone::tone;
use super::verdict::verdict;
use super::{catalogue, curves, gain, levels, whereabouts, words};
use crate::identify::{Fit, exported};
use crate::joint::{Joint, JointError};
use crate::record::Record;

/// What is told of the set that is kept, besides its causes.
struct Told {
    /// What else may be at work, as clauses.
    doubles: Vec<String>,
    /// True where a law outside the catalogue is likelier in the place of a cause, or beside all.
    outside: bool,
    /// True where a tone is left.
    toned: bool,
    left_out: Vec<LeftOut>,
    joint: Joint,
    joint_parameters: Vec<Estimate>,
    /// What is said of those.
    said: Option<String>,
}

impl Told {
    fn of(
        (records, timed): (&[Record], bool),
        (bench, drives): (&Bench, Option<&Drives>),
        kept: &Kept,
        compared: &Compared,
        against: Vec<String>,
    ) -> Result<Told, JointError> {
        let (whole, modelled) = (&compared.whole, &compared.modelled);
        let (outsiders, (left_out, parameters)) = rayon::join(
            // A law outside is refitted as the search refits: smoothed, what was found would leave more than it did.
            || outsiders((bench, drives), &kept.found, (timed, kept.taken_back)),
            || {
                rayon::join(
                    || left_out(bench, whole),
                    || {
                        let joint = exported::joint(&bench.whole.operators, whole)?;
                        let told = joint_parameters(&bench.whole, whole, &joint);
                        Ok((joint, told))
                    },
                )
            },
        );
        let (joint, (joint_parameters, said)) = parameters?;
        let outside = !outsiders.is_empty();
        let only_between = !whole.effects.is_empty() && !bears_out(&left_out);
        // What a load repeats has its pitch, and is no tone of another's.
        let toned = match compared.structure_after.goes_with_the_load() {
            true => None,
            false => tone(&bench.whole, modelled, &bench.noise),
        };
        let clauses = [
            against,
            doubles(whole, modelled),
            outsiders,
            only_between
                .then(|| words::only_between(&whole.effects))
                .into_iter()
                .collect(),
            toned
                .iter()
                .map(|tone| words::toned(&records[tone.record], tone))
                .collect(),
        ];
        Ok(Told {
            doubles: clauses.concat(),
            outside,
            toned: toned.is_some(),
            left_out,
            joint,
            joint_parameters,
            said,
        })
    }
}

/// Findings, what was found with its joints smoothed, and the joint of all samples that is handed out.
///
/// # Errors
/// [`JointError`] where the records hold no joint at all (no stiffness).
pub(super) fn assembled(
    records: &[Record],
    bench: &Bench,
    found: Found,
    against: Vec<String>,
) -> Result<(Findings, Found, Fit), JointError> {
    let timed = records.iter().all(|r| r.time.is_some());
    let drives = Drives::of(records, bench);
    let drives = drives.as_ref();
    let kept = Kept::of(drives, bench, found, timed);
    let compared = Compared::of(bench, &kept.found);
    let told = Told::of((records, timed), (bench, drives), &kept, &compared, against)?;
    let (verdict, by_noise) = verdict_of((bench, drives), &kept.found, &compared, &told);
    let mut notes = notes(records, bench, (&kept, &compared), told.said);
    notes.extend(by_noise.then(words::left_by_drive_noise));
    let Compared {
        found,
        whole,
        before,
        after,
        structure_after,
        ..
    } = &compared;
    let (share, beyond_noise) = match (verdict, compared.left()) {
        (Verdict::Clean, _) => (0.0, 0.0),
        // Nothing takes any of it away, however random it looks.
        (Verdict::Unexplained, _) if whole.effects.is_empty() => (1.0, 1.0),
        // Who says that noise alone is left counts no share of it as more.
        (Verdict::Explained, (_, beyond)) => (beyond, beyond),
        (_, left) => left,
    };
    let (judged, unit) = bench.whole.operators.form.judged();
    let samples = |r: &Record| (r.name.clone(), r.len(), String::new());
    let mut findings = Findings {
        verdict,
        summary: String::new(),
        judged: judged.to_string(),
        unit: unit.to_string(),
        records: records.iter().map(samples).collect(),
        held_out: gain::stretches(bench),
        causes: catalogue::named(bench, found, whole),
        candidates: catalogue::candidates(bench, &kept.found, before, beyond_noise),
        noise: noise(bench, unit),
        baseline: gain::errors(bench, before),
        extended: gain::errors(bench, after),
        gain: compared.gain,
        levels: levels::levels(bench, before, after, timed),
        left_out: told.left_out,
        unexplained: Unexplained {
            share,
            places: match verdict {
                Verdict::Clean | Verdict::Explained => Vec::new(),
                // Of what noise may leave there are no places.
                _ if !structure_after.is_seen() => Vec::new(),
                _ => whereabouts::of_structure(records, bench, structure_after),
            },
            doubles: match verdict {
                Verdict::Clean => Vec::new(),
                _ => told.doubles,
            },
        },
        not_identifiable: words::not_identifiable(
            records,
            bounds_slip_force(&told.joint_parameters),
        ),
        next_experiment: None,
        joint_parameters: told.joint_parameters,
        notes,
        joint: told.joint,
        curves: curves::curves(bench, before, after),
        outlook: Outlook::default(),
    };
    findings.next_experiment = words::next_experiment(&findings);
    findings.summary = words::summary(&findings);
    let Compared { found, whole, .. } = compared;
    Ok((findings, found, whole))
}

/// The verdict, and whether it is another one for what noise of the drives leaves by itself, which is asked where more than
/// noise of the judged channel is left.
fn verdict_of(
    (bench, drives): (&Bench, Option<&Drives>),
    sober: &Found,
    compared: &Compared,
    told: &Told,
) -> (Verdict, bool) {
    let named = !compared.whole.effects.is_empty();
    let (_, beyond_noise) = compared.left();
    let beside = |of_noise: OfNoise| {
        verdict(
            named.then(|| compared.may_explain(bench) && told.doubles.is_empty()),
            &compared.structure_before,
            &compared.structure_after,
            (bench.most_left(), bench.is_read_to_the_end(), of_noise),
            compared.chi(bench),
            (
                // Trials are as the search left them; a smoothed baseline leaves more than the one they began from.
                unlisted(&bench.train, sober, beyond_noise),
                told.toned,
                told.outside,
            ),
        )
    };
    let said = beside(OfNoise::default());
    match (said, drives) {
        (Verdict::Unexplained | Verdict::PartlyExplained, Some(drives)) => {
            let then = beside(drives.leave(&compared.whole));
            (then, then != said)
        }
        _ => (said, false),
    }
}

/// What is said of channels that do not go together, of the records, of names that noise may have brought, of the joint and of jumps.
fn notes(
    records: &[Record],
    bench: &Bench,
    (kept, compared): (&Kept, &Compared),
    of_the_joint: Option<String>,
) -> Vec<String> {
    let effects = &compared.whole.effects;
    let astray = !compared.goes_together(bench);
    let mut notes: Vec<String> = Vec::new();
    notes.extend(astray.then(|| words::goes_astray(compared.follows)));
    notes.extend(words::notes(records, bench, effects));
    notes.extend(words::of_drive_noise(&kept.by_noise));
    notes.extend(of_the_joint);
    notes.extend(whereabouts::of_jumps(records, effects));
    notes
}

fn noise(bench: &Bench, unit: &str) -> NoiseFinding {
    let count = bench.noise.len().max(1) as f64;
    let rms = (bench.noise.iter().map(|n| n.deviation.powi(2)).sum::<f64>() / count).sqrt();
    let alike = bench.noise.iter().map(|n| n.colour.neighbours());
    let autoregression = alike.sum::<f64>() / count;
    NoiseFinding {
        rms,
        unit: unit.to_string(),
        autoregression,
        method: if bench.noise_is_repeated() {
            "differences of cycles that repeat or change steadily, no model".to_string()
        } else {
            "residual of the best model, because too few cycles repeat".to_string()
        },
        effective_samples: bench.whole.independent_rows(),
    }
}
