//! One axis: its range in a convenient unit, its ticks at round numbers, its title.

use crate::record::written::Scale;

/// Room left free at either end, as a share of the range.
const MARGIN: f64 = 0.04;

/// A linear or logarithmic axis; positions are in the shown unit, or its decadic logarithm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Axis {
    /// Title with unit, e.g. `force [kN]`.
    pub(super) title: String,
    /// Smallest position.
    pub(super) lower: f64,
    /// Largest position.
    pub(super) upper: f64,
    /// Positions of the ticks.
    pub(super) ticks: Vec<f64>,
    scale: Scale,
    decimals: usize,
    logarithmic: bool,
}

/// Decades from which a logarithmic axis has ticks at powers of ten alone.
const WIDE: f64 = 2.5;

/// Ticks of a logarithmic axis below which it has all that are round.
const FEWEST: usize = 3;

/// Share of the range that a tick of a logarithmic axis keeps from the last one, so that their labels
/// do not touch.
const CLOSEST: f64 = 0.08;

impl Axis {
    /// An axis over all finite `values` (SI) with about `count` ticks; `None` where there is none.
    pub(super) fn over(
        name: &str,
        unit: &str,
        values: impl Iterator<Item = f64>,
        count: usize,
    ) -> Option<Axis> {
        let (smallest, largest) = extent(values)?;
        let scale = Scale::of(smallest.abs().max(largest.abs()), unit);
        let (mut lower, mut upper) = (scale.shown(smallest), scale.shown(largest));
        if lower == upper {
            // A constant still gets a range, so that its level can be read.
            let half = if lower == 0.0 { 1.0 } else { 0.1 * lower.abs() };
            (lower, upper) = (lower - half, upper + half);
        }
        let room = MARGIN * (upper - lower);
        Some(Axis::linear(name, scale, lower - room, upper + room, count))
    }

    fn linear(name: &str, scale: Scale, lower: f64, upper: f64, count: usize) -> Axis {
        let (step, decimals) = round_step((upper - lower) / count.max(1) as f64);
        let first = (lower / step).ceil() as i64;
        let last = (upper / step).floor() as i64;
        Axis {
            title: titled(name, &scale.unit),
            lower,
            upper,
            ticks: (first..=last).map(|tick| tick as f64 * step).collect(),
            scale,
            decimals,
            logarithmic: false,
        }
    }

    /// Logarithmic where the values are positive and span more than a factor of 30, else linear
    /// from zero.
    pub(super) fn from_zero_or_logarithmic(
        name: &str,
        unit: &str,
        values: impl Iterator<Item = f64> + Clone,
        count: usize,
    ) -> Option<Axis> {
        let (smallest, largest) = extent(values.clone())?;
        if !(smallest > 0.0 && largest > 30.0 * smallest) {
            return Axis::over(name, unit, values.chain([0.0]), count);
        }
        Some(Axis::decades(name, unit, smallest, largest))
    }

    /// Logarithmic where the values are positive and span more than a factor of two, else linear.
    pub(super) fn logarithmic(
        name: &str,
        unit: &str,
        values: impl Iterator<Item = f64> + Clone,
        count: usize,
    ) -> Option<Axis> {
        let (smallest, largest) = extent(values.clone())?;
        if smallest > 0.0 && largest > 2.0 * smallest {
            return Some(Axis::decades(name, unit, smallest, largest));
        }
        Axis::over(name, unit, values, count)
    }

