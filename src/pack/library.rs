//! Where the FMU's shared library comes from, and that it is the right one.

use super::{FmiVersion, PackError};
use crate::variables::STAMP;
use std::path::{Path, PathBuf};

/// How the library is built; `iwan export` finds it where this leaves it.
pub const BUILD_COMMAND: &str =
    "cargo build --release --lib --no-default-features --target-dir target/fmu";
/// Environment variable that names a library for this machine's platform.
pub const VARIABLE: &str = "IWAN_FMU_LIBRARY";
/// Platform folders: those that FMI 2.0 names, and Linux on ARM by its name in FMI 3.0.
pub const PLATFORMS: [&str; 7] = [
    "linux64",
    "win64",
    "darwin64",
    "linux32",
    "win32",
    "darwin32",
    "aarch64-linux",
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
    /// [`PackError::UnreadableLibrary`], and as [`Library::of_bytes`].
    pub fn read(platform: &str, path: &Path) -> Result<Library, PackError> {
        known(platform)?;
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
    /// [`PackError::Platform`], [`PackError::WrongFormat`], [`PackError::StaleLibrary`].
    pub fn of_bytes(platform: &str, path: &Path, bytes: Vec<u8>) -> Result<Library, PackError> {
        let platform = known(platform)?;
        let path = path.to_owned();
        let (expected, is_format) = format(platform);
        if !is_format(&bytes) {
            return Err(PackError::WrongFormat {
                path,
                platform,
                expected,
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

    /// Name inside an archive: the model identifier without `lib`. FMI 3.0 calls the folders
    /// `x86_64-windows` and the like.
    pub fn entry(&self, version: FmiVersion) -> String {
        let folder = match (version, self.platform) {
            (FmiVersion::Three, "linux64") => "x86_64-linux",
            (FmiVersion::Three, "win64") => "x86_64-windows",
            (FmiVersion::Three, "darwin64") => "x86_64-darwin",
            (FmiVersion::Three, "linux32") => "x86-linux",
            (FmiVersion::Three, "win32") => "x86-windows",
            (FmiVersion::Three, "darwin32") => "x86-darwin",
            (_, platform) => platform,
        };
        let suffix = match &self.platform[..3] {
            "win" => "dll",
            "dar" => "dylib",
            _ => "so",
        };
        let name = crate::variables::MODEL_IDENTIFIER;
        format!("binaries/{folder}/{name}.{suffix}")
    }
}

fn known(platform: &str) -> Result<&'static str, PackError> {
    let mut names = PLATFORMS.into_iter();
    names
        .find(|&known| known == platform)
        .ok_or_else(|| PackError::Platform {
            came: platform.to_owned(),
        })
}

/// Platform folder of this machine.
fn this_platform() -> Result<&'static str, PackError> {
    use std::env::consts::{ARCH, OS};
    match (OS, ARCH) {
        ("linux", "x86_64") => Ok("linux64"),
        ("linux", "x86") => Ok("linux32"),
        ("linux", "aarch64") => Ok("aarch64-linux"),
        ("windows", "x86_64") => Ok("win64"),
        ("windows", "x86") => Ok("win32"),
        // A library for both processors of the Mac goes by the older one's name.
        ("macos", _) => Ok("darwin64"),
        _ => Err(PackError::Platform {
            came: format!("{ARCH}-{OS}"),
        }),
    }
}

/// Format of a platform's libraries, in words and as a test of the file.
fn format(platform: &str) -> (&'static str, fn(&[u8]) -> bool) {
    match platform {
        "linux64" => ("a 64-bit ELF library for x86-64", |bytes| {
            is_elf(bytes, 2, 62)
        }),
        "linux32" => ("a 32-bit ELF library for x86", |bytes| is_elf(bytes, 1, 3)),
        "aarch64-linux" => ("a 64-bit ELF library for ARM", |bytes| {
            is_elf(bytes, 2, 183)
        }),
        "win64" => ("a PE library for x86-64", |bytes| is_pe(bytes, 0x8664)),
        "win32" => ("a PE library for x86", |bytes| is_pe(bytes, 0x014c)),
        _ => ("a Mach-O library", |bytes| {
            bytes.starts_with(b"\xcf\xfa\xed\xfe")
                || bytes.starts_with(b"\xce\xfa\xed\xfe")
                || bytes.starts_with(b"\xca\xfe\xba\xbe")
        }),
    }
}

/// ELF of a class (1: 32 bits, 2: 64 bits) and a machine, little-endian.
fn is_elf(bytes: &[u8], class: u8, machine: u16) -> bool {
    bytes.starts_with(b"\x7fELF")
        && bytes.get(4) == Some(&class)
        && bytes.get(18..20) == Some(&machine.to_le_bytes()[..])
}

/// PE of a machine; byte 60 holds where the head is.
fn is_pe(bytes: &[u8], machine: u16) -> bool {
    let head = || {
        let place = bytes.get(60..64)?.try_into().ok().map(u32::from_le_bytes)?;
        let place = usize::try_from(place).ok()?;
        bytes.get(place..place.checked_add(6)?)
    };
    let expected = [&b"PE\0\0"[..], &machine.to_le_bytes()].concat();
    bytes.starts_with(b"MZ") && head() == Some(&expected[..])
}
