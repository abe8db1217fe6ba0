//! A monolithic dummy measured through the same chain: it has no joint, so that loss, harmonics or
//! phase in it come from the measuring chain alone. That settles joint against chain.

use super::separability::TOLD;
use crate::causes::{Cause, Kind, find};
use crate::diagnose::prepare::Bench;
use crate::diagnose::search::Found;
use crate::diagnose::trials::{ALARM, dispersion};
use crate::identify::{Fit, Operators, Problem, baseline, refit};
use crate::joint::effect::Acting;
use crate::record::Record;
use crate::record::noise::from_differences;
use crate::record::repeats::from_repeats;

/// What a dummy says of one cause of the measuring chain.
#[derive(Debug, Clone, PartialEq)]
pub struct Dummy {
    /// Catalogue name.
    pub name: String,
    /// Fall of the dummy's misfit with this cause, in noise variances.
    pub fall: f64,
    /// χ² that the cause, as large as the joint's records would have it, would leave on the dummy.
    pub power: f64,
    /// What follows.
    pub ruling: Ruling,
}

/// What follows from a dummy for one cause.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ruling {
    /// The dummy shows it, at least as large as the records need it.
    Shown,
    /// The dummy would have shown it and does not.
    Excluded,
    /// The dummy could not have shown it.
    Open,
}

impl Ruling {
    /// Identifier for programs.
    pub fn name(self) -> &'static str {
        match self {
            Ruling::Shown => "shown",
            Ruling::Excluded => "excluded",
            Ruling::Open => "open",
        }
    }
}

/// Share of the misfit a cause would leave on the dummy that has to be there: what is less explains
/// less than half of the effect's size in the records.
const PRESENT: f64 = 0.25;

/// The dummy as a problem: a linear spring in the form of the joint's records, weighed by its own
/// noise.
fn spring(bench: &Bench, dummy: &Record) -> (Problem, Fit) {
    let form = bench.whole.operators.form;
    let mut problem = Problem::new(form, std::slice::from_ref(dummy));
    problem.operators = Operators {
        form,
        edges: Vec::new(),
        thresholds: Vec::new(),
    };
    let fit = baseline(&problem);
    let (input, judged) = problem.channels(0);
    let residual = &fit.residuals(&problem)[0];
    let noise = from_repeats(input, judged).unwrap_or_else(|| from_differences(residual));
    let largest = judged.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let a = noise.autoregression;
    let innovation = noise.deviation.max(1e-9 * largest) * (1.0 - a * a).sqrt();
    let record = &mut problem.records[0];
    record.autoregression = a;
    record.weight.iter_mut().for_each(|w| *w = 1.0 / innovation);
    let fit = baseline(&problem);
    (problem, fit)
}

/// What the dummy says of a cause that the joint's records would have with the given values.
fn examine(problem: &Problem, plain: &Fit, cause: &'static dyn Cause, acting: &Acting) -> Dummy {
    let with = refit(problem, plain, vec![acting.clone()]);
    let fall = (plain.misfit - with.misfit) / dispersion(problem, &with);
    // What it would leave on a dummy free of noise.
    let mut simulated = problem.clone();
    let truth = problem.predict(&plain.coefficients, std::slice::from_ref(acting));
    for (record, truth) in simulated.records.iter_mut().zip(truth) {
        match problem.operators.form {
            crate::identify::Form::Play => record.displacement = truth.judged,
            crate::identify::Form::Stop => record.force = truth.judged,
        }
    }
    let power = baseline(&simulated).misfit / dispersion(problem, &with);
    let ruling = match (fall > ALARM, fall >= PRESENT * power) {
        (true, true) => Ruling::Shown,
        (_, false) if power >= 2.0 * TOLD => Ruling::Excluded,
        _ => Ruling::Open,
    };
    Dummy {
        name: cause.name().to_string(),
        fall,
        power,
        ruling,
    }
}

/// Settles ambiguous names by the dummy: a cause of the chain that it shows is named, one that it
/// would have shown and does not is taken off.
pub fn settle(bench: &Bench, found: Found, dummy: &Record) -> (Found, Vec<Dummy>) {
    let (problem, plain) = spring(bench, dummy);
    let mut found = found;
    let mut said = Vec::new();
    for place in 0..found.best.effects.len() {
        let named = found.best.effects[place].clone();
        let mut set: Vec<String> = vec![named.effect.name().to_string()];
        set.extend(found.rivals.get(place).cloned().unwrap_or_default());
        let mut others = found.best.effects.clone();
        others.remove(place);
        // Every member with its values in the records.
        let members: Vec<(&'static dyn Cause, Fit)> = set
            .iter()
            .filter_map(|name| find(name))
            .filter_map(|cause| Some((cause, in_place(bench, &found, &others, place, cause)?)))
            .collect();
        let mut shown: Vec<String> = Vec::new();
        let mut excluded: Vec<String> = Vec::new();
        for (cause, fit) in members.iter().filter(|m| m.0.kind() == Kind::Measurement) {
            let acting = fit.effect(cause.name());
            let Some(acting) = acting else { continue };
            let ruling = examine(&problem, &plain, *cause, acting);
            match ruling.ruling {
                Ruling::Shown => shown.push(ruling.name.clone()),
                Ruling::Excluded => excluded.push(ruling.name.clone()),
                Ruling::Open => {}
            }
            said.push(ruling);
        }
        let stays = |name: &str| match shown.is_empty() {
            true => !excluded.iter().any(|e| e == name),
            false => shown.iter().any(|s| s == name),
        };
        let left: Vec<&(&'static dyn Cause, Fit)> =
            members.iter().filter(|m| stays(m.0.name())).collect();
        let best = left.iter().min_by(|a, b| a.1.misfit.total_cmp(&b.1.misfit));
        let Some((cause, fit)) = best else { continue };
        if cause.name() != named.effect.name() {
            found.best = fit.clone();
        }
        let rivals = left.iter().map(|m| m.0.name().to_string());
        let rivals = rivals.filter(|name| name != cause.name()).collect();
        if let Some(list) = found.rivals.get_mut(place) {
            *list = rivals;
        }
    }
    (found, said)
}

/// The joint refit with the cause in the named one's place, effects in the same order.
fn in_place(
    bench: &Bench,
    found: &Found,
    others: &[Acting],
    place: usize,
    cause: &'static dyn Cause,
) -> Option<Fit> {
    if found.best.effects[place].effect.name() == cause.name() {
        return Some(found.best.clone());
    }
    let starts = cause.starts(&bench.scale).into_iter().map(|values| Acting {
        effect: cause.effect(),
        values,
    });
    let starts: Vec<Acting> = starts.collect();
    let without = refit(&bench.train, &found.best, others.to_vec());
    let mut scored = crate::identify::scores(&bench.train, &without, &starts);
    scored.sort_by(|a, b| b.fall.total_cmp(&a.fall));
    let fits = scored.iter().take(2).map(|score| {
        let mut effects = others.to_vec();
        effects.insert(place, score.acting.clone());
        refit(&bench.train, &without, effects)
    });
    fits.min_by(|a, b| a.misfit.total_cmp(&b.misfit))
}
