//! The algorithmic tangent of the joint in motion.

use super::{Drive, Response, Simulation};
use crate::joint::sensitivity::Sensitivity;

impl Simulation {
    /// Slopes of the last answer over its input, see [`Sensitivity`].
    pub fn sensitivity(&self) -> Sensitivity {
        let (force, flexibility) = (self.output.force, 1.0 / self.series_stiffness);
        match &self.response {
            Response::Network(exact) => {
                let (slope, sliding) = (exact.tangent_stiffness(), exact.sliding_force());
                let over_slip = Sensitivity {
                    force: slope,
                    displacement: 1.0 + slope * flexibility,
                    slip_displacement: 1.0,
                    dissipation: sliding,
                    stored_energy: force - sliding + force * slope * flexibility,
                };
                over_slip.over(match self.drive {
                    Drive::Force => over_slip.force,
                    Drive::Displacement => over_slip.displacement,
                })
            }
            Response::BehindSpring(exact) => {
                // Both are at hand; this curve would be solved for them anew.
                let slope = self.output.tangent_stiffness;
                let sliding = exact.sliding_force_with(slope);
                Sensitivity {
                    force: slope,
                    displacement: 1.0,
                    slip_displacement: 1.0 - slope * flexibility,
                    dissipation: sliding,
                    stored_energy: force - sliding,
                }
            }
            Response::Extended(extended) => extended.sensitivity(),
        }
    }
}
