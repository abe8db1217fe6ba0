//! What several subcommands read, and what they say of it.

use super::BadInput;
use super::fewest::Fewest;
use crate::identify::table::{Known, at_resonance};
use crate::joint::Joint;
use crate::joint::error::shown;
use crate::read::{self, Loaded, Options, ReadError};
use crate::record::{AmplitudeTable, Record};
use crate::saved::SavedJoint;
use std::path::{Path, PathBuf};

/// How to read files whose header does not say what they hold.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct Foreign {
    /// Columns of a foreign file, counted from 1 or by header: `force=2,displacement=1,time=3`
    #[arg(long, value_name = "QUANTITY=COLUMN,…")]
    columns: Option<String>,
    /// Units, where the header has none or wrong ones: `force=kN,displacement=mm`
    #[arg(long, value_name = "QUANTITY=UNIT,…")]
    units: Option<String>,
}

impl Foreign {
    /// The options taken apart.
    ///
    /// # Errors
    /// [`ReadError::Option`].
    pub fn options(&self) -> Result<Options, ReadError> {
        Options::from_arguments(self.columns.as_deref(), self.units.as_deref())
    }
}

/// The measured records of one joint.
#[derive(Debug, Clone, clap::Args)]
pub struct Records {
    /// Tests of one joint, a CSV file each: time, force, displacement; or an amplitude table
    #[arg(required = true, value_name = "RECORD")]
    pub files: Vec<PathBuf>,
    /// How to read them.
    #[command(flatten)]
    pub foreign: Foreign,
}

impl Records {
    /// Reads every file, in order, and says on stderr what was assumed.
    ///
    /// # Errors
    /// [`ReadError`] of the first bad file; [`BadInput`] for one content under two names: a copy
    /// would count as a second test, and as data that no fit has seen; for fewer samples than `fewest`; or
    /// for signs that no joint has.
    pub fn load(&self, fewest: Fewest) -> anyhow::Result<Vec<Loaded>> {
        let options = self.foreign.options()?;
        let mut loaded: Vec<Loaded> = Vec::new();
        for file in &self.files {
            let next = read::file(file, &options)?;
            if let Some(same) = loaded.iter().position(|other| other.sha256 == next.sha256) {
                let (file, same) = (file.display(), self.files[same].display());
                let message = format!("{file}: same content as {same}; give every test once");
                return Err(BadInput(message).into());
            }
            tell_notes(file, &next.notes);
            loaded.push(next);
        }
        let files = self.files.iter().zip(&loaded);
        let histories: Vec<(&Path, &Record)> = files
            .filter_map(|(file, loaded)| Some((file.as_path(), loaded.measurement.history()?)))
            .collect();
        // Of too few samples everything else that can be said is chance.
        fewest.admit(&histories)?;
        super::signs::admit(histories)?;
        Ok(loaded)
    }

    /// The names of the files, for a message about all of them.
    pub fn named(&self) -> String {
        match &self.files[..] {
            [first, _, _, _, ..] => {
                format!("{} and {} more", first.display(), self.files.len() - 1)
            }
            few => few
                .iter()
                .map(|file| file.display().to_string())
                .collect::<Vec<_>>()
                .join(", "),
        }
    }

    /// The files as inputs that no output may replace.
    pub fn paths(&self) -> Vec<&Path> {
        self.files.iter().map(PathBuf::as_path).collect()
    }
}

/// What an amplitude table lacks and the engineer knows.
#[derive(Debug, Clone, Default, clap::Args)]
pub struct BesideTable {
    /// Amplitude tables: stiffness of the joint at small load, where no displacement is kept
    #[arg(long, value_name = "N/m", allow_negative_numbers = true)]
    stiffness: Option<f64>,
    /// Amplitude tables at phase resonance: modal mass, for the joint's own force
    #[arg(long, value_name = "kg", allow_negative_numbers = true)]
    modal_mass: Option<f64>,
}

