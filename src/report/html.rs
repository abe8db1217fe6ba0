//! `report.html`: one page that needs nothing else, with the plots inline.

use minijinja::value::Value;
use minijinja::{Environment, UndefinedBehavior, context};

use std::sync::Arc;

use super::glossary::{self, Glossary};
use super::symbols::marked_up;
use super::wording::{in_prose, rows};
use super::{CausePage, ReportError, compared, confusion, content, evidence, outlook, plots};
use crate::diagnose::Findings;

/// Named `.html`, so that every value is escaped.
const TEMPLATE: &str = "report.html";

/// The findings as a self-contained page; `pages` explain the causes and may be incomplete.
///
/// # Errors
/// [`ReportError`], which is a defect of this program and never of the findings: numbers that are
/// not finite are shown as `not determined` and left out of plots.
pub fn render(findings: &Findings, pages: &[CausePage]) -> Result<String, ReportError> {
    let mut environment = Environment::new();
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    environment.set_trim_blocks(true);
    environment.set_lstrip_blocks(true);
    let glossary = Arc::new(Glossary::default());
    environment.add_filter("explained", move |text: String| glossary.linked(&text));
    environment.add_template(TEMPLATE, include_str!("report.html"))?;
    let mut records = Vec::new();
    for curves in &findings.curves {
        let figures = plots::of_record(findings, curves)?;
        if figures.is_empty() && !curves.cycles.is_empty() {
            // An amplitude table: its levels are drawn together.
            continue;
        }
        records.push(context! {
            name => curves.name,
            figures => figures.iter().map(content::figure).collect::<Vec<_>>(),
        });
    }
    let page = environment.get_template(TEMPLATE)?.render(context! {
        style => Value::from_safe_string(include_str!("report.css").to_owned()),
        version => env!("CARGO_PKG_VERSION"),
        names => findings.records.iter().map(|(name, ..)| name).collect::<Vec<_>>(),
        banner => content::banner(findings),
        causes => content::causes(findings, pages),
        perhaps => !findings.unexplained.doubles.is_empty(),
        gain => content::gain(findings),
        level_figures => plots::levels(findings)?.iter().map(content::figure).collect::<Vec<_>>(),
        levels => compared::levels(findings),
        levels_left => compared::levels_left(findings),
        passed => compared::passed(findings),
        left_out => compared::left_out(findings),
        plots => records,
        evidence => evidence::bars(findings),
        candidates => evidence::candidates(findings),
        untried => evidence::untried(findings),
        parameters => content::joint_parameters(findings),
        not_identifiable => findings.not_identifiable.iter().map(|s| marked_up(&in_prose(s))).collect::<Vec<_>>(),
        next_experiment => findings.next_experiment.as_deref().map(in_prose),
        blocks => outlook::blocks(findings),
        map => confusion::map(findings),
        separability => outlook::separability(findings),
        dummy => outlook::dummy(findings),
        correction => outlook::correction(findings),
        rows => rows(findings),
        words => glossary::terms(),
        records => content::records(findings),
        notes => findings.notes,
    })?;
    Ok(page)
}
