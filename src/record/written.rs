//! Numbers as an engineer writes them: a convenient unit, and powers of ten where there is none.

/// A convenient multiple of an SI unit, e.g. µm for metres.
#[derive(Debug, Clone, PartialEq)]
pub struct Scale {
    /// How much of the SI unit one of the shown unit is.
    factor: f64,
    /// The unit as shown; empty where dimensionless.
    pub unit: String,
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
    pub fn of(magnitude: f64, unit: &str) -> Scale {
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
    pub fn shown(&self, value: f64) -> f64 {
        value / self.factor
    }

    /// A number already written, followed by the unit where there is one.
    pub fn attach(&self, number: &str) -> String {
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
pub fn number(value: f64, digits: i32) -> String {
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
pub fn quantity(value: f64, unit: &str) -> String {
    if !value.is_finite() {
        return number(value, 3);
    }
    let scale = Scale::of(value, unit);
    scale.attach(&number(scale.shown(value), 3))
}

/// A share as percent, e.g. `7.1 %`.
pub fn percent(share: f64) -> String {
    if !share.is_finite() {
        return number(share, 2);
    }
    let value = 100.0 * share;
    let digits = if value.abs() >= 100.0 { 3 } else { 2 };
    format!("{} %", number(value, digits))
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
