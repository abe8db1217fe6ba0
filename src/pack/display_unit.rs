//! The unit in which an importer may show a quantity of joints, which are stiff and small.

/// Name of the shown unit, and what an SI value is multiplied by.
pub type DisplayUnit = (&'static str, f64);

/// Shown unit of an SI unit; `None` where SI is what engineers use.
pub fn display_unit(unit: &str) -> Option<DisplayUnit> {
    Some(match unit {
        "m" => ("um", 1e6),
        "N" => ("kN", 1e-3),
        "N/m" => ("kN/mm", 1e-6),
        "J" => ("mJ", 1e3),
        "W" => ("mW", 1e3),
        "s" => ("ms", 1e3),
        _ => return None,
    })
}
