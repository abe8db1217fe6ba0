//! Estimates as an engineer writes them: as many digits as are known.

use crate::diagnose::findings::Estimate;
use crate::record::written::{Scale, number, percent, quantity};

/// An estimate as it is shown, in pieces.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shown {
    /// Value with unit.
    pub(super) value: String,
    /// Error with unit and percent, e.g. `± 0.18 kN (4.4 %)`.
    pub(super) error: String,
    /// Interval with unit, e.g. `3.94 … 4.30 kN`; empty where the data do not bound the value.
    pub(super) interval: String,
}

/// Value, error and interval in one unit; the value carries the digits its error leaves it.
pub(super) fn estimate(estimate: &Estimate) -> Shown {
    let value = estimate.value;
    let Some((lower, upper)) = estimate.interval else {
        return Shown {
            value: quantity(value, &estimate.unit),
            error: "not bounded by the data".to_owned(),
            interval: String::new(),
        };
    };
    let bounds = [lower, upper].into_iter().filter(|bound| bound.is_finite());
    let known = if value.is_finite() && value != 0.0 {
        value
    } else {
        bounds.fold(0.0, |largest: f64, bound| largest.max(bound.abs()))
    };
    let scale = Scale::of(known, &estimate.unit);
    let (below, above) = (value - lower, upper - value);
    let spread = below.min(above);
    if !(spread >= 0.0 && below.max(above) > 0.0 && (upper - lower).is_finite()) {
        let interval = [lower, upper].map(|bound| number(scale.shown(bound), 3));
        let error = match (value == lower, value == upper) {
            (true, false) if upper.is_infinite() => "or more",
            (false, true) if lower.is_infinite() => "or less",
            _ => "see the interval",
        };
        return Shown {
            value: quantity(value, &estimate.unit),
            error: error.to_owned(),
            interval: scale.attach(&interval.join(" … ")),
        };
    }
    let half = 0.5 * (upper - lower);
    let reference = if spread > 0.0 { spread } else { half };
    let write = Digits::for_error(scale.shown(reference), scale.shown(known));
    let margin = if below.max(above) > 1.25 * spread {
        format!(
            "+{} / -{}",
            write.number(scale.shown(above)),
            write.number(scale.shown(below))
        )
    } else {
        format!("± {}", write.number(scale.shown(half)))
    };
    let relative = if value == 0.0 {
        String::new()
    } else {
        format!(" ({})", percent(half / value.abs()))
    };
    let interval = [lower, upper].map(|bound| write.number(scale.shown(bound)));
    Shown {
        value: scale.attach(&write.number(scale.shown(value))),
        error: format!("{}{relative}", scale.attach(&margin)),
        interval: scale.attach(&interval.join(" … ")),
    }
}

/// How many digits are written after the point, or that powers of ten are needed.
enum Digits {
    Decimals(usize),
    Significant,
}

impl Digits {
    /// Two digits of the error, never more than six of the value.
    fn for_error(error: f64, value: f64) -> Digits {
        let of_error = 1 - error.abs().log10().floor() as i32;
        let of_value = 5 - value.abs().log10().floor() as i32;
        match of_error.min(of_value) {
            decimals @ 0..=6 => Digits::Decimals(decimals as usize),
            decimals if decimals < 0 && value.abs() < 1e6 => Digits::Decimals(0),
            _ => Digits::Significant,
        }
    }

    fn number(&self, value: f64) -> String {
        match self {
            Digits::Decimals(decimals) => format!("{value:.decimals$}"),
            Digits::Significant => number(value, 3),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn estimated(value: f64, unit: &str, interval: Option<(f64, f64)>) -> Shown {
        estimate(&Estimate {
            name: "x".to_owned(),
            value,
            unit: unit.to_owned(),
            interval,
        })
    }

    #[test]
    fn digits_follow_the_error() {
        let shown = estimated(4123.4, "N", Some((3940.0, 4300.0)));
        assert_eq!(shown.value, "4.12 kN");
        assert_eq!(shown.error, "± 0.18 kN (4.4 %)");
        assert_eq!(shown.interval, "3.94 … 4.30 kN");
        let skew = estimated(1e-5, "m", Some((0.9e-5, 1.4e-5)));
        assert_eq!(skew.error, "+4.0 / -1.0 µm (25 %)");
    }

    #[test]
    fn missing_and_broken_intervals() {
        assert_eq!(estimated(1.0, "m", None).error, "not bounded by the data");
        let open = estimated(1.0, "N", Some((0.5, f64::INFINITY)));
        assert_eq!(
            (open.value.as_str(), open.interval.as_str()),
            ("1.00 N", "0.500 … ∞ N")
        );
        let bound = estimated(3200.0, "N", Some((3200.0, f64::INFINITY)));
        assert_eq!(
            (bound.value.as_str(), bound.error.as_str()),
            ("3.20 kN", "or more")
        );
        let nan = estimated(f64::NAN, "N", Some((1.0, 2.0)));
        assert_eq!(nan.value, "not determined");
        assert_eq!(open.error, "see the interval");
        let point = estimated(2.0, "N", Some((2.0, 2.0)));
        assert_eq!(point.value, "2.00 N");
        let about_zero = estimated(0.0, "N", Some((-1.0, 1.0)));
        assert_eq!(about_zero.error, "± 1.0 N");
    }
}
