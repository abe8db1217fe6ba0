//! Why an archive was not made.

use crate::saved::SavedError;
use crate::variables::VariableError;
use std::path::PathBuf;

/// Why an archive was not made.
#[derive(Debug, thiserror::Error)]
pub enum PackError {
    /// joint.json is no joint.
    #[error(transparent)]
    Saved(#[from] SavedError),
    /// The joint cannot be shown as FMI variables.
    #[error(transparent)]
    Variables(#[from] VariableError),
    /// A parameter outside its own bounds.
    #[error(
        "parameter `{name}` is {}: it must be {}",
        crate::joint::error::shown(*.value),
        crate::joint::error::admitted(*.lower, *.upper)
    )]
    StartOutOfBounds {
        /// Name of the variable.
        name: String,
        /// Its value in joint.json.
        value: f64,
        /// Smallest admissible.
        lower: f64,
        /// Largest admissible.
        upper: f64,
    },
    /// No library to pack.
    #[error(
        "no shared library for the FMU, looked for {}; build it in the source folder with `{}`, then copy \
         it to the last of these places, name it in the environment variable {}, or pack it with `iwan \
         export joint.json -o joint.fmu --binary PLATFORM=FILE`",
        looked.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", "),
        super::library::BUILD_COMMAND,
        super::library::VARIABLE
    )]
    NoLibrary {
        /// Places looked at.
        looked: Vec<PathBuf>,
    },
    /// A platform that FMI does not name.
    #[error("platform `{came}`: expected one of {}", super::platform::PLATFORMS.map(|known| known.name).join(", "))]
    Platform {
        /// What was asked for.
        came: String,
    },
    /// `--binary` without its two halves.
    #[error("`{came}`: expected PLATFORM=FILE, e.g. linux64=target/fmu/release/libiwan.so")]
    BinaryForm {
        /// What was asked for.
        came: String,
    },
    /// Two libraries for one platform.
    #[error("platform `{platform}` has two libraries: {first} and {second}")]
    PlatformTwice {
        /// The platform.
        platform: &'static str,
        /// One file.
        first: PathBuf,
        /// The other file.
        second: PathBuf,
    },
    /// A library that cannot be read.
    #[error("library {path}: {error}")]
    UnreadableLibrary {
        /// The file.
        path: PathBuf,
        /// What the system says.
        error: std::io::Error,
    },
    /// A file that is no shared library of its platform.
    #[error("library {path}: expected {expected} for {platform}, came something else")]
    WrongFormat {
        /// The file.
        path: PathBuf,
        /// The platform.
        platform: &'static str,
        /// Format of that platform.
        expected: &'static str,
    },
    /// The beginning of a library.
    #[error(
        "library {path} is cut short: it has {came} bytes and speaks of {expected}; copy or build \
         it anew"
    )]
    CutShort {
        /// The file.
        path: PathBuf,
        /// Bytes that its tables ask for.
        expected: u64,
        /// Bytes that there are.
        came: u64,
    },
    /// A library of other sources than this program.
    #[error(
        "library {path} was built from other sources than this program (expected {expected} in \
         it); build it anew with `{}`",
        super::library::BUILD_COMMAND
    )]
    StaleLibrary {
        /// The file.
        path: PathBuf,
        /// Stamp of this program.
        expected: &'static str,
    },
    /// The format cannot hold an entry.
    #[error("cannot make the archive: {name}: {error}")]
    Entry {
        /// The entry.
        name: String,
        /// What is wrong with it.
        error: std::io::Error,
    },
}
