//! `iwan check`.

/// Load an exported joint, run it and compare.
#[derive(Debug, clap::Args)]
pub struct Check {}

/// Runs the subcommand.
pub fn run(_arguments: &Check) -> anyhow::Result<()> {
    anyhow::bail!("`iwan check` is not built yet")
}
