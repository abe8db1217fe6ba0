//! An archive behind an independent importer: of FMI 2.0 behind the `fmi` crate, of FMI 3.0 behind
//! `fmi-rs`.

mod import;
mod run;
mod three;
mod two;
mod unit;

use super::load::Load;
use super::measured::Measured;
use super::validation::{Validation, validate};
use super::verdict::{Difference, Verdict};
use crate::cli::BadInput;
use crate::joint::{Drive, Joint, Output, Simulation};
use crate::saved;
use crate::variables::{Causality, Place, Signal, Variable, Variables, drive_of};
use import::Import;
use run::{Driven, Run};
use std::path::Path;
use unit::Refused;

/// An archive, unpacked and read.
pub struct Archive {
    import: Import,
    shown: String,
    joint: Joint,
    drive: Drive,
    validation: Validation,
    input: u32,
    answers: Vec<(Signal, Variable)>,
}

impl Archive {
    /// Unpacks an archive and reads the joint that it carries.
    ///
    /// # Errors
    /// [`BadInput`] where it is no archive of ours; [`saved::SavedError`] where its joint is none.
    pub fn open(path: &Path) -> anyhow::Result<Archive> {
        let shown = path.display().to_string();
        let refuse = |reason: String| BadInput(format!("{shown}: {reason}"));
        let import = Import::open(path)?;
        let file = import.resources().join("joint.json");
        let text = std::fs::read_to_string(file)
            .map_err(|error| refuse(format!("resources/joint.json: {error}")))?;
        let joint = saved::read(&text, &format!("{shown}/resources/joint.json"))?.joint;
        let drive = drive_of(&text, import.token()).ok_or_else(|| {
            refuse("the GUID in modelDescription.xml is not that of resources/joint.json".into())
        })?;
        let variables = Variables::of(&joint, drive)?;
        let validation = validate(path, import.version(), &joint, &variables);
        let mut answers = Vec::new();
        let mut input = None;
        for variable in variables.signals {
            match (variable.place, variable.causality) {
                (_, Causality::Input) => input = Some(variable.reference),
                (Place::Signal(signal), _) => answers.push((signal, variable)),
                _ => {}
            }
        }
        let input = input.ok_or_else(|| refuse("has no input".into()))?;
        Ok(Archive {
            import,
            shown,
            joint,
            drive,
            validation,
            input,
            answers,
        })
    }

    /// What the archive says of itself, held against its joint.
    pub fn validation(&self) -> &Validation {
        &self.validation
    }

    /// The communication step \[s\] that importers take by default, where the archive names one.
    pub fn default_step(&self) -> Option<f64> {
        self.import.default_step().filter(|step| *step > 0.0)
    }

    /// The joint that the archive carries.
    pub fn joint(&self) -> &Joint {
        &self.joint
    }

    /// The quantity that the archive is driven in.
    pub fn drive(&self) -> Drive {
        self.drive
    }

    /// Runs archive and joint side by side; the archive as [`Driven::run`] has it.
    ///
    /// # Errors
    /// [`BadInput`] where the archive refuses a call; [`crate::joint::JointError`] where the joint
    /// refuses the load.
    pub fn compare(&self, load: &Load) -> anyhow::Result<Verdict> {
        if let Some(reason) = &self.validation.unloadable {
            return Err(BadInput(format!("{}: {reason}", self.shown)).into());
        }
        let expected = self.simulate(load)?;
        let run = self
            .run(load)
            .map_err(|refused| BadInput(format!("{}: {refused}", self.shown)))?;
        let measured = Measured::of(load, self.drive, &expected);
        let answers = self.answers.iter().enumerate();
        let differences = answers.map(|(index, (signal, variable))| {
            let pairs = run.rows.iter().zip(&expected);
            let pairs = pairs.map(|(row, output)| (row[index], signal.of(output)));
            difference(variable, pairs)
        });
        Ok(Verdict {
            version: self.import.version(),
            samples: run.rows.len(),
            input: match self.drive {
                Drive::Force => "force",
                Drive::Displacement => "displacement",
            },
            differences: differences.collect(),
            state_continues: run.state_continues,
            reset_repeats: run.reset_repeats,
            measured,
            steps: None,
            validation: self.validation.clone(),
        })
    }

    fn simulate(&self, load: &Load) -> anyhow::Result<Vec<Output>> {
        let mut simulation = Simulation::new(&self.joint, self.drive)?;
        let rows = load.time.iter().zip(&load.input);
        Ok(rows
            .map(|(time, input)| simulation.step(*time, *input))
            .collect::<Result<_, _>>()?)
    }

    fn run(&self, load: &Load) -> Result<Run, Refused> {
        let mut unit = self.import.instance()?;
        let answers = self.answers.iter();
        let references: Vec<_> = answers.map(|(_, answer)| answer.reference).collect();
        let driven = Driven {
            unit: unit.as_mut(),
            load,
            input: self.input,
            answers: &references,
        };
        driven.run()
    }
}

fn difference(variable: &Variable, pairs: impl Iterator<Item = (f64, f64)>) -> Difference {
    let mut largest = 0.0_f64;
    let mut scale = 0.0_f64;
    for (came, expected) in pairs {
        let apart = (came - expected).abs();
        // A NaN must not vanish in a maximum.
        largest = if apart.is_nan() {
            f64::INFINITY
        } else {
            largest.max(apart)
        };
        scale = scale.max(expected.abs());
    }
    Difference {
        name: variable.name.clone(),
        unit: variable.unit,
        largest,
        scale,
    }
}
