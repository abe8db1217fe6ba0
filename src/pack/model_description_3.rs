//! modelDescription.xml of FMI 3.0.

use super::model_description::{
    Attributes, default_experiment, empty, log_categories, of_variable, owned, root, units,
    unknowns, within,
};
use super::{FmiVersion, Nominal};
use crate::joint::Drive;
use crate::saved::SavedJoint;
use crate::variables::{MODEL_IDENTIFIER, TIME_REFERENCE, Variables};
use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io::Result;

/// The XML of a joint under a drive. Elements and attributes stand in the order of the FMI 3.0
/// schema.
pub fn xml(
    saved: &SavedJoint,
    drive: Drive,
    variables: &Variables,
    token: &str,
) -> Result<Vec<u8>> {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = root(
        FmiVersion::Three,
        saved,
        drive,
        ("instantiationToken", token),
    );
    within(&mut writer, "fmiModelDescription", root, |writer| {
        empty(writer, "CoSimulation", capabilities())?;
        let used = variables.iter().map(|variable| variable.unit);
        units(writer, used.chain(["s"]))?;
        log_categories(writer)?;
        default_experiment(writer, &saved.provenance)?;
        within(writer, "ModelVariables", vec![], |writer| {
            empty(writer, "Float64", time())?;
            let nominal = Nominal::of(&saved.joint);
            variables.iter().try_for_each(|variable| {
                let (mut attributes, numbers) = of_variable(variable, &saved.joint, nominal);
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
    let all = unknowns(variables, |_, variable| variable.reference.to_string());
    let write = |writer: &mut _, element, output: &str, on: &str| {
        let attributes = [("valueReference", output), ("dependencies", on)];
        empty(writer, element, owned(&attributes))
    };
    within(writer, "ModelStructure", vec![], |writer| {
        for unknown in &all {
            write(writer, "Output", &unknown.output, &unknown.at_a_point)?;
        }
        for unknown in &all {
            write(writer, "InitialUnknown", &unknown.output, &unknown.initial)?;
        }
        Ok(())
    })
}
