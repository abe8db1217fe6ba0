//! `iwan check`: an exported joint loaded by an independent importer and held against the joint
//! that it carries.

#[cfg(feature = "importer")]
mod attributes;
#[cfg(feature = "importer")]
mod importer;
#[cfg(feature = "importer")]
mod load;
#[cfg(feature = "importer")]
mod measured;
#[cfg(feature = "importer")]
mod steps;
#[cfg(feature = "importer")]
mod validation;
#[cfg(feature = "importer")]
mod verdict;

use super::BadInput;
use super::input::Foreign;
#[cfg(feature = "importer")]
use crate::joint::error::shown;
use std::path::PathBuf;

/// Load an exported joint, run it and compare.
///
/// The archive's XML and libraries are held against the joint.json inside it; the archive is loaded
/// through the `fmi` crate (FMI 2.0) or `fmi-rs` (FMI 3.0) and driven step by step, and must agree
/// with `iwan simulate` to rounding.
/// With a record it also says how the joint answers beside the measurement, and what the
/// dissipation loses by the importer's communication step.
#[derive(Debug, clap::Args)]
pub struct Check {
    /// The archive of `iwan export` or `iwan diagnose`
    #[arg(value_name = "JOINT.fmu")]
    archive: PathBuf,
    /// The load: a file with time, and force or displacement by the archive's drive; by default a
    /// growing two-tone load that is made for the joint
    record: Option<PathBuf>,
    /// The importer's communication step to judge, in seconds; by default the one that the archive
    /// suggests
    #[arg(
        long,
        value_name = "SECONDS",
        requires = "record",
        allow_negative_numbers = true
    )]
    step: Option<f64>,
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
        Some(record) => {
            let (joint, drive) = (archive.joint(), archive.drive());
            load::Load::read(record, &arguments.foreign, joint, drive)?
        }
        None => load::Load::made_for(archive.joint(), archive.drive())?,
    };
    let record = arguments.record.as_ref().filter(|_| load.time.len() > 2);
    let judged = match record {
        Some(_) => Some(judged_step(arguments.step, archive.default_step(), &load)?),
        None => None,
    };
    let mut verdict = archive.compare(&load)?;
    let mut between = None;
    if let (Some(record), Some(step)) = (record, judged) {
        match steps::Steps::of(archive.joint(), archive.drive(), &load, step) {
            Ok(steps) => verdict.steps = Some(steps),
            // The samples themselves have been answered.
            Err(reason) => between = Some((record, reason)),
        }
    }
    let shown = arguments.archive.display().to_string();
    super::output::print(&if arguments.json {
        verdict.json(&shown)
    } else {
        verdict.text(&shown)
    })?;
    if let Some(fault) = archive.validation().faults.first() {
        return Err(BadInput(format!("{shown}: {fault}")).into());
    }
    if !verdict.agrees() {
        let reason = "does not answer as its own resources/joint.json";
        return Err(BadInput(format!("{shown}: {reason}")).into());
    }
    match between {
        None => Ok(()),
        Some((record, reason)) => {
            let place = format!("{}: between its samples", record.display());
            Err(anyhow::Error::new(reason).context(place))
        }
    }
}

/// The step that was asked for, else the archive's own, else the record's. None makes more than
/// [`steps::MOST_JUDGED`] of the record.
#[cfg(feature = "importer")]
fn judged_step(
    asked: Option<f64>,
    own: Option<f64>,
    load: &load::Load,
) -> Result<(f64, &'static str), BadInput> {
    let span = load.time[load.time.len() - 1] - load.time[0];
    let least = span / steps::MOST_JUDGED;
    match (asked, own) {
        (Some(step), _) if !(step >= least && step <= span) => Err(BadInput(format!(
            "--step {}: expected seconds from {least:.1e} up to the record's {}",
            shown(step),
            shown(span)
        ))),
        (Some(step), _) => Ok((step, "as asked for")),
        (None, Some(step)) if step >= least && step <= span => Ok((step, "the archive's default")),
        _ => Ok((span / (load.time.len() - 1) as f64, "the record's own")),
    }
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
