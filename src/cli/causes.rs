//! `iwan causes`: the catalogue, explained.

use super::{BadInput, output};
use crate::causes::{CATALOGUE, Cause, Kind, find};
use crate::joint::Parameter;
use serde_json::{Value, json};
use std::fmt::Write;

/// The catalogue of causes: all in a line each, or one on its page.
#[derive(Debug, clap::Args)]
pub struct Causes {
    /// A cause, e.g. `pinning`
    name: Option<String>,
    /// For programs
    #[arg(long)]
    json: bool,
}

/// Prints the list or the page.
///
/// # Errors
/// [`BadInput`] for a name that is not in the catalogue.
pub fn run(arguments: &Causes) -> anyhow::Result<()> {
    let text = match &arguments.name {
        Some(name) => {
            let cause = meant(name).ok_or_else(|| unknown(name))?;
            if arguments.json {
                pretty(&as_json(cause))
            } else {
                page(cause)
            }
        }
        None if arguments.json => pretty(&CATALOGUE.iter().map(|cause| as_json(*cause)).collect()),
        None => list(),
    };
    output::print(&text)
}

/// Letters by which a name may be off and still be taken for a slip of the pen, as a share of its length.
const SLIP: f64 = 0.34;

/// Letters that a part of a name has at least to stand for it.
const LEAST: usize = 3;

/// The letters of a name, whatever its case and whatever stands between its words.
fn letters(name: &str) -> String {
    let letters = name.chars().filter(|c| c.is_alphanumeric());
    letters.flat_map(char::to_lowercase).collect()
}

/// The cause of that name, also as `Pinning` or `preload loss`, or by a beginning that is no other's
/// (`pre-load`).
fn meant(name: &str) -> Option<&'static dyn Cause> {
    let given = letters(name);
    let alike = |cause: &&&'static dyn Cause| letters(cause.name()) == given;
    let begins = |cause: &&&'static dyn Cause| letters(cause.name()).starts_with(&given);
    let mut begun = CATALOGUE.iter().filter(begins);
    let only = match (begun.next(), begun.next()) {
        (Some(one), None) if given.chars().count() >= LEAST => Some(one),
        _ => None,
    };
    find(name).or_else(|| CATALOGUE.iter().find(alike).or(only).copied())
}

fn unknown(name: &str) -> BadInput {
    let nearest = nearest(name);
    let suggestion = match nearest.is_empty() {
        true => ";".to_owned(),
        false => format!("; did you mean `{}`?", nearest.join("` or `")),
    };
    let known = CATALOGUE
        .iter()
        .map(|cause| cause.name())
        .collect::<Vec<_>>()
        .join(", ");
    BadInput(format!(
        "no cause is called `{name}`{suggestion} known: {known}"
    ))
}

/// The names nearest to one that is none: those it is a part of, else those that a few letters more, fewer or
/// others make of it.
fn nearest(name: &str) -> Vec<&'static str> {
    let given = letters(name);
    if given.is_empty() {
        return Vec::new();
    }
    let names = || CATALOGUE.iter().map(|cause| cause.name());
    let parts: Vec<_> = names().filter(|n| letters(n).contains(&given)).collect();
    if !parts.is_empty() && given.chars().count() >= LEAST {
        return parts;
    }
    let steps = |n: &&str| steps(&given, &letters(n));
    let least = names().map(|n| steps(&n)).min().unwrap_or(usize::MAX);
    let allowed = (SLIP * given.chars().count() as f64).max(1.0);
    let near = names().filter(|n| steps(n) == least && least as f64 <= allowed);
    near.collect()
}

