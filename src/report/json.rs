//! `diagnosis.json`, schema `iwan-diagnosis/1`: what a program reads.

use serde_json::{Value, json};

use crate::diagnose::Findings;
use crate::diagnose::findings::{Candidate, Errors, Estimate, NamedCause};

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
        },
        "unexplained": {
            "share": number(findings.unexplained.share),
            "where": findings.unexplained.places,
        },
        "not_identifiable": findings.not_identifiable,
        "next_experiment": findings.next_experiment,
        "records": list(&findings.records, |(name, samples, hash)| {
            json!({ "name": name, "samples": samples, "sha256": hash })
        }),
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

fn errors(errors: &Errors) -> Value {
    json!({
        "train_rms": number(errors.train_rms),
        "held_out_rms": number(errors.held_out_rms),
        "dissipation_error": errors.dissipation_error.map_or(Value::Null, number),
    })
}
