//! A step of a joint that displacement drives: its slip is the unknown.

use super::{MOST_TRIALS, March, PRECISE, Step, share};
use crate::identify::bracket::Bracket;

impl March<'_> {
    pub(super) fn step_displacement(&mut self, time: f64, step: f64, displacement: f64) -> Step {
        let path_acts = self.in_path_acts();
        let mut trial = if path_acts {
            self.slip_ahead(step, displacement)
        } else {
            displacement
        };
        let precise = PRECISE * displacement.abs().max(0.1 * self.range());
        let mut bracket = Bracket::new();
        let mut round = 0;
        loop {
            let (network, tangent) = self.network(trial);
            let (beside, beside_slope) = self.beside_slip(trial);
            let joint_force = network + beside;
            let joint_slope = tangent + beside_slope;
            let (path, path_slope) = self.in_path(joint_force, step);
            let error = trial + path - displacement;
            let slope = 1.0 + path_slope * joint_slope;
            let next = bracket.next(trial, error, slope, error);
            if !path_acts || error.abs() <= precise || next == trial || round >= MOST_TRIALS {
                let across = self.beside_joint(displacement, step);
                self.tangent = tangent;
                self.outlook.take(step, displacement, slope / joint_slope);
                self.accept(
                    time,
                    step,
                    (trial, joint_force, displacement, across.velocity),
                );
                return Step {
                    force: joint_force + across.force,
                    displacement,
                    share: share(slope),
                    input: [-path_slope, 0.0],
                    ..Step::default()
                };
            }
            trial = next;
            round += 1;
        }
    }

    /// Slip \[m\] after Newton's first step from where the joint was, which asks no operator.
    fn slip_ahead(&self, step: f64, displacement: f64) -> f64 {
        let slip = self.last.slip;
        let (_, beside_slope) = self.beside_slip(slip);
        let (path, path_slope) = self.in_path(self.last.force, step);
        let error = slip + path - displacement;
        slip - error / (1.0 + path_slope * (self.tangent + beside_slope))
    }
}
