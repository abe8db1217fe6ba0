//! An unpacked archive of either version.

use super::unit::{Refused, Unit};
use crate::cli::BadInput;
use crate::pack::FmiVersion;
use fmi::fmi2::import::Fmi2Import;
use fmi::import;
use fmi::schema::MajorVersion;
use fmi::schema::traits::{DefaultExperiment, FmiModelDescription};
use fmi::traits::FmiImport;
use fmi_rs::fmi3::builder::FMU3Builder;
use std::path::{Path, PathBuf};

/// The importers, one for each version. The `fmi` crate has one of FMI 3.0 too, but without saved
/// states, and it takes no `unit`.
pub enum Import {
    /// Of FMI 2.0, in the `fmi` crate.
    Two(Fmi2Import),
    /// Of FMI 3.0, in `fmi-rs`.
    Three(FMU3Builder),
}

impl Import {
    /// Unpacks an archive by the importer of the version that it names.
    ///
    /// # Errors
    /// [`BadInput`] where it is no archive of these versions.
    pub fn open(path: &Path) -> Result<Import, BadInput> {
        let refuse = |error: String| {
            BadInput(format!(
                "{}: is no archive of FMI 2.0 or 3.0: {error}",
                path.display()
            ))
        };
        let version = import::peek_descr_path(path)
            .map_err(|error| error.to_string())
            .and_then(|seen| seen.major_version().map_err(|error| error.to_string()))
            .map_err(refuse)?;
        match version {
            MajorVersion::FMI2 => import::from_path(path)
                .map(Import::Two)
                .map_err(|error| refuse(error.to_string())),
            MajorVersion::FMI3 => FMU3Builder::new(&path)
                .map(|builder| Import::Three(without_events(builder)))
                .map_err(|error| refuse(error.to_string())),
            MajorVersion::FMI1 => Err(refuse("its version is 1.0".into())),
        }
    }

    /// Version of FMI.
    pub fn version(&self) -> FmiVersion {
        match self {
            Import::Two(_) => FmiVersion::Two,
            Import::Three(_) => FmiVersion::Three,
        }
    }

    /// The unpacked resources.
    pub fn resources(&self) -> PathBuf {
        match self {
            Import::Two(import) => import.resource_path(),
            Import::Three(import) => import.unzipdir.path().join("resources"),
        }
    }

    /// GUID of FMI 2.0, instantiation token of FMI 3.0.
    pub fn token(&self) -> &str {
        match self {
            Import::Two(import) => &import.model_description().guid,
            Import::Three(import) => &import.model_description.instantiationToken,
        }
    }

    /// Step size of the default experiment \[s\].
    pub fn default_step(&self) -> Option<f64> {
        match self {
            Import::Two(import) => import.model_description().step_size(),
            Import::Three(import) => {
                let experiment = import.model_description.defaultExperiment.as_ref()?;
                experiment.stepSize.as_ref()?.parse().ok()
            }
        }
    }

    /// An instance; it keeps the library loaded as long as it lives.
    ///
    /// # Errors
    /// [`Refused`] where the library cannot be loaded or refuses the archive.
    pub fn instance(&self) -> Result<Box<dyn Unit>, Refused> {
        let name = "check";
        match self {
            Import::Two(import) => import
                .instantiate_cs(name, false, false)
                .map(|unit| Box::new(unit) as Box<dyn Unit>)
                .map_err(|error| Refused::new("fmi2Instantiate", error)),
            Import::Three(import) => import
                .instantiate_cs(name)
                .map(|unit| Box::new(unit) as Box<dyn Unit>)
                .map_err(|error| Refused::new("fmi3InstantiateCoSimulation", error)),
        }
    }
}

/// The archive declares neither events nor early return: none is asked for.
fn without_events(builder: FMU3Builder) -> FMU3Builder {
    FMU3Builder {
        eventModeUsed: false,
        earlyReturnAllowed: false,
        ..builder
    }
}
