//! χ and ϑ from the growth of the loss with load: log D over log F_0 (Eq. 47).

use super::level::{APART, Level};
use super::line::{line, slope_drift};
use crate::identify::interval::{Boundary, Estimated};

/// Which amplitude the loss is laid over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Force amplitude of the joint.
    Force,
    /// Displacement amplitude: at phase resonance the table's force is the exciter's, not the
    /// joint's; the joint's force follows the displacement.
    Displacement,
}

/// Slope of log D between two neighbouring levels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalSlope {
    /// Geometric mean of the two amplitudes.
    pub amplitude: f64,
    /// d log D / d log amplitude.
    pub slope: f64,
}

/// `D = ϑ F_0^(χ+3)` where the slope is constant.
#[derive(Debug, Clone, PartialEq)]
pub struct DissipationLaw {
    /// χ: the slope less three.
    pub exponent: Estimated,
    /// ϑ.
    pub coefficient: Estimated,
    /// What the amplitude is.
    pub over: Over,
    /// Smallest and largest amplitude used.
    pub range: (f64, f64),
    /// First level used and one past the last, of the levels with positive loss.
    pub used: (usize, usize),
    /// Slopes between neighbouring levels, over all levels.
    pub local_slopes: Vec<LocalSlope>,
    /// False where no three levels share a slope: the law is then a line through all of them, and
    /// nothing may be built on it.
    pub constant: bool,
    /// True where one slope serves all levels.
    pub single: bool,
}

/// Largest drift of the slope over a range that still counts as constant. Over a decade of force
/// the second-order terms of an exact power-law joint at a tenth of full slip reach this.
const STEADY_SLOPE: f64 = 0.05;
/// Drift that scatter may hide at most: beyond, levels that scatter so widely show no slope.
const MOST_DRIFT: f64 = 0.3;
/// The same for levels of one reading each, whose scatter is unknown.
const STEADY_SLOPE_OF_READINGS: f64 = 0.2;
/// Smallest ratio of the largest to the smallest amplitude that gives a slope.
const LEAST_SPAN: f64 = 1.25;
/// Smallest relative error of a loss: sampling of the loop.
const LEAST_ERROR: f64 = 1e-3;

/// The law over the longest range of levels with a constant slope, the lowest of equally long
/// ones; over all levels where there is no such range. `None` below two levels, or where they lie within a quarter of each other.
///
/// Checked in tests/identification.rs against planted exponents and the bolted beam's table.
pub fn dissipation_law(levels: &[Level], over: Over) -> Option<DissipationLaw> {
    let mut usable: Vec<(f64, &Level)> = levels
        .iter()
        .filter(|l| l.dissipation > 0.0)
        .filter_map(|l| Some((amplitude(l, over).filter(|a| *a > 0.0)?.ln(), l)))
        .collect();
    usable.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (x, usable): (Vec<f64>, Vec<&Level>) = usable.into_iter().unzip();
    let y: Vec<f64> = usable.iter().map(|l| l.dissipation.ln()).collect();
    let error: Vec<f64> = usable
        .iter()
        .map(|l| l.relative_error.unwrap_or(LEAST_ERROR).max(LEAST_ERROR))
        .collect();
    let readings = usable.iter().all(|l| l.relative_error.is_none());
    let weight: Vec<f64> = error.iter().map(|e| e.powi(-2)).collect();
    let count = usable.len();
    // Levels of one amplitude at two frequencies have no slope between them.
    let local_slopes: Vec<LocalSlope> = (1..count)
        .filter(|&i| x[i] - x[i - 1] > APART)
        .map(|i| LocalSlope {
            amplitude: (0.5 * (x[i] + x[i - 1])).exp(),
            slope: (y[i] - y[i - 1]) / (x[i] - x[i - 1]),
        })
        .collect();
    let constant = |from: usize, to: usize| {
        let allowed = if readings {
            STEADY_SLOPE_OF_READINGS
        } else {
            STEADY_SLOPE
        };
        drift(&x[from..to], &y[from..to], &weight[from..to]).abs()
            <= allowed + (2.0 * drift_error(&x[from..to], &error[from..to])).min(MOST_DRIFT)
    };
    let range = (3..=count)
        .rev()
        .flat_map(|length| (0..=count - length).map(move |from| (from, from + length)))
        .find(|&(from, to)| x[to - 1] - x[from] >= LEAST_SPAN.ln() && constant(from, to));
    let (from, to) = range.unwrap_or((0, count));
    if count < 2 || x[to - 1] - x[from] < LEAST_SPAN.ln() {
        return None;
    }
    let fit = line(&x[from..to], &y[from..to], &weight[from..to])?;
    let (exponent, coefficient) = estimates(&fit, over);
    Some(DissipationLaw {
        exponent,
        coefficient,
        over,
        range: (x[from].exp(), x[to - 1].exp()),
        used: (from, to),
        local_slopes,
        // Two levels have one slope and no way to contradict it.
        constant: range.is_some() || count == 2,
        single: count >= 3 && constant(0, count),
    })
}

