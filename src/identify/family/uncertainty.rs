//! What the fit knows of each number, and of what follows from them.

use super::shape::{EXPONENT, LAST_SHARE, NETWORK_SHARE, NUMBERS, Shape};
use nalgebra::DMatrix;

/// Standard deviation of a number known only to lie between 0 and 1.
pub const SHARE_UNKNOWN: f64 = 0.289;
/// Standard deviations of ln K_0, ln loss and χ before any data: so wide that they decide nothing,
/// so that the covariance exists.
const WIDE: [f64; 3] = [10.0, 10.0, 2.0];

/// Covariance of the numbers of a shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Uncertainty {
    covariance: DMatrix<f64>,
    /// rms change of the judged channel, over its own rms, per unit of each number.
    sensitivity: Vec<f64>,
}

impl Uncertainty {
    /// From the Jacobian over all numbers, the variance of a residual and its inflation by
    /// correlation. What the data leave open of the two shares is bounded by their range.
    pub fn new(jacobian: &DMatrix<f64>, variance: f64, inflation: f64) -> Option<Uncertainty> {
        let count = jacobian.nrows() as f64;
        let noise = (variance * inflation).max(f64::MIN_POSITIVE);
        let mut precision = jacobian.tr_mul(jacobian) / noise;
        let before = [WIDE[0], WIDE[1], WIDE[2], SHARE_UNKNOWN, SHARE_UNKNOWN];
        for (j, deviation) in before.iter().enumerate() {
            precision[(j, j)] += deviation.powi(-2);
        }
        let scale: Vec<f64> = (0..NUMBERS).map(|j| precision[(j, j)].sqrt()).collect();
        let scaled = DMatrix::from_fn(NUMBERS, NUMBERS, |a, b| {
            precision[(a, b)] / (scale[a] * scale[b])
        });
        let inverse = scaled.cholesky()?.inverse();
        Some(Uncertainty {
            covariance: DMatrix::from_fn(NUMBERS, NUMBERS, |a, b| {
                inverse[(a, b)] / (scale[a] * scale[b])
            }),
            sensitivity: (0..NUMBERS)
                .map(|j| (jacobian.column(j).norm_squared() / count).sqrt())
                .collect(),
        })
    }

    /// Standard deviation of one number.
    pub fn deviation(&self, number: usize) -> f64 {
        self.covariance[(number, number)].sqrt()
    }

    /// rms change of the judged channel, over its own rms, when a number changes by one.
    pub fn sensitivity(&self, number: usize) -> f64 {
        self.sensitivity[number]
    }

    /// True where the data narrow a share to less than half of what is known without data.
    pub fn knows_share(&self, number: usize) -> bool {
        self.deviation(number) < 0.5 * SHARE_UNKNOWN
    }

    /// True where the data say nothing at all of a share.
    pub fn ignores_share(&self, number: usize) -> bool {
        self.deviation(number) > 0.97 * SHARE_UNKNOWN
    }

    /// Standard deviation of a function of the numbers, to first order.
    pub fn of(&self, shape: &Shape, f: &dyn Fn(&Shape) -> f64) -> f64 {
        let gradient = gradient(shape, f);
        let mut square = 0.0;
        for a in 0..NUMBERS {
            square += gradient[a] * self.with(&gradient, a);
        }
        square.max(0.0).sqrt()
    }

    /// The same with χ known.
    pub fn beside_exponent(&self, shape: &Shape, f: &dyn Fn(&Shape) -> f64) -> f64 {
        let gradient = gradient(shape, f);
        let shared = self.with(&gradient, EXPONENT).powi(2) / self.covariance[(EXPONENT, EXPONENT)];
        (self.of(shape, f).powi(2) - shared).max(0.0).sqrt()
    }

    /// Covariance of a function and a number.
    fn with(&self, gradient: &[f64; NUMBERS], number: usize) -> f64 {
        (0..NUMBERS)
            .map(|b| gradient[b] * self.covariance[(number, b)])
            .sum()
    }
}

fn gradient(shape: &Shape, f: &dyn Fn(&Shape) -> f64) -> [f64; NUMBERS] {
    let at = shape.numbers();
    std::array::from_fn(|j| {
        let step = 1e-6;
        let side = |sign: f64| {
            let mut there = at;
            there[j] += sign * step;
            if j == NETWORK_SHARE || j == LAST_SHARE {
                there[j] = there[j].clamp(0.0, 1.0);
            }
            (f(&shape.with(&there)), there[j])
        };
        let ((above, up), (below, down)) = (side(1.0), side(-1.0));
        (above - below) / (up - down)
    })
}

/// Range of χ in a fit. Towards −1 the population is all at zero force and its stiffness without
/// bound: K_0 and χ then compensate each other.
pub const EXPONENT_RANGE: (f64, f64) = (-0.95, 3.0);
