//! What stands on the page, as values for its template.

use minijinja::context;
use minijinja::value::Value;

use super::CausePage;
use super::compared::errors;
use super::plots::Figure;
use super::quantity::estimate;
use super::symbols::marked_up;
use super::wording;
use crate::diagnose::Findings;
use crate::diagnose::findings::{Candidate, Estimate, NamedCause, Verdict};
use crate::record::written::{number, percent, quantity};

/// Verdict, warning and the figures that sum the page up.
pub(super) fn banner(findings: &Findings) -> Value {
    let worse = wording::worse_sentence(findings);
    let sentence = wording::verdict_sentence(findings);
    context! {
        class => if worse.is_some() { "worse" } else { findings.verdict.name() },
        word => wording::verdict_word(findings.verdict),
        summary => (findings.summary != sentence).then_some(&findings.summary),
        sentence => sentence,
        worse => worse,
        tiles => tiles(findings),
    }
}

fn tiles(findings: &Findings) -> Vec<Value> {
    let tile = |label: &str, value: String, under: String| context! { label, value, under };
    let unit = &findings.unit;
    let mut tiles = vec![tile(
        "Error on unseen data, baseline",
        quantity(findings.baseline.held_out_rms, unit),
        format!("rms of the {}", findings.judged),
    )];
    if !findings.causes.is_empty() {
        tiles.push(tile(
            "Error on unseen data, extended",
            quantity(findings.extended.held_out_rms, unit),
            format!("ratio {}", wording::ratio(findings)),
        ));
    }
    tiles.push(tile(
        "Noise",
        quantity(findings.noise.rms, &findings.noise.unit),
        findings.noise.method.clone(),
    ));
    // A clean record has no misfit of which a share could be left.
    if findings.verdict != Verdict::Clean {
        tiles.push(tile(
            "Left unexplained",
            percent(findings.unexplained.share),
            "of the explainable misfit".to_owned(),
        ));
    }
    tiles
}

/// One card per named cause, with its page and those of its rivals where given.
pub(super) fn causes(findings: &Findings, pages: &[CausePage]) -> Vec<Value> {
    let cards = findings.causes.iter();
    cards.map(|cause| card(cause, pages)).collect()
}

fn card(cause: &NamedCause, pages: &[CausePage]) -> Value {
    let page_of = |name: &str| pages.iter().find(|page| page.name == name);
    let rivals = cause.ambiguous_with.iter().map(|name| {
        context! {
            words => wording::in_words(name),
            happens => page_of(name).map(|page| &page.happens),
        }
    });
    context! {
        name => cause.name,
        title => wording::capital(&wording::in_words(&cause.name)),
        kind => cause.kind,
        part => if cause.kind == "measurement" {
            "removed from the record, not part of the joint"
        } else {
            "part of the joint and of the exported unit"
        },
        weight => wording::weight_sentence(cause),
        parameters => estimates(&cause.present()),
        rivals => rivals.collect::<Vec<_>>(),
        page => page_of(&cause.name).map(|page| context! {
            happens => page.happens,
            sign => page.sign,
            mistaken_for => page.mistaken_for.iter().map(|name| wording::in_words(name)).collect::<Vec<_>>(),
            separated_by => page.separated_by,
            formula => marked_up(&page.formula),
            source => page.source,
        }),
    }
}

/// Errors before and after.
pub(super) fn gain(findings: &Findings) -> Value {
    let unit = &findings.unit;
    let mut rows = vec![errors("Baseline joint", &findings.baseline, unit)];
    if !findings.causes.is_empty() {
        rows.push(errors("Extended joint", &findings.extended, unit));
    }
    context! {
        miss => wording::miss_sentence(findings),
        sentence => wording::gain_sentence(findings),
        judged => findings.judged,
        ratio => (!findings.causes.is_empty()).then(|| wording::ratio(findings)),
        rows => rows,
        noise => quantity(findings.noise.rms, &findings.noise.unit),
        method => findings.noise.method,
        autoregression => number(findings.noise.autoregression, 2),
        effective => number(findings.noise.effective_samples.round(), 4),
        rest => wording::rest_sentence(findings),
        places => findings.unexplained.places,
    }
}

/// Rows of a table of parameters.
pub(super) fn estimates(estimates: &[Estimate]) -> Vec<Value> {
    let rows = estimates.iter().map(|row| {
        let shown = estimate(row);
        context! {
            name => wording::in_words(&row.name),
            value => shown.value,
            error => shown.error,
            interval => shown.interval,
        }
    });
    rows.collect()
}

/// The whole catalogue, strongest first.
pub(super) fn candidates(findings: &Findings) -> Vec<Value> {
    let mut ranked: Vec<&Candidate> = findings.candidates.iter().collect();
    // Candidates without a score come last.
    let score = |candidate: &Candidate| {
        if candidate.evidence.is_nan() {
            f64::NEG_INFINITY
        } else {
            candidate.evidence
        }
    };
    ranked.sort_by(|a, b| score(b).total_cmp(&score(a)));
    let named = |candidate: &Candidate| {
        let mut causes = findings.causes.iter();
        causes.any(|cause| cause.name == candidate.name)
    };
    let optional = |value: Option<f64>| value.map_or("–".to_owned(), |value| number(value, 3));
    let rows = ranked.into_iter().map(|candidate| {
        context! {
            name => wording::in_words(&candidate.name),
            kind => candidate.kind,
            named => named(candidate),
            evidence => number(candidate.evidence, 3),
            probability => percent(candidate.probability),
            lambda_sep => optional(candidate.lambda_sep),
            held_out_gain => optional(candidate.held_out_gain),
        }
    });
    rows.collect()
}

/// Records with their sizes and hashes.
pub(super) fn records(findings: &Findings) -> Vec<Value> {
    let records = findings.records.iter();
    records
        .map(|(name, samples, hash)| context! { name, samples, hash })
        .collect()
}

/// A figure; its drawing is markup of our own and goes in as it is.
pub(super) fn figure(figure: &Figure) -> Value {
    let keys = figure.keys.iter();
    context! {
        title => figure.title,
        caption => figure.caption,
        wide => figure.wide,
        keys => keys.map(|(class, label)| context! { class, label }).collect::<Vec<_>>(),
        svg => Value::from_safe_string(figure.svg.clone()),
    }
}
