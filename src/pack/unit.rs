//! A unit as FMI writes it → exponents of the SI base units.

/// Exponents of the base units of an FMI 2.0 `BaseUnit`; factor 1, offset 0 throughout, since
/// everything is in SI.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BaseUnit {
    /// Kilogram.
    pub kg: i32,
    /// Metre.
    pub m: i32,
    /// Second.
    pub s: i32,
    /// Radian.
    pub rad: i32,
}

/// Base units of an expression such as `N.s/m`, `N*s2/m2`, `N/m^3`, `1/(m.s)`; `None` where it
/// holds something else.
///
/// The grammar is FMI's: factors joined by `.` or `*`, one `/` whose right side may stand in
/// brackets, exponents with or without `^`.
pub fn base_unit(text: &str) -> Option<BaseUnit> {
    let mut sum = BaseUnit::default();
    for (index, side) in text.split('/').enumerate() {
        let side = side.trim().trim_start_matches('(').trim_end_matches(')');
        let sign = if index == 0 { 1 } else { -1 };
        for factor in side.split(['.', '*', '·']) {
            let (symbol, exponent) = factor_of(factor.trim())?;
            let unit = symbol_of(symbol)?;
            let times = sign * exponent;
            sum.kg += times * unit.kg;
            sum.m += times * unit.m;
            sum.s += times * unit.s;
            sum.rad += times * unit.rad;
        }
    }
    Some(sum)
}

/// `m^3`, `m3`, `s-2` → symbol and exponent.
fn factor_of(factor: &str) -> Option<(&str, i32)> {
    let symbol = factor.trim_end_matches(|c: char| c.is_ascii_digit() || c == '-');
    if symbol.is_empty() {
        return (factor == "1").then_some(("1", 1));
    }
    let exponent = &factor[symbol.len()..];
    let exponent = if exponent.is_empty() {
        Some(1)
    } else {
        exponent.parse().ok()
    };
    Some((symbol.trim_end_matches('^'), exponent?))
}

fn symbol_of(symbol: &str) -> Option<BaseUnit> {
    let unit = |kg, m, s| BaseUnit { kg, m, s, rad: 0 };
    Some(match symbol {
        "1" => unit(0, 0, 0),
        "kg" => unit(1, 0, 0),
        "m" => unit(0, 1, 0),
        "s" => unit(0, 0, 1),
        "N" => unit(1, 1, -2),
        "J" => unit(1, 2, -2),
        "W" => unit(1, 2, -3),
        "Pa" => unit(1, -1, -2),
        "Hz" => unit(0, 0, -1),
        "rad" => BaseUnit {
            rad: 1,
            ..unit(0, 0, 0)
        },
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_of_the_glossaries() {
        let unit = |kg, m, s| Some(BaseUnit { kg, m, s, rad: 0 });
        assert_eq!(base_unit("N"), unit(1, 1, -2));
        assert_eq!(base_unit("N/m"), unit(1, 0, -2));
        assert_eq!(base_unit("N.s/m"), unit(1, 0, -1));
        assert_eq!(base_unit("N*s2/m2"), unit(1, -1, 0));
        assert_eq!(base_unit("N*s^2/m^2"), unit(1, -1, 0));
        assert_eq!(base_unit("m/N^3"), unit(-3, -2, 6));
        assert_eq!(base_unit("1/(m.s)"), unit(0, -1, -1));
        assert_eq!(base_unit("J"), unit(1, 2, -2));
        assert_eq!(base_unit("1"), unit(0, 0, 0));
        assert_eq!(base_unit("bananas"), None);
        assert_eq!(base_unit("m^x"), None);
        assert_eq!(base_unit("2"), None);
    }
}
