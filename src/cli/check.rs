//! `iwan check`: an exported joint loaded by an independent importer and held against the joint
//! that it carries.

#[cfg(feature = "importer")]
mod importer;
#[cfg(feature = "importer")]
mod load;
#[cfg(feature = "importer")]
mod verdict;

use super::BadInput;
use super::input::Foreign;
use std::path::PathBuf;

/// Load an exported joint, run it and compare.
///
/// The archive is loaded through the `fmi` crate and driven step by step; the joint.json inside it
/// is simulated beside it. The two must agree to rounding.
#[derive(Debug, clap::Args)]
pub struct Check {
    /// The archive of `iwan export` or `iwan diagnose`
    #[arg(value_name = "JOINT.fmu")]
    archive: PathBuf,
    /// The load: a file with time, and force or displacement by the archive's drive; by default a
    /// growing two-tone load that is made for the joint
    record: Option<PathBuf>,
    /// Result as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    foreign: Foreign,
}

/// Prints the largest differences and the verdict.
///
/// # Errors
/// [`BadInput`] where the archive cannot be loaded or disagrees with its joint, where the load
/// cannot be read, and where this program was built without the importer.
#[cfg(feature = "importer")]
pub fn run(arguments: &Check) -> anyhow::Result<()> {
    let archive = importer::Archive::open(&arguments.archive)?;
    let load = match &arguments.record {
        Some(record) => load::Load::read(record, &arguments.foreign, archive.drive())?,
        None => load::Load::made_for(archive.joint(), archive.drive())?,
    };
    let verdict = archive.compare(&load)?;
    let shown = arguments.archive.display().to_string();
    super::output::print(&if arguments.json {
        verdict.json(&shown)
    } else {
        verdict.text(&shown)
    })?;
    if verdict.agrees() {
        return Ok(());
    }
    Err(BadInput(format!(
        "{shown}: does not answer as its own resources/joint.json"
    ))
    .into())
}

/// Tells how to build the importer.
///
/// # Errors
/// [`BadInput`] always.
#[cfg(not(feature = "importer"))]
pub fn run(arguments: &Check) -> anyhow::Result<()> {
    let message = format!(
        "{}: this `iwan` was built without an importer; build it with `cargo build --release \
         --features importer`, which needs libclang (LIBCLANG_PATH)",
        arguments.archive.display()
    );
    Err(BadInput(message).into())
}
