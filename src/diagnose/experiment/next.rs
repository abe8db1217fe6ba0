//! From open questions to the next experiment, or to why there is none.

use super::Options;
use super::design::{
    BLOCKS, BLOCKS_TO_SHOW, Chosen, Design, Question, Standing, least, program, refitted,
};
use super::limits::rigs;
use super::separability::{Map, TOLD};
use crate::causes::{Cause, Kind, find};
use crate::diagnose::findings::Findings;
use crate::diagnose::prepare::Bench;
use crate::identify::{Fit, Problem};
use crate::joint::effect::Acting;
use rayon::prelude::*;

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
    // Without time there is no rate to prescribe.
    let open = ambiguous(findings, known);
    let named = !open.is_empty();
    let questions = if named { open } else { hidden(map) };
    if questions.is_empty() {
        return None;
    }
    let rows = bench.whole.rows() as f64;
    let design = Design::new(problem, &whole.coefficients, &questions, rows, &bench.scale);
    let most = if named { BLOCKS } else { BLOCKS_TO_SHOW };
    let chosen = design.choose(&rigs(bench, &options.limits), most);
    let mut causes: Vec<String> = Vec::new();
    for question in &questions {
        for name in [question.cause.name(), &question.rival] {
            if name != "none" && !causes.iter().any(|c| c == name) {
                causes.push(name.to_string());
            }
        }
    }
    let (drive, unit) = problem.operators.form.input();
    let (before, after) = match &chosen {
        None => (None, None),
        Some(chosen) if named => refits(&design, chosen, known, whole),
        Some(chosen) => (least(&chosen.before), least(&chosen.after)),
    };
    let settles = after.is_some_and(|s| s.ratio() >= 1.0);
    let needed = after.map_or(f64::NAN, |s| s.needed);
    let lambda = |standing: Option<Standing>| standing.map_or(f64::NAN, |s| s.lambda);
    let (before, after) = (lambda(before), lambda(after));
    let instead = (!settles).then(|| instead(&causes, options.dummy.is_some()));
    let (blocks, time, values) = match chosen {
        None => (Vec::new(), Vec::new(), Vec::new()),
        Some(chosen) => {
            let played = chosen.rig.play(&chosen.blocks);
            let words = chosen.blocks.iter().map(|b| b.words(&chosen.rig, unit));
            (words.collect(), played.time, played.values)
        }
    };
    let purpose = match named {
        true => format!("To tell {} apart", causes.join(" and ")),
        false => format!("To show {} at a size that would matter", causes.join(", ")),
    };
    let description = match (&instead, blocks.is_empty()) {
        (None, _) => format!(
            "{purpose}: run next_experiment.csv and diagnose it together with these records; expected chi² between the rivals {before:.1} before, {after:.1} with it."
        ),
        (Some(instead), true) => {
            format!("{purpose}: not with this rig, no program fits its limits; {instead}")
        }
        (Some(instead), false) if after >= TOLD => format!(
            "{purpose}: hardly with this rig; the best program within its limits (next_experiment.csv) takes chi² from {before:.1} to {after:.1}, and {needed:.0} is needed, because no law is true to the last digit; {instead}"
        ),
        (Some(instead), false) => format!(
            "{purpose}: not with this rig; the best program within its limits (next_experiment.csv) takes chi² from {before:.1} to {after:.1}, and {needed:.0} is needed; {instead}"
        ),
    };
    Some(Experiment {
        description,
        causes,
        blocks,
        drive: drive.to_string(),
        unit: unit.to_string(),
        time,
        values,
        lambda_before: before,
        lambda_after: after,
        settles,
        instead,
    })
}

/// The question that is settled least, before and after, by joint refits of every rival to every
/// other.
fn refits(
    design: &Design,
    chosen: &Chosen,
    known: &[(&'static dyn Cause, Acting)],
    whole: &Fit,
) -> (Option<Standing>, Option<Standing>) {
    let mut both = design.problem.clone();
    let (program, more) = program(design.problem, &chosen.rig, &chosen.blocks);
    both.records.extend(program.records);
    let asked: Vec<&str> = design.questions.iter().map(|q| q.cause.name()).collect();
    let others: Vec<Acting> = whole
        .effects
        .iter()
        .filter(|a| !asked.contains(&a.effect.name()))
        .cloned()
        .collect();
    let worst = |problem: &Problem, rows: f64| {
        let each = design.questions.par_iter().map(|question| {
            let rival = known.iter().find(|k| k.0.name() == question.rival);
            let left =
                |rival: Option<&Acting>| refitted(problem, whole, &question.acting, rival, &others);
            Standing::new(left(rival.map(|k| &k.1)), left(None), rows)
        });
        least(&each.collect::<Vec<_>>())
    };
    (
        worst(design.problem, design.rows),
        worst(&both, design.rows + more),
    )
}

/// What would settle it, where no program does.
fn instead(causes: &[String], dummy_is_there: bool) -> String {
    let is = |name: &String, kind: Kind| find(name).is_some_and(|c| c.kind() == kind);
    let chain = causes.iter().any(|c| is(c, Kind::Measurement));
    let joint = causes.iter().any(|c| is(c, Kind::Joint));
    match (chain, joint) {
        (true, _) if dummy_is_there => "a second displacement sensor of another kind would, or more force or rate (--limit-force, --limit-rate).".to_string(),
        (true, true) => "a monolithic dummy measured through the same chain would tell the joint from the chain (--dummy FILE), and so would a second displacement sensor of another kind, or more force or rate (--limit-force, --limit-rate).".to_string(),
        (true, false) => "a monolithic dummy measured through the same chain (--dummy FILE) or a second sensor of another kind would.".to_string(),
        _ => "more force, more rate or more time would (--limit-force, --limit-rate, --limit-duration), or a second sensor at the slipping faces.".to_string(),
    }
}
