//! Intervals: Student's factor, and a number with what the data say about it.

use crate::joint::parameters::Parameter;

/// Factor of the two-sided 95 % interval of a normal variable.
pub const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Factor of the two-sided 95 % interval for so many degrees of freedom.
///
/// Closed forms for one and two degrees, the Cornish–Fisher series (Abramowitz & Stegun 26.7.5)
/// from three on, right to 0.2 %. Infinite for none: no scatter, no interval.
pub fn student_95(degrees_of_freedom: usize) -> f64 {
    let z = NORMAL_95;
    let n = degrees_of_freedom as f64;
    match degrees_of_freedom {
        0 => f64::INFINITY,
        1 => 12.706_204_736_432_1,
        2 => 4.302_652_729_696_14,
        _ => {
            z + (z.powi(3) + z) / (4.0 * n)
                + (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / (96.0 * n.powi(2))
                + (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z)
                    / (384.0 * n.powi(3))
                + (79.0 * z.powi(9) + 776.0 * z.powi(7) + 1482.0 * z.powi(5)
                    - 1920.0 * z.powi(3)
                    - 945.0 * z)
                    / (92160.0 * n.powi(4))
        }
    }
}

/// An edge of the admissible range on which an estimate lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Boundary {
    /// At the smallest admissible value.
    Lower,
    /// At the largest admissible value.
    Upper,
}

/// One estimated quantity, SI, with its 95 % interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimated {
    /// Glossary name, e.g. `dissipation_coefficient`.
    pub name: &'static str,
    /// Symbol, e.g. `ϑ`.
    pub symbol: &'static str,
    /// SI unit.
    pub unit: String,
    /// Best value.
    pub value: f64,
    /// 95 % interval; `None` where the data do not bound it.
    pub interval: Option<(f64, f64)>,
    /// Set where the estimate lies on an edge of its range.
    pub at_boundary: Option<Boundary>,
}

impl Estimated {
    /// A value with a symmetric interval `value ± half_width`; a half-width that is no finite
    /// number gives no interval.
    pub fn symmetric(
        name: &'static str,
        symbol: &'static str,
        unit: impl Into<String>,
        value: f64,
        half_width: f64,
    ) -> Estimated {
        Estimated {
            name,
            symbol,
            unit: unit.into(),
            value,
            interval: half_width
                .is_finite()
                .then_some((value - half_width, value + half_width)),
            at_boundary: None,
        }
    }

    /// A positive value with an interval symmetric in its logarithm:
    /// `value · exp(± half_width)`.
    pub fn logarithmic(
        name: &'static str,
        symbol: &'static str,
        unit: impl Into<String>,
        value: f64,
        half_width: f64,
    ) -> Estimated {
        Estimated {
            name,
            symbol,
            unit: unit.into(),
            value,
            // Beyond e^20 either way nothing is known of the number.
            interval: (half_width < 20.0)
                .then(|| (value * (-half_width).exp(), value * half_width.exp())),
            at_boundary: None,
        }
    }

    /// The interval cut to what a glossary admits of the number of that name; a value that it does not admit keeps its
    /// interval as it is.
    pub fn within(mut self, glossary: &[Parameter]) -> Estimated {
        let own = glossary.iter().find(|p| p.name == self.name);
        let admits = |p: &&Parameter| (p.lower..=p.upper).contains(&self.value);
        if let (Some(p), Some((lower, upper))) = (own.filter(admits), self.interval) {
            self.interval = Some((lower.max(p.lower), upper.min(p.upper)));
        }
        self
    }

    /// Half the width of the interval.
    pub fn half_width(&self) -> Option<f64> {
        self.interval.map(|(lower, upper)| 0.5 * (upper - lower))
    }

    /// True where the interval holds `value`.
    pub fn admits(&self, value: f64) -> bool {
        self.interval
            .is_some_and(|(lower, upper)| lower <= value && value <= upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint::FourParameter;

    #[test]
    fn student_factors_are_those_of_the_tables() {
        // Abramowitz & Stegun, table 26.10; the series is right to 0.2 % at three degrees.
        for (degrees, tabulated) in [(1, 12.706), (2, 4.303), (3, 3.182), (5, 2.571), (30, 2.042)] {
            assert!(
                (student_95(degrees) / tabulated - 1.0).abs() < 2e-3,
                "{degrees}"
            );
        }
        assert!((student_95(1_000_000) - NORMAL_95).abs() < 1e-5);
    }

    #[test]
    fn an_interval_ends_where_the_glossary_does() {
        let exponent = |value: f64| Estimated::symmetric("exponent", "χ", "1", value, 0.5);
        let cut = |value: f64| exponent(value).within(FourParameter::PARAMETERS).interval;
        assert_eq!(cut(-0.5), Some((-0.999, 0.0)));
        assert_eq!(cut(0.0), Some((-0.5, 0.5)));
        assert_eq!(cut(-1.5), Some((-2.0, -1.0)));
        let other = exponent(-0.9).within(&[]);
        assert_eq!(other, exponent(-0.9));
    }
}
