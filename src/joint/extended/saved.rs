//! The complete state of the extended joint, as numbers, and the way back to one.

use super::{Extended, JointError, Situation, SlipLimit};
use crate::joint::sensitivity::Sensitivity;

/// Numbers before the network's in a saved state.
const SITUATION: usize = 19;

impl Extended {
    /// Notes the present state, to go back to; allocates nothing.
    pub fn keep(&mut self) {
        let mut kept = std::mem::take(&mut self.kept);
        kept.clear();
        self.save(&mut kept);
        self.kept = kept;
    }

    /// Goes back to the state that was kept last.
    pub fn go_back(&mut self) -> Result<(), JointError> {
        let kept = std::mem::take(&mut self.kept);
        let back = self.restore(&kept);
        self.kept = kept;
        back
    }

    /// Count of numbers of a saved state.
    pub fn state_length(&self) -> usize {
        let parts = self.network.state_length() + self.ledger.state_length();
        SITUATION + parts + self.laws.memory().len()
    }

    /// Appends the complete state.
    pub fn save(&self, state: &mut Vec<f64>) {
        let now = &self.now;
        state.extend([
            now.time,
            now.step,
            now.force,
            now.displacement,
            now.velocity,
        ]);
        state.extend([now.slip, now.slip_rate, now.dissipation, self.tangent]);
        state.extend([
            if self.rising { 1.0 } else { -1.0 },
            self.slopes.force,
            self.slopes.displacement,
            self.slopes.dissipation,
            self.slopes.stored_energy,
            self.limit.positive,
            self.limit.negative,
        ]);
        state.extend(self.outlook.saved());
        self.network.save(state);
        self.ledger.save(state);
        state.extend_from_slice(self.laws.memory());
    }

    /// Puts back what [`Extended::save`] appended, or says what differs.
    pub fn restore(&mut self, state: &[f64]) -> Result<(), JointError> {
        let network = self.network.state_length();
        let ledger = self.ledger.state_length();
        let expected = self.state_length();
        let [
            time,
            step,
            force,
            displacement,
            velocity,
            slip,
            slip_rate,
            dissipation,
            tangent,
            rising,
            by_force,
            by_displacement,
            by_dissipation,
            by_stored,
            limit_up,
            limit_down,
            along,
            way,
            input,
            rest @ ..,
        ] = state
        else {
            return Err(foreign(expected, state.len()));
        };
        if state.len() != expected {
            return Err(foreign(expected, state.len()));
        }
        self.now = Situation {
            time: *time,
            step: *step,
            force: *force,
            displacement: *displacement,
            velocity: *velocity,
            slip: *slip,
            slip_rate: *slip_rate,
            dissipation: *dissipation,
        };
        (self.tangent, self.rising) = (*tangent, *rising > 0.0);
        self.slopes = Sensitivity {
            force: *by_force,
            displacement: *by_displacement,
            slip_displacement: 1.0,
            dissipation: *by_dissipation,
            stored_energy: *by_stored,
        };
        self.limit = SlipLimit {
            positive: *limit_up,
            negative: *limit_down,
        };
        self.outlook.restore([*along, *way, *input]);
        let (sliders, rest) = rest.split_at(network);
        let (account, memory) = rest.split_at(ledger);
        self.network.restore(sliders);
        self.ledger.restore(account);
        self.laws.restore(memory);
        Ok(())
    }
}

fn foreign(expected: usize, found: usize) -> JointError {
    JointError::ForeignState {
        reason: format!("it has {found} numbers where this joint with its effects has {expected}"),
    }
}
