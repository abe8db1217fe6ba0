//! Where the FMU's shared library comes from, and that it is the right one.

use super::platform::Platform;
use super::whole;
use super::{FmiVersion, PackError};
use crate::variables::{MODEL_IDENTIFIER, STAMP};
use std::path::{Path, PathBuf};

/// How the library is built; `iwan export` finds it where this leaves it.
pub const BUILD_COMMAND: &str =
    "cargo build --release --lib --no-default-features --target-dir target/fmu";
/// Environment variable that names a library for this machine's platform.
pub const VARIABLE: &str = "IWAN_FMU_LIBRARY";
/// One shared library for one platform, checked.
#[derive(Debug, Clone)]
pub struct Library {
    /// The platform.
    pub platform: &'static Platform,
    /// Where it was read from.
    pub path: PathBuf,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl Library {
    /// Reads a library and checks its format, its length and its stamp.
    ///
    /// # Errors
    /// [`PackError::UnreadableLibrary`], and as [`Library::of_bytes`].
    pub fn read(platform: &str, path: &Path) -> Result<Library, PackError> {
        Platform::named(platform)?;
        match std::fs::read(path) {
            Ok(bytes) => Library::of_bytes(platform, path, bytes),
            Err(error) => Err(PackError::UnreadableLibrary {
                path: path.to_owned(),
                error,
            }),
        }
    }

    /// A library by its content; `path` names it in messages.
    ///
    /// # Errors
    /// [`PackError::Platform`], [`PackError::WrongFormat`], [`PackError::CutShort`],
    /// [`PackError::StaleLibrary`].
    pub fn of_bytes(platform: &str, path: &Path, bytes: Vec<u8>) -> Result<Library, PackError> {
        let platform = Platform::named(platform)?;
        let path = path.to_owned();
        if !(platform.is_format)(&bytes) {
            return Err(PackError::WrongFormat {
                path,
                platform: platform.name,
                expected: platform.format,
            });
        }
        let came = bytes.len() as u64;
        if let Some(expected) = whole::length(&bytes).filter(|expected| *expected > came) {
            return Err(PackError::CutShort {
                path,
                expected,
                came,
            });
        }
        let mut windows = bytes.windows(STAMP.len());
        if !windows.any(|window| window == STAMP.as_bytes()) {
            return Err(PackError::StaleLibrary {
                path,
                expected: STAMP,
            });
        }
        Ok(Library {
            platform,
            path,
            bytes,
        })
    }

    /// The library of a `PLATFORM=FILE`.
    ///
    /// # Errors
    /// [`PackError::BinaryForm`], and as [`Library::read`].
    pub fn named(text: &str) -> Result<Library, PackError> {
        let (platform, path) = text.split_once('=').ok_or_else(|| PackError::BinaryForm {
            came: text.to_owned(),
        })?;
        Library::read(platform, Path::new(path))
    }

    /// The library for this machine: `IWAN_FMU_LIBRARY`, else `../fmu/release/` seen from the
    /// program's folder, where the build command leaves it, else `IwanJoint.so` beside the program.
    ///
    /// # Errors
    /// [`PackError::NoLibrary`] with all places looked at, and as [`Library::read`].
    pub fn of_this_machine(version: FmiVersion) -> Result<Library, PackError> {
        let platform = Platform::of_this_machine(version)?.name;
        if let Some(path) = std::env::var_os(VARIABLE) {
            return Library::read(platform, Path::new(&path));
        }
        let program = std::env::current_exe().unwrap_or_default();
        let folder = program.parent().unwrap_or(Path::new("."));
        let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        let built = folder
            .with_file_name("fmu")
            .join("release")
            .join(format!("{prefix}iwan{suffix}"));
        let looked = vec![built, folder.join(format!("IwanJoint{suffix}"))];
        match looked.iter().find(|path| path.is_file()) {
            Some(path) => Library::read(platform, path),
            None => Err(PackError::NoLibrary { looked }),
        }
    }

    /// Name inside an archive: the model identifier without `lib`. FMI 3.0 calls the folders
    /// `x86_64-windows` and the like.
    pub fn entry(&self, version: FmiVersion) -> String {
        let (folder, suffix) = (self.platform.folder(version), self.platform.suffix);
        format!("binaries/{folder}/{MODEL_IDENTIFIER}.{suffix}")
    }
}
