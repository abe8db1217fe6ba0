//! Series stiffness K_1 K_T / (K_1 + K_T): the secant compliance, extrapolated to no load.

use super::level::Level;
use super::line::line;
use super::monotonic::Monotonic;
use crate::identify::interval::Estimated;

/// The secant compliance of the levels against the load.
#[derive(Debug, Clone, PartialEq)]
pub struct Stiffness {
    /// K_0 = K_1 K_T / (K_1 + K_T) \[N/m\].
    pub series: Estimated,
    /// Largest over initial secant compliance: how deep the record slips.
    pub reach: f64,
}

/// `U_0/F_0 = 1/K_0 + B F_0^(χ+1)`, from the virgin curve `H(F) + F/K_1` at small force: a straight
/// line over `F_0^(χ+1)` through the first `used` levels. One level gives its own secant, without
/// interval.
pub fn series_stiffness(levels: &[Level], exponent: f64, used: usize) -> Option<Stiffness> {
    let with_displacement: Vec<(f64, f64)> = levels
        .iter()
        .filter_map(|l| Some((l.force_amplitude, l.displacement_amplitude?)))
        .filter(|&(force, displacement)| force > 0.0 && displacement > 0.0)
        .collect();
    let used = used.clamp(1, with_displacement.len().max(1));
    let first = with_displacement.get(..used)?;
    let x: Vec<f64> = first.iter().map(|(f, _)| f.powf(exponent + 1.0)).collect();
    let y: Vec<f64> = first.iter().map(|(f, u)| u / f).collect();
    let (compliance, half_width) = match line(&x, &y, &vec![1.0; x.len()]) {
        // A compliance that is not positive is noise: the smallest secant is better.
        Some(fit) if fit.intercept > 0.0 => (fit.intercept, fit.intercept_half_width),
        _ => (
            y.iter().copied().fold(f64::INFINITY, f64::min),
            f64::INFINITY,
        ),
    };
    let largest = with_displacement
        .iter()
        .map(|(f, u)| u / f)
        .fold(0.0, f64::max);
    Some(Stiffness {
        series: Estimated::logarithmic(
            "joint_stiffness",
            "K_1 K_T/(K_1+K_T)",
            "N/m",
            1.0 / compliance,
            half_width / compliance,
        ),
        reach: largest / compliance,
    })
}

/// From the first piece of a monotonic curve, where there are no levels to extrapolate: a secant of
/// some width, so a lower bound, and without interval.
pub fn of_curve(curve: &Monotonic) -> Stiffness {
    let first = curve.force[1] / curve.displacement[1];
    let last = curve.force.len() - 1;
    Stiffness {
        series: Estimated::logarithmic(
            "joint_stiffness",
            "K_1 K_T/(K_1+K_T)",
            "N/m",
            first,
            f64::INFINITY,
        ),
        reach: first * curve.displacement[last] / curve.force[last],
    }
}
