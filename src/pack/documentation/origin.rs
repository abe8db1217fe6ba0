//! Where the joint's numbers come from: records, date, verdict.

use crate::saved::{Judgement, Provenance, RecordUsed};
use quick_xml::escape::escape;
use std::fmt::Write as _;

/// The section; says so where no record stands behind the joint.
pub fn section(page: &mut String, provenance: &Provenance) {
    page.push_str("<h2>Where the numbers come from</h2>\n");
    if let Some(remark) = &provenance.remark {
        let _ = writeln!(page, "<p>{}</p>", escape(remark));
    }
    if let Some(verdict) = &provenance.verdict {
        let _ = writeln!(page, "<p>{}</p>", judgement(verdict));
    }
    let made: Vec<String> = [&provenance.tool, &provenance.date]
        .into_iter()
        .flatten()
        .map(|text| escape(text).into_owned())
        .collect();
    if !made.is_empty() {
        let _ = writeln!(page, "<p>Identified by {}.</p>", made.join(", "));
    }
    if provenance.records.is_empty() {
        page.push_str("<p>joint.json names no record: the numbers are given, not measured.</p>\n");
        return;
    }
    page.push_str(
        "<table>\n<tr><th>Record</th><th>Samples</th><th>Duration [s]</th>\
         <th>Samples per second</th><th>Largest force [N]</th><th>SHA-256 of the file</th></tr>\n",
    );
    for record in &provenance.records {
        page.push_str(&row(record));
    }
    page.push_str("</table>\n");
}

fn row(record: &RecordUsed) -> String {
    let (duration, rate) = match record.span {
        Some(span) => (
            format!("{:.6}", span.duration),
            format!("{:.6}", 1.0 / span.sample_interval),
        ),
        None => (String::new(), String::new()),
    };
    let force = record
        .largest_force
        .map_or(String::new(), |largest| format!("{largest:.6}"));
    format!(
        "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{duration}</td>\
         <td class=\"number\">{rate}</td><td class=\"number\">{force}</td><td><code>{}</code></td></tr>\n",
        escape(&record.name),
        record.samples,
        escape(&record.sha256),
    )
}

fn judgement(verdict: &Judgement) -> String {
    let mut text = format!("Verdict: <strong>{}</strong>.", escape(&verdict.word));
    if let Some(ratio) = verdict.held_out_rms_ratio {
        let _ = write!(
            text,
            " Error on data that no fit has seen, with the causes over without: {ratio:.3}"
        );
        if let Some((low, high)) = verdict.interval {
            let _ = write!(text, " (95 %: {low:.3} … {high:.3})");
        }
        text.push('.');
    }
    text
}
