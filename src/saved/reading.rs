//! joint.json → joint.

use std::collections::BTreeMap;

use serde_json::Value;

use super::entry::Entry;
use super::origin::{intervals, provenance};
use super::repeated::repeated;
use super::{FORMAT, Provenance, SavedError, SavedJoint};
use crate::causes;
use crate::joint::error::admitted;
use crate::joint::{
    Acting, Density, Effect, FourParameter, Joint, Parameter, PowerLaw, PowerLawTable, Sliders,
};

/// Reads a joint.json; `path` is how errors name the file.
///
/// # Errors
/// [`SavedError`], with line and column where the text is no JSON and the JSON path elsewhere.
/// Checked in tests/saved.rs.
pub fn read(text: &str, path: &str) -> Result<SavedJoint, SavedError> {
    read_with(text, path, |name| Some(causes::find(name)?.effect()))
}

/// [`read`] with another catalogue.
fn read_with(
    text: &str,
    path: &str,
    find: impl Fn(&str) -> Option<&'static dyn Effect>,
) -> Result<SavedJoint, SavedError> {
    // Editors of some systems write a byte order mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let value: Value = serde_json::from_str(text).map_err(|error| SavedError::Syntax {
        file: path.into(),
        line: error.line(),
        column: error.column(),
        reason: error.to_string(),
    })?;
    if let Some(twice) = repeated(text) {
        return Err(SavedError::Repeated {
            file: path.into(),
            place: twice.place,
            line: twice.line,
            column: twice.column,
        });
    }
    let root = Entry {
        file: path,
        place: "$".into(),
        value: &value,
    };
    root.object()?;
    let format = root.get("format", "add \"format\": \"iwan-joint/1\"")?;
    if format.text()? != FORMAT {
        return Err(format.unusable("this program reads \"iwan-joint/1\""));
    }
    root.only(&ENTRIES)?;
    let units = root.get("units", "add \"units\": \"SI\"")?;
    if units.text()? != "SI" {
        return Err(units.unusable("give all parameters in SI units and say \"SI\""));
    }
    let density = density(&root.get("density", "give a density with its \"family\"")?)?;
    let spring = root.get(
        "series_stiffness",
        "a stiffness in N/m, or null where rigid",
    )?;
    let series_stiffness = if spring.value.is_null() {
        f64::INFINITY
    } else {
        spring.number()?
    };
    let effects = match root.find("causes") {
        Some(list) => effects(&list, find)?,
        None => Vec::new(),
    };
    let joint =
        Joint::new(density, series_stiffness, effects).map_err(|reason| SavedError::NoJoint {
            file: path.into(),
            place: "$".into(),
            reason,
        })?;
    Ok(SavedJoint {
        joint,
        provenance: root
            .find("provenance")
            .map_or(Ok(Provenance::default()), |e| provenance(&e))?,
        intervals: root
            .find("intervals")
            .map_or(Ok(BTreeMap::new()), |e| intervals(&e))?,
    })
}

/// All that a file may hold.
const ENTRIES: [&str; 8] = [
    "format",
    "version",
    "units",
    "density",
    "series_stiffness",
    "causes",
    "provenance",
    "intervals",
];

fn density(entry: &Entry) -> Result<Density, SavedError> {
    let family = entry.get("family", FAMILIES)?;
    let (scalars, tables): (&[Parameter], &[&str]) = match family.text()? {
        "power_law" => (PowerLaw::PARAMETERS, &[]),
        "four_parameter" => (FourParameter::PARAMETERS, &[]),
        "power_law_table" => (PowerLawTable::PARAMETERS, &["break_free", "density"]),
        "sliders" => (Sliders::PARAMETERS, &["weight", "slip_at"]),
        _ => return Err(family.unusable(FAMILIES)),
    };
    let mut known = vec!["family"];
    known.extend(scalars.iter().map(|parameter| parameter.name));
    known.extend(tables);
    entry.only(&known)?;
    let values = parameters(entry, scalars)?;
    let mut vectors = Vec::new();
    for name in tables {
        vectors.push(entry.get(name, "a list of numbers, SI units")?.numbers()?);
    }
    let made = match (values.as_slice(), vectors.as_slice()) {
        (&[coefficient, exponent, slider_stiffness, stiffness], [break_free, density]) => {
            let (break_free, density) = (break_free.clone(), density.clone());
            PowerLawTable::new(
                coefficient,
                exponent,
                slider_stiffness,
                stiffness,
                break_free,
                density,
            )
            .map(Density::PowerLawTable)
        }
        (&[elastic], [weight, slip_at]) => {
            Sliders::new(weight.clone(), slip_at.clone(), elastic).map(Density::Sliders)
        }
        _ => Density::from_values(family.text()?, &values),
    };
    made.map_err(|reason| entry.no_joint(reason))
}

const FAMILIES: &str = "one of \"power_law\", \"power_law_table\", \"four_parameter\", \"sliders\"";

fn effects(
    list: &Entry,
    find: impl Fn(&str) -> Option<&'static dyn Effect>,
) -> Result<Vec<Acting>, SavedError> {
    let mut effects: Vec<Acting> = Vec::new();
    for entry in list.items()? {
        let name = entry.get("name", "the name of a cause, see `iwan causes`")?;
        let effect = find(name.text()?)
            .ok_or_else(|| name.unusable("no such cause; `iwan causes` lists those there are"))?;
        if effect.place().is_measurement() {
            let needed = "it belongs to the measuring chain, not to the joint: take it out";
            return Err(name.unusable(needed));
        }
        if effects
            .iter()
            .any(|other| other.effect.name() == effect.name())
        {
            return Err(name.unusable("it is there twice: keep one"));
        }
        entry.only(&["name", "parameters"])?;
        let glossary = effect.parameters();
        let given = entry.get("parameters", &names(glossary))?;
        let known: Vec<&str> = glossary.iter().map(|parameter| parameter.name).collect();
        given.only(&known)?;
        effects.push(Acting {
            effect,
            values: parameters(&given, glossary)?,
        });
    }
    Ok(effects)
}

/// Values in the order of the glossary, each in its range.
fn parameters(entry: &Entry, glossary: &[Parameter]) -> Result<Vec<f64>, SavedError> {
    let mut values = Vec::with_capacity(glossary.len());
    for parameter in glossary {
        let Parameter {
            name,
            unit,
            lower,
            upper,
            ..
        } = parameter;
        let unit = match *unit {
            "1" => String::new(),
            unit => format!(" in {unit}"),
        };
        let needed = format!("a number{unit}, {}", admitted(*lower, *upper));
        // A refinement of a law may be left out: it then drops out of it.
        if let (None, Some(neutral)) = (entry.find(name), parameter.neutral) {
            values.push(neutral);
            continue;
        }
        let given = entry.get(name, &needed)?;
        let value = if given.value.is_null() {
            f64::INFINITY
        } else {
            given.number()?
        };
        if !(*lower..=*upper).contains(&value) {
            return Err(given.unusable(&needed));
        }
        values.push(value);
    }
    Ok(values)
}

fn names(glossary: &[Parameter]) -> String {
    let names: Vec<&str> = glossary.iter().map(|parameter| parameter.name).collect();
    format!("give {}", names.join(", "))
}
