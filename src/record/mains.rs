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

/// Amplitudes of the sine and the cosine of a frequency \[Hz\] in values over time.
pub fn line(time: &[f64], values: &[f64], frequency: f64) -> (f64, f64) {
    let (mut sine, mut cosine) = (0.0, 0.0);
    for (t, value) in time.iter().zip(values) {
        let (s, c) = (TAU * frequency * t).sin_cos();
        sine += value * s;
        cosine += value * c;
    }
    let half = 0.5 * time.len().max(1) as f64;
    (sine / half, cosine / half)
}

/// Values over time without their lines of some frequencies \[Hz\], one after the other.
pub fn without_lines(time: &[f64], values: &[f64], frequencies: &[f64]) -> Vec<f64> {
    let mut left = values.to_vec();
    for frequency in frequencies {
        let (sine, cosine) = line(time, &left, *frequency);
        for (t, value) in time.iter().zip(&mut left) {
            let (s, c) = (TAU * frequency * t).sin_cos();
            *value -= sine * s + cosine * c;
        }
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
    fn values_too_few_for_a_line_have_no_noise() {
        for count in 0..4 {
            let values = vec![2.0; count];
            assert_eq!(beneath_mains(&values, &values).deviation, 0.0);
        }
    }
}
