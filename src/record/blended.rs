//! Noise of differences between cycles, some of whose values were read between samples.

use super::colour::Colour;

/// Weights of the samples of one cycle in a difference, four neighbours each.
type Taps = [f64; 4];

/// Differences over a run of cycles, and the samples that each is made of.
#[derive(Debug, Clone)]
pub(super) struct Blended {
    /// One difference per sample of the middle cycle, in the channel's unit.
    pub(super) differences: Vec<f64>,
    /// Weights of each cycle's samples.
    pub(super) taps: Vec<Taps>,
}

/// Correlation of neighbours that noise is taken for at most.
pub(super) const MOST_ALIKE: f64 = 0.99;

/// Halvings of the range of correlations: to a part in 10⁹.
const HALVINGS: usize = 30;

/// Coefficients of the powers of the correlation of neighbours, from the zeroth on.
type Powers = [f64; 6];

impl Blended {
    /// Covariance of two differences `lag` samples apart, up to 2, of noise of unit variance whose neighbours within a cycle
    /// correlate by `a`, and those of different cycles not, by powers of `a`.
    ///
    /// `Σ_j Σ_k Σ_l h_jk h_jl a^|lag + k − l|`: neighbours that were read between samples share those, and of slow noise
    /// reading between samples takes less away.
    fn covariance(&self, lag: usize) -> Powers {
        let mut powers = Powers::default();
        for h in &self.taps {
            for (k, l) in (0..4).flat_map(|k| (0..4).map(move |l| (k, l))) {
                powers[(lag + k).abs_diff(l)] += h[k] * h[l];
            }
        }
        powers
    }

    /// Variance of a difference of noise of unit variance and a colour.
    pub(super) fn variance(&self, colour: Colour) -> f64 {
        let powers = self.covariance(0);
        let Colour { slow, share } = colour;
        share * at(slow, &powers) + (1.0 - share) * powers[0]
    }

    /// Sum of the products of differences `lag` samples apart, and of how many pairs.
    fn products(&self, lag: usize) -> (f64, f64) {
        let behind = self.differences.iter().skip(lag);
        let products = self.differences.iter().zip(behind).map(|(a, b)| a * b);
        let pairs = self.differences.len().saturating_sub(lag);
        (products.sum(), pairs as f64)
    }

    /// Mean square over that of white noise of unit variance.
    pub(super) fn mean_square(&self) -> f64 {
        let (squares, samples) = self.products(0);
        squares / samples / self.covariance(0)[0]
    }

    /// Mean square of what is new in every difference, `d_t − a d_{t−1}`, over that of noise of unit variance whose neighbours
    /// correlate by `a`.
    pub(super) fn new_square(&self, a: f64) -> f64 {
        let pairs = self.differences.windows(2);
        let new: f64 = pairs.map(|w| (w[1] - a * w[0]).powi(2)).sum();
        let [none, one] = [0, 1].map(|lag| at(a, &self.covariance(lag)));
        new / (self.differences.len() as f64 - 1.0) / ((1.0 + a * a) * none - 2.0 * a * one)
    }
}

/// Value of a polynomial of the correlation of neighbours.
fn at(a: f64, powers: &Powers) -> f64 {
    powers.iter().rev().fold(0.0, |sum, c| sum * a + c)
}

/// Standard deviation and correlation of neighbours of the noise whose differences these are, the latter without the bias of
/// short parts: that of which these have the mean product of neighbours over their mean square.
pub(super) fn moments(parts: &[&Blended]) -> (f64, f64) {
    let (mut squares, mut products, mut count, mut any) = (0.0, 0.0, 0.0, 0.0);
    let (mut square, mut product) = (Powers::default(), Powers::default());
    for part in parts {
        let ((own, samples), (next, pairs)) = (part.products(0), part.products(1));
        squares += own;
        products += next;
        count += samples;
        any += pairs;
        let (own, next) = (part.covariance(0), part.covariance(1));
        for power in 0..own.len() {
            square[power] += samples * own[power];
            product[power] += pairs * next[power];
        }
    }
    if squares <= 0.0 || any <= 0.0 {
        return (0.0, 0.0);
    }
    let alike = |a: f64| at(a, &product) / at(a, &square);
    let seen = products / squares;
    // A correlation within two standard errors of none is taken as none.
    let (mut least, mut most) = match seen - alike(0.0) > 2.0 / count.sqrt() {
        true => (0.0, MOST_ALIKE),
        false => (0.0, 0.0),
    };
    for _ in 0..HALVINGS {
        let middle = 0.5 * (least + most);
        match alike(middle) < seen {
            true => least = middle,
            false => most = middle,
        }
    }
    ((squares / at(most, &square)).sqrt(), most)
}

