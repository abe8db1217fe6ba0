//! The turns of a load before its record began: those that leave least.

use super::beginning::{Beginning, early, low_high, turns, wins};
use crate::record::cycles::span;
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// Shares of the way back to the last turn at which the load may have turned before the record began.
const BACK: [f64; 3] = [0.25, 0.5, 0.75];

/// Levels of a test that shrinks, over the level before.
const SHRINKS: [f64; 4] = [0.4, 0.55, 0.7, 0.85];

/// The turns before a record that leave least, by what `left` says of a beginning, and how much that is; `None` of a
/// record whose load turns less than twice. A further turn has to bring its part of what is left per sample, of
/// `samples` that vary by themselves.
pub fn past(
    (input, samples): (&[f64], f64),
    left: impl Fn(&Beginning) -> f64 + Sync,
) -> Option<(f64, Beginning)> {
    if early(input) == 0 {
        return None;
    }
    let (low, high) = low_high(input.iter().copied());
    let older = older(input);
    let newer = newer(input);
    let nearest = |tried: &[Beginning]| {
        let all = tried.par_iter().map(|b| (left(b), b));
        let nearest = all.min_by(|(a, _), (b, _)| a.total_cmp(b));
        nearest.map(|(_, best)| best.clone())
    };
    // Of each range by itself: what is nearest with two turns may stay behind with older ones.
    let of_range = |tried: &Vec<Beginning>| {
        let (all, best) = sharpened(nearest(tried)?, &left);
        Some(deepened((all, best), (&left, samples), DEEP, &older))
    };
    let two = histories(input);
    let shrunk: Vec<_> = shrinking((low, high)).map(Beginning::behind).collect();
    let shrunk = || nearest(&shrunk).map(|best| moved(best, &left, (1..=ROUNDS, SWEEPS)));
    let (shrunk, ranges) = rayon::join(shrunk, || {
        two.par_iter().filter_map(of_range).collect::<Vec<_>>()
    });
    let ranges = ranges.into_iter().chain(shrunk);
    let (all, best) = ranges.min_by(|(a, _), (b, _)| a.total_cmp(b))?;
    Some(deepened((all, best), (&left, samples), DEEPEST, &newer))
}

/// Turns of which each has one more than those given.
type Longer<'a> = &'a (dyn Fn(&[f64]) -> Vec<Vec<f64>> + Sync);

/// The same turns behind one at either end of the record's range.
fn older(input: &[f64]) -> impl Fn(&[f64]) -> Vec<Vec<f64>> + use<> {
    let (low, high) = low_high(input.iter().copied());
    move |turned| [low, high].map(|turn| [&[turn], turned].concat()).to_vec()
}

/// The same turns and one of a smaller block after them.
fn newer(input: &[f64]) -> impl Fn(&[f64]) -> Vec<Vec<f64>> + use<> {
    let start = input[0];
    move |turned| match *turned {
        [.., before, _] => BACK
            .map(|share| start + share * (before - start))
            .map(|turn| [turned, &[turn]].concat())
            .to_vec(),
        _ => Vec::new(),
    }
}

/// More turns, one by one, as long as each leaves so much less by what `left` says of a beginning, of `samples` that vary by
/// themselves.
fn deepened(
    (mut all, mut best): (f64, Beginning),
    (left, samples): (&(impl Fn(&Beginning) -> f64 + Sync), f64),
    most: usize,
    longer: Longer,
) -> (f64, Beginning) {
    while best.turned.len() < most {
        let tried = longer(&best.turned).into_par_iter();
        let tried = tried.map(|turned| sharpened(Beginning::behind(turned), left));
        let nearest = tried.min_by(|(a, _), (b, _)| a.total_cmp(b));
        match nearest.filter(|longer| wins(longer.0, all, samples)) {
            Some(longer) => (all, best) = longer,
            None => break,
        }
    }
    (all, best)
}

