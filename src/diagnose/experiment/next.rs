//! From open questions to the next experiment, or to why there is none.

use super::Options;
use super::design::Question;
use super::instead::instead;
use super::plan::{Plan, Told};
use super::program::Rig;
use super::purpose::purpose;
use super::separability::{Map, TOLD};
use crate::causes::{Cause, find};
use crate::diagnose::findings::Findings;
use crate::diagnose::prepare::Bench;
use crate::identify::{Fit, Problem};
use crate::joint::effect::Acting;
use crate::record::written::quantity;

/// A load program that separates what the records cannot.
#[derive(Debug, Clone, PartialEq)]
pub struct Experiment {
    /// What it is for and what it would do, in a sentence or two.
    pub description: String,
    /// Causes it is to separate or to show.
    pub causes: Vec<String>,
    /// Its blocks, in words.
    pub blocks: Vec<String>,
    /// Prescribed channel: `force` or `displacement`.
    pub drive: String,
    /// Unit of that channel.
    pub unit: String,
    /// Time \[s\].
    pub time: Vec<f64>,
    /// Prescribed channel.
    pub values: Vec<f64>,
    /// Least χ² between the rivals with the records so far.
    pub lambda_before: f64,
    /// Least χ² between the rivals with this experiment besides.
    pub lambda_after: f64,
    /// True where it is expected to settle every question.
    pub settles: bool,
    /// What would, where it does not.
    pub instead: Option<String>,
}

/// Causes that are asked about together at most; more make no program better.
const MOST: usize = 5;

/// Ordered pairs of causes that are ambiguous with each other, as they were fitted.
fn ambiguous(findings: &Findings, known: &[(&'static dyn Cause, Acting)]) -> Vec<Question> {
    let mut questions = Vec::new();
    for named in findings
        .causes
        .iter()
        .filter(|c| !c.ambiguous_with.is_empty())
    {
        let fitted = |name: &str| known.iter().find(|k| k.0.name() == name);
        for rival in named.ambiguous_with.iter().take(MOST - 1) {
            for (one, other) in [(&named.name, rival), (rival, &named.name)] {
                questions.extend(fitted(one).map(|(cause, acting)| Question {
                    cause: *cause,
                    acting: acting.clone(),
                    rival: other.clone(),
                    mapped: None,
                }));
            }
        }
    }
    questions
}

/// Causes that the records would not show at a size that would matter, nearest rival each.
fn hidden(map: &Map) -> Vec<Question> {
    let mut lines: Vec<_> = map.lines.iter().zip(&map.shown).collect();
    lines.retain(|(line, _)| !line.fitted && line.lambda < TOLD);
    lines.sort_by(|a, b| a.0.lambda.total_cmp(&b.0.lambda));
    let asked = lines.into_iter().take(MOST).filter_map(|(line, acting)| {
        Some(Question {
            cause: find(&line.name)?,
            acting: acting.clone(),
            rival: line.rivals.first()?.0.clone(),
            mapped: Some(line.lambda),
        })
    });
    asked.collect()
}

/// The next experiment: for what is ambiguous, else for what the records cannot show.
pub fn next(
    findings: &Findings,
    bench: &Bench,
    problem: &Problem,
    map: &Map,
    known: &[(&'static dyn Cause, Acting)],
    whole: &Fit,
    options: &Options,
) -> Option<Experiment> {
    let open = ambiguous(findings, known);
    let told = Told {
        bench,
        problem,
        known,
        whole,
        ambiguous: !open.is_empty(),
    };
    let questions = match told.ambiguous {
        true => open,
        false => hidden(map),
    };
    if questions.is_empty() {
        return None;
    }
    let causes = names(&questions);
    let rigs = told.rigs(&options.limits);
    let (plan, missed) = told.plan(questions, &rigs);
    let settles = plan.settles() && missed.is_empty();
    let instead = (!settles).then(|| {
        let mut unsettled = missed.clone();
        if !plan.settles() {
            unsettled.extend(plan.questions.iter().cloned());
        }
        instead(&told, &unsettled, &options.limits, options.dummy.is_some())
    });
    let found: Vec<String> = findings.causes.iter().map(|c| c.name.clone()).collect();
    let purpose = |questions: &[Question]| purpose(questions, told.ambiguous, &found);
    let mut description = format!("{}: {}", purpose(&plan.questions), promise(&plan, &rigs));
    if !missed.is_empty() {
        description += &format!(". {}: not with this rig", purpose(&missed));
    }
    description += &match &instead {
        Some(instead) => format!("; {instead}"),
        None => ".".to_string(),
    };
    let (drive, unit) = problem.operators.form.input();
    let after = plan.after().map_or(f64::NAN, |s| s.lambda);
    let lambda_before = plan.before();
    let (blocks, time, values) = match plan.chosen {
        None => (Vec::new(), Vec::new(), Vec::new()),
        Some(chosen) => {
            let played = chosen.rig.play(&chosen.blocks);
            let words = chosen.blocks.iter().map(|b| b.words(&chosen.rig, unit));
            (words.collect(), played.time, played.values)
        }
    };
    Some(Experiment {
        description,
        causes,
        blocks,
        drive: drive.to_string(),
        unit: unit.to_string(),
        time,
        values,
        lambda_before,
        lambda_after: after,
        settles,
        instead,
    })
}

/// Names of all that is asked about, once each.
fn names(questions: &[Question]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for question in questions {
        for name in [question.cause.name(), &question.rival] {
            if name != "none" && !names.iter().any(|n| n == name) {
                names.push(name.to_string());
            }
        }
    }
    names
}

/// What the program would do for its questions, or that there is none: a sentence without its full stop.
fn promise(plan: &Plan, rigs: &[Rig]) -> String {
    let before = plan.before();
    let Some(after) = plan.after() else {
        let longest = rigs.iter().map(Rig::longest).fold(0.0, f64::max);
        return match rigs.iter().all(|rig| rig.menu().is_empty()) {
            true => format!(
                "not with this rig, no program fits into {}",
                quantity(longest, "s")
            ),
            false => "not with this rig, no program within its limits brings anything".to_string(),
        };
    };
    let (lambda, needed) = (after.lambda.max(before), after.needed);
    let takes = format!("takes chi² from {before:.1} to {lambda:.1}, and {needed:.0} is needed");
    let why = match lambda >= TOLD {
        true => ", because no law is true to the last digit",
        false => "",
    };
    match (&plan.chosen, plan.settles()) {
        (None, _) => {
            format!(
                "not with this rig, no program within its limits will do: the best {takes}{why}"
            )
        }
        (_, true) => format!(
            "run next_experiment.csv and diagnose it together with these records; expected chi² between the rivals {before:.1} before, {lambda:.1} with it"
        ),
        (_, false) => {
            let hardly = match lambda >= TOLD {
                true => "hardly",
                false => "not",
            };
            format!(
                "{hardly} with this rig; the best program within its limits (next_experiment.csv) {takes}{why}"
            )
        }
    }
}
