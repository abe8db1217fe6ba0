//! `iwan export`.

/// Export a joint as an FMI co-simulation unit.
#[derive(Debug, clap::Args)]
pub struct Export {}

/// Runs the subcommand.
pub fn run(_arguments: &Export) -> anyhow::Result<()> {
    anyhow::bail!("`iwan export` is not built yet")
}
