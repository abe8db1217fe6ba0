//! How alike the noise of neighbouring samples is, and what makes it white.

/// White noise and slow noise at once, as shares of a variance.
///
/// Samples `k` apart correlate by `w φᵏ`, `w` the share of the slow part and `φ` the correlation of its neighbours: first-order
/// noise where there is no white part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colour {
    /// Correlation `φ` of neighbours in the slow part, −1 … 1.
    pub slow: f64,
    /// Share `w` of the slow part in the variance, above zero and up to one.
    pub share: f64,
}

impl Colour {
    /// Every sample by itself.
    pub const WHITE: Colour = Colour::first_order(0.0);

    /// First-order noise whose neighbours correlate by `a`.
    pub const fn first_order(a: f64) -> Colour {
        Colour {
            slow: a,
            share: 1.0,
        }
    }

    /// Correlation of neighbours, `w φ`.
    pub fn neighbours(&self) -> f64 {
        self.share * self.slow
    }

    /// `θ` of `x_t − φ x_{t−1} = e_t − θ e_{t−1}`, e white, which has these correlations:
    /// `θ/(1 + θ²) = φ (1 − w)/(1 + φ² − 2 w φ²)`, the root within the unit circle.
    fn remembered(&self) -> f64 {
        let Colour { slow, share } = *self;
        let product = slow * (1.0 - share);
        if product == 0.0 {
            return 0.0;
        }
        let square = 1.0 + slow * slow - 2.0 * share * slow * slow;
        let root = (square * square - 4.0 * product * product).max(0.0).sqrt();
        2.0 * product / (square + root)
    }

    /// Standard deviation of what is new in every sample of noise of unit variance: `√(1 − a²)` of first-order noise.
    pub fn innovation(&self) -> f64 {
        let (slow, remembered) = (self.slow, self.remembered());
        let beside = 1.0 + remembered * (remembered - 2.0 * slow);
        ((1.0 - slow * slow) / beside).max(0.0).sqrt()
    }

    /// What a sample counts for in a mean, `1/Σ_k ρ_k` over all distances of either sign.
    pub fn independence(&self) -> f64 {
        (1.0 - self.slow) / (1.0 - self.slow + 2.0 * self.neighbours())
    }

    /// What a sample counts for in a variance, `1/Σ_k ρ_k²`.
    pub fn independence_of_squares(&self) -> f64 {
        let square = self.slow * self.slow;
        (1.0 - square) / (1.0 - square + 2.0 * self.share * self.share * square)
    }

    /// That of every `every`-th sample, `w φ^(every k)`.
    pub fn apart(&self, every: usize) -> Colour {
        Colour {
            slow: (0..every).fold(1.0, |product, _| product * self.slow),
            share: self.share,
        }
    }

    /// As slow as so many independent samples leave possible within so many standard errors, and no slower than `most`:
    /// `Var φ = (1 − φ²)(1 − φθ)²/(n (φ − θ)²)` (Box and Jenkins), Bartlett's `(1 − a²)/n` of first-order noise.
    pub fn slower(&self, errors: f64, samples: f64, most: f64) -> Colour {
        let (slow, remembered) = (self.slow, self.remembered());
        let beside = match remembered == 0.0 {
            true => 1.0,
            false => (1.0 - slow * remembered) / (slow - remembered),
        };
        let error = ((1.0 - slow * slow) / samples.max(1.0)).sqrt() * beside;
        Colour {
            slow: (slow + errors * error).min(most.max(slow)),
            ..*self
        }
    }

    /// What whitens it, from a first sample on.
    pub fn whitening(&self) -> Whitening {
        Whitening {
            slow: self.slow,
            remembered: self.remembered(),
            begins: self.innovation(),
            spread: f64::NAN,
        }
    }
}

/// The coefficients by which sample after sample becomes what is new in it (the innovations algorithm of the two
/// correlations that [`Colour`] has).
#[derive(Debug, Clone, Copy)]
pub struct Whitening {
    slow: f64,
    remembered: f64,
    /// Deviation of what is new over that of noise.
    begins: f64,
    /// Variance of what is new in the last sample over that far behind a beginning.
    spread: f64,
}

/// How one sample is whitened: `e = x − slow · x_before + kept · e_before`, and `scale · e` has the variance of what is new far
/// behind a beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Factor of the sample before.
    pub slow: f64,
    /// Factor of what was new in the sample before.
    pub kept: f64,
    /// Factor of what is new.
    pub scale: f64,
}

/// Distance from one at which a variance no longer changes.
const SETTLED: f64 = 1e-13;

impl Whitening {
    /// True where what was new in a sample counts in the next.
    #[inline]
    pub fn keeps(&self) -> bool {
        self.remembered != 0.0
    }