/// Other turns with two of those given, up and down again, left out, and older and newer ones instead where these leave
/// less, by what `left` says of a beginning; `None` where no such turns are as few and leave no more, or leave less.
///
/// One by one the search gives the way that is best for the turns it has: what comes to nothing beside later ones
/// takes the place of an older turn, or of the newest.
pub(super) fn reconsidered(
    (all, best): (f64, &Beginning),
    (left, samples): (&(impl Fn(&Beginning) -> f64 + Sync), f64),
    input: &[f64],
) -> Option<Beginning> {
    let (older, newer) = (older(input), newer(input));
    let anew = |turned: Vec<f64>| {
        let sharp = sharpened(Beginning::behind(turned), left);
        let further = deepened(sharp, (left, samples), DEEPEST, &newer);
        deepened(further, (left, samples), DEEPEST, &older)
    };
    let mut now = (all, best.clone());
    // Fewer turns may leave a little more, and more of them less again: that has to end.
    for _ in 0..DEEPEST {
        let pairs = now.1.turned.len().saturating_sub(2);
        let others = (0..pairs).into_par_iter().map(|place| {
            let mut turned = now.1.turned.clone();
            turned.drain(place + 1..place + 3);
            anew(turned)
        });
        let better =
            others.filter(
                |(other, begun)| match begun.turned.len() < now.1.turned.len() {
                    true => !wins(now.0, *other, samples),
                    false => wins(*other, now.0, samples),
                },
            );
        match better.min_by(|(a, _), (b, _)| a.total_cmp(b)) {
            Some(other) => now = other,
            None => break,
        }
    }
    (now.1 != *best).then_some(now.1)
}

/// Most turns that a record is asked for, and most beyond which no older one is.
const DEEPEST: usize = 6;
const DEEP: usize = 4;

/// Rounds of halved moves of the turns.
const ROUNDS: i32 = 5;

/// Those after which what is nearest is known to a thousandth of its range.
const FINE: i32 = 8;

/// Most moves of every turn by the same step, where it is to be that fine.
const SWEEPS: usize = 4;

/// The same with turns where they leave least, by what `left` says of a beginning; and how much that is.
pub fn sharpened(begun: Beginning, left: impl Fn(&Beginning) -> f64) -> (f64, Beginning) {
    moved(begun, left, (1..=ROUNDS, 1))
}

/// The same turns as finely as a baseline tells them, and how much that leaves.
pub(super) fn finely_moved(begun: Beginning, left: impl Fn(&Beginning) -> f64) -> (f64, Beginning) {
    moved(begun, left, (3..=FINE, SWEEPS))
}

/// The turns moved by halved steps, each as often as that leaves less.
fn moved(
    begun: Beginning,
    left: impl Fn(&Beginning) -> f64,
    (halved, sweeps): (RangeInclusive<i32>, usize),
) -> (f64, Beginning) {
    // One turn alone was as far from rest.
    let range = match *begun.turned {
        [turn] => turn.abs(),
        _ => span(&begun.turned),
    };
    let places = begun.turned.len();
    let mut best = (left(&begun), begun);
    for times in halved {
        let step = 0.25 * range * 0.5_f64.powi(times);
        for _ in 0..sweeps {
            let before = best.0;
            for (place, by) in (0..places).flat_map(|place| [(place, step), (place, -step)]) {
                let mut other = best.1.clone();
                other.turned[place] += by;
                let judged = left(&other);
                if judged < best.0 {
                    best = (judged, other);
                }
            }
            if best.0 == before {
                break;
            }
        }
    }
    best
}

/// Readings between which the load may have gone before, and where it turned last: between the first turns of
/// the record, its whole range, or half way, as in a test that grows.
fn histories(input: &[f64]) -> [Vec<Beginning>; 3] {
    let start = input[0];
    let first = low_high(turns(input)[..2].iter().map(|&turn| input[turn]));
    let whole = low_high(input.iter().copied());
    let between = (0.5 * (first.0 + whole.0), 0.5 * (first.1 + whole.1));
    [first, between, whole].map(|(low, high)| {
        let both = [(high, low), (low, high)].into_iter();
        let turned = both.flat_map(|(before, last)| {
            let back = BACK.map(|share| vec![before, start + share * (last - start)]);
            std::iter::once(vec![before, last]).chain(back)
        });
        turned.map(Beginning::behind).collect()
    })
}

/// Turns of tests whose levels shrink: each leaves one up and one down, which later loads close one by one.
fn shrinking((low, high): (f64, f64)) -> impl Iterator<Item = Vec<f64>> {
    let ways = [(low, high), (high, low)].into_iter();
    let levels = ways.flat_map(|both| SHRINKS.map(|by| (both, by)));
    levels.flat_map(|((one, other), by)| {
        let middle = 0.5 * (one + other);
        let turn = move |k: usize| {
            let level = f64::powi(by, k.div_ceil(2) as i32);
            middle + level * (if k.is_multiple_of(2) { one } else { other } - middle)
        };
        (3..=DEEPEST).map(move |turns| (0..turns).map(turn).collect())
    })
}