/// Letters to add, drop or change to make one word of the other (Levenshtein).
fn steps(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().collect();
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (i, letter) in one.chars().enumerate() {
        let mut diagonal = i;
        row[0] = i + 1;
        for (j, target) in other.iter().enumerate() {
            let changed = diagonal + usize::from(letter != *target);
            diagonal = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[other.len()]
}

fn kind(cause: &dyn Cause) -> &'static str {
    match cause.kind() {
        Kind::Joint => "joint",
        Kind::Measurement => "measurement",
    }
}

fn list() -> String {
    let longest = CATALOGUE
        .iter()
        .map(|cause| cause.name().len())
        .max()
        .unwrap_or(0);
    let mut text = String::new();
    for cause in CATALOGUE {
        let happens = cause.page().happens;
        let line = format!("{:longest$}  {:11}  {happens}", cause.name(), kind(*cause));
        text.push_str(line.trim_end());
        text.push('\n');
    }
    text
}

fn page(cause: &dyn Cause) -> String {
    let page = cause.page();
    let mut text = format!("{} ({} cause)\n\n", cause.name(), kind(cause));
    let mistaken = page.mistaken_for.join(", ");
    for (title, paragraph) in [
        ("What happens", page.happens),
        ("Sign in the record", page.sign),
        ("Mistaken for", mistaken.as_str()),
        ("Separated by", page.separated_by),
        ("Law", page.formula),
        ("Source", page.source),
    ] {
        text.push_str(&format!("{title}\n{}\n\n", wrapped(2, paragraph)));
    }
    text.push_str("Parameters\n");
    for parameter in cause.parameters() {
        text.push_str(&entry(parameter));
    }
    text
}

fn entry(parameter: &Parameter) -> String {
    let Parameter {
        name,
        symbol,
        unit,
        lower,
        upper,
        meaning,
        ..
    } = parameter;
    let mut text = format!("  {name} ({symbol}) [{unit}], {lower:e} to {upper:e}");
    if let Some(vanishing) = parameter.vanishes_at {
        // writing to a string cannot fail
        let _ = write!(text, ", no effect at {vanishing}");
    }
    text.push_str(&format!("\n{}\n", wrapped(4, meaning)));
    text
}

/// The paragraph in lines of up to 89 characters, the given count of spaces before each.
fn wrapped(indent: usize, paragraph: &str) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in paragraph.split_whitespace() {
        let line = lines
            .last_mut()
            .filter(|line| line.chars().count() + word.chars().count() < 89);
        match line {
            Some(line) => line.extend([" ", word]),
            None => lines.push(format!("{:indent$}{word}", "")),
        }
    }
    lines.join("\n")
}

fn pretty(value: &Value) -> String {
    format!("{value:#}\n")
}

fn as_json(cause: &dyn Cause) -> Value {
    let page = cause.page();
    let parameters: Vec<Value> = cause
        .parameters()
        .iter()
        .map(|parameter| {
            json!({
                "name": parameter.name,
                "symbol": parameter.symbol,
                "unit": parameter.unit,
                "lower": parameter.lower,
                "upper": parameter.upper,
                "vanishes_at": parameter.vanishes_at,
                "meaning": parameter.meaning,
            })
        })
        .collect();
    json!({
        "name": cause.name(),
        "kind": kind(cause),
        "happens": page.happens,
        "sign": page.sign,
        "mistaken_for": page.mistaken_for,
        "separated_by": page.separated_by,
        "formula": page.formula,
        "source": page.source,
        "parameters": parameters,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_known_in_other_spellings() {
        for (given, name) in [
            ("pinning", "pinning"),
            ("Pinning", "pinning"),
            ("preload loss", "preload_loss"),
            ("Pre-Load-Loss", "preload_loss"),
            (" RUNNING_IN ", "running_in"),
            ("pre-load", "preload_loss"),
        ] {
            let cause = meant(given).map(|cause| cause.name());
            assert_eq!(cause, Some(name), "{given}");
        }
        for none in ["pining", "sensor", "p", ""] {
            assert!(meant(none).is_none(), "{none}");
        }
    }

    #[test]
    fn a_slip_of_the_pen_is_answered_with_the_name() {
        assert_eq!(nearest("pining"), ["pinning"]);
        assert_eq!(nearest("sensor").len(), 3);
        assert_eq!(nearest("sensor_dealy"), ["sensor_delay"]);
        assert_eq!(nearest("velocity weakning"), ["velocity_weakening"]);
        assert!(nearest("temperature").is_empty());
        assert!(nearest("").is_empty());
        let BadInput(message) = unknown("pining");
        assert!(
            message.starts_with("no cause is called `pining`; did you mean `pinning`? known: ")
        );
    }
}
