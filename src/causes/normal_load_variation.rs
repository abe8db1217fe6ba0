//! `normal_load_variation`: the clamping follows the load or the displacement.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
use crate::joint::elementary::square;
use crate::joint::parameters::Parameter;

/// Break-free forces that follow force and displacement, both ways alike:
/// `n = max(1 + a_F F + a_U U + e_F |F| + e_U |U| + q_F F² + q_U U², 0)`.
pub struct NormalLoadVariation;

static PARAMETERS: [Parameter; 6] = [
    Parameter {
        name: "force_sensitivity",
        symbol: "a_F",
        unit: "1/N",
        lower: -1e36,
        upper: 1e36,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "relative change of the break-free forces per newton of force",
    },
    Parameter {
        name: "displacement_sensitivity",
        symbol: "a_U",
        unit: "1/m",
        lower: -1e13,
        upper: 1e13,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "the same per metre of displacement",
    },
    Parameter {
        name: "even_force_sensitivity",
        symbol: "e_F",
        unit: "1/N",
        lower: -1e36,
        upper: 1e36,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "the same per newton of force either way, as of bolts that are bent",
    },
    Parameter {
        name: "even_displacement_sensitivity",
        symbol: "e_U",
        unit: "1/m",
        lower: -1e13,
        upper: 1e13,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "the same per metre of displacement either way",
    },
    Parameter {
        name: "force_curvature",
        symbol: "q_F",
        unit: "1/N2",
        lower: -1e60,
        upper: 1e60,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "the same per square of the force, as of bolts that are bent a little",
    },
    Parameter {
        name: "displacement_curvature",
        symbol: "q_U",
        unit: "1/m2",
        lower: -1e26,
        upper: 1e26,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "the same per square of the displacement",
    },
];

/// Places of the values that follow the force and of those that follow the displacement: in proportion, either way
/// alike, and squared.
const OF_FORCE: [usize; 3] = [0, 2, 4];
const OF_DISPLACEMENT: [usize; 3] = [1, 3, 5];

/// Relative change of the break-free forces at the peak that a search begins with.
const CHANGE: f64 = 0.02;

/// Share of what a law says at the peak that a refinement of it begins with.
const REFINES: f64 = 0.1;

/// What values at three places say of a load.
fn change(values: &[f64], [odd, even, squared]: [usize; 3], load: f64) -> f64 {
    values[odd] * load + (values[even] + values[squared] * load.abs()) * load.abs()
}

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
    fn sees_energy(&self) -> bool {
        false
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, _memory: &[f64]) -> SlipLimit {
        let of_force = change(values, OF_FORCE, last.force);
        let of_displacement = change(values, OF_DISPLACEMENT, last.displacement);
        let limit = (1.0 + of_force + of_displacement).max(0.0);
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
            formula: "phi = phi_0 max(1 + a_F F + a_U U + e_F |F| + e_U |U| + q_F F^2 + q_U U^2, 0)",
            source: "Friction contact with variable normal load: Menq, Griffin and Bielak 1986; Yang, Chu and Menq 1998.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &NormalLoadVariation
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let (force, displacement) = (scale.force, scale.displacement);
        // Either way alike, force and displacement do different things: the one stiffens loops that the other widens.
        let shapes = [
            (0, force),
            (1, displacement),
            (2, force),
            (3, displacement),
            (5, square(displacement)),
        ];
        let one = |(place, load): (usize, f64)| {
            let mut values = vec![0.0; PARAMETERS.len()];
            values[place] = CHANGE / load;
            values
        };
        shapes.map(one).to_vec()
    }
    /// Proportional laws bend as an exponential would, and those either way are sharp or not.
    fn refined(&self, values: &[f64], scale: &Scale) -> Vec<f64> {
        let mut refined = values.to_vec();
        let channels = [
            (OF_FORCE, scale.force),
            (OF_DISPLACEMENT, scale.displacement),
        ];
        for (places @ [odd, even, squared], peak) in channels {
            match places.map(|place| values[place] != 0.0) {
                [_, true, false] => refined[squared] = REFINES * values[even] / peak,
                [_, false, true] => refined[even] = REFINES * values[squared] * peak,
                [true, false, false] => refined[squared] = 0.5 * square(values[odd]),
                _ => {}
            }
        }
        refined
    }
    /// What lies between force and displacement, as behind a spring in the load path: of what is proportional, or of
    /// what is alike either way.
    fn begun_anew(&self, values: &[f64], scale: &Scale) -> Option<Vec<f64>> {
        let over = scale.force / scale.displacement;
        let kinds = match values[0] != 0.0 || values[1] != 0.0 {
            true => &[(0, over)][..],
            false => &[(2, over), (4, square(over))],
        };
        let mut between = values.to_vec();
        for &(force, over) in kinds {
            let displacement = force + 1;
            let whole = values[force] + values[displacement] / over;
            if values[force] == 0.0 || values[displacement] == 0.0 {
                between[force] = 0.5 * whole;
                between[displacement] = 0.5 * whole * over;
            }
        }
        (between != values).then_some(between)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_follows_force_and_displacement_and_stays_a_limit() {
        let at = |values: [f64; 6], force, displacement| {
            let last = Situation {
                force,
                displacement,
                ..Situation::default()
            };
            NormalLoadVariation.slip_limit(&values, &last, &[])
        };
        assert_eq!(at([0.25, 0.0, 0.0, 0.0, 0.0, 0.0], 2.0, 7.0).positive, 1.5);
        assert_eq!(at([0.25, 0.5, 0.0, 0.0, 0.0, 0.0], 2.0, -3.0).negative, 0.0);
        assert_eq!(
            at([0.25, 0.0, 0.0, 0.0, 0.0, 0.0], -20.0, 0.0).positive,
            0.0
        );
        assert_eq!(
            at([0.0, 0.0, 0.25, 0.5, 0.0, 0.0], -2.0, -3.0).positive,
            3.0
        );
        assert_eq!(
            at([0.0, 0.0, 0.0, 0.0, 0.25, 0.5], -2.0, -3.0).negative,
            6.5
        );
    }

    #[test]
    fn a_law_is_refined_in_what_it_follows() {
        let scale = Scale {
            force: 4.0,
            displacement: 2.0,
            ..Scale::default()
        };
        let starts = NormalLoadVariation.starts(&scale);
        let refined: Vec<Vec<usize>> = starts
            .iter()
            .map(|start| {
                let refined = NormalLoadVariation.refined(start, &scale);
                (0..6).filter(|&i| refined[i] != start[i]).collect()
            })
            .collect();
        assert_eq!(refined, [[4], [5], [4], [5], [3]]);
        let between = NormalLoadVariation.begun_anew(&starts[0], &scale).unwrap();
        assert_eq!(between[..2], [0.0025, 0.005]);
        assert_eq!(NormalLoadVariation.begun_anew(&between, &scale), None);
        let either_way = NormalLoadVariation.begun_anew(&starts[4], &scale).unwrap();
        assert_eq!(either_way, [0.0, 0.0, 0.0, 0.0, 0.000_625, 0.0025]);
    }
}
