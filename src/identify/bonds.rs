//! Operators that hold more while they rest: the law of `joint/sticking.rs` over a bank, solved within
//! each step.

use super::lanes::{Columns, LANES, Lanes, sum, total};
use crate::joint::sticking::{FALL, left, slide};
use pulp::{Arch, NullaryFnOnce};

/// What is left of the excess of every operator, and the trial that an accepted step takes it from.
#[derive(Debug, Clone)]
pub(super) struct Bonds {
    excess: f64,
    left: Vec<Lanes>,
    last: Tried,
}

/// An input of the plays or an increment of the stops, and the limits beside it.
#[derive(Debug, Clone, Copy)]
enum Tried {
    Plays(f64, (f64, f64)),
    Stops(f64, (f64, f64)),
}

impl Bonds {
    /// Virgin operators, `32 × groups` of them, that hold more by this share while they rest.
    pub fn new(excess: f64, groups: usize) -> Bonds {
        Bonds {
            excess,
            left: vec![[1.0; LANES]; groups],
            last: Tried::Plays(0.0, (1.0, 1.0)),
        }
    }

    /// Plays tried at an input, as [`Bank::plays`](super::lanes::Bank::plays).
    pub fn plays<'a>(
        &'a mut self,
        columns: Columns<'a>,
        input: f64,
        limits: (f64, f64),
    ) -> Plays<'a> {
        self.last = Tried::Plays(input, limits);
        Plays(columns, self, input, limits)
    }

    /// Stops tried after an increment, as [`Bank::stops`](super::lanes::Bank::stops).
    pub fn stops<'a>(
        &'a mut self,
        columns: Columns<'a>,
        increment: f64,
        limits: (f64, f64),
    ) -> Stops<'a> {
        self.last = Tried::Stops(increment, limits);
        Stops(columns, self, increment, limits)
    }

    /// Takes the slides of the last trial off the excess.
    pub fn wear(&mut self, arch: Arch, columns: Columns<'_>) {
        arch.dispatch(Wear(columns, self));
    }
}

/// How an operator that stands at `stands` on one side of its `limit` slides.
#[inline(always)]
fn slid(stands: f64, limit: f64, excess: f64) -> f64 {
    slide(stands - limit - excess, excess)
}

/// Share of a slide's increment that is not from the excess falling.
#[inline(always)]
fn followed(slide: f64, stands: f64, limit: f64) -> f64 {
    match slide > 0.0 {
        false => 0.0,
        true if slide >= stands - limit => 1.0,
        true => 1.0 / (1.0 - FALL),
    }
}

pub(super) struct Plays<'a>(Columns<'a>, &'a Bonds, f64, (f64, f64));

impl NullaryFnOnce for Plays<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn call(self) -> (f64, f64) {
        let Plays(at, bonds, input, (up, down)) = self;
        let mut tangent = [0.0; LANES];
        for (k, trial) in at.trial.iter_mut().enumerate() {
            for i in 0..LANES {
                let (threshold, full) = (at.thresholds[k][i], bonds.excess * bonds.left[k][i]);
                let (high, low) = (threshold * up, threshold * down);
                let stands = input - at.positions[k][i];
                let forth = slid(stands, high, full * high);
                let back = slid(-stands, low, full * low);
                trial[i] = at.positions[k][i] + forth - back;
                let moved = followed(forth, stands, high) + followed(back, -stands, low);
                tangent[i] += at.weights[k][i] * moved;
            }
        }
        (sum(at.trial, at.weights), total(tangent))
    }
}

pub(super) struct Stops<'a>(Columns<'a>, &'a Bonds, f64, (f64, f64));

