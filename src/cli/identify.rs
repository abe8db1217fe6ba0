//! `iwan identify`.

/// Identify the joint from measured records.
#[derive(Debug, clap::Args)]
pub struct Identify {}

/// Runs the subcommand.
pub fn run(_arguments: &Identify) -> anyhow::Result<()> {
    anyhow::bail!("`iwan identify` is not built yet")
}
