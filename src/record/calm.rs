//! A smooth channel beneath its noise.

/// Samples to either side over which a parabola is fitted, one width after the other.
const WIDTHS: [usize; 6] = [2, 3, 4, 6, 8, 12];

/// Standard errors within which what two widths say is the same. Judged: with fewer, a ramp keeps more of its noise; with
/// more, a sharp corner is further off than its noise.
const ALIKE: f64 = 1.3;

/// The same up to a width over which parabolas leave noise alone of the whole channel: there are no corners to keep then,
/// and what two widths say differs by chance.
const SURELY: f64 = 3.0;

/// Standard errors beyond which a sample stands out from its neighbours: of a million normal ones none does.
const ALONE: f64 = 5.5;

/// Samples of one side that foretell the next within twice their noise.
const SIDE: usize = 6;

/// The channel as parabolas over its neighbours say it is, over as many as agree.
///
/// A least-squares parabola over `2m + 1` samples has the variance `σ² 3(3m² + 3m − 1)/((2m − 1)(2m + 1)(2m + 3))` in
/// their middle (Savitzky and Golay 1964). The widest is taken whose interval of [`ALIKE`] standard errors has a
/// value in common with those of all narrower ones (intersection of confidence intervals, Goldenshluger and
/// Nemirovski 1997), so that corners, jumps and peaks stay as they are. Of [`SURELY`] standard errors are those up to the
/// width over which the whole channel is smooth but for sparks, which are struck out first. `noise` is `σ`. Checked by the
/// tests below.
pub fn calmed(channel: &[f64], noise: f64) -> Vec<f64> {
    let (bare, smooth) = smooth_over(channel, noise);
    agreed(&bare, noise, smooth)
}

/// The same of a channel that is smooth but for its noise and sparks over [`SIDE`] neighbours and more.
pub fn smoothed(channel: &[f64], noise: f64) -> Option<Vec<f64>> {
    let (bare, smooth) = smooth_over(channel, noise);
    (smooth >= SIDE).then(|| agreed(&bare, noise, smooth))
}

/// What the parabolas that agree say of a channel that is smooth over so many neighbours.
fn agreed(channel: &[f64], noise: f64, smooth: usize) -> Vec<f64> {
    let alike = |m: usize| if m <= smooth { SURELY } else { ALIKE };
    let calm = |i: usize| {
        let nearest = i.min(channel.len() - 1 - i);
        let mut value = channel[i];
        let within = alike(0) * noise;
        let (mut low, mut high) = (value - within, value + within);
        for m in WIDTHS.into_iter().take_while(|&m| m <= nearest) {
            let (wider, error) = parabola(&channel[i - m..=i + m]);
            let within = alike(m) * noise * error;
            (low, high) = (low.max(wider - within), high.min(wider + within));
            if low > high {
                break;
            }
            value = wider;
        }
        value
    };
    (0..channel.len()).map(calm).collect()
}

/// The widest neighbourhood over which parabolas leave no more of the channel than white noise of `noise`, and the channel
/// without what stands out from them alone; as it is and zero where none do.
///
/// Of noise `n` samples leave `σ² (1 − error²)` each, within `√(2/n)` of it, and `σ` is known no better.
fn smooth_over(channel: &[f64], noise: f64) -> (Vec<f64>, usize) {
    let leaves_noise = |m: usize| {
        let bare = sparkless(channel, m, noise);
        let (slow, kept) = slow_over(&bare, m);
        let both = bare.iter().zip(&slow);
        let left: f64 = both.map(|(value, slow)| (value - slow).powi(2)).sum();
        let count = channel.len().saturating_sub(2 * m) as f64;
        let most = (1.0 + SURELY * (2.0 * 2.0 / count).sqrt()) * count * kept * noise * noise;
        (left < most).then_some((bare, m))
    };
    let widest = WIDTHS.into_iter().rev().find_map(leaves_noise);
    widest.unwrap_or_else(|| (channel.to_vec(), 0))
}

