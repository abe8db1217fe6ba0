//! modelDescription.xml of FMI 3.0, and what else differs from FMI 2.0 in the archive.

use super::Library;
use super::model_description::{
    Attributes, default_experiment, empty, log_categories, of_variable, owned, units, within,
};
use crate::joint::{Drive, Joint};
use crate::variables::{Causality, MODEL_IDENTIFIER, TIME_REFERENCE, Variables};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io::Result;

/// Version of FMI for which an archive is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FmiVersion {
    /// FMI 2.0.
    #[default]
    Two,
    /// FMI 3.0.
    Three,
}

impl FmiVersion {
    /// Place of a library in the archive.
    pub fn entry(self, library: &Library) -> String {
        match self {
            FmiVersion::Two => library.entry(),
            FmiVersion::Three => entry(library),
        }
    }
}

/// Place of a library in an archive of FMI 3.0, whose platforms have other names.
fn entry(library: &Library) -> String {
    let tuple = match library.platform {
        "linux64" => "x86_64-linux",
        "linux32" => "x86-linux",
        "win64" => "x86_64-windows",
        "win32" => "x86-windows",
        "darwin64" => "x86_64-darwin",
        "darwin32" => "x86-darwin",
        tuple => tuple,
    };
    library.entry().replacen(library.platform, tuple, 1)
}

/// The XML of a joint under a drive. Elements and attributes stand in the order of the FMI 3.0
/// schema.
pub fn xml(joint: &Joint, drive: Drive, variables: &Variables, token: &str) -> Result<Vec<u8>> {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = vec![
        ("fmiVersion", "3.0".to_owned()),
        ("modelName", MODEL_IDENTIFIER.to_owned()),
        ("instantiationToken", token.to_owned()),
        ("description", super::description(joint, drive)),
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        (
            "generationTool",
            concat!("iwan ", env!("CARGO_PKG_VERSION")).to_owned(),
        ),
        ("variableNamingConvention", "structured".to_owned()),
    ];
    within(&mut writer, "fmiModelDescription", root, |writer| {
        empty(writer, "CoSimulation", capabilities())?;
        let used = variables.iter().map(|variable| variable.unit);
        units(writer, used.chain(["s"]))?;
        log_categories(writer)?;
        default_experiment(writer)?;
        within(writer, "ModelVariables", vec![], |writer| {
            empty(writer, "Float64", time())?;
            variables.iter().try_for_each(|variable| {
                let (mut attributes, numbers) = of_variable(variable, joint);
                attributes.extend(numbers);
                empty(writer, "Float64", attributes)
            })
        })?;
        structure(writer, variables)
    })?;
    let mut bytes = writer.into_inner();
    bytes.push(b'\n');
    Ok(bytes)
}

/// What the library can do; each is tested at its boundary. Steps never return early and there are
/// no events, so that an importer need not be ready for them.
fn capabilities() -> Attributes<'static> {
    owned(&[
        ("modelIdentifier", MODEL_IDENTIFIER),
        ("needsExecutionTool", "false"),
        ("canBeInstantiatedOnlyOncePerProcess", "false"),
        ("canGetAndSetFMUState", "true"),
        ("canSerializeFMUState", "true"),
        ("providesDirectionalDerivatives", "true"),
        ("providesAdjointDerivatives", "true"),
        ("providesPerElementDependencies", "false"),
        ("canHandleVariableCommunicationStepSize", "true"),
        ("maxOutputDerivativeOrder", "1"),
        ("providesIntermediateUpdate", "false"),
        ("mightReturnEarlyFromDoStep", "false"),
        ("canReturnEarlyAfterIntermediateUpdate", "false"),
        ("hasEventMode", "false"),
        ("providesEvaluateDiscreteStates", "false"),
    ])
}

/// The independent variable, which FMI 3.0 asks for.
fn time() -> Attributes<'static> {
    vec![
        ("name", "time".to_owned()),
        ("valueReference", TIME_REFERENCE.to_string()),
        ("description", "Communication point".to_owned()),
        ("causality", "independent".to_owned()),
        ("variability", "continuous".to_owned()),
        ("unit", "s".to_owned()),
    ]
}

/// Outputs and how they depend, as in FMI 2.0.
fn structure(writer: &mut Writer<Vec<u8>>, variables: &Variables) -> Result<()> {
    let references = |wanted: &[Causality]| -> Vec<String> {
        let chosen = variables
            .iter()
            .filter(|variable| wanted.contains(&variable.causality));
        chosen
            .map(|variable| variable.reference.to_string())
            .collect()
    };
    let outputs = references(&[Causality::Output]);
    let input = references(&[Causality::Input]).join(" ");
    let knowns = references(&[Causality::Input, Causality::Parameter]).join(" ");
    within(writer, "ModelStructure", vec![], |writer| {
        for (element, dependencies) in [("Output", &input), ("InitialUnknown", &knowns)] {
            for output in &outputs {
                let attributes = [("valueReference", output), ("dependencies", dependencies)];
                let attributes = attributes.map(|(name, value)| (name, value.clone()));
                empty(writer, element, attributes.into())?;
            }
        }
        Ok(())
    })
}
