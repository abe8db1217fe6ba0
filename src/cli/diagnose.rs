//! `iwan diagnose`.

/// Find what the baseline joint gets wrong, and why.
#[derive(Debug, clap::Args)]
pub struct Diagnose {}

/// Runs the subcommand.
pub fn run(_arguments: &Diagnose) -> anyhow::Result<()> {
    anyhow::bail!("`iwan diagnose` is not built yet")
}
