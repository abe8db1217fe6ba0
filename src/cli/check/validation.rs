//! What an archive says of itself, held against the joint in it: what importers' own checks miss.

use super::attributes::{sized, structured};
use crate::joint::Joint;
use crate::pack::{FmiVersion, Library, PackError, Platform, date_time};
use crate::variables::{MODEL_IDENTIFIER, Variables};
use fmi_rs::model_description::{ModelDescriptionError, ValidationError, fmi2, fmi3};
use quick_xml::events::{BytesStart, Event};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

type Zip = zip::ZipArchive<File>;
/// Attributes of an element by name.
pub type Attributes = BTreeMap<String, String>;
/// Names of elements and their attributes, in the order of the XML.
pub type Elements = [(String, Attributes)];

/// What was found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Validation {
    /// Platforms whose library is in the archive.
    pub platforms: Vec<String>,
    /// What is wrong: an importer may refuse the archive or answer for another joint.
    pub faults: Vec<String>,
    /// What is worth knowing and harms nothing.
    pub notes: Vec<String>,
    /// Why this machine cannot load the archive's library; half a library would end the program.
    pub unloadable: Option<String>,
}

/// What importers read first.
const DESCRIPTION: &str = "modelDescription.xml";
/// Entries that every archive of ours has …
const ENTRIES: [&str; 3] = [
    DESCRIPTION,
    "resources/joint.json",
    "documentation/index.html",
];
/// … and one that FMI 3.0 has besides.
const TERMINALS: &str = "terminalsAndIcons/terminalsAndIcons.xml";

/// Lists the archive's entries and reads its XML.
pub fn validate(
    archive: &Path,
    version: FmiVersion,
    joint: &Joint,
    variables: &Variables,
) -> Validation {
    let mut found = Validation::default();
    let read = File::open(archive)
        .map_err(zip::result::ZipError::from)
        .and_then(Zip::new)
        .and_then(|mut zip| {
            entries(&mut zip, version, &mut found)?;
            let description = text(&mut zip, DESCRIPTION)?;
            let terminals = match version {
                FmiVersion::Two => None,
                FmiVersion::Three => text(&mut zip, TERMINALS).ok(),
            };
            Ok((description, terminals))
        });
    let (description, terminals) = match read {
        Ok(texts) => texts,
        Err(error) => {
            found.faults.push(format!("the archive: {error}"));
            return found;
        }
    };
    match elements(&description) {
        Ok(elements) => {
            interface(&elements, &mut found.faults);
            described(&elements, version, joint, variables, &mut found.faults);
            sized(
                &elements,
                &variables_of(&elements, version),
                &mut found.faults,
            );
            structured(&elements, version, &mut found.faults);
        }
        Err(error) => found.faults.push(format!("{DESCRIPTION}: {error}")),
    }
    judged(&description, version, &mut found.faults);
    match terminals.as_deref().map(elements) {
        Some(Ok(elements)) => connected(&elements, variables, &mut found.faults),
        Some(Err(error)) => found.faults.push(format!("{TERMINALS}: {error}")),
        None => {}
    }
    found
}

fn text(zip: &mut Zip, entry: &str) -> zip::result::ZipResult<String> {
    let mut text = String::new();
    zip.by_name(entry)?.read_to_string(&mut text)?;
    Ok(text)
}

