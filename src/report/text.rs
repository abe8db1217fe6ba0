//! What the engineer reads on the screen: fixed sections, the verdict first, a screenful at most.

use super::outlook;
use super::quantity::estimate;
use super::wording;
use crate::diagnose::Findings;
use crate::diagnose::findings::{Estimate, NamedCause};
use crate::record::written::quantity;

/// Lines at most; what does not fit is counted and stands in diagnosis.json.
const MOST_LINES: usize = 40;
/// Columns at most, where words allow.
const WIDTH: usize = 96;
/// Columns of the labels at the left.
const LABEL: usize = 15;

/// The findings as plain text of at most 40 lines, ending in a line break.
///
/// The first line is the verdict, or that the prediction of unseen data got worse.
pub fn render(findings: &Findings) -> String {
    let mut sections = vec![verdict(findings), wrong(findings)];
    sections.extend(causes(findings));
    sections.extend([
        gain(findings),
        left(findings),
        sentences("Dummy", &outlook::dummy(findings)),
        sentences("Correction", &outlook::correction_sentence(findings)),
        joint(findings),
        sentences("Cannot show", &findings.not_identifiable),
        next(findings),
        sentences("Notes", &findings.notes),
        records(findings),
    ]);
    sections.retain(|section| !section.lines.is_empty());
    shorten(&mut sections);
    let mut page = String::new();
    for section in &sections {
        for (row, line) in section.lines.iter().enumerate() {
            let label = if row == 0 { section.label } else { "" };
            let text = if section.full_width {
                line.clone()
            } else {
                format!("{label:LABEL$}{line}")
            };
            page.push_str(text.trim_end());
            page.push('\n');
        }
    }
    page
}

/// One block of the page.
struct Section {
    label: &'static str,
    lines: Vec<String>,
    /// Lines that must stay, from the first on.
    kept: usize,
    full_width: bool,
}

impl Section {
    fn new(label: &'static str, lines: Vec<String>) -> Section {
        Section {
            label,
            kept: 1,
            lines,
            full_width: false,
        }
    }
}

/// Takes lines from the longest sections until the page fits, saying how many.
fn shorten(sections: &mut [Section]) {
    let total: usize = sections.iter().map(|section| section.lines.len()).sum();
    let mut excess = total.saturating_sub(MOST_LINES);
    let mut taken = vec![0; sections.len()];
    while excess > 0 {
        // A section that loses its first line gains the line that says so: take two then.
        let longest = (0..sections.len())
            .filter(|&i| sections[i].lines.len() - taken[i] > sections[i].kept + 1)
            .max_by_key(|&i| sections[i].lines.len() - taken[i]);
        let Some(longest) = longest else { break };
        if taken[longest] == 0 {
            taken[longest] = 2;
        } else {
            taken[longest] += 1;
        }
        excess -= 1;
    }
    for (section, taken) in sections.iter_mut().zip(taken) {
        if taken > 0 {
            section.lines.truncate(section.lines.len() - taken);
            section
                .lines
                .push(format!("… {taken} lines more: see diagnosis.json"));
        }
    }
}

fn verdict(findings: &Findings) -> Section {
    let word = wording::verdict_word(findings.verdict).to_uppercase();
    let mut lines = Vec::new();
    if let Some(warning) = wording::worse_sentence(findings) {
        lines.extend(wrap(&format!("WORSE. {warning}"), WIDTH));
    }
    let sentence = wording::verdict_sentence(findings);
    lines.extend(wrap(&format!("{word}. {sentence}"), WIDTH));
    let kept = lines.len();
    if findings.summary != sentence {
        lines.extend(wrap(&findings.summary, WIDTH));
    }
    Section {
        label: "",
        lines,
        kept,
        full_width: true,
    }
}

fn wrong(findings: &Findings) -> Section {
    Section::new("What is wrong", column(&wording::miss_sentence(findings)))
}

fn causes(findings: &Findings) -> Vec<Section> {
    findings.causes.iter().map(cause).collect()
}

fn cause(cause: &NamedCause) -> Section {
    let mut lines = vec![format!("{} ({})", cause.name, cause.kind)];
    if !cause.ambiguous_with.is_empty() {
        lines.extend(column(&format!(
            "not to be told from: {}",
            cause.ambiguous_with.join(", ")
        )));
    }
    let kept = lines.len();
    lines.extend(table(&cause.present()));
    lines.extend(column(&wording::weight_sentence(cause)));
    Section {
        kept,
        ..Section::new("Cause", lines)
    }
}

fn gain(findings: &Findings) -> Section {
    let mut lines = column(&wording::gain_sentence(findings));
    if wording::change(findings) != wording::Change::None {
        lines.extend(column(&wording::capital(&format!(
            "{}.",
            wording::error_step(findings)
        ))));
    }
    let energy = wording::energy_sentence(findings);
    lines.extend(column(&energy));
    lines.extend(column(&wording::left_out_sentence(findings)));
    Section {
        kept: 2,
        ..Section::new("Gain", lines)
    }
}

fn left(findings: &Findings) -> Section {
    let mut lines = column(&format!(
        "{} Noise {}: {}.",
        wording::rest_sentence(findings),
        quantity(findings.noise.rms, &findings.noise.unit),
        findings.noise.method
    ));
    lines.extend(
        findings
            .unexplained
            .places
            .iter()
            .flat_map(|place| bullet(place)),
    );
    Section::new("What remains", lines)
}

fn joint(findings: &Findings) -> Section {
    Section::new("Joint", table(&findings.joint_parameters))
}

fn next(findings: &Findings) -> Section {
    let experiment = findings.next_experiment.as_deref().unwrap_or("");
    Section::new("Next", column(experiment))
}

fn records(findings: &Findings) -> Section {
    let names = findings.records.iter();
    let names: Vec<String> = names
        .map(|(name, samples, _)| format!("{name} ({samples} samples)"))
        .collect();
    Section::new("Records", column(&names.join(", ")))
}

fn sentences(label: &'static str, sentences: &[String]) -> Section {
    let lines = sentences.iter().flat_map(|sentence| bullet(sentence));
    Section::new(label, lines.collect())
}

/// Name, value and error of each estimate, in columns.
fn table(estimates: &[Estimate]) -> Vec<String> {
    let rows: Vec<_> = estimates
        .iter()
        .map(|row| (row.name.as_str(), estimate(row)))
        .collect();
    let name = rows
        .iter()
        .map(|(name, _)| name.chars().count())
        .max()
        .unwrap_or(0);
    let value = rows
        .iter()
        .map(|(_, shown)| shown.value.chars().count())
        .max()
        .unwrap_or(0);
    rows.iter()
        .map(|(label, shown)| format!("{label:name$}  {:>value$}  {}", shown.value, shown.error))
        .collect()
}

/// Text wrapped to what the labels leave.
fn column(text: &str) -> Vec<String> {
    wrap(text, WIDTH - LABEL)
}

/// One item of a list, its further lines indented.
fn bullet(text: &str) -> Vec<String> {
    let lines = wrap(text, WIDTH - LABEL - 2).into_iter().enumerate();
    lines
        .map(|(row, line)| format!("{} {line}", if row == 0 { '-' } else { ' ' }))
        .collect()
}

/// Text broken at white space into lines of at most `width` characters, where words allow.
fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}
