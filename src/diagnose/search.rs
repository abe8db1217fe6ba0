//! The search: every cause scored at its vanishing size, the promising ones refitted jointly with
//! the baseline, the best set grown forward and pruned backward.

use super::prepare::Bench;
use super::tested::{Prospect, tested};
use super::trials::{ALARM, Effort, Trial, dispersion, trials};
use super::verdict::NEGLIGIBLE;
use crate::identify::{Fit, Problem, refit};

/// Share of the misfit beyond noise that a further cause must explain: a weaker one may as well be
/// the named cause's law being only nearly right.
const FURTHER_SHARE: f64 = 0.10;

/// Share of its rows below which no misfit falls: the noise may have been estimated too large, by a
/// factor of 1.4 at most.
const OVERRATED: f64 = 0.5;

/// Causes, best first, whose prediction of held-out cycles is looked at in one round.
const PREDICTORS: usize = 4;

/// Most causes named together.
const MOST: usize = 3;

/// What the search found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The baseline on the training samples.
    pub baseline: Fit,
    /// The named set on the training samples; the baseline's fit where nothing is named.
    pub best: Fit,
    /// Every cause tried alone beside the baseline, best first.
    pub trials: Vec<Trial>,
    /// For each named cause, in the order of `best.effects`: rivals that do as well in its place.
    pub rivals: Vec<Vec<String>>,
    /// For each named cause: evidence it brings beside the others.
    pub evidence: Vec<f64>,
}

/// The set of causes alone, found in a quick pass: what it leaves tells the noise.
pub fn quick(bench: &Bench, timed: bool, baseline: &Fit) -> Fit {
    grown(bench, timed, baseline, Effort::Quick).0
}

/// Grows the set of causes, prunes it, tests it on held-out cycles, and lists rivals.
pub fn search(bench: &Bench, timed: bool, baseline: Fit) -> Found {
    let (best, first) = grown(bench, timed, &baseline, Effort::Full);
    let best = exchanged(bench, timed, &baseline, best);
    let best = tested(bench, &baseline, best);
    let (rivals, evidence) = rivals(bench, timed, &best, &first);
    Found {
        baseline,
        best,
        trials: first,
        rivals,
        evidence,
    }
}

/// Forward selection with joint refits and pruning; the set, and the trials beside the baseline.
///
/// Of the causes with enough evidence, the one is taken that lowers the squared error most, held-out
/// samples included, of those that [`Prospect::holds`] lets pass.
fn grown(bench: &Bench, timed: bool, baseline: &Fit, effort: Effort) -> (Fit, Vec<Trial>) {
    let problem = &bench.train;
    let least = least(problem, baseline);
    let mut current = baseline.clone();
    let mut first: Option<Vec<Trial>> = None;
    for round in 0..MOST {
        let enough = match round {
            0 => f64::INFINITY,
            _ => current.misfit - least,
        };
        if enough < OVERRATED * problem.rows() as f64 {
            break;
        }
        let trials = trials(problem, &bench.scale, timed, &current, (effort, enough));
        let enough = |t: &Trial| t.fit.misfit < enough;
        let mut promising = trials.iter().filter(|t| t.evidence >= ALARM && enough(t));
        let next = match effort {
            Effort::Quick => promising.next(),
            Effort::Full => promising
                .take(PREDICTORS)
                .map(|t| (t, Prospect::of(bench, &current, &t.fit)))
                .filter(|(_, prospect)| prospect.holds())
                .max_by(|(_, a), (_, b)| a.total().total_cmp(&b.total()))
                .map(|(t, _)| t),
        };
        let next = next.map(|t| t.fit.clone());
        first.get_or_insert(trials);
        match next {
            Some(fit) => current = prune(problem, fit, least),
            None => break,
        }
    }
    (current, first.unwrap_or_default())
}

/// Misfit that one cause of several has to take away beside the others.
fn least(problem: &Problem, baseline: &Fit) -> f64 {
    FURTHER_SHARE * (baseline.misfit - problem.rows() as f64).max(0.0)
}

