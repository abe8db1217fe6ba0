//! What the archive's folder `resources` holds: the joint.

use super::location;
use super::logger::Standard;
use super::refusal::Refusal;
use crate::joint::{Drive, Joint};
use crate::saved;
use crate::variables::{drive_of, guid};
use std::path::PathBuf;

/// The joint of an archive and the drive for which it was exported.
#[derive(Debug)]
pub struct Bundle {
    /// The joint as exported.
    pub joint: Joint,
    /// Which quantity is the input.
    pub drive: Drive,
    /// GUID of joint and drive; saved states carry it.
    pub guid: String,
}

impl Bundle {
    /// Reads `joint.json` at the location and holds the GUID of the XML against it; refusals name
    /// the arguments as the host's standard does.
    pub fn read(standard: Standard, location: &str, came: &str) -> Result<Bundle, Refusal> {
        let (path, text) = joint_json(standard.resources(), location)?;
        let drive = drive_of(&text, came).ok_or_else(|| Refusal::WrongGuid {
            argument: standard.token(),
            force_driven: guid(&text, Drive::Force),
            displacement_driven: guid(&text, Drive::Displacement),
            came: came.to_owned(),
        })?;
        let joint = saved::read(&text, &path.display().to_string())?.joint;
        Ok(Bundle {
            joint,
            drive,
            guid: came.to_owned(),
        })
    }
}

/// Path and text of the first `joint.json` that can be read.
fn joint_json(argument: &'static str, location: &str) -> Result<(PathBuf, String), Refusal> {
    let mut refusal = Refusal::NoLocation { argument };
    let folders = location::folders(location);
    for folder in folders.map_err(|error| Refusal::Location { argument, error })? {
        let path = folder.join("joint.json");
        match std::fs::read_to_string(&path) {
            Ok(text) => return Ok((path, text)),
            Err(error) => refusal = Refusal::Unreadable { path, error },
        }
    }
    Err(refusal)
}
