//! The way down: several starts, the best of them to the end, and what is left open held in place.

use super::levenberg::{self, Free, minimise};
use super::shape::{EXPONENT, LAST_SHARE, NETWORK_SHARE, NUMBERS, Shape};
use super::target::Target;
use super::uncertainty::{EXPONENT_RANGE, SHARE_UNKNOWN, Uncertainty};
use crate::identify::interval::NORMAL_95;

/// A shape with the descent that led there.
#[derive(Debug, Clone, PartialEq)]
pub struct Best {
    /// Where it ended.
    pub shape: Shape,
    /// Residuals of the records there.
    pub residual: Vec<f64>,
    /// Iterations of all descents on the way.
    pub iterations: usize,
    /// False where the iterations ran out.
    pub converged: bool,
}

impl Best {
    fn misfit(&self) -> f64 {
        self.residual.iter().map(|r| r * r).sum()
    }

    /// rms residual, over that of the judged channel.
    pub fn rms(&self) -> f64 {
        (self.misfit() / self.residual.len().max(1) as f64).sqrt()
    }

    /// Variance of a residual and how correlation inflates it.
    fn noise(&self, target: &Target) -> (f64, f64) {
        let degrees = self.residual.len().saturating_sub(NUMBERS).max(1);
        let correlation = target.autoregression(&self.residual);
        (
            self.misfit() / degrees as f64,
            (1.0 + correlation) / (1.0 - correlation),
        )
    }

    /// Uncertainty of all five numbers here, held ones included.
    pub fn uncertainty(&self, target: &Target) -> Option<Uncertainty> {
        let residuals = |numbers: &[f64]| target.residuals(&self.shape.with(numbers));
        let free = free_numbers(&self.shape, &Pull::none(), 1.0);
        let jacobian = levenberg::jacobian(&free, &self.shape.numbers(), &residuals)?;
        let (variance, inflation) = self.noise(target);
        Uncertainty::new(&jacobian, variance, inflation)
    }
}

/// Starts that are followed, and the iterations that tell them apart.
const STARTS: usize = 5;
const FIRST: usize = 12;
/// Iterations of the best one.
const LAST: usize = 100;
/// Steps of the difference quotients for the last descents, over the usual ones. The residuals have
/// a corner wherever a sample reaches φ_max, and between corners a descent can be caught that
/// wider quotients, which look across them, are not.
const WIDENED: [f64; 3] = [30.0, 3.0, 1.0];

/// The least misfit over all five numbers.
pub fn global(target: &Target, starts: &[Shape]) -> Option<Best> {
    let first = different(starts)
        .iter()
        .filter_map(|start| descend(target, start, &Pull::none(), FIRST, 1.0))
        .min_by(|a, b| a.misfit().total_cmp(&b.misfit()))?;
    let mut best = descend(target, &first.shape, &Pull::none(), LAST, 1.0)?;
    best.iterations += first.iterations;
    Some(polished(target, best, &Pull::none()))
}

/// The least misfit with what the data leave open pulled to the middle of its range, and β held at
/// zero where they say nothing of it.
pub fn settled(target: &Target, free: &Best, known: &Uncertainty) -> Best {
    let (variance, inflation) = free.noise(target);
    let held = known.ignores_share(LAST_SHARE).then_some(0.0);
    let pull = Pull {
        strength: (variance * inflation).sqrt() / SHARE_UNKNOWN,
        last_share: held,
        exponent: None,
    };
    let mut start = free.shape;
    start.last_share = held.unwrap_or(start.last_share);
    if known.ignores_share(NETWORK_SHARE) {
        start.network_share = 0.5;
    }
    match descend(target, &start, &pull, LAST, 1.0) {
        Some(best) => polished(target, best, &pull),
        None => free.clone(),
    }
}

