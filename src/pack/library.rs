//! Where the FMU's shared library comes from, and that it is the right one.

use super::PackError;
use crate::variables::STAMP;
use std::path::{Path, PathBuf};

/// How the library is built; `iwan export` finds it where this leaves it.
pub const BUILD_COMMAND: &str =
    "cargo build --release --lib --no-default-features --target-dir target/fmu";
/// Environment variable that names a library for this machine's platform.
pub const VARIABLE: &str = "IWAN_FMU_LIBRARY";
/// Platform folders of FMI 2.0.
pub const PLATFORMS: [&str; 6] = [
    "linux64", "win64", "darwin64", "linux32", "win32", "darwin32",
];

/// One shared library for one platform, checked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Library {
    /// FMI platform folder.
    pub platform: &'static str,
    /// Where it was read from.
    pub path: PathBuf,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl Library {
    /// Reads a library and checks its format and its stamp.
    ///
    /// # Errors
    /// [`PackError::Platform`], [`PackError::UnreadableLibrary`], [`PackError::WrongFormat`],
    /// [`PackError::StaleLibrary`].
    pub fn read(platform: &str, path: &Path) -> Result<Library, PackError> {
        let platform = PLATFORMS
            .into_iter()
            .find(|&known| known == platform)
            .ok_or_else(|| PackError::Platform {
                came: platform.to_owned(),
            })?;
        let path = path.to_owned();
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) => return Err(PackError::UnreadableLibrary { path, error }),
        };
        let (expected, is_format) = format(platform);
        if !is_format(&bytes) {
            return Err(PackError::WrongFormat {
                path,
                platform,
                expected,
            });
        }
        if !bytes
            .windows(STAMP.len())
            .any(|window| window == STAMP.as_bytes())
        {
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
    pub fn of_this_machine() -> Result<Library, PackError> {
        let platform = this_platform()?;
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

    /// Name inside the archive: the model identifier without `lib`.
    pub fn entry(&self) -> String {
        let suffix = match &self.platform[..3] {
            "win" => "dll",
            "dar" => "dylib",
            _ => "so",
        };
        format!(
            "binaries/{}/{}.{suffix}",
            self.platform,
            crate::variables::MODEL_IDENTIFIER
        )
    }
}

/// Platform folder of this machine. FMI 2.0 has none for Linux on ARM; importers look in linux64.
fn this_platform() -> Result<&'static str, PackError> {
    match (std::env::consts::OS, cfg!(target_pointer_width = "64")) {
        ("linux", true) => Ok("linux64"),
        ("linux", false) => Ok("linux32"),
        ("windows", true) => Ok("win64"),
        ("windows", false) => Ok("win32"),
        ("macos", true) => Ok("darwin64"),
        (system, _) => Err(PackError::Platform {
            came: system.to_owned(),
        }),
    }
}

/// Format of a platform's libraries, in words and as a test of the first bytes.
fn format(platform: &str) -> (&'static str, fn(&[u8]) -> bool) {
    match platform {
        "linux64" => ("a 64-bit ELF library", |bytes| {
            bytes.starts_with(b"\x7fELF\x02")
        }),
        "linux32" => ("a 32-bit ELF library", |bytes| {
            bytes.starts_with(b"\x7fELF\x01")
        }),
        "win64" | "win32" => ("a PE library", |bytes| bytes.starts_with(b"MZ")),
        _ => ("a Mach-O library", |bytes| {
            bytes.starts_with(b"\xcf\xfa\xed\xfe")
                || bytes.starts_with(b"\xce\xfa\xed\xfe")
                || bytes.starts_with(b"\xca\xfe\xba\xbe")
        }),
    }
}
