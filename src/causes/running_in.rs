//! `running_in`: friction, or stiffness, settles to its lasting value within the first cycles.

use super::wear::{ENERGY, PER_PATH, TAIL, at_once, follow_path, remaining, shapes, soon, worn};
use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Places, Response, Situation, SlipLimit};
use crate::joint::parameters::Parameter;

/// Break-free forces settle with the energy dissipated, `n = 1 − a exp(−E/E_0)`, or with the path of the
/// slip, see [`worn`]; or a compliance in the load path does, `dx = c exp(−E/E_0) dF`, and for c < 0, of fresh
/// surfaces that are stiffer, `x = −c [1 − exp(−E/E_0)] F`.
///
/// Contact that is gained meets the load that is there unstressed, contact that is lost lets go what it bore: a
/// closed cycle of load returns no work either way, as it would if a joint that stiffens under load lifted it.
pub struct RunningIn;

static PARAMETERS: [Parameter; 5] = [
    Parameter {
        name: "deficit",
        symbol: "a",
        unit: "1",
        lower: -0.98,
        upper: 0.98,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "share of the lasting break-free forces that the fresh surfaces lack; negative where they have more",
    },
    ENERGY,
    TAIL,
    PER_PATH,
    Parameter {
        name: "softness",
        symbol: "c",
        unit: "m/N",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "compliance that the fresh surfaces have more than they will; negative where they have less",
    },
];

/// What is left of the change after this energy \[J\] and path \[m\].
fn left((dissipation, path): (f64, f64), values: &[f64]) -> f64 {
    remaining(worn(dissipation, path, values), values[2])
}

impl RunningIn {
    /// Compliance in the load path beyond the least it will have \[m/N\].
    fn compliance(values: &[f64], work: &[f64]) -> f64 {
        if values[4] == 0.0 {
            return 0.0;
        }
        let left = left((work[0], work[1]), values);
        match values[4] >= 0.0 {
            true => values[4] * left,
            false => -values[4] * (1.0 - left),
        }
    }
}

impl Effect for RunningIn {
    fn name(&self) -> &'static str {
        "running_in"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn places(&self, values: &[f64]) -> Places {
        let also = (values[4] != 0.0).then_some(Place::InSeries);
        [Some(self.place()), also, None]
    }
    /// Energy and path before the last step that took time, which its compliance went by; both behind it; slip; the
    /// load, and what gave way to it.
    fn memory(&self) -> usize {
        7
    }
    /// Energies and paths.
    fn lasting(&self) -> usize {
        4
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[6] = self.in_series(values, now.force, now.step, memory).value;
        memory[5] = now.force;
        if now.step > 0.0 {
            memory.copy_within(2..4, 0);
        }
        memory[2] = now.dissipation;
        follow_path(now, &mut memory[3..5]);
    }
    fn slip_limit(&self, values: &[f64], last: &Situation, memory: &[f64]) -> SlipLimit {
        if values[0] == 0.0 {
            return SlipLimit::UNCHANGED;
        }
        let limit = 1.0 - values[0] * left((last.dissipation, memory[3]), values);
        SlipLimit::either_way(limit)
    }
    /// Where no time passes the compliance stays.
    fn in_series(&self, values: &[f64], force: f64, step: f64, memory: &[f64]) -> Response {
        let work = if step > 0.0 { &memory[2..] } else { memory };
        let slope = RunningIn::compliance(values, work);
        Response {
            value: match values[4] > 0.0 {
                true => memory[6] + slope * (force - memory[5]),
                false => slope * force,
            },
            slope,
            damping: 0.0,
        }
    }
    /// Of a spring of the present compliance, which is what it gives back; what that changes by under load is lost.
    fn stored_energy(&self, values: &[f64], now: &Situation, memory: &[f64]) -> Option<f64> {
        Some(0.5 * RunningIn::compliance(values, memory) * now.force * now.force)
    }
}

