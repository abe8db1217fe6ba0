//! The .fmu archive: modelDescription.xml, documentation, the joint, the shared libraries.

mod date;
mod display_unit;
mod documentation;
mod error;
mod experiment;
mod library;
mod licence;
mod model_description;
mod model_description_3;
mod nominal;
mod platform;
pub mod terminals;
mod unit;
mod version;
mod whole;

pub use date::date_time;
pub use error::PackError;
pub use experiment::Experiment;
pub use library::{BUILD_COMMAND, Library, VARIABLE};
pub use licence::LINKED;
pub use nominal::Nominal;
pub use platform::{PLATFORMS, Platform};
pub use version::FmiVersion;

use crate::joint::{Drive, Joint};
use crate::saved;
use crate::variables::{Variables, guid};
use std::io::{Cursor, Write};
use zip::write::{SimpleFileOptions, ZipWriter};

/// The icon: a joint between two bodies, and its hysteresis loop. Drawn by scripts/icon.py.
pub const ICON: &[u8] = include_bytes!("icon.png");

/// The entries of an archive; the same joint, drive and libraries give the same bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Archive {
    entries: Vec<(String, Vec<u8>)>,
}

impl Archive {
    /// Makes the archive of the text of a joint.json; `file` only names it in messages.
    ///
    /// # Errors
    /// A text that is no joint, a joint that FMI variables cannot show, two libraries for one
    /// platform.
    pub fn new(
        joint_json: &str,
        file: &str,
        drive: Drive,
        libraries: &[Library],
    ) -> Result<Archive, PackError> {
        Archive::of_version(FmiVersion::Two, joint_json, file, drive, libraries)
    }

    /// As [`Archive::new`], for a version of FMI.
    ///
    /// # Errors
    /// As [`Archive::new`].
    pub fn of_version(
        version: FmiVersion,
        joint_json: &str,
        file: &str,
        drive: Drive,
        libraries: &[Library],
    ) -> Result<Archive, PackError> {
        let saved = saved::read(joint_json, file)?;
        let variables = Variables::of(&saved.joint, drive)?;
        check_starts(&variables, &saved.joint)?;
        check_platforms(libraries)?;
        let guid = guid(joint_json, drive);
        let entry = |name: &str, bytes: std::io::Result<Vec<u8>>| match bytes {
            Ok(bytes) => Ok((name.to_owned(), bytes)),
            Err(error) => Err(PackError::Entry {
                name: name.to_owned(),
                error,
            }),
        };
        let xml = match version {
            FmiVersion::Two => model_description::xml(&saved, drive, &variables, &guid),
            FmiVersion::Three => model_description_3::xml(&saved, drive, &variables, &guid),
        };
        let mut entries = vec![entry("modelDescription.xml", xml)?];
        match version {
            FmiVersion::Two => entries.push(entry("model.png", Ok(ICON.to_vec()))?),
            FmiVersion::Three => {
                entries.push(entry(terminals::ENTRY, terminals::xml())?);
                entries.push(entry(terminals::ICON_ENTRY, Ok(ICON.to_vec()))?);
            }
        }
        let page = documentation::html(version, &saved, drive, &variables, &guid);
        for (name, bytes) in [
            ("documentation/index.html", page.into_bytes()),
            (
                "documentation/licenses/license.txt",
                licence::text().into_bytes(),
            ),
            ("resources/joint.json", joint_json.as_bytes().to_vec()),
        ] {
            entries.push(entry(name, Ok(bytes))?);
        }
        entries.extend(
            libraries
                .iter()
                .map(|library| (library.entry(version), library.bytes.clone())),
        );
        Ok(Archive { entries })
    }

    /// The archive as a zip file.
    ///
    /// # Errors
    /// [`PackError::Entry`] where the format cannot hold an entry, e.g. one beyond 4 GB.
    pub fn bytes(&self) -> Result<Vec<u8>, PackError> {
        let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
        for (name, bytes) in &self.entries {
            let permissions = if name.starts_with("binaries/") {
                0o755
            } else {
                0o644
            };
            // The time of an entry stays at the format's zero: equal content, equal archive.
            let options = SimpleFileOptions::default()
                .compression_method(zip::CompressionMethod::Deflated)
                .last_modified_time(zip::DateTime::default())
                .unix_permissions(permissions);
            let refuse = |error: std::io::Error| PackError::Entry {
                name: name.clone(),
                error,
            };
            zip.start_file(name.as_str(), options)
                .map_err(|e| refuse(e.into()))?;
            zip.write_all(bytes).map_err(refuse)?;
        }
        let refuse = |error: zip::result::ZipError| PackError::Entry {
            name: "the archive's directory".to_owned(),
            error: error.into(),
        };
        Ok(zip.finish().map_err(refuse)?.into_inner())
    }

    /// Names of the entries, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().map(|(name, _)| name.as_str())
    }
}

fn check_starts(variables: &Variables, joint: &Joint) -> Result<(), PackError> {
    for variable in &variables.parameters {
        let value = variable.start(joint).unwrap_or_default();
        if !(variable.lower..=variable.upper).contains(&value) {
            return Err(PackError::StartOutOfBounds {
                name: variable.name.clone(),
                value,
                lower: variable.lower,
                upper: variable.upper,
            });
        }
    }
    Ok(())
}

fn check_platforms(libraries: &[Library]) -> Result<(), PackError> {
    for (index, library) in libraries.iter().enumerate() {
        let twin = libraries[..index]
            .iter()
            .find(|other| other.platform.name == library.platform.name);
        if let Some(other) = twin {
            return Err(PackError::PlatformTwice {
                platform: library.platform.name,
                first: other.path.clone(),
                second: library.path.clone(),
            });
        }
    }
    Ok(())
}

/// The joint in one sentence, e.g. `Iwan joint, four_parameter density, driven in force, with
/// pinning`.
fn description(joint: &Joint, drive: Drive) -> String {
    let drive = match drive {
        Drive::Force => "force",
        Drive::Displacement => "displacement",
    };
    let causes: Vec<_> = joint
        .effects
        .iter()
        .map(|acting| acting.effect.name())
        .collect();
    let with = if causes.is_empty() { "" } else { ", with " };
    let family = joint.density.family();
    format!(
        "Iwan joint, {family} density, driven in {drive}{with}{}",
        causes.join(", ")
    )
}
