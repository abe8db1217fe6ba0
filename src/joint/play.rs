//! The dual of a slider network: play operators driven by force (no equation to solve).

use super::density::Sliders;
use super::simulation::JointError;

/// A network in play form, `u = c_0 F + Σ c_j P_j[F]`, thresholds increasing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plays {
    /// `c_0 = 1/S_0` \[m/N\].
    pub compliance: f64,
    /// `c_j = 1/S_j − 1/S_{j−1}` \[m/N\], positive; infinite in the last play where the network
    /// reaches full slip there.
    pub weight: Vec<f64>,
    /// `r_j = G(d_j)` \[N\], increasing.
    pub threshold: Vec<f64>,
}

impl From<&Sliders> for Plays {
    /// `S_j` is the stiffness left after j sliders slipped, `r_j = G(d_j)`, and
    /// `c_j = 1/S_j − 1/S_{j−1} = w_j/(S_j S_{j−1})`.
    fn from(sliders: &Sliders) -> Plays {
        // Sums from the far end keep the small stiffnesses near full slip accurate.
        let mut left = vec![sliders.elastic; sliders.weight.len() + 1];
        for j in (0..sliders.weight.len()).rev() {
            left[j] = left[j + 1] + sliders.weight[j];
        }
        let mut plays = Plays {
            compliance: 1.0 / left[0],
            ..Plays::default()
        };
        let (mut force, mut reached) = (0.0, 0.0);
        for (j, (weight, slip_at)) in sliders.weight.iter().zip(&sliders.slip_at).enumerate() {
            force += left[j] * (slip_at - reached);
            reached = *slip_at;
            plays.threshold.push(force);
            plays.weight.push(weight / left[j] / left[j + 1]);
        }
        plays
    }
}

impl Plays {
    /// The stop form: `S_j = 1/(c_0 + Σ_{i≤j} c_i)`, `w_j = S_{j−1} − S_j = c_j S_j S_{j−1}`,
    /// `d_j = d_{j−1} + (r_j − r_{j−1})/S_{j−1}`; what the last play leaves is elastic. Plays of
    /// zero weight vanish, a zero threshold is compliance, equal thresholds are one play.
    ///
    /// # Errors
    /// [`JointError::WrongCount`] for vectors of different length; [`JointError::OutOfRange`] for
    /// a compliance that is not positive, a weight or threshold that is negative or no number.
    pub fn sliders(&self) -> Result<Sliders, JointError> {
        let mut compliance = self.compliance;
        let merged = self.in_order(&mut compliance)?;
        let (mut weight, mut slip_at) = (Vec::new(), Vec::new());
        let mut stiffness = 1.0 / compliance;
        let (mut reached, mut force) = (0.0, 0.0);
        for (threshold, softening) in merged {
            if stiffness <= 0.0 {
                break; // full slip was reached: no load gets further
            }
            reached += (threshold - force) / stiffness;
            force = threshold;
            compliance += softening;
            let left = 1.0 / compliance;
            slip_at.push(reached);
            weight.push(if left > 0.0 {
                softening * left * stiffness
            } else {
                stiffness
            });
            stiffness = left;
        }
        Sliders::new(weight, slip_at, stiffness)
    }

    /// `(r_j, c_j)` that act, sorted and merged; plays without threshold go into `compliance`.
    fn in_order(&self, compliance: &mut f64) -> Result<Vec<(f64, f64)>, JointError> {
        if self.weight.len() != self.threshold.len() {
            return Err(JointError::WrongCount {
                what: "threshold of the plays".into(),
                found: self.threshold.len(),
                expected: self.weight.len(),
            });
        }
        admit("compliance", *compliance, f64::MIN_POSITIVE)?;
        for (weight, threshold) in self.weight.iter().zip(&self.threshold) {
            admit("play weight", *weight, 0.0)?;
            admit("play threshold", *threshold, 0.0)?;
        }
        let mut plays: Vec<(f64, f64)> = self
            .threshold
            .iter()
            .copied()
            .zip(self.weight.iter().copied())
            .collect();
        plays.retain(|(_, weight)| *weight > 0.0);
        plays.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut merged: Vec<(f64, f64)> = Vec::with_capacity(plays.len());
        for (threshold, weight) in plays {
            match merged.last_mut() {
                _ if threshold == 0.0 => *compliance += weight,
                Some(last) if last.0 == threshold => last.1 += weight,
                _ => merged.push((threshold, weight)),
            }
        }
        Ok(merged)
    }
}

fn admit(name: &str, value: f64, lower: f64) -> Result<(), JointError> {
    if value >= lower {
        return Ok(());
    }
    Err(JointError::OutOfRange {
        name: name.into(),
        value,
        lower,
        upper: f64::INFINITY,
    })
}

/// Plays in motion: `P_r[F]: p ← min(max(p, F − r), F + r)`.
///
/// Dissipated `Σ c_j r_j |dP_j|`, stored `c_0 F²/2 + Σ c_j P_j²/2`. Checked in tests/network.rs
/// against the stop form to 1e-12.
#[derive(Debug, Clone, PartialEq)]
pub struct PlayNetwork {
    plays: Plays,
    position: Vec<f64>,
    force: f64,
    dissipation: f64,
}

impl PlayNetwork {
    /// A virgin network.
    pub fn new(plays: Plays) -> PlayNetwork {
        let position = vec![0.0; plays.weight.len()];
        PlayNetwork {
            plays,
            position,
            force: 0.0,
            dissipation: 0.0,
        }
    }

    /// Goes to `force` \[N\] in one monotone leg; returns u \[m\], infinite beyond full slip.
    pub fn drive_force(&mut self, force: f64) -> f64 {
        self.force = force;
        let mut slip = self.plays.compliance * force;
        for ((position, threshold), weight) in self
            .position
            .iter_mut()
            .zip(&self.plays.threshold)
            .zip(&self.plays.weight)
        {
            let moved = position.max(force - threshold).min(force + threshold);
            // A play at rest at zero adds nothing, even where its weight is infinite.
            if moved != *position {
                self.dissipation += weight * threshold * (moved - *position).abs();
                *position = moved;
            }
            if moved != 0.0 {
                slip += weight * moved;
            }
        }
        slip
    }

    /// Energy dissipated so far \[J\].
    pub fn dissipation(&self) -> f64 {
        self.dissipation
    }

    /// Energy stored \[J\].
    pub fn stored_energy(&self) -> f64 {
        let plays = self.position.iter().zip(&self.plays.weight);
        let kept: f64 = plays
            .filter(|(p, _)| **p != 0.0)
            .map(|(p, c)| 0.5 * c * p * p)
            .sum();
        kept + 0.5 * self.plays.compliance * self.force * self.force
    }
}
