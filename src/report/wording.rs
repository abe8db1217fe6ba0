//! Sentences that the screen and the page share.

use super::quantity::share;
use crate::diagnose::Findings;
use crate::diagnose::findings::{NamedCause, Verdict};
use crate::record::written::{number, percent, quantity};

/// How the prediction of unseen data changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Change {
    /// Nothing was extended, or nothing was measured.
    None,
    /// Better, and the interval excludes no gain.
    Better,
    /// Better at best value only: the interval includes no gain, or there is none.
    PerhapsBetter,
    /// Worse than the baseline.
    Worse,
}

/// Judges the held-out ratio; where the ratio is no number, the two errors themselves.
pub(super) fn change(findings: &Findings) -> Change {
    let (given, interval) = findings.gain;
    let ratio = if given.is_finite() {
        given
    } else {
        findings.extended.held_out_rms / findings.baseline.held_out_rms
    };
    if ratio > 1.0 {
        Change::Worse
    } else if ratio.is_nan() || (ratio == 1.0 && findings.causes.is_empty()) {
        Change::None
    } else if interval.is_some_and(|(_, upper)| upper < 1.0) {
        Change::Better
    } else {
        Change::PerhapsBetter
    }
}

/// One word or two for the verdict.
pub(super) fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Clean => "Clean",
        Verdict::Explained => "Explained",
        Verdict::PartlyExplained => "Partly explained",
        Verdict::Unexplained => "Unexplained",
    }
}

/// The verdict in a sentence or two, names of causes in words.
pub(super) fn verdict_sentence(findings: &Findings) -> String {
    in_prose(&findings.summary)
}

/// What may be at work in the place of a named cause and is not in the catalogue.
pub(super) fn perhaps_instead(findings: &Findings, cause: &NamedCause) -> Option<String> {
    let own = format!("{}: ", cause.name);
    let doubles = findings.unexplained.doubles.iter();
    let clauses: Vec<&str> = doubles.filter_map(|d| d.strip_prefix(&own)).collect();
    (!clauses.is_empty()).then(|| {
        format!(
            "Perhaps something that is not in the catalogue instead: {}.",
            in_prose(&clauses.join("; "))
        )
    })
}

/// The warning that comes before everything else where the prediction got worse: of held-out cycles,
/// or of a record held out whole.
pub(super) fn worse_sentence(findings: &Findings) -> Option<String> {
    if change(findings) == Change::Worse {
        return Some(format!(
            "With the extension the prediction of unseen data got worse: {}. Keep the baseline joint.",
            error_step(findings)
        ));
    }
    let records = findings.left_out.iter();
    let worst = records
        .filter(|record| record.interval.map_or(record.ratio, |(lower, _)| lower) > WORSE)
        .max_by(|a, b| a.ratio.total_cmp(&b.ratio))?;
    Some(format!(
        "With the extension the prediction of record {}, held out whole, got worse: {} → {}, ratio {}.",
        worst.record,
        quantity(worst.before, &findings.unit),
        quantity(worst.after, &findings.unit),
        number(worst.ratio, 3)
    ))
}

/// Ratio of errors on a whole record beyond which it is predicted worse: one in a hundred is less
/// than anyone would see.
const WORSE: f64 = 1.01;

/// `held-out error 0.82 µm → 0.31 µm, ratio 0.380 (95 %: 0.330 … 0.440)`.
pub(super) fn error_step(findings: &Findings) -> String {
    format!(
        "held-out error {} → {}, ratio {}",
        quantity(findings.baseline.held_out_rms, &findings.unit),
        quantity(findings.extended.held_out_rms, &findings.unit),
        ratio(findings)
    )
}

/// The ratio after over before, with its interval.
pub(super) fn ratio(findings: &Findings) -> String {
    let (ratio, interval) = findings.gain;
    match interval {
        Some((lower, upper)) => format!(
            "{} (95 %: {} … {})",
            number(ratio, 3),
            number(lower, 3),
            number(upper, 3)
        ),
        None => format!("{} (no interval)", number(ratio, 3)),
    }
}

/// What the change of the held-out error means.
pub(super) fn gain_sentence(findings: &Findings) -> String {
    let fall = percent((1.0 - findings.gain.0).abs());
    match change(findings) {
        Change::None => "Nothing was added to the baseline joint.".to_owned(),
        Change::Better => format!("The error on unseen data falls by {fall}."),
        Change::PerhapsBetter if findings.verdict == Verdict::Explained => format!(
            "The error on unseen data falls by {fall}; its scatter from cycle to cycle does not exclude that it is none, but the samples are over forty times as likely by the causes."
        ),
        Change::PerhapsBetter => {
            format!("The error on unseen data falls by {fall}; the data do not prove a gain.")
        }
        Change::Worse => format!("The error on unseen data rises by {fall}."),
    }
}

/// How far the baseline misses the judged channel, against the noise.
pub(super) fn miss_sentence(findings: &Findings) -> String {
    let error = findings.baseline.held_out_rms;
    let noise = findings.noise.rms;
    let times = if noise > 0.0 && (error / noise).is_finite() {
        format!(
            ", {} × the noise of {}",
            number(error / noise, 2),
            quantity(noise, &findings.noise.unit)
        )
    } else {
        String::new()
    };
    format!(
        "The baseline misses the measured {} by {} rms on unseen data{times}.",
        findings.judged,
        quantity(error, &findings.unit)
    )
}

