//! `iwan export`: a joint as an FMI co-simulation unit.

use super::simulate::DriveName;
use super::{BadInput, output};
use crate::joint::Drive;
use crate::pack::{Archive, FmiVersion, Library, PackError};
use crate::variables::VariableError;
use std::path::{Path, PathBuf};

/// Export a joint as an FMI co-simulation unit (FMU).
#[derive(Debug, clap::Args)]
pub struct Export {
    /// The joint: a joint.json of `iwan identify` or `iwan diagnose`
    joint: PathBuf,
    /// File to write
    #[arg(short, long, value_name = "JOINT.fmu")]
    output: PathBuf,
    /// What the importer prescribes
    #[arg(long, value_enum, default_value = "force")]
    drive: DriveName,
    /// Version of FMI
    #[arg(long, value_name = "VERSION", default_value = "2", value_parser = ["2", "3"])]
    fmi: String,
    /// A shared library to pack, e.g. `win64=IwanJoint.dll`; may be given once per platform. By
    /// default the one that was built for this machine
    #[arg(long, value_name = "PLATFORM=FILE")]
    binary: Vec<String>,
}

/// Writes the archive, or leaves what was there as it was.
///
/// # Errors
/// [`BadInput`] where joint, library or output cannot be used; a parameter without a value
/// reference is a defect.
pub fn run(arguments: &Export) -> anyhow::Result<()> {
    let inputs = inputs(arguments);
    let inputs: Vec<_> = inputs.iter().map(PathBuf::as_path).collect();
    output::admit(&arguments.output, &inputs)?;
    // The text as it is: its hash goes into the archive.
    let (_, text) = super::input::joint_and_text(&arguments.joint)?;
    let drive = match arguments.drive {
        DriveName::Force => Drive::Force,
        DriveName::Displacement => Drive::Displacement,
    };
    let version = match arguments.fmi.as_str() {
        "3" => FmiVersion::Three,
        _ => FmiVersion::Two,
    };
    let archive = archive(version, &text, &arguments.joint, drive, &arguments.binary);
    let archive = archive.map_err(sorted)?;
    let bytes = archive.bytes().map_err(sorted)?;
    output::write(&arguments.output, |out| Ok(out.write_all(&bytes)?))?;
    for name in archive.names() {
        output::tell(&format!("{}: {name}", arguments.output.display()));
    }
    Ok(())
}

fn archive(
    version: FmiVersion,
    text: &str,
    file: &Path,
    drive: Drive,
    binaries: &[String],
) -> Result<Archive, PackError> {
    let libraries = if binaries.is_empty() {
        vec![Library::of_this_machine(version)?]
    } else {
        binaries
            .iter()
            .map(|named| Library::named(named))
            .collect::<Result<_, _>>()?
    };
    let file = file.display().to_string();
    Archive::of_version(version, text, &file, drive, &libraries)
}

/// Files that the output must not replace.
fn inputs(arguments: &Export) -> Vec<PathBuf> {
    let named = arguments
        .binary
        .iter()
        .filter_map(|named| named.split_once('='));
    let mut inputs: Vec<_> = named.map(|(_, path)| PathBuf::from(path)).collect();
    inputs.push(arguments.joint.clone());
    inputs
}

/// Bad input, but for a name that our own tables lack.
fn sorted(error: PackError) -> anyhow::Error {
    match error {
        PackError::Variables(
            VariableError::UnknownParameter { .. }
            | VariableError::UnknownCause { .. }
            | VariableError::TooManyParameters { .. },
        ) => error.into(),
        _ => BadInput(error.to_string()).into(),
    }
}
