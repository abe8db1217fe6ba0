//! Every cause tried beside a current set: scored at its vanishing size, the promising ones refitted
//! jointly with the baseline.

use super::forms::{by_form, of_other_forms, starts};
use super::refinements::refined;
use super::search::MOST;
use rayon::prelude::*;

use crate::causes::{CATALOGUE, Cause, Scale, find};
use crate::identify::{Fit, Problem, Score, refit, refit_below, scores};
use crate::joint::effect::Acting;

/// Fall of the whitened misfit, per excess dispersion, that makes one model likelier than another one, where each has
/// its own beginnings, drives or sets of causes: the largest of many correlated χ²₁ and χ²₂ falls over the catalogue's
/// shapes, and the penalty of two values (ln n each) on top.
pub const ALARM: f64 = 30.0;

/// Evidence, its penalty taken off, that a cause must have beside noise.
///
/// Of 88 clean records of the laboratory, under each kind of noise in turn, the largest evidence of a cause that lowers
/// the errors themselves was −7 in the median, 2 in one of ten, and 19, 8.5 and 8.1 in the largest; where it was 19
/// held-out samples spoke against it.
const CHANCE: f64 = 20.0;

/// Part of the noise's variance that a cause must bring all along the record: less than a tenth of the noise in
/// rms may as well be what grids and steps of a model are wrong by.
const TENTH: f64 = 0.01;

/// Evidence that a cause must have: [`CHANCE`], and in long records a tenth of the noise.
pub fn alarm(problem: &Problem) -> f64 {
    CHANCE.max(TENTH * problem.independent_rows())
}

/// One cause fitted jointly with everything else in the set.
#[derive(Debug, Clone)]
pub struct Trial {
    /// The cause.
    pub cause: &'static dyn Cause,
    /// The joint refit with it; only begun where it has no prospect of coming near the best.
    pub fit: Fit,
    /// Evidence against the set without it: fall of the misfit over the dispersion left, less the
    /// penalty for its parameters; the penalty alone where the values are another cause's.
    pub evidence: f64,
    /// False where the fitted values are another cause's, be they those of one that was in the set before.
    pub plausible: bool,
}

impl Trial {
    /// What a fit with the cause brings over the one without it.
    pub(super) fn of(
        (problem, scale): (&Problem, &Scale),
        cause: &'static dyn Cause,
        without: &Fit,
        fit: Fit,
    ) -> Trial {
        let fall = (without.misfit - fit.misfit) / dispersion(problem, &fit);
        let plausible = all_plausible(scale, &fit);
        let free = free(cause, fit.effect(cause.name()));
        Trial {
            cause,
            evidence: if plausible { fall } else { 0.0 } - penalty(problem, free),
            plausible,
            fit,
        }
    }

    /// The cause as it was fitted; `None` where its refit was not worth beginning.
    pub fn own(&self) -> Option<&Acting> {
        self.fit.effect(self.cause.name())
    }
}

impl std::fmt::Debug for dyn Cause {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// How much work trials may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// The best few by their scores, and what no score foretells, one shape each: enough to tell what is noise.
    Quick,
    /// Every cause whose score is worth a refit.
    Full,
}

/// Causes refitted in a quick pass.
const LEADING: usize = 4;

/// Those that set the bound of a full one.
const FIRST: usize = 2;

/// Shapes of a cause that are refitted in a full pass; of a mass that rings, whose wrong sizes ring otherwise, more
/// beside up to one other cause.
pub(super) const SHAPES: usize = 2;
const OF_A_MASS: usize = 8;

/// Share of the highest score below which no refit is tried: the score is the fall to first order.
const WORTH: f64 = 0.03;

/// Fall to first order below which no refit is tried either.
pub(super) const PROMISING: f64 = 0.25 * ALARM;

/// Falls to first order that a refit is credited with at most. Judged: four to five times the score were seen.
const FORETOLD: f64 = 20.0;

