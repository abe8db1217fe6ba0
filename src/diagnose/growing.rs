//! Sets of causes, grown forward from the baseline and from other first causes, and pruned backward.

use super::beside::Beside;
use super::coarsely::trials_of;
use super::forms::at_other_places;
use super::gridded::stays_on_a_finer_grid;
use super::loud::heard;
use super::places::{self, NEARLY};
use super::prepare::Bench;
use super::tested::{Prospect, beyond_unseen, unseen_beyond_scatter, unseen_rows};
use super::trials::{ALARM, Effort, Trial, alarm, all_plausible, dispersion};
use crate::causes::{Cause, find};
use crate::identify::{Fit, Problem, refit};
use crate::joint::effect::Acting;
use rayon::prelude::*;

/// Share of the misfit beyond noise that another set must explain of what a set leaves.
pub(super) const FURTHER_SHARE: f64 = 0.10;

/// Share of the baseline's misfit beyond noise that a further cause must explain: a weaker one may as well be the
/// named cause's law being only nearly right. Of 154 effects of the laboratory that were named rightly, 98 in a
/// hundred left less than 0.062 of it.
const NEARLY_RIGHT: f64 = 0.07;

/// Part of that share which is enough of a set that leaves nothing beyond scatter, that of the noise's estimate included.
const COMPLETE: f64 = 0.43;

/// Share of its rows, beyond scatter, from which what a set leaves may be a second cause.
const STRUCTURE: f64 = 0.05;

/// Share of its rows below which no misfit falls: the noise may have been estimated too large, by a
/// factor of 1.4 at most.
const OVERRATED: f64 = 0.5;

/// Share of the evidence wanted that fitted samples have to give; held-out ones may give the rest.
const UNDECIDED: f64 = 0.5;

/// Causes, best first, whose prediction of held-out cycles is looked at in one round.
const PREDICTORS: usize = 4;

/// First causes, best first, beside which a second one is looked for where the set leaves structure.
const BEGINNINGS: usize = 6;

/// Forward selection with joint refits and pruning, from the `trials` beside the baseline, or from a set that is `known`.
///
/// The first cause that is taken need not be of the true set: one that is neither of two may take more than
/// each of them. Where the pair leaves structure, pairs are grown from other first causes as well before a third is asked
/// for. Sets without prospect of a misfit below `wanted` are given up. With the set comes what was tried beside others.
pub(super) fn grown(
    bench: &Bench,
    timed: bool,
    (baseline, trials, known): (&Fit, &[Trial], Option<Fit>),
    (effort, wanted): (Effort, f64),
) -> (Fit, Vec<Beside>) {
    let grow = Grow {
        bench,
        timed,
        effort,
        baseline,
        wanted,
    };
    let mut beside = Vec::new();
    // Of two neither may predict held-out cycles without the other.
    let one = known.or_else(|| grow.next(baseline, trials, f64::INFINITY));
    let mut best = match one {
        Some(one) => grow.second(one, &mut beside),
        None => baseline.clone(),
    };
    if effort == Effort::Full
        && grow.leaves_another(baseline, &best)
        && let Some(two) = grow.elsewhere((baseline, &best), trials)
    {
        best = two;
    }
    (grow.third(best, trials, &mut beside), beside)
}

/// Evidence that a cause must have; where a channel shows less noise than it resolves, what models are wrong by shows,
/// and a cause has to bring what makes any model likelier than another.
fn evidence_wanted(bench: &Bench) -> f64 {
    let records = 0..bench.train.records.len();
    match records.into_iter().any(|k| bench.is_finer_than_read(k)) {
        true => alarm(&bench.train).max(ALARM),
        false => alarm(&bench.train),
    }
}

/// How sets grow.
struct Grow<'a> {
    bench: &'a Bench,
    timed: bool,
    effort: Effort,
    baseline: &'a Fit,
    /// Misfit that sets of several have to reach.
    wanted: f64,
}

