//! The noise of the judged channel before any search: of cycles that repeat or change steadily, or of the fastest variations.

use super::mains_phase;
use crate::identify::{Fit, Problem};
use crate::record::Record;
use crate::record::cycles::rms;
use crate::record::mains::without_lines;
use crate::record::noise::{Noise, from_differences};
use crate::record::repeats::{from_repeats, from_steady_changes};
use crate::record::wandering::wandering;

/// Times a deviation of noise up to which what a model leaves holds hardly anything else: a fifth of the variance.
const HARDLY_MORE: f64 = 1.1;

/// The lesser of what repeated cycles of a channel and of a residual tell: where cycles are sampled at other phases, the
/// first holds what interpolation misses of a bent response, the second what noise of the drive does to a model.
fn calmer(channel: Option<Noise>, residual: Option<Noise>) -> Option<Noise> {
    let told = [channel, residual].into_iter().flatten();
    told.min_by(|a, b| a.deviation.total_cmp(&b.deviation))
}

/// Noise that is white and slow at once in what is left of a record, see [`wandering`]; none where noise was taken off the drive:
/// what that does to a model wanders as well, and is drawn where it is asked for.
pub(super) fn unlike_the_load(calmed: bool, drive: &[f64], residual: &[f64]) -> Option<Noise> {
    match calmed {
        true => None,
        false => wandering(drive, residual),
    }
}

/// Noise that repeated cycles told, of the colour that all that is left has where that is hardly more: few cycles do not tell
/// slow noise beside white noise.
fn of_all_left(told: Noise, of_all: impl FnOnce() -> Option<Noise>) -> Noise {
    let few = told.colour.share == 1.0;
    let of_all = few.then(of_all).flatten();
    match of_all.filter(|all| all.deviation < HARDLY_MORE * told.deviation) {
        Some(all) => Noise {
            colour: all.colour,
            beyond: 0.0,
            ..told
        },
        None => told,
    }
}

/// Noise of the judged channel: from cycles that repeat or change steadily where a record has them, else lent
/// by the other records, else from the fastest variations of the baseline's residual.
pub(super) fn told(
    problem: &Problem,
    first: &Fit,
    (least, records): (&[f64], &[Record]),
) -> Vec<Noise> {
    let mut residuals = first.residuals(problem);
    // A hum does not repeat with the cycles and is no noise.
    let hums = mains_phase::loudest_mains(problem, first);
    let mut hum_free = Vec::new();
    for (k, residual) in residuals.iter_mut().enumerate() {
        let (_, judged) = problem.channels(k);
        let time = &problem.records[k].time;
        let quiet = without_lines(time, residual, &hums);
        let both = judged.iter().zip(residual.iter().zip(&quiet));
        hum_free.push(both.map(|(y, (r, q))| y - (r - q)).collect::<Vec<f64>>());
        *residual = quiet;
    }
    let own: Vec<Option<Noise>> = residuals
        .iter()
        .enumerate()
        .map(|(k, residual)| {
            let (input, judged) = (problem.channels(k).0, &hum_free[k]);
            let of_residual = from_repeats(input, residual);
            let repeated = match records[k].noisy_drive {
                // What noise of the drive does to a model does so in every model.
                true => of_residual,
                false => calmer(from_repeats(input, judged), of_residual),
            };
            let found = repeated.or_else(|| from_steady_changes(input, residual));
            let found = found.filter(|n| !n.holds_a_change(residual));
            let of_all = || unlike_the_load(records[k].calmed, input, residual);
            found.map(|n| of_all_left(n, of_all))
        })
        .collect();
    let lent = own.iter().flatten().max_by_key(|n| n.samples).copied();
    own.iter()
        .zip(&residuals)
        .enumerate()
        .map(|(k, (own, residual))| {
            // Noise leaves at least itself after any fit: an estimate above what the baseline
            // leaves holds a change of the response from cycle to cycle.
            let most = 1.2 * rms(residual);
            let own = own.filter(|n| n.deviation <= most);
            let lent = lent.filter(|n| n.deviation <= most);
            let mut noise = own.or(lent).unwrap_or_else(|| from_differences(residual));
            noise.deviation = noise.deviation.max(least[k]);
            noise
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::colour::Colour;
    use crate::record::noise::tests::drawn;

    /// What a few cycles told for first-order noise is white and slow in all that is left, where that is no more than noise.
    #[test]
    fn few_cycles_do_not_tell_the_colour_of_what_is_left_of_all() {
        let mut random = drawn(20_261_201);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let drive: Vec<f64> = (0..4000)
            .map(|i| f64::from(i) / 80.0)
            .map(|t| (0.7 + 0.3 * (0.4 * t).sin()) * (std::f64::consts::TAU * t).sin())
            .collect();
        let mut slow = 0.0;
        let mut left = || {
            slow = 0.94 * slow + (1.0 - 0.94_f64.powi(2)).sqrt() * white();
            (slow + white()) * 0.5_f64.sqrt()
        };
        let residual: Vec<f64> = drive.iter().map(|_| left()).collect();
        let told = Noise {
            deviation: 1.0,
            colour: Colour::first_order(0.4),
            beyond: 0.1,
            samples: 300,
            repeated: true,
        };
        let of_all = of_all_left(told, || unlike_the_load(false, &drive, &residual));
        assert!((of_all.colour.slow - 0.94).abs() < 0.04, "{of_all:?}");
        assert!((of_all.colour.share - 0.5).abs() < 0.15, "{of_all:?}");
        assert_eq!((of_all.beyond, of_all.deviation), (0.0, 1.0));
        let more: Vec<f64> = residual.iter().map(|left| 1.3 * left).collect();
        let of_more = of_all_left(told, || unlike_the_load(false, &drive, &more));
        assert_eq!(of_more, told);
        let calmed = of_all_left(told, || unlike_the_load(true, &drive, &residual));
        assert_eq!(calmed, told);
    }
}
