//! Causes of long records tried by few of their samples first: the others decide between those that come near.

use super::places::scatter;
use super::refinements::refined_nearby;
use super::trials::{self, ALARM, Effort, Trial, led, of_all_samples};
use crate::causes::{Cause, Scale};
use crate::identify::operators::Operators;
use crate::identify::{Fit, Problem, refit, refit_below, suited};

/// Independent samples that a first look is content with. What a cause has to bring grows with a record, a hundredth
/// of the noise's variance per sample: of so many that is 5½ standard deviations of what is seen.
const MOST: f64 = 3000.0;

/// Noise variances of the explainable misfit that a first look is content with where there is more of that: causes that bring a tenth
/// of it are then as plain.
const LEADER: f64 = 300.0;

/// Fewest independent samples of a first look.
const FEWEST: f64 = 1000.0;

/// Share of what a cause takes away by which its values, told by few samples, may leave more than they will.
const ASTRAY: f64 = 0.03;

/// Share of the leader's fall by which a cause may stay behind that is fitted to all samples: few have shown what its
/// refinements bring.
pub(super) const BEHIND: f64 = 0.05;

/// Share of a misfit that a set may leave more of few samples than of all: turning points stay all, and are counted for as
/// much as the others; limits that follow what the joint does follow longer steps.
const COARSE: f64 = 0.15;

/// Standard deviations of what few samples say of a fall by which less than is wanted may be enough.
const SCATTER: f64 = 3.0;

/// Tries every cause beside the current set, best first; a refit without prospect of a misfit below `wanted` is given up.
pub fn trials(
    problem: &Problem,
    scale: &Scale,
    timed: bool,
    current: &Fit,
    asked: (Effort, f64),
) -> Vec<Trial> {
    let usable = |c: &dyn Cause| c.is_told(timed);
    trials_of(usable, problem, scale, current, asked)
}

/// The same of the causes that are `usable` alone.
pub fn trials_of(
    usable: impl Fn(&dyn Cause) -> bool,
    problem: &Problem,
    scale: &Scale,
    current: &Fit,
    asked: (Effort, f64),
) -> Vec<Trial> {
    match Coarsely::of(problem, current) {
        Some(coarsely) => coarsely.trials_of(usable, (problem, scale), current, asked),
        None => of_all_samples(usable, problem, scale, current, asked),
    }
}

/// Trials that were made on other `cells`, beside another drive or in other noise, by these: fitted anew from where they
/// ended as far as they come near.
pub(super) fn trials_again(
    (known, cells): (&[Trial], &Operators),
    (problem, scale): (&Problem, &Scale),
    current: &Fit,
    asked: (Effort, f64),
) -> Vec<Trial> {
    let carried = |known: &Trial| {
        let mut here = known.clone();
        here.fit.coefficients = cells.carried(&known.fit.coefficients, &problem.operators);
        here
    };
    let here: Vec<Trial> = known.iter().map(carried).collect();
    from_these(&here, (problem, scale), current, asked, trials::BEHIND)
}

/// Trials from where these ended, of which the first leads and others may stay behind by a share of its fall.
fn from_these(
    ended: &[Trial],
    (problem, scale): (&Problem, &Scale),
    current: &Fit,
    asked: (Effort, f64),
    behind: f64,
) -> Vec<Trial> {
    let leading = ended.iter().take(1).collect();
    let others = ended.iter().skip(1).collect();
    let onward = |one: &Trial, bound: f64| onward((problem, scale), current, one, bound);
    let ways = (leading, others);
    led((problem, scale), current, asked, ways, (behind, onward))
}

/// A problem with few of its samples, and a set that suits these.
pub(super) struct Coarsely {
    problem: Problem,
    current: Fit,
    /// Independent samples of which one was left.
    every: f64,
}

impl Coarsely {
    /// `None` of records that are short, and of a set that does not suit few samples as well as all.
    pub(super) fn of(problem: &Problem, current: &Fit) -> Option<Coarsely> {
        let explainable = current.misfit - problem.rows() as f64;
        let enough = LEADER * problem.independent_rows() / explainable.max(0.0);
        let enough = enough.clamp(FEWEST, MOST);
        let few = problem.coarser((enough as usize, MOST as usize))?;
        let own = refit(&few, current, current.effects.clone());
        let every = problem.independent_rows() / few.independent_rows();
        let rows = few.rows() as f64;
        let of_all = rows + explainable / every;
        let suits = own.misfit < (1.0 + COARSE) * of_all + scatter(rows) * of_all / rows;
        suits.then_some(Coarsely {
            every,
            current: own,
            problem: few,
        })
    }

    /// Misfit of few samples that answers to one of all.
    fn wanted(&self, current: &Fit, wanted: f64) -> f64 {
        let fall = (current.misfit - wanted) / self.every;
        // Two models that differ by λ leave λ ± 2√λ.
        self.current.misfit - fall + SCATTER * 2.0 * fall.max(0.0).sqrt()
    }

    /// Trials by all samples, from where few led.
    fn trials_of(
        &self,
        usable: impl Fn(&dyn Cause) -> bool,
        (problem, scale): (&Problem, &Scale),
        current: &Fit,
        (effort, wanted): (Effort, f64),
    ) -> Vec<Trial> {
        let asked = (effort, self.wanted(current, wanted));
        let few = of_all_samples(usable, &self.problem, scale, &self.current, asked);
        from_these(&few, (problem, scale), current, (effort, wanted), BEHIND)
    }

