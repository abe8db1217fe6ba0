//! One [`Findings`](crate::diagnose::Findings) value as text, HTML with plots, and JSON.

mod compared;
mod confusion;
mod content;
mod evidence;
mod glossary;
pub mod html;
pub mod json;
mod outlook;
mod plots;
mod quantity;
mod symbols;
pub mod text;
mod wording;

/// The page of one cause of the catalogue, as the report prints it.
///
/// The caller takes it from the catalogue, so that the report knows no cause. Plain text
/// throughout; `name` is the catalogue's identifier.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct CausePage {
    /// Catalogue name.
    pub name: String,
    /// What happens in the joint or the instrument.
    pub happens: String,
    /// The sign it leaves in the record.
    pub sign: String,
    /// Names of the causes it is mistaken for.
    pub mistaken_for: Vec<String>,
    /// What separates it from those.
    pub separated_by: String,
    /// The law, in symbols.
    pub formula: String,
    /// Where the law is from.
    pub source: String,
}

/// Why a report could not be made: always a defect of this program, never of the record.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The page's template was refused or lacks a value.
    #[error("report template: {0}")]
    Template(#[from] minijinja::Error),
    /// A plot could not be drawn.
    #[error("plot `{plot}`: {reason}")]
    Plot {
        /// Which plot.
        plot: String,
        /// What the drawing library said.
        reason: String,
    },
}