impl Cause for RunningIn {
    fn page(&self) -> Page {
        Page {
            happens: "Films and peaks of fresh surfaces wear off in the first cycles; contact spreads, friction grows, or the joint stiffens, and then stays.",
            sign: "The first loops are wider and softer than the later ones of the same load, or as wide and only softer; the change dies out and does not come back after a pause.",
            mistaken_for: &["preload_loss", "creep", "displacement_drift", "offset_step"],
            separated_by: "Repeated equal blocks: loops grow narrower and stiffer here and wider and softer with lost preload; creep and drift move a loop and leave its area. Friction that falls within the first part of the work and then stays is called running in, and may be lost preload as well, as where parts embed; one that goes on falling is lost preload.",
            formula: "phi = phi_0 [1 - a r] or dU = du + dF/K_1 + c r dF, r = (1 + q w)^(-1/q), exp(-w) for q = 0, w = E/E_0 or s/L",
            source: "Growth of fretting friction to its steady value over the first cycles, with the dissipated energy (Fouvry; Schwingshackl et al. 2012) or the path of the slip as the measure of work.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &RunningIn
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], values[1], 0.3, values[3], values[4]]
    }
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        let runs_in = values[0] > 0.0 || values[4] != 0.0 || soon(values, scale);
        runs_in && !at_once(values, scale)
    }
    fn also_called(&self, values: &[f64], scale: &Scale) -> Option<&'static str> {
        (values[0] < 0.0 && !at_once(values, scale)).then_some("preload_loss")
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let shares = [0.01, 0.05, 0.2, 0.8];
        let of = |friction: f64, softness: f64| {
            let with = move |mut values: Vec<f64>| {
                values[0] = friction;
                values.push(softness);
                values
            };
            shapes(friction, &shares, scale).into_iter().map(with)
        };
        of(0.05, 0.0)
            .chain(of(0.0, 0.05 / scale.stiffness))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_grows_from_its_deficit_to_one() {
        let at = |dissipation| {
            let last = Situation {
                dissipation,
                ..Situation::default()
            };
            RunningIn
                .slip_limit(&[0.4, 2.0, 0.0, 0.0, 0.0], &last, &[0.0; 7])
                .positive
        };
        assert_eq!(at(0.0), 0.6);
        assert!((at(2.0) - (1.0 - 0.4 / std::f64::consts::E)).abs() < 1e-15);
        assert_eq!(at(2000.0), 1.0);
    }

    #[test]
    fn a_compliance_settles_from_either_side_and_is_never_negative() {
        let at = |softness: f64, dissipation: f64| {
            let values = [0.0, 2.0, 0.0, 0.0, softness];
            let response = RunningIn.in_series(
                &values,
                30.0,
                0.1,
                &[7.0, 7.0, dissipation, 0.0, 0.0, 0.0, 0.0],
            );
            assert_eq!(response.value, 30.0 * response.slope);
            response.slope
        };
        assert_eq!(at(1e-3, 0.0), 1e-3);
        assert!((at(1e-3, 2.0) - 1e-3 / std::f64::consts::E).abs() < 1e-18);
        assert_eq!(at(1e-3, 2000.0), 0.0);
        assert_eq!(at(-1e-3, 0.0), 0.0);
        assert_eq!(at(-1e-3, 2000.0), 1e-3);
    }

    #[test]
    fn contact_that_is_gained_meets_its_load_unstressed_and_what_is_lost_lets_go() {
        for (softness, gives_way) in [(1e-3, 0.02), (-1e-3, 0.02 * (1.0 - (-1.0_f64).exp()))] {
            let values = [0.0, 2.0, 0.0, 0.0, softness];
            let mut memory = [0.0; 7];
            // Loaded while fresh, worn by the load, held.
            for (force, dissipation) in [(20.0, 2.0), (20.0, 2.0)] {
                let now = Situation {
                    step: 0.1,
                    force,
                    dissipation,
                    ..Situation::default()
                };
                RunningIn.remember(&values, &now, &mut memory);
            }
            assert!((memory[6] - gives_way).abs() < 1e-15, "{}", memory[6]);
        }
    }

    #[test]
    fn work_is_remembered_with_its_path() {
        let mut memory = [0.0; 7];
        let values = [0.0, 2.0, 0.0, 0.0, -1e-3];
        for (step, slip, dissipation) in [(0.1, 0.5, 1.0), (0.1, -0.25, 3.0), (0.0, -0.5, 4.0)] {
            let now = Situation {
                step,
                slip,
                dissipation,
                ..Situation::default()
            };
            RunningIn.remember(&values, &now, &mut memory);
        }
        // What answers in no time goes by the work before the step that took some.
        assert_eq!(memory, [1.0, 0.5, 4.0, 1.5, -0.5, 0.0, 0.0]);
        let at = |step, memory: &[f64]| RunningIn.in_series(&values, 1.0, step, memory).value;
        assert_eq!(
            at(0.0, &memory),
            at(0.1, &[0.0, 0.0, 1.0, 0.5, 0.0, 0.0, 0.0])
        );
    }
}
