//! A channel that goes straight from turn to turn, beneath its noise.

use super::cycles::{span, turning_points};
use super::peaks::BAND;

/// Standard deviations of white noise that no turn is smaller than.
const WIGGLES: f64 = 8.0;

/// Samples of a ramp, at least: fewer lie on any line.
const FEWEST: usize = 6;

/// Times the scatter of its mean square by which noise may leave more of a line.
const SURELY: f64 = 3.0;

/// Variance of a sample beside a corner about lines through a dozen samples or more that meet there, over its own.
const AND_LINES: f64 = 1.5;

/// Share of the samples that lie on ramps, at least.
const MOST: f64 = 0.8;

/// Steps beside a corner within which a channel that is rounded there leaves its ramps.
const NEAR: usize = 2;

/// Steps by which the time is found at which two ramps meet.
const STEPS: usize = 5;

/// A straight stretch of a channel, or one that bends evenly, as where an amplitude grows all the time.
#[derive(Debug, Clone, Copy)]
struct Ramp {
    /// First and last sample.
    ends: [usize; 2],
    /// Time in its middle.
    middle: f64,
    /// Value and slope there, and half the bend.
    curve: [f64; 3],
}

impl Ramp {
    fn at(&self, time: f64) -> f64 {
        let t = time - self.middle;
        self.curve[0] + t * (self.curve[1] + t * self.curve[2])
    }

    fn slope(&self, time: f64) -> f64 {
        self.curve[1] + 2.0 * self.curve[2] * (time - self.middle)
    }

    /// The same as a parabola through its samples by least squares, and the sum of squares that it leaves.
    fn bent(self, time: &[f64], channel: &[f64]) -> (Ramp, f64) {
        let [first, last] = self.ends;
        let samples =
            || (first..=last).map(|i| (time[i] - self.middle, channel[i] - self.at(time[i])));
        let count = (last - first + 1) as f64;
        let mean = |of: &dyn Fn(f64) -> f64| samples().map(|(t, _)| of(t)).sum::<f64>() / count;
        // The square of time, less what a line makes of it: what the line left goes with that alone.
        let square = mean(&|t| t * t);
        let tilt = mean(&|t| t * t * t) / square;
        let bend = |t: f64| t * t - square - tilt * t;
        let (both, own) = samples().fold((0.0, 0.0), |(both, own), (t, left)| {
            (both + bend(t) * left, own + bend(t) * bend(t))
        });
        let by = both / own;
        let left = samples().map(|(t, left)| (left - by * bend(t)).powi(2));
        let [value, slope, _] = self.curve;
        let curve = [value - by * square, slope - by * tilt, by];
        let left = left.sum();
        (Ramp { curve, ..self }, left)
    }

    /// Time near the one given at which another ramp meets this one.
    fn meets(&self, other: &Ramp, near: f64) -> f64 {
        let nearer = |t: f64| t - (self.at(t) - other.at(t)) / (self.slope(t) - other.slope(t));
        (0..STEPS).fold(near, |t, _| nearer(t))
    }
}

