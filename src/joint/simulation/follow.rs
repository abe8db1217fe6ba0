//! Several inputs at once, all of them or none.

use super::{Drive, JointError, Output, Response, Simulation};
use crate::joint::virgin::VirginCurve;

/// Inputs [N or m] beyond which an exact response is not asked. The work of larger ones may be no
/// finite number, and a dissipation that is infinite stays so.
const FARTHEST: f64 = 1e100;

impl Simulation {
    /// Refuses what can be told from the input alone: an exact response refuses inputs, never states,
    /// and one with effects finds out by itself how far it reaches.
    pub(super) fn admit(&self, time: f64, input: f64) -> Result<(), JointError> {
        for value in [time, input] {
            if !value.is_finite() {
                return Err(JointError::NotFinite { time, value });
            }
        }
        let force = input;
        match &self.response {
            Response::Extended(_) => return Ok(()),
            Response::Network(network) if self.drive == Drive::Force => {
                let full_slip = network.curve().full_slip_force();
                if force.abs() >= full_slip {
                    return Err(JointError::BeyondFullSlip { force, full_slip });
                }
            }
            Response::Network(_) | Response::BehindSpring(_) => (),
        }
        if input.abs() > FARTHEST {
            return Err(JointError::OutOfReach { time, value: input });
        }
        Ok(())
    }

    /// Takes several inputs [N or m] at their times [s], all of them or, on an error, none. Returns
    /// the answers before and after the last of them. Allocates nothing but the error.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn follow(&mut self, way: &[(f64, f64)]) -> Result<[Output; 2], JointError> {
        let (output, started) = (self.output, self.started);
        // A single step leaves the state as before by itself.
        if let Response::Extended(extended) = &mut self.response
            && way.len() > 1
        {
            extended.keep();
        }
        let mut from = if started { output.time } else { f64::MIN };
        for &(time, value) in way {
            self.admit(time, value)?;
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