/// Correlation of neighbours in noise whitened by the coefficient `a`, beyond what reading between samples makes of first-order
/// noise: zero for such noise, near one for noise behind a filter far below half the sampling rate. Less than chance gives is
/// none.
pub(super) fn beyond_first_order(parts: &[&Blended], a: f64) -> f64 {
    let of_lag = |lag: usize| {
        let (mut seen, mut expected, mut pairs) = (0.0, 0.0, 0.0);
        for part in parts {
            let (products, own) = part.products(lag);
            seen += products;
            expected += own * at(a, &part.covariance(lag));
            pairs += own;
        }
        [seen / pairs, expected / pairs]
    };
    let [none, one, two] = [0, 1, 2].map(of_lag);
    let whitened = |k: usize| {
        let [one, two] = [one[k] / none[k], two[k] / none[k]];
        (one * (1.0 + a * a) - a * (1.0 + two)) / (1.0 + a * a - 2.0 * a * one)
    };
    let beyond = whitened(0) - whitened(1);
    let count: usize = parts.iter().map(|part| part.differences.len()).sum();
    match beyond > CHANCE / (count as f64).sqrt() {
        true => beyond.min(MOST_COLOURED),
        false => 0.0,
    }
}

/// Correlation of neighbours that whitening is taken to leave at most: of few samples it is not known to be more.
const MOST_COLOURED: f64 = 0.9;

/// Standard errors that chance may give a correlation.
const CHANCE: f64 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one cycle as it is the differences are noise itself; a mean of two neighbours has the correlation of a mean.
    #[test]
    fn differences_covary_as_the_samples_they_share() {
        let blended = |taps: Taps| Blended {
            differences: Vec::new(),
            taps: vec![taps],
        };
        let (plain, mean) = (blended([2.0, 0.0, 0.0, 0.0]), blended([0.0, 0.5, 0.5, 0.0]));
        for a in [0.0, 0.3, 0.9] {
            let of = |one: &Blended, lag| at(a, &one.covariance(lag));
            assert_eq!((of(&plain, 0), of(&plain, 1)), (4.0, 4.0 * a));
            // Var = (1 + a)/2, and (1 + 2a + a²)/4 one sample apart.
            assert!((of(&mean, 0) - (1.0 + a) / 2.0).abs() < 1e-12);
            assert!((of(&mean, 1) - (1.0 + a).powi(2) / 4.0).abs() < 1e-12);
        }
    }

    /// Differences of noise that one pole or two of 0.8 have passed, as three cycles of the drive would give them.
    #[test]
    fn noise_behind_a_filter_is_told_from_first_order_noise() {
        let mut random = crate::record::noise::tests::drawn(20_261_127);
        let mut normal = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let mut told = |second: f64| {
            let (mut one, mut two) = (0.0, 0.0);
            let mut next = || {
                one = 0.8 * one + normal();
                two = second * two + one;
                two
            };
            let part = Blended {
                differences: (0..1000).map(|_| next()).collect(),
                taps: vec![[1.0, 0.0, 0.0, 0.0]],
            };
            let (_, a) = moments(&[&part]);
            beyond_first_order(&[&part], a)
        };
        let first_order: Vec<f64> = (0..200).map(|_| told(0.0)).collect();
        // One in 32 000 lies beyond four standard errors.
        assert!(first_order.iter().all(|b| *b == 0.0), "{first_order:?}");
        for _ in 0..20 {
            // (1.6/1.64 (1 + a²) − a (1 + r₂))/(1 − a²) with a = 1.6/1.64 and r₂ = 1.6 a − 0.64.
            let filtered = told(0.8);
            assert!((filtered - 0.62).abs() < 0.15, "{filtered}");
        }
    }
}
