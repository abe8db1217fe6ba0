//! documentation/licenses/license.txt: under what the archive may be used.

/// Packages whose code is in the shared library, with their licences; compared with what cargo
/// links by tests/fmu_archive.rs.
pub const LINKED: &[(&str, &str)] = &[
    ("itoa", "MIT OR Apache-2.0"),
    ("libc", "MIT OR Apache-2.0"),
    ("libm", "MIT"),
    ("memchr", "Unlicense OR MIT"),
    ("serde_core", "MIT OR Apache-2.0"),
    ("serde_json", "MIT OR Apache-2.0"),
    ("thiserror", "MIT OR Apache-2.0"),
    ("zmij", "MIT"),
];

/// The choice of two licences, the packages inside, and both licences in full.
pub fn text() -> String {
    let linked: String = LINKED
        .iter()
        .map(|(name, licence)| format!("  {name}: {licence}\n"))
        .collect();
    format!(
        "The shared libraries in binaries/ are iwan {version}, licensed under {licence}, at your \
         choice.\nThe joint in resources/joint.json belongs to whoever measured it; nothing here \
         says anything about it.\n\nCode of these packages is in the libraries, and of Rust's \
         standard library (MIT OR Apache-2.0):\n{linked}\n{rule}\n{mit}\n{rule}\n{apache}",
        version = env!("CARGO_PKG_VERSION"),
        licence = env!("CARGO_PKG_LICENSE"),
        rule = "-".repeat(72),
        mit = include_str!("../../LICENSE-MIT"),
        apache = include_str!("../../LICENSE-APACHE"),
    )
}