impl NullaryFnOnce for Stops<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn call(self) -> (f64, f64) {
        let Stops(at, bonds, increment, (up, down)) = self;
        let mut tangent = [0.0; LANES];
        for (k, trial) in at.trial.iter_mut().enumerate() {
            for i in 0..LANES {
                let (threshold, full) = (at.thresholds[k][i], bonds.excess * bonds.left[k][i]);
                let (high, low) = (threshold * up, threshold * down);
                let stands = at.positions[k][i] + increment;
                let forth = slid(stands, high, full * high);
                let back = slid(-stands, low, full * low);
                trial[i] = stands - forth + back;
                let slid = followed(forth, stands, high) + followed(back, -stands, low);
                tangent[i] += at.weights[k][i] * (1.0 - slid);
            }
        }
        (sum(at.trial, at.weights), total(tangent))
    }
}

struct Wear<'a>(Columns<'a>, &'a mut Bonds);

impl NullaryFnOnce for Wear<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Wear(at, bonds) = self;
        for (k, lanes) in bonds.left.iter_mut().enumerate() {
            for (i, bond) in lanes.iter_mut().enumerate() {
                let (from, to) = (at.positions[k][i], at.trial[k][i]);
                let (slide, force, (up, down)) = match bonds.last {
                    Tried::Plays(input, limits) => (to - from, input - to, limits),
                    Tried::Stops(increment, limits) => (from + increment - to, to, limits),
                };
                let share = if force < 0.0 { down } else { up };
                let limit = at.thresholds[k][i] * share;
                *bond = left(
                    *bond,
                    slide.abs(),
                    bonds.excess * limit,
                    force.abs() / limit,
                );
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::lanes::Bank;
    use crate::joint::{Network, Sliders, SlipLimit};

    const EXCESS: f64 = 0.3;

    fn sliders() -> (Vec<f64>, Vec<f64>) {
        let slip_at = (1..=40).map(|j| 0.02 * f64::from(j)).collect();
        (slip_at, vec![1.0; 40])
    }

    /// Largest difference, over turnings of falling size, between stops that are solved within each step
    /// and a network whose limits are those of the step before, over the largest force.
    fn apart(steps_per_leg: u32) -> f64 {
        let (slip_at, weight) = sliders();
        let pairs: Vec<(f64, f64)> = slip_at.iter().copied().zip(weight.clone()).collect();
        let mut bank = Bank::new(pairs.into_iter()).sticking(EXCESS);
        let sliders = Sliders::new(weight, slip_at, 0.0);
        let Ok(sliders) = sliders else {
            unreachable!("the sliders above are sliders")
        };
        let mut network = Network::new(&sliders).sticking(EXCESS);
        let (mut at, mut worst, mut largest) = (0.0, 0.0_f64, 0.0_f64);
        for turning in [1.0, -1.0, 0.7, -0.4, 0.9] {
            let step = (turning - at) / f64::from(steps_per_leg);
            for _ in 0..steps_per_leg {
                at += step;
                let (force, _) = bank.stops(step, (1.0, 1.0));
                bank.accept();
                network.begin(SlipLimit::UNCHANGED);
                let dissipated = network.accept(at);
                assert!(dissipated >= 0.0, "{dissipated} at {at}");
                worst = worst.max((force - network.force()).abs());
                largest = largest.max(force.abs());
            }
            at = turning;
        }
        worst / largest
    }

    #[test]
    fn the_network_comes_to_the_same_as_its_steps_get_small() {
        let (coarse, fine) = (apart(200), apart(3200));
        assert!(coarse < 0.05, "{coarse}");
        assert!(fine < coarse / 8.0, "{fine} after {coarse}");
    }

    #[test]
    fn a_contact_breaks_away_above_the_force_at_which_it_slides() {
        let mut bank = Bank::new([(1.0, 1.0)].into_iter()).sticking(EXCESS);
        let mut forces = Vec::new();
        for _ in 0..400 {
            forces.push(bank.stops(0.01, (1.0, 1.0)).0);
            bank.accept();
        }
        let highest = forces.iter().copied().fold(0.0, f64::max);
        assert!((highest - 1.3).abs() < 0.011, "{highest}");
        assert!((forces[399] - 1.0).abs() < 1e-12, "{}", forces[399]);
    }
}