impl BesideTable {
    /// The values, checked.
    ///
    /// # Errors
    /// [`BadInput`] for a value that is not positive and finite, or both given.
    pub fn known(&self) -> Result<Known, BadInput> {
        for (option, value) in [
            ("--stiffness", self.stiffness),
            ("--modal-mass", self.modal_mass),
        ] {
            if let Some(value) = value.filter(|v| !(v.is_finite() && *v > 0.0)) {
                return Err(BadInput(format!(
                    "{option} {}: must be a number above zero",
                    shown(value)
                )));
            }
        }
        if self.stiffness.is_some() && self.modal_mass.is_some() {
            return Err(BadInput(
                "--stiffness and --modal-mass: one follows from the other; give one".to_string(),
            ));
        }
        Ok(Known {
            stiffness: self.stiffness,
            modal_mass: self.modal_mass,
        })
    }

    /// Refuses a value that no file of these has a use for: a joint would be told to rest on it.
    ///
    /// # Errors
    /// [`BadInput`] naming the option, and why.
    pub fn of_use(&self, loaded: &[Loaded]) -> Result<(), BadInput> {
        let tables: Vec<&AmplitudeTable> = loaded
            .iter()
            .filter_map(|loaded| loaded.measurement.table())
            .collect();
        let of_stiffness =
            |table: &&AmplitudeTable| table.displacement_amplitude.is_none() || at_resonance(table);
        let of_mass = |table: &&AmplitudeTable| table.frequency.is_some() && at_resonance(table);
        let unused = |option: &str, why: &str| {
            Err(BadInput(format!(
                "{option}: nothing here has a use for it: {why}; leave it out"
            )))
        };
        const HISTORY: &str = "a time history tells the joint's own force and stiffness";
        match (self.stiffness, self.modal_mass) {
            (Some(_), _) if tables.is_empty() => unused("--stiffness", HISTORY),
            (_, Some(_)) if tables.is_empty() => unused("--modal-mass", HISTORY),
            (Some(_), _) if !tables.iter().any(of_stiffness) => unused(
                "--stiffness",
                "the displacement amplitudes of the table tell it",
            ),
            (_, Some(_)) if !tables.iter().any(of_mass) => unused(
                "--modal-mass",
                "it is for a table with displacement amplitudes and frequencies, taken at phase \
                 resonance, where the loss is force times displacement times pi",
            ),
            _ => Ok(()),
        }
    }
}

/// Says on stderr what was assumed while reading a file.
pub fn tell_notes(file: &Path, notes: &[String]) {
    for note in notes {
        super::output::tell(&format!("{}: {note}", file.display()));
    }
}

/// Reads a joint.json.
///
/// # Errors
/// As [`joint_and_text`].
pub fn joint(file: &Path) -> anyhow::Result<Joint> {
    Ok(joint_and_text(file)?.0)
}

/// Reads a joint.json once, as a pipe can be, and gives its text as well.
///
/// # Errors
/// As [`saved`].
pub fn joint_and_text(file: &Path) -> anyhow::Result<(Joint, String)> {
    let (saved, text) = saved(file)?;
    Ok((saved.joint, text))
}

/// Reads a joint.json with where the joint comes from, and gives its text as well.
///
/// # Errors
/// [`BadInput`] where there is no such text file, [`crate::saved::SavedError`] with the place
/// where it holds no joint.
pub fn saved(file: &Path) -> anyhow::Result<(SavedJoint, String)> {
    let name = file.display().to_string();
    let refuse = |reason: String| BadInput(format!("{name}: {reason}"));
    if file.is_dir() {
        return Err(refuse("this is a folder; name the joint.json in it".to_string()).into());
    }
    let bytes = std::fs::read(file).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => {
            refuse("there is no such file; check the name and the folder".to_string())
        }
        _ => refuse(format!("cannot be read: {error}")),
    })?;
    let text = String::from_utf8(bytes)
        .map_err(|_| refuse("this is no joint.json: not a text in UTF-8".to_string()))?;
    Ok((crate::saved::read(&text, &name)?, text))
}
