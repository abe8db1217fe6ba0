//! Which samples are set aside before looking: whole cycles, in every record.

use super::cycles::{Cycle, alike, cycles};

/// Marks the samples of a drive that no fit may see: the last cycles in time and one whole load
/// level from the middle of the record (an amplitude or a rate that the fit then has to predict).
///
/// About a fifth of the record; a record without cycles gives its last eighth and a piece of its
/// middle. The first cycle and the virgin leg always stay with the fit, and so does a cycle of the largest
/// load: what a joint does beyond the loads of the fit is not told by them. Where the last cycles hold all of
/// those, the ones before are set aside in their place, and where a begun cycle behind the last one does, that stays.
/// So does what is behind the last one and longer than the cycles that are set aside.
pub fn held_out(drive: &[f64]) -> Vec<bool> {
    held_out_elsewhere(drive, Fitted::default())
}

/// What has to be seen by the fit although it would be set aside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fitted {
    /// How the record ends: the cycles before the last ones are set aside.
    pub end: bool,
    /// The level in the middle of the record: another one is set aside.
    pub middle: bool,
}

/// The same where the fit has to see some of it.
pub fn held_out_elsewhere(drive: &[f64], fitted: Fitted) -> Vec<bool> {
    let mut held = vec![false; drive.len()];
    let found = cycles(drive);
    let mut mark = |from: usize, to: usize| held[from..to].iter_mut().for_each(|h| *h = true);
    if found.len() < 6 {
        let at_end = &AT_THE_END[usize::from(fitted.end)..];
        let in_the_middle = &IN_THE_MIDDLE[usize::from(fitted.middle)..];
        for pieces in [in_the_middle, at_end] {
            if let Some((from, to)) = piece(drive, pieces) {
                mark(from, to);
            }
        }
        return held;
    }
    let count = (found.len() / 10).max(1);
    let largest = largest(drive, &found);
    let at_end = found.len() - count;
    let last = match largest.iter().position(|l| *l) {
        Some(first) if first >= at_end => first - count,
        _ if fitted.end => at_end - count,
        _ => at_end,
    };
    let behind = found[found.len() - 1].end;
    let to = match found.get(last + count) {
        Some(next) => next.start,
        // What rings down below what counts as a cycle may be long, and tells the fit what happens while it does.
        None if drive.len() - behind > behind - found[last].start => behind,
        None if is_largest_alone(drive, (behind, drive.len())) => behind,
        None => drive.len(),
    };
    mark(found[last].start, to);
    let budget = drive.len() / 7;
    let middle = |apart: Option<(usize, usize)>| {
        middle_level((&found[1..last], &largest[1..last]), budget, apart)
    };
    let usual = middle(None);
    let chosen = match fitted.middle {
        true => middle(usual),
        false => usual,
    };
    if let Some((from, to)) = chosen {
        mark(from, to);
    }
    held
}

/// Part of the largest load from which a cycle counts as one of it.
const AS_LARGE: f64 = 0.97;

/// Sixteenths of a record without cycles of which the first is set aside that does not hold the largest load alone.
const IN_THE_MIDDLE: [(usize, usize); 3] = [(7, 8), (9, 10), (5, 6)];
const AT_THE_END: [(usize, usize); 3] = [(14, 16), (12, 14), (10, 12)];

/// The first piece, in sixteenths of the record, that may be set aside.
fn piece(drive: &[f64], sixteenths: &[(usize, usize)]) -> Option<(usize, usize)> {
    let at = |share: usize| drive.len() * share / 16;
    let mut pieces = sixteenths.iter().map(|&(from, to)| (at(from), at(to)));
    pieces.find(|&piece| !is_largest_alone(drive, piece))
}

/// True where no sample outside a piece comes near its largest load.
fn is_largest_alone(drive: &[f64], (from, to): (usize, usize)) -> bool {
    let outside = most(&drive[..from]).max(most(&drive[to..]));
    outside < AS_LARGE * most(&drive[from..to])
}

/// Largest magnitude of a part of a drive.
fn most(part: &[f64]) -> f64 {
    part.iter().fold(0.0_f64, |most, x| most.max(x.abs()))
}

/// Which cycles reach the largest load, up or down.
fn largest(drive: &[f64], found: &[Cycle]) -> Vec<bool> {
    let reach = |c: &Cycle| most(&drive[c.start..c.end]);
    let highest = found.iter().map(reach).fold(0.0, f64::max);
    found
        .iter()
        .map(|c| reach(c) >= AS_LARGE * highest)
        .collect()
}

