//! What stands on the page, as values for its template.

use minijinja::context;
use minijinja::value::Value;

use super::CausePage;
use super::compared::errors;
use super::plots::Figure;
use super::quantity::{estimate, share};
use super::symbols::marked_up;
use super::wording;
use crate::diagnose::Findings;
use crate::diagnose::findings::{Estimate, NamedCause, Verdict};
use crate::record::written::{number, quantity};

/// Verdict, warning and the figures that sum the page up.
pub(super) fn banner(findings: &Findings) -> Value {
    let worse = wording::worse_sentence(findings);
    context! {
        class => if worse.is_some() { "worse" } else { findings.verdict.name() },
        word => wording::verdict_word(findings.verdict),
        sentence => wording::verdict_sentence(findings),
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
            share(findings.unexplained.share),
            "of the explainable misfit".to_owned(),
        ));
    }
    tiles
}

/// One card per named cause, with its page and those of its rivals where given.
pub(super) fn causes(findings: &Findings, pages: &[CausePage]) -> Vec<Value> {
    let cards = findings.causes.iter();
    cards.map(|cause| card(findings, cause, pages)).collect()
}

fn card(findings: &Findings, cause: &NamedCause, pages: &[CausePage]) -> Value {
    let page_of = |name: &str| pages.iter().find(|page| page.name == name);
    let rivals = cause.ambiguous_with.iter().map(|name| {
        context! {
            words => wording::in_words(name),
            happens => page_of(name).map(|page| &page.happens),
        }
    });
    let perhaps = wording::perhaps_instead(findings, cause);
    context! {
        name => cause.name,
        perhaps => perhaps,
        title => wording::capital(&wording::in_words(&cause.name)),
        kind => cause.kind,
        part => if cause.kind == "measurement" {
            "removed from the record, not part of the joint"
        } else {
            "part of the joint and of the exported unit"
        },
        weight => wording::weight_sentence(cause),
        parameters => estimates(&cause.present(), |name| law_symbol(findings, &cause.name, name)),
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
        effective => count(findings.noise.effective_samples),
        of_tables => wording::of_tables(findings),
        rest => wording::rest_sentence(findings),
        places => wording::places(findings),
    }
}

/// A count as it is: `6242`.
fn count(value: f64) -> String {
    match value.is_finite() {
        true => format!("{value:.0}"),
        false => number(value, 3),
    }
}

/// The letter of a parameter in the law of a cause of the joint. Causes of the measuring chain have left
/// the joint, and their letters with them.
fn law_symbol(findings: &Findings, cause: &str, parameter: &str) -> Option<&'static str> {
    let mut effects = findings.joint.effects.iter();
    let law = effects.find(|acting| acting.effect.name() == cause)?;
    let mut glossary = law.effect.parameters().iter();
    glossary
        .find(|entry| entry.name == parameter)
        .map(|entry| entry.symbol)
}

/// The letters of SAND2001-0811 for the joint's own parameters.
fn joint_symbol(parameter: &str) -> Option<&'static str> {
    match parameter {
        "slip_force" => Some("F_S"),
        "exponent" => Some("chi"),
        "dissipation_coefficient" => Some("ϑ"),
        _ => None,
    }
}

/// Rows of the joint's own parameters.
pub(super) fn joint_parameters(findings: &Findings) -> Vec<Value> {
    estimates(&findings.joint_parameters, joint_symbol)
}

/// Rows of a table of parameters, each with the letter that its law has for it.
fn estimates(estimates: &[Estimate], symbol: impl Fn(&str) -> Option<&'static str>) -> Vec<Value> {
    let rows = estimates.iter().map(|row| {
        let shown = estimate(row);
        context! {
            name => wording::in_words(&row.name),
            symbol => symbol(&row.name).map(marked_up),
            value => marked_up(&shown.value),
            error => marked_up(&shown.error),
            interval => marked_up(&shown.interval),
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
        narrow => figure.narrow.clone().map(Value::from_safe_string),
    }
}
