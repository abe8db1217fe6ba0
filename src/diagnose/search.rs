//! The search: every cause scored at its vanishing size, the promising ones refitted jointly with
//! the baseline, the best set grown, its causes exchanged for better ones, and pruned.

use super::finely::finely;
use super::growing::{grown, least, prune, share};
use super::places::{self, Place};
use super::prepare::Bench;
use super::tested::tested;
use super::trials::{Effort, Trial, dispersion};
use crate::identify::{Fit, smoothed};

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
}

impl Found {
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
    grown(bench, timed, baseline, Effort::Quick).0
}

/// Grows the set of causes, prunes it, tests it on held-out cycles, and lists rivals.
///
/// A mass that moves with the joint is marched in shorter steps, or more turns, from where it was found, if they suit it
/// better.
pub fn search(bench: &mut Bench, timed: bool, baseline: Fit) -> Found {
    let (best, first) = grown(bench, timed, &baseline, Effort::Full);
    let best = finely(bench, best);
    let least = least(&bench.train, &baseline);
    let (settled, mut places) = settled(bench, timed, least, best, &first);
    let mut best = tested(bench, &baseline, settled.clone());
    if best.effects != settled.effects {
        places = places::places(bench, timed, &best, &first, None);
    }
    // Without it another minimum of the others was met that leaves no more.
    while let Some(idle) = places.iter().position(|p| p.brought <= 0.0) {
        let mut others = best.effects.clone();
        others.remove(idle);
        best = places::alone(&bench.train, &best, others, &first);
        places = places::places(bench, timed, &best, &first, None);
    }
    let scale = dispersion(&bench.train, &best);
    Found {
        rivals: places.iter().map(|p| p.rivals(bench, &best)).collect(),
        evidence: places.iter().map(|p| p.brought / scale).collect(),
        baseline,
        best,
        trials: first,
    }
}

/// Exchanges causes of a set of several as long as that makes it better.
///
/// Returns the set with its places; a cause that does not bring its share beside the others is dropped.
fn settled(
    bench: &Bench,
    timed: bool,
    least: f64,
    mut best: Fit,
    first: &[Trial],
) -> (Fit, Vec<Place>) {
    let mut places = places::places(bench, timed, &best, first, None);
    for _ in 0..MOST {
        if best.effects.len() < 2 {
            break;
        }
        let Some((better, known)) = places::exchanged(bench, &best, &places) else {
            break;
        };
        best = better;
        places = places::places(bench, timed, &best, first, Some(known));
    }
    let share = share(bench, &best, least);
    if best.effects.len() > 1 && places.iter().any(|place| place.brought < share) {
        best = prune(bench, best, least, first);
        places = places::places(bench, timed, &best, first, None);
    }
    (best, places)
}
