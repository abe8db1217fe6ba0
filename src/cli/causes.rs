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
            let cause = find(name).ok_or_else(|| unknown(name))?;
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

fn unknown(name: &str) -> BadInput {
    let known = CATALOGUE
        .iter()
        .map(|cause| cause.name())
        .collect::<Vec<_>>()
        .join(", ");
    BadInput(format!("no cause is called `{name}`; known: {known}"))
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