fn entries(
    zip: &mut Zip,
    version: FmiVersion,
    found: &mut Validation,
) -> zip::result::ZipResult<()> {
    let names: Vec<String> = zip.file_names().map(str::to_owned).collect();
    let terminals = (version == FmiVersion::Three).then_some(TERMINALS);
    for entry in ENTRIES.into_iter().chain(terminals) {
        if !names.iter().any(|name| name == entry) {
            found.faults.push(format!("{entry} is missing"));
        }
    }
    let here = Platform::of_this_machine(version).ok();
    let here = here.map(|platform| platform.folder(version));
    for name in names.iter().filter(|name| !name.ends_with('/')) {
        let Some((folder, file)) = name
            .strip_prefix("binaries/")
            .and_then(|rest| rest.split_once('/'))
        else {
            continue;
        };
        let mut bytes = Vec::new();
        zip.by_name(name)?.read_to_end(&mut bytes)?;
        let Some(platform) = Platform::of_folder(version, folder) else {
            let version = version.number();
            let note = format!("{name}: FMI {version} names no folder {folder}");
            found.notes.push(note);
            continue;
        };
        found.platforms.push(folder.to_owned());
        let library = Library::of_bytes(platform.name, Path::new(name), bytes);
        match library.map(|library| library.entry(version)) {
            Ok(expected) if expected != *name => {
                found
                    .faults
                    .push(format!("{name}: importers look for {expected}, not {file}"));
            }
            Ok(_) => {}
            Err(error @ PackError::StaleLibrary { .. }) => {
                found
                    .notes
                    .push(format!("of another version of iwan: {error}"));
            }
            Err(error) => {
                let error = error.to_string();
                if here == Some(folder) {
                    found.unloadable = Some(error.clone());
                }
                found.faults.push(error);
            }
        }
    }
    found.platforms.sort();
    if let Some(folder) = here.filter(|here| found.platforms.iter().all(|other| other != here)) {
        let others = match &found.platforms[..] {
            [] => "none at all".to_owned(),
            others => others.join(", "),
        };
        found.unloadable = Some(format!(
            "no library for this machine, which takes that of binaries/{folder}; there is {others}"
        ));
    }
    if found.platforms.is_empty() {
        found.faults.push("no library in binaries/".to_owned());
    }
    Ok(())
}

/// Every element of the XML with its attributes, in order.
///
/// # Errors
/// What the XML's grammar is broken by.
pub fn elements(xml: &str) -> quick_xml::Result<Vec<(String, Attributes)>> {
    let mut reader = quick_xml::Reader::from_str(xml);
    let mut elements = Vec::new();
    loop {
        match reader.read_event()? {
            Event::Start(start) | Event::Empty(start) => elements.push(element(&start)?),
            Event::Eof => return Ok(elements),
            _ => {}
        }
    }
}

fn element(start: &BytesStart) -> quick_xml::Result<(String, Attributes)> {
    let name = String::from_utf8_lossy(start.name().as_ref()).into_owned();
    let mut attributes = Attributes::new();
    for attribute in start.attributes() {
        let attribute = attribute?;
        let key = String::from_utf8_lossy(attribute.key.as_ref()).into_owned();
        attributes.insert(key, attribute.unescape_value()?.into_owned());
    }
    Ok((name, attributes))
}

fn interface(elements: &Elements, faults: &mut Vec<String>) {
    let of = |name: &str| elements.iter().find(|element| element.0 == name);
    let identifier = of("CoSimulation").and_then(|unit| unit.1.get("modelIdentifier"));
    if identifier.map(String::as_str) != Some(MODEL_IDENTIFIER) {
        let came = identifier.map_or("none", String::as_str);
        faults.push(format!(
            "model identifier: expected {MODEL_IDENTIFIER}, came {came}"
        ));
    }
    let date = of("fmiModelDescription").and_then(|root| root.1.get("generationDateAndTime"));
    if let Some(date) = date.filter(|date| date_time(date).as_ref() != Some(date)) {
        faults.push(format!(
            "generationDateAndTime: expected a date and time such as 2024-05-01T12:00:00Z, came {date}"
        ));
    }
    for attribute in ["stopTime", "stepSize"] {
        let value = of("DefaultExperiment").and_then(|e| e.1.get(attribute));
        if value.is_some_and(|value| !value.parse().is_ok_and(|value: f64| value > 0.0)) {
            faults.push(format!("default experiment: {attribute} is not positive"));
        }
    }
}