/// The channel as the lines through its ramps say it is, samples that lie on none as they are; `None` where most lie on
/// none, or where it is rounded between them.
///
/// A line over `n` samples has at its end the variance `4σ²/n` of noise of `σ`, where a corner drawn through single samples
/// has that of `σ` or more: a joint remembers how far it was driven. Lines reach from turn to turn, or to a kink between
/// two (the end of a rest or of a level), and leave no more than white noise of `noise` does. Checked by the tests below.
pub fn ramped(time: &[f64], channel: &[f64], noise: f64) -> Option<Vec<f64>> {
    let band = BAND.max(WIGGLES * noise / span(channel));
    let turns = turning_points(channel, band);
    let sums = Sums::of(time, channel);
    let found: Vec<Option<Vec<Ramp>>> = turns
        .windows(2)
        .map(|ends| between((time, channel), &sums, [ends[0], ends[1]], noise))
        .collect();
    let both = turns.windows(2).zip(&found);
    let on_ramps = both.filter(|(_, ramps)| ramps.is_some());
    let on_ramps: usize = on_ramps.map(|(ends, _)| ends[1] - ends[0]).sum();
    if (on_ramps as f64) < MOST * channel.len() as f64 {
        return None;
    }
    let mut straight = channel.to_vec();
    for ramp in found.iter().flatten().flatten() {
        (ramp.ends[0]..=ramp.ends[1]).for_each(|i| straight[i] = ramp.at(time[i]));
    }
    let (mut left, mut near) = (0.0, 0.0);
    // What a servo rounds falls short of the corner in the samples beside it.
    let (mut beyond, mut beside) = (0.0, 0.0);
    let stretches = found.split(Option::is_none);
    for stretch in stretches {
        let ramps: Vec<Ramp> = stretch.iter().flatten().flatten().copied().collect();
        for pair in ramps.windows(2) {
            let [about, last] = [pair[0].ends[1], pair[1].ends[0]];
            let meets = pair[0].meets(&pair[1], 0.5 * (time[about] + time[last]));
            let step = (time[last] - time[about]) / (last - about) as f64;
            let slopes = [0, 1].map(|k: usize| pair[k].slope(meets));
            let turns = slopes[0] * slopes[1] < 0.0;
            let (low, high) = (about.saturating_sub(NEAR), last + NEAR);
            for i in low.max(pair[0].ends[0])..=high.min(pair[1].ends[1]) {
                straight[i] = pair[usize::from(time[i] > meets)].at(time[i]);
                let off = channel[i] - straight[i];
                left += off.powi(2);
                near += 1.0;
                if turns && (time[i] - meets).abs() < step {
                    beyond += off * slopes[0].signum();
                    beside += 1.0;
                }
            }
        }
    }
    let scatter = noise * (AND_LINES * beside).sqrt();
    let is_sharp = left <= noise_leaves(near, noise) && beyond >= -SURELY * scatter;
    is_sharp.then_some(straight)
}

/// The ramps from one turn to the next: one, two straight ones that meet between them, or one that bends; none where it is
/// none of these.
fn between(
    (time, channel): (&[f64], &[f64]),
    sums: &Sums,
    [from, to]: [usize; 2],
    noise: f64,
) -> Option<Vec<Ramp>> {
    // Which side of the corner the samples that turn are on is not known before the lines are.
    let ends = [from + 1, to.checked_sub(1)?];
    let one = sums.ramp(ends)?;
    let splits = (ends[0]..ends[1]).filter_map(|at| {
        let both = [sums.ramp([ends[0], at])?, sums.ramp([at + 1, ends[1]])?];
        Some((both[0].1 + both[1].1, both))
    });
    let two = splits.min_by(|(a, _), (b, _)| a.total_cmp(b));
    let bends = one.0.bent(time, channel);
    // Of a line that bends by less than is seen at once corners are off all the same: every value has to be worth it.
    let value = ((ends[1] - ends[0] + 1) as f64).ln() * noise * noise;
    let dear = |values: f64, ramps: &[(Ramp, f64)]| {
        let left: f64 = ramps.iter().map(|(_, left)| left).sum();
        left + values * value
    };
    let ways = [
        Some((2.0, vec![one])),
        Some((3.0, vec![bends])),
        two.map(|(_, both)| (5.0, both.to_vec())),
    ];
    let ways = ways.into_iter().flatten();
    let (_, ramps) = ways.min_by(|(a, x), (b, y)| dear(*a, x).total_cmp(&dear(*b, y)))?;
    let is_found = |(ramp, left): &(Ramp, f64)| {
        let count = (ramp.ends[1] - ramp.ends[0] - 1) as f64;
        *left <= noise_leaves(count, noise)
    };
    let found = ramps.iter().all(is_found);
    found.then(|| ramps.into_iter().map(|(ramp, _)| ramp).collect())
}

/// Sums over all samples before each: of time, value, their squares and their product, from the first sample on.
struct Sums {
    start: [f64; 2],
    before: Vec<[f64; 5]>,
}

impl Sums {
    fn of(time: &[f64], channel: &[f64]) -> Sums {
        let start = [time[0], channel[0]];
        let mut before = vec![[0.0; 5]];
        let mut all = [0.0; 5];
        for (time, value) in time.iter().zip(channel) {
            let (t, x) = (time - start[0], value - start[1]);
            let terms = [t, x, t * t, t * x, x * x];
            all.iter_mut()
                .zip(terms)
                .for_each(|(sum, term)| *sum += term);
            before.push(all);
        }
        Sums { start, before }
    }