/// Share of the fall that is wanted by which a law may stay behind before its refinements are fitted.
pub(super) const UNREFINED: f64 = 0.1;

/// Share of the leader's fall by which a refit may stay behind that goes on where it ended.
const NEAR: f64 = 0.02;

/// Share of the leader's fall by which a refit may stay behind before it is given up.
pub(super) const BEHIND: f64 = 0.15;

/// Tries the `usable` causes beside the current set by every sample of a problem, best first; a refit without prospect of
/// a misfit below `wanted` is given up.
pub(super) fn of_all_samples(
    usable: impl Fn(&dyn Cause) -> bool,
    problem: &Problem,
    scale: &Scale,
    current: &Fit,
    (effort, wanted): (Effort, f64),
) -> Vec<Trial> {
    let mut scored = scored((usable, |_: &Acting| true), problem, scale, current);
    let first = |s: &Scored| s.1.first().map_or(0.0, |s| s.fall);
    scored.sort_by(|a, b| first(b).total_cmp(&first(a)));
    let highest = scored.first().map_or(0.0, first);
    let worth = (WORTH * highest).max(PROMISING);
    let (leading, shapes) = match effort {
        Effort::Quick => (LEADING, 1),
        Effort::Full => (FIRST, SHAPES),
    };
    // A mass takes many refits, which a bound saves: it leads where its score is the highest.
    let rings = |s: &Scored| s.1.iter().any(|s| problem.hauls(&s.acting));
    let behind = scored.iter().skip(1).position(rings);
    if let Some(behind) = behind.filter(|_| effort == Effort::Full) {
        scored[1 + behind..].rotate_left(1);
    }
    let (leading, others) = scored.split_at(leading.min(scored.len()));
    let tried = |s: &&Scored| effort == Effort::Full || s.1.iter().any(unforetold);
    let others: Vec<&Scored> = others.iter().filter(tried).collect();
    let try_one = |(cause, scores): &Scored, bound: f64| {
        // What a refinement takes away is not known before it is fitted.
        let bound = bound + UNREFINED * (current.misfit - bound).max(0.0);
        let foretold = |s: &&Score| s.fall > worth.max((current.misfit - bound) / FORETOLD);
        let rings = |s: &Score| problem.hauls(&s.acting);
        let shapes = match scores.iter().any(rings) && current.effects.len() + 1 < MOST {
            true if shapes == SHAPES => OF_A_MASS,
            _ => shapes,
        };
        let first = &scores[..shapes.min(scores.len())];
        let mut begun: Vec<&Score> = first.iter().filter(foretold).collect();
        if effort == Effort::Full {
            begun.extend(of_other_forms(scores, first.len()).filter(foretold));
        }
        if !begun.iter().any(|s| sticks(&s.acting)) {
            begun.extend(scores.iter().find(|s| unforetold(s)));
        }
        // What a form is worth is known when its refinements are: a cube that hardens holds only as far as it levels off.
        let of_form = |before: Option<Trial>, form: &[&Score]| {
            let unrefined = UNREFINED
                * before
                    .as_ref()
                    .map_or(0.0, |b| current.misfit - b.fit.misfit);
            let bound = before
                .as_ref()
                .map_or(bound, |b| bound.min(b.fit.misfit + unrefined));
            let starts = starts(problem, current, form, (SHAPES, bound)).into_iter();
            let fit = starts.fold(current.clone(), |best, (start, leads_on)| {
                // A second shape has to do better than the first.
                let bound = match best.effects.len() > current.effects.len() {
                    true => bound.min(best.misfit),
                    false => bound,
                };
                let fit = match leads_on {
                    true => refit_below(problem, &start, start.effects.clone(), bound),
                    false => start,
                };
                if fit.misfit < best.misfit { fit } else { best }
            });
            let fit = match fit.misfit < bound {
                true => refined((problem, scale), *cause, current.misfit, fit),
                false => fit,
            };
            let trial = Trial::of((problem, scale), *cause, current, fit);
            match before.filter(|b| !trial.beats(problem, b)) {
                Some(before) => Some(before),
                None => Some(trial),
            }
        };
        let trial = by_form(&begun)
            .iter()
            .map(Vec::as_slice)
            .fold(None, of_form);
        trial.unwrap_or_else(|| Trial::of((problem, scale), *cause, current, current.clone()))
    };
    let leading: Vec<&Scored> = leading.iter().collect();
    led(
        (problem, scale),
        current,
        (effort, wanted),
        (leading, others),
        (BEHIND, try_one),
    )
}

