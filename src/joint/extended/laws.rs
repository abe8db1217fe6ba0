//! The effects of one joint, asked place by place.

use std::ops::Range;

use crate::joint::effect::{Acting, Place, Places, Response, Situation, SlipLimit};

/// One effect and where its history lies in the simulation's memory.
#[derive(Debug, Clone)]
pub(super) struct Law {
    pub acting: Acting,
    /// Where it acts, and where else.
    pub places: Places,
    pub span: Range<usize>,
}

/// All effects of a joint with their history.
#[derive(Debug, Clone)]
pub(super) struct Laws {
    laws: Vec<Law>,
    memory: Vec<f64>,
}

impl Laws {
    /// The effects that act on the joint itself; those of the measuring chain are left out.
    pub fn new(effects: &[Acting]) -> Laws {
        let mut laws = Vec::new();
        let mut length = 0;
        for acting in effects
            .iter()
            .filter(|a| !a.effect.place().is_measurement())
        {
            let end = length + acting.effect.memory();
            laws.push(Law {
                acting: acting.clone(),
                places: acting.effect.places(&acting.values),
                span: length..end,
            });
            length = end;
        }
        Laws {
            laws,
            memory: vec![0.0; length],
        }
    }

    /// Count of effects.
    pub fn len(&self) -> usize {
        self.laws.len()
    }

    /// Effects in order, each with its history.
    pub fn iter(&self) -> impl Iterator<Item = (&Law, &[f64])> {
        self.laws
            .iter()
            .map(|law| (law, &self.memory[law.span.clone()]))
    }

    /// History of all effects.
    pub fn memory(&self) -> &[f64] {
        &self.memory
    }

    /// Puts back a saved history of the same length.
    pub fn restore(&mut self, memory: &[f64]) {
        self.memory.copy_from_slice(memory);
    }

    /// Product of all slip limits.
    pub fn slip_limit(&self, last: &Situation) -> SlipLimit {
        self.at(Place::SlipLimit)
            .map(|(law, memory)| {
                law.acting
                    .effect
                    .slip_limit(&law.acting.values, last, memory)
            })
            .fold(SlipLimit::UNCHANGED, |all, one| SlipLimit {
                positive: all.positive * one.positive,
                negative: all.negative * one.negative,
            })
    }

    /// Sum of what contacts at rest hold more.
    pub fn sticking(&self) -> f64 {
        let each = self
            .at(Place::SlipLimit)
            .map(|(law, _)| law.acting.effect.sticking(&law.acting.values));
        each.sum()
    }

    /// Force beside the network at slip u and its rate, `Σ p(u, u̇)`.
    pub fn beside_slip(&self, slip: (f64, f64)) -> Response {
        self.sum(Place::BesideSlip, |law, memory| {
            law.beside_slip(slip, memory)
        })
    }

    /// Force beside the joint at displacement U and rate V.
    pub fn beside_joint(&self, displacement: f64, velocity: f64) -> Response {
        self.sum(Place::BesideJoint, |law, _| {
            law.beside_joint(displacement, velocity)
        })
    }

    /// Displacement beyond F/K_1 and of all that lies in series, at the end of a step.
    pub fn in_load_path(&self, force: f64, step: f64) -> Response {
        let spring = self.sum(Place::Spring, |law, _| law.spring(force));
        let series = self.sum(Place::InSeries, |law, memory| {
            law.in_series(force, step, memory)
        });
        plus(spring, series)
    }

    /// The effect at these places whose answers fall most, where one falls.
    pub fn falling(
        &self,
        places: [Place; 2],
        slope: impl Fn(&Law, Place, &[f64]) -> f64,
    ) -> Option<&'static str> {
        let each = self.iter().map(|(law, memory)| {
            let here = law.places().filter(|place| places.contains(place));
            let sum: f64 = here.map(|place| slope(law, place, memory)).sum();
            (sum, law.acting.effect.name())
        });
        each.filter(|(slope, _)| *slope < 0.0)
            .min_by(|one, other| one.0.total_cmp(&other.0))
            .map(|(_, name)| name)
    }

    /// Shows an accepted sample to every effect.
    pub fn remember(&mut self, now: &Situation) {
        for law in &self.laws {
            law.remember(now, &mut self.memory[law.span.clone()]);
        }
    }

    fn at(&self, place: Place) -> impl Iterator<Item = (&Law, &[f64])> {
        self.iter().filter(move |(law, _)| law.acts_at(place))
    }

    fn sum(&self, place: Place, answer: impl Fn(&Law, &[f64]) -> Response) -> Response {
        self.at(place)
            .map(|(law, memory)| answer(law, memory))
            .fold(Response::default(), plus)
    }
}

impl Law {
    /// Where it acts.
    pub fn places(&self) -> impl Iterator<Item = Place> {
        self.places.into_iter().flatten()
    }
    /// True where it acts at this place.
    pub fn acts_at(&self, place: Place) -> bool {
        self.places.contains(&Some(place))
    }
    pub fn beside_slip(&self, slip: (f64, f64), memory: &[f64]) -> Response {
        let acting = &self.acting;
        acting.effect.beside_slip(&acting.values, slip, memory)
    }
    pub fn beside_joint(&self, displacement: f64, velocity: f64) -> Response {
        let acting = &self.acting;
        acting
            .effect
            .beside_joint(&acting.values, displacement, velocity)
    }
    pub fn spring(&self, force: f64) -> Response {
        self.acting.effect.spring(&self.acting.values, force)
    }
    pub fn in_series(&self, force: f64, step: f64, memory: &[f64]) -> Response {
        let acting = &self.acting;
        acting.effect.in_series(&acting.values, force, step, memory)
    }
    pub fn remember(&self, now: &Situation, memory: &mut [f64]) {
        self.acting
            .effect
            .remember(&self.acting.values, now, memory);
    }
    pub fn stored_energy(&self, now: &Situation, memory: &[f64]) -> Option<f64> {
        let acting = &self.acting;
        acting.effect.stored_energy(&acting.values, now, memory)
    }
}

fn plus(one: Response, other: Response) -> Response {
    Response {
        value: one.value + other.value,
        slope: one.slope + other.slope,
        damping: one.damping + other.damping,
    }
}
