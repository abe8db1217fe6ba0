//! One communication step.

use super::derivatives::{Leg, Rates};
use super::instance::Instance;
use super::refusal::Refusal;
use crate::joint::{Output, time_passing};

/// A communication point may differ from the instance's own time by this, relative to the time
/// (absolute below one second): importers that sum their steps were seen to be off by 1e-9.
const TIME_TOLERANCE: f64 = 1e-8;

/// Where derivatives are given, the input as set may differ from the joint's present one by this,
/// relative to the largest part of the polynomial: hosts that work out its end themselves get other
/// digits. Beyond it the input jumps, and its turning value there counts.
const INPUT_ROUNDING: f64 = 1e-12;

/// Time derivatives of the input at the communication point, orders 1 to 3 [SI per sⁿ]. The input
/// of the next step is the Taylor polynomial that they make; afterwards they are forgotten.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InputDerivatives(pub [f64; 3]);

impl InputDerivatives {
    /// The input stays as it was set.
    pub const NONE: InputDerivatives = InputDerivatives([0.0; 3]);

    /// The input at `late` \[s\] after the communication point, where it was `input`.
    fn input_after(self, input: f64, late: f64) -> f64 {
        let [first, second, third] = self.0;
        input + late * (first + late / 2.0 * (second + late / 3.0 * third))
    }

    /// Time derivative of the input at `late` \[s\] after the communication point.
    fn rate_after(self, late: f64) -> f64 {
        let [first, second, third] = self.0;
        first + late * (second + late / 2.0 * third)
    }

    /// True where the polynomial does not begin at the joint's present input. Without derivatives
    /// the input as set is that at the end of the step, and none jumps.
    fn jumps(self, present: f64, set: f64, step: f64) -> bool {
        let [first, second, third] = self.0.map(f64::abs);
        let size = InputDerivatives([first, second, third]).input_after(set.abs(), step);
        self != InputDerivatives::NONE
            && (set - present).abs() > INPUT_ROUNDING * size.max(present.abs())
    }

    /// Times \[s\] within a step at which the input turns, in order, then infinity. The joint
    /// remembers turning values alone, so that these and the end of the step are all it needs of
    /// the polynomial.
    fn turns_within(self, step: f64) -> [f64; 2] {
        let [first, second, third] = self.0;
        // Roots of first + second t + third t²/2, in the form that loses no digits.
        let discriminant = second * second - 2.0 * third * first;
        if discriminant < 0.0 {
            return [f64::INFINITY; 2];
        }
        let sum = -(second + discriminant.sqrt().copysign(second));
        let within = |turn: f64| {
            if turn > 0.0 && turn < step {
                turn
            } else {
                f64::INFINITY
            }
        };
        let (one, other) = (within(sum / third), within(2.0 * first / sum));
        [one.min(other), one.max(other)]
    }
}

impl Instance {
    /// Moves the joint over a step of `size` \[s\] from `point` \[s\]. The input, as set before, is
    /// the input at the *end* of the step, unless derivatives were set: then it is the input at the
    /// beginning, reached by a jump where it is not there. On a refusal everything is as before.
    pub fn step(&mut self, point: f64, size: f64) -> Result<(), Refusal> {
        let end = self.check_step(point, size)?;
        let motion = &mut self.motion;
        let Some(simulation) = &mut motion.simulation else {
            return Ok(());
        };
        let (given, set) = (motion.derivatives, motion.input);
        let before = simulation.output();
        // Where the step begins, then the end of each leg: at most a jump, two turns and the end.
        let mut way = [(motion.time, simulation.input()); 5];
        let mut legs = 0;
        let mut lead = |time: f64, input: f64| {
            legs += 1;
            way[legs] = (time, input);
        };
        if given.jumps(simulation.input(), set, size) {
            lead(motion.time, set);
        }
        let turns = given.turns_within(size);
        for turn in turns.into_iter().filter(|turn| turn.is_finite()) {
            let time = (point + turn).clamp(motion.time, end);
            lead(time, given.input_after(set, turn));
        }
        lead(end, given.input_after(set, size));
        let ends = simulation.follow(&way[1..=legs])?;
        let elapsed = time_passing(motion.time, end);
        let still = Output {
            time: ends[1].time,
            ..before
        };
        let moved = elapsed > 0.0 || ends[1] != still;
        if legs > 1 {
            // What is lost in no time has no power.
            let lost = ends[1].dissipation - before.dissipation;
            motion.dissipation_rate = if elapsed > 0.0 { lost / elapsed } else { 0.0 };
        } else if moved {
            motion.dissipation_rate = ends[1].dissipation_rate;
        }
        if moved {
            let leg = Leg {
                ends,
                inputs: [way[legs - 1].1, way[legs].1],
                input_rate: (given != InputDerivatives::NONE).then(|| given.rate_after(size)),
            };
            let slopes = simulation.sensitivity();
            motion.rates = Rates::of(&leg, &slopes, simulation.has_effects());
            if elapsed > 0.0 {
                let beyond_mean = motion.rates.dissipation - motion.dissipation_rate;
                motion.rates.dissipation_rate = 2.0 * beyond_mean / elapsed;
            }
            motion.step = elapsed;
        }
        motion.time = end;
        motion.derivatives = InputDerivatives::NONE;
        Ok(())
    }

    /// End of the step \[s\]; never before the instance's own time, whatever rounding made of it.
    fn check_step(&self, point: f64, size: f64) -> Result<f64, Refusal> {
        let now = self.motion.time;
        if !size.is_finite() || size < 0.0 {
            return Err(Refusal::StepSize { came: size });
        }
        let tolerance = TIME_TOLERANCE * now.abs().max(1.0);
        // Written so that NaN is refused.
        let close = (point - now).abs() <= tolerance;
        if !close {
            return Err(Refusal::CommunicationPoint {
                expected: now,
                tolerance,
                came: point,
            });
        }
        let end = (point + size).max(now);
        if let Some(stop) = self.motion.stop
            && end > stop + tolerance
        {
            return Err(Refusal::PastStop { stop, came: end });
        }
        Ok(end)
    }

    /// Takes time derivatives of the input for the next step; all of them or none.
    pub fn set_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        values: &[f64],
    ) -> Result<(), Refusal> {
        let mut derivatives = self.motion.derivatives;
        let largest = derivatives.0.len();
        for ((&reference, &order), &value) in references.iter().zip(orders).zip(values) {
            let variable = self.input_variable(reference)?;
            let slot = usize::try_from(order)
                .ok()
                .and_then(|order| order.checked_sub(1));
            let slot = slot.and_then(|slot| derivatives.0.get_mut(slot));
            let slot = slot.ok_or(Refusal::Order {
                largest,
                came: order,
            })?;
            if !value.is_finite() {
                let (lower, upper) = (f64::MIN, f64::MAX);
                let name = format!("derivative {order} of {}", variable.name);
                return Err(Refusal::OutOfRange {
                    name,
                    lower,
                    upper,
                    came: value,
                });
            }
            *slot = value;
        }
        self.motion.derivatives = derivatives;
        Ok(())
    }
}
