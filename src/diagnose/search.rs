//! The search: every cause scored at its vanishing size, the promising ones refitted jointly with
//! the baseline, the best set grown forward and pruned backward.

use rayon::prelude::*;

use super::prepare::Bench;
use crate::causes::{CATALOGUE, Cause, Scale};
use crate::identify::{Fit, Problem, refit, scores};
use crate::joint::effect::Acting;

/// Fall of the whitened misfit, per excess dispersion, that a first cause must bring.
///
/// The largest fall over the catalogue's shapes on clean records is a maximum of correlated χ²₁
/// and χ²₂ variables: its 99 % quantile for the count of shapes used lies near 16; the penalty for
/// two parameters at the sample counts of interest (ln n each) brings it to this.
pub const ALARM: f64 = 30.0;

/// Share of the misfit beyond noise that a further cause must explain: a weaker one may as well be
/// the named cause's law being only nearly right.
const FURTHER_SHARE: f64 = 0.10;

/// Most causes named together.
const MOST: usize = 3;

/// One cause fitted jointly with everything else in the set.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The cause.
    pub cause: &'static dyn Cause,
    /// The joint refit with it.
    pub fit: Fit,
    /// Evidence against the set without it: fall of the misfit over the dispersion left, less the
    /// penalty for its parameters.
    pub evidence: f64,
}

impl std::fmt::Debug for dyn Cause {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// What the search found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The baseline on the training samples.
    pub baseline: Fit,
    /// The named set on the training samples; the baseline's fit where nothing is named.
    pub best: Fit,
    /// Every cause tried alone beside the final set's others, best first.
    pub trials: Vec<Trial>,
    /// For each named cause, in the order of `best.effects`: rivals that do as well in its place.
    pub rivals: Vec<Vec<String>>,
    /// For each named cause: evidence it brings beside the others.
    pub evidence: Vec<f64>,
}

/// χ² per degree of freedom, at least one: differences of misfit count only as far as the best
/// model reaches the noise.
pub fn dispersion(problem: &Problem, fit: &Fit) -> f64 {
    (fit.misfit / problem.rows().max(1) as f64).max(1.0)
}

/// Half the information criterion's penalty of a cause's free values, doubled: `k ln n`.
fn penalty(problem: &Problem, cause: &dyn Cause) -> f64 {
    cause.parameters().len() as f64 * (problem.rows().max(3) as f64).ln()
}

/// Tries every cause beside the current set.
pub fn trials(problem: &Problem, scale: &Scale, timed: bool, current: &Fit) -> Vec<Trial> {
    let usable: Vec<&'static dyn Cause> = CATALOGUE
        .iter()
        .copied()
        .filter(|c| timed || !c.needs_time())
        .filter(|c| !current.effects.iter().any(|a| a.effect.name() == c.name()))
        .collect();
    let scored: Vec<Vec<crate::identify::Score>> = usable
        .par_iter()
        .map(|cause| {
            let starts: Vec<Acting> = cause
                .starts(scale)
                .into_iter()
                .map(|values| Acting {
                    effect: cause.effect(),
                    values,
                })
                .collect();
            let mut found = scores(problem, current, &starts);
            found.sort_by(|a, b| b.fall.total_cmp(&a.fall));
            found
        })
        .collect();
    let highest = scored
        .iter()
        .filter_map(|s| s.first())
        .fold(0.0_f64, |a, s| a.max(s.fall));
    let worth = (0.03 * highest).max(0.25 * ALARM);
    let mut trials: Vec<Trial> = usable
        .par_iter()
        .zip(&scored)
        .map(|(&cause, scored)| {
            let best = scored
                .iter()
                .take(2)
                .filter(|s| s.fall > worth)
                .map(|s| {
                    let mut effects = current.effects.clone();
                    effects.push(s.acting.clone());
                    refit(problem, current, effects)
                })
                .min_by(|a, b| a.misfit.total_cmp(&b.misfit));
            let fit = best.unwrap_or_else(|| current.clone());
            let fall = (current.misfit - fit.misfit) / dispersion(problem, &fit);
            let evidence = fall - penalty(problem, cause);
            Trial {
                cause,
                fit,
                evidence,
            }
        })
        .collect();
    trials.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    trials
}

/// Grows the set of causes, prunes it, and lists rivals.
pub fn search(bench: &Bench, timed: bool, baseline: Fit) -> Found {
    let problem = &bench.train;
    let mut current = baseline.clone();
    let mut first: Option<Vec<Trial>> = None;
    for round in 0..MOST {
        let trials = trials(problem, &bench.scale, timed, &current);
        let Some(best) = trials.first().cloned() else {
            break;
        };
        if round == 0 {
            first = Some(trials);
        }
        let beyond = (baseline.misfit - problem.rows() as f64).max(0.0);
        let enough = round == 0 || current.misfit - best.fit.misfit > FURTHER_SHARE * beyond;
        if best.evidence < ALARM || !enough {
            break;
        }
        current = prune(problem, best.fit);
    }
    let trials = first.unwrap_or_default();
    let (rivals, evidence) = rivals(bench, timed, &current);
    Found {
        baseline,
        best: current,
        trials,
        rivals,
        evidence,
    }
}

/// Drops causes that the others have made needless.
fn prune(problem: &Problem, mut fit: Fit) -> Fit {
    while fit.effects.len() > 1 {
        let without: Option<Fit> = (0..fit.effects.len())
            .map(|drop| {
                let mut effects = fit.effects.clone();
                effects.remove(drop);
                refit(problem, &fit, effects)
            })
            .min_by(|a, b| a.misfit.total_cmp(&b.misfit));
        match without {
            Some(less) if (less.misfit - fit.misfit) / dispersion(problem, &fit) < ALARM => {
                fit = less;
            }
            _ => break,
        }
    }
    fit
}

/// For each named cause: who else does as well in its place, and what it brings.
fn rivals(bench: &Bench, timed: bool, best: &Fit) -> (Vec<Vec<String>>, Vec<f64>) {
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
        let rivals = trials(problem, &bench.scale, timed, &without)
            .into_iter()
            .filter(|t| t.cause.name() != named.effect.name())
            .filter(|t| t.fit.misfit - best.misfit < MARGIN * scale + NEARLY * brought)
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
/// causes apart no better than their laws are true.
const NEARLY: f64 = 0.03;
