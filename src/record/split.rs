//! Which samples are set aside before looking: whole cycles, in every record.

use super::cycles::{Cycle, alike, cycles};

/// Marks the samples of a drive that no fit may see: the last cycles in time and one whole load
/// level from the middle of the record (an amplitude or a rate that the fit then has to predict).
///
/// About a fifth of the record; a record without cycles gives its last eighth and a piece of its
/// middle. The first cycle and the virgin leg always stay with the fit, and so does a cycle of the largest
/// load: what a joint does beyond the loads of the fit is not told by them. Where the last cycles hold all of
/// those, the ones before are set aside in their place.
pub fn held_out(drive: &[f64]) -> Vec<bool> {
    let mut held = vec![false; drive.len()];
    let found = cycles(drive);
    let mut mark = |from: usize, to: usize| held[from..to].iter_mut().for_each(|h| *h = true);
    if found.len() < 6 {
        let n = drive.len();
        mark(n * 7 / 16, n / 2);
        mark(n * 7 / 8, n);
        return held;
    }
    let count = (found.len() / 10).max(1);
    let largest = largest(drive, &found);
    let at_end = found.len() - count;
    let last = match largest.iter().position(|l| *l) {
        Some(first) if first >= at_end => first - count,
        _ => at_end,
    };
    let to = found
        .get(last + count)
        .map_or(drive.len(), |next| next.start);
    mark(found[last].start, to);
    let budget = drive.len() / 7;
    if let Some((from, to)) = middle_level(&found[1..last], &largest[1..last], budget) {
        mark(from, to);
    }
    held
}

/// Part of the largest load from which a cycle counts as one of it.
const AS_LARGE: f64 = 0.97;

/// Which cycles reach the largest load, up or down.
fn largest(drive: &[f64], found: &[Cycle]) -> Vec<bool> {
    let reach = |c: &Cycle| {
        let part = drive[c.start..c.end].iter();
        part.fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    let most = found.iter().map(reach).fold(0.0, f64::max);
    found.iter().map(|c| reach(c) >= AS_LARGE * most).collect()
}

/// The level nearest the middle whose samples fit the budget and that is not the only one of the largest load.
fn middle_level(found: &[Cycle], largest: &[bool], budget: usize) -> Option<(usize, usize)> {
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
        .min_by(|a, b| {
            let far = |l: &(usize, usize)| ((l.0 + l.1) as f64 / 2.0 - middle).abs();
            far(a).total_cmp(&far(b))
        })
        .map(|(from, end)| (found[from].start, found[end - 1].end))
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn a_ramp_gives_pieces() {
        let drive: Vec<f64> = (0..800).map(f64::from).collect();
        let held = held_out(&drive);
        assert_eq!(held.iter().filter(|h| **h).count(), 150);
    }
}
