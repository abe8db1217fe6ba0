//! Harmonics of the residual within the force's cycles: even ones come from asymmetry only.

use super::Residual;
use crate::record::cycles::{Cycle, cycles};
use std::f64::consts::TAU;

/// One harmonic, averaged over the cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Multiple of the fundamental.
    pub order: usize,
    /// Part in phase with the force (its n-th multiple), a cosine from the force's peak.
    pub in_phase: f64,
    /// Part in quadrature.
    pub quadrature: f64,
    /// Standard error of either part from the scatter of the cycles; infinite for one cycle.
    pub standard_error: f64,
    /// Count of cycles.
    pub cycles: usize,
}

impl Harmonic {
    /// Amplitude.
    pub fn amplitude(&self) -> f64 {
        self.in_phase.hypot(self.quadrature)
    }
}

/// Harmonics 1 … `highest` over the settled cycles of the force, or over all cycles where none is
/// settled; empty without cycles. Phases count from the fundamental of the force in each cycle.
pub fn harmonics(residual: &Residual, highest: usize) -> Vec<Harmonic> {
    let all = cycles(&residual.record.force);
    let settled: Vec<Cycle> = all.iter().copied().filter(|c| c.steady).collect();
    let used = if settled.is_empty() { all } else { settled };
    if used.is_empty() {
        return Vec::new();
    }
    (1..=highest)
        .map(|order| {
            let parts: Vec<(f64, f64)> = used
                .iter()
                .map(|cycle| part(residual, cycle, order))
                .collect();
            let count = parts.len() as f64;
            let (a, b) = parts.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
            let (a, b) = (a / count, b / count);
            let squares: f64 = parts
                .iter()
                .map(|p| (p.0 - a).powi(2) + (p.1 - b).powi(2))
                .sum();
            Harmonic {
                order,
                in_phase: a,
                quadrature: b,
                standard_error: if parts.len() > 1 {
                    (squares / 2.0 / (count - 1.0) / count).sqrt()
                } else {
                    f64::INFINITY
                },
                cycles: parts.len(),
            }
        })
        .collect()
}

/// Share of the even harmonics in the sum of squares of all of them.
pub fn even_share(harmonics: &[Harmonic]) -> f64 {
    let square = |h: &Harmonic| h.amplitude().powi(2);
    let all: f64 = harmonics.iter().map(square).sum();
    let even: f64 = harmonics
        .iter()
        .filter(|h| h.order % 2 == 0)
        .map(square)
        .sum();
    if all > 0.0 { even / all } else { 0.0 }
}

/// Fourier parts of one cycle against the force's phase.
fn part(residual: &Residual, cycle: &Cycle, order: usize) -> (f64, f64) {
    let own = cycle.start..cycle.end;
    let (fc, fs) = fourier(&residual.record.force[own.clone()], 1);
    let peak = fs.atan2(fc);
    let (a, b) = fourier(&residual.values[own], order);
    let turn = peak * order as f64;
    (
        a * turn.cos() + b * turn.sin(),
        b * turn.cos() - a * turn.sin(),
    )
}

/// Cosine and sine coefficient of one period.
fn fourier(values: &[f64], order: usize) -> (f64, f64) {
    let count = values.len() as f64;
    let (mut cosine, mut sine) = (0.0, 0.0);
    for (i, v) in values.iter().enumerate() {
        let angle = TAU * order as f64 * i as f64 / count;
        cosine += v * angle.cos();
        sine += v * angle.sin();
    }
    (2.0 * cosine / count, 2.0 * sine / count)
}
