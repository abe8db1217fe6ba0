//! Where in a file something stands.

use std::path::PathBuf;

/// A place in a table: file, line and column, both counted from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spot {
    /// The file as it was named.
    pub file: PathBuf,
    /// Line of the file, comments and blank lines counted.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// The column's header as it stands in the file, or what it was declared to be.
    pub name: String,
}

impl std::fmt::Display for Spot {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let file = self.file.display();
        write!(
            f,
            "{file}, line {}, column {} `{}`",
            self.line, self.column, self.name
        )
    }
}
