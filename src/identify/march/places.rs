//! What the effects do at their places, summed, with the slopes that a step's equation needs.

use super::{March, index};
use crate::joint::effect::{Acting, Place, Response, Trajectory};

/// Force beside the joint over U, or beside the slip over u, with its derivatives.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Beside {
    /// \[N\].
    pub force: f64,
    /// d/dU or d/du \[N/m\], by way of the rate included.
    pub slope: f64,
    /// The same with the rate held.
    pub held: f64,
    /// The same by the two values before, latest first, by way of the rate.
    pub earlier: [f64; 2],
    /// The rate \[m/s\].
    pub velocity: f64,
}

impl Beside {
    fn at(velocity: f64) -> Beside {
        Beside {
            velocity,
            ..Beside::default()
        }
    }

    /// Takes in a law, with d rate / d value for the end of the step and the two before it.
    fn add(&mut self, response: Response, rate: [f64; 3]) {
        self.force += response.value;
        self.held += response.slope;
        self.slope += response.slope + response.damping * rate[0];
        let earlier = self.earlier.iter_mut().zip(&rate[1..]);
        earlier.for_each(|(sum, per)| *sum += response.damping * per);
    }
}

/// Where the joint was one step before the last one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Earlier {
    pub displacement: f64,
    pub slip: f64,
    /// Length of the step that led on from there \[s\].
    pub step: f64,
}

impl March<'_> {
    /// What acts beside the slip at the end of a step.
    pub(super) fn beside_slip(&self, slip: f64, step: f64) -> Beside {
        if !self.has[index(Place::BesideSlip)] {
            return Beside::default();
        }
        let before = self.earlier.map(|e| (e.slip, e.step));
        let (rate, per_slip) = rate(slip, (self.last.slip, self.last.slip_rate), before, step);
        let mut sum = Beside::at(rate);
        for (acting, memory) in self.effects.iter().zip(&self.memories) {
            if acting.acts_at(Place::BesideSlip) {
                let (values, at) = (&acting.values, (slip, rate));
                sum.add(acting.effect.beside_slip(values, at, memory), per_slip);
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
        let before = self.earlier.map(|e| (e.displacement, e.step));
        let last = (self.last.displacement, self.last.velocity);
        let (velocity, per_displacement) = rate(displacement, last, before, step);
        let mut sum = Beside::at(velocity);
        for acting in self.effects {
            if acting.acts_at(Place::BesideJoint) {
                let response = acting
                    .effect
                    .beside_joint(&acting.values, displacement, velocity);
                sum.add(response, per_displacement);
            }
        }
        sum
    }
}

/// Rate of what went from the last value, with its rate, to this one within a step: a backward difference of second order
/// where the value before those is known, with the step from there; also d rate / d value, for this one and the two before.
fn rate(
    now: f64,
    (last, its_rate): (f64, f64),
    before: Option<(f64, f64)>,
    step: f64,
) -> (f64, [f64; 3]) {
    if step <= 0.0 {
        return (its_rate, [0.0; 3]);
    }
    let first = (now - last) / step;
    match before {
        Some((before, length)) if length > 0.0 => {
            let previous = (last - before) / length;
            let weight = step / (step + length);
            let (own, oldest) = ((1.0 + weight) / step, weight / length);
            let rate = first + weight * (first - previous);
            (rate, [own, -own - oldest, oldest])
        }
        _ => (first, [1.0 / step, -1.0 / step, 0.0]),
    }
}

/// True where a force beside the slip follows its rate.
pub(super) fn damps_slip(acting: &Acting) -> bool {
    let rests = vec![0.0; acting.effect.memory()];
    let moving = || {
        acting
            .effect
            .beside_slip(&acting.values, (0.0, 1.0), &rests)
    };
    acting.acts_at(Place::BesideSlip) && moving().damping != 0.0
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
