//! The evidence of the candidates that were tried, as bars and in numbers.

use minijinja::context;
use minijinja::value::Value;

use super::quantity::{chi_squared, share};
use super::wording::in_words;
use crate::diagnose::Findings;
use crate::diagnose::findings::Candidate;
use crate::record::written::number;

/// Bars at most; the table beneath has all.
const MOST_BARS: usize = 14;

/// Bars of the strongest candidates; `None` where nothing was scored.
pub(super) fn bars(findings: &Findings) -> Option<Value> {
    let tried = tried(findings);
    let scored = tried.iter().filter(|c| c.evidence.is_finite());
    let scored: Vec<&Candidate> = scored.copied().collect();
    let shown = &scored[..scored.len().min(MOST_BARS)];
    if shown.is_empty() {
        return None;
    }
    let values = || shown.iter().map(|candidate| candidate.evidence);
    let (lowest, highest) = (values().fold(0.0, f64::min), values().fold(0.0, f64::max));
    let span = match highest - lowest {
        span if span > 0.0 => span,
        _ => 1.0,
    };
    let share = |value: f64| format!("{:.2}", 100.0 * (value - lowest) / span);
    let rows = shown.iter().map(|candidate| {
        let evidence = candidate.evidence;
        context! {
            name => in_words(&candidate.name),
            class => class(findings, &candidate.name),
            from => share(evidence.min(0.0)),
            width => format!("{:.2}", 100.0 * evidence.abs() / span),
            evidence => number(evidence, 3),
        }
    });
    let rest = match scored.len() - shown.len() {
        0 => String::new(),
        rest => format!(" {rest} weaker ones stand in the table."),
    };
    Some(context! {
        caption => format!(
            "Log evidence against the baseline: penalised for parameters and whitened; below zero the baseline is the better account.{rest}"
        ),
        zero => share(0.0),
        rows => rows.collect::<Vec<_>>(),
    })
}

fn class(findings: &Findings, name: &str) -> &'static str {
    let mut causes = findings.causes.iter();
    if causes.clone().any(|cause| cause.name == name) {
        "extended"
    } else if causes.any(|cause| cause.ambiguous_with.iter().any(|rival| rival == name)) {
        "ambiguous"
    } else {
        "measured"
    }
}

/// The candidates that were tried, strongest first; those without a score come last. What no record
/// of this kind can show was not tried: it has neither evidence nor probability.
fn tried(findings: &Findings) -> Vec<&Candidate> {
    let candidates = findings.candidates.iter();
    let mut tried: Vec<&Candidate> = candidates
        .filter(|c| c.evidence != 0.0 || c.probability != 0.0)
        .collect();
    let score = |candidate: &Candidate| match candidate.evidence {
        evidence if evidence.is_nan() => f64::NEG_INFINITY,
        evidence => evidence,
    };
    tried.sort_by(|a, b| score(b).total_cmp(&score(a)));
    tried
}

/// Candidates that were not tried, in words.
pub(super) fn untried(findings: &Findings) -> Vec<String> {
    let tried = tried(findings);
    let candidates = findings.candidates.iter();
    let untried = candidates.filter(|c| tried.iter().all(|tried| tried.name != c.name));
    untried.map(|c| in_words(&c.name)).collect()
}

/// Every candidate that was tried, in numbers.
pub(super) fn candidates(findings: &Findings) -> Vec<Value> {
    let optional = |value: Option<f64>| value.map_or("–".to_owned(), |value| number(value, 3));
    let tried = tried(findings);
    let rows = tried.iter().map(|candidate| {
        context! {
            name => in_words(&candidate.name),
            kind => candidate.kind,
            named => findings.causes.iter().any(|cause| cause.name == candidate.name),
            evidence => number(candidate.evidence, 3),
            probability => share(candidate.probability),
            lambda_sep => candidate.lambda_sep.map_or("–".to_owned(), chi_squared),
            held_out_gain => optional(candidate.held_out_gain),
        }
    });
    rows.collect()
}