impl Grow<'_> {
    /// The set with the trial that lowers the squared error most, held-out samples included, of those with
    /// enough evidence, theirs included, that [`Prospect::holds`] lets pass.
    fn next(&self, current: &Fit, trials: &[Trial], enough: f64) -> Option<Fit> {
        let least = evidence_wanted(self.bench);
        let reaches = |t: &&Trial| t.fit.misfit < enough;
        let next = match self.effort {
            Effort::Quick => trials.iter().find(|t| t.evidence >= least && reaches(t)),
            Effort::Full => trials
                .iter()
                .filter(|t| t.evidence >= UNDECIDED * least && reaches(t))
                .take(PREDICTORS)
                .map(|t| (t, Prospect::of(self.bench, current, &t.fit)))
                .map(|(t, prospect)| (t, t.evidence + prospect.held_out_evidence(), prospect))
                .filter(|(_, evidence, prospect)| *evidence >= least && prospect.holds())
                .filter(|(t, evidence, _)| {
                    let little = (*evidence, &t.fit);
                    let problem = &self.bench.train;
                    let known = self.bench.noise_is_repeated();
                    heard((problem, known), current, little) >= least
                        && stays_on_a_finer_grid(problem, current, little)
                })
                .max_by(|(.., a), (.., b)| a.total().total_cmp(&b.total()))
                .map(|(t, ..)| t),
        };
        next.map(|t| t.fit.clone())
    }

    /// Trials beside a set, as far as sets with them are asked for; `enough` is the misfit that a further cause must reach.
    fn beside(&self, current: &Fit, (effort, enough): (Effort, f64)) -> Vec<Trial> {
        let Grow { bench, timed, .. } = *self;
        let any = !bench.wearing_sets || current.effects.iter().any(|a| a.effect.wears());
        let asked = |cause: &dyn Cause| cause.is_told(timed) && (any || cause.effect().wears());
        let asked_for = (effort, enough);
        trials_of(asked, &bench.train, &bench.scale, current, asked_for)
    }

    /// One cause with a second, if one has enough evidence; that stays until the places of both have been looked at.
    fn second(&self, one: Fit, beside: &mut Vec<Beside>) -> Fit {
        if one.effects.len() != 1 {
            return one;
        }
        let share = self
            .least(&one)
            .min(0.5 * structure(&self.bench.train, &one));
        let enough = one.misfit - share;
        self.further(&one, enough, beside).unwrap_or(one)
    }

    /// Two causes with a third, pruned; the last cause has to bring the set to what is wanted of it.
    fn third(&self, two: Fit, first: &[Trial], beside: &mut Vec<Beside>) -> Fit {
        if two.effects.len() != 2 {
            return two;
        }
        let enough = (two.misfit - self.least(&two)).min(self.wanted);
        match self.further(&two, enough, beside) {
            Some(three) => prune(self.bench, self.baseline, three, first),
            None => two,
        }
    }

    /// A set with a cause more that brings it below a misfit.
    fn further(&self, current: &Fit, enough: f64, beside: &mut Vec<Beside>) -> Option<Fit> {
        if enough < OVERRATED * self.bench.train.rows() as f64 {
            return None;
        }
        let trials = self.beside(current, (self.effort, enough));
        let next = self.next(current, &trials, enough);
        // Every cause has to have been asked.
        if self.effort == Effort::Full && !self.bench.wearing_sets {
            beside.push(Beside::of(&self.bench.train, current, trials));
        }
        next
    }

    fn least(&self, set: &Fit) -> f64 {
        least(&self.bench.train, self.baseline, &set.effects)
    }

    /// True where a set leaves structure, be it on held-out samples, and more than the laws of the right causes
    /// may be wrong by.
    fn leaves_another(&self, baseline: &Fit, best: &Fit) -> bool {
        let (problem, bench) = (&self.bench.train, self.bench);
        let rows = problem.rows() as f64;
        let seen = || {
            leaves_structure(problem, best)
                && places::beyond_scatter(problem, best) > NEARLY * (baseline.misfit - rows)
        };
        let unseen = || {
            let left = unseen_beyond_scatter(bench, best);
            left > STRUCTURE * unseen_rows(bench) && left > NEARLY * beyond_unseen(bench, baseline)
        };
        seen() || unseen()
    }

    /// The best pair that begins with another cause than the set began with, or with a cause at another of its
    /// places, if it is better than the set. Of the same two the first may have taken from the second what no step
    /// of both gives back.
    fn elsewhere(&self, (baseline, best): (&Fit, &Fit), first: &[Trial]) -> Option<Fit> {
        let Grow { bench, .. } = *self;
        let evident = evidence_wanted(bench);
        let began = best.effects.first();
        let others = at_other_places(&bench.train, &bench.scale, baseline, first);
        let mut beginnings: Vec<&Trial> = first
            .iter()
            .filter(|t| began.is_none_or(|a| a.effect.name() != t.cause.name()))
            .chain(&others)
            .filter(|t| t.plausible && t.evidence >= evident)
            .collect();
        beginnings.sort_by(|a, b| a.fit.misfit.total_cmp(&b.fit.misfit));
        let least = ALARM * dispersion(&self.bench.train, best);
        let beyond = best.misfit - self.bench.train.rows() as f64;
        // A set that takes no more is not worth the settling.
        let enough = (best.misfit - FURTHER_SHARE * beyond).min(self.wanted);
        beginnings.truncate(BEGINNINGS);
        let pair = |one: &Trial| {
            // A trial that is bound too tightly ends short of what it would reach.
            let trials = self.beside(&one.fit, (Effort::Quick, best.misfit.min(self.wanted)));
            self.next(&one.fit, &trials, enough)
        };
        let pairs: Vec<Fit> = beginnings.into_par_iter().filter_map(pair).collect();
        pairs
            .into_iter()
            .map(|pair| (Prospect::of(self.bench, best, &pair).total(), pair))
            .filter(|(gain, _)| *gain > least)
            .max_by(|(a, _), (b, _)| a.total_cmp(b))
            .map(|(_, pair)| pair)
    }
}

