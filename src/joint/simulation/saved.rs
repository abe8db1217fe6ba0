//! The complete state of a joint in motion, as numbers.

use super::{JointError, Output, Response, Simulation};

/// Version of the saved state.
const FORMAT: f64 = 6.0;
/// Numbers of a saved state before those of the response.
const HEAD: usize = 11;

impl Simulation {
    /// Complete state as numbers; [`Simulation::restore`] continues identically, to the last bit.
    pub fn state(&self) -> Vec<f64> {
        let o = &self.output;
        let started = if self.started { 1.0 } else { 0.0 };
        let mut state = vec![
            FORMAT,
            self.fingerprint,
            started,
            o.time,
            o.force,
            o.displacement,
        ];
        state.extend([o.slip_displacement, o.dissipation, o.dissipation_rate]);
        state.extend([o.stored_energy, o.tangent_stiffness]);
        match &self.response {
            Response::Network(exact) => state.extend(exact.state()),
            Response::BehindSpring(exact) => state.extend(exact.state()),
            Response::Extended(extended) => extended.save(&mut state),
        }
        state
    }

    /// Puts back a saved state of the same joint and drive.
    ///
    /// # Errors
    /// [`JointError::ForeignState`]; the state is then as before.
    pub fn restore(&mut self, state: &[f64]) -> Result<(), JointError> {
        let foreign = |reason: String| JointError::ForeignState { reason };
        let (head, rest) = state
            .split_at_checked(HEAD)
            .ok_or_else(|| foreign(format!("it has only {} numbers", state.len())))?;
        let &[
            format,
            print,
            started,
            time,
            force,
            displacement,
            slip,
            loss,
            rate,
            stored,
            tangent,
        ] = head
        else {
            return Err(foreign(format!("it has only {} numbers", state.len())));
        };
        if format != FORMAT {
            return Err(foreign(format!(
                "its version is {format}, this one reads {FORMAT}"
            )));
        }
        if print != self.fingerprint {
            return Err(foreign(
                "it was saved from other parameters or another drive".into(),
            ));
        }
        match &mut self.response {
            Response::Network(exact) => exact.restore(rest)?,
            Response::BehindSpring(exact) => exact.restore(rest)?,
            Response::Extended(extended) => extended.restore(rest)?,
        }
        self.started = started != 0.0;
        self.output = Output {
            time,
            force,
            displacement,
            slip_displacement: slip,
            dissipation: loss,
            dissipation_rate: rate,
            stored_energy: stored,
            tangent_stiffness: tangent,
        };
        Ok(())
    }
}
