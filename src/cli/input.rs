//! What several subcommands read, and what they say of it.

use crate::read::{Options, ReadError};

/// How to read files whose header does not say what they hold.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Foreign {
    /// Columns of a foreign file, counted from 1 or by header: `force=2,displacement=1,time=3`
    #[arg(long, value_name = "QUANTITY=COLUMN,…")]
    columns: Option<String>,
    /// Units, where the header has none or wrong ones: `force=kN,displacement=mm`
    #[arg(long, value_name = "QUANTITY=UNIT,…")]
    units: Option<String>,
}

impl Foreign {
    /// The options taken apart.
    ///
    /// # Errors
    /// [`ReadError::Option`].
    pub fn options(&self) -> Result<Options, ReadError> {
        Options::from_arguments(self.columns.as_deref(), self.units.as_deref())
    }
}

/// Says on stderr what was assumed while reading a file.
pub fn tell_notes(file: &std::path::Path, notes: &[String]) {
    for note in notes {
        eprintln!("{}: {note}", file.display());
    }
}

/// Reads a joint.json.
pub fn joint(file: &std::path::Path) -> anyhow::Result<crate::joint::Joint> {
    anyhow::bail!("{}: reading a saved joint is not built yet", file.display())
}
