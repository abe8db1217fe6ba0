//! Everything that a look ahead gives, as part of the findings.

use super::Options;
use super::correction::{Correction, correction};
use super::dummy::Dummy;
use super::loading::loading;
use super::next::{Experiment, next};
use super::separability::{ENERGY, MOTION, Map, Separable, TOLD, map};
use crate::causes::{CATALOGUE, Cause, find};
use crate::diagnose::findings::{Findings, Verdict};
use crate::diagnose::prepare::Bench;
use crate::diagnose::search::Found;
use crate::diagnose::trials::{Trial, trial_of};
use crate::identify::{Fit, Problem};
use crate::joint::effect::Acting;
use crate::record::written::quantity;

/// What lies beyond the verdict.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Outlook {
    /// Separability of every cause on the records' own loading, the least first.
    pub separability: Vec<Separable>,
    /// The load program that would settle what is open; `None` where nothing is.
    pub experiment: Option<Experiment>,
    /// What a dummy says of the causes of the measuring chain that are in question.
    pub dummy: Vec<Dummy>,
    /// A learned correction, which is no cause; `None` where none is sure to help.
    pub correction: Option<Correction>,
}

/// Looks ahead: fills in `outlook`, the candidates' λ_sep, and what the records cannot show.
pub fn look_ahead(
    findings: &mut Findings,
    bench: &Bench,
    found: &Found,
    whole: &Fit,
    timed: bool,
    options: &Options,
) {
    let problem = loading(bench);
    let known = fitted(findings, found, whole);
    let causes: Vec<&'static dyn Cause> = CATALOGUE
        .iter()
        .copied()
        .filter(|c| c.is_told(timed))
        .collect();
    let mut map = map(&problem, &whole.coefficients, &causes, &bench.scale, &known);
    tell(findings, &mut map, &problem, bench);
    let experiment = match timed {
        // Without time there is no rate to prescribe.
        false => None,
        true => next(findings, bench, &problem, &map, &known, whole, options),
    };
    if let Some(experiment) = &experiment {
        findings.next_experiment = Some(experiment.description.clone());
    }
    findings.outlook.experiment = experiment;
    findings.outlook.separability = map.lines;
    if matches!(
        findings.verdict,
        Verdict::Unexplained | Verdict::PartlyExplained
    ) {
        let after = found.best.predict(&bench.train);
        findings.outlook.correction = correction(bench, &after, &findings.unit);
    }
}

/// Named causes with their fitted values, and their rivals with theirs.
fn fitted(findings: &Findings, found: &Found, whole: &Fit) -> Vec<(&'static dyn Cause, Acting)> {
    let mut known: Vec<(&'static dyn Cause, Acting)> = Vec::new();
    for acting in &whole.effects {
        known.extend(find(acting.effect.name()).map(|cause| (cause, acting.clone())));
    }
    let rivals = findings.causes.iter().flat_map(|c| &c.ambiguous_with);
    for rival in rivals {
        if known.iter().any(|k| k.0.name() == rival) {
            continue;
        }
        let trial = trial_of(&found.trials, rival);
        let acting = trial.and_then(Trial::own);
        known.extend(find(rival).zip(acting.cloned()));
    }
    known
}

/// Puts the map into the findings.
fn tell(findings: &mut Findings, map: &mut Map, problem: &Problem, bench: &Bench) {
    for candidate in &mut findings.candidates {
        let line = map.lines.iter().find(|l| l.name == candidate.name);
        candidate.lambda_sep = line.map(|l| l.lambda);
    }
    let used: usize = problem.records.iter().map(|r| r.time.len()).sum();
    let all: usize = bench.whole.records.iter().map(|r| r.time.len()).sum();
    if used < all {
        findings.notes.push(format!(
            "Separability was computed on {used} of the {all} samples of loading."
        ));
    }
    let hidden = map.lines.iter().filter(|l| l.lambda < TOLD && !l.fitted);
    findings.not_identifiable.extend(hidden.map(sentence));
}

/// What a record cannot show, in words.
fn sentence(line: &Separable) -> String {
    let glossary = find(&line.name).map_or(&[][..], |cause| cause.effect().parameters());
    let neutral = |name: &str, value: f64| {
        let mut those = glossary.iter().filter(|p| p.name == name);
        those.any(|p| p.neutral == Some(value))
    };
    let acting = line
        .values
        .iter()
        .filter(|(name, value, _)| !neutral(name, *value));
    let values = acting.map(|(name, value, unit)| format!("{name} {}", quantity(*value, unit)));
    let values = values.collect::<Vec<_>>().join(", ");
    let (energy, motion) = (100.0 * ENERGY, 100.0 * MOTION);
    let size = format!(
        "{} at a size that would matter ({values}: {energy:.0} % of the energy per cycle or {motion:.0} % of the response)",
        line.name
    );
    if line.rivals.iter().any(|r| r.0 == "none") {
        return format!(
            "{size}: this loading does not show it, the baseline takes it as its own (chi² {:.1}).",
            line.baseline
        );
    }
    let rivals: Vec<String> = line.rivals.iter().map(|r| r.0.clone()).collect();
    format!(
        "{size}: this loading does not tell it from {} (chi² {:.1}).",
        rivals.join(", "),
        line.lambda
    )
}