    fn decades(name: &str, unit: &str, smallest: f64, largest: f64) -> Axis {
        let scale = Scale::of(largest, unit);
        let (lower, upper) = (scale.shown(smallest).log10(), scale.shown(largest).log10());
        let room = MARGIN * (upper - lower);
        let decades = lower.floor() as i32..=upper.ceil() as i32;
        let wide = upper - lower >= WIDE;
        let (lower, upper) = (lower - room, upper + room);
        let within = |marks: &'static [f64]| -> Vec<f64> {
            let each = decades.clone().flat_map(|decade| {
                let of = move |mark: &f64| (mark * 10f64.powi(decade)).log10();
                marks.iter().map(of)
            });
            each.filter(|tick| (lower..=upper).contains(tick)).collect()
        };
        let sparse = within(if wide { &[1.0] } else { &[1.0, 2.0, 5.0] });
        let ticks = match sparse.len() < FEWEST {
            true => within(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]),
            false => sparse,
        };
        let apart = CLOSEST * (upper - lower);
        let ticks = ticks
            .into_iter()
            .fold(Vec::new(), |mut kept: Vec<f64>, tick| {
                if kept.last().is_none_or(|last| tick - last >= apart) {
                    kept.push(tick);
                }
                kept
            });
        Axis {
            title: titled(name, &scale.unit),
            lower,
            upper,
            ticks,
            scale,
            decimals: 0,
            logarithmic: true,
        }
    }

    /// The same axis with ticks at whole numbers only.
    pub(super) fn whole(mut self) -> Axis {
        self.ticks.retain(|tick| tick.fract() == 0.0);
        self.decimals = 0;
        self
    }

    /// Where an SI value lies.
    pub(super) fn place(&self, value: f64) -> f64 {
        let shown = self.scale.shown(value);
        if self.logarithmic {
            shown.log10()
        } else {
            shown
        }
    }

    /// What a tick is called.
    pub(super) fn label(&self, tick: f64) -> String {
        if self.logarithmic {
            // Rounded, for ten to the power of a logarithm is off by an ulp.
            let value = 10f64.powf(tick);
            let decimals = (-tick.floor()).max(0.0) as usize;
            return format!("{value:.decimals$}");
        }
        // No negative zero.
        let decimals = self.decimals;
        format!("{:.decimals$}", if tick == 0.0 { 0.0 } else { tick })
    }
}

fn titled(name: &str, unit: &str) -> String {
    if unit.is_empty() {
        name.to_owned()
    } else {
        format!("{name} [{unit}]")
    }
}

/// Smallest and largest finite value.
fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .filter(|value| value.is_finite())
        .fold(None, |range, value| {
            let (lower, upper) = range.unwrap_or((value, value));
            Some((value.min(lower), value.max(upper)))
        })
}

/// The next of 1, 2, 5, 10 … above `least`, and the decimals that write its multiples.
fn round_step(least: f64) -> (f64, usize) {
    let decade = 10f64.powf(least.log10().floor());
    let mantissa = least / decade;
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|round| *round >= mantissa * (1.0 - 1e-9))
        .unwrap_or(10.0)
        * decade;
    // The small addend keeps 0.1's logarithm of -1 from rounding to a second decimal.
    (step, (-(step.log10() + 1e-9).floor()).max(0.0) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_labelled_alike() {
        let Some(axis) = Axis::over("force", "N", [-4100.0, 4100.0].into_iter(), 6) else {
            unreachable!("two finite values")
        };
        assert_eq!(axis.title, "force [kN]");
        let labels: Vec<String> = axis.ticks.iter().map(|tick| axis.label(*tick)).collect();
        assert_eq!(labels, ["-4", "-2", "0", "2", "4"]);
        let Some(fine) = Axis::over("x", "m", [0.0, 1.1e-6].into_iter(), 5) else {
            unreachable!("two finite values")
        };
        let labels: Vec<String> = fine.ticks.iter().map(|tick| fine.label(*tick)).collect();
        assert_eq!(labels, ["0.0", "0.5", "1.0"]);
    }

    #[test]
    fn wide_positive_ranges_are_logarithmic() {
        let values = [2e-6, 3e-3];
        let Some(axis) = Axis::from_zero_or_logarithmic("e", "J", values.into_iter(), 5) else {
            unreachable!("two finite values")
        };
        let labels: Vec<String> = axis.ticks.iter().map(|tick| axis.label(*tick)).collect();
        assert_eq!(labels, ["0.01", "0.1", "1"]);
        assert!((axis.place(1e-3) - 0.0).abs() < 1e-12);
    }

    #[test]
    fn narrow_logarithmic_ranges_have_ticks_enough() {
        let values = [10.6, 39.8];
        let Some(axis) = Axis::logarithmic("f", "N", values.into_iter(), 5) else {
            unreachable!("two finite values")
        };
        let labels: Vec<String> = axis.ticks.iter().map(|tick| axis.label(*tick)).collect();
        assert_eq!(labels, ["20", "30", "40"]);
    }

    #[test]
    fn no_finite_value_no_axis() {
        assert_eq!(Axis::over("x", "m", [f64::NAN].into_iter(), 5), None);
    }
}
