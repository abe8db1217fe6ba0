//! `diagnosis.json`, schema `iwan-diagnosis/1`: what a program reads.

use serde_json::{Value, json};

use crate::diagnose::Findings;
use crate::diagnose::experiment::{Correction, Dummy, Separable};
use crate::diagnose::findings::{Candidate, Errors, Estimate, NamedCause};
use crate::diagnose::left_out::LeftOut;
use crate::diagnose::levels::{Compared, Level};

/// Identifier of the schema.
pub const SCHEMA: &str = "iwan-diagnosis/1";

/// The findings by the schema; SI units, intervals as `[lower, upper]`, and `null` for every number
/// that is not finite or was not computed.
pub fn render(findings: &Findings) -> Value {
    let noise = &findings.noise;
    let (ratio, interval) = findings.gain;
    json!({
        "schema": SCHEMA,
        "verdict": findings.verdict.name(),
        "summary": findings.summary,
        "judged": findings.judged,
        "unit": findings.unit,
        "causes": list(&findings.causes, cause),
        "candidates": list(&findings.candidates, candidate),
        "noise": {
            "rms": number(noise.rms),
            "unit": noise.unit,
            "autoregression": number(noise.autoregression),
            "method": noise.method,
            "effective_samples": number(noise.effective_samples),
        },
        "baseline": errors(&findings.baseline),
        "extended": errors(&findings.extended),
        "gain": {
            "held_out_rms_ratio": number(ratio),
            "interval": bounds(interval),
            "left_out_records": list(&findings.left_out, left_out),
        },
        "levels": list(&findings.levels, level),
        "unexplained": {
            "share": number(findings.unexplained.share),
            "where": findings.unexplained.places,
            "perhaps_instead": findings.unexplained.doubles,
            "correction": findings.outlook.correction.as_ref().map(correction),
        },
        "not_identifiable": findings.not_identifiable,
        "next_experiment": next_experiment(findings),
        "separability": list(&findings.outlook.separability, separable),
        "dummy": list(&findings.outlook.dummy, dummy),
        "records": findings.records.iter().zip(&findings.held_out).map(|((name, samples, hash), held)| {
            json!({ "name": name, "samples": samples, "sha256": hash, "held_out": held })
        }).collect::<Value>(),
        "joint_parameters": list(&findings.joint_parameters, estimate),
        "notes": findings.notes,
    })
}

fn list<T>(items: &[T], write: impl Fn(&T) -> Value) -> Value {
    items.iter().map(write).collect()
}

/// JSON has no NaN and no infinity: both become `null`.
fn number(value: f64) -> Value {
    serde_json::Number::from_f64(value).map_or(Value::Null, Value::Number)
}

fn bounds(interval: Option<(f64, f64)>) -> Value {
    interval.map_or(Value::Null, |(lower, upper)| {
        json!([number(lower), number(upper)])
    })
}

fn estimate(estimate: &Estimate) -> Value {
    json!({
        "name": estimate.name,
        "value": number(estimate.value),
        "unit": estimate.unit,
        "interval": bounds(estimate.interval),
    })
}

fn cause(cause: &NamedCause) -> Value {
    json!({
        "name": cause.name,
        "kind": cause.kind,
        "parameters": list(&cause.parameters, estimate),
        "absent": cause.absent,
        "ambiguous_with": cause.ambiguous_with,
        "evidence": number(cause.evidence),
        "matters": number(cause.matters),
    })
}

fn candidate(candidate: &Candidate) -> Value {
    json!({
        "name": candidate.name,
        "kind": candidate.kind,
        "evidence": number(candidate.evidence),
        "probability": number(candidate.probability),
        "lambda_sep": candidate.lambda_sep.map_or(Value::Null, number),
        "held_out_gain": candidate.held_out_gain.map_or(Value::Null, number),
    })
}

/// The experiment with its file, or the words alone where no program was designed.
fn next_experiment(findings: &Findings) -> Value {
    let Some(experiment) = &findings.outlook.experiment else {
        let words = findings.next_experiment.as_ref();
        return words.map_or(Value::Null, |words| json!({ "description": words }));
    };
    let written = !experiment.blocks.is_empty();
    json!({
        "description": experiment.description,
        "causes": experiment.causes,
        "file": written.then_some("next_experiment.csv"),
        "drive": experiment.drive,
        "blocks": experiment.blocks,
        "duration": experiment.time.last().copied().map_or(Value::Null, number),
        "lambda_before": number(experiment.lambda_before),
        "lambda_after": number(experiment.lambda_after),
        "settles": experiment.settles,
        "instead": experiment.instead,
    })
}

fn separable(line: &Separable) -> Value {
    json!({
        "name": line.name,
        "fitted": line.fitted,
        "values": list(&line.values, |(name, value, unit)| {
            json!({ "name": name, "value": number(*value), "unit": unit })
        }),
        "lambda_sep": number(line.lambda),
        "lambda_baseline": number(line.baseline),
        "rivals": list(&line.rivals, left),
        "map": list(&line.row, left),
    })
}

/// What one rival leaves.
fn left((name, left): &(String, f64)) -> Value {
    json!({ "name": name, "lambda": number(*left) })
}

fn dummy(line: &Dummy) -> Value {
    json!({
        "name": line.name,
        "fall": number(line.fall),
        "power": number(line.power),
        "ruling": line.ruling.name(),
    })
}

fn correction(correction: &Correction) -> Value {
    json!({
        "is_a_cause": false,
        "terms": list(&correction.terms, |(feature, size)| {
            json!({ "feature": feature, "largest": number(*size), "unit": correction.unit })
        }),
        "held_out_rms_ratio": number(correction.ratio),
        "interval": bounds(Some(correction.interval)),
    })
}

fn errors(errors: &Errors) -> Value {
    json!({
        "train_rms": number(errors.train_rms),
        "held_out_rms": number(errors.held_out_rms),
        "held_out_interval": bounds(errors.held_out_interval),
        "dissipation_error": errors.dissipation_error.map_or(Value::Null, number),
        "dissipation_interval": bounds(errors.dissipation_interval),
        "stiffness_error": errors.stiffness_error.map_or(Value::Null, number),
        "stiffness_interval": bounds(errors.stiffness_interval),
    })
}

fn left_out(record: &LeftOut) -> Value {
    json!({
        "record": record.record,
        "before": number(record.before),
        "after": number(record.after),
        "ratio": number(record.ratio),
        "interval": bounds(record.interval),
    })
}

fn level(level: &Level) -> Value {
    json!({
        "record": level.record,
        "amplitude": number(level.amplitude),
        "mean": number(level.mean),
        "unit": level.unit,
        "rate": level.rate.map_or(Value::Null, number),
        "cycles": level.cycles,
        "held_out": level.held_out,
        "energy": level.energy.as_ref().map(compared),
        "stiffness": level.stiffness.as_ref().map(compared),
    })
}

fn compared(quantity: &Compared) -> Value {
    json!({
        "measured": number(quantity.measured),
        "unit": quantity.unit,
        "baseline_error": number(quantity.before),
        "baseline_interval": bounds(quantity.before_interval),
        "extended_error": number(quantity.after),
        "extended_interval": bounds(quantity.after_interval),
    })
}
