//! The Iwan network as sliders in stop form: driven by slip, answers with force.

use super::density::Sliders;
use super::effect::SlipLimit;

/// A finite network in motion. Slider j carries the force `f_j`, and
///
/// `f_j ← clamp(f_j + w_j Δu, −w_j d_j n₋, +w_j d_j n₊)`, `F = Σ f_j + S_∞ u` (Eq. 27, 28),
///
/// where n± multiply the break-free forces for this step. A slider that stands above a lowered
/// limit lets go first, at held u, and then follows Δu: so its frictional work is exact and never
/// negative. Checked in tests/network.rs against the play form and against the work done.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    weight: Vec<f64>,
    strength: Vec<f64>,
    elastic: f64,
    force: Vec<f64>,
    slip: f64,
    limit: SlipLimit,
    relaxed: Vec<f64>,
    let_go: f64,
}

/// What the network would answer at a slip. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Trial {
    /// F \[N\].
    pub force: f64,
    /// dF/du \[N/m\] along the direction asked for.
    pub stiffness: f64,
    /// `Σ |f_j|` \[N\]: the scale of rounding errors in F.
    pub gross: f64,
}

impl Network {
    /// A virgin network at u = 0.
    pub fn new(sliders: &Sliders) -> Network {
        let count = sliders.weight.len();
        let strength = sliders
            .weight
            .iter()
            .zip(&sliders.slip_at)
            .map(|(w, d)| w * d)
            .collect();
        Network {
            weight: sliders.weight.clone(),
            strength,
            elastic: sliders.elastic,
            force: vec![0.0; count],
            slip: 0.0,
            limit: SlipLimit::UNCHANGED,
            relaxed: vec![0.0; count],
            let_go: 0.0,
        }
    }

    /// Slip displacement u \[m\] last accepted.
    pub fn slip(&self) -> f64 {
        self.slip
    }

    /// Force \[N\] last accepted.
    pub fn force(&self) -> f64 {
        self.force.iter().sum::<f64>() + self.elastic * self.slip
    }

    /// `Σ f_j²/(2 w_j) + S_∞ u²/2` \[J\].
    pub fn stored_energy(&self) -> f64 {
        let sliders: f64 = self
            .force
            .iter()
            .zip(&self.weight)
            .map(|(f, w)| 0.5 * f * f / w)
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
        self.strength.iter().sum::<f64>() * share
    }

    /// Opens a step under `limit`: sliders above it let go at held u. Undone by the next `begin`.
    pub fn begin(&mut self, limit: SlipLimit) {
        // A limit below zero, or none at all, is no friction.
        let limit = SlipLimit {
            positive: limit.positive.max(0.0),
            negative: limit.negative.max(0.0),
        };
        self.limit = limit;
        self.let_go = 0.0;
        for j in 0..self.force.len() {
            let (low, high) = (
                -self.strength[j] * limit.negative,
                self.strength[j] * limit.positive,
            );
            let held = self.force[j];
            let left = held.max(low).min(high);
            self.relaxed[j] = left;
            self.let_go += 0.5 * (held - left) * (held + left) / self.weight[j];
        }
    }

    /// Answer at `slip` \[m\] within the open step; `rising` tells which side of a kink counts.
    pub fn trial(&self, slip: f64, rising: bool) -> Trial {
        let increment = slip - self.slip;
        let mut trial = Trial::default();
        for ((start, weight), strength) in self.relaxed.iter().zip(&self.weight).zip(&self.strength)
        {
            let (low, high) = (
                -strength * self.limit.negative,
                strength * self.limit.positive,
            );
            let stuck = start + weight * increment;
            let force = stuck.max(low).min(high);
            let sticks = if rising {
                stuck >= low && stuck < high
            } else {
                stuck > low && stuck <= high
            };
            trial.force += force;
            trial.gross += force.abs();
            trial.stiffness += if sticks { *weight } else { 0.0 };
        }
        let remainder = self.elastic * slip;
        trial.force += remainder;
        trial.gross += remainder.abs();
        trial.stiffness += self.elastic;
        trial
    }

    /// Takes `slip` \[m\] as the end of the open step; returns the frictional work \[J\], ≥ 0.
    pub fn accept(&mut self, slip: f64) -> f64 {
        let increment = slip - self.slip;
        let mut dissipated = self.let_go;
        for j in 0..self.force.len() {
            let strength = self.strength[j];
            let (low, high) = (
                -strength * self.limit.negative,
                strength * self.limit.positive,
            );
            let stuck = self.relaxed[j] + self.weight[j] * increment;
            let force = stuck.max(low).min(high);
            dissipated += force * ((stuck - force) / self.weight[j]);
            self.force[j] = force;
        }
        self.slip = slip;
        self.let_go = 0.0;
        self.relaxed.copy_from_slice(&self.force);
        dissipated
    }

    /// Length of what [`Network::save`] appends.
    pub fn state_length(&self) -> usize {
        self.force.len() + 1
    }

    /// Appends slip and slider forces.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.push(self.slip);
        state.extend_from_slice(&self.force);
    }

    /// Puts back what [`Network::save`] appended; `state` has [`Network::state_length`] numbers.
    pub fn restore(&mut self, state: &[f64]) {
        let Some((slip, force)) = state.split_first() else {
            return;
        };
        self.slip = *slip;
        self.force.copy_from_slice(force);
        self.relaxed.copy_from_slice(force);
        self.let_go = 0.0;
    }
}
