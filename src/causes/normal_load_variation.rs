//! `normal_load_variation`: the clamping follows the load or the displacement.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::parameters::Parameter;

/// Break-free forces that follow the load `L = F + k U` of force and displacement, `n = max(1 + a L + e |L| + q L², 0)`,
/// both ways alike.
pub struct NormalLoadVariation;

static PARAMETERS: [Parameter; 4] = [
    Parameter {
        name: "sensitivity",
        symbol: "a",
        unit: "1/N",
        lower: -1e6,
        upper: 1e6,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "relative change of the break-free forces per newton of load",
    },
    Parameter {
        name: "displacement_weight",
        symbol: "k",
        unit: "N/m",
        lower: 0.0,
        upper: 1e13,
        vanishes_at: None,
        neutral: None,
        meaning: "load that counts per metre of displacement; 0 where the clamping follows the force alone",
    },
    Parameter {
        name: "even_sensitivity",
        symbol: "e",
        unit: "1/N",
        lower: -1e6,
        upper: 1e6,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "the same per newton of load either way, as of bolts that are bent",
    },
    Parameter {
        name: "quadratic_sensitivity",
        symbol: "q",
        unit: "1/N2",
        lower: -1e6,
        upper: 1e6,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "the same per square of the load, as of bolts that are bent a little",
    },
];

impl Effect for NormalLoadVariation {
    fn name(&self) -> &'static str {
        "normal_load_variation"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, _memory: &[f64]) -> SlipLimit {
        let load = last.force + values[1] * last.displacement;
        let even = values[2] + values[3] * load.abs();
        let limit = (1.0 + values[0] * load + even * load.abs()).max(0.0);
        SlipLimit::either_way(limit)
    }
}

impl Cause for NormalLoadVariation {
    fn page(&self) -> Page {
        Page {
            happens: "The applied load also presses the surfaces together or pulls them apart, by eccentric loading, a wedge or a taper: friction is high at one end of the stroke and low at the other. Bolts that bend, or surfaces that ride up, clamp more at both ends.",
            sign: "Loops fatter and steeper towards one end than the other, in steady symmetric cycles too; even harmonics in the dissipative part; a mean load changes the dissipation. Of clamping that follows the load both ways alike, loops of pinched or bulging ends that no Masing joint has.",
            mistaken_for: &[
                "asymmetric_friction",
                "joint_opening",
                "sensor_nonlinearity",
            ],
            separated_by: "Small loops about a positive mean load against the same about a negative one: their areas differ here, while friction that depends on direction gives both the same; an opening joint changes stiffness and no area.",
            formula: "phi = phi_0 max(1 + a L + e |L| + q L^2, 0), L = F + k U",
            source: "Friction contact with variable normal load: Menq, Griffin and Bielak 1986; Yang, Chu and Menq 1998.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &NormalLoadVariation
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let of = |(weight, [odd, even, square]): (f64, [f64; 3])| {
            let load = scale.force * (1.0 + weight);
            let weight = weight * scale.force / scale.displacement;
            vec![odd / load, weight, even / load, square / (load * load)]
        };
        // The force or the displacement: from either a refit finds what lies between, from between not always.
        let odd = [0.0, 30.0].map(|weight| (weight, [0.02, 0.0, 0.0]));
        // Either way alike, force and displacement do different things: the one stiffens loops that the other widens.
        let even = [
            (0.0, [0.0, 0.02, 0.0]),
            (100.0, [0.0, 0.02, 0.0]),
            (100.0, [0.0, 0.0, 0.02]),
        ];
        odd.into_iter().chain(even).map(of).collect()
    }
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let load = scale.force + values[1] * scale.displacement;
        let mut refined = values.to_vec();
        match values[2] == 0.0 {
            true => refined[2] = 0.1 * values[3] * load,
            false => refined[3] = 0.1 * values[2] / load,
        }
        refined
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_follows_force_and_displacement_and_stays_a_limit() {
        let at = |values: [f64; 4], force, displacement| {
            let last = Situation {
                force,
                displacement,
                ..Situation::default()
            };
            NormalLoadVariation.slip_limit(&values, &last, &[])
        };
        assert_eq!(at([0.25, 0.0, 0.0, 0.0], 2.0, 7.0).positive, 1.5);
        assert_eq!(at([0.25, 2.0, 0.0, 0.0], 2.0, -3.0).negative, 0.0);
        assert_eq!(at([0.25, 2.0, 0.0, 0.0], 2.0, -1.5).negative, 0.75);
        assert_eq!(at([0.25, 0.0, 0.0, 0.0], -20.0, 0.0).positive, 0.0);
        assert_eq!(at([0.25, 2.0, 0.5, 0.0], 2.0, -1.5).positive, 1.25);
        assert_eq!(at([0.25, 2.0, 0.0, 0.5], 2.0, -1.5).positive, 1.25);
    }
}