/// The channel with what parabolas over `m` neighbours to either side say instead of samples that are off them by more than
/// [`ALONE`] standard errors, the farthest first. The tip of a corner is not off what its own side says, and stays; so does
/// all where a side of fewer than [`SIDE`] says too little.
fn sparkless(channel: &[f64], m: usize, noise: f64) -> Vec<f64> {
    let mut bare = channel.to_vec();
    if m < SIDE {
        return bare;
    }
    let (_, error) = parabola(&vec![0.0; 2 * m + 1]);
    // What a sample is off a parabola that it has no part in.
    let kept = 1.0 - error * error;
    let off = |bare: &[f64], i: usize| (bare[i] - parabola(&bare[i - m..=i + m]).0) / kept;
    let least = ALONE * noise / kept.sqrt();
    let inner = m..channel.len().saturating_sub(m).max(m);
    let mut far: Vec<(f64, usize)> = inner
        .map(|i| (off(&bare, i).abs(), i))
        .filter(|(off, _)| *off > least)
        .collect();
    far.sort_by(|a, b| b.0.total_cmp(&a.0));
    for (_, i) in far {
        let off = off(&bare, i);
        let before = bare[i] - foretold(m, |k| bare[i - k]);
        let after = bare[i] - foretold(m, |k| bare[i + k]);
        let alone = [before, after].map(|of_side| of_side * off.signum() > 0.5 * off.abs());
        if off.abs() > least && alone == [true, true] {
            bare[i] -= off;
        }
    }
    bare
}

/// Value before the first of `m` samples by the parabola that comes nearest to them.
fn foretold(m: usize, at: impl Fn(usize) -> f64) -> f64 {
    let n = m as f64;
    let weight = |k: f64| {
        let all = n * (n - 1.0) * (n - 2.0);
        (3.0 * (3.0 * n * n + 3.0 * n + 2.0) - 18.0 * (2.0 * n + 1.0) * k + 30.0 * k * k) / all
    };
    (1..=m).map(|k| weight(k as f64) * at(k)).sum()
}

/// The channel as parabolas over the widest neighbourhood say it is, itself at its ends; and what is left of the variance of
/// white noise about them.
pub fn slow(channel: &[f64]) -> (Vec<f64>, f64) {
    slow_over(channel, WIDTHS[WIDTHS.len() - 1])
}

/// The same over `m` neighbours to either side.
fn slow_over(channel: &[f64], m: usize) -> (Vec<f64>, f64) {
    let mut slow = channel.to_vec();
    let mut kept = 1.0;
    for (i, about) in channel.windows(2 * m + 1).enumerate() {
        let (value, error) = parabola(about);
        slow[i + m] = value;
        kept = 1.0 - error * error;
    }
    (slow, kept)
}

/// Differences of which the smallest noise is taken.
const ORDERS: std::ops::RangeInclusive<u32> = 3..=8;

/// White noise that no difference of third to eighth order exceeds: `k`-th differences of white noise have the
/// variance `σ² (2k)!/(k!)²`, those of what is slower than a sixth of the sampling rate the less the higher `k`.
pub fn fastest(channel: &[f64]) -> f64 {
    let mut differences = channel.to_vec();
    let mut power = 1.0;
    let mut least = f64::INFINITY;
    for order in 1..=*ORDERS.end() {
        differences = differences.windows(2).map(|w| w[1] - w[0]).collect();
        // (2k)!/(k!)² grows by 2 (2k − 1)/k.
        power *= 2.0 * f64::from(2 * order - 1) / f64::from(order);
        let mut squares: Vec<f64> = differences.iter().map(|d| d * d / power).collect();
        squares.sort_by(f64::total_cmp);
        let median = squares.get(squares.len() / 2).copied().unwrap_or(0.0);
        if ORDERS.contains(&order) {
            // The median of χ²₁ is 0.4549: kinks at reversals are outliers to it.
            least = least.min((median / 0.4549).sqrt());
        }
    }
    least
}

/// Differences of sixth order: of a load nothing is left in them.
pub fn fastest_part(channel: &[f64]) -> Vec<f64> {
    let once = |values: Vec<f64>| values.windows(2).map(|w| w[1] - w[0]).collect();
    (0..6).fold(channel.to_vec(), |values, _| once(values))
}

/// Value of the parabola through an odd count of neighbours in their middle, and its error over theirs.
fn parabola(neighbours: &[f64]) -> (f64, f64) {
    let m = (neighbours.len() / 2) as f64;
    let all = (2.0 * m - 1.0) * (2.0 * m + 1.0) * (2.0 * m + 3.0);
    let of = |(k, value): (usize, &f64)| {
        let from_middle = k as f64 - m;
        3.0 * (3.0 * m * m + 3.0 * m - 1.0 - 5.0 * from_middle * from_middle) / all * value
    };
    let middle = neighbours.iter().enumerate().map(of).sum();
    let variance = 3.0 * (3.0 * m * m + 3.0 * m - 1.0) / all;
    (middle, variance.sqrt())
}

