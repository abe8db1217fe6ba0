//! An instance of FMI 3.0 in `fmi-rs`.

use super::unit::{Refused, Unit};
use fmi_rs::fmi3::FMU3;
use fmi_rs::fmi3::types::fmi3Status;
use std::ptr;
use std::sync::Arc;

impl Unit for Arc<FMU3> {
    fn enter_initialization(&mut self, time: f64) -> Result<(), Refused> {
        let entered = self.enterInitializationMode(None, time, None);
        answered("fmi3EnterInitializationMode", entered)
    }

    fn exit_initialization(&mut self) -> Result<(), Refused> {
        answered("fmi3ExitInitializationMode", self.exitInitializationMode())
    }

    fn set(&mut self, input: u32, value: f64) -> Result<(), Refused> {
        let set = self.setFloat64(&[input], &[value]);
        answered(format!("fmi3SetFloat64 to {value:?}"), set)
    }

    /// The archive declares neither events nor early return, so none may come; and the step must
    /// have gone all the way.
    fn step(&mut self, from: f64, size: f64) -> Result<(), Refused> {
        let call = || format!("fmi3DoStep from {from} s by {size} s");
        let (mut event, mut terminate, mut early) = (true, true, true);
        let mut reached = f64::NAN;
        let stepped = self.doStep(
            from,
            size,
            true,
            &mut event,
            &mut terminate,
            &mut early,
            &mut reached,
        );
        answered(call(), stepped)?;
        if event || terminate || early {
            let asked = format!(
                "asks for an event ({event}), the end ({terminate}) or an early return ({early})"
            );
            return Err(Refused::new(call(), asked));
        }
        let expected = from + size;
        // Communication points are sums of steps: rounding is admitted.
        let near = (reached - expected).abs() <= 1e-9 * (expected.abs() + size);
        if near {
            return Ok(());
        }
        let told = format!("reached {reached} s instead of {expected} s");
        Err(Refused::new(call(), told))
    }

    fn read(&mut self, references: &[u32]) -> Result<Vec<f64>, Refused> {
        let mut values = vec![f64::NAN; references.len()];
        answered("fmi3GetFloat64", self.getFloat64(references, &mut values))?;
        Ok(values)
    }

    fn reset(&mut self) -> Result<(), Refused> {
        answered("fmi3Reset", FMU3::reset(self))
    }

    fn save(&mut self) -> Result<Vec<u8>, Refused> {
        let mut state = ptr::null_mut();
        answered("fmi3GetFMUState", self.getFMUState(&mut state))?;
        let mut size = 0;
        let sized = self.serializedFMUStateSize(state, &mut size);
        answered("fmi3SerializedFMUStateSize", sized)?;
        let mut bytes = vec![0; size];
        let written = self.serializeFMUState(state, &mut bytes);
        answered("fmi3SerializeFMUState", written)?;
        answered("fmi3FreeFMUState", self.freeFMUState(&mut state))?;
        Ok(bytes)
    }

    fn restore(&mut self, bytes: &[u8]) -> Result<(), Refused> {
        let mut state = ptr::null_mut();
        let read = self.deserializeFMUState(bytes, &mut state);
        answered("fmi3DeserializeFMUState", read)?;
        answered("fmi3SetFMUState", self.setFMUState(state))?;
        answered("fmi3FreeFMUState", self.freeFMUState(&mut state))
    }
}

/// A warning is no refusal: the values are defined.
fn answered(call: impl Into<String>, status: fmi3Status) -> Result<(), Refused> {
    match status {
        fmi3Status::Ok | fmi3Status::Warning => Ok(()),
        refused => Err(Refused::new(call, format!("{refused:?}"))),
    }
}
