//! The search: every cause scored at its vanishing size, the promising ones refitted jointly with
//! the baseline, the best set grown, its causes exchanged for better ones, and pruned.

use super::beside::Beside;
use super::coarsely::trials;
use super::finely::{finely, finely_anew};
use super::growing::{grown, prune, share};
use super::places::{self, Place};
use super::prepare::Bench;
use super::tested::tested;
use super::trials::{Effort, Trial, dispersion, penalty};
use crate::identify::{Fit, Problem, refit, smoothed};
use crate::joint::effect::Acting;
use rayon::prelude::*;

/// Most causes named together.
pub(super) const MOST: usize = 3;

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
    /// True where rivals and evidence were not asked for: other beginnings or drives of the same records are likelier,
    /// or may be.
    pub unasked: bool,
}

/// What a search begins with, as far as it is known.
#[derive(Debug, Clone, Default)]
pub struct Begun {
    /// Every cause alone beside the baseline.
    pub alone: Option<Vec<Trial>>,
    /// A set of causes that is grown on, where it is not empty.
    pub set: Vec<Acting>,
    /// What was tried beside others.
    pub beside: Vec<Beside>,
}

impl Begun {
    /// With every cause alone beside the baseline, where that is known.
    pub(super) fn knowing(alone: Option<Vec<Trial>>) -> Begun {
        Begun {
            alone,
            ..Begun::default()
        }
    }

    /// Of records that were searched before, where noise, cells or samples were others: several causes that suit them are
    /// grown on, and their places looked at again. Beside one the best of all is asked for anew.
    pub(super) fn from_several(suits: &[Acting]) -> Begun {
        Begun {
            set: match suits.len() > 1 {
                true => suits.to_vec(),
                false => Vec::new(),
            },
            ..Begun::default()
        }
    }
}

/// What stands at these places.
fn of_kept<T: Clone>(all: &[T], kept: &[usize]) -> Vec<T> {
    kept.iter().filter_map(|&k| all.get(k)).cloned().collect()
}

impl Found {
    /// A set of which rivals and evidence are not asked for.
    pub(super) fn unasked(baseline: Fit, best: Fit, trials: Vec<Trial>) -> Found {
        Found {
            rivals: vec![Vec::new(); best.effects.len()],
            evidence: vec![0.0; best.effects.len()],
            baseline,
            best,
            trials,
            unasked: true,
        }
    }

    /// True where no cause is named.
    pub fn names_none(&self) -> bool {
        self.best.effects.is_empty()
    }

    /// Evidence for the named causes together: penalised fall of the misfit over the baseline's.
    pub(super) fn brings(&self, problem: &Problem) -> f64 {
        let fall = (self.baseline.misfit - self.best.misfit) / dispersion(problem, &self.best);
        fall - penalty(problem, self.best.free())
    }

    /// Without the named causes at these places; the others are fitted anew.
    pub fn without(self, bench: &Bench, places: Vec<usize>) -> Found {
        if places.is_empty() {
            return self;
        }
        let stays = |k: &usize| !places.contains(k);
        let kept: Vec<usize> = (0..self.best.effects.len()).filter(stays).collect();
        let effects: Vec<Acting> = kept.iter().map(|&k| self.best.effects[k].clone()).collect();
        Found {
            best: match effects.is_empty() {
                true => self.baseline.clone(),
                false => refit(&bench.train, &self.best, effects),
            },
            rivals: of_kept(&self.rivals, &kept),
            evidence: of_kept(&self.evidence, &kept),
            ..self
        }
    }

    /// What every fit leaves as the problem is weighed now.
    pub(super) fn weigh(&mut self, problem: &Problem) {
        let trials = self.trials.iter_mut().map(|t| &mut t.fit);
        let fits: Vec<&mut Fit> = trials.chain([&mut self.baseline, &mut self.best]).collect();
        let weigh = |fit: &mut Fit| fit.misfit = problem.misfit(&fit.predict(problem)).0;
        fits.into_par_iter().for_each(weigh);
    }

    /// With joints that follow the noise no more than their data ask for.
    pub fn smoothed(self, bench: &Bench) -> Found {
        let (baseline, best) = rayon::join(
            || smoothed(&bench.train, &self.baseline),
            || smoothed(&bench.train, &self.best),
        );
        Found {
            baseline,
            best,
            ..self
        }
    }
}

/// The set of causes alone, found in a quick pass: what it leaves tells the noise.
pub fn quick(bench: &Bench, timed: bool, baseline: &Fit) -> Fit {
    let asked = (Effort::Quick, f64::INFINITY);
    let trials = trials(&bench.train, &bench.scale, timed, baseline, asked);
    grown(bench, timed, (baseline, &trials, None), asked).0
}

