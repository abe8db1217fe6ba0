//! modelDescription.xml of FMI 2.0, and what FMI 3.0 has in common with it.

use super::display_unit::display_unit;
use super::unit::base_unit;
use super::{Experiment, FmiVersion, Nominal, date_time};
use crate::joint::{Drive, Joint};
use crate::saved::{Provenance, SavedJoint};
use crate::variables::{Causality, MODEL_IDENTIFIER, Place, Signal, Variable, Variables};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::collections::BTreeSet;
use std::io::Result;

/// Attributes of one element, in order.
pub(super) type Attributes<'a> = Vec<(&'a str, String)>;

/// The XML of a joint under a drive. Elements and attributes stand in the order of the FMI 2.0
/// schema; strict importers stop at any other.
pub fn xml(saved: &SavedJoint, drive: Drive, variables: &Variables, guid: &str) -> Result<Vec<u8>> {
    let joint = &saved.joint;
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let mut root = root(FmiVersion::Two, saved, drive, ("guid", guid));
    root.push(("numberOfEventIndicators", "0".to_owned()));
    within(&mut writer, "fmiModelDescription", root, |writer| {
        empty(writer, "CoSimulation", capabilities())?;
        units(writer, variables.iter().map(|variable| variable.unit))?;
        log_categories(writer)?;
        default_experiment(writer, &saved.provenance)?;
        within(writer, "ModelVariables", vec![], |writer| {
            let nominal = Nominal::of(joint);
            variables.iter().try_for_each(|variable| {
                let (attributes, real) = of_variable(variable, joint, nominal);
                within(writer, "ScalarVariable", attributes, |writer| {
                    empty(writer, "Real", real)
                })
            })
        })?;
        structure(writer, variables)
    })?;
    let mut bytes = writer.into_inner();
    bytes.push(b'\n');
    Ok(bytes)
}

/// Attributes of the root; what tells one joint from another goes by a name of each version.
pub(super) fn root<'a>(
    version: FmiVersion,
    saved: &SavedJoint,
    drive: Drive,
    (token, value): (&'a str, &str),
) -> Attributes<'a> {
    let mut root = vec![
        ("fmiVersion", version.number().to_owned()),
        ("modelName", MODEL_IDENTIFIER.to_owned()),
        (token, value.to_owned()),
        ("description", super::description(&saved.joint, drive)),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("license", env!("CARGO_PKG_LICENSE").to_owned()),
        (
            "generationTool",
            concat!("iwan ", env!("CARGO_PKG_VERSION")).to_owned(),
        ),
    ];
    // Of the joint, not of the export: the same joint gives the same archive.
    let date = saved.provenance.date.as_deref().and_then(date_time);
    root.extend(date.map(|date| ("generationDateAndTime", date)));
    root.push(("variableNamingConvention", "structured".to_owned()));
    root
}

/// What the library can do; each is tested at its boundary.
fn capabilities() -> Attributes<'static> {
    owned(&[
        ("modelIdentifier", MODEL_IDENTIFIER),
        ("needsExecutionTool", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("canInterpolateInputs", "true"),
        ("maxOutputDerivativeOrder", "1"),
        ("canRunAsynchronuously", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canNotUseMemoryManagementFunctions", "true"),
        ("canGetAndSetFMUstate", "true"),
        ("canSerializeFMUstate", "true"),
        ("providesDirectionalDerivative", "true"),
    ])
}

pub(super) fn log_categories(writer: &mut Writer<Vec<u8>>) -> Result<()> {
    within(writer, "LogCategories", vec![], |writer| {
        let refused = "Why a call was refused; always told";
        log_category(writer, "logStatusError", refused)?;
        log_category(
            writer,
            "logEvents",
            "Instantiated, initialized, reset, terminated",
        )
    })
}

/// The joint's own measurement, as [`Experiment`] has it.
pub(super) fn default_experiment(
    writer: &mut Writer<Vec<u8>>,
    provenance: &Provenance,
) -> Result<()> {
    let experiment = Experiment::of(provenance);
    let attributes = vec![
        ("startTime", "0".to_owned()),
        ("stopTime", format!("{:?}", experiment.stop_time)),
        ("stepSize", format!("{:?}", experiment.step_size)),
    ];
    empty(writer, "DefaultExperiment", attributes)
}

/// Every unit that is used, once, with its base units.
pub(super) fn units<'a>(
    writer: &mut Writer<Vec<u8>>,
    used: impl Iterator<Item = &'a str>,
) -> Result<()> {
    let used: BTreeSet<_> = used.collect();
    within(writer, "UnitDefinitions", vec![], |writer| {
        for unit in used {
            within(writer, "Unit", owned(&[("name", unit)]), |writer| {
                let Some(base) = base_unit(unit) else {
                    return Ok(());
                };
                let exponents = [
                    ("kg", base.kg),
                    ("m", base.m),
                    ("s", base.s),
                    ("rad", base.rad),
                ];
                let present = exponents.into_iter().filter(|&(_, exponent)| exponent != 0);
                let attributes = present.map(|(name, exponent)| (name, exponent.to_string()));
                empty(writer, "BaseUnit", attributes.collect())?;
                display_unit(unit).map_or(Ok(()), |(name, factor)| {
                    let attributes =
                        vec![("name", name.to_owned()), ("factor", format!("{factor:?}"))];
                    empty(writer, "DisplayUnit", attributes)
                })
            })?;
        }
        Ok(())
    })
}

