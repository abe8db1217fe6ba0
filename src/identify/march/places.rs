//! What the effects do at their places, summed, with the slopes that a step's equation needs.

use super::{March, index};
use crate::joint::effect::Place;

impl March<'_> {
    pub(super) fn beside_slip(&self, slip: f64) -> (f64, f64) {
        if !self.has[index(Place::BesideSlip)] {
            return (0.0, 0.0);
        }
        let mut sum = (0.0, 0.0);
        for (acting, memory) in self.effects.iter().zip(&self.memories) {
            if acting.acts_at(Place::BesideSlip) {
                let response = acting.effect.beside_slip(&acting.values, slip, memory);
                sum = (sum.0 + response.value, sum.1 + response.slope);
            }
        }
        sum
    }

    pub(super) fn in_path(&self, force: f64, step: f64) -> (f64, f64) {
        if !self.has[index(Place::Spring)] && !self.has[index(Place::InSeries)] {
            return (0.0, 0.0);
        }
        let mut sum = (0.0, 0.0);
        for (acting, memory) in self.effects.iter().zip(&self.memories) {
            for place in acting.places() {
                let response = match place {
                    Place::Spring => acting.effect.spring(&acting.values, force),
                    Place::InSeries => acting.effect.in_series(&acting.values, force, step, memory),
                    _ => continue,
                };
                sum = (sum.0 + response.value, sum.1 + response.slope);
            }
        }
        sum
    }

    /// Force beside the joint and its slope d/dU at the end of a step.
    pub(super) fn beside_joint(&self, displacement: f64, step: f64) -> (f64, f64, f64) {
        if !self.has[index(Place::BesideJoint)] {
            return (0.0, 0.0, 0.0);
        }
        let (velocity, [per_displacement, ..]) = self.velocity(displacement, step);
        let mut sum = (0.0, 0.0);
        for acting in self.effects {
            if acting.acts_at(Place::BesideJoint) {
                let response = acting
                    .effect
                    .beside_joint(&acting.values, displacement, velocity);
                sum = (
                    sum.0 + response.value,
                    sum.1 + response.slope + response.damping * per_displacement,
                );
            }
        }
        (sum.0, sum.1, velocity)
    }

    /// Backward difference of second order where two earlier samples are known; also d rate / dU,
    /// for this sample and the two before it.
    pub(super) fn velocity(&self, displacement: f64, step: f64) -> (f64, [f64; 3]) {
        if step <= 0.0 {
            return (self.last.velocity, [0.0; 3]);
        }
        let first = (displacement - self.last.displacement) / step;
        match self.earlier {
            Some((before, length)) if length > 0.0 => {
                let previous = (self.last.displacement - before) / length;
                let weight = step / (step + length);
                let (own, oldest) = ((1.0 + weight) / step, weight / length);
                let rate = first + weight * (first - previous);
                (rate, [own, -own - oldest, oldest])
            }
            _ => (first, [1.0 / step, -1.0 / step, 0.0]),
        }
    }

    /// −d force beside the joint / d earlier displacements, from its slope at this sample.
    pub(super) fn carried(&self, displacement: f64, step: f64, across_slope: f64) -> [f64; 2] {
        if across_slope == 0.0 {
            return [0.0; 2];
        }
        let (_, [own, before, oldest]) = self.velocity(displacement, step);
        match own > 0.0 {
            true => [-across_slope * before / own, -across_slope * oldest / own],
            false => [0.0; 2],
        }
    }
}
