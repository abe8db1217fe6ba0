//! Slopes of all that a step answers over its slip u, the state before the step held.

use super::ahead::Along;
use super::laws::{Law, Laws};
use crate::joint::effect::{Place, Response, Situation};
use crate::joint::sensitivity::Sensitivity;

/// Width of the difference by which the energy is differentiated that a law says itself, in units
/// of the slip, and the least slip in units of the network's slip range.
const WIDTH: f64 = 1e-5;
const LEAST: f64 = 1e-3;

/// The end of a step, before the effects remember it.
#[derive(Debug)]
pub(super) struct End<'a> {
    pub along: &'a Along,
    pub now: &'a Situation,
    pub laws: &'a Laws,
    /// Displacement over the step, and slip over it \[m\].
    pub way: f64,
    pub slipped: f64,
    /// Force of the network's sliders that slide \[N\].
    pub sliding: f64,
    /// K_1 as flexibility \[m/N\], and the slip range \[m\].
    pub flexibility: f64,
    pub reach: f64,
}

impl End<'_> {
    /// Slopes over u, as long as the ledger owes nothing; `scratch` has the length of a memory.
    pub fn slopes(&self, scratch: &mut [f64]) -> Sensitivity {
        let (point, force) = (&self.along.point, self.now.force);
        let mut lost = self.sliding + self.along.lost;
        // The network's springs take what its sliders do not, and K_1 its own.
        let mut stored = force - self.sliding + self.flexibility * force * point.load_slope;
        stored += self.along.stored;
        // What acts beside the slip is no force of the network.
        let now = self.now;
        stored -= self.laws.beside_slip((now.slip, now.slip_rate)).value;
        for (law, memory) in self.laws.iter() {
            let (mut elastic, mut other) = (0.0, 0.0);
            for place in law.places() {
                let (one, rest) = self.work(place, law, memory);
                (elastic, other) = (elastic + one, other + rest);
            }
            let kept = self.kept(law, memory, scratch).unwrap_or(elastic);
            lost += elastic + other - kept;
            stored += kept;
        }
        Sensitivity {
            force: point.stiffness,
            displacement: point.stretch,
            slip_displacement: 1.0,
            dissipation: lost,
            stored_energy: stored,
        }
    }

    /// Slopes of the work on one law at one place, as the ledger books it \[N\].
    fn work(&self, place: Place, law: &Law, memory: &[f64]) -> (f64, f64) {
        let (point, now) = (&self.along.point, self.now);
        match place {
            Place::BesideSlip => {
                let still = law.beside_slip((now.slip, 0.0), memory);
                let moving = law.beside_slip((now.slip, now.slip_rate), memory);
                (still.value, self.lost(still, moving, self.slipped))
            }
            Place::BesideJoint => {
                let still = law.beside_joint(now.displacement, 0.0);
                let moving = law.beside_joint(now.displacement, now.velocity);
                let other = self.lost(still, moving, self.way);
                (still.value * point.stretch, other * point.stretch)
            }
            Place::Spring => {
                let slope = law.spring(now.force).slope;
                (now.force * slope * point.load_slope, 0.0)
            }
            Place::InSeries => {
                let slope = law.in_series(now.force, now.step, memory).slope;
                (now.force * slope * point.load_slope, 0.0)
            }
            Place::SlipLimit | Place::ForceChannel | Place::DisplacementChannel => (0.0, 0.0),
        }
    }

    /// Slope of `[f(x, v) − f(x, 0)] Δx` over x \[N\].
    fn lost(&self, still: Response, moving: Response, way: f64) -> f64 {
        let rate = if self.now.step > 0.0 {
            moving.damping / self.now.step
        } else {
            0.0
        };
        let changing = way * (moving.slope - still.slope + rate);
        moving.value - still.value + changing
    }

    /// Slope of the energy that a law says it keeps, by a central difference.
    fn kept(&self, law: &Law, memory: &[f64], scratch: &mut [f64]) -> Option<f64> {
        let width = WIDTH * self.now.slip.abs().max(LEAST * self.reach);
        let scratch = &mut scratch[law.span.clone()];
        let mut at = |way: f64| {
            let situation = self.beyond(way);
            scratch.copy_from_slice(memory);
            law.remember(&situation, scratch);
            law.stored_energy(&situation, scratch)
        };
        Some((at(width)? - at(-width)?) / (2.0 * width))
    }

    /// The situation if the step had gone further by this slip \[m\].
    fn beyond(&self, slip: f64) -> Situation {
        let (point, now) = (&self.along.point, self.now);
        let way = point.stretch * slip;
        let per_time = |way: f64| if now.step > 0.0 { way / now.step } else { 0.0 };
        Situation {
            force: now.force + point.load_slope * slip,
            displacement: now.displacement + way,
            velocity: now.velocity + per_time(way),
            slip: now.slip + slip,
            slip_rate: now.slip_rate + per_time(slip),
            ..*now
        }
    }
}
