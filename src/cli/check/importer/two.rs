//! An instance of FMI 2.0 in the `fmi` crate.

use super::unit::{Refused, Unit};
use fmi::fmi2::instance::{CoSimulation, Common, InstanceCS};
use fmi::traits::FmiStatus;

impl Unit for InstanceCS {
    fn start(&mut self, time: f64, input: u32, value: f64) -> Result<(), Refused> {
        self.setup_experiment(None, time, None)
            .map_err(|error| Refused::new("fmi2SetupExperiment", error))?;
        self.enter_initialization_mode()
            .map_err(|error| Refused::new("fmi2EnterInitializationMode", error))?;
        self.set(input, value)?;
        self.exit_initialization_mode()
            .map(|_| ())
            .map_err(|error| Refused::new("fmi2ExitInitializationMode", error))
    }

    fn set(&mut self, input: u32, value: f64) -> Result<(), Refused> {
        self.set_real(&[input], &[value])
            .map(|_| ())
            .map_err(|error| Refused::new(format!("fmi2SetReal to {value}"), error))
    }

    fn step(&mut self, from: f64, size: f64) -> Result<(), Refused> {
        let call = || format!("fmi2DoStep from {from} s by {size} s");
        self.do_step(from, size, true)
            .map(|_| ())
            .map_err(|error| Refused::new(call(), error))
    }

    fn read(&mut self, references: &[u32]) -> Result<Vec<f64>, Refused> {
        let mut values = vec![f64::NAN; references.len()];
        self.get_real(references, &mut values)
            .map_err(|error| Refused::new("fmi2GetReal", error))?;
        Ok(values)
    }

    fn reset(&mut self) -> Result<(), Refused> {
        Common::reset(self)
            .map(|_| ())
            .map_err(|error| Refused::new("fmi2Reset", error))
    }

    fn save(&mut self) -> Result<Option<Vec<u8>>, Refused> {
        let state = self
            .get_fmu_state()
            .map_err(|error| Refused::new("fmi2GetFMUstate", error))?;
        self.serialize_fmu_state(&state)
            .map(Some)
            .map_err(|error| Refused::new("fmi2SerializeFMUstate", error))
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), Refused> {
        let state = self
            .deserialize_fmu_state(bytes)
            .map_err(|error| Refused::new("fmi2DeSerializeFMUstate", error))?;
        FmiStatus::ok(self.set_fmu_state(&state))
            .map(|_| ())
            .map_err(|error| Refused::new("fmi2SetFMUstate", error))
    }
}