/// Every cause alone beside the baseline, as a search begins with.
pub(super) fn alone(bench: &Bench, timed: bool, baseline: &Fit) -> Vec<Trial> {
    let asked = (Effort::Full, f64::INFINITY);
    trials(&bench.train, &bench.scale, timed, baseline, asked)
}

/// Grows the set of causes, prunes it, tests it on held-out cycles, and lists rivals; where the set leaves more than
/// `enough` of every row, in noise variances, it is not asked further.
///
/// Every cause alone is tried first, and a set grown from those, where they are not known as the search is `begun`. A mass
/// that moves with the joint is marched in shorter steps, or more turns, from where it was found, if they suit it better.
/// With what is found comes what was tried in the place of each cause.
pub fn search(
    bench: &mut Bench,
    timed: bool,
    (baseline, begun): (Fit, Begun),
    enough: f64,
) -> (Found, Vec<Beside>) {
    let enough = enough * bench.train.rows() as f64;
    let first = begun.alone;
    let first = first.unwrap_or_else(|| alone(bench, timed, &baseline));
    let asked = (Effort::Full, enough);
    let set = (!begun.set.is_empty()).then(|| refit(&bench.train, &baseline, begun.set));
    let (best, mut beside) = grown(bench, timed, (&baseline, &first, set), asked);
    beside.extend(begun.beside);
    if best.misfit > enough {
        return (Found::unasked(baseline, best, first), beside);
    }
    let best = finely(bench, best);
    let before = best.clone();
    let (settled, mut places) = settled(bench, timed, (&baseline, best), (&first, &beside));
    let settled = finely_anew(bench, &before, settled);
    let mut best = tested(bench, &baseline, settled.clone());
    if best.effects != settled.effects {
        places = places::places(bench, timed, &best, (&first, &beside), None);
    }
    // Without it another minimum of the others was met that leaves no more.
    while let Some(idle) = places.iter().position(|p| p.brought <= 0.0) {
        best = places::alone(&bench.train, &best, best.others(idle), &first);
        places = places::places(bench, timed, &best, (&first, &beside), None);
    }
    let scale = dispersion(&bench.train, &best);
    let of_place = |(k, place): (usize, &Place)| place.beside(&bench.train, best.others(k));
    let beside = places.iter().enumerate().map(of_place).collect();
    let found = Found {
        rivals: places.iter().map(|p| p.rivals(bench, &best)).collect(),
        evidence: places.iter().map(|p| p.brought / scale).collect(),
        baseline,
        best,
        trials: first,
        unasked: false,
    };
    (found, beside)
}

/// Exchanges causes of a set of several as long as that makes it better.
///
/// Returns the set with its places; a cause that does not bring its share beside the others is dropped.
fn settled(
    bench: &Bench,
    timed: bool,
    (baseline, mut best): (&Fit, Fit),
    (first, beside): (&[Trial], &[Beside]),
) -> (Fit, Vec<Place>) {
    let tried = (first, beside);
    let mut places = places::places(bench, timed, &best, tried, None);
    for _ in 0..MOST {
        if best.effects.len() < 2 {
            break;
        }
        let Some((better, known)) = places::exchanged(bench, &best, &places) else {
            break;
        };
        best = better;
        places = places::places(bench, timed, &best, tried, Some(known));
    }
    let share = share(bench, baseline, &best);
    if best.effects.len() > 1 && places.iter().any(|place| place.brought < share) {
        best = prune(bench, baseline, best, first);
        places = places::places(bench, timed, &best, tried, None);
    }
    (best, places)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// A virgin joint's record of a dashpot in white noise: the displacement comes 0.2 of a radian late.
    pub(in crate::diagnose) fn dashpot(seed: u64) -> Bench {
        let mut noise = drawn(seed);
        let time: Vec<f64> = (0..2000).map(|i| 0.01 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.0 * t).sin()).collect();
        let late = |t: &f64| 1e-8 * 80.0 * (5.0 * t - 0.2).sin();
        let record = Record {
            name: "dashpot".to_string(),
            displacement: time.iter().map(|t| late(t) + 1e-8 * noise()).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        prepare(Form::Play, &[record], &[Beginning::default()])
    }

    /// Found, or given up where another beginning is said to leave a hundredth of the noise.
    #[test]
    fn what_leaves_more_than_enough_is_given_up() {
        let bench = dashpot(20261126);
        let plain = baseline(&bench.train);
        let asked = |enough: f64| {
            search(
                &mut bench.clone(),
                true,
                (plain.clone(), Begun::default()),
                enough,
            )
            .0
        };
        let (found, beaten) = (asked(f64::INFINITY), asked(0.01));
        assert!(!found.unasked && found.evidence[0] > 0.0, "{found:?}");
        assert!(beaten.unasked && beaten.best.misfit <= found.best.misfit * 1.001);
        assert!(beaten.evidence.iter().all(|e| *e == 0.0) && beaten.rivals.concat().is_empty());
    }
}