    /// The step of the next sample; anew where nothing is known of the one before.
    #[inline]
    pub fn step(&mut self, anew: bool) -> Step {
        if anew || self.spread.is_nan() {
            self.spread = match self.remembered == 0.0 {
                true => 1.0,
                false => self.begins.powi(-2),
            };
            return Step {
                slow: 0.0,
                kept: 0.0,
                scale: self.begins,
            };
        }
        let kept = self.remembered / self.spread;
        if self.spread != 1.0 {
            self.spread = 1.0 + self.remembered * (self.remembered - kept);
            if (self.spread - 1.0).abs() < SETTLED {
                self.spread = 1.0;
            }
        }
        Step {
            slow: self.slow,
            kept,
            scale: if self.spread == 1.0 {
                1.0
            } else {
                1.0 / self.spread.sqrt()
            },
        }
    }
}

/// One channel whitened sample after sample.
#[derive(Debug, Clone, Copy, Default)]
pub struct White {
    before: f64,
    new: f64,
}

impl White {
    /// The whitened sample.
    #[inline]
    pub fn next(&mut self, step: &Step, value: f64) -> f64 {
        self.new = value - step.slow * self.before + step.kept * self.new;
        self.before = value;
        step.scale * self.new
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::drawn;

    /// Lower triangle of the Cholesky factor of so many samples' correlations, solved for given values: the definition of what
    /// whitening does, up to the scale of what is new.
    fn by_factor(colour: Colour, values: &[f64]) -> Vec<f64> {
        let correlation = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 1.0,
            apart => colour.share * colour.slow.powi(apart as i32),
        };
        let mut factor = vec![vec![0.0; values.len()]; values.len()];
        let mut white: Vec<f64> = Vec::new();
        for i in 0..values.len() {
            for j in 0..=i {
                let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                let left = correlation(i, j) - known;
                factor[i][j] = if i == j {
                    left.sqrt()
                } else {
                    left / factor[j][j]
                };
            }
            let known: f64 = (0..i).map(|k| factor[i][k] * white[k]).sum();
            white.push((values[i] - known) / factor[i][i]);
        }
        white.iter().map(|w| w * colour.innovation()).collect()
    }

    const COLOURS: [Colour; 6] = [
        Colour::WHITE,
        Colour::first_order(0.9),
        Colour::first_order(-0.5),
        Colour {
            slow: 0.95,
            share: 0.5,
        },
        Colour {
            slow: 0.99,
            share: 0.1,
        },
        Colour {
            slow: 0.6,
            share: 0.9,
        },
    ];

    #[test]
    fn whitening_is_that_of_the_correlations() {
        let mut random = drawn(20_261_130);
        let values: Vec<f64> = (0..60).map(|_| random() - 0.5).collect();
        for colour in COLOURS {
            let expected = by_factor(colour, &values);
            let mut whitening = colour.whitening();
            let mut white = White::default();
            for (i, (value, expected)) in values.iter().zip(&expected).enumerate() {
                let z = white.next(&whitening.step(i == 0), *value);
                assert!(
                    (z - expected).abs() < 1e-10,
                    "{colour:?} {i}: {z} {expected}"
                );
            }
            // Behind a gap it begins as it began.
            let z = white.next(&whitening.step(true), values[0]);
            assert!((z - expected[0]).abs() < 1e-12);
        }
    }

    #[test]
    fn samples_count_as_their_correlations_say() {
        for colour in COLOURS {
            let correlation = |k: i32| colour.share * colour.slow.powi(k);
            let mean: f64 = 1.0 + 2.0 * (1..4000).map(correlation).sum::<f64>();
            let square: f64 = 1.0 + 2.0 * (1..4000).map(|k| correlation(k).powi(2)).sum::<f64>();
            assert!(
                (colour.independence() * mean - 1.0).abs() < 1e-9,
                "{colour:?}"
            );
            let counted = colour.independence_of_squares();
            assert!((counted * square - 1.0).abs() < 1e-9, "{colour:?}");
            let third = colour.apart(3);
            assert!((third.neighbours() - correlation(3)).abs() < 1e-12);
            // Every sample alone is as slow as it was.
            assert_eq!(colour.apart(1), colour);
        }
    }

    #[test]
    fn how_slow_noise_may_be_is_bartletts_of_the_first_order() {
        let slower = Colour::first_order(0.6).slower(2.0, 400.0, 0.99);
        assert!((slower.slow - (0.6 + 2.0 * 0.8 / 20.0)).abs() < 1e-12);
        assert_eq!(Colour::first_order(0.98).slower(5.0, 10.0, 0.99).slow, 0.99);
        // A slow half beside white noise is told less well than one by itself.
        let both = COLOURS[3].slower(2.0, 400.0, 0.999);
        let alone = Colour::first_order(0.95).slower(2.0, 400.0, 0.999);
        assert!(
            both.slow > alone.slow && both.share == 0.5,
            "{both:?} {alone:?}"
        );
    }
}
