//! `iwan diagnose`: records → what is wrong, why, and the joint that has it.

use super::input::Records;
use super::output;
use std::path::PathBuf;

/// Find what the baseline joint gets wrong, and why.
#[derive(Debug, clap::Args)]
pub struct Diagnose {
    #[command(flatten)]
    records: Records,
    /// Folder to write into; made where it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

/// Runs the subcommand.
pub fn run(arguments: &Diagnose) -> anyhow::Result<()> {
    output::admit_folder(&arguments.output)?;
    let _records = arguments.records.load()?;
    anyhow::bail!("`iwan diagnose` is not built yet")
}
