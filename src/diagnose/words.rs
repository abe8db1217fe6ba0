//! What a diagnosis says in words.

use super::backwards::runs_backwards;
use super::findings::{Findings, Verdict};
use super::judged_channel::compliance_ratio;
use super::prepare::Bench;
use super::tone::Tone;
use crate::identify::Form;
use crate::identify::beginning::{Beginning, at_zero};
use crate::joint::effect::Acting;
use crate::record::Record;
use crate::record::outliers::stand_alone;
use crate::record::resolution::step;
use crate::record::written::quantity;

/// The verdict in a sentence or two.
pub fn summary(findings: &Findings) -> String {
    let names: Vec<String> = findings
        .causes
        .iter()
        .map(|c| {
            let own = in_words(&c.name);
            if c.ambiguous_with.is_empty() {
                own
            } else {
                let rivals: Vec<String> = c.ambiguous_with.iter().map(|r| in_words(r)).collect();
                format!("{own} (or {})", rivals.join(" or "))
            }
        })
        .collect();
    let many = names.len() > 1;
    let doubles = in_words(&findings.unexplained.doubles.join("; "));
    capital(&said(
        findings.verdict,
        (&names.join(" and "), many),
        findings.gain,
        (findings.unexplained.share, &doubles),
    ))
}

/// The verdict of causes with these names (whether they are several), the ratio of errors with its interval, and
/// the share that is left with what may be there instead.
fn said(
    verdict: Verdict,
    (names, many): (&str, bool),
    (ratio, interval): (f64, Option<(f64, f64)>),
    (left, doubles): (f64, &str),
) -> String {
    let partly = || partly((names, many), ratio, interval);
    match verdict {
        Verdict::Clean if names.is_empty() => {
            "the baseline joint explains the records to the noise; no cause is called for."
                .to_string()
        }
        Verdict::Clean => format!(
            "the baseline joint explains the records to the noise; {names} can be seen and {} not matter.",
            if many { "do" } else { "does" }
        ),
        Verdict::Explained => format!(
            "{names} {} what the baseline gets wrong: the held-out error falls to {ratio:.2} of the baseline's and only noise is left.",
            if many { "explain" } else { "explains" }
        ),
        // What may be something else is not said as if it were found.
        Verdict::PartlyExplained if !doubles.is_empty() => format!(
            "perhaps {names}, perhaps something that is not in the catalogue ({doubles}). {}.",
            capital(&partly())
        ),
        Verdict::PartlyExplained => format!(
            "{}; {:.0} % of the misfit beyond the noise stays unexplained.",
            partly(),
            100.0 * left
        ),
        Verdict::Unexplained => {
            let perhaps = match doubles.is_empty() {
                true => String::new(),
                false => format!("; {doubles}"),
            };
            format!(
                "the baseline leaves structure beyond the noise, and no cause of the catalogue predicts it{perhaps}."
            )
        }
    }
}

/// `sensor_delay` as `sensor delay`, `running_in` as the noun that it is.
fn in_words(names: &str) -> String {
    names.replace("running_in", "running-in").replace('_', " ")
}

/// The first letter raised.
fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(rest).collect()
    })
}

/// What a partial explanation does to prediction: better, worse, or neither beyond its scatter.
fn partly((names, many): (&str, bool), ratio: f64, interval: Option<(f64, f64)>) -> String {
    let proven = interval.map_or(ratio < 1.0, |(_, upper)| upper < 1.0);
    let (take, fit) = match many {
        true => ("take", "fit"),
        false => ("takes", "fits"),
    };
    match (proven, ratio > 1.0) {
        (true, _) => {
            format!("{names} {take} the held-out error to {ratio:.2} of the baseline's")
        }
        (false, false) => format!(
            "{names} {fit} best, but the gain on unseen data is not proven (held-out error {ratio:.2} of the baseline's)"
        ),
        (false, true) => format!(
            "{names} {fit} best what was fitted, but {take} the held-out error to {ratio:.2} of the baseline's"
        ),
    }
}

