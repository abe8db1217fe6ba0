//! Small effects, one or two for each place, for tests alone.

use iwan::joint::{Effect, Parameter, Place, Response, Situation, SlipLimit};

pub const fn parameter(name: &'static str, vanishes_at: f64) -> Parameter {
    Parameter {
        name,
        symbol: name,
        unit: "1",
        lower: 0.0,
        upper: f64::INFINITY,
        vanishes_at: Some(vanishes_at),
        neutral: None,
        meaning: "For tests.",
    }
}

/// f = c U̇.
pub struct Dashpot;
impl Effect for Dashpot {
    fn name(&self) -> &'static str {
        "dashpot"
    }
    fn place(&self) -> Place {
        Place::BesideJoint
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("damping", 0.0)] }
    }
    fn beside_joint(&self, values: &[f64], _displacement: f64, velocity: f64) -> Response {
        Response {
            value: values[0] * velocity,
            slope: 0.0,
            damping: values[0],
        }
    }
}

/// p = k (|u| − gap)₊, on both sides, with a cubic part.
pub struct Stop;
impl Effect for Stop {
    fn name(&self) -> &'static str {
        "stop"
    }
    fn place(&self) -> Place {
        Place::BesideSlip
    }
    fn parameters(&self) -> &'static [Parameter] {
        const {
            &[
                parameter("stiffness", 0.0),
                Parameter {
                    vanishes_at: None,
                    neutral: None,
                    ..parameter("gap", 0.0)
                },
            ]
        }
    }
    fn beside_slip(&self, values: &[f64], (slip, _): (f64, f64), _memory: &[f64]) -> Response {
        let depth = (slip.abs() - values[1]).max(0.0);
        Response {
            value: (values[0] * depth * (1.0 + depth * depth)).copysign(slip),
            slope: if depth > 0.0 {
                values[0] * (1.0 + 3.0 * depth * depth)
            } else {
                0.0
            },
            damping: 0.0,
        }
    }
}

/// s = ± gap/2, reached at a tiny seating force.
pub struct Play;
pub const SEAT: f64 = 1e-6;
impl Effect for Play {
    fn name(&self) -> &'static str {
        "play"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("gap", 0.0)] }
    }
    fn in_series(&self, values: &[f64], force: f64, _step: f64, _memory: &[f64]) -> Response {
        let seated = (force / SEAT).clamp(-1.0, 1.0);
        let slope = if force.abs() < SEAT {
            0.5 * values[0] / SEAT
        } else {
            0.0
        };
        Response {
            value: 0.5 * values[0] * seated,
            slope,
            damping: 0.0,
        }
    }
}

/// Compliance δ = c F in tension only.
pub struct Opening;
impl Effect for Opening {
    fn name(&self) -> &'static str {
        "opening"
    }
    fn place(&self) -> Place {
        Place::Spring
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("compliance", 0.0)] }
    }
    fn spring(&self, values: &[f64], force: f64) -> Response {
        let slope = if force > 0.0 { values[0] } else { 0.0 };
        Response {
            value: slope * force,
            slope,
            damping: 0.0,
        }
    }
}

/// Slip limits n± per direction, vanishing at 1.
pub struct Sided;
impl Effect for Sided {
    fn name(&self) -> &'static str {
        "sided"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("positive", 1.0), parameter("negative", 1.0)] }
    }
    fn slip_limit(&self, values: &[f64], _last: &Situation, _memory: &[f64]) -> SlipLimit {
        SlipLimit {
            positive: values[0],
            negative: values[1],
        }
    }
}

/// Limits that fall with the dissipated energy; counts samples to have a history.
pub struct Wear;
impl Effect for Wear {
    fn name(&self) -> &'static str {
        "wear"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("rate", 0.0)] }
    }
    fn memory(&self) -> usize {
        1
    }
    fn remember(&self, _values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = now.dissipation;
    }
    fn slip_limit(&self, values: &[f64], _last: &Situation, memory: &[f64]) -> SlipLimit {
        let left = 0.5 + 0.5 * (-values[0] * memory[0]).exp();
        SlipLimit {
            positive: left,
            negative: left,
        }
    }
}

/// One Kelvin element: s → C F with time constant 1 s.
pub struct Kelvin;
impl Effect for Kelvin {
    fn name(&self) -> &'static str {
        "kelvin"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("compliance", 0.0)] }
    }
    fn memory(&self) -> usize {
        1
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = self.in_series(values, now.force, now.step, memory).value;
    }
    fn in_series(&self, values: &[f64], force: f64, step: f64, memory: &[f64]) -> Response {
        let share = -(-step).exp_m1();
        Response {
            value: memory[0] + share * (values[0] * force - memory[0]),
            slope: share * values[0],
            damping: 0.0,
        }
    }
    fn stored_energy(&self, values: &[f64], _now: &Situation, memory: &[f64]) -> Option<f64> {
        Some(0.5 * memory[0] * memory[0] / values[0])
    }
}
