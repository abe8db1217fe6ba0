//! Platforms: their folders in an archive and the form of their libraries.

use super::{FmiVersion, PackError};

/// A platform that a library can be for.
#[derive(Debug)]
pub struct Platform {
    /// Folder in FMI 2.0, and the name on the command line.
    pub name: &'static str,
    /// Folder in FMI 3.0.
    folder_3: &'static str,
    /// How the library's name ends.
    pub suffix: &'static str,
    /// Its format in words.
    pub format: &'static str,
    /// Whether a file has that format.
    pub is_format: fn(&[u8]) -> bool,
}

/// Those that FMI 2.0 names, and ARM by its names in FMI 3.0: FMI 2.0 has none for it.
pub const PLATFORMS: [Platform; 8] = [
    Platform {
        name: "linux64",
        folder_3: "x86_64-linux",
        suffix: "so",
        format: "a 64-bit ELF library for x86-64",
        is_format: |bytes| is_elf(bytes, 2, 62),
    },
    Platform {
        name: "win64",
        folder_3: "x86_64-windows",
        suffix: "dll",
        format: "a PE library for x86-64",
        is_format: |bytes| is_pe(bytes, 0x8664),
    },
    Platform {
        name: "darwin64",
        folder_3: "x86_64-darwin",
        suffix: "dylib",
        format: MACH_O,
        is_format: is_mach_o,
    },
    Platform {
        name: "linux32",
        folder_3: "x86-linux",
        suffix: "so",
        format: "a 32-bit ELF library for x86",
        is_format: |bytes| is_elf(bytes, 1, 3),
    },
    Platform {
        name: "win32",
        folder_3: "x86-windows",
        suffix: "dll",
        format: "a PE library for x86",
        is_format: |bytes| is_pe(bytes, 0x014c),
    },
    Platform {
        name: "darwin32",
        folder_3: "x86-darwin",
        suffix: "dylib",
        format: MACH_O,
        is_format: is_mach_o,
    },
    Platform {
        name: "aarch64-linux",
        folder_3: "aarch64-linux",
        suffix: "so",
        format: "a 64-bit ELF library for ARM",
        is_format: |bytes| is_elf(bytes, 2, 183),
    },
    Platform {
        name: "aarch64-darwin",
        folder_3: "aarch64-darwin",
        suffix: "dylib",
        format: MACH_O,
        is_format: is_mach_o,
    },
];

impl Platform {
    /// Folder under `binaries/`.
    pub fn folder(&self, version: FmiVersion) -> &'static str {
        match version {
            FmiVersion::Two => self.name,
            FmiVersion::Three => self.folder_3,
        }
    }

    /// The platform of a name.
    ///
    /// # Errors
    /// [`PackError::Platform`].
    pub fn named(name: &str) -> Result<&'static Platform, PackError> {
        PLATFORMS
            .iter()
            .find(|platform| platform.name == name)
            .ok_or_else(|| PackError::Platform {
                came: name.to_owned(),
            })
    }

    /// The platform of a folder under `binaries/`; `None` where the version names none such.
    pub fn of_folder(version: FmiVersion, folder: &str) -> Option<&'static Platform> {
        let mut platforms = PLATFORMS.iter();
        platforms.find(|platform| platform.folder(version) == folder)
    }

    /// The platform of this machine.
    ///
    /// # Errors
    /// [`PackError::Platform`] where FMI names none for it.
    pub fn of_this_machine(version: FmiVersion) -> Result<&'static Platform, PackError> {
        use std::env::consts::{ARCH, OS};
        Platform::named(match (OS, ARCH, version) {
            ("linux", "x86_64", _) => "linux64",
            ("linux", "x86", _) => "linux32",
            ("linux", "aarch64", _) => "aarch64-linux",
            ("windows", "x86_64", _) => "win64",
            ("windows", "x86", _) => "win32",
            ("macos", "aarch64", FmiVersion::Three) => "aarch64-darwin",
            // In FMI 2.0 a library for either processor of the Mac goes by the older one's name.
            ("macos", _, _) => "darwin64",
            _ => {
                let came = format!("{ARCH}-{OS}");
                return Err(PackError::Platform { came });
            }
        })
    }
}

const MACH_O: &str = "a Mach-O library";

fn is_mach_o(bytes: &[u8]) -> bool {
    let heads = [
        b"\xcf\xfa\xed\xfe",
        b"\xce\xfa\xed\xfe",
        b"\xca\xfe\xba\xbe",
    ];
    heads.iter().any(|head| bytes.starts_with(*head))
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
