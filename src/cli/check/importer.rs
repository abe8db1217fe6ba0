//! An archive behind the `fmi` crate's importer.

use super::load::Load;
use super::measured::Measured;
use super::validation::{Validation, validate};
use super::verdict::{Difference, Verdict};
use crate::cli::BadInput;
use crate::joint::{Drive, Joint, Output, Simulation};
use crate::saved;
use crate::variables::{Causality, Place, Signal, Variable, Variables, drive_of};
use fmi::fmi2::import::Fmi2Import;
use fmi::fmi2::instance::{CoSimulation, Common, InstanceCS};
use fmi::import;
use fmi::traits::FmiImport;
use std::path::Path;

/// An archive, unpacked and read.
#[derive(Debug)]
pub struct Archive {
    import: Fmi2Import,
    shown: String,
    joint: Joint,
    drive: Drive,
    validation: Validation,
    input: Variable,
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
        let import: Fmi2Import = import::from_path(path)
            .map_err(|error| refuse(format!("is no FMI 2.0 archive: {error}")))?;
        let file = import.resource_path().join("joint.json");
        let text = std::fs::read_to_string(file)
            .map_err(|error| refuse(format!("resources/joint.json: {error}")))?;
        let joint = saved::read(&text, &format!("{shown}/resources/joint.json"))?.joint;
        let drive = drive_of(&text, &import.model_description().guid).ok_or_else(|| {
            refuse("the GUID in modelDescription.xml is not that of resources/joint.json".into())
        })?;
        let variables = Variables::of(&joint, drive)?;
        let validation = validate(path, &joint, &variables);
        let signals = variables.signals;
        let mut answers = Vec::new();
        let mut input = None;
        for variable in signals {
            match (variable.place, variable.causality) {
                (_, Causality::Input) => input = Some(variable),
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
        let experiment = self
            .import
            .model_description()
            .default_experiment
            .as_ref()?;
        experiment.step_size.filter(|step| *step > 0.0)
    }

    /// The joint that the archive carries.
    pub fn joint(&self) -> &Joint {
        &self.joint
    }

    /// The quantity that the archive is driven in.
    pub fn drive(&self) -> Drive {
        self.drive
    }

    /// Runs archive and joint side by side. Halfway the archive's state is saved, serialized, and
    /// the second half is run twice from it.
    ///
    /// # Errors
    /// [`BadInput`] where the archive refuses a call; [`crate::joint::JointError`] where the joint
    /// refuses the load.
    pub fn compare(&self, load: &Load) -> anyhow::Result<Verdict> {
        let expected = self.simulate(load)?;
        let mut unit = self.instance(load)?;
        let half = load.time.len() / 2;
        let mut rows = vec![self.read(&mut unit, load.time[0])?];
        for row in 1..half.max(1) {
            rows.push(self.step(&mut unit, load, row)?);
        }
        let state = unit
            .get_fmu_state()
            .map_err(|error| self.refused("fmi2GetFMUstate", error))?;
        let bytes = unit
            .serialize_fmu_state(&state)
            .map_err(|error| self.refused("fmi2SerializeFMUstate", error))?;
        let first: Vec<_> = self.second_half(&mut unit, load, half)?;
        let state = unit
            .deserialize_fmu_state(&bytes)
            .map_err(|error| self.refused("fmi2DeSerializeFMUstate", error))?;
        let put_back = unit.set_fmu_state(&state);
        fmi::traits::FmiStatus::ok(put_back)
            .map_err(|error| self.refused("fmi2SetFMUstate", error))?;
        let again = self.second_half(&mut unit, load, half)?;
        let state_continues = first == again;
        rows.extend(first);
        let measured = Measured::of(load, self.drive, &expected);
        let differences = self
            .answers
            .iter()
            .enumerate()
            .map(|(index, (signal, variable))| {
                let pairs = rows.iter().zip(&expected);
                let pairs = pairs.map(|(row, output)| (row[index], signal.of(output)));
                difference(variable, pairs)
            });
        Ok(Verdict {
            samples: rows.len(),
            input: match self.drive {
                Drive::Force => "force",
                Drive::Displacement => "displacement",
            },
            differences: differences.collect(),
            state_continues,
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

    fn instance(&self, load: &Load) -> Result<InstanceCS, BadInput> {
        let mut unit = self
            .import
            .instantiate_cs("check", false, false)
            .map_err(|error| self.refused("fmi2Instantiate", error))?;
        unit.setup_experiment(None, load.time[0], None)
            .map_err(|error| self.refused("fmi2SetupExperiment", error))?;
        unit.enter_initialization_mode()
            .map_err(|error| self.refused("fmi2EnterInitializationMode", error))?;
        self.set(&mut unit, load.input[0])?;
        unit.exit_initialization_mode()
            .map_err(|error| self.refused("fmi2ExitInitializationMode", error))?;
        Ok(unit)
    }

    fn second_half(
        &self,
        unit: &mut InstanceCS,
        load: &Load,
        half: usize,
    ) -> Result<Vec<Vec<f64>>, BadInput> {
        (half.max(1)..load.time.len())
            .map(|row| self.step(unit, load, row))
            .collect()
    }

    /// One step to the time of a row, under the input of that row.
    fn step(&self, unit: &mut InstanceCS, load: &Load, row: usize) -> Result<Vec<f64>, BadInput> {
        let (from, to) = (load.time[row - 1], load.time[row]);
        self.set(unit, load.input[row])?;
        unit.do_step(from, to - from, true)
            .map_err(|error| self.refused(&format!("fmi2DoStep from {from} s to {to} s"), error))?;
        self.read(unit, to)
    }

    fn set(&self, unit: &mut InstanceCS, value: f64) -> Result<(), BadInput> {
        unit.set_real(&[self.input.reference], &[value])
            .map(|_| ())
            .map_err(|error| self.refused(&format!("fmi2SetReal to {value}"), error))
    }

    fn read(&self, unit: &mut InstanceCS, time: f64) -> Result<Vec<f64>, BadInput> {
        let references: Vec<_> = self
            .answers
            .iter()
            .map(|(_, answer)| answer.reference)
            .collect();
        let mut values = vec![f64::NAN; references.len()];
        unit.get_real(&references, &mut values)
            .map_err(|error| self.refused(&format!("fmi2GetReal at {time} s"), error))?;
        Ok(values)
    }

    fn refused(&self, call: &str, error: impl std::fmt::Display) -> BadInput {
        BadInput(format!("{}: {call}: {error}", self.shown))
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
