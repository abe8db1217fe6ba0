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
            let beside = self.beside_slip(trial, step);
            let joint_force = network + beside.force;
            let joint_slope = tangent + beside.slope;
            let (path, path_slope) = self.in_path(joint_force, step);
            let error = trial + path - displacement;
            let slope = 1.0 + path_slope * joint_slope;
            let next = bracket.next(trial, error, slope, error);
            if !path_acts || error.abs() <= precise || next == trial || round >= MOST_TRIALS {
                let across = self.beside_joint(displacement, step);
                self.tangent = tangent;
                let held = tangent + beside.held;
                self.outlook
                    .take(step, displacement, (1.0 + path_slope * held) / held);
                self.network = network;
                self.accept(
                    time,
                    step,
                    (trial, joint_force, displacement, across.velocity),
                );
                let share = share(slope);
                return Step {
                    force: joint_force + across.force,
                    displacement,
                    share,
                    input: [-path_slope, 0.0],
                    // A force before took of the way, and its slip with it.
                    carried: beside.earlier.map(|c| -c * path_slope * share),
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
        let beside = self.beside_slip(slip, step);
        let (path, path_slope) = self.in_path(self.network + beside.force, step);
        let error = slip + path - displacement;
        slip - error / (1.0 + path_slope * (self.tangent + beside.slope))
    }
}
