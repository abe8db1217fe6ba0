//! The catalogue as findings tell it: causes that are named, and what became of every one.

use super::findings::{Candidate, Estimate, NamedCause};
use super::prepare::Bench;
use super::search::Found;
use super::{gain, intervals, probability};
use crate::causes::{CATALOGUE, Kind, find};
use crate::identify::{Fit, Prediction};
use crate::joint::parameters::Parameter;
use rayon::prelude::*;

/// The causes that are named, the one that brings most first.
pub(super) fn named(bench: &Bench, found: &Found, whole: &Fit) -> Vec<NamedCause> {
    let intervals = intervals::intervals(&bench.whole, &bench.scale, whole);
    let mut causes: Vec<NamedCause> = whole
        .effects
        .iter()
        .enumerate()
        .map(|(e, acting)| {
            let parameters = acting
                .effect
                .parameters()
                .iter()
                .zip(&acting.values)
                .zip(&intervals[e])
                .map(|((parameter, &value), &interval)| Estimate {
                    name: parameter.name.to_string(),
                    value,
                    unit: parameter.unit.to_string(),
                    interval,
                })
                .collect();
            NamedCause {
                name: acting.effect.name().to_string(),
                kind: kind(acting.effect.name()),
                parameters,
                absent: absent(acting.effect.parameters(), &acting.values),
                ambiguous_with: found.rivals.get(e).cloned().unwrap_or_default(),
                evidence: found.evidence.get(e).copied().unwrap_or(0.0),
                matters: gain::share_of_energy(&bench.whole, whole, e),
            }
        })
        .collect();
    causes.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    causes
}

/// Names of the refinements of a law that a fit has left out.
pub(super) fn absent(parameters: &[Parameter], values: &[f64]) -> Vec<String> {
    let both = parameters.iter().zip(values);
    let neutral = both.filter(|(p, v)| p.neutral == Some(**v));
    neutral.map(|(p, _)| p.name.to_string()).collect()
}

/// `joint` or `measurement`.
pub(super) fn kind(name: &str) -> String {
    match find(name).map(|c| c.kind()) {
        Some(Kind::Measurement) => "measurement",
        _ => "joint",
    }
    .to_string()
}

/// The whole catalogue with evidence, probability (against each other, none and what is not listed)
/// and what each alone would do to the held-out error.
pub(super) fn candidates(
    bench: &Bench,
    found: &Found,
    before: &[Prediction],
    left: f64,
) -> Vec<Candidate> {
    let probabilities = probability::probabilities(&bench.train, found, left);
    let mut all: Vec<Candidate> = found
        .trials
        .par_iter()
        .zip(probabilities)
        .map(|(trial, probability)| Candidate {
            name: trial.cause.name().to_string(),
            kind: kind(trial.cause.name()),
            evidence: 0.5 * trial.evidence,
            probability,
            lambda_sep: None,
            held_out_gain: Some(gain::ratio_alone(
                bench,
                before,
                &trial.fit.predict(&bench.train),
            )),
        })
        .collect();
    for cause in CATALOGUE {
        if !all.iter().any(|c| c.name == cause.name()) {
            all.push(Candidate {
                name: cause.name().to_string(),
                kind: kind(cause.name()),
                evidence: 0.0,
                probability: 0.0,
                lambda_sep: None,
                held_out_gain: None,
            });
        }
    }
    all
}
