//! A step of a joint that force drives: the network's force is the unknown.

use super::{MOST_TRIALS, March, PRECISE, Step, share};
use crate::identify::bracket::Bracket;
use crate::identify::inertia::Carried;

/// Rounding of a difference of displacements, as a share of one.
const ROUNDED: f64 = 1e-15;

impl March<'_> {
    pub(super) fn step_force(&mut self, time: f64, step: f64, force: f64) -> Step {
        let parallel = self.feeds_back();
        let mut trial = if parallel {
            self.force_ahead(step, force)
        } else {
            force
        };
        let precise = PRECISE * force.abs().max(0.1 * self.range());
        let mut bracket = Bracket::new();
        let mut answer;
        let mut round = 0;
        loop {
            let (slip, tangent) = self.network(trial);
            let (beside, beside_slope) = self.beside_slip(slip);
            let joint_force = trial + beside;
            let joint_slope = 1.0 + beside_slope * tangent;
            let (path, path_slope) = self.in_path(joint_force, step);
            let displacement = slip + path;
            let displacement_slope = tangent + path_slope * joint_slope;
            let across = self.beside_joint(displacement, step);
            let hauled = self.inertia.at(step, displacement);
            let error = joint_force + across.force + hauled.force - force;
            let slope = joint_slope + (across.slope + hauled.slope) * displacement_slope;
            answer = (slip, joint_force, displacement, across.velocity);
            let share = share(slope);
            let next = bracket.next(trial, error, slope, 2.0 * error);
            let precise = precise.max(ROUNDED * hauled.slope * displacement.abs());
            if !parallel || error.abs() <= precise || next == trial || round >= MOST_TRIALS {
                self.tangent = tangent;
                self.outlook
                    .take(step, force, displacement_slope / joint_slope);
                let taken = self.inertia.take(step, displacement);
                self.accept(time, step, answer);
                return Step {
                    force: force - hauled.force,
                    displacement,
                    share,
                    input: match displacement_slope > 0.0 {
                        true => [1.0, -1.0 - path_slope * beside_slope]
                            .map(|by| by / displacement_slope),
                        // A joint that no force moves.
                        false => [0.0; 2],
                    },
                    carried: across.earlier.map(|c| -c * displacement_slope * share),
                    hauled: Carried {
                        by_motion: taken.by_motion.map(|c| -c * displacement_slope * share),
                        ..taken
                    },
                };
            }
            trial = next;
            round += 1;
        }
    }

    /// Network force \[N\] after Newton's first step from where the joint was, which asks no operator.
    fn force_ahead(&self, step: f64, force: f64) -> f64 {
        let (beside, beside_slope) = self.beside_slip(self.last.slip);
        let network = self.last.force - beside;
        let joint_slope = 1.0 + beside_slope * self.tangent;
        let (path, path_slope) = self.in_path(network + beside, step);
        let displacement = self.last.slip + path;
        let displacement_slope = self.tangent + path_slope * joint_slope;
        let across = self.beside_joint(displacement, step);
        let hauled = self.inertia.at(step, displacement);
        let error = self.last.force + across.force + hauled.force - force;
        network - error / (joint_slope + (across.slope + hauled.slope) * displacement_slope)
    }
}
