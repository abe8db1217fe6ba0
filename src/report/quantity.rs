//! Numbers as an engineer writes them: a convenient unit, and as many digits as are known.

use crate::diagnose::findings::Estimate;

/// A convenient multiple of an SI unit, e.g. µm for metres.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scale {
    /// How much of the SI unit one of the shown unit is.
    factor: f64,
    /// The unit as shown; empty where dimensionless.
    pub(super) unit: String,
}

const PREFIXES: [(f64, &str); 8] = [
    (1e9, "G"),
    (1e6, "M"),
    (1e3, "k"),
    (1.0, ""),
    (1e-3, "m"),
    (1e-6, "µ"),
    (1e-9, "n"),
    (1e-12, "p"),
];

/// Units that take prefixes, with the largest and smallest prefix in use for them.
const PREFIXED: [(&str, f64, f64); 8] = [
    ("N", 1e9, 1e-6),
    ("m", 1.0, 1e-12),
    ("J", 1e6, 1e-9),
    ("W", 1e6, 1e-9),
    ("s", 1.0, 1e-9),
    ("Hz", 1e9, 1e-3),
    ("Pa", 1e9, 1.0),
    ("V", 1e3, 1e-6),
];

impl Scale {
    /// The multiple of `unit` in which `magnitude` has one to three digits before the point.
    ///
    /// Only a leading N, m, J, W, s, Hz, Pa or V of the first power takes a prefix (`N/m` becomes
    /// `MN/m`); every other unit, and a magnitude of zero or no number, keeps the SI unit.
    pub(super) fn of(magnitude: f64, unit: &str) -> Scale {
        let leading: String = unit.chars().take_while(|c| c.is_alphabetic()).collect();
        let first_power = unit[leading.len()..].is_empty()
            || unit[leading.len()..].starts_with(['/', '.', '*', ' ', '·']);
        let range = PREFIXED.iter().find(|(name, ..)| *name == leading);
        let size = magnitude.abs();
        if let (Some((_, largest, smallest)), true) = (range, first_power && size.is_normal()) {
            let in_use = PREFIXES.iter().filter(|(factor, _)| factor <= largest);
            let mut in_use = in_use.filter(|(factor, _)| factor >= smallest).peekable();
            // 0.9995 shows as 1.00 of the larger unit, not as 1000 of the smaller one.
            while let Some((factor, prefix)) = in_use.next() {
                if size >= 0.9995 * factor || in_use.peek().is_none() {
                    return Scale {
                        factor: *factor,
                        unit: format!("{prefix}{}", typeset(unit)),
                    };
                }
            }
        }
        Scale {
            factor: 1.0,
            unit: typeset(unit),
        }
    }

    /// An SI value in the shown unit.
    pub(super) fn shown(&self, value: f64) -> f64 {
        value / self.factor
    }

    /// A number already written, followed by the unit where there is one.
    fn attach(&self, number: &str) -> String {
        if self.unit.is_empty() {
            number.to_owned()
        } else {
            format!("{number} {}", self.unit)
        }
    }
}

/// `N.s/m3` as `N·s/m³`; `1` as nothing.
fn typeset(unit: &str) -> String {
    if unit == "1" || unit == "-" {
        return String::new();
    }
    if unit.contains('(') {
        // A power that is itself a formula, e.g. `N/m^(2+chi)`: left as it is written.
        return unit.to_owned();
    }
    let mut shown = String::new();
    let mut in_power = false;
    let mut after_letter = false;
    for c in unit.chars() {
        match c {
            '^' => in_power = true,
            '-' if in_power => shown.push('⁻'),
            '0'..='9' if in_power || after_letter => {
                shown.push(superscript(c));
                in_power = true;
            }
            '.' | '*' => {
                shown.push('·');
                in_power = false;
            }
            _ => {
                shown.push(c);
                in_power = false;
            }
        }
        after_letter = c.is_alphabetic();
    }
    shown
}

fn superscript(digit: char) -> char {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    digit
        .to_digit(10)
        .map_or(digit, |value| RAISED[value as usize])
}

/// A number with `digits` significant digits; far from one as `1.23·10⁻⁵`; `not determined` where
/// it is none.
pub(super) fn number(value: f64, digits: i32) -> String {
    if value.is_nan() {
        return "not determined".to_owned();
    }
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "-∞" }.to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // Written in powers of ten first: rounding may reach the next decade.
    let written = format!("{value:.*e}", (digits - 1).max(0) as usize);
    let Some((mantissa, power)) = written.split_once('e') else {
        return written;
    };
    match power.parse::<i32>() {
        Ok(decade) if (-3..=5).contains(&decade) => {
            let decimals = (digits - 1 - decade).max(0) as usize;
            format!("{value:.decimals$}")
        }
        _ => {
            let raised = power.chars();
            let raised = raised.map(|c| if c == '-' { '⁻' } else { superscript(c) });
            format!("{mantissa}·10{}", raised.collect::<String>())
        }
    }
}

/// An SI value with three digits in a convenient unit, e.g. `12.3 µm`.
pub(super) fn quantity(value: f64, unit: &str) -> String {
    if !value.is_finite() {
        return number(value, 3);
    }
    let scale = Scale::of(value, unit);
    scale.attach(&number(scale.shown(value), 3))
}

/// A share as percent, e.g. `7.1 %`.
pub(super) fn percent(share: f64) -> String {
    if !share.is_finite() {
        return number(share, 2);
    }
    let value = 100.0 * share;
    let digits = if value.abs() >= 100.0 { 3 } else { 2 };
    format!("{} %", number(value, digits))
}

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
    fn convenient_units() {
        assert_eq!(quantity(1.234e-6, "m"), "1.23 µm");
        assert_eq!(quantity(-4120.0, "N"), "-4.12 kN");
        assert_eq!(quantity(0.99996e3, "N"), "1.00 kN");
        assert_eq!(quantity(2.5e7, "N/m"), "25.0 MN/m");
        assert_eq!(quantity(12.0, "N.s/m"), "12.0 N·s/m");
        assert_eq!(quantity(3e12, "N/m3"), "3000 GN/m³");
        assert_eq!(quantity(1.5e-4, "m2"), "1.50·10⁻⁴ m²");
        assert_eq!(quantity(0.5, "1/J"), "0.500 1/J");
        assert_eq!(quantity(2.0, "N/m^(2+chi)"), "2.00 N/m^(2+chi)");
        assert_eq!(quantity(0.25, "1"), "0.250");
        assert_eq!(quantity(0.0, "m"), "0 m");
        assert_eq!(quantity(3e-14, "m"), "0.0300 pm");
        assert_eq!(quantity(f64::NAN, "m"), "not determined");
        assert_eq!(quantity(f64::INFINITY, "N/m"), "∞");
        assert_eq!(percent(0.0712), "7.1 %");
        assert_eq!(percent(1.234), "123 %");
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