fn log_category(writer: &mut Writer<Vec<u8>>, name: &str, description: &str) -> Result<()> {
    empty(
        writer,
        "Category",
        owned(&[("name", name), ("description", description)]),
    )
}

/// What a variable is, and its numbers, in the words of both versions of FMI.
pub(super) fn of_variable<'a>(
    variable: &Variable,
    joint: &Joint,
    nominal: Nominal,
) -> (Attributes<'a>, Attributes<'a>) {
    let mut attributes = vec![
        ("name", variable.name.clone()),
        ("valueReference", variable.reference.to_string()),
        ("description", variable.description.clone()),
        ("causality", variable.causality.name().to_owned()),
    ];
    let (variability, initial) = match variable.causality {
        // FMI forbids `initial` on inputs.
        Causality::Input => ("continuous", None),
        Causality::Output | Causality::Local => ("continuous", Some("calculated")),
        Causality::Parameter => ("fixed", Some("exact")),
    };
    attributes.push(("variability", variability.to_owned()));
    attributes.extend(initial.map(|initial| ("initial", initial.to_owned())));
    (attributes, numbers(variable, joint, nominal))
}

/// Units, bounds, size and start value.
fn numbers<'a>(variable: &Variable, joint: &Joint, nominal: Nominal) -> Attributes<'a> {
    let start = variable.start(joint);
    let mut real = owned(&[("unit", variable.unit)]);
    let shown = display_unit(variable.unit);
    real.extend(shown.map(|(name, _)| ("displayUnit", name.to_owned())));
    let numbers = [
        (
            "min",
            Some(variable.lower).filter(|bound| bound.is_finite()),
        ),
        (
            "max",
            Some(variable.upper).filter(|bound| bound.is_finite()),
        ),
        ("nominal", nominal.value(&variable.name, start)),
        ("start", start),
    ];
    for (name, number) in numbers {
        // `{:?}` is the shortest text that reads back as the same number.
        real.extend(number.map(|number| (name, format!("{number:?}"))));
    }
    real
}

/// One output and what it depends on, by numbers of variables as the version counts them.
pub(super) struct Unknown {
    pub(super) output: String,
    /// At a communication point: the input at the end of the step, as the directional derivatives
    /// have it.
    pub(super) at_a_point: String,
    /// In Initialization Mode: the input and every parameter; but no power has been lost over a
    /// step yet, whatever they are.
    pub(super) initial: String,
}

/// All outputs; `number` counts a variable by its place in the list or by its reference.
pub(super) fn unknowns(
    variables: &Variables,
    number: impl Fn(usize, &Variable) -> String,
) -> Vec<Unknown> {
    let numbers = |wanted: &[Causality]| -> String {
        let all = variables.iter().enumerate();
        let chosen = all.filter(|(_, variable)| wanted.contains(&variable.causality));
        let numbers: Vec<_> = chosen.map(|(place, v)| number(place, v)).collect();
        numbers.join(" ")
    };
    let input = numbers(&[Causality::Input]);
    let knowns = numbers(&[Causality::Input, Causality::Parameter]);
    let all = variables.iter().enumerate();
    let outputs = all.filter(|(_, variable)| variable.causality == Causality::Output);
    let unknown = |(place, output): (usize, &Variable)| Unknown {
        output: number(place, output),
        at_a_point: input.clone(),
        initial: match output.place {
            Place::Signal(Signal::DissipationRate) => String::new(),
            _ => knowns.clone(),
        },
    };
    outputs.map(unknown).collect()
}

fn structure(writer: &mut Writer<Vec<u8>>, variables: &Variables) -> Result<()> {
    let all = unknowns(variables, |place, _| (place + 1).to_string());
    type Dependencies = fn(&Unknown) -> &str;
    let kinds: [(&str, Dependencies); 2] = [
        ("Outputs", |unknown| &unknown.at_a_point),
        ("InitialUnknowns", |unknown| &unknown.initial),
    ];
    within(writer, "ModelStructure", vec![], |writer| {
        kinds.iter().try_for_each(|(element, dependencies)| {
            within(writer, element, vec![], |writer| {
                all.iter().try_for_each(|unknown| {
                    let on = ("dependencies", dependencies(unknown));
                    empty(writer, "Unknown", owned(&[("index", &unknown.output), on]))
                })
            })
        })
    })
}

pub(super) fn owned<'a>(attributes: &[(&'a str, &str)]) -> Attributes<'a> {
    attributes
        .iter()
        .map(|&(name, value)| (name, value.to_owned()))
        .collect()
}

pub(super) fn empty(
    writer: &mut Writer<Vec<u8>>,
    name: &str,
    attributes: Attributes,
) -> Result<()> {
    let pairs = attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    writer
        .create_element(name)
        .with_attributes(pairs)
        .write_empty()
        .map(|_| ())
}

pub(super) fn within(
    writer: &mut Writer<Vec<u8>>,
    name: &str,
    attributes: Attributes,
    content: impl FnOnce(&mut Writer<Vec<u8>>) -> Result<()>,
) -> Result<()> {
    let pairs = attributes
        .iter()
        .map(|(name, value)| (*name, value.as_str()));
    writer
        .create_element(name)
        .with_attributes(pairs)
        .write_inner_content(content)
        .map(|_| ())
}