/// Misfit that noise alone does not leave; without end where a set leaves no such.
///
/// Half of it is enough for a second cause to be looked at: two that explain all may each beside the
/// other bring what neither brings beside a first one that is neither of them.
fn structure(problem: &Problem, fit: &Fit) -> f64 {
    match leaves_structure(problem, fit) {
        true => places::beyond_scatter(problem, fit),
        false => f64::INFINITY,
    }
}

/// True where a set leaves misfit that noise alone does not.
pub(super) fn leaves_structure(problem: &Problem, fit: &Fit) -> bool {
    structure_left(problem, fit) > 0.0
}

/// Misfit by which a set leaves more than noise alone does.
fn structure_left(problem: &Problem, fit: &Fit) -> f64 {
    places::beyond_scatter(problem, fit) - STRUCTURE * problem.rows() as f64
}

/// Misfit below which a model leaves noise alone, of what a fit with structure leaves.
pub(super) fn noise_alone(problem: &Problem, fit: &Fit) -> f64 {
    fit.misfit - structure_left(problem, fit)
}

/// Misfit that one cause of several has to take away beside the others: a share of what those of a set do whose laws
/// may be wrong, so of what is left beside those alone that are [exact](Cause::is_exact).
fn least(problem: &Problem, baseline: &Fit, set: &[Acting]) -> f64 {
    let exact = |a: &&Acting| find(a.effect.name()).is_some_and(|c| c.is_exact());
    let exact: Vec<Acting> = set.iter().filter(exact).cloned().collect();
    let left = match exact.is_empty() {
        true => baseline.misfit,
        false => refit(problem, baseline, exact).misfit,
    };
    NEARLY_RIGHT * (left - problem.rows() as f64).max(0.0)
}

/// Misfit that each of several causes has to take away: enough evidence, and its share, which is
/// smaller the less they leave together: a law that is only nearly right is not mended wholly by another's. Where
/// noise is what a model leaves, that tells nothing.
pub(super) fn share(bench: &Bench, baseline: &Fit, fit: &Fit) -> f64 {
    share_of(bench, fit, least(&bench.train, baseline, &fit.effects))
}

/// The same, of what a set leaves that has to be mended by `least`.
fn share_of(bench: &Bench, fit: &Fit, least: f64) -> f64 {
    let problem = &bench.train;
    let left = places::beyond_doubt(bench, fit).max(0.0) / (STRUCTURE * problem.rows() as f64);
    let wanted = match bench.noise_is_repeated() {
        true => COMPLETE + (1.0 - COMPLETE) * left.min(1.0),
        false => 1.0,
    };
    (wanted * least).max(ALARM * dispersion(problem, fit))
}