    /// The line through samples by least squares, and the sum of squares that it leaves; none through fewer than
    /// [`FEWEST`].
    fn ramp(&self, ends: [usize; 2]) -> Option<(Ramp, f64)> {
        let [first, last] = ends;
        if last + 1 < first + FEWEST {
            return None;
        }
        let count = (last - first + 1) as f64;
        let [t, x, tt, tx, xx] =
            std::array::from_fn(|k| (self.before[last + 1][k] - self.before[first][k]) / count);
        let slope = (tx - t * x) / (tt - t * t);
        let left = count * ((xx - x * x) - slope * (tx - t * x));
        let ramp = Ramp {
            ends,
            middle: self.start[0] + t,
            curve: [self.start[1] + x, slope, 0.0],
        };
        Some((ramp, left))
    }
}

/// Most that white noise leaves of a line in a sum of so many squares.
fn noise_leaves(count: f64, noise: f64) -> f64 {
    // The noise is known no better than such a mean square.
    (1.0 + SURELY * (2.0 * 2.0 / count.max(1.0)).sqrt()) * count * noise * noise
}

#[cfg(test)]
mod tests {
    use super::super::calm::fastest;
    use super::super::noise::tests::drawn;
    use super::*;

    fn noisy(wave: impl Fn(f64) -> f64, seed: u64) -> [Vec<f64>; 3] {
        let mut random = drawn(seed);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let time: Vec<f64> = (0..1500).map(|i| 0.01 * f64::from(i)).collect();
        let clean: Vec<f64> = time.iter().map(|t| wave(*t)).collect();
        let read = clean.iter().map(|x| x + 3e-3 * noise()).collect();
        [time, clean, read]
    }

    /// Levels of a triangle of 61 samples a cycle, which starts from rest.
    fn triangle(t: f64) -> f64 {
        let cycle = (t - 0.3).max(0.0) / 0.61;
        let level = ((1.0 + (cycle / 6.0).floor()) / 4.0).min(1.0);
        level * (4.0 * ((cycle + 0.25).fract() - 0.5).abs() - 1.0)
    }

    #[test]
    fn a_triangle_beneath_its_noise_has_sharp_corners() {
        let [time, clean, read] = noisy(triangle, 20_261_128);
        let found = ramped(&time, &read, fastest(&read)).unwrap();
        let off = found.iter().zip(&clean).map(|(a, b)| a - b);
        let square: f64 = off.map(|d| d * d).sum();
        let rms = (square / clean.len() as f64).sqrt();
        assert!(rms < 1.2e-3, "{rms}");
        // Every tip is within the noise, by which a sample is off as a rule.
        let tips = super::super::peaks::between(&time, &found).peaks;
        assert!(tips.len() > 30, "{}", tips.len());
        for tip in tips.iter().filter(|tip| tip.value.abs() > 0.9) {
            assert!((tip.value.abs() - 1.0).abs() < 3e-3, "{tip:?}");
        }
    }

    /// Its amplitude grows all the time, by a tenth of it in every cycle: flanks bend by more than the noise.
    #[test]
    fn ramps_may_bend_evenly() {
        let grows = |t: f64| t * (1.0 - 4.0 * ((t / 1.5 + 0.25).fract() - 0.5).abs());
        let [time, clean, read] = noisy(grows, 20_261_128);
        let found = ramped(&time, &read, fastest(&read)).unwrap();
        let off = found.iter().zip(&clean).map(|(a, b)| (a - b).powi(2));
        let rms = (off.sum::<f64>() / clean.len() as f64).sqrt();
        assert!(rms < 1.2e-3, "{rms}");
    }

    #[test]
    fn what_is_bent_or_rounded_is_no_ramp() {
        let sine = |t: f64| (10.0 * t).sin();
        let rounded = |t: f64| (0.97 * (10.3 * t).sin()).asin();
        // By less than the noise of a sample, a third of a step wide.
        let hardly = |t: f64| (0.9998 * (10.3 * t).sin()).asin() / 0.9998_f64.asin();
        for wave in [&sine as &dyn Fn(f64) -> f64, &rounded, &hardly] {
            let [time, _, read] = noisy(wave, 20_261_129);
            assert!(ramped(&time, &read, fastest(&read)).is_none());
        }
    }
}