/// How far energy per cycle and stiffness are off before and after; empty where it was not computed.
pub(super) fn energy_sentence(findings: &Findings) -> String {
    let (before, after) = (&findings.baseline, &findings.extended);
    let of = |name: &str, before: Option<f64>, after: Option<f64>| match (before, after) {
        (Some(before), Some(after)) if !findings.causes.is_empty() => {
            format!(
                "{name} off by {} before, {} after.",
                share(before),
                share(after)
            )
        }
        (Some(before), _) => format!("{name} off by {}.", share(before)),
        _ => String::new(),
    };
    let said = [
        of(
            "Energy per cycle",
            before.dissipation_error,
            after.dissipation_error,
        ),
        of("Stiffness", before.stiffness_error, after.stiffness_error),
    ];
    said.join(" ").trim().to_owned()
}

/// Records held out whole, before and after; empty for a single record.
pub(super) fn left_out_sentence(findings: &Findings) -> String {
    let records = findings.left_out.iter().map(|record| {
        let unit = &findings.unit;
        let (before, after) = (quantity(record.before, unit), quantity(record.after, unit));
        match findings.causes.is_empty() {
            true => format!("{} {before}", record.record),
            false => format!("{} {before} → {after}", record.record),
        }
    });
    let records: Vec<String> = records.collect();
    match records.is_empty() {
        true => String::new(),
        false => format!("Records held out whole: {}.", records.join(", ")),
    }
}

/// What the cause changes and how surely it is there.
pub(super) fn weight_sentence(cause: &NamedCause) -> String {
    format!(
        "Changes {} of the dissipated energy; without it the misfit rises by {} noise variances.",
        share(cause.matters),
        number(cause.evidence, 3)
    )
}

/// Times the noise as it is told that a clean joint's baseline may leave in rms before it is said that slow noise was
/// granted: of the hundred clean records of card 20270112 none left 1.4 on unseen data (`baseline_over_noise` over
/// `noise_stated_over_true` of its marks).
const SLOW_NOISE: f64 = 2.0;

/// The rest, as a share of what could be explained.
pub(super) fn rest_sentence(findings: &Findings) -> String {
    if findings.verdict == Verdict::Clean {
        let times = findings.baseline.train_rms / findings.noise.rms;
        return match times > SLOW_NOISE {
            true => format!(
                "Nothing that stands out of slow noise: what is left is {} times the noise that is told by its fast \
                 part, and too few cycles repeat to part slow noise from an effect.",
                number(times, 2)
            ),
            false => "Nothing beyond the noise.".to_owned(),
        };
    }
    let beyond = match findings.verdict {
        Verdict::Explained => " beyond what noise may leave",
        _ => "",
    };
    format!(
        "{} of the explainable misfit is left{beyond}.",
        share(findings.unexplained.share)
    )
}

/// `sensor_delay` as `sensor delay`, `running_in` as the noun that it is.
pub(super) fn in_words(name: &str) -> String {
    name.replace("running_in", "running-in").replace('_', " ")
}

/// Where structure is left, what is said of one stretch put together: several bins may lie in it.
pub(super) fn places(findings: &Findings) -> Vec<String> {
    const SHARE: &str = " % of the structure";
    let mut places: Vec<(&str, Option<u32>)> = Vec::new();
    for place in &findings.unexplained.places {
        let share = place.strip_suffix(SHARE).and_then(|p| p.rsplit_once(": "));
        let share = share.and_then(|(stretch, share)| Some((stretch, share.parse().ok()?)));
        let (stretch, share) =
            share.map_or((place.as_str(), None), |(s, n): (_, u32)| (s, Some(n)));
        match places.iter_mut().find(|(known, _)| *known == stretch) {
            Some((_, sum)) => *sum = sum.zip(share).map(|(sum, share)| sum + share),
            None => places.push((stretch, share)),
        }
    }
    let said = places.into_iter().map(|(stretch, share)| match share {
        Some(share) => format!("{stretch}: {share}{SHARE}"),
        None => stretch.to_owned(),
    });
    said.collect()
}

/// Whether amplitude tables were diagnosed: they are judged in no channel of a time history.
pub(super) fn of_tables(findings: &Findings) -> bool {
    !["displacement", "force"].contains(&findings.judged.as_str())
}

/// What the rows of a record are.
pub(super) fn rows(findings: &Findings) -> &'static str {
    match of_tables(findings) {
        true => "levels",
        false => "samples",
    }
}

/// The first letter raised.
pub(super) fn capital(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(rest).collect()
    })
}

/// A sentence with the names of causes and parameters in words: `tell running_in from creep` →
/// `tell running-in from creep`. Symbols (`F_S`) and names of files stay.
pub(super) fn in_prose(sentence: &str) -> String {
    let mut prose = String::with_capacity(sentence.len());
    let mut rest = sentence;
    while !rest.is_empty() {
        let within = |c: char| c.is_alphanumeric() || c == '_';
        let end = rest.find(|c| !within(c)).unwrap_or(rest.len());
        if end == 0 {
            let first = rest.chars().next().map_or(0, char::len_utf8);
            prose.push_str(&rest[..first]);
            rest = &rest[first..];
            continue;
        }
        let (word, more) = rest.split_at(end);
        let file = more.strip_prefix('.').is_some_and(|ending| {
            let mut letters = ending.chars();
            letters.next().is_some_and(|c| c.is_ascii_lowercase())
        });
        let named = word
            .split('_')
            .all(|part| part.len() > 1 && part.chars().all(|c| c.is_ascii_lowercase()));
        prose.push_str(&match named && !file {
            true => in_words(word),
            false => word.to_owned(),
        });
        rest = more;
    }
    prose
}

#[cfg(test)]
mod tests {
    use super::in_prose;

    #[test]
    fn names_stand_in_words_in_prose() {
        assert_eq!(
            in_prose(
                "To show preload_loss, running_in: run next_experiment.csv; F_S and K_1 stay."
            ),
            "To show preload loss, running-in: run next_experiment.csv; F_S and K_1 stay."
        );
    }
}
