//! `iwan identify`: records → joint.json.

mod found;
mod json;
mod text;

use super::BadInput;
use super::fewest::Fewest;
use super::input::{BesideTable, Records};
use super::output;
use super::progress::Progress;
use crate::identify::family::LEAST_SAMPLES;
use crate::saved::SavedJoint;
use found::Found;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Identify the joint from measured records or an amplitude table.
#[derive(Debug, clap::Args)]
pub struct Identify {
    #[command(flatten)]
    records: Records,
    #[command(flatten)]
    beside: BesideTable,
    /// File to write; by default joint.json
    #[arg(short, long, value_name = "JOINT.json")]
    output: Option<PathBuf>,
    /// Report as JSON instead of text
    #[arg(long)]
    json: bool,
}

/// Identifies, prints the fit report and writes joint.json.
///
/// Of an amplitude table that lacks the stiffness, or the joint's own force, the report is printed
/// and no joint written: what is missing and how to give it is said. That is no error of the input
/// where no file was asked for.
///
/// # Errors
/// Of reading; [`BadInput`] where the records hold nothing to identify, or no joint for the file that
/// was asked for.
pub fn run(arguments: &Identify) -> anyhow::Result<()> {
    let asked = arguments.output.as_deref();
    let output = asked.unwrap_or(Path::new("joint.json"));
    output::admit(output, &arguments.records.paths())?;
    let known = arguments.beside.known()?;
    let loaded = arguments.records.load(Fewest::Together(LEAST_SAMPLES))?;
    arguments.beside.of_use(&loaded)?;
    let noticed = super::noticed::notes(&loaded);
    noticed.iter().for_each(|note| output::tell(note));
    let progress = Progress::new();
    progress.stage(&format!("identifying from {} record(s)", loaded.len()));
    let mut found = Found::from(&loaded, &known)
        .map_err(|error| BadInput(format!("{}: {error}", arguments.records.named())))?;
    drop(progress);
    found.noticed.extend(noticed);
    if let (Some(file), Err(why)) = (asked, &found.joint) {
        return Err(BadInput(format!(
            "{}: there is no joint to write: {why}; without `-o` the report alone is printed",
            file.display()
        ))
        .into());
    }
    let report = if arguments.json {
        json::report(&found)
    } else {
        text::report(&found)
    };
    if output == Path::new("-") {
        // The joint has the standard output for itself.
        output::tell(report.trim_end());
    } else {
        output::print(&report)?;
    }
    let joint = match &found.joint {
        Ok(joint) => joint,
        Err(why) => {
            output::tell(&format!("{} is not written: {why}", output.display()));
            return Ok(());
        }
    };
    let saved = SavedJoint {
        joint: joint.clone(),
        provenance: super::provenance::provenance(&loaded, &known, "identify"),
        intervals: intervals(&found),
    };
    output::write(output, |out| {
        out.write_all(crate::saved::write(&saved).as_bytes())?;
        Ok(())
    })?;
    output::tell(&format!("wrote {}", output.display()));
    Ok(())
}

/// Intervals by glossary name; infinite where the data do not bound a value.
fn intervals(found: &Found) -> BTreeMap<String, (f64, f64)> {
    found
        .estimates()
        .iter()
        .map(|e| {
            let open = (f64::NEG_INFINITY, f64::INFINITY);
            (e.name.to_string(), e.interval.unwrap_or(open))
        })
        .collect()
}
