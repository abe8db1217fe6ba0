//! An instance of FMI 2.0 in the `fmi` crate.

use super::unit::{Refused, Unit};
use fmi::fmi2::instance::{CoSimulation, Common, InstanceCS};
use fmi::traits::FmiStatus;
use std::fmt::Display;

impl Unit for InstanceCS {
    fn enter_initialization(&mut self, time: f64) -> Result<(), Refused> {
        let set_up = self.setup_experiment(None, time, None);
        answered("fmi2SetupExperiment", set_up)?;
        let entered = Common::enter_initialization_mode(self);
        answered("fmi2EnterInitializationMode", entered).map(|_| ())
    }

    fn exit_initialization(&mut self) -> Result<(), Refused> {
        let exited = Common::exit_initialization_mode(self);
        answered("fmi2ExitInitializationMode", exited).map(|_| ())
    }

    fn set(&mut self, input: u32, value: f64) -> Result<(), Refused> {
        let set = self.set_real(&[input], &[value]);
        answered(format!("fmi2SetReal to {value:?}"), set).map(|_| ())
    }

    fn step(&mut self, from: f64, size: f64) -> Result<(), Refused> {
        let stepped = self.do_step(from, size, true);
        answered(format!("fmi2DoStep from {from} s by {size} s"), stepped).map(|_| ())
    }

    fn read(&mut self, references: &[u32]) -> Result<Vec<f64>, Refused> {
        let mut values = vec![f64::NAN; references.len()];
        answered("fmi2GetReal", self.get_real(references, &mut values))?;
        Ok(values)
    }

    fn reset(&mut self) -> Result<(), Refused> {
        answered("fmi2Reset", Common::reset(self)).map(|_| ())
    }

    fn save(&mut self) -> Result<Vec<u8>, Refused> {
        let state = answered("fmi2GetFMUstate", self.get_fmu_state())?;
        answered("fmi2SerializeFMUstate", self.serialize_fmu_state(&state))
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), Refused> {
        let state = answered("fmi2DeSerializeFMUstate", self.deserialize_fmu_state(bytes))?;
        let set = FmiStatus::ok(self.set_fmu_state(&state));
        answered("fmi2SetFMUstate", set).map(|_| ())
    }
}

fn answered<T>(call: impl Into<String>, answer: Result<T, impl Display>) -> Result<T, Refused> {
    answer.map_err(|error| Refused::new(call, error))
}