#[cfg(test)]
mod tests {
    use super::super::noise::tests::drawn;
    use super::*;

    #[test]
    fn a_parabola_is_met_whatever_its_width() {
        let channel: Vec<f64> = (0..40).map(|i| 3.0 - 0.2 * f64::from(i * i)).collect();
        for (before, after) in channel.iter().zip(calmed(&channel, 1.0)) {
            assert!((before - after).abs() < 1e-9, "{before} {after}");
        }
    }

    #[test]
    fn noise_is_told_from_a_fast_sine() {
        let mut random = drawn(20_261_125);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let noisy: Vec<f64> = (0..2000)
            .map(|i| 1000.0 * (0.5 * f64::from(i)).sin() + noise())
            .collect();
        let told = fastest(&noisy);
        assert!((0.85..1.5).contains(&told), "{told}");
        let smooth: Vec<f64> = (0..2000).map(|i| (0.1 * f64::from(i)).sin()).collect();
        assert!(fastest(&smooth) < 1e-6);
    }

    /// A sine of 200 samples a cycle: twelve samples to either side leave three tenths of its noise.
    #[test]
    fn what_is_smooth_throughout_loses_most_of_its_noise() {
        let mut random = drawn(20_261_128);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let true_value = |i: usize| 100.0 * (0.01 * std::f64::consts::PI * i as f64).sin();
        let noisy: Vec<f64> = (0..4000).map(|i| true_value(i) + noise()).collect();
        let calm = calmed(&noisy, fastest(&noisy));
        let at = 20..3980;
        let squares: f64 = at.clone().map(|i| (calm[i] - true_value(i)).powi(2)).sum();
        let left = (squares / at.len() as f64).sqrt();
        assert!(left < 0.36, "{left}");
        assert_eq!(smooth_over(&noisy, 1.0).1, 12);
        let corners: Vec<f64> = (0..4000)
            .map(|i| noisy[i] + 10.0 * true_value(i).abs())
            .collect();
        assert!(smooth_over(&corners, 1.0).1 < 12);
    }

    /// The same sine with six samples in a thousand off by ten times the noise.
    #[test]
    fn sparks_in_what_is_smooth_are_struck_out() {
        let mut random = drawn(20_261_129);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let true_value = |i: usize| 100.0 * (0.01 * std::f64::consts::PI * i as f64).sin();
        let spark = |i: usize| match i % 167 {
            83 => 10.0,
            _ => 0.0,
        };
        let noisy: Vec<f64> = (0..4000)
            .map(|i| true_value(i) + spark(i) + noise())
            .collect();
        let calm = calmed(&noisy, fastest(&noisy));
        let at = 20..3980;
        let squares: f64 = at.clone().map(|i| (calm[i] - true_value(i)).powi(2)).sum();
        let left = (squares / at.len() as f64).sqrt();
        assert!(left < 0.36, "{left}");
    }

    /// The tip of a corner that is off the parabola over all of its neighbours by ten times the noise.
    #[test]
    fn a_corner_is_no_spark() {
        let mut random = drawn(20_261_130);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let corners: Vec<f64> = (0..4000)
            .map(|i| 150.0 * (0.01 * std::f64::consts::PI * f64::from(i)).sin().abs() + noise())
            .collect();
        let (bare, smooth) = smooth_over(&corners, 1.0);
        assert!(bare == corners && smooth < SIDE, "{smooth}");
        assert!(sparkless(&corners, SIDE, 1.0) == corners);
    }

    /// A triangle and a jump of fifty times the noise: what noise is taken off leaves neither rounder.
    #[test]
    fn noise_is_taken_off_and_corners_stay() {
        let mut random = drawn(20_261_124);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let true_value = |i: usize| {
            let ramp = (i % 100) as f64;
            let jump = if i > 1000 { 50.0 } else { 0.0 };
            2.0 * ramp.min(100.0 - ramp) + jump
        };
        let noisy: Vec<f64> = (0..2000).map(|i| true_value(i) + noise()).collect();
        let left = |of: &[f64], near: bool| {
            let at = (20..1980).filter(|i| {
                let corner = (i % 50).min(50 - i % 50);
                (corner < 8) == near
            });
            let squares: Vec<f64> = at.map(|i| (of[i] - true_value(i)).powi(2)).collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let calm = calmed(&noisy, fastest(&noisy));
        let (smooth, corners) = (left(&calm, false), left(&calm, true));
        assert!(smooth < 0.5 && corners < 1.0, "{smooth} {corners}");
    }
}