fn estimates(fit: &super::line::Line, over: Over) -> (Estimated, Estimated) {
    let (low, high) = (-0.99, 4.0);
    let mut exponent =
        Estimated::symmetric("exponent", "χ", "1", fit.slope - 3.0, fit.slope_half_width);
    if exponent.value <= low {
        exponent.value = low;
        exponent.at_boundary = Some(Boundary::Lower);
    } else if exponent.value >= high {
        exponent.value = high;
        exponent.at_boundary = Some(Boundary::Upper);
    }
    let unit = match over {
        Over::Force => format!("J/N^{:.4}", fit.slope),
        Over::Displacement => format!("J/m^{:.4}", fit.slope),
    };
    let coefficient = Estimated::logarithmic(
        "dissipation_coefficient",
        "ϑ",
        unit,
        fit.intercept.exp(),
        fit.intercept_half_width,
    );
    (exponent, coefficient)
}

fn amplitude(level: &Level, over: Over) -> Option<f64> {
    match over {
        Over::Force => Some(level.force_amplitude),
        Over::Displacement => level.displacement_amplitude,
    }
}

/// Change of slope over the points.
fn drift(x: &[f64], y: &[f64], weight: &[f64]) -> f64 {
    // Two amplitudes, each at several frequencies, have one slope and no way to contradict it.
    let amplitudes = x.chunk_by(|a, b| b - a <= APART).count();
    if amplitudes < 3 {
        return 0.0;
    }
    match slope_drift(x, y, weight) {
        Some((drift, _)) => drift,
        // Three points: the difference of their two slopes.
        None if x.len() == 3 => (y[2] - y[1]) / (x[2] - x[1]) - (y[1] - y[0]) / (x[1] - x[0]),
        None => 0.0,
    }
}

/// Standard error of that change, from the errors of the losses: the difference of the slopes of
/// the two halves.
fn drift_error(x: &[f64], error: &[f64]) -> f64 {
    let range = x[x.len() - 1] - x[0];
    let mean_square = error.iter().map(|e| e * e).sum::<f64>() / error.len() as f64;
    // Slope of each half: rms error √2 over half the range; their difference once more √2; many
    // points average.
    4.0 * (mean_square * 3.0 / x.len() as f64).sqrt() / range
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(law: impl Fn(f64) -> f64, amplitudes: &[f64]) -> Vec<Level> {
        amplitudes
            .iter()
            .map(|&a| Level {
                force_amplitude: a,
                dissipation: law(a),
                relative_error: Some(1e-3),
                count: 4,
                ..Level::default()
            })
            .collect()
    }

    #[test]
    fn a_power_law_gives_back_its_exponent_and_coefficient() {
        let levels = table(|a| 3e-9 * a.powf(2.6), &[10.0, 20.0, 40.0, 80.0]);
        let law = dissipation_law(&levels, Over::Force).expect("four levels");
        assert!(law.single);
        assert!((law.exponent.value + 0.4).abs() < 1e-12);
        assert!((law.coefficient.value / 3e-9 - 1.0).abs() < 1e-11);
    }

    #[test]
    fn only_the_range_with_a_constant_slope_is_used() {
        let bent = |a: f64| a.powf(2.5) * (1.0 + (a / 60.0).powi(4));
        let levels = table(bent, &[2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0]);
        let law = dissipation_law(&levels, Over::Force).expect("levels");
        assert!(!law.single);
        assert_eq!(law.used.0, 0);
        assert!(law.range.1 < 40.0);
        assert!((law.exponent.value + 0.5).abs() < 0.03);
    }
}
