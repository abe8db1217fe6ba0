//! What the XML says of its variables beside the joint, where importers stop and their checks do not
//! look: display units, sizes, dependencies.

use super::validation::{Attributes, Elements};
use crate::pack::FmiVersion;
use std::collections::{BTreeMap, BTreeSet};

/// Name → attributes of the variable and of its type.
type Variables<'a> = BTreeMap<&'a str, (&'a Attributes, &'a Attributes)>;

/// Every display unit is one of its unit, and every nominal value is a size.
pub fn sized(elements: &Elements, variables: &Variables, faults: &mut Vec<String>) {
    let defined = display_units(elements);
    for (name, (_, real)) in variables {
        let text = |key: &str| real.get(key).map(String::as_str);
        if let Some(shown) = text("displayUnit")
            && !defined.contains(&(text("unit").unwrap_or_default(), shown))
        {
            faults.push(format!(
                "variable {name}: display unit {shown} is not defined"
            ));
        }
        let is_size = |text: &str| {
            let number = text.parse::<f64>();
            number.is_ok_and(|number| number > 0.0 && number.is_finite())
        };
        if let Some(came) = text("nominal").filter(|text| !is_size(text)) {
            faults.push(format!(
                "variable {name}: nominal expected above 0, came {came}"
            ));
        }
    }
}

/// Pairs of a unit and a display unit of it.
fn display_units(elements: &Elements) -> BTreeSet<(&str, &str)> {
    let mut unit = "";
    let mut pairs = BTreeSet::new();
    for (element, attributes) in elements {
        let name = attributes.get("name").map_or("", String::as_str);
        match element.as_str() {
            "Unit" => unit = name,
            "DisplayUnit" => {
                pairs.insert((unit, name));
            }
            _ => {}
        }
    }
    pairs
}

/// Outputs and what they depend on are variables of the XML. FMI 3.0 writes references; the places
/// in the list that FMI 2.0 writes are looked at by `fmi-rs`.
pub fn structured(elements: &Elements, version: FmiVersion, faults: &mut Vec<String>) {
    if version == FmiVersion::Two {
        return;
    }
    let of = |wanted: &'static [&str]| {
        let all = elements.iter();
        all.filter(move |element| wanted.contains(&element.0.as_str()))
    };
    let references: BTreeSet<_> = of(&["Float64"])
        .filter_map(|element| element.1.get("valueReference"))
        .map(String::as_str)
        .collect();
    for (element, attributes) in of(&["Output", "InitialUnknown"]) {
        let texts = ["valueReference", "dependencies"].map(|key| attributes.get(key));
        let named = texts.into_iter().flatten();
        for reference in named.flat_map(|text| text.split_whitespace()) {
            if !references.contains(reference) {
                faults.push(format!("{element}: there is no variable {reference}"));
            }
        }
    }
}
