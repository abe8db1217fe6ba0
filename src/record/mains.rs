//! The line of the mains in values over time.

use std::f64::consts::TAU;

use super::noise::{Noise, of_thirds, thirds};

/// What the mains' frequency is by name \[Hz\].
pub const NOMINAL: [f64; 2] = [50.0, 60.0];

/// Share by which mains leave it.
const AWAY: f64 = 0.002;

/// Frequencies tried about a nominal one, per cycle of the values.
const PER_CYCLE: f64 = 4.0;

/// Frequencies about the nominal ones, in steps of a quarter of a cycle over a time \[s\], at most `most` to either
/// side of each.
pub fn frequencies(long: f64, most: usize) -> Vec<f64> {
    let all = NOMINAL.into_iter();
    all.flat_map(|nominal| near(nominal, long, most)).collect()
}

/// Those about one nominal frequency.
pub fn near(nominal: f64, long: f64, most: usize) -> Vec<f64> {
    let half = (AWAY * nominal * PER_CYCLE * long).ceil() as usize;
    let half = half.min(most);
    let step = AWAY * nominal / half.max(1) as f64;
    let at = |i: usize| nominal + step * (i as f64 - half as f64);
    (0..=2 * half).map(at).collect()
}

/// Samples over which a sine is turned on from one to the next before it is taken anew.
const TURNED: usize = 16;

/// Angle \[rad\] by which a sample may be off its place among evenly spaced ones for the sine to be turned on to it: the
/// second order of what is off leaves a sixth of its cube.
const EVEN: f64 = 1e-3;

/// Sine and cosine of a frequency \[Hz\] at every one of some times; `each` sees its index, too.
fn waves(time: &[f64], frequency: f64, mut each: impl FnMut(usize, f64, f64)) {
    let fast = TAU * frequency;
    let long = time.last().unwrap_or(&0.0) - time.first().unwrap_or(&0.0);
    let step = long / time.len().saturating_sub(1).max(1) as f64;
    let (sine, cosine) = (fast * step).sin_cos();
    for (block, times) in time.chunks(TURNED).enumerate() {
        let (mut s, mut c) = (0.0, 1.0);
        for (i, t) in times.iter().enumerate() {
            let off = i
                .checked_sub(1)
                .map(|before| (t - times[before] - step) * fast);
            (s, c) = match off.filter(|off| off.abs() < EVEN) {
                Some(off) => {
                    let (small, large) = (off, 1.0 - 0.5 * off * off);
                    let (s, c) = (s * large + c * small, c * large - s * small);
                    (s * cosine + c * sine, c * cosine - s * sine)
                }
                None => (fast * t).sin_cos(),
            };
            each(block * TURNED + i, s, c);
        }
    }
}

/// Amplitudes of the sine and the cosine of a frequency \[Hz\] in values over time.
pub fn line(time: &[f64], values: &[f64], frequency: f64) -> (f64, f64) {
    let (mut sine, mut cosine) = (0.0, 0.0);
    waves(time, frequency, |i, s, c| {
        sine += values[i] * s;
        cosine += values[i] * c;
    });
    let half = 0.5 * time.len().max(1) as f64;
    (sine / half, cosine / half)
}

/// Values over time without their lines of some frequencies \[Hz\], one after the other.
pub fn without_lines(time: &[f64], values: &[f64], frequencies: &[f64]) -> Vec<f64> {
    let mut left = values.to_vec();
    for frequency in frequencies {
        let (sine, cosine) = line(time, &left, *frequency);
        waves(time, *frequency, |i, s, c| left[i] -= sine * s + cosine * c);
    }
    left
}

/// Noise of a channel from its fastest variations, as of `from_differences`, without what hums at the frequency of
/// the mains, or three times that, in it: [`LONGEST`] samples at most.
pub fn beneath_mains(time: &[f64], channel: &[f64]) -> Noise {
    let count = channel.len().min(LONGEST);
    let left = thirds(&channel[..count]);
    let time = &time[..left.len()];
    let long = time.last().unwrap_or(&0.0) - time.first().unwrap_or(&0.0);
    let loudest = |tried: Vec<f64>| {
        let strength = |f: f64| {
            let (sine, cosine) = line(time, &left, f);
            sine.hypot(cosine)
        };
        let all = tried.into_iter().map(|f| (strength(f), f));
        all.max_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(0.0, |(_, f)| f)
    };
    let mains = loudest(frequencies(long, MOST));
    let near = |i: i32| mains + f64::from(i) / (FINER * PER_CYCLE * long.max(f64::MIN_POSITIVE));
    let mains = loudest((-FINER as i32..=FINER as i32).map(near).collect());
    let left = without_lines(time, &left, &[mains, 3.0 * mains]);
    of_thirds(&left, count)
}

/// Samples that a hum is looked for in.
const LONGEST: usize = 4096;

/// Steps to either side of a nominal frequency in which it is looked for at most.
const MOST: usize = 50;

/// Parts of a step in which it is then looked for.
const FINER: f64 = 8.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::from_differences;

    #[test]
    fn a_hum_is_no_noise_beneath_it() {
        let time: Vec<f64> = (0..4000).map(|i| 0.0025 * f64::from(i)).collect();
        let noise = crate::record::noise::tests::white(4000);
        let hums = |t: &f64| (TAU * 50.03 * t).sin() + 0.3 * (TAU * 150.09 * t + 1.0).cos();
        let both = time.iter().zip(&noise);
        let channel: Vec<f64> = both.map(|(t, z)| 9.0 * hums(t) + z).collect();
        assert!(from_differences(&channel).deviation > 2.0);
        let found = beneath_mains(&time, &channel).deviation;
        assert!((found - 1.0).abs() < 0.1, "{found}");
        let found = beneath_mains(&time, &noise).deviation;
        assert!((found - 1.0).abs() < 0.1, "{found}");
    }

    #[test]
    fn a_sine_is_the_same_at_even_and_at_uneven_times() {
        for uneven in [0.0, 1e-7, 1e-4] {
            let place = |i: i32| 0.3 + 1e-3 * f64::from(i) + uneven * f64::from(i * i % 7);
            let time: Vec<f64> = (0..3000).map(place).collect();
            waves(&time, 49.97, |i, s, c| {
                let (sine, cosine) = (TAU * 49.97 * time[i]).sin_cos();
                assert!((s - sine).abs().max((c - cosine).abs()) < 1e-8, "{i}");
            });
        }
    }

    #[test]
    fn values_too_few_for_a_line_have_no_noise() {
        for count in 0..4 {
            let values = vec![2.0; count];
            assert_eq!(beneath_mains(&values, &values).deviation, 0.0);
        }
    }
}
