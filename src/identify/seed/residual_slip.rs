//! Residual slip: predicted by the cyclic losses with no free parameter, and as measured.

use super::dissipation::DissipationLaw;
use super::level::Level;
use crate::identify::interval::NORMAL_95;

/// Measured over predicted residual slip.
#[derive(Debug, Clone, PartialEq)]
pub struct ResidualSlip {
    /// Largest force amplitude compared \[N\].
    pub force_amplitude: f64,
    /// Predicted there \[m\].
    pub predicted: f64,
    /// Measured there \[m\].
    pub measured: f64,
    /// Weighted mean of measured/predicted over the levels.
    pub ratio: f64,
    /// Half-width of its interval, the exponent's included.
    pub half_width: f64,
    /// True where the ratio is 1 within that and [`MARGIN`].
    pub agrees: bool,
}

/// What second-order terms and the sampling of a loop may do to the ratio.
const MARGIN: f64 = 0.05;

/// `u_R = ϑ (χ+3)/(4(χ+1)) (1 − 2^−(χ+1)) F_M^(χ+2)` (Eq. 49 = A7 mended), with ϑ F^(χ+3) taken as
/// the loss measured at the same level.
pub fn residual_slip(levels: &[Level], law: &DissipationLaw) -> Option<ResidualSlip> {
    let share = |chi: f64| (chi + 3.0) / (4.0 * (chi + 1.0)) * (1.0 - (-(chi + 1.0)).exp2());
    let chi = law.exponent.value;
    let compared: Vec<(f64, f64, f64, f64)> = levels
        .iter()
        .filter(|l| (law.range.0 * 0.999..=law.range.1 * 1.001).contains(&l.force_amplitude))
        .filter_map(|l| {
            let (measured, error) = l.residual_slip?;
            let predicted = share(chi) * l.dissipation / l.force_amplitude;
            let relative = (error / predicted)
                .hypot(l.relative_error.unwrap_or(0.0))
                .max(1e-3);
            Some((l.force_amplitude, predicted, measured, relative))
        })
        .collect();
    let total: f64 = compared.iter().map(|c| c.3.powi(-2)).sum();
    let last = compared.last()?;
    let ratio = compared
        .iter()
        .map(|c| c.2 / c.1 * c.3.powi(-2))
        .sum::<f64>()
        / total;
    let of_exponent = law.exponent.half_width().map_or(0.0, |width| {
        ((share(chi + 1e-4) / share(chi)).ln() / 1e-4 * width).abs()
    });
    let half_width = (NORMAL_95 / total.sqrt()).hypot(of_exponent);
    Some(ResidualSlip {
        force_amplitude: last.0,
        predicted: last.1,
        measured: last.2,
        ratio,
        half_width,
        agrees: (ratio - 1.0).abs() <= half_width + MARGIN,
    })
}
