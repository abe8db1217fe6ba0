//! One communication step.

use super::derivatives::{Leg, Rates};
use super::instance::Instance;
use super::refusal::Refusal;

/// A communication point may differ from the instance's own time by this, relative to the time
/// (absolute below one second): importers that sum their steps were seen to be off by 1e-9.
const TIME_TOLERANCE: f64 = 1e-8;

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
    /// the input at the *end* of the step, unless derivatives were set. On a refusal everything is
    /// as before.
    pub fn step(&mut self, point: f64, size: f64) -> Result<(), Refusal> {
        let end = self.check_step(point, size)?;
        let motion = &mut self.motion;
        let Some(simulation) = &mut motion.simulation else {
            return Ok(());
        };
        let (given, set) = (motion.derivatives, motion.input);
        let turns = given.turns_within(size);
        let legs = 1 + turns.iter().filter(|turn| turn.is_finite()).count();
        // Where the step begins, then the end of each leg; at most two turns, so three legs.
        let mut way = [
            (motion.time, simulation.input()),
            (end, 0.0),
            (end, 0.0),
            (end, 0.0),
        ];
        for (place, turn) in turns.into_iter().take(legs - 1).enumerate() {
            let time = (point + turn).clamp(motion.time, end);
            way[place + 1] = (time, given.input_after(set, turn));
        }
        way[legs] = (end, given.input_after(set, size));
        let before = simulation.output();
        let ends = simulation.follow(&way[1..=legs])?;
        let elapsed = end - motion.time;
        let moved = elapsed > 0.0 || ends[1] != before;
        if legs == 1 {
            motion.dissipation_rate = ends[1].dissipation_rate;
        } else {
            motion.dissipation_rate = (ends[1].dissipation - before.dissipation) / elapsed;
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