/// Drops causes that the others have made needless. A law whose values
/// become those of another cause takes nobody's place: a rate that is remembered for ever is a path.
pub(super) fn prune(bench: &Bench, baseline: &Fit, mut fit: Fit, first: &[Trial]) -> Fit {
    let problem = &bench.train;
    while fit.effects.len() > 1 {
        let without: Option<Fit> = (0..fit.effects.len())
            .map(|drop| places::alone(problem, &fit, fit.others(drop), first))
            .filter(|less| all_plausible(&bench.scale, less))
            .min_by(|a, b| a.misfit.total_cmp(&b.misfit));
        match without {
            Some(less) if less.misfit - fit.misfit < share(bench, baseline, &fit) => fit = less,
            _ => break,
        }
    }
    fit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::diagnose::search::alone;
    use crate::diagnose::search::tests::dashpot;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// A reading that comes late and drifts, of a sensor that bends.
    #[test]
    fn a_third_cause_is_tried_as_far_as_it_may_bring_a_set_to_what_is_wanted() {
        let mut noise = drawn(20261127);
        let time: Vec<f64> = (0..2000).map(|i| 0.01 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.0 * t).sin()).collect();
        let read = |t: &f64| {
            let late = 1e-8 * 80.0 * (5.0 * t - 0.2).sin();
            late + 2e5 * late * late + 2e-8 * t
        };
        let record = Record {
            name: "bent".to_string(),
            displacement: time.iter().map(|t| read(t) + 1e-8 * noise()).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        let plain = baseline(&bench.train);
        let first = alone(&bench, true, &plain);
        let acting = |name: &str, values: &[f64]| Acting {
            effect: find(name).unwrap().effect(),
            values: values.to_vec(),
        };
        let two = [
            acting("viscous_damping", &[1e7, 0.0]),
            acting(
                "displacement_drift",
                &[1e-8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            ),
        ];
        let two = refit(&bench.train, &plain, two.to_vec());
        let on = |wanted: f64| {
            let grow = Grow {
                bench: &bench,
                timed: true,
                effort: Effort::Full,
                baseline: &plain,
                wanted,
            };
            grow.third(two.clone(), &first, &mut Vec::new())
        };
        let grown = on(f64::INFINITY);
        assert!(grown.misfit < 0.5 * two.misfit, "{grown:?}");
        assert_eq!(on(2.0 * grown.misfit).effects, grown.effects);
        assert_eq!(on(0.6 * grown.misfit), two);
    }

    /// Where sets without a cause that wears the joint are known, one has to come beside a dashpot, and any beside one.
    #[test]
    fn sets_that_are_known_of_joints_made_anew_are_not_asked_for_where_wear_goes_on() {
        let mut bench = dashpot(20261130);
        let plain = baseline(&bench.train);
        let names = |bench: &Bench, own: &str| {
            let effect = find(own).unwrap().effect();
            let mut values = vec![0.0; effect.parameters().len()];
            values[0] = 1e-3;
            let set = refit(&bench.train, &plain, vec![Acting { effect, values }]);
            let grow = Grow {
                bench,
                timed: true,
                effort: Effort::Full,
                baseline: &plain,
                wanted: f64::INFINITY,
            };
            let beside = grow.beside(&set, (Effort::Quick, f64::INFINITY));
            beside.iter().map(|t| t.cause.name()).collect::<Vec<_>>()
        };
        let any = names(&bench, "viscous_damping");
        bench.wearing_sets = true;
        let wearing = names(&bench, "viscous_damping");
        assert!(wearing.contains(&"running_in") && wearing.len() < any.len());
        let wears = |name: &&str| find(name).unwrap().effect().wears();
        assert!(wearing.iter().all(wears));
        assert!(names(&bench, "running_in").iter().any(|name| !wears(name)));
    }

    /// Beside a loud hum a drift has to take a share of what hum alone leaves, not of the hum.
    #[test]
    fn no_other_cause_mends_a_tone() {
        let mut noise = drawn(20261130);
        let time: Vec<f64> = (0..2000).map(|i| 1e-3 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (50.0 * t).sin()).collect();
        let read = |t: &f64| {
            let hum = 2e-7 * (std::f64::consts::TAU * 50.03 * t).sin();
            1e-8 * 80.0 * (50.0 * t).sin() + hum + 4e-8 * t + 1e-8 * noise()
        };
        let record = Record {
            name: "hum".to_string(),
            displacement: time.iter().map(read).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        let plain = baseline(&bench.train);
        let of = |name: &str, values: &[f64]| Acting {
            effect: find(name).unwrap().effect(),
            values: values.to_vec(),
        };
        let hum = of("mains_hum", &[2e-7, 0.0, 50.03, 0.0, 0.0, 0.0, 0.0]);
        let drift = of(
            "displacement_drift",
            &[4e-8, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        );
        let asked = |set: &[Acting]| least(&bench.train, &plain, set);
        let all = NEARLY_RIGHT * (plain.misfit - bench.train.rows() as f64);
        assert_eq!(asked(std::slice::from_ref(&drift)), all);
        assert!(asked(&[drift.clone(), hum.clone()]) < 0.2 * all);
        let set = refit(&bench.train, &plain, vec![hum, drift]);
        let without = refit(&bench.train, &plain, set.others(1));
        let takes = without.misfit - set.misfit;
        assert!(
            takes > share(&bench, &plain, &set) && takes < all,
            "{takes}"
        );
        let kept = prune(&bench, &plain, set.clone(), &[]);
        assert_eq!(kept.effects, set.effects);
    }

    /// Of a variance that sixteen cycles told, a set leaves no more than that may be wrong by, and then twice as much.
    #[test]
    fn what_the_noise_may_be_told_wrong_by_asks_no_larger_share_of_a_cause() {
        let bench = dashpot(20261127);
        assert!(bench.noise_is_repeated());
        let rows = bench.train.rows() as f64;
        let leaving = |misfit: f64| Fit {
            misfit,
            ..baseline(&bench.train)
        };
        let scatter = places::scatter(rows);
        let doubt = -places::beyond_doubt(&bench, &leaving(rows));
        assert!(doubt > 1.2 * scatter, "{doubt} {scatter}");
        let least = 1e6;
        let asked = |misfit: f64| share_of(&bench, &leaving(misfit), least);
        assert_eq!(asked(rows + 0.5 * (scatter + doubt)), COMPLETE * least);
        assert!(asked(rows + 2.0 * doubt) > 1.1 * COMPLETE * least);
    }
}
