//! Noise of a channel where cycles of the drive repeat: no model is needed then.

use super::blended::{Blended, beyond_first_order, moments};
use super::colour::Colour;
use super::cycles::{Cycle, alike, as_long, cycles, span};
use super::noise::Noise;
use super::peaks::between;
use super::white_and_slow::white_and_slow;

/// Noise from steady cycles: second differences over three equal cycles of the drive, so that a
/// uniform change from cycle to cycle (drift, wear) cancels as well as the response itself.
///
/// `response(t−T) − 2 response(t) + response(t+T)` has `4 + 2s` times the variance of white noise, with
/// `s` the sum of squares of the interpolation weights; of other noise see [`Blended`]. `None` where fewer than 150
/// samples lie in such triples.
pub fn from_repeats(drive: &[f64], response: &[f64]) -> Option<Noise> {
    either_way(drive, |drive| repeats(drive, response))
}

/// What cycles that begin on the way up tell, else those that begin on the way down: where blocks begin downwards, the
/// first and the last cycle upwards of each lie in two of them.
fn either_way(drive: &[f64], told: impl Fn(&[f64]) -> Option<Noise>) -> Option<Noise> {
    let downwards = || drive.iter().map(|x| -x).collect::<Vec<_>>();
    told(drive).or_else(|| told(&downwards()))
}

fn repeats(drive: &[f64], response: &[f64]) -> Option<Noise> {
    let found = cycles(drive);
    let kinked = kinked(drive);
    let differences = |triple: &[Cycle], settled: bool| {
        // Until the first cycle has reached its peak it may remember what was before.
        let skip = if settled { 0 } else { rise(drive, &triple[0]) };
        differences((drive, response), &kinked, triple, skip)
    };
    // A fourth equal cycle in front makes sure that the memory of another level has closed.
    let settled: Vec<Blended> = found
        .windows(4)
        .filter(|w| w.windows(2).all(|pair| alike(&pair[0], &pair[1])))
        .filter_map(|w| differences(&w[1..], true))
        .collect();
    let any: Vec<Blended> = if count(&settled) >= ENOUGH {
        settled
    } else {
        found
            .windows(3)
            .filter(|w| w.windows(2).all(|pair| alike(&pair[0], &pair[1])))
            .filter_map(|w| differences(w, false))
            .collect()
    };
    noise_of(any)
}

/// Noise from cycles of equal length whose level changes steadily, as in a sine that grows: third and higher
/// differences over the cycles, over which a change that is smooth from cycle to cycle cancels.
///
/// The lowest order is taken beyond which the noise falls no more. `None` where there is no such order, or
/// where fewer than 150 samples tell it.
pub fn from_steady_changes(drive: &[f64], response: &[f64]) -> Option<Noise> {
    either_way(drive, |drive| steady_changes(drive, response))
}

fn steady_changes(drive: &[f64], response: &[f64]) -> Option<Noise> {
    let found = cycles(drive);
    let kinked = kinked(drive);
    let settled = found.get(1..)?;
    let of_order = |order: usize| {
        let runs = settled.windows(order + 1);
        let equal = runs.filter(|w| w.windows(2).all(|pair| as_long(&pair[0], &pair[1])));
        let parts = equal.filter_map(|w| differences((drive, response), &kinked, w, 0));
        noise_of(parts.collect())
    };
    let noise: Vec<Option<Noise>> = ORDERS.map(of_order).into();
    noise.windows(2).find_map(|pair| match pair {
        [Some(lower), Some(higher)] if higher.deviation > CONVERGED * lower.deviation => {
            Some(*lower)
        }
        _ => None,
    })
}

/// Orders of differences over cycles that change steadily.
const ORDERS: [usize; 3] = [3, 4, 5];

/// Part of the noise by a lower order that a higher one has to show: of noise all orders show the same.
const CONVERGED: f64 = 0.9;

/// The noise of calm parts of differences.
fn noise_of(parts: Vec<Blended>) -> Option<Noise> {
    let first_order = |calm: &[&Blended]| Colour::first_order(moments(calm).1);
    let calm = calm_parts(&parts, first_order)?;
    // Slow noise beside white noise scatters the variance of a cycle more than first-order noise with such neighbours.
    let wider = white_and_slow(&calm).and_then(|(_, colour)| calm_parts(&parts, |_| colour));
    let both = wider.and_then(|wider| {
        let (deviation, colour) = white_and_slow(&wider)?;
        Some((deviation, colour, 0.0, count(wider)))
    });
    let (deviation, colour, beyond, samples) = both.unwrap_or_else(|| {
        let (deviation, alike) = moments(&calm);
        let beyond = beyond_first_order(&calm, alike);
        (deviation, Colour::first_order(alike), beyond, count(calm))
    });
    Some(Noise {
        deviation,
        colour,
        beyond,
        samples,
        repeated: true,
    })
}

