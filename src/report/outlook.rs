//! What lies beyond the verdict, as values for the page's template.

use minijinja::context;
use minijinja::value::Value;

use super::quantity::chi_squared;
use super::wording::{in_prose, in_words};
use crate::diagnose::Findings;
use crate::diagnose::experiment::Dummy;
use crate::diagnose::experiment::dummy::Ruling;
use crate::diagnose::experiment::separability::TOLD;
use crate::record::written::{number, percent, quantity};

/// Blocks of the next experiment, in words.
pub(super) fn blocks(findings: &Findings) -> Vec<String> {
    let experiment = findings.outlook.experiment.as_ref();
    experiment.map_or(Vec::new(), |e| {
        e.blocks.iter().map(|block| in_prose(block)).collect()
    })
}

/// The map of what is mistaken for what, the hardest to tell first.
pub(super) fn separability(findings: &Findings) -> Vec<Value> {
    let mut lines: Vec<_> = findings.outlook.separability.iter().collect();
    lines.sort_by(|a, b| a.lambda.total_cmp(&b.lambda));
    let rows = lines.into_iter().map(|line| {
        let rivals = line.rivals.iter().map(|(name, left)| {
            let name = match name.as_str() {
                "none" => "the baseline".to_owned(),
                name => in_words(name),
            };
            format!("{name} ({})", chi_squared(*left))
        });
        context! {
            name => in_words(&line.name),
            fitted => line.fitted,
            hidden => line.lambda < TOLD,
            lambda => chi_squared(line.lambda),
            baseline => chi_squared(line.baseline),
            rivals => rivals.collect::<Vec<_>>().join(", "),
        }
    });
    rows.collect()
}

/// What the dummy says, a sentence per cause, and one for all that it does not show.
pub(super) fn dummy(findings: &Findings) -> Vec<String> {
    let lines = findings.outlook.dummy.iter();
    let (absent, lines): (Vec<&Dummy>, Vec<&Dummy>) =
        lines.partition(|line| line.ruling == Ruling::Absent);
    lines
        .into_iter()
        .filter_map(|line| {
            let (name, fall) = (in_words(&line.name), number(line.fall, 3));
            let power = number(line.power, 3);
            let sentence = match line.ruling {
                Ruling::Shown => format!("{name}: the dummy shows it (its misfit falls by {fall}); it belongs to the measuring chain."),
                Ruling::Excluded => format!("{name}: excluded; as large as the records need it, it would leave a χ² of {power} on the dummy, which falls by {fall} only."),
                Ruling::Open => format!("{name}: open; the dummy cannot tell (χ² {power})."),
                Ruling::Slips => format!("the dummy is no solid specimen: its loop slips as a joint's does (its misfit falls by {fall} with a joint's law, by {power} with the best cause of the measuring chain), so that nothing it shows is sure to be the chain's."),
                Ruling::Absent => return None,
            };
            Some(sentence)
        })
        .chain(shows_none(&absent))
        .collect()
}

/// That the dummy shows none of these; nothing of nothing.
fn shows_none(absent: &[&Dummy]) -> Option<String> {
    let names: Vec<String> = absent.iter().map(|line| in_words(&line.name)).collect();
    let most = absent.iter().map(|line| line.fall).reduce(f64::max)?;
    Some(format!(
        "the dummy shows none of {} (its misfit falls by {} at most).",
        names.join(", "),
        number(most, 3)
    ))
}

/// What the learned correction does, in a sentence; none where there is none.
pub(super) fn correction_sentence(findings: &Findings) -> Vec<String> {
    let correction = findings.outlook.correction.as_ref();
    let sentence = correction.map(|correction| {
        format!(
            "What no cause explains can be predicted in part from the record itself: added to the model it takes the error on unseen data to {} (95 %: {} to {}). It names nothing and enters no joint.",
            percent(correction.ratio),
            percent(correction.interval.0),
            percent(correction.interval.1),
        )
    });
    sentence.into_iter().collect()
}

/// The learned correction.
pub(super) fn correction(findings: &Findings) -> Option<Value> {
    let correction = findings.outlook.correction.as_ref()?;
    let terms = correction.terms.iter().map(|(feature, size)| {
        context! { feature, size => quantity(*size, &correction.unit) }
    });
    Some(context! {
        sentence => correction_sentence(findings).concat(),
        terms => terms.collect::<Vec<_>>(),
    })
}