/// Trials of what leads, then those of the others as far as they may come near those with values of their own, best first.
pub(super) fn led<T: Sync>(
    (problem, scale): (&Problem, &Scale),
    current: &Fit,
    (effort, wanted): (Effort, f64),
    (leading, others): (Vec<&T>, Vec<&T>),
    (behind, try_one): (f64, impl Fn(&T, f64) -> Trial + Sync),
) -> Vec<Trial> {
    let leading = leading.into_par_iter();
    let mut trials: Vec<Trial> = leading.map(|one| try_one(one, wanted)).collect();
    let plausible = trials.iter().filter(|t| t.plausible);
    let lowest = plausible.fold(current.misfit, |least, t| least.min(t.fit.misfit));
    let bound = wanted.min(lowest + behind * (current.misfit - lowest) + ALARM);
    trials.par_extend(others.into_par_iter().map(|one| try_one(one, bound)));
    if effort == Effort::Full {
        trials = settled((problem, scale), current, trials, wanted);
    }
    trials.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
    trials
}

/// Those of the trials that come near the best and what is `wanted`, refitted once more from where they ended: valleys are
/// long, and rivals are told apart by little.
fn settled(
    (problem, scale): (&Problem, &Scale),
    current: &Fit,
    trials: Vec<Trial>,
    wanted: f64,
) -> Vec<Trial> {
    let lowest = trials
        .iter()
        .filter(|t| t.plausible)
        .min_by(|a, b| a.fit.misfit.total_cmp(&b.fit.misfit));
    let Some(lowest) = lowest.map(|t| &t.fit) else {
        return trials;
    };
    let margin = NEAR * (current.misfit - lowest.misfit) + ALARM * dispersion(problem, lowest);
    let within = lowest.misfit.min(wanted) + margin;
    let once_more = |trial: Trial| match trial.own().is_some() && trial.fit.misfit < within {
        true => {
            let fit = refit(problem, &trial.fit, trial.fit.effects.clone());
            Trial::of((problem, scale), trial.cause, current, fit)
        }
        false => trial,
    };
    trials.into_par_iter().map(once_more).collect()
}

/// True where the first order tells nothing: of contacts that let go one by one the misfit may fall although no
/// small part of it does.
fn unforetold(score: &Score) -> bool {
    score.fall == 0.0 && sticks(&score.acting)
}

fn sticks(acting: &Acting) -> bool {
    acting.effect.sticking(&acting.values) > 0.0
}

/// What was tried of a cause; `None` where it was not.
pub(super) fn trial_of<'a>(trials: &'a [Trial], name: &str) -> Option<&'a Trial> {
    trials.iter().find(|t| t.cause.name() == name)
}

/// True where one of the trials leaves less than a misfit, with values of its own.
pub(super) fn one_leaves(trials: &[Trial], misfit: f64) -> bool {
    trials.iter().any(|t| t.plausible && t.fit.misfit < misfit)
}

/// χ² per degree of freedom, at least one: differences of misfit count only as far as the best
/// model reaches the noise.
pub fn dispersion(problem: &Problem, fit: &Fit) -> f64 {
    (fit.misfit / problem.rows().max(1) as f64).max(1.0)
}

/// True where no cause of a set has values that are another cause's.
pub fn all_plausible(scale: &Scale, fit: &Fit) -> bool {
    implausible(scale, fit).is_none()
}