/// Exchanges one cause of several for another as long as that lowers the squared error, held-out
/// samples included: the first cause was chosen before the others were known.
fn exchanged(bench: &Bench, timed: bool, baseline: &Fit, mut best: Fit) -> Fit {
    let problem = &bench.train;
    for _ in 0..MOST {
        if best.effects.len() < 2 {
            break;
        }
        let gain = |t: &Trial| Prospect::of(bench, &best, &t.fit).total();
        let better = (0..best.effects.len())
            .flat_map(|place| {
                let mut others = best.effects.clone();
                let named = others.remove(place).effect.name();
                let without = refit(problem, &best, others);
                let wanted = 0.5 * (best.misfit + without.misfit);
                let mut trials = trials(
                    problem,
                    &bench.scale,
                    timed,
                    &without,
                    (Effort::Full, wanted),
                );
                trials.retain(|t| t.plausible && t.fit.misfit < wanted && t.cause.name() != named);
                trials
            })
            .map(|t| (gain(&t), t.fit))
            .filter(|(gain, _)| *gain > ALARM * dispersion(problem, &best))
            .max_by(|(a, _), (b, _)| a.total_cmp(b));
        match better {
            Some((_, fit)) => best = prune(problem, fit, least(problem, baseline)),
            None => break,
        }
    }
    best
}

/// Drops causes that the others have made needless; `least` is what one has to take away.
fn prune(problem: &Problem, mut fit: Fit, least: f64) -> Fit {
    while fit.effects.len() > 1 {
        let without: Option<Fit> = (0..fit.effects.len())
            .map(|drop| {
                let mut effects = fit.effects.clone();
                effects.remove(drop);
                refit(problem, &fit, effects)
            })
            .min_by(|a, b| a.misfit.total_cmp(&b.misfit));
        match without {
            Some(less)
                if less.misfit - fit.misfit < least.max(ALARM * dispersion(problem, &fit)) =>
            {
                fit = less;
            }
            _ => break,
        }
    }
    fit
}

/// For each named cause: who else does as well in its place, and what it brings.
///
/// `first` are the trials beside the baseline: they are those of a single cause's place.
fn rivals(bench: &Bench, timed: bool, best: &Fit, first: &[Trial]) -> (Vec<Vec<String>>, Vec<f64>) {
    let problem = &bench.train;
    let mut all = Vec::new();
    let mut evidence = Vec::new();
    for place in 0..best.effects.len() {
        let mut others = best.effects.clone();
        let named = others.remove(place);
        let without = refit(problem, best, others);
        let scale = dispersion(problem, best);
        let brought = without.misfit - best.misfit;
        evidence.push(brought / scale);
        let rows = problem.rows() as f64;
        let left = (best.misfit - rows - SCATTER * (2.0 * rows).sqrt()).max(0.0);
        let unseen = left.min(NEARLY * brought).min(NEGLIGIBLE * rows * scale);
        let as_well = best.misfit + MARGIN * scale + unseen;
        let wanted = (Effort::Full, as_well);
        let anew = match best.effects.len() {
            1 => None,
            _ => Some(trials(problem, &bench.scale, timed, &without, wanted)),
        };
        let rivals = anew
            .as_deref()
            .unwrap_or(first)
            .iter()
            .filter(|t| t.plausible && t.cause.name() != named.effect.name())
            .filter(|t| t.fit.misfit < as_well)
            .map(|t| t.cause.name().to_string())
            .collect();
        all.push(rivals);
    }
    (all, evidence)
}

/// Difference of misfit, in noise variances, within which two causes count as equally good: a
/// likelihood ratio of exp(−5), less than one wrong in a hundred.
const MARGIN: f64 = 10.0;

/// Share of what the named cause brings by which a rival may fall short of it and still be listed:
/// the law of a cause is only nearly that of the joint measured, so a strong effect tells two
/// causes apart no better than their laws are true. What the named cause leaves beyond the scatter of
/// noise bounds it, for a law that leaves nothing is right, and so does what the test of structure
/// would not see, [`NEGLIGIBLE`] of the noise.
pub const NEARLY: f64 = 0.01;

/// Standard deviations by which a sum of squares of noise alone may exceed its mean.
const SCATTER: f64 = 2.0;
