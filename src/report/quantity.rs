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

/// Shares below this, and beyond this many times the whole, say nothing by their digits.
const LEAST_SHARE: f64 = 1e-4;
const MOST_SHARE: f64 = 10.0;

/// A share as percent: `7.1 %`, `< 0.01 %`, `> 1000 %`.
pub(super) fn share(value: f64) -> String {
    match value.abs() {
        size if size > 0.0 && size < LEAST_SHARE => "< 0.01 %".to_owned(),
        size if size > MOST_SHARE && size.is_finite() => "> 1000 %".to_owned(),
        _ => percent(value),
    }
}

/// A χ²: below a hundredth there is none.
pub(super) fn chi_squared(value: f64) -> String {
    match value {
        value if value > 0.0 && value < 0.01 => "< 0.01".to_owned(),
        value => number(value, 3),
    }
}

/// Value, error and interval in one unit; the value carries the digits its error leaves it. A value that
/// its error exceeds is none: only its bounds are said.
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
        return open(estimate, (lower, upper), &scale);
    }
    let half = 0.5 * (upper - lower);
    if value != 0.0 && half > value.abs() {
        let [from, to] = [lower, upper].map(|bound| rounded(bound, &estimate.unit));
        // The unit stands once where both bounds have it.
        let from = match from.1 == to.1 {
            true => from.0,
            false => Scale::of(lower, &estimate.unit).attach(&from.0),
        };
        let to = Scale::of(upper, &estimate.unit).attach(&to.0);
        return Shown {
            value: "undetermined".to_owned(),
            error: format!("between {from} and {to}"),
            interval: format!("{from} … {to}"),
        };
    }
    let reference = if spread > 0.0 { spread } else { half };
    let write = Digits::for_error(scale.shown(reference), scale.shown(known));
    let apart = scale.shown((above - below).abs());
    let margin = if below.max(above) > 1.25 * spread || apart > 2.001 * write.last() {
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

/// An estimate with a bound on one side only, or with none that holds its value.
fn open(estimate: &Estimate, (lower, upper): (f64, f64), scale: &Scale) -> Shown {
    let value = quantity(estimate.value, &estimate.unit);
    let interval = [lower, upper].map(|bound| number(scale.shown(bound), 3));
    let (below, above) = (lower.is_finite(), upper.is_finite());
    let (value, error) = match (below, above) {
        // A bound alone is no value: its sign goes with it wherever it is written.
        (true, false) if estimate.value == lower => {
            (format!("> {value}"), "not bounded from above".to_owned())
        }
        (false, true) if estimate.value == upper => {
            (format!("< {value}"), "not bounded from below".to_owned())
        }
        (true, false) => (
            value,
            format!("at least {}", quantity(lower, &estimate.unit)),
        ),
        (false, true) => (
            value,
            format!("at most {}", quantity(upper, &estimate.unit)),
        ),
        (true, true) => {
            let [from, to] = &interval;
            (
                value,
                format!("between {}", scale.attach(&format!("{from} and {to}"))),
            )
        }
        (false, false) => (value, "not bounded by the data".to_owned()),
    };
    Shown {
        value,
        error,
        interval: scale.attach(&interval.join(" … ")),
    }
}

/// Two digits of a bound, and the unit that they are in.
fn rounded(bound: f64, unit: &str) -> (String, String) {
    let scale = Scale::of(bound, unit);
    let shown = scale.shown(bound);
    let write = Digits::Last(1 - decade(shown));
    let written = match shown.abs() >= 1e4 || (shown != 0.0 && shown.abs() < 1e-3) {
        true => number(shown, 2),
        false => write.number(shown),
    };
    (written, scale.unit)
}

/// Power of ten of the first digit.
fn decade(value: f64) -> i32 {
    match value.abs() {
        size if size > 0.0 && size.is_finite() => size.log10().floor() as i32,
        _ => 0,
    }
}

/// Where the last digit stands, or that powers of ten are needed.
enum Digits {
    /// Digits after the point; below zero the tens, the hundreds and so on are the last.
    Last(i32),
    Significant,
}

impl Digits {
    /// Two digits of the error, never more than six of the value.
    fn for_error(error: f64, value: f64) -> Digits {
        let decimals = (1 - decade(error)).min(5 - decade(value));
        match decimals {
            0..=6 => Digits::Last(decimals),
            _ if decimals < 0 && value.abs() < 1e5 => Digits::Last(decimals),
            _ => Digits::Significant,
        }
    }

    /// One of the last digit; nothing where there is no such place.
    fn last(&self) -> f64 {
        match self {
            Digits::Last(decimals) => 10f64.powi(-decimals),
            Digits::Significant => f64::INFINITY,
        }
    }

    fn number(&self, value: f64) -> String {
        match self {
            Digits::Last(decimals) if *decimals >= 0 => {
                let decimals = *decimals as usize;
                format!("{value:.decimals$}")
            }
            Digits::Last(_) => format!("{:.0}", (value / self.last()).round() * self.last()),
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
            ("> 3.20 kN", "not bounded from above")
        );
        let nan = estimated(f64::NAN, "N", Some((1.0, 2.0)));
        assert_eq!(nan.value, "not determined");
        assert_eq!(open.error, "at least 500 mN");
        let outside = estimated(9.16e-6, "m", Some((1e-5, 1.2e-5)));
        assert_eq!(outside.error, "between 10.0 and 12.0 µm");
        let point = estimated(2.0, "N", Some((2.0, 2.0)));
        assert_eq!(point.value, "2.00 N");
        let about_zero = estimated(0.0, "N", Some((-1.0, 1.0)));
        assert_eq!(about_zero.error, "± 1.0 N");
    }

    #[test]
    fn a_value_that_its_error_exceeds_is_none() {
        let shown = estimated(58_941.0, "1/m2", Some((-2_643_830.0, 4_231_028.0)));
        assert_eq!(shown.value, "undetermined");
        assert_eq!(shown.error, "between -2.6·10⁶ and 4.2·10⁶ 1/m²");
        let shown = estimated(0.01, "1", Some((-0.61, 0.63)));
        assert_eq!(shown.error, "between -0.61 and 0.63");
        let wide = estimated(1.3e6, "N/m", Some((1e5, 5.9e9)));
        assert_eq!(wide.error, "between 100 kN/m and 5.9 GN/m");
    }

    #[test]
    fn shares_and_chi_squared_have_no_idle_digits() {
        let shown = [0.071, 5.6e-213, -1e-9, 0.0, 1.09e6].map(share);
        assert_eq!(shown, ["7.1 %", "< 0.01 %", "< 0.01 %", "0 %", "> 1000 %"]);
        assert_eq!([2.6e-7, 10.66].map(chi_squared), ["< 0.01", "10.7"]);
        assert_eq!(share(f64::NAN), "not determined");
    }

    #[test]
    fn value_error_and_interval_agree() {
        let skew = estimated(246.0, "1", Some((195.0, 303.0)));
        assert_eq!(skew.error, "+57 / -51 (22 %)");
        let coarse = estimated(58_941.0, "1/m2", Some((58_641.0, 59_241.0)));
        assert_eq!(coarse.value, "58940 1/m²");
        assert_eq!(coarse.error, "± 300 1/m² (0.51 %)");
        assert_eq!(coarse.interval, "58640 … 59240 1/m²");
    }
}
