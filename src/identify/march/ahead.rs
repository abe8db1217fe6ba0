//! The slip limits of a step: those of the end that its input and the tangents foretell.

use super::{March, index};
use crate::identify::operators::Form;
use crate::joint::effect::Place;
use crate::joint::outlook::Outlook;
use crate::joint::simulation::Drive;

impl March<'_> {
    /// The outlook of a joint that has not moved.
    pub(super) fn at_rest(&self) -> Outlook {
        let beside = self.beside_slip(0.0, 0.0).held;
        let (_, path) = self.in_path(0.0, 0.0);
        let network = match self.operators.form {
            Form::Play => self.elastic / (1.0 + beside * self.elastic),
            Form::Stop => 1.0 / (self.elastic + self.stopped + beside),
        };
        Outlook::of(network + path)
    }

    /// Takes the slip limits of a step to `input`; a joint that goes on keeps them where no time passes.
    pub(super) fn update_limits(&mut self, step: f64, input: f64) {
        let kept = step <= 0.0 && self.goes_on;
        if !self.has[index(Place::SlipLimit)] || kept {
            return;
        }
        let drive = match self.operators.form {
            Form::Play => Drive::Force,
            Form::Stop => Drive::Displacement,
        };
        let ahead = self.outlook.ahead(&self.last, drive, step, input);
        let mut limits = (1.0, 1.0);
        for (acting, memory) in self.effects.iter().zip(&self.memories) {
            if acting.acts_at(Place::SlipLimit) {
                let limit = acting.effect.slip_limit(&acting.values, &ahead, memory);
                limits = (limits.0 * limit.positive, limits.1 * limit.negative);
            }
        }
        self.limits = limits;
    }
}
