//! The Iwan network as sliders in stop form: driven by slip, answers with force.

use super::density::Sliders;
use super::effect::SlipLimit;
use super::sticking::{FALL, left};

/// A finite network in motion. Slider j carries the force `f_j`, and
///
/// `f_j ← clamp(f_j + w_j Δu, −w_j d_j n₋, +w_j d_j n₊)`, `F = Σ f_j + S_∞ u` (Eq. 27, 28),
///
/// where n± multiply the break-free forces for this step. A slider that stands above a lowered
/// limit lets go first, at held u, and then follows Δu: so its frictional work is exact and never
/// negative. Checked in tests/network.rs against the play form and against the work done.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    sliders: Vec<Slider>,
    elastic: f64,
    slip: f64,
    /// Share by which a slider that rests holds more than one that slides.
    excess: f64,
    /// Limit of the open step, and what it lost by letting sliders go.
    limit: SlipLimit,
    let_go: f64,
    gross: f64,
}

/// One slider; side by side in memory, since every step touches all of it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Slider {
    /// w \[N/m\].
    weight: f64,
    /// w d \[N\], of the slider once it slides.
    strength: f64,
    /// What it holds in the open step \[N\], no less.
    holds: f64,
    /// Share of the excess left, as last accepted, and in the open step.
    bond: f64,
    open_bond: f64,
    /// f \[N\] as last accepted.
    force: f64,
    /// f \[N\] after letting go at the limit of the open step.
    relaxed: f64,
}

impl Slider {
    /// Force if it stuck, and the force that it can carry.
    fn after(&self, increment: f64, limit: SlipLimit) -> (f64, f64) {
        let stuck = self.relaxed + self.weight * increment;
        (stuck, clamped(stuck, self.holds, limit))
    }

    /// Force and stiffness. At its limit a slider slides if pushed on and sticks if pushed back.
    fn tried(&self, increment: f64, limit: SlipLimit, rising: bool) -> (f64, f64) {
        let (stuck, force) = self.after(increment, limit);
        let share = if rising {
            limit.positive
        } else {
            -limit.negative
        };
        // No short circuit: this is the innermost loop, and a wrong guess costs more.
        let sticks = (stuck == force) & (force != self.holds * share);
        (force, if sticks { self.weight } else { 0.0 })
    }

    /// Force at which it slides towards the side on which it stands \[N\].
    fn kinetic(&self, limit: SlipLimit) -> f64 {
        let share = if self.force < 0.0 {
            limit.negative
        } else {
            limit.positive
        };
        self.strength * share
    }

    /// Lets go what stands above the limit: with an excess the limit falls as it slides, `f' = φ + e −
    /// β (f − f')` down to φ.
    fn relax(&mut self, limit: SlipLimit, excess: f64) {
        let kinetic = self.kinetic(limit);
        let full = kinetic * excess;
        let stands = self.force.abs();
        let fallen = (kinetic + full * self.bond - FALL * stands) / (1.0 - FALL);
        let rests = stands.min(fallen.max(kinetic));
        self.open_bond = left(self.bond, stands - rests, full, rests / kinetic);
        self.holds = self.strength * (1.0 + excess * self.open_bond);
        self.relaxed = rests.copysign(self.force);
    }

    /// Lets go what stands above the limit of a step that opens; returns what that loses \[J\].
    fn open(&mut self, limit: SlipLimit, excess: f64) -> f64 {
        if excess > 0.0 {
            self.relax(limit, excess);
        } else {
            self.relaxed = clamped(self.force, self.strength, limit);
        }
        let (held, left) = (self.force, self.relaxed);
        0.5 * (held - left) * (held + left) / self.weight
    }

    /// Takes the slide of an accepted step off the excess.
    fn wear(&mut self, slide: f64, limit: SlipLimit, excess: f64) {
        let kinetic = self.kinetic(limit);
        self.bond = left(
            self.open_bond,
            slide,
            kinetic * excess,
            self.force.abs() / kinetic,
        );
        self.open_bond = self.bond;
    }
}

/// A limit below zero, or none at all, is no friction.
fn not_negative(limit: SlipLimit) -> SlipLimit {
    SlipLimit {
        positive: limit.positive.max(0.0),
        negative: limit.negative.max(0.0),
    }
}

/// One instruction per bound, where `f64::clamp` also looks after numbers that are none.
fn clamped(force: f64, strength: f64, limit: SlipLimit) -> f64 {
    let (low, high) = (-strength * limit.negative, strength * limit.positive);
    let above = if force > low { force } else { low };
    if above < high { above } else { high }
}

/// What the network would answer at a slip. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Trial {
    /// F \[N\].
    pub force: f64,
    /// dF/du \[N/m\] along the direction asked for.
    pub stiffness: f64,
    /// About `Σ |f_j|` \[N\], no less: the scale of rounding errors in F.
    pub gross: f64,
}

impl Network {
    /// A virgin network at u = 0.
    pub fn new(sliders: &Sliders) -> Network {
        let pairs = sliders.weight.iter().zip(&sliders.slip_at);
        let sliders_at_rest = pairs.map(|(weight, slip_at)| Slider {
            weight: *weight,
            strength: weight * slip_at,
            holds: weight * slip_at,
            bond: 1.0,
            open_bond: 1.0,
            force: 0.0,
            relaxed: 0.0,
        });
        Network {
            sliders: sliders_at_rest.collect(),
            elastic: sliders.elastic,
            slip: 0.0,
            excess: 0.0,
            limit: SlipLimit::UNCHANGED,
            let_go: 0.0,
            gross: 0.0,
        }
    }

