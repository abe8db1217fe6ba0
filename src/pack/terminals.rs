//! terminalsAndIcons/terminalsAndIcons.xml of FMI 3.0; FMI 2.0 has no such folder.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};
use std::io::Result;

/// Where the entry stands in an archive of FMI 3.0.
pub const ENTRY: &str = "terminalsAndIcons/terminalsAndIcons.xml";
/// Where the icon stands that the entry names.
pub const ICON_ENTRY: &str = "terminalsAndIcons/icon.png";

/// One mechanical terminal: displacement across the joint as the potential, force through it as the
/// flow. A tool that knows the rule connects both with one line, in either drive. Checked against
/// the standard's schema by tests/fmu/fmpy_three.py.
pub fn xml() -> Result<Vec<u8>> {
    let mut writer = Writer::new_with_indent(Vec::new(), b' ', 2);
    writer.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    writer
        .create_element("fmiTerminalsAndIcons")
        .with_attribute(("fmiVersion", "3.0"))
        .write_inner_content(|writer| {
            writer
                .create_element("GraphicalRepresentation")
                .write_inner_content(|writer| {
                    writer
                        .create_element("CoordinateSystem")
                        .with_attributes(SQUARE)
                        .with_attribute(("suggestedScalingFactorTo_mm", "0.1"))
                        .write_empty()?;
                    writer
                        .create_element("Icon")
                        .with_attributes(SQUARE)
                        .write_empty()
                        .map(|_| ())
                })?;
            writer
                .create_element("Terminals")
                .write_inner_content(terminal)
                .map(|_| ())
        })?;
    Ok(writer.into_inner())
}

const SQUARE: [(&str, &str); 4] = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];

fn terminal(writer: &mut Writer<Vec<u8>>) -> Result<()> {
    let attributes = [
        ("name", "joint"),
        ("matchingRule", "plug"),
        (
            "terminalKind",
            "org.modelica.Mechanics.Translational.Interfaces.Flange",
        ),
        (
            "description",
            "Displacement across the joint and force through it",
        ),
    ];
    writer
        .create_element("Terminal")
        .with_attributes(attributes)
        .write_inner_content(|writer| {
            for (member, variable, kind) in
                [("s", "displacement", "signal"), ("f", "force", "inflow")]
            {
                writer
                    .create_element("TerminalMemberVariable")
                    .with_attribute(("variableKind", kind))
                    .with_attribute(("memberName", member))
                    .with_attribute(("variableName", variable))
                    .write_empty()?;
            }
            Ok(())
        })
        .map(|_| ())
}
