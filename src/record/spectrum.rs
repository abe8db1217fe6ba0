//! Noise read off the upper seven eighths of a residual's spectrum, where a model's errors hardly reach.

use std::f64::consts::{PI, TAU};

/// Samples of a segment, the most of which there are enough; neighbouring segments overlap by half.
///
/// Of drawn noise of any correlation 150 samples in the shortest pass for slower structure no more often than 600 in
/// the longest.
const SEGMENTS: [usize; 3] = [128, 64, 32];

/// Share of a segment's bins that are not used: what is slower than an eighth of the sampling rate's half may be
/// structure.
const SLOW: usize = 16;

/// Fewest segments whose median tells a spectrum.
const FEWEST: usize = 7;

/// Noise that the fast part of a spectrum tells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FastNoise {
    /// Standard deviation, in the residual's unit.
    pub deviation: f64,
    /// Correlation of neighbours.
    pub autoregression: f64,
    /// Largest standard deviation that the fast part allows: slow noise hardly shows there.
    pub most: f64,
}

/// Twice the fall of the logarithmic likelihood within which a correlation is possible: one standard
/// deviation, doubled for a median that tells half as much as a mean.
const POSSIBLE: f64 = 2.0;

/// First-order autoregressive noise `S(ω) = s²/(1 − 2a cos ω + a²)` that fits the fast part of the
/// spectrum best (Whittle's likelihood); `None` where the residual is too short.
///
/// The periodogram is a median over segments, so that kinks and bursts of structure count little.
pub fn fast_noise(residual: &[f64]) -> Option<FastNoise> {
    let enough = |segment: &usize| 2 * residual.len() / segment > FEWEST;
    let segment = SEGMENTS.into_iter().find(enough)?;
    let spectrum = spectrum(residual, segment);
    let band = segment / SLOW..segment / 2;
    let shape = |a: f64, bin: usize| {
        1.0 / (1.0 - 2.0 * a * (TAU * bin as f64 / segment as f64).cos() + a * a)
    };
    let innovation = |a: f64| {
        let sum: f64 = band.clone().map(|bin| spectrum[bin] / shape(a, bin)).sum();
        sum / band.len() as f64
    };
    let against = |a: f64| {
        let logs: f64 = band.clone().map(|bin| shape(a, bin).ln()).sum();
        innovation(a).ln() + logs / band.len() as f64
    };
    let correlations = || (0..100).map(|step| 0.01 * f64::from(step));
    let best = correlations().min_by(|&x, &y| against(x).total_cmp(&against(y)))?;
    let samples = band.len() as f64 * residual.len() as f64 / segment as f64;
    let deviation = |a: f64| (innovation(a) / (1.0 - a * a)).sqrt();
    let most = correlations()
        .filter(|&a| 2.0 * samples * (against(a) - against(best)) <= POSSIBLE)
        .map(deviation)
        .fold(deviation(best), f64::max);
    deviation(best).is_finite().then(|| FastNoise {
        deviation: deviation(best),
        autoregression: best,
        most,
    })
}

/// Median periodogram over overlapping segments under a Hann window, scaled so that white noise of
/// unit variance gives one in every bin.
fn spectrum(residual: &[f64], segment: usize) -> Vec<f64> {
    let starts: Vec<usize> = (0..)
        .map(|k| k * segment / 2)
        .take_while(|start| start + segment <= residual.len())
        .collect();
    let phase = |i: usize| TAU * i as f64 / segment as f64;
    let window: Vec<f64> = (0..segment)
        .map(|i| (PI * i as f64 / segment as f64).sin().powi(2))
        .collect();
    let power: f64 = window.iter().map(|w| w * w).sum();
    let turns: Vec<(f64, f64)> = (0..segment).map(|i| phase(i).sin_cos()).collect();
    let mut bins = vec![Vec::new(); segment / 2];
    for start in starts {
        let part = &residual[start..start + segment];
        let mean = part.iter().sum::<f64>() / segment as f64;
        let part: Vec<f64> = part
            .iter()
            .zip(&window)
            .map(|(x, w)| (x - mean) * w)
            .collect();
        for (bin, values) in bins.iter_mut().enumerate() {
            let (mut real, mut imaginary) = (0.0, 0.0);
            for (i, x) in part.iter().enumerate() {
                let (sine, cosine) = turns[i * bin % segment];
                real += x * cosine;
                imaginary += x * sine;
            }
            values.push((real * real + imaginary * imaginary) / power);
        }
    }
    // The median of a variable that is distributed as χ²₂/2 is ln 2 of its mean.
    let median = |values: &mut Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2] / std::f64::consts::LN_2
    };
    bins.iter_mut().map(median).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coloured noise of unit variance, nearly normal, beneath a slow wave five times as large.
    fn record(length: u32, correlation: f64, wave: f64) -> Vec<f64> {
        let mut random = crate::record::noise::tests::drawn(7);
        let mut last = 0.0;
        (0..length)
            .map(|i| {
                let normal = (0..12).map(|_| random()).sum::<f64>() - 6.0;
                last = correlation * last + (1.0 - correlation * correlation).sqrt() * normal;
                last + wave * (0.04 * f64::from(i)).sin()
            })
            .collect()
    }

    #[test]
    fn noise_is_told_with_and_without_a_slow_wave_above_it() {
        for correlation in [0.0, 0.5, 0.8] {
            for wave in [0.0, 5.0] {
                let noise = fast_noise(&record(6000, correlation, wave)).unwrap();
                let off = (noise.autoregression - correlation).abs();
                assert!(off < 0.07, "{correlation}: {noise:?}");
                let off = (noise.deviation - 1.0).abs();
                assert!(off < 0.15, "{correlation}: {noise:?}");
                assert!(
                    (0.98..2.0).contains(&noise.most),
                    "{correlation}: {noise:?}"
                );
            }
        }
        assert_eq!(fast_noise(&[1.0; 100]), None);
    }

    /// White noise beneath a wave of five times its size, in records of 150 to 600 samples.
    #[test]
    fn of_short_records_noise_is_told_in_shorter_segments() {
        for length in [150, 300, 450, 600] {
            let noise = fast_noise(&record(length, 0.0, 5.0)).unwrap();
            assert!((0.7..1.4).contains(&noise.deviation), "{length}: {noise:?}");
            assert!(noise.most < 2.0, "{length}: {noise:?}");
        }
    }
}