/// Those parts that hold no change of the response; `None` where too few samples are left.
fn calm_parts(parts: &[Blended], colour: impl Fn(&[&Blended]) -> Colour) -> Option<Vec<&Blended>> {
    let calm = calm(parts, colour);
    (count(calm.iter().copied()) >= ENOUGH).then(|| calm_between_neighbours(calm))
}

/// Fewest samples in repeated cycles from which noise is estimated.
const ENOUGH: usize = 150;

fn count<'a>(parts: impl IntoIterator<Item = &'a Blended>) -> usize {
    let lengths = parts.into_iter().map(|part| part.differences.len());
    lengths.sum()
}

/// Second difference of the drive, over its amplitude, up to which cycles repeat at all.
const UNEQUAL: f64 = 0.02;

/// Share of the response's second differences that those of the drive may explain.
const FOLLOWED: f64 = 0.5;

/// Samples from the start of a cycle to its peak.
fn rise(drive: &[f64], cycle: &Cycle) -> usize {
    let part = &drive[cycle.start..cycle.end];
    let highest = |a: &(usize, &f64), b: &(usize, &f64)| a.1.total_cmp(b.1);
    part.iter()
        .enumerate()
        .max_by(highest)
        .map_or(0, |(at, _)| at)
}

/// Samples next to a kink of the drive: no interpolation is right there.
fn kinked(drive: &[f64]) -> Vec<bool> {
    let clock: Vec<f64> = (0..drive.len()).map(|i| i as f64).collect();
    let mut near = vec![false; drive.len()];
    for behind in between(&clock, drive).kinks {
        let about = behind.saturating_sub(3)..(behind + 2).min(drive.len());
        near[about].iter_mut().for_each(|n| *n = true);
    }
    near
}

/// Differences of the response over a run of cycles, of an order one less than their count; `None` where those of the
/// drive do not vanish well enough.
fn differences(
    (drive, response): (&[f64], &[f64]),
    kinked: &[bool],
    run: &[Cycle],
    skip: usize,
) -> Option<Blended> {
    let weights = binomial(run.len());
    let place = run.len() / 2;
    let middle = &run[place];
    let from_middle = |c: &Cycle| shift(drive, middle, c.start as f64 - middle.start as f64);
    let others: Vec<(f64, f64)> = (0..run.len())
        .filter(|&other| other != place)
        .map(|other| (from_middle(&run[other]), weights[other]))
        .collect();
    let sampled = others.iter().all(|(shift, _)| shift.fract() == 0.0);
    let difference = |channel: &[f64], i: usize| {
        let mut sum = weights[place] * channel[i];
        for (shift, weight) in &others {
            sum += weight * interpolate(channel, i as f64 + shift)?;
        }
        Some(sum)
    };
    let mut part = Blended {
        differences: Vec::new(),
        taps: vec![[weights[place], 0.0, 0.0, 0.0]],
    };
    let read = |(shift, weight): &(f64, f64)| taps(shift - shift.floor()).map(|tap| weight * tap);
    part.taps.extend(others.iter().map(read));
    let (mut unequal, mut scattered) = (0.0, 0.0);
    let smooth = |i: &usize| sampled || !kinked[*i];
    for i in (middle.start + skip..middle.end).filter(smooth) {
        if let (Some(apart), Some(driven)) = (difference(response, i), difference(drive, i)) {
            unequal += driven * driven;
            scattered += apart * apart;
            part.differences.push(apart);
        }
    }
    let root = |sum: f64| (sum / part.differences.len().max(1) as f64).sqrt();
    let follows =
        span(&response[middle.start..middle.end]) / span(&drive[middle.start..middle.end]);
    let repeats = root(unequal) < UNEQUAL * middle.amplitude
        && root(unequal) * follows <= FOLLOWED * root(scattered);
    (repeats && part.differences.len() > 8).then_some(part)
}

/// Weights of a difference over so many values: binomial coefficients of alternating sign.
fn binomial(count: usize) -> Vec<f64> {
    let mut weights = vec![1.0];
    for _ in 1..count {
        let shifted = weights.iter().skip(1).chain(&[0.0]);
        let mut next = vec![1.0];
        next.extend(shifted.zip(&weights).map(|(after, before)| after - before));
        weights = next;
    }
    weights
}