    /// A set that is fitted `by_few` samples, from what suits them and below a misfit, fitted to all where it comes near
    /// `bound` of those.
    pub(super) fn fitted(
        &self,
        (problem, current): (&Problem, &Fit),
        bound: f64,
        by_few: impl FnOnce(&Problem, &Fit, f64) -> Option<Fit>,
    ) -> Option<Fit> {
        let wanted = self.wanted(current, bound);
        let few = by_few(&self.problem, &self.current, wanted)?;
        Some(to_all(problem, current, &few, bound))
    }
}

/// A set as few samples, or other cells, have told it, fitted to all where it comes near a misfit of `bound`.
fn to_all(problem: &Problem, current: &Fit, few: &Fit, bound: f64) -> Fit {
    let begun = suited(problem, few, few.effects.clone());
    let astray = ASTRAY * (current.misfit - begun.misfit).max(0.0) + ALARM;
    if begun.misfit - astray >= bound {
        return begun;
    }
    let misfit = current.misfit;
    let start = Fit { misfit, ..begun };
    refit_below(problem, &start, start.effects.clone(), bound)
}

/// A cause as few samples, or other cells, have told it, fitted to all and refined where it leaves less than `bound`.
fn onward((problem, scale): (&Problem, &Scale), current: &Fit, few: &Trial, bound: f64) -> Trial {
    let fit = match few.own() {
        None => current.clone(),
        Some(_) => to_all(problem, current, &few.fit, bound),
    };
    let fit = match fit.misfit < bound {
        true => refined_nearby((problem, scale), few.cause, fit),
        false => fit,
    };
    Trial::of((problem, scale), few.cause, current, fit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::prepare::{Bench, prepare};
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::record::Record;
    use crate::record::colour::Colour;
    use crate::record::noise::tests::drawn;

    /// A record of `samples` a quarter of whose stiffness creeps, of a joint that slips as well, in white noise: where
    /// nothing slips a film between its surfaces answers alike.
    fn creeping(samples: u32) -> Bench {
        let mut noise = drawn(20261128);
        let time: Vec<f64> = (0..samples).map(|i| 0.01 * f64::from(i)).collect();
        let level = |t: &f64| if *t < 80.0 { 40.0 } else { 60.0 };
        let force: Vec<f64> = time.iter().map(|t| level(t) * (0.5 * t).sin()).collect();
        let (mut crept, mut slipped) = (0.0, 0.0_f64);
        let mut lagged = |f: &f64| {
            crept += (0.25 * f - crept) * 0.01 / 0.6;
            slipped = slipped.clamp(f - 20.0, f + 20.0);
            1e-8 * (f + 0.5 * slipped + crept)
        };
        let record = Record {
            name: "creeping".to_string(),
            displacement: force.iter().map(|f| lagged(f) + 3e-9 * noise()).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        prepare(Form::Play, &[record], &[Beginning::default()])
    }

    /// What few samples have told is fitted to all, and weighed by all.
    #[test]
    fn many_samples_are_tried_by_few_with_the_same_end() {
        let bench = creeping(16_000);
        let Bench { train, scale, .. } = &bench;
        let first = baseline(train);
        let asked = (Effort::Full, f64::INFINITY);
        let coarsely = Coarsely::of(train, &first).unwrap();
        assert!(coarsely.every > 3.0 && coarsely.problem.rows() < train.rows() / 3);
        let few = trials(train, scale, true, &first, asked);
        let all = of_all_samples(|_| true, train, scale, &first, asked);
        assert_eq!(few.len(), all.len());
        let best = [&few, &all].map(|trials| &trials[0]);
        assert!(best.iter().all(|t| t.cause.name() == "creep"));
        let apart = best[0].fit.misfit - best[1].fit.misfit;
        assert!(apart.abs() < 1.0, "{apart}");
        for own in &few {
            let (left, _) = train.misfit(&own.fit.predict(train));
            assert!(
                (left / own.fit.misfit - 1.0).abs() < 1e-9,
                "{}",
                own.cause.name()
            );
        }
        // As many trials of a short record are those of all its samples.
        let short = creeping(3000);
        assert!(Coarsely::of(&short.train, &baseline(&short.train)).is_none());
    }

    /// Of slow noise few samples say much: the fewer are asked the more there is to explain.
    #[test]
    fn a_set_that_leaves_noise_is_asked_by_more() {
        let mut bench = creeping(14_000);
        let record = &mut bench.train.records[0];
        // White noise less half of that before has 1.25 times its variance.
        record.colour = Colour::first_order(0.5);
        record.weight.iter_mut().for_each(|w| *w /= 1.25_f64.sqrt());
        let first = baseline(&bench.train);
        let Bench { train, scale, .. } = &bench;
        let only = |cause: &dyn Cause| cause.name() == "creep";
        let asked = (Effort::Full, f64::INFINITY);
        let left = trials_of(only, train, scale, &first, asked).remove(0).fit;
        let rows = |fit: &Fit| Coarsely::of(&bench.train, fit).unwrap().problem.rows();
        assert!(rows(&left) > rows(&first) + 500);
    }

    /// A set that leaves more of few samples than of all has to be judged by all.
    #[test]
    fn few_samples_that_a_set_does_not_suit_are_not_asked() {
        let bench = creeping(16_000);
        let first = baseline(&bench.train);
        let better = Fit {
            misfit: 0.8 * first.misfit,
            ..first.clone()
        };
        assert!(Coarsely::of(&bench.train, &first).is_some());
        assert!(Coarsely::of(&bench.train, &better).is_none());
    }
}
