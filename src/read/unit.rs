//! Units as test rigs write them, each as a ratio to the SI unit of its dimension.

use super::quantity::Quantity;

/// What a unit measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// SI unit s.
    Time,
    /// SI unit N.
    Force,
    /// SI unit m.
    Length,
    /// SI unit Hz.
    Frequency,
    /// SI unit J.
    Energy,
    /// SI unit m/s².
    Acceleration,
    /// K or °C, kept as given.
    Temperature,
}

impl Dimension {
    /// Its name in words.
    pub fn name(self) -> &'static str {
        match self {
            Dimension::Time => "time",
            Dimension::Force => "force",
            Dimension::Length => "length",
            Dimension::Frequency => "frequency",
            Dimension::Energy => "energy",
            Dimension::Acceleration => "acceleration",
            Dimension::Temperature => "temperature",
        }
    }
}

/// One unit: SI value = (written + `zero`) · `times` / `over`. Multiplier and divisor are kept
/// apart so that 1.5 mm is 0.0015 m to the last bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Spelling, without spaces, dots, stars, carets and degree signs, µ as u.
    pub spelling: &'static str,
    /// What it measures.
    pub dimension: Dimension,
    times: f64,
    over: f64,
    zero: f64,
    /// What to tell the reader, where the name has more than one meaning.
    pub remark: Option<&'static str>,
}

impl Unit {
    /// The SI value of a number written in this unit.
    pub fn si(&self, written: f64) -> f64 {
        (written + self.zero) * self.times / self.over
    }
}

const fn unit(spelling: &'static str, dimension: Dimension, times: f64, over: f64) -> Unit {
    Unit {
        spelling,
        dimension,
        times,
        over,
        zero: 0.0,
        remark: None,
    }
}

const fn remarked(base: Unit, remark: &'static str) -> Unit {
    Unit {
        remark: Some(remark),
        ..base
    }
}

const POUND_FORCE: f64 = 4.4482216152605; // exact: 0.45359237 kg · 9.80665 m/s²
const STANDARD_GRAVITY: f64 = 9.80665; // exact by definition
const INCH: f64 = 0.0254; // exact by definition

use Dimension::{Acceleration, Energy, Force, Frequency, Length, Temperature, Time};

/// Every unit that is read; the first of each dimension is the SI unit.
static UNITS: &[Unit] = &[
    unit("s", Time, 1.0, 1.0),
    unit("ms", Time, 1.0, 1e3),
    unit("us", Time, 1.0, 1e6),
    unit("ns", Time, 1.0, 1e9),
    unit("min", Time, 60.0, 1.0),
    unit("h", Time, 3600.0, 1.0),
    unit("sec", Time, 1.0, 1.0),
    unit("second", Time, 1.0, 1.0),
    unit("seconds", Time, 1.0, 1.0),
    unit("N", Force, 1.0, 1.0),
    unit("kN", Force, 1e3, 1.0),
    unit("mN", Force, 1.0, 1e3),
    unit("MN", Force, 1e6, 1.0),
    unit("uN", Force, 1.0, 1e6),
    unit("daN", Force, 10.0, 1.0),
    unit("lbf", Force, POUND_FORCE, 1.0),
    unit("lb", Force, POUND_FORCE, 1.0),
    unit("lbs", Force, POUND_FORCE, 1.0),
    unit("klbf", Force, POUND_FORCE * 1e3, 1.0),
    unit("kip", Force, POUND_FORCE * 1e3, 1.0),
    unit("kips", Force, POUND_FORCE * 1e3, 1.0),
    unit("dyn", Force, 1.0, 1e5),
    unit("kgf", Force, STANDARD_GRAVITY, 1.0),
    unit("kp", Force, STANDARD_GRAVITY, 1.0),
    remarked(
        unit("tonf", Force, STANDARD_GRAVITY * 1e3, 1.0),
        "tonf is read as the metric ton-force, 9806.65 N",
    ),
    unit("tf", Force, STANDARD_GRAVITY * 1e3, 1.0),
    unit("newton", Force, 1.0, 1.0),
    unit("m", Length, 1.0, 1.0),
    unit("mm", Length, 1.0, 1e3),
    unit("um", Length, 1.0, 1e6),
    unit("micron", Length, 1.0, 1e6),
    unit("microns", Length, 1.0, 1e6),
    unit("nm", Length, 1.0, 1e9),
    unit("cm", Length, 1.0, 1e2),
    unit("in", Length, INCH, 1.0),
    unit("inch", Length, INCH, 1.0),
    unit("inches", Length, INCH, 1.0),
    unit("mil", Length, INCH, 1e3),
    unit("mils", Length, INCH, 1e3),
    unit("thou", Length, INCH, 1e3),
    unit("ft", Length, 12.0 * INCH, 1.0),
    unit("Hz", Frequency, 1.0, 1.0),
    unit("kHz", Frequency, 1e3, 1.0),
    unit("mHz", Frequency, 1.0, 1e3),
    unit("MHz", Frequency, 1e6, 1.0),
    unit("1/s", Frequency, 1.0, 1.0),
    unit("J", Energy, 1.0, 1.0),
    unit("mJ", Energy, 1.0, 1e3),
    unit("uJ", Energy, 1.0, 1e6),
    unit("nJ", Energy, 1.0, 1e9),
    unit("kJ", Energy, 1e3, 1.0),
    unit("MJ", Energy, 1e6, 1.0),
    unit("Nm", Energy, 1.0, 1.0),
    unit("Nmm", Energy, 1.0, 1e3),
    unit("Num", Energy, 1.0, 1e6),
    unit("kNm", Energy, 1e3, 1.0),
    unit("kNmm", Energy, 1.0, 1.0),
    unit("lbfin", Energy, POUND_FORCE * INCH, 1.0),
    unit("inlbf", Energy, POUND_FORCE * INCH, 1.0),
    unit("lbin", Energy, POUND_FORCE * INCH, 1.0),
    unit("inlb", Energy, POUND_FORCE * INCH, 1.0),
    unit("lbfft", Energy, POUND_FORCE * 12.0 * INCH, 1.0),
    unit("ftlbf", Energy, POUND_FORCE * 12.0 * INCH, 1.0),
    unit("ftlb", Energy, POUND_FORCE * 12.0 * INCH, 1.0),
    unit("m/s2", Acceleration, 1.0, 1.0),
    unit("ms2", Acceleration, 1.0, 1.0), // m·s⁻²
    unit("mm/s2", Acceleration, 1.0, 1e3),
    unit("cm/s2", Acceleration, 1.0, 1e2),
    unit("in/s2", Acceleration, INCH, 1.0),
    unit("g", Acceleration, STANDARD_GRAVITY, 1.0),
    unit("gn", Acceleration, STANDARD_GRAVITY, 1.0),
    unit("K", Temperature, 1.0, 1.0),
    unit("C", Temperature, 1.0, 1.0),
    unit("degC", Temperature, 1.0, 1.0),
    unit("celsius", Temperature, 1.0, 1.0),
    Unit {
        zero: -32.0,
        ..remarked(unit("F", Temperature, 5.0, 9.0), FAHRENHEIT)
    },
    Unit {
        zero: -32.0,
        ..remarked(unit("degF", Temperature, 5.0, 9.0), FAHRENHEIT)
    },
];

