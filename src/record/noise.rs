//! The noise of a channel, read off what a model leaves or off the fastest variations.

use super::blended::MOST_ALIKE;
use super::colour::Colour;
use super::spectrum::{FastNoise, fast_noise};

/// Noise of one channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Standard deviation, in the channel's unit.
    pub deviation: f64,
    /// How alike neighbouring samples are: of first order, or slow and white noise at once.
    pub colour: Colour,
    /// Correlation of neighbours that repeated cycles show in it once whitened: zero for first-order noise, large behind a
    /// filter far below half the sampling rate; zero where none told.
    pub beyond: f64,
    /// Samples it was estimated from.
    pub samples: usize,
    /// True where repeated cycles gave it; false where it is read off the fastest variations.
    pub repeated: bool,
}

impl Noise {
    /// Independent samples of white noise that would tell as much: second differences of neighbouring
    /// triples share cycles, by which a variance from them scatters [`SHARED`] times as much.
    pub fn told_by(&self) -> f64 {
        let samples = self.samples as f64;
        if self.repeated {
            samples / SHARED
        } else {
            samples
        }
    }

    /// Deviation of what is new in every sample, `σ √(1 − a²)` of first-order noise.
    pub fn innovation(&self) -> f64 {
        self.deviation * self.colour.innovation()
    }

    /// As slow as it may be within so many standard errors.
    pub fn most_alike(&self, errors: f64) -> Colour {
        self.colour.slower(errors, self.told_by(), MOST_ALIKE)
    }

    /// True of what varies too slowly to be noise: a model's error rather, or what cycles do not repeat.
    pub fn is_rather_structure(&self) -> bool {
        self.colour.neighbours() > SLOW
    }

    /// Spectral density of whitened noise where it is largest over its mean, `(1 + c)/(1 − c)` with what whitening leaves of the
    /// correlation of neighbours: one for first-order noise.
    pub fn coloured(&self) -> f64 {
        (1.0 + self.beyond) / (1.0 - self.beyond)
    }

    /// True where a few repeated cycles tell more slow noise than the fast part of the whole residual allows: one
    /// of them holds a change of the response, a jump of the gain, and too few are calm to tell it by.
    pub fn holds_a_change(&self, residual: &[f64]) -> bool {
        let independent = self.told_by() * self.colour.independence_of_squares();
        independent < FEW && fast_beneath(self.deviation, residual).is_some()
    }
}

/// Correlation of neighbours above which what varies so slowly is rather structure than noise: noise of 0.9 is told as 0.93
/// at most by a thousand samples, two standard deviations of `√((1 − a²)/n)` off.
const SLOW: f64 = 0.93;

/// Independent samples from which a variance is told within a fifth.
const FEW: f64 = 50.0;

/// The noise in the fast part of a residual's spectrum, where it is of less than half that variance at most.
fn fast_beneath(deviation: f64, residual: &[f64]) -> Option<FastNoise> {
    fast_noise(residual).filter(|fast| 2.0 * fast.most.powi(2) < deviation.powi(2))
}

/// Ratio `1 + 2 (4² + 1²)/6²` of variances: second differences `(1, −2, 1)` one cycle apart correlate
/// by −4/6, two apart by 1/6.
const SHARED: f64 = 35.0 / 18.0;

/// Noise of a residual that nothing repeats in.
///
/// Its own variance and correlation of neighbours, unless the fast part of its spectrum belongs to
/// noise of less than half that variance at most: the rest is then structure that a model misses.
pub fn from_residual(residual: &[f64]) -> Noise {
    let (deviation, autoregression) = moments(residual);
    let (deviation, autoregression) = match fast_beneath(deviation, residual) {
        Some(fast) => (fast.deviation, fast.autoregression),
        None => (deviation, autoregression),
    };
    Noise {
        deviation,
        colour: Colour::first_order(autoregression),
        beyond: 0.0,
        samples: residual.len(),
        repeated: false,
    }
}

/// Noise from the fastest variations only, taken as white: third differences,
/// `Var = 20 σ²`, over which any smooth response cancels.
pub fn from_differences(residual: &[f64]) -> Noise {
    of_thirds(&thirds(residual), residual.len())
}

/// Third differences.
pub(super) fn thirds(values: &[f64]) -> Vec<f64> {
    let of = |w: &[f64]| w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0];
    values.windows(4).map(of).collect()
}

/// White noise of such differences.
pub(super) fn of_thirds(differences: &[f64], samples: usize) -> Noise {
    let mut squares: Vec<f64> = differences.iter().map(|d| d * d / 20.0).collect();
    // The median of χ²₁ is 0.4549: kinks at reversals are outliers to it.
    squares.sort_by(f64::total_cmp);
    let median = squares.get(squares.len() / 2).copied().unwrap_or(0.0);
    Noise {
        deviation: (median / 0.4549).sqrt(),
        colour: Colour::WHITE,
        beyond: 0.0,
        samples,
        repeated: false,
    }
}

/// Standard deviation and lag-one correlation.
fn moments(residual: &[f64]) -> (f64, f64) {
    let count = residual.len() as f64;
    let square = residual.iter().map(|v| v * v).sum::<f64>() / count;
    let product: f64 = residual.windows(2).map(|w| w[0] * w[1]).sum();
    if square <= 0.0 || count < 2.0 {
        return (0.0, 0.0);
    }
    let correlation = product / (count - 1.0) / square;
    // A correlation within two standard errors of zero is taken as none.
    let significant = correlation > 2.0 / count.sqrt();
    let correlation = match significant {
        true => correlation.min(MOST_ALIKE),
        false => 0.0,
    };
    (square.sqrt(), correlation)
}

#[cfg(test)]
pub mod tests {
    use super::*;

    /// Numbers drawn evenly between 0 and 1.
    pub fn drawn(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        // Knuth's linear congruential generator, its upper bits.
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// Numbers of even distribution in ±√3, and so of unit variance.
    pub fn white(count: usize) -> Vec<f64> {
        let mut random = drawn(3);
        let scaled = (0..count).map(|_| 12.0_f64.sqrt() * (random() - 0.5));
        scaled.collect()
    }

    #[test]
    fn slow_noise_of_few_cycles_is_doubted_where_the_residual_has_none_so_fast() {
        let told = |samples| Noise {
            deviation: 5.0,
            colour: Colour::first_order(0.97),
            beyond: 0.0,
            samples,
            repeated: true,
        };
        let still = white(4000);
        assert!(told(300).holds_a_change(&still));
        assert!(!told(300_000).holds_a_change(&still));
        let mut last = 0.0;
        let innovation = 5.0 * (1.0 - 0.97_f64.powi(2)).sqrt();
        let slow: Vec<f64> = still
            .iter()
            .map(|z| {
                last = 0.97 * last + innovation * z;
                last
            })
            .collect();
        assert!(!told(300).holds_a_change(&slow));
    }
}
