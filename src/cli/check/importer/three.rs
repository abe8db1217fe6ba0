//! An instance of FMI 3.0 in the `fmi` crate. Its interface has no saved states.

use super::unit::{Refused, Unit};
use fmi::fmi3::instance::InstanceCS;
use fmi::fmi3::{CoSimulation, Common, GetSet};

impl Unit for InstanceCS {
    fn start(&mut self, time: f64, input: u32, value: f64) -> Result<(), Refused> {
        Common::enter_initialization_mode(self, None, time, None)
            .map_err(|error| Refused::new("fmi3EnterInitializationMode", error))?;
        self.set(input, value)?;
        Common::exit_initialization_mode(self)
            .map(|_| ())
            .map_err(|error| Refused::new("fmi3ExitInitializationMode", error))
    }

    fn set(&mut self, input: u32, value: f64) -> Result<(), Refused> {
        self.set_float64(&[input], &[value])
            .map(|_| ())
            .map_err(|error| Refused::new(format!("fmi3SetFloat64 to {value}"), error))
    }

    /// The archive declares neither events nor early return, so none may come; and the step must
    /// have gone all the way.
    fn step(&mut self, from: f64, size: f64) -> Result<(), Refused> {
        let refused = |answer: String| {
            let call = format!("fmi3DoStep from {from} s by {size} s");
            Refused::new(call, answer)
        };
        let (mut event, mut terminate, mut early) = (true, true, true);
        let mut reached = f64::NAN;
        self.do_step(
            from,
            size,
            true,
            &mut event,
            &mut terminate,
            &mut early,
            &mut reached,
        )
        .map_err(|error| refused(error.to_string()))?;
        if event || terminate || early {
            return Err(refused(format!(
                "asks for an event ({event}), the end ({terminate}) or an early return ({early})"
            )));
        }
        let expected = from + size;
        // Communication points are sums of steps: rounding is admitted.
        let near = (reached - expected).abs() <= 1e-9 * (expected.abs() + size);
        if near {
            return Ok(());
        }
        Err(refused(format!(
            "reached {reached} s instead of {expected} s"
        )))
    }

    fn read(&mut self, references: &[u32]) -> Result<Vec<f64>, Refused> {
        let mut values = vec![f64::NAN; references.len()];
        self.get_float64(references, &mut values)
            .map_err(|error| Refused::new("fmi3GetFloat64", error))?;
        Ok(values)
    }

    fn reset(&mut self) -> Result<(), Refused> {
        Common::reset(self)
            .map(|_| ())
            .map_err(|error| Refused::new("fmi3Reset", error))
    }

    fn save(&mut self) -> Result<Option<Vec<u8>>, Refused> {
        Ok(None)
    }

    fn restore(&mut self, _: &[u8]) -> Result<(), Refused> {
        let answer = "this importer has no saved states";
        Err(Refused::new("fmi3SetFMUState", answer))
    }
}