const FAHRENHEIT: &str = "degrees Fahrenheit are converted to degrees Celsius";

/// The unit of that spelling and dimension. Capitals matter where they change the meaning (mN,
/// MN, or Nm of energy for nm) and are forgiven where they do not (KN, LBF).
pub fn find(written: &str, dimension: Dimension) -> Option<&'static Unit> {
    let plain = plain(written);
    let known = || UNITS.iter().filter(|unit| unit.dimension == dimension);
    if let Some(unit) = known().find(|unit| unit.spelling == plain) {
        return Some(unit);
    }
    if UNITS.iter().any(|unit| unit.spelling == plain) {
        return None;
    }
    let mut forgiven = known().filter(|unit| unit.spelling.eq_ignore_ascii_case(&plain));
    let first = forgiven.next()?;
    forgiven.next().is_none().then_some(first)
}

/// What a unit would measure, where it is known in another dimension than the one wanted.
pub fn measures(written: &str) -> Option<Dimension> {
    let plain = plain(written);
    UNITS
        .iter()
        .find(|unit| unit.spelling == plain)
        .map(|unit| unit.dimension)
}

/// Spellings for that quantity, for messages.
pub fn known(quantity: Quantity) -> String {
    let of_dimension = UNITS
        .iter()
        .filter(|unit| unit.dimension == quantity.dimension());
    of_dimension
        .map(|unit| unit.spelling)
        .collect::<Vec<_>>()
        .join(", ")
}

/// Spelling without the marks that rigs write differently.
fn plain(written: &str) -> String {
    let mut plain = String::with_capacity(written.len());
    for sign in written.trim().trim_end_matches("/cycle").chars() {
        match sign {
            'µ' | 'μ' => plain.push('u'),
            '²' => plain.push('2'),
            ' ' | '\u{a0}' | '.' | '*' | '^' | '·' | '⋅' | '×' | '°' | '-' | '−' | '⁻' => {
            }
            other => plain.push(other),
        }
    }
    if plain.contains("/s/s") {
        plain.replace("/s/s", "/s2")
    } else {
        plain
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capitals_are_forgiven_only_where_they_say_nothing() {
        let factor =
            |written: &str, dimension: Dimension| find(written, dimension).map(|u| u.si(1.0));
        assert_eq!(factor("MHz", Frequency), Some(1e6));
        assert_eq!(factor("mHz", Frequency), Some(1e-3));
        assert_eq!(factor("MHZ", Frequency), None);
        assert_eq!(factor("NM", Length), Some(1e-9));
        assert_eq!(factor("Nm", Length), None);
        assert_eq!(factor("KN", Force), Some(1e3));
        assert_eq!(factor("LBF", Force), factor("lbf", Force));
    }
}
