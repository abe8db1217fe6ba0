//! Records searched: what is noise is told first where cycles do not repeat, and what a search teaches of noise and joint
//! is searched with once more.

use super::investigation::Investigation;
use super::prepare::Bench;
use super::search::{Begun, Found, quick, search};
use super::taught::taught;
use crate::identify::{Fit, baseline, refit};
use crate::joint::effect::Acting;

/// Said where every cause is tried.
pub(super) const SEARCHING: &str = "searching the catalogue for causes";

/// Said where they are tried again with what the first ones taught.
const KNOWN_BETTER: &str = "once more: noise or joint are known better beside what was found";

/// What is found from the baseline of the records as they are weighed, and what is known as a search of them is `begun`; what
/// leaves more than `enough` of every row is not asked further.
pub(super) fn searched(
    mut bench: Bench,
    (mut first, mut begun): (Fit, Begun),
    (timed, enough): (bool, f64),
    progress: &mut impl FnMut(&str),
) -> Investigation {
    if !bench.noise_is_repeated() {
        first = noise_told(&mut bench, timed, first, progress);
        begun.alone = None;
    }
    let enough = enough / bench.innovation_square();
    progress(SEARCHING);
    let (found, beside) = search(&mut bench, timed, (first, begun), enough);
    let again = match found.unasked {
        true => None,
        false => taught(&bench, &found.best),
    };
    let one = Investigation { bench, found };
    let again = again.map(|taught| {
        progress(KNOWN_BETTER);
        let first = baseline(&taught.bench.train);
        let known = taught.alone((&one.found.trials, &one.bench.train.operators), &first);
        if taught.finds_the_same {
            return taught.again(&one.found, (first, known));
        }
        let begun = Begun {
            alone: Some(known),
            beside,
            ..Begun::from_several(&taught.suits)
        };
        let mut bench = taught.bench;
        let (found, _) = search(&mut bench, timed, (first, begun), f64::INFINITY);
        Investigation { bench, found }
    });
    match again {
        Some(again) => weighed(one.or_likelier(again)),
        None => weighed(one),
    }
}

/// The same weighed by what was found, where nothing else tells the noise.
fn weighed(one: Investigation) -> Investigation {
    let Investigation {
        mut bench,
        mut found,
    } = one;
    bench.weigh_what_is_left(&found.best);
    if !bench.noise_is_repeated() {
        found.weigh(&bench.train);
    }
    Investigation { bench, found }
}

/// The baseline of records in which too few cycles repeat, weighed by what a quick search leaves.
fn noise_told(
    bench: &mut Bench,
    timed: bool,
    mut first: Fit,
    progress: &mut impl FnMut(&str),
) -> Fit {
    progress("what is noise: a quick search, because too few cycles repeat");
    for _ in 0..2 {
        bench.weigh_what_is_left(&quick(bench, timed, &first));
        first = baseline(&bench.train);
    }
    first
}

/// What a quick search alone finds in such records, or the given set of causes where that leaves less.
pub(super) fn quickly_searched(
    mut bench: Bench,
    timed: bool,
    given: &[Acting],
    progress: &mut impl FnMut(&str),
) -> Investigation {
    let plain = baseline(&bench.train);
    let first = noise_told(&mut bench, timed, plain, progress);
    let (sought, given) = rayon::join(
        || quick(&bench, timed, &first),
        || refit(&bench.train, &first, given.to_vec()),
    );
    let best = match given.misfit < sought.misfit {
        true => given,
        false => sought,
    };
    bench.weigh_what_is_left(&best);
    let mut found = Found::unasked(first, best, Vec::new());
    found.weigh(&bench.train);
    Investigation { bench, found }
}
