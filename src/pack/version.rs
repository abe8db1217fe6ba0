//! For which version of FMI an archive is made.

/// Version of FMI; one shared library serves both.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FmiVersion {
    /// FMI 2.0.
    #[default]
    Two,
    /// FMI 3.0.
    Three,
}

impl FmiVersion {
    /// The number, as `fmiVersion` has it.
    pub const fn number(self) -> &'static str {
        match self {
            FmiVersion::Two => "2.0",
            FmiVersion::Three => "3.0",
        }
    }
}
