//! What the effects do at their places, summed, with the slopes that a step's equation needs.

use super::{March, index};
use crate::joint::effect::{Acting, Place, Trajectory};

/// Force beside the joint, with its derivatives.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Beside {
    /// \[N\].
    pub force: f64,
    /// d/dU \[N/m\], by way of the rate included.
    pub slope: f64,
    /// The same by the two displacements before, latest first.
    pub earlier: [f64; 2],
    /// Rate of the displacement \[m/s\].
    pub velocity: f64,
}

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

    /// True where effects act in the load path.
    pub(super) fn in_path_acts(&self) -> bool {
        self.has[index(Place::Spring)] || self.has[index(Place::InSeries)]
    }

    pub(super) fn in_path(&self, force: f64, step: f64) -> (f64, f64) {
        if !self.in_path_acts() {
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

    /// What acts beside the joint at the end of a step.
    pub(super) fn beside_joint(&self, displacement: f64, step: f64) -> Beside {
        if !self.has[index(Place::BesideJoint)] {
            return Beside::default();
        }
        let (velocity, per_displacement) = self.velocity(displacement, step);
        let mut sum = Beside {
            velocity,
            ..Beside::default()
        };
        for acting in self.effects {
            if acting.acts_at(Place::BesideJoint) {
                let response = acting
                    .effect
                    .beside_joint(&acting.values, displacement, velocity);
                sum.force += response.value;
                sum.slope += response.slope + response.damping * per_displacement[0];
                let earlier = sum.earlier.iter_mut().zip(&per_displacement[1..]);
                earlier.for_each(|(sum, per)| *sum += response.damping * per);
            }
        }
        sum
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
}

/// What the effects at one channel add to the truth, summed.
pub fn added(effects: &[Acting], place: Place, truth: &Trajectory) -> Option<Vec<f64>> {
    let mut sum: Option<Vec<f64>> = None;
    for acting in effects.iter().filter(|a| a.acts_at(place)) {
        let one = acting.effect.channel(&acting.values, place, truth);
        sum = Some(match sum {
            None => one,
            Some(mut all) => {
                all.iter_mut().zip(&one).for_each(|(a, b)| *a += b);
                all
            }
        });
    }
    sum
}
