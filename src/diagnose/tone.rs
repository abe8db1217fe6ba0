//! A steady tone in what a model leaves: cycles of the load do not repeat it, so that it passes for noise.

use crate::identify::weighing::whitened;
use crate::identify::{Prediction, Problem};
use crate::record::colour::Colour;
use crate::record::noise::Noise;
use std::f64::consts::TAU;

/// A sine that goes on through a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tone {
    /// Index of the record.
    pub record: usize,
    /// Cycles per sample.
    pub frequency: f64,
    /// Its part of the variance of what is left, once whitened.
    pub share: f64,
}

/// Samples apart from which noise has forgotten itself and a tone has not.
const FAR: usize = 64;

/// Distances that are looked at.
const LAGS: usize = 256;

/// Distances at which what noise is alike by itself is told.
const NEAR: usize = 32;

/// Cycles within [`LAGS`] below which what goes together is slow and no tone.
const SLOWEST: usize = 4;

/// Part of the correlations' square that lies about one frequency in a tone.
const PURE: f64 = 0.5;

/// Standard errors by which correlations of noise may exceed their mean square.
const CHANCE: f64 = 6.0;

/// Part of the variance from which a tone matters: three tenths of the noise in rms.
const MATTERS: f64 = 0.1;

/// The loudest tone in what a model leaves of any record.
///
/// Of noise the mean square of a correlation is `B/n`, B the sum of the squares of those nearby (Bartlett); of a tone of the
/// share s it is `s²/2` at any distance. Records shorter than four times the farthest distance tell none.
pub fn tone(problem: &Problem, predictions: &[Prediction], noise: &[Noise]) -> Option<Tone> {
    let tones = predictions
        .iter()
        .enumerate()
        .filter_map(|(k, prediction)| {
            let left = of_record(problem, (k, prediction), noise[k].colour);
            Some(Tone {
                record: k,
                ..told(&left)?
            })
        });
    tones.max_by(|a, b| a.share.total_cmp(&b.share))
}

/// What is left of a record, whitened, about its mean; nothing where no fit answers for a sample.
fn of_record(problem: &Problem, (k, prediction): (usize, &Prediction), colour: Colour) -> Vec<f64> {
    let (_, judged) = problem.channels(k);
    let record = &problem.records[k];
    let errors = judged.iter().zip(&prediction.judged).enumerate();
    let mut left = whitened(colour, errors.map(|(i, (y, p))| (y - p, record.counts(i))));
    let silent = left.iter_mut().enumerate();
    for (_, w) in silent.filter(|(i, _)| !record.counts(*i)) {
        *w = 0.0;
    }
    let mean = left.iter().sum::<f64>() / left.len().max(1) as f64;
    left.iter_mut().for_each(|w| *w -= mean);
    left
}

fn told(left: &[f64]) -> Option<Tone> {
    if left.len() < 4 * (FAR + LAGS) {
        return None;
    }
    let square: f64 = left.iter().map(|w| w * w).sum();
    let correlation = |lag: usize| {
        let pairs = left.iter().zip(&left[lag..]);
        let reach = left.len() as f64 / (left.len() - lag) as f64;
        reach * pairs.map(|(a, b)| a * b).sum::<f64>() / square
    };
    // Written so that what is no number is none.
    let rests = square > 0.0;
    if !rests {
        return None;
    }
    let near = (1..=NEAR).map(|lag| 2.0 * correlation(lag).powi(2));
    let alike = 1.0 + near.sum::<f64>();
    let far: Vec<f64> = (FAR..FAR + LAGS).map(correlation).collect();
    let mean = far.iter().sum::<f64>() / LAGS as f64;
    let power = |bin: usize| {
        let wave = |(i, r): (usize, &f64)| {
            let (sine, cosine) = (TAU * (i * bin % LAGS) as f64 / LAGS as f64).sin_cos();
            [(r - mean) * sine, (r - mean) * cosine]
        };
        let add = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
        let [sine, cosine] = far.iter().enumerate().map(wave).fold([0.0; 2], add);
        2.0 * (sine * sine + cosine * cosine) / (LAGS * LAGS) as f64
    };
    let powers: Vec<f64> = (0..LAGS / 2).map(power).collect();
    let all: f64 = powers.iter().sum();
    let highest = (SLOWEST..LAGS / 2 - 1).max_by(|a, b| powers[*a].total_cmp(&powers[*b]))?;
    let about = &powers[highest - 1..=highest + 1];
    let pure: f64 = about.iter().sum();
    let by_noise = alike / left.len() as f64 * (1.0 + CHANCE * (2.0 * alike / LAGS as f64).sqrt());
    let share = (2.0 * (pure - by_noise).max(0.0)).sqrt();
    // Where a tone lies between two of the frequencies both have a part.
    let centre = about.iter().zip([-1.0, 0.0, 1.0]);
    let off = centre.map(|(p, at)| p * at).sum::<f64>() / pure;
    (pure > PURE * all && share > MATTERS).then_some(Tone {
        record: 0,
        frequency: (highest as f64 + off) / LAGS as f64,
        share,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::drawn;

    /// Noise of unit variance of which so much goes on, with a tone of an amplitude.
    fn left(alike: f64, (loud, frequency): (f64, f64), seed: u64) -> Vec<f64> {
        let mut random = drawn(seed);
        let mut last = 0.0;
        (0..3000)
            .map(|i| {
                let normal = (0..12).map(|_| random()).sum::<f64>() - 6.0;
                last = alike * last + (1.0 - alike * alike).sqrt() * normal;
                last + loud * (TAU * frequency * f64::from(i)).sin()
            })
            .collect()
    }

    #[test]
    fn a_tone_is_told_by_its_frequency_and_its_share() {
        for (seed, frequency) in [(1, 0.03), (2, 0.0713), (3, 0.2004), (4, 0.43)] {
            // An amplitude of one is a variance of a half, a third of all.
            let found = told(&left(0.0, (1.0, frequency), seed)).expect("a tone");
            assert!((found.frequency - frequency).abs() < 2e-3, "{found:?}");
            assert!((found.share - 0.333).abs() < 0.06, "{found:?}");
        }
    }

    #[test]
    fn noise_has_no_tone_however_slow() {
        for alike in [0.0, 0.6, 0.9, 0.98] {
            for seed in 0..100 {
                let found = told(&left(alike, (0.0, 0.0), 10 + seed));
                assert_eq!(found, None, "{alike}, {seed}");
            }
        }
    }

    #[test]
    fn short_records_and_silence_tell_none() {
        assert_eq!(told(&left(0.0, (3.0, 0.1), 1)[..1000]), None);
        assert_eq!(told(&[0.0; 3000]), None);
    }
}