/// What these records cannot show.
pub fn not_identifiable(records: &[Record], slip_force_is_bounded: bool) -> Vec<String> {
    let mut sentences = Vec::new();
    let deepest = records.iter().map(compliance_ratio).fold(1.0_f64, f64::max);
    if deepest < 4.0 && !slip_force_is_bounded {
        sentences.push(format!(
            "Full slip was not approached (largest over smallest secant compliance {deepest:.1}): the slip force F_S and the ratio beta are not bounded from above by these records."
        ));
    }
    sentences.push(
        "The split of the small-amplitude compliance into 1/K_1 and 1/K_T: only the stiffness of both in series is seen in force and displacement of the joint.".to_string(),
    );
    if records.iter().any(|r| r.time.is_none()) {
        sentences.push(
            "A record has no time: every cause that depends on rate or time was left out."
                .to_string(),
        );
    }
    sentences
}

/// Assumptions made on the way.
pub fn notes(records: &[Record], bench: &Bench, effects: &[Acting]) -> Vec<String> {
    let mut notes = Vec::new();
    if !bench.noise_is_repeated() {
        notes.push("Too few cycles repeat for a noise estimate without a model: what the best model leaves is taken as noise, so that structure hidden in it cannot be told from noise.".to_string());
    }
    if bench.fitted.middle {
        notes.push("Something happened within the cycles that are set aside as a rule, which all samples together tell: the fit was given them, and the gain is measured on others.".to_string());
    }
    if bench.fitted.end {
        notes.push("The last cycles showed what no earlier one did: the fit was given them to find out why, and the gain is measured on cycles before them.".to_string());
    }
    if bench.whole.records.iter().any(|r| r.between.straight) {
        notes.push("The drive was taken to go straight from sample to sample, as one does that a program made: turns between samples, as a measured one has, leave more.".to_string());
    }
    if bench.whole.wears_on && effects.iter().any(|a| a.effect.wears()) {
        notes.push("Wear goes on from record to record: they were taken for tests of one joint after the other, in the order given.".to_string());
    }
    for (k, record) in records.iter().enumerate() {
        notes.extend(finer_than_read(record, k, bench));
    }
    for ((record, struck), prepared) in records.iter().zip(&bench.struck).zip(&bench.whole.records)
    {
        let count = struck.iter().filter(|s| **s).count();
        if count > 0 {
            notes.push(stand_alone(&record.name, count, record.len()));
        }
        notes.extend(runs_backwards(record));
        notes.extend(begins(
            record,
            &prepared.beginning,
            bench.whole.operators.form,
        ));
    }
    notes
}

/// What the noise of a record was taken for, where the record shows less than its channel resolves.
fn finer_than_read(record: &Record, k: usize, bench: &Bench) -> Option<String> {
    if !bench.is_finer_than_read(k) {
        return None;
    }
    let form = bench.whole.operators.form;
    let (channel, unit) = form.judged();
    let why = match step(form.channels(record).1) {
        Some(step) => format!("is read in steps of {}", quantity(step, unit)),
        None => "shows less noise than a ten-thousandth of itself".to_string(),
    };
    Some(format!(
        "Record {}: the {channel} {why}; its noise was taken for {} rms.",
        record.name,
        quantity(bench.noise[k].deviation, unit)
    ))
}

/// What is said of records that were read at even steps.
pub fn was_uneven(names: &[String]) -> String {
    format!(
        "Sampled unevenly, as its own clock tells, and read off at even steps, as many as there are samples: {}.",
        names.join(", ")
    )
}

/// What is said of causes that noise of the drive does the work of; nothing of none.
pub fn of_drive_noise(names: &[&str]) -> Option<String> {
    let names: Vec<String> = names.iter().map(|name| in_words(name)).collect();
    (!names.is_empty()).then(|| {
        format!(
            "Not named, as noise of the driving channel alone makes as much of it: {}.",
            names.join(", ")
        )
    })
}

/// What is said where more than the judged channel's noise is left, and noise of the drive alone leaves as much.
pub fn left_by_drive_noise() -> String {
    "What is left stands out no more than what noise of the driving channel alone leaves of such records."
        .to_string()
}

/// What is said of causes that only the form shows which is not this one; nothing of none.
pub fn of_other_form(names: &[String], form: Form) -> Option<String> {
    let in_words: Vec<String> = names.iter().map(|name| in_words(name)).collect();
    (!names.is_empty()).then(|| {
        format!(
            "Not named, as nothing is seen of it with the {} as the input, though neither channel is plainly the quieter: {}.",
            form.input().0,
            in_words.join(", ")
        )
    })
}

