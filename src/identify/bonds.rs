//! Operators that hold more while they rest: the law of `joint/sticking.rs` over a bank, solved within
//! each step.

use super::lanes::{Columns, LANES, Lanes, sum, total};
use crate::joint::sticking::{FALL, left, slide};
use pulp::{Arch, NullaryFnOnce};

/// What is left of the excess of every operator, and the input and limits of the trial that an accepted step takes it from.
#[derive(Debug, Clone)]
pub(super) struct Bonds {
    excess: f64,
    left: Vec<Lanes>,
    last: (f64, (f64, f64)),
}

impl Bonds {
    /// Virgin operators, `LANES × groups` of them, that hold more by this share while they rest.
    pub fn new(excess: f64, groups: usize) -> Bonds {
        Bonds {
            excess,
            left: vec![[1.0; LANES]; groups],
            last: (0.0, (1.0, 1.0)),
        }
    }

    /// Plays tried at an input, as [`Bank::plays`](super::lanes::Bank::plays).
    pub fn plays<'a>(
        &'a mut self,
        columns: Columns<'a>,
        input: f64,
        limits: (f64, f64),
    ) -> Plays<'a> {
        self.last = (input, limits);
        Plays(columns, self, input, limits)
    }

    /// Takes the slides of the last trial off the excess.
    pub fn wear(&mut self, arch: Arch, columns: Columns<'_>) {
        arch.dispatch(Wear(columns, self));
    }
}

/// The slide of an operator that stands `stands` away from rest under limits `high` and `low`, and how
/// much of an increment of `stands` it follows.
#[inline(always)]
fn slid(stands: f64, threshold: f64, (up, down): (f64, f64), excess: f64) -> (f64, f64) {
    let limit = threshold * if stands < 0.0 { down } else { up };
    let (size, full) = (stands.abs(), excess * limit);
    let slide = slide(size - limit - full, full);
    let fallen = if slide >= size - limit { 1.0 } else { FALLING };
    let follows = if slide > 0.0 { fallen } else { 0.0 };
    (slide.copysign(stands), follows)
}

/// Slide per increment while the excess falls.
const FALLING: f64 = 1.0 / (1.0 - FALL);

pub(super) struct Plays<'a>(Columns<'a>, &'a Bonds, f64, (f64, f64));

impl NullaryFnOnce for Plays<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn call(self) -> (f64, f64) {
        let Plays(at, bonds, input, limits) = self;
        let mut tangent = [0.0; LANES];
        let held = at.positions.iter().zip(at.thresholds).zip(&bonds.left);
        for ((trial, weight), ((position, threshold), left)) in
            at.trial.iter_mut().zip(at.weights).zip(held)
        {
            for i in 0..LANES {
                let excess = bonds.excess * left[i];
                let (slide, follows) = slid(input - position[i], threshold[i], limits, excess);
                trial[i] = position[i] + slide;
                tangent[i] += weight[i] * follows;
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
        let (input, (up, down)) = bonds.last;
        let excess = bonds.excess;
        let held = at.positions.iter().zip(&*at.trial).zip(at.thresholds);
        for (lanes, ((from, to), threshold)) in bonds.left.iter_mut().zip(held) {
            for i in 0..LANES {
                let slide = to[i] - from[i];
                let force = input - to[i];
                let limit = threshold[i] * if force < 0.0 { down } else { up };
                lanes[i] = left(lanes[i], slide.abs(), excess * limit, force.abs() / limit);
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

    /// Largest difference, over turnings of falling size, between operators that are solved within each step
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
                let force = bank.weight() * at - bank.plays(at, (1.0, 1.0)).0;
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
        for step in 1..=400 {
            let input = 0.01 * f64::from(step);
            forces.push(input - bank.plays(input, (1.0, 1.0)).0);
            bank.accept();
        }
        let highest = forces.iter().copied().fold(0.0, f64::max);
        assert!((highest - 1.3).abs() < 0.011, "{highest}");
        assert!((forces[399] - 1.0).abs() < 1e-12, "{}", forces[399]);
    }
}