    /// The network, virgin still, of sliders that hold more by this share while they rest; each
    /// falls to its limit with its own slide, at the end of the steps in which it slides (see
    /// [`sticking`](super::sticking)).
    pub fn sticking(mut self, excess: f64) -> Network {
        self.excess = excess.max(0.0);
        for slider in &mut self.sliders {
            slider.holds = slider.strength * (1.0 + self.excess);
        }
        self
    }

    /// Slip displacement u \[m\] last accepted.
    pub fn slip(&self) -> f64 {
        self.slip
    }

    /// Force \[N\] last accepted.
    pub fn force(&self) -> f64 {
        self.sliders.iter().map(|s| s.force).sum::<f64>() + self.elastic * self.slip
    }

    /// `Σ f_j²/(2 w_j) + S_∞ u²/2` \[J\].
    pub fn stored_energy(&self) -> f64 {
        let sliders: f64 = self
            .sliders
            .iter()
            .map(|s| 0.5 * s.force * s.force / s.weight)
            .sum();
        sliders + 0.5 * self.elastic * self.slip * self.slip
    }

    /// Force \[N\] at which every slider slips towards positive u (or negative, as a magnitude)
    /// under the limit of this step; infinite with an elastic remainder.
    pub fn full_slip_force(&self, positive: bool) -> f64 {
        if self.elastic > 0.0 {
            return f64::INFINITY;
        }
        let share = if positive {
            self.limit.positive
        } else {
            self.limit.negative
        };
        self.sliders.iter().map(|s| s.holds).sum::<f64>() * share
    }

    /// Opens a step under `limit`: sliders above it let go at held u. Undone by the next `begin`.
    pub fn begin(&mut self, limit: SlipLimit) {
        let limit = not_negative(limit);
        if limit == self.limit && self.excess == 0.0 {
            return; // relaxed already, by the last step
        }
        self.limit = limit;
        self.let_go = 0.0;
        self.gross = 0.0;
        for slider in &mut self.sliders {
            self.let_go += slider.open(limit, self.excess);
            self.gross += slider.relaxed.abs();
        }
    }

    /// Force \[N\], frictional work and stored energy \[J\] of a step to `slip` under another limit than that of the open
    /// step.
    pub fn under(&self, limit: SlipLimit, slip: f64) -> [f64; 3] {
        let (limit, increment) = (not_negative(limit), slip - self.slip);
        let remainder = self.elastic * slip;
        let mut sums = [remainder, 0.0, 0.5 * remainder * slip];
        for slider in &self.sliders {
            let mut opened = *slider;
            let let_go = opened.open(limit, self.excess);
            let (stuck, force) = opened.after(increment, limit);
            sums[0] += force;
            sums[1] += let_go + force * (stuck - force) / slider.weight;
            sums[2] += 0.5 * force * force / slider.weight;
        }
        sums
    }

    /// Answer at `slip` \[m\] within the open step; `rising` tells which side of a kink counts.
    pub fn trial(&self, slip: f64, rising: bool) -> Trial {
        let increment = slip - self.slip;
        let (mut force, mut stiffness) = (0.0, 0.0);
        for slider in &self.sliders {
            let (carried, sticking) = slider.tried(increment, self.limit, rising);
            force += carried;
            stiffness += sticking;
        }
        let remainder = self.elastic * slip;
        Trial {
            force: force + remainder,
            stiffness: stiffness + self.elastic,
            gross: self.gross.max(force.abs()) + stiffness * increment.abs() + remainder.abs(),
        }
    }

    /// Takes `slip` \[m\] as the end of the open step; returns the frictional work \[J\], ≥ 0.
    pub fn accept(&mut self, slip: f64) -> f64 {
        let increment = slip - self.slip;
        let limit = self.limit;
        let mut dissipated = self.let_go;
        self.gross = 0.0;
        for slider in &mut self.sliders {
            let (stuck, force) = slider.after(increment, limit);
            dissipated += force * (stuck - force) / slider.weight;
            self.gross += force.abs();
            (slider.force, slider.relaxed) = (force, force);
            if self.excess > 0.0 {
                slider.wear((stuck - force).abs(), limit, self.excess);
            }
        }
        self.slip = slip;
        self.let_go = 0.0;
        dissipated
    }

    /// Force \[N\] of the sliders that slide on if pushed on towards positive u (or negative): the
    /// dissipation grows by this much per slip.
    pub fn sliding_force(&self, rising: bool) -> f64 {
        let share = if rising {
            self.limit.positive
        } else {
            -self.limit.negative
        };
        let sliding = |slider: &&Slider| slider.force == slider.holds * share;
        self.sliders.iter().filter(sliding).map(|s| s.force).sum()
    }

    /// Length of what [`Network::save`] appends.
    pub fn state_length(&self) -> usize {
        let bonds = if self.excess > 0.0 { 2 } else { 1 };
        bonds * self.sliders.len() + 1
    }

    /// Appends slip, slider forces, and what is left of their excess where they have one.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.push(self.slip);
        state.extend(self.sliders.iter().map(|slider| slider.force));
        if self.excess > 0.0 {
            state.extend(self.sliders.iter().map(|slider| slider.bond));
        }
    }

    /// Puts back what [`Network::save`] appended; `state` has [`Network::state_length`] numbers.
    pub fn restore(&mut self, state: &[f64]) {
        let Some((slip, forces)) = state.split_first() else {
            return;
        };
        self.slip = *slip;
        for (slider, force) in self.sliders.iter_mut().zip(forces) {
            slider.force = *force;
        }
        let bonds = forces.iter().skip(self.sliders.len());
        for (slider, bond) in self.sliders.iter_mut().zip(bonds) {
            slider.bond = *bond;
        }
        // No limit equals this one: the next step relaxes anew.
        self.limit = SlipLimit {
            positive: f64::NAN,
            negative: f64::NAN,
        };
    }
}
