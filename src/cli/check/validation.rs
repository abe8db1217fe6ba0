//! What an archive says of itself, held against the joint in it: what importers' own checks miss.

use crate::joint::Joint;
use crate::pack::{FmiVersion, Library, PackError};
use crate::variables::{MODEL_IDENTIFIER, Variables};
use quick_xml::events::{BytesStart, Event};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

type Zip = zip::ZipArchive<File>;
/// Attributes of an element by name.
type Attributes = BTreeMap<String, String>;

/// What was found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Validation {
    /// Platforms whose library is in the archive.
    pub platforms: Vec<String>,
    /// What is wrong: an importer may refuse the archive or answer for another joint.
    pub faults: Vec<String>,
    /// What is worth knowing and harms nothing.
    pub notes: Vec<String>,
}

/// Entries that every archive of ours has.
const ENTRIES: [&str; 3] = [
    "modelDescription.xml",
    "resources/joint.json",
    "documentation/index.html",
];

/// Lists the archive's entries and reads its XML.
pub fn validate(archive: &Path, joint: &Joint, variables: &Variables) -> Validation {
    let mut found = Validation::default();
    let read = File::open(archive)
        .map_err(zip::result::ZipError::from)
        .and_then(Zip::new)
        .and_then(|mut zip| {
            entries(&mut zip, &mut found)?;
            let mut xml = String::new();
            zip.by_name(ENTRIES[0])?.read_to_string(&mut xml)?;
            Ok(xml)
        });
    match read.map(|xml| elements(&xml)) {
        Ok(Ok(elements)) => {
            interface(&elements, &mut found.faults);
            described(&elements, joint, variables, &mut found.faults);
        }
        Ok(Err(error)) => found.faults.push(format!("{}: {error}", ENTRIES[0])),
        Err(error) => found.faults.push(format!("the archive: {error}")),
    }
    found
}

fn entries(zip: &mut Zip, found: &mut Validation) -> zip::result::ZipResult<()> {
    let names: Vec<String> = zip.file_names().map(str::to_owned).collect();
    for entry in ENTRIES {
        if !names.iter().any(|name| name == entry) {
            found.faults.push(format!("{entry} is missing"));
        }
    }
    for name in names.iter().filter(|name| !name.ends_with('/')) {
        let Some((platform, file)) = name
            .strip_prefix("binaries/")
            .and_then(|rest| rest.split_once('/'))
        else {
            continue;
        };
        let mut bytes = Vec::new();
        zip.by_name(name)?.read_to_end(&mut bytes)?;
        found.platforms.push(platform.to_owned());
        match Library::of_bytes(platform, Path::new(name), bytes) {
            Ok(library) if library.entry(FmiVersion::Two) != *name => {
                let expected = library.entry(FmiVersion::Two);
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
            Err(error) => found.faults.push(error.to_string()),
        }
    }
    found.platforms.sort();
    if found.platforms.is_empty() {
        found.faults.push("no library in binaries/".to_owned());
    }
    Ok(())
}

/// Every element of the XML with its attributes, in order.
fn elements(xml: &str) -> quick_xml::Result<Vec<(String, Attributes)>> {
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

fn interface(elements: &[(String, Attributes)], faults: &mut Vec<String>) {
    let of = |name: &str| elements.iter().find(|element| element.0 == name);
    let identifier = of("CoSimulation").and_then(|unit| unit.1.get("modelIdentifier"));
    if identifier.map(String::as_str) != Some(MODEL_IDENTIFIER) {
        let came = identifier.map_or("none", String::as_str);
        faults.push(format!(
            "model identifier: expected {MODEL_IDENTIFIER}, came {came}"
        ));
    }
    for attribute in ["stopTime", "stepSize"] {
        let value = of("DefaultExperiment").and_then(|e| e.1.get(attribute));
        if value.is_some_and(|value| !value.parse().is_ok_and(|value: f64| value > 0.0)) {
            faults.push(format!("default experiment: {attribute} is not positive"));
        }
    }
}

/// Every variable of the joint with its reference, unit, role, bounds and start value, and none
/// besides.
fn described(
    elements: &[(String, Attributes)],
    joint: &Joint,
    variables: &Variables,
    faults: &mut Vec<String>,
) {
    let pairs = elements.windows(2);
    let xml: BTreeMap<&str, (&Attributes, &Attributes)> = pairs
        .filter(|pair| pair[0].0 == "ScalarVariable" && pair[1].0 == "Real")
        .filter_map(|pair| Some((pair[0].1.get("name")?.as_str(), (&pair[0].1, &pair[1].1))))
        .collect();
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
            differs(key, format!("{expected:?}"), format!("{:?}", number(key)));
        }
    }
}