/// Place in a set of the first cause that has values of another.
pub fn implausible(scale: &Scale, fit: &Fit) -> Option<usize> {
    let plausible =
        |a: &Acting| find(a.effect.name()).is_none_or(|c| c.plausible(&a.values, scale));
    fit.effects.iter().position(|a| !plausible(a))
}

pub(super) type Scored = (&'static dyn Cause, Vec<Score>);

/// Every usable cause with the scores of those of its shapes that are `wanted`, best first.
pub(super) fn scored(
    (usable, wanted): (impl Fn(&dyn Cause) -> bool, impl Fn(&Acting) -> bool),
    problem: &Problem,
    scale: &Scale,
    current: &Fit,
) -> Vec<Scored> {
    let usable: Vec<&'static dyn Cause> = CATALOGUE
        .iter()
        .copied()
        .filter(|c| usable(*c))
        .filter(|c| !current.effects.iter().any(|a| a.effect.name() == c.name()))
        .collect();
    let starts: Vec<Acting> = usable
        .iter()
        .flat_map(|&cause| {
            let shapes = cause.starts(scale).into_iter();
            shapes.map(|values| Acting {
                effect: cause.effect(),
                values,
            })
        })
        .filter(wanted)
        .collect();
    let found = scores(problem, current, &starts);
    let of = |cause: &'static dyn Cause| {
        let own = found
            .iter()
            .filter(|s| s.acting.effect.name() == cause.name());
        let mut own: Vec<Score> = own.cloned().collect();
        // What the first order takes for the best size is none where it tells nothing.
        let as_begun = starts
            .iter()
            .filter(|a| a.effect.name() == cause.name() && sticks(a));
        own.extend(as_begun.map(|acting| Score {
            acting: acting.clone(),
            fall: 0.0,
        }));
        own.sort_by(|a, b| b.fall.total_cmp(&a.fall));
        (cause, own)
    };
    usable.into_iter().map(of).collect()
}

/// Half the information criterion's penalty of a cause's free values, doubled: `k ln n`.
pub(super) fn penalty(problem: &Problem, free: usize) -> f64 {
    free as f64 * (problem.rows().max(3) as f64).ln()
}

/// Count of values that were fitted: all but the neutral ones.
fn free(cause: &dyn Cause, fitted: Option<&Acting>) -> usize {
    fitted.map_or(cause.parameters().len(), Acting::free)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;

    #[test]
    fn no_score_is_final_only_where_the_first_order_tells_something() {
        let score = |name: &str, values: &[f64], fall: f64| {
            let effect = find(name).unwrap().effect();
            let values = values.to_vec();
            let acting = Acting { effect, values };
            unforetold(&Score { acting, fall })
        };
        assert!(score("static_friction_drop", &[0.1, 0.0, 2.0], 0.0));
        assert!(!score("static_friction_drop", &[0.1, 0.0, 2.0], 1.0));
        // All contacts together let go by degrees.
        assert!(!score("static_friction_drop", &[0.1, 1e-6, 2.0], 0.0));
        assert!(!score("viscous_damping", &[1.0, 0.0], 0.0));
        // A mass changes the turning points in jumps, and foretells what it takes away.
        assert!(!score("fixture_inertia", &[1.0], 0.0));
    }

    #[test]
    fn a_set_is_as_plausible_as_its_causes() {
        let scale = Scale {
            period: 0.05,
            slowest: 0.05,
            ..Scale::default()
        };
        let set = |memory: f64| Fit {
            coefficients: Vec::new(),
            offsets: Vec::new(),
            effects: [
                ("viscous_damping", vec![1.0, 0.0]),
                ("velocity_weakening", vec![0.1, 1e-3, memory, 1.0]),
            ]
            .map(|(name, values)| Acting {
                effect: find(name).unwrap().effect(),
                values,
            })
            .to_vec(),
            series: None,
            misfit: 0.0,
        };
        assert!(all_plausible(&scale, &set(1e-3)));
        // A rate that is remembered for hundreds of cycles.
        assert!(!all_plausible(&scale, &set(20.0)));
    }
}
