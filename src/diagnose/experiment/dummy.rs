//! A monolithic dummy measured through the same chain: it has no joint, so that loss, harmonics or
//! phase in it come from the measuring chain alone. That settles joint against chain.

use super::monolithic::Alone;
use super::separability::TOLD;
use crate::causes::{Cause, Kind, find};
use crate::diagnose::prepare::Bench;
use crate::diagnose::search::Found;
use crate::diagnose::trials::{ALARM, dispersion};
use crate::identify::{Fit, Operators, Problem, baseline, refit};
use crate::joint::effect::Acting;
use crate::record::Record;
use crate::record::noise::{Noise, from_differences};
use crate::record::repeats::from_repeats;
use crate::record::resolution::resolution;

/// What a dummy says of one cause of the measuring chain, or of itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Dummy {
    /// Catalogue name; `slip` where it is of the dummy itself.
    pub name: String,
    /// Fall of the dummy's misfit with this cause, in noise variances.
    pub fall: f64,
    /// χ² that the cause, as large as the joint's records would have it, would leave on the dummy: zero for one that
    /// the records do not ask for. Of slip, the fall with the best cause of the chain instead.
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
    /// The dummy cannot tell: it could not have shown it, or it slips.
    Open,
    /// The dummy does not show it, and the records do not ask for it.
    Absent,
    /// The dummy itself slips as a joint does: it is no solid specimen, and names no cause.
    Slips,
}

impl Ruling {
    /// Identifier for programs.
    pub fn name(self) -> &'static str {
        match self {
            Ruling::Shown => "shown",
            Ruling::Excluded => "excluded",
            Ruling::Open => "open",
            Ruling::Absent => "absent",
            Ruling::Slips => "slips",
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
    let noise = Noise {
        deviation: noise.deviation.max(resolution(judged)),
        ..noise
    };
    let record = &mut problem.records[0];
    record.colour = noise.colour;
    // Those that stand alone keep none.
    let counted = record.weight.iter_mut().filter(|w| **w > 0.0);
    counted.for_each(|w| *w = 1.0 / noise.innovation());
    let fit = baseline(&problem);
    (problem, fit)
}

/// What the dummy, which slips or does not and was timed or not, says of a cause that the joint's records would have with
/// the given values. Of what happens once, and without time of what needs it, it says nothing.
fn examine(
    (problem, plain): (&Problem, &Fit),
    (slips, timed): (bool, bool),
    cause: &'static dyn Cause,
    acting: &Acting,
) -> Dummy {
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
    let may_show = !cause.happens_once() && (cause.is_told(timed));
    let ruling = match (fall > ALARM, fall >= PRESENT * power) {
        _ if !may_show => Ruling::Open,
        // Slip has loss and harmonics of its own.
        (true, true) if !slips => Ruling::Shown,
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

/// What a dummy settles.
pub struct Settled {
    /// The set, with names that the dummy excludes taken off.
    pub found: Found,
    /// What the dummy says of each cause of the chain that was in question.
    pub said: Vec<Dummy>,
    /// Where the dummy speaks against a cause that stays named, one clause each.
    pub against: Vec<String>,
}

impl Settled {
    /// What was found, where nobody measured a dummy.
    pub fn without_dummy(found: Found) -> Settled {
        Settled {
            found,
            said: Vec::new(),
            against: Vec::new(),
        }
    }
}

/// Part of what a named cause brings that another has to bring to take its place where a dummy excludes it.
const MOST_OF_IT: f64 = 0.5;

/// Settles ambiguous names by the dummy: a cause of the chain that it shows is named, one that it would have shown and
/// does not is taken off. Where it takes off all that were as good, whoever of the others does most of the work is named;
/// where nobody does, the name stays, and that the dummy speaks against it is said. So is what it shows that nobody
/// asked about, and that it slips itself.
pub fn settle(bench: &Bench, found: Found, dummy: &Record) -> Settled {
    let (problem, plain) = spring(bench, dummy);
    let alone = Alone::of(&problem, &plain, dummy);
    let asked = (alone.slips.is_some(), dummy.time.is_some());
    let mut said: Vec<Dummy> = alone.slips.clone().into_iter().collect();
    let (mut found, mut against) = (found, Vec::new());
    for place in 0..found.best.effects.len() {
        let named = found.best.effects[place].clone();
        let mut set: Vec<String> = vec![named.effect.name().to_string()];
        set.extend(found.rivals.get(place).cloned().unwrap_or_default());
        let others = found.best.others(place);
        // Every member with its values in the records.
        let mut members: Vec<Member> = set
            .iter()
            .filter_map(|name| find(name))
            .filter_map(|cause| Some((cause, in_place(bench, &found, &others, place, cause)?)))
            .collect();
        let as_good = members.len();
        if found.best.effects.len() == 1 {
            members.extend(less_good(&found, &set));
        }
        let rulings = members.iter().map(|(cause, fit)| {
            let acting = fit.effect(cause.name());
            let acting = acting.filter(|_| cause.kind() == Kind::Measurement)?;
            Some(examine((&problem, &plain), asked, *cause, acting))
        });
        let rulings: Vec<Option<Dummy>> = rulings.collect();
        let is = |member: usize, ruling: Ruling| {
            let ruled = rulings[member].as_ref();
            ruled.is_some_and(|r| r.ruling == ruling)
        };
        let shown = (0..as_good).any(|m| is(m, Ruling::Shown));
        let stays = |member: &usize| match shown {
            true => is(*member, Ruling::Shown),
            false => !is(*member, Ruling::Excluded),
        };
        let misfit = |member: &usize| members[*member].1.misfit;
        let least = |a: &usize, b: &usize| misfit(a).total_cmp(&misfit(b));
        let left: Vec<usize> = (0..as_good).filter(stays).collect();
        let best = left.iter().copied().min_by(least);
        let best = best.or_else(|| (as_good..members.len()).filter(stays).min_by(least));
        said.extend(
            rulings
                .iter()
                .take(best.map_or(as_good, |b| as_good.max(b + 1)))
                .flatten()
                .cloned(),
        );
        let Some(best) = best else {
            against.push(format!(
                "{}: the dummy would have shown it and does not",
                named.effect.name()
            ));
            continue;
        };
        let (cause, fit) = &members[best];
        if cause.name() != named.effect.name() {
            let more = (fit.misfit - found.best.misfit) / dispersion(&bench.train, fit);
            if let Some(evidence) = found.evidence.get_mut(place) {
                *evidence -= more;
            }
            found.best = fit.clone();
        }
        let rivals = left.iter().filter(|m| **m != best);
        let rivals = rivals.map(|m| members[*m].0.name().to_string()).collect();
        if let Some(list) = found.rivals.get_mut(place) {
            *list = rivals;
        }
    }
    said.extend(alone.beside(&said));
    Settled {
        found,
        said,
        against,
    }
}

/// A cause, and the joint refit with it in the place in question.
type Member = (&'static dyn Cause, Fit);

/// Causes that were tried alone and do most of what the named one does, without those of the set.
fn less_good(found: &Found, set: &[String]) -> Vec<Member> {
    let brought = found.baseline.misfit - found.best.misfit;
    let enough = found.baseline.misfit - MOST_OF_IT * brought;
    let others = found.trials.iter().filter(|t| {
        let asked = !set.iter().any(|name| name == t.cause.name());
        asked && t.plausible && t.own().is_some() && t.fit.misfit < enough
    });
    others.map(|t| (t.cause, t.fit.clone())).collect()
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