/// Keeps the runs whose variance is no further above the lower quartile's than noise scatters, and
/// at least those within twice of it: the others hold a change of the response itself, which no
/// noise estimate may contain.
///
/// A cycle of correlated noise holds few independent samples, `n (1 − a²) / (1 + a²)` for a variance of first-order noise,
/// so its variance scatters more; the calmest cycles alone would make it too small and too white.
fn calm(parts: &[Blended], colour: impl Fn(&[&Blended]) -> Colour) -> Vec<&Blended> {
    let mut squares: Vec<f64> = parts.iter().map(Blended::mean_square).collect();
    squares.sort_by(f64::total_cmp);
    let Some(&quartile) = squares.get(squares.len() / 4) else {
        return Vec::new();
    };
    let mean_length = count(parts) as f64 / parts.len() as f64;
    let within = |most: f64| -> Vec<&Blended> {
        let calm = |part: &&Blended| part.mean_square() <= most * quartile;
        parts.iter().filter(calm).collect()
    };
    let mut most = TWICE;
    for _ in 0..8 {
        let calm = within(most);
        // From too few samples no correlation can be told.
        if count(calm.iter().copied()) < ENOUGH {
            break;
        }
        let independent = colour(&calm).independence_of_squares() * mean_length;
        let spread = (2.0 / independent).sqrt();
        let wider = above_quartile(spread);
        if wider <= most {
            break;
        }
        most = wider;
    }
    within(most)
}

/// Keeps the runs whose neighbours differ by no more than noise as slow as theirs makes them, by the same measure.
///
/// What is new in every sample tells a variance by all of a run's samples, however slow the noise: a corner of the response that
/// interpolation misses shows in it, and would make slow noise look fast.
fn calm_between_neighbours(mut parts: Vec<&Blended>) -> Vec<&Blended> {
    for _ in 0..4 {
        let (_, a) = moments(&parts);
        if a == 0.0 {
            break;
        }
        let squares: Vec<f64> = parts.iter().map(|part| part.new_square(a)).collect();
        let mut ordered = squares.clone();
        ordered.sort_by(f64::total_cmp);
        let quartile = ordered[ordered.len() / 4];
        let length = count(parts.iter().copied()) as f64 / parts.len() as f64;
        let spread = (2.0 / length).sqrt();
        let most = above_quartile(spread).max(TWICE);
        let both = parts.iter().zip(&squares);
        let kept: Vec<&Blended> = both
            .filter(|(_, square)| **square <= most * quartile)
            .map(|(part, _)| *part)
            .collect();
        let enough = count(kept.iter().copied()) >= ENOUGH;
        if !enough || kept.len() == parts.len() {
            break;
        }
        parts = kept;
    }
    parts
}

/// Variance of a run over the lower quartile's up to which it passes for that of noise, of variances that scatter by `spread` of their
/// mean.
fn above_quartile(spread: f64) -> f64 {
    // A normal variable's lower quartile lies 0.674 standard deviations below its mean.
    (1.0 + SCATTER * spread) / (1.0 - 0.674 * spread).max(0.2)
}

/// The least of what passes.
const TWICE: f64 = 2.0;

/// Standard deviations above its mean up to which a cycle's variance passes for that of noise.
const SCATTER: f64 = 3.0;

/// Shift in samples, near `guess`, at which the drive repeats the given cycle best
/// (Gauss–Newton on the sum of squared differences).
fn shift(drive: &[f64], cycle: &Cycle, guess: f64) -> f64 {
    let mut shift = guess;
    for _ in 0..6 {
        let (mut product, mut norm) = (0.0, 0.0);
        for i in cycle.start..cycle.end {
            let at = i as f64 + shift;
            if let (Some(here), Some(ahead), Some(behind)) = (
                interpolate(drive, at),
                interpolate(drive, at + 0.5),
                interpolate(drive, at - 0.5),
            ) {
                let slope = ahead - behind;
                product += slope * (drive[i] - here);
                norm += slope * slope;
            }
        }
        let step = if norm > 0.0 {
            (product / norm).clamp(-2.0, 2.0)
        } else {
            0.0
        };
        shift += step;
        if step.abs() < 1e-6 {
            break;
        }
    }
    // A drive sampled in step with its period repeats to the sample: no interpolation then.
    if (shift - shift.round()).abs() < 1e-3 {
        shift.round()
    } else {
        shift
    }
}

/// Cubic Lagrange interpolation at a fractional index.
fn interpolate(channel: &[f64], at: f64) -> Option<f64> {
    let base = at.floor();
    let weights = taps(at - base);
    let base = base as isize;
    if base < 1 || base + 2 >= channel.len() as isize {
        return None;
    }
    let b = base as usize;
    let both = weights.iter().zip(&channel[b - 1..b + 3]);
    Some(both.map(|(w, y)| w * y).sum())
}

/// Weights of the four samples about a place that lies a share of a step behind the second.
fn taps(s: f64) -> [f64; 4] {
    [
        -s * (s - 1.0) * (s - 2.0) / 6.0,
        (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
        -(s + 1.0) * s * (s - 2.0) / 2.0,
        (s + 1.0) * s * (s - 1.0) / 6.0,
    ]
}
