//! Names that are taken back before anything is said of them.

use super::drawn_drives::Drives;
use super::noise_alone::beyond_noise;
use super::outsiders::stood_for;
use super::prepare::Bench;
use super::search::Found;
use super::structure::structure;
use super::trials::alarm;

/// Share of the misfit beyond the noise that a named set must at least take away: one that takes
/// less is the least bad of wrong explanations.
const TAKES: f64 = 0.25;

/// Takes back names that leave nearly all of the misfit where it was, on the samples of the fit, and
/// structure in it: without, the noise is larger than it was taken for. Those that take away no more than noise of a drive
/// may bring, or noise of another kind than first-order, and those that one law outside the catalogue stands for, are taken
/// back as well.
fn sober(bench: &Bench, found: Found, timed: bool) -> Found {
    let rows = bench.train.rows() as f64;
    let predictions = found.best.predict(&bench.train);
    let left = structure(&bench.train, &predictions, &bench.noise);
    // What is beyond noise whose variance is known to its own scatter only, and what is structure in any case.
    let noise = rows * bench.most_left().unwrap_or(1.0);
    let beyond = (found.baseline.misfit - noise).max(left.share * rows);
    let taken = found.baseline.misfit - found.best.misfit;
    let takes_little = taken < TAKES * beyond && left.is_seen();
    let all = (0..found.best.effects.len()).collect();
    match takes_little || taken < bench.least_taken(alarm(&bench.train)) {
        true => found.without(bench, all),
        false => {
            let stood_for = stood_for(bench, &found, timed);
            found.without(bench, stood_for)
        }
    }
}

/// What stays of a set once that is sober, and names that noise of the drive may have brought.
pub(super) struct Kept {
    pub(super) found: Found,
    /// Names taken back as [`beyond_noise`] does.
    pub(super) by_noise: Vec<&'static str>,
    /// True where any name was taken back.
    pub(super) taken_back: bool,
}

impl Kept {
    pub(super) fn of(drives: Option<&Drives>, bench: &Bench, found: Found, timed: bool) -> Kept {
        let named = found.best.effects.len();
        let kept = sober(bench, found, timed);
        let mut by_noise: Vec<&str> = kept.best.effects.iter().map(|a| a.effect.name()).collect();
        let found = beyond_noise(drives, bench, kept);
        by_noise.retain(|name| found.best.effect(name).is_none());
        Kept {
            taken_back: found.best.effects.len() < named,
            by_noise,
            found,
        }
    }
}
