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
            let beside = self.beside_slip(slip, step);
            let joint_force = trial + beside.force;
            let joint_slope = 1.0 + beside.slope * tangent;
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
                let held = 1.0 + beside.held * tangent;
                self.outlook
                    .take(step, force, (tangent + path_slope * held) / held);
                let taken = self.inertia.take(step, displacement);
                self.network = trial;
                self.accept(time, step, answer);
                let [latest, oldest] = [0, 1].map(|k| {
                    let (across, beside) = (across.earlier[k], beside.earlier[k]);
                    -(across * displacement_slope + beside * tangent) * share
                });
                let in_path = path_slope / (1.0 + path_slope * beside.slope);
                return Step {
                    force: force - hauled.force,
                    displacement,
                    share,
                    input: match displacement_slope > 0.0 {
                        true => [1.0, -1.0 - path_slope * beside.slope]
                            .map(|by| by / displacement_slope),
                        // A joint that no force moves.
                        false => [0.0; 2],
                    },
                    carried: [latest, oldest],
                    lagging: beside.earlier.map(|c| c * in_path),
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
        let beside = self.beside_slip(self.last.slip, step);
        let network = self.network;
        let joint_force = network + beside.force;
        let joint_slope = 1.0 + beside.slope * self.tangent;
        let (path, path_slope) = self.in_path(joint_force, step);
        let displacement = self.last.slip + path;
        let displacement_slope = self.tangent + path_slope * joint_slope;
        let across = self.beside_joint(displacement, step);
        let hauled = self.inertia.at(step, displacement);
        let error = joint_force + across.force + hauled.force - force;
        network - error / (joint_slope + (across.slope + hauled.slope) * displacement_slope)
    }
}
