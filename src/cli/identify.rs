//! `iwan identify`: records → joint.json.

use super::input::Records;
use super::output;
use std::path::PathBuf;

/// Identify the joint from measured records.
#[derive(Debug, clap::Args)]
pub struct Identify {
    #[command(flatten)]
    records: Records,
    /// File to write
    #[arg(short, long, value_name = "JOINT.json", default_value = "joint.json")]
    output: PathBuf,
}

/// Runs the subcommand.
pub fn run(arguments: &Identify) -> anyhow::Result<()> {
    output::admit(&arguments.output, &arguments.records.paths())?;
    let _records = arguments.records.load()?;
    anyhow::bail!("`iwan identify` is not built yet")
}
