//! Which samples are set aside before looking: whole cycles, in every record.

use super::cycles::{Cycle, alike, cycles};

/// Marks the samples of a drive that no fit may see: the last cycles in time and one whole load
/// level from the middle of the record (an amplitude or a rate that the fit then has to predict).
///
/// About a fifth of the record; a record without cycles gives its last eighth and a piece of its
/// middle. The first cycle and the virgin leg always stay with the fit.
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
    let last = found.len() - (found.len() / 10).max(1);
    mark(found[last].start, drive.len());
    let budget = drive.len() / 7;
    if let Some((from, to)) = middle_level(&found[1..last], budget) {
        mark(from, to);
    }
    held
}

/// The level nearest the middle whose samples fit the budget; else a piece of that length.
fn middle_level(found: &[Cycle], budget: usize) -> Option<(usize, usize)> {
    let mut levels: Vec<(usize, usize)> = Vec::new();
    let mut start = 0;
    for i in 1..=found.len() {
        if i == found.len() || !alike(&found[i - 1], &found[i]) {
            levels.push((start, i));
            start = i;
        }
    }
    let middle = found.len() as f64 / 2.0;
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

    #[test]
    fn a_ramp_gives_pieces() {
        let drive: Vec<f64> = (0..800).map(f64::from).collect();
        let held = held_out(&drive);
        assert_eq!(held.iter().filter(|h| **h).count(), 150);
    }
}