/// The level nearest the middle, apart from given samples, whose own fit the budget and that is not the only one of the
/// largest load.
fn middle_level(
    (found, largest): (&[Cycle], &[bool]),
    budget: usize,
    apart: Option<(usize, usize)>,
) -> Option<(usize, usize)> {
    let mut levels: Vec<(usize, usize)> = Vec::new();
    let mut start = 0;
    for i in 1..=found.len() {
        if i == found.len() || !alike(&found[i - 1], &found[i]) {
            levels.push((start, i));
            start = i;
        }
    }
    let middle = found.len() as f64 / 2.0;
    let largest_elsewhere = |&(from, end): &(usize, usize)| {
        let within = largest[from..end].iter().any(|l| *l);
        let mut elsewhere = largest[..from].iter().chain(&largest[end..]);
        !within || elsewhere.any(|l| *l)
    };
    levels
        .iter()
        .filter(|(from, to)| *from > 0 && to > from)
        .map(|&(from, to)| {
            let mut end = to;
            while end > from + 1 && found[end - 1].end - found[from].start > budget {
                end -= 1;
            }
            (from, end)
        })
        .filter(|&(from, end)| found[end - 1].end - found[from].start <= budget)
        .filter(largest_elsewhere)
        .filter(|&(from, end)| {
            let overlaps = |(first, last)| found[from].start < last && first < found[end - 1].end;
            !apart.is_some_and(overlaps)
        })
        .min_by(|a, b| {
            let far = |l: &(usize, usize)| ((l.0 + l.1) as f64 / 2.0 - middle).abs();
            far(a).total_cmp(&far(b))
        })
        .map(|(from, end)| (found[from].start, found[end - 1].end))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn whole_cycles_are_set_aside_and_the_first_is_kept() {
        let drive: Vec<f64> = (0..3000)
            .map(|i| (1.0 + (i / 1000) as f64) * (i as f64 * std::f64::consts::TAU / 100.0).sin())
            .collect();
        let held = held_out(&drive);
        let share = held.iter().filter(|h| **h).count() as f64 / 3000.0;
        assert!((0.1..0.35).contains(&share), "{share}");
        assert!(held[..100].iter().all(|h| !h));
        assert!(held[2999]);
    }

    fn sines(amplitudes: &[f64]) -> Vec<f64> {
        let cycle = |a: &f64| {
            let a = *a;
            (0..100).map(move |i| a * (f64::from(i) * std::f64::consts::TAU / 100.0).sin())
        };
        amplitudes.iter().flat_map(cycle).collect()
    }

    #[test]
    fn a_cycle_of_the_largest_load_is_never_set_aside_with_all_others() {
        let growing: Vec<f64> = (1..=22).map(|k| f64::from(k) / 22.0).collect();
        let up_and_down = [
            0.3, 0.3, 0.3, 0.6, 0.6, 0.6, 1.0, 1.0, 1.0, 0.6, 0.6, 0.6, 0.3, 0.3, 0.3, 0.3,
        ];
        for amplitudes in [&growing[..], &up_and_down[..]] {
            let drive = sines(amplitudes);
            let held = held_out(&drive);
            let share = held.iter().filter(|h| **h).count() as f64 / drive.len() as f64;
            assert!((0.08..0.35).contains(&share), "{share}");
            let fitted = drive.iter().zip(&held).filter(|(_, h)| !**h);
            let largest = fitted.fold(0.0_f64, |most, (x, _)| most.max(x.abs()));
            assert!(largest > 0.97, "{largest}");
        }
    }

    #[test]
    fn a_begun_cycle_of_the_largest_load_stays_with_the_fit() {
        let mut drive = sines(&[0.5; 12]);
        let begun = sines(&[1.0]);
        drive.extend_from_slice(&begun[..76]);
        let held = held_out(&drive);
        // Cycles begin a sample behind their zero.
        assert!(held[1201..].iter().all(|h| !h) && held[1101..1201].iter().all(|h| *h));
    }

    #[test]
    fn where_the_fit_sees_the_end_the_cycles_before_are_set_aside() {
        let steps: Vec<f64> = (0..8).map(f64::from).collect();
        for drive in [sines(&[0.5; 30]), sines(&[1.0; 3]), steps.repeat(100)] {
            let end = Fitted {
                end: true,
                ..Fitted::default()
            };
            let (usual, other) = (held_out(&drive), held_out_elsewhere(&drive, end));
            let last = drive.len() - 2;
            assert!(usual[last] && !other[last]);
            let count = |held: &[bool]| held.iter().filter(|h| **h).count();
            assert!(2 * count(&other) > count(&usual), "{}", count(&other));
        }
    }

    #[test]
    fn where_the_fit_sees_the_middle_another_level_is_set_aside() {
        let levels = [0.3, 0.3, 0.6, 0.6, 1.0, 1.0, 0.7, 0.7, 0.4, 0.4, 1.0, 1.0];
        let middle = Fitted {
            middle: true,
            ..Fitted::default()
        };
        for drive in [sines(&levels), sines(&[1.0; 3])] {
            let (usual, other) = (held_out(&drive), held_out_elsewhere(&drive, middle));
            let end = drive.len() * 3 / 4;
            let mut both = usual[..end].iter().zip(&other);
            assert!(usual[..end].contains(&true) && both.all(|(a, b)| !(*a && *b)));
            assert_eq!(usual[end..], other[end..]);
        }
    }

    /// Of a ring-down the last cycles that count as such are set aside, and not all that follows them.
    #[test]
    fn what_rings_down_for_long_stays_with_the_fit() {
        let drive: Vec<f64> = (0..6000)
            .map(|i| 0.01 * f64::from(i))
            .map(|t| (-0.15 * t).exp() * (TAU * t).sin())
            .collect();
        let held = held_out(&drive);
        let share = held.iter().filter(|h| **h).count() as f64 / 6000.0;
        assert!((0.03..0.2).contains(&share), "{share}");
        assert!(held[4000..].iter().all(|h| !h));
    }

    #[test]
    fn a_ramp_gives_pieces_but_not_its_top() {
        let up: Vec<f64> = (0..800).map(f64::from).collect();
        let up_and_down: Vec<f64> = (0..800_i32)
            .map(|i| f64::from(400 - (i - 400).abs()))
            .collect();
        for (drive, last) in [(up, 700), (up_and_down, 800)] {
            let held = held_out(&drive);
            assert_eq!(held.iter().filter(|h| **h).count(), 150);
            assert_eq!(held.iter().rposition(|h| *h), Some(last - 1));
            let top = drive.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
            assert!(top.is_some_and(|(at, _)| !held[at]));
        }
    }
}
