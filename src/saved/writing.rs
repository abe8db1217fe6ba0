//! Joint → joint.json.

use serde_json::{Map, Value, json};

use super::{FORMAT, Judgement, Provenance, RecordUsed, SavedJoint};
use crate::joint::{Acting, Density};

/// The text of a joint.json, entries in the order of [`super`]'s picture, lists of numbers in one
/// line. Checked by round trips in tests/saved.rs.
pub fn write(saved: &SavedJoint) -> String {
    let causes: Vec<Value> = saved.joint.effects.iter().map(cause).collect();
    let intervals: Map<String, Value> = saved
        .intervals
        .iter()
        .map(|(name, (low, high))| (name.clone(), json!([number(*low), number(*high)])))
        .collect();
    let entries = [
        ("format", json!(FORMAT)),
        ("version", json!(env!("CARGO_PKG_VERSION"))),
        ("units", json!("SI")),
        ("density", density(&saved.joint.density)),
        ("series_stiffness", number(saved.joint.series_stiffness)),
        ("causes", Value::Array(causes)),
        ("provenance", provenance(&saved.provenance)),
        ("intervals", Value::Object(intervals)),
    ];
    let lines: Vec<String> = entries
        .iter()
        .map(|(name, value)| format!("  \"{name}\": {}", layout(value, 1)))
        .collect();
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

fn density(density: &Density) -> Value {
    let mut entry = Map::new();
    entry.insert("family".into(), json!(density.family()));
    for (parameter, value) in density.parameters().iter().zip(density.values()) {
        entry.insert(parameter.name.into(), number(value));
    }
    match density {
        Density::PowerLaw(_) | Density::FourParameter(_) => {}
        Density::PowerLawTable(table) => {
            entry.insert("break_free".into(), numbers(&table.break_free));
            entry.insert("density".into(), numbers(&table.density));
        }
        Density::Sliders(sliders) => {
            entry.insert("weight".into(), numbers(&sliders.weight));
            entry.insert("slip_at".into(), numbers(&sliders.slip_at));
        }
    }
    Value::Object(entry)
}

fn cause(acting: &Acting) -> Value {
    let glossary = acting.effect.parameters().iter();
    let parameters: Map<String, Value> = glossary
        .zip(&acting.values)
        .map(|(parameter, value)| (parameter.name.to_string(), number(*value)))
        .collect();
    json!({"name": acting.effect.name(), "parameters": parameters})
}

fn provenance(provenance: &Provenance) -> Value {
    let records: Vec<Value> = provenance.records.iter().map(record).collect();
    let mut entry = Map::new();
    entry.insert("records".into(), Value::Array(records));
    let words = [
        ("date", &provenance.date),
        ("tool", &provenance.tool),
        ("remark", &provenance.remark),
    ];
    for (name, text) in words {
        if let Some(text) = text {
            entry.insert(name.into(), json!(text));
        }
    }
    if let Some(verdict) = &provenance.verdict {
        entry.insert("verdict".into(), judgement(verdict));
    }
    Value::Object(entry)
}

fn record(used: &RecordUsed) -> Value {
    let mut entry = json!({"name": used.name, "samples": used.samples, "sha256": used.sha256});
    if let Some(span) = used.span {
        entry["duration"] = number(span.duration);
        entry["sample_interval"] = number(span.sample_interval);
    }
    if let Some(largest) = used.largest_force {
        entry["largest_force"] = number(largest);
    }
    entry
}

fn judgement(verdict: &Judgement) -> Value {
    let ratio = verdict.held_out_rms_ratio.map_or(Value::Null, number);
    let mut entry = json!({"word": verdict.word, "held_out_rms_ratio": ratio});
    if let Some((low, high)) = verdict.interval {
        entry["interval"] = json!([number(low), number(high)]);
    }
    entry
}

/// JSON has no infinity: null stands for it.
fn number(value: f64) -> Value {
    serde_json::Number::from_f64(value).map_or(Value::Null, Value::Number)
}

fn numbers(values: &[f64]) -> Value {
    Value::Array(values.iter().map(|value| number(*value)).collect())
}

/// JSON text with one entry per line, lists of plain values in one line.
fn layout(value: &Value, depth: usize) -> String {
    let nested = |value: &Value| matches!(value, Value::Object(_) | Value::Array(_));
    let pad = "  ".repeat(depth + 1);
    let close = "  ".repeat(depth);
    match value {
        Value::Object(entries) if !entries.is_empty() => {
            let lines: Vec<String> = entries
                .iter()
                .map(|(name, value)| format!("{pad}{}: {}", json!(name), layout(value, depth + 1)))
                .collect();
            format!("{{\n{}\n{close}}}", lines.join(",\n"))
        }
        Value::Array(values) if values.iter().any(nested) => {
            let lines: Vec<String> = values
                .iter()
                .map(|value| format!("{pad}{}", layout(value, depth + 1)))
                .collect();
            format!("[\n{}\n{close}]", lines.join(",\n"))
        }
        Value::Array(values) => {
            let plain: Vec<String> = values.iter().map(Value::to_string).collect();
            format!("[{}]", plain.join(", "))
        }
        plain => plain.to_string(),
    }
}