/// What is said where the two channels hardly go together.
pub fn goes_astray(follows: f64) -> String {
    format!(
        "The best joint answers {:.0} % of the judged channel's variance: see that the columns are those of one test, in their order and at one time.",
        100.0 * follows.max(0.0)
    )
}

/// What is said of causes that no record bears out by itself.
pub fn only_between(effects: &[Acting]) -> String {
    let names: Vec<&str> = effects.iter().map(|a| a.effect.name()).collect();
    format!(
        "{}: only what differs between the records speaks for it, which may have another reason: without one of them the others tell nothing of it",
        names.join(", ")
    )
}

/// What is said of a tone that goes on through a record.
pub fn toned(record: &Record, tone: &Tone) -> String {
    let ends = record
        .time
        .as_ref()
        .and_then(|t| Some((t.first()?, t.last()?)));
    let pitch = match ends {
        Some((first, last)) => {
            let steps = record.len().saturating_sub(1) as f64;
            quantity(tone.frequency * steps / (last - first), "Hz")
        }
        None => format!("one cycle in {:.1} samples", 1.0 / tone.frequency),
    };
    format!(
        "a steady tone ({pitch}) goes on through record {}: a vibration of the rig, or what its electronics pick up",
        record.name
    )
}

/// How a record begins, where that is not with a virgin joint at the zero of what drives it.
fn begins(record: &Record, beginning: &Beginning, form: Form) -> Option<String> {
    let (drive, unit) = form.input();
    let (channel, _) = form.channels(record);
    let name = &record.name;
    let largest = channel.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let first = channel.first().copied().unwrap_or(0.0);
    if beginning.goes_on {
        return Some(format!(
            "Record {name}: the joint goes on where the record before left it."
        ));
    }
    if let Some(last) = beginning.turned.last() {
        let or_behind = match at_zero(channel) {
            true => ", or behind a load of which no record tells",
            false => "",
        };
        return Some(format!(
            "Record {name} begins in the middle of a test{or_behind}: its {drive} came from a turn at {} or so.",
            quantity(*last, unit)
        ));
    }
    if beginning.zero != 0.0 {
        return Some(format!(
            "Record {name} begins at rest at a {drive} of {}, which was taken for the zero of its sensor.",
            quantity(first, unit)
        ));
    }
    (first.abs() > NOT_ZERO * largest).then(|| {
        format!("Record {name} does not start at rest: its {drive} was taken to have come straight from zero.")
    })
}

/// Share of the largest reading below which the first one is zero.
const NOT_ZERO: f64 = 0.05;

/// What would settle an ambiguity.
pub fn next_experiment(findings: &Findings) -> Option<String> {
    let unclear = findings
        .causes
        .iter()
        .find(|c| !c.ambiguous_with.is_empty())?;
    let page = crate::causes::find(&unclear.name)?.page();
    Some(format!(
        "To tell {} from {}: {}",
        unclear.name,
        unclear.ambiguous_with.join(" and "),
        page.separated_by
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verbs_agree_with_the_count_of_causes() {
        let gain = (0.5, Some((0.4, 0.6)));
        let explained = |names| said(Verdict::Explained, names, gain, (0.0, ""));
        assert!(explained(("pinning", false)).starts_with("pinning explains"));
        assert!(
            explained(("creep and pinning", true)).starts_with("creep and pinning explain what")
        );
        let taken = partly(("creep and pinning", true), 0.5, gain.1);
        assert_eq!(
            taken,
            "creep and pinning take the held-out error to 0.50 of the baseline's"
        );
    }

    #[test]
    fn what_may_be_something_else_is_not_asserted() {
        let doubles = (0.1, "pinning: a specimen that settles");
        let text = said(
            Verdict::PartlyExplained,
            ("pinning", false),
            (0.5, None),
            doubles,
        );
        assert!(text.starts_with(
            "perhaps pinning, perhaps something that is not in the catalogue (pinning: a specimen that settles)."
        ));
        assert!(text.ends_with(". Pinning takes the held-out error to 0.50 of the baseline's."));
    }
}
