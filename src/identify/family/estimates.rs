//! The fitted joint's numbers with their intervals.

use super::shape::{EXPONENT, Shape};
use super::told::Told;
use super::uncertainty::{EXPONENT_RANGE, Uncertainty};
use crate::identify::interval::{Boundary, Estimated, NORMAL_95};

/// A shape with what is known of it.
pub struct Known<'a> {
    /// Where the fit ended.
    pub shape: &'a Shape,
    /// To first order.
    pub uncertainty: &'a Uncertainty,
    /// The best joints at the ends of χ's interval, where the valley is curved.
    pub along_exponent: Option<[Shape; 2]>,
    /// Which numbers the records tell.
    pub told: Told,
}

impl Known<'_> {
    /// All numbers; what was not told has no interval.
    ///
    /// K_0 and ϑ depend strongly and not linearly on χ: their intervals take the way along the
    /// valley to either end of χ's interval, and what remains beside it to first order.
    pub fn estimates(&self) -> Vec<Estimated> {
        let shape = self.shape;
        let mut exponent = Estimated::symmetric(
            "exponent",
            "χ",
            "1",
            shape.exponent,
            NORMAL_95 * self.uncertainty.deviation(EXPONENT),
        );
        if shape.exponent <= EXPONENT_RANGE.0 {
            exponent.at_boundary = Some(Boundary::Lower);
        } else if shape.exponent >= EXPONENT_RANGE.1 {
            exponent.at_boundary = Some(Boundary::Upper);
        }
        let Told {
            split, slip_force, ..
        } = self.told;
        let loss_unit = format!("J/N^{:.4}", shape.exponent + 3.0);
        let mut spring = self.positive("series_stiffness", "K_1", "N/m", &Shape::spring, split);
        if shape.network_share >= 1.0 {
            spring.at_boundary = Some(Boundary::Upper);
            spring.interval = None;
        }
        vec![
            self.positive(
                "joint_stiffness",
                "K_1 K_T/(K_1+K_T)",
                "N/m",
                &|s: &Shape| s.series_stiffness,
                true,
            ),
            self.positive(
                "dissipation_coefficient",
                "ϑ",
                &loss_unit,
                &|s: &Shape| s.log_coefficient().exp(),
                true,
            ),
            exponent,
            self.positive("stiffness", "K_T", "N/m", &Shape::network_stiffness, split),
            spring,
            self.positive("slip_force", "F_S", "N", &Shape::slip_force, slip_force),
            self.ratio(),
        ]
    }

    fn positive(
        &self,
        name: &'static str,
        symbol: &'static str,
        unit: &str,
        value: &dyn Fn(&Shape) -> f64,
        told: bool,
    ) -> Estimated {
        let log = |s: &Shape| value(s).ln();
        let best = log(self.shape);
        let (below, above) = match &self.along_exponent {
            Some(ends) => {
                let ways = ends.map(|end| log(&end) - best);
                let beside = NORMAL_95 * self.uncertainty.beside_exponent(self.shape, &log);
                let lowest = ways.iter().copied().fold(0.0, f64::min);
                let highest = ways.iter().copied().fold(0.0, f64::max);
                (lowest.hypot(beside), highest.hypot(beside))
            }
            None => {
                let half = NORMAL_95 * self.uncertainty.of(self.shape, &log);
                (half, half)
            }
        };
        // Beyond e^20 either way nothing is known of the number.
        let bounded = told && best.is_finite() && below < 20.0 && above < 20.0;
        Estimated {
            name,
            symbol,
            unit: unit.into(),
            value: best.exp(),
            interval: bounded.then(|| ((best - below).exp(), (best + above).exp())),
            at_boundary: None,
        }
    }

    fn ratio(&self) -> Estimated {
        let half_width = if self.told.ratio {
            NORMAL_95 * self.uncertainty.of(self.shape, &Shape::ratio)
        } else {
            f64::INFINITY
        };
        let mut ratio = Estimated::symmetric("ratio", "β", "1", self.shape.ratio(), half_width);
        if self.shape.last_share <= 0.0 {
            ratio.at_boundary = Some(Boundary::Lower);
        }
        ratio
    }
}
