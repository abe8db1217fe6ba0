//! Several inputs at once, all of them or none.

use super::{Drive, JointError, Output, Response, Simulation};
use crate::joint::virgin::VirginCurve;

impl Simulation {
    /// Takes several inputs [N or m] at their times [s], all of them or, on an error, none. Returns
    /// the answers before and after the last of them. Allocates nothing but the error.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn follow(&mut self, way: &[(f64, f64)]) -> Result<[Output; 2], JointError> {
        let (output, started) = (self.output, self.started);
        match &mut self.response {
            // A single step leaves the state as before by itself.
            Response::Extended(_) if way.len() < 2 => (),
            Response::Extended(extended) => extended.keep(),
            // An exact response refuses inputs, never states: it can be asked beforehand.
            Response::Network(network) if self.drive == Drive::Force => {
                let full_slip = network.curve().full_slip_force();
                let beyond = way.iter().find(|(_, force)| force.abs() >= full_slip);
                if let Some(&(_, force)) = beyond {
                    return Err(JointError::BeyondFullSlip { force, full_slip });
                }
            }
            Response::Network(_) | Response::BehindSpring(_) => (),
        }
        let mut from = if started { output.time } else { f64::MIN };
        for &(time, value) in way {
            if !(time.is_finite() && value.is_finite()) {
                return Err(JointError::NotFinite { time, value });
            }
            if time < from {
                return Err(JointError::TimeRunsBack { from, to: time });
            }
            from = time;
        }
        let mut before = output;
        for &(time, input) in way {
            before = self.output;
            if let Err(reason) = self.step(time, input) {
                if let Response::Extended(extended) = &mut self.response
                    && way.len() > 1
                {
                    extended.go_back()?;
                }
                (self.output, self.started) = (output, started);
                return Err(reason);
            }
        }
        Ok([before, self.output])
    }
}
