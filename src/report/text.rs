//! What the engineer reads on the screen: fixed sections, the verdict first, a screenful at most.

use super::outlook;
use super::quantity::estimate;
use super::wording;
use crate::diagnose::Findings;
use crate::diagnose::findings::{Estimate, NamedCause};
use crate::record::written::quantity;

/// Lines at most, named causes apart; what does not fit is counted and stands in diagnosis.json.
const MOST_LINES: usize = 40;
/// Columns at most, where words allow.
const WIDTH: usize = 96;
/// Columns of the labels at the left.
const LABEL: usize = 15;

/// The findings as plain text of at most 40 lines (more only where named causes alone are longer), ending in a
/// line break.
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
    /// Counts of lines that belong together (a sentence, an item, a row), in order.
    items: Vec<usize>,
    /// Items that must stay, from the first on.
    kept: usize,
    full_width: bool,
}

impl Section {
    /// A section of one item.
    fn new(label: &'static str, lines: Vec<String>) -> Section {
        Section::of(label, vec![lines])
    }

    /// A section of items that stay whole or go whole.
    fn of(label: &'static str, items: Vec<Vec<String>>) -> Section {
        let items: Vec<Vec<String>> = items.into_iter().filter(|item| !item.is_empty()).collect();
        Section {
            label,
            items: items.iter().map(Vec::len).collect(),
            kept: 1,
            lines: items.into_iter().flatten().collect(),
            full_width: false,
        }
    }

    /// The same section, all of which must stay.
    fn whole(mut self) -> Section {
        self.kept = self.items.len();
        self
    }

    /// Lines of items that may go.
    fn spare(&self) -> usize {
        self.items.iter().skip(self.kept).sum()
    }
}

/// Takes items from the longest sections, the last ones first, until the page fits, saying how many. No
/// sentence is cut, and named causes stay whole: of many a page is longer.
fn shorten(sections: &mut [Section]) {
    let total: usize = sections.iter().map(|section| section.lines.len()).sum();
    let mut excess = total.saturating_sub(MOST_LINES) as i64;
    let mut taken = vec![0; sections.len()];
    while excess > 0 {
        // The first item taken from a section makes room for the line that says so.
        let longest = (0..sections.len())
            .filter(|&i| sections[i].spare() > usize::from(taken[i] == 0))
            .max_by_key(|&i| sections[i].lines.len());
        let Some(longest) = longest else { break };
        let section = &mut sections[longest];
        let count = section.items.pop().unwrap_or(0);
        section.lines.truncate(section.lines.len() - count);
        excess -= count as i64 - i64::from(taken[longest] == 0);
        taken[longest] += 1;
    }
    for (section, taken) in sections.iter_mut().zip(taken) {
        if taken > 0 {
            section
                .lines
                .push(format!("… {taken} more in diagnosis.json"));
        }
    }
}

fn verdict(findings: &Findings) -> Section {
    let word = wording::verdict_word(findings.verdict).to_uppercase();
    let warning = wording::worse_sentence(findings);
    let warning = warning.map(|warning| wrap(&format!("WORSE. {warning}"), WIDTH));
    let sentence = format!("{word}. {}", wording::verdict_sentence(findings));
    let items = warning.into_iter().chain([wrap(&sentence, WIDTH)]);
    Section {
        full_width: true,
        ..Section::of("", items.collect()).whole()
    }
}

fn wrong(findings: &Findings) -> Section {
    Section::new("What is wrong", column(&wording::miss_sentence(findings)))
}

fn causes(findings: &Findings) -> Vec<Section> {
    let causes = findings.causes.iter();
    causes.map(|one| cause(one, findings)).collect()
}

/// The name as programs know it, once; in the sentences it stands in words.
fn cause(cause: &NamedCause, findings: &Findings) -> Section {
    let mut items = vec![vec![format!("{} ({})", cause.name, cause.kind)]];
    if !cause.ambiguous_with.is_empty() {
        let rivals = cause.ambiguous_with.iter();
        let rivals: Vec<String> = rivals.map(|name| wording::in_words(name)).collect();
        items.push(column(&format!(
            "not to be told from: {}",
            rivals.join(", ")
        )));
    }
    if let Some(perhaps) = wording::perhaps_instead(findings, cause) {
        items.push(column(&perhaps));
    }
    items.extend(table(&cause.present()));
    items.push(column(&wording::weight_sentence(cause)));
    Section::of("Cause", items).whole()
}

fn gain(findings: &Findings) -> Section {
    let mut items = vec![column(&wording::gain_sentence(findings))];
    if wording::change(findings) != wording::Change::None {
        items.push(column(&wording::capital(&format!(
            "{}.",
            wording::error_step(findings)
        ))));
    }
    items.push(column(&wording::energy_sentence(findings)));
    items.push(column(&wording::left_out_sentence(findings)));
    Section {
        kept: 2,
        ..Section::of("Gain", items)
    }
}

fn left(findings: &Findings) -> Section {
    let mut items = vec![column(&format!(
        "{} Noise {}: {}.",
        wording::rest_sentence(findings),
        quantity(findings.noise.rms, &findings.noise.unit),
        findings.noise.method
    ))];
    let places = wording::places(findings).into_iter();
    items.extend(places.map(|place| bullet(&place)));
    Section::of("What remains", items)
}

fn joint(findings: &Findings) -> Section {
    Section::of("Joint", table(&findings.joint_parameters))
}

fn next(findings: &Findings) -> Section {
    let experiment = findings.next_experiment.as_deref().unwrap_or("");
    Section::new("Next", column(&wording::in_prose(experiment)))
}

fn records(findings: &Findings) -> Section {
    let names = findings.records.iter();
    let names: Vec<String> = names
        .map(|(name, count, _)| format!("{name} ({count} {})", wording::rows(findings)))
        .collect();
    Section::new("Records", column(&names.join(", ")))
}

fn sentences(label: &'static str, sentences: &[String]) -> Section {
    let items = sentences.iter().map(|sentence| match label {
        // Notes name records, whose names are not ours to change.
        "Notes" => bullet(sentence),
        _ => bullet(&wording::in_prose(sentence)),
    });
    Section::of(label, items.collect())
}

/// Name, value and error of each estimate, in columns; a row is an item.
fn table(estimates: &[Estimate]) -> Vec<Vec<String>> {
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
        .map(|(label, shown)| {
            let row = format!("{label:name$}  {:>value$}  {}", shown.value, shown.error);
            vec![row]
        })
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
    // A number and its sign stay on one line.
    let text = text.replace(" %", "\u{a0}%").replace(" ×", "\u{a0}×");
    for word in text.split_ascii_whitespace() {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
        .iter()
        .map(|line| line.replace('\u{a0}', " "))
        .collect()
}
