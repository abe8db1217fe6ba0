//! `clearance`: free play in the load path.

use super::free_play::{DRAG, crossed, drag, on_seat, stored};
use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Response, Situation};
use crate::joint::parameters::Parameter;

/// Free play that the load path crosses whenever the force changes its sign,
/// `s = (g/2) tanh(y/F_s)`; y is the force F, or what is left of it when parts that cross the play drag, see [`on_seat`].
pub struct Clearance;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "gap",
        symbol: "g",
        unit: "m",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "free play from contact on one side to contact on the other",
    },
    Parameter {
        name: "seating_force",
        symbol: "F_s",
        unit: "N",
        lower: 1e-36,
        upper: 1e9,
        vanishes_at: None,
        neutral: None,
        meaning: "force over which the surfaces come to full contact",
    },
    DRAG,
];

/// Share of the largest force by which free play has to be crossed: a law that goes on bending up to
/// the largest force is a spring that softens.
const SEATED: f64 = 0.4;

impl Effect for Clearance {
    fn name(&self) -> &'static str {
        "clearance"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    /// Force on the seat.
    fn memory(&self) -> usize {
        1
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = on_seat(now.force, memory[0], values[2]);
    }
    fn in_series(&self, values: &[f64], force: f64, _step: f64, memory: &[f64]) -> Response {
        crossed(values[0], values[1], force, (memory[0], values[2]))
    }
    /// The seating springs back; drag is lost.
    fn stored_energy(&self, values: &[f64], _now: &Situation, memory: &[f64]) -> Option<f64> {
        Some(stored(values[0], values[1], memory[0]))
    }
}

impl Cause for Clearance {
    fn page(&self) -> Page {
        Page {
            happens: "Pins, threads or a worn linkage in the load path have free play: the displacement jumps by the gap whenever the force changes its sign.",
            sign: "A step of fixed size in displacement at zero force, or a dwell at zero force after each reversal of a prescribed motion; odd harmonics, the same in every cycle and at every amplitude.",
            mistaken_for: &["slack_growth", "static_friction_drop", "pinning"],
            separated_by: "It sits at zero force, not at zero displacement nor at the reversal; its size is fixed while slack growth follows past peaks.",
            formula: "U = u + F/K_1 + (g/2) tanh(y/F_s), y = F or within F_d of it",
            source: "Dead-zone of a backlash, smoothed over the seating force; Coble et al. 2022 for a friction damper with backlash.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &Clearance
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        values[1] < SEATED * scale.force
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        [0.005, 0.015, 0.05, 0.12, 0.3]
            .iter()
            .map(|share| vec![0.005 * scale.displacement, share * scale.force, 0.0])
            .collect()
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], drag(values[1])]
    }
}