/// The best joints with χ at either end of its 95 % interval: the curved valley along which the other
/// numbers follow χ. `None` where χ is so well known that the valley is straight.
pub fn along_exponent(target: &Target, best: &Best, known: &Uncertainty) -> Option<[Shape; 2]> {
    let width = NORMAL_95 * known.deviation(EXPONENT);
    if width < STRAIGHT {
        return None;
    }
    let (variance, inflation) = best.noise(target);
    let end = |sign: f64| {
        let exponent =
            (best.shape.exponent + sign * width).clamp(EXPONENT_RANGE.0, EXPONENT_RANGE.1);
        let pull = Pull {
            strength: (variance * inflation).sqrt() / SHARE_UNKNOWN,
            last_share: (best.shape.last_share == 0.0).then_some(0.0),
            exponent: Some(exponent),
        };
        let start = Shape {
            exponent,
            ..best.shape
        };
        descend(target, &start, &pull, LAST, 1.0).map(|found| found.shape)
    };
    Some([end(-1.0)?, end(1.0)?])
}

/// Half-width of χ below which first order is enough for all that depends on it.
const STRAIGHT: f64 = 0.02;

/// What is known of the two shares without data, and what is held.
struct Pull {
    /// Residual per unit of a share's distance from the middle; zero pulls nothing.
    strength: f64,
    /// Value at which σ is held.
    last_share: Option<f64>,
    /// Value at which χ is held.
    exponent: Option<f64>,
}

impl Pull {
    fn none() -> Pull {
        Pull {
            strength: 0.0,
            last_share: None,
            exponent: None,
        }
    }

    /// Residuals beside those of the records.
    fn residuals(&self, numbers: &[f64]) -> [f64; 2] {
        let pull = |number: usize| self.strength * (numbers[number] - 0.5);
        let last = if self.last_share.is_some() {
            0.0
        } else {
            pull(LAST_SHARE)
        };
        [pull(NETWORK_SHARE), last]
    }
}

fn polished(target: &Target, mut best: Best, pull: &Pull) -> Best {
    for widened in WIDENED {
        if let Some(mut next) = descend(target, &best.shape, pull, LAST, widened) {
            next.iterations += best.iterations;
            if next.misfit() < best.misfit() {
                best = next;
            }
        }
    }
    best
}

fn descend(
    target: &Target,
    start: &Shape,
    pull: &Pull,
    most_iterations: usize,
    widened: f64,
) -> Option<Best> {
    let free = free_numbers(start, pull, widened);
    let residuals = |numbers: &[f64]| {
        let mut all = target.residuals(&start.with(numbers))?;
        all.extend(pull.residuals(numbers));
        Some(all)
    };
    let mut minimum = minimise(&free, most_iterations, &residuals)?;
    let records = minimum.residual.len() - pull.residuals(&minimum.at).len();
    minimum.residual.truncate(records);
    Some(Best {
        shape: start.with(&minimum.at),
        residual: minimum.residual,
        iterations: minimum.iterations,
        converged: minimum.converged,
    })
}

fn free_numbers(start: &Shape, pull: &Pull, widened: f64) -> Vec<Free> {
    let at = start.numbers();
    let free = |start: f64, lower: f64, upper: f64, step: f64| Free {
        start,
        lower,
        upper,
        step: step * widened,
    };
    let range = |held: Option<f64>, free: (f64, f64)| held.map_or(free, |value| (value, value));
    let exponents = range(pull.exponent, EXPONENT_RANGE);
    let (lowest, highest) = range(pull.last_share, (0.0, 0.999));
    vec![
        free(at[0], at[0] - 12.0, at[0] + 12.0, 1e-5),
        free(at[1], at[1] - 40.0, at[1] + 40.0, 1e-5),
        free(at[2], exponents.0, exponents.1, 1e-4),
        free(at[NETWORK_SHARE], 1e-3, 1.0, 1e-4),
        free(at[LAST_SHARE], lowest, highest, 1e-4),
    ]
}

/// A few starts that are not neighbours of a better one.
fn different(starts: &[Shape]) -> Vec<Shape> {
    let mut kept: Vec<Shape> = Vec::new();
    for start in starts {
        let near = |k: &Shape| {
            (k.exponent - start.exponent).abs() < 0.2
                && (k.last_share - start.last_share).abs() < 0.2
                && (k.series_stiffness / start.series_stiffness).ln().abs() < 0.7
        };
        if !kept.iter().any(near) {
            kept.push(*start);
        }
        if kept.len() == STARTS {
            break;
        }
    }
    kept
}