/// The standard's rules on names, roles, start values and structure, in the words of `fmi-rs`, which
/// shares no code with what wrote the XML.
fn judged(description: &str, version: FmiVersion, faults: &mut Vec<String>) {
    let problems: Result<Vec<ValidationError>, ModelDescriptionError> = match version {
        FmiVersion::Two => {
            fmi2::ModelDescription::from_string(description).map(|read| read.validate())
        }
        FmiVersion::Three => {
            fmi3::ModelDescription::from_string(description).map(|read| read.validate())
        }
    };
    match problems {
        Ok(problems) => {
            let messages = problems.into_iter().map(|problem| problem.message);
            faults.extend(messages.map(|message| format!("{DESCRIPTION}: {message}")));
        }
        Err(error) => faults.push(format!("{DESCRIPTION}: {error}")),
    }
}

/// Every member of a terminal is a variable of the joint: a tool connects by these names.
fn connected(elements: &Elements, variables: &Variables, faults: &mut Vec<String>) {
    let members = elements
        .iter()
        .filter(|element| element.0 == "TerminalMemberVariable");
    let names: Vec<_> = members
        .map(|member| member.1.get("variableName").map_or("", String::as_str))
        .collect();
    if names.is_empty() {
        faults.push(format!("{TERMINALS}: no terminal with a variable"));
    }
    for name in names {
        if variables.iter().all(|variable| variable.name != name) {
            faults.push(format!("{TERMINALS}: there is no variable {name:?}"));
        }
    }
}

/// Name → attributes of the variable and of its type, which in FMI 3.0 are one element. The
/// independent variable, time, is the standard's and not the joint's.
fn variables_of(
    elements: &Elements,
    version: FmiVersion,
) -> BTreeMap<&str, (&Attributes, &Attributes)> {
    let (outer, inner, between) = match version {
        FmiVersion::Two => ("ScalarVariable", "Real", 1),
        FmiVersion::Three => ("Float64", "Float64", 0),
    };
    let pairs = elements.iter().zip(elements.iter().skip(between));
    pairs
        .filter(|(variable, of_type)| variable.0 == outer && of_type.0 == inner)
        .map(|(variable, of_type)| (&variable.1, &of_type.1))
        .filter(|(variable, _)| {
            variable.get("causality").map(String::as_str) != Some("independent")
        })
        .filter_map(|pair| Some((pair.0.get("name")?.as_str(), pair)))
        .collect()
}

/// Every variable of the joint with its reference, unit, role, bounds and start value, and none
/// besides.
fn described(
    elements: &Elements,
    version: FmiVersion,
    joint: &Joint,
    variables: &Variables,
    faults: &mut Vec<String>,
) {
    let xml = variables_of(elements, version);
    for stranger in xml
        .keys()
        .filter(|name| variables.iter().all(|v| v.name != **name))
    {
        faults.push(format!(
            "variable {stranger}: the joint has none of that name"
        ));
    }
    for variable in variables.iter() {
        let name = variable.name.as_str();
        let Some((outer, real)) = xml.get(name) else {
            faults.push(format!("variable {name} is missing"));
            continue;
        };
        let number = |key: &str| real.get(key).and_then(|text| text.parse::<f64>().ok());
        let finite = |bound: f64| Some(bound).filter(|bound| bound.is_finite());
        let written = |number: Option<f64>| number.map_or("none".to_owned(), |n| n.to_string());
        let mut differs = |what: &str, expected: String, came: String| {
            if expected != came {
                faults.push(format!(
                    "variable {name}: {what} expected {expected}, came {came}"
                ));
            }
        };
        let text = |from: &Attributes, key: &str| from.get(key).cloned().unwrap_or_default();
        let reference = variable.reference.to_string();
        differs("valueReference", reference, text(outer, "valueReference"));
        let causality = variable.causality.name().to_owned();
        differs("causality", causality, text(outer, "causality"));
        differs("unit", variable.unit.to_owned(), text(real, "unit"));
        for (key, expected) in [
            ("min", finite(variable.lower)),
            ("max", finite(variable.upper)),
            ("start", variable.start(joint)),
        ] {
            differs(key, written(expected), written(number(key)));
        }
    }
}
