//! Passes through a record whose input is corrected by what the march before gave.

use crate::joint::effect::Trajectory;
use crate::record::cycles::rms;
use nalgebra::Complex;

/// Change of the correction from pass to pass, as a share of the correction, below which it has settled.
const SETTLED: f64 = 1e-3;

/// How far the turns of correcting and marching have come.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Turns {
    /// Passes that are left.
    left: usize,
    last: Option<Vec<f64>>,
    change: f64,
}

impl Turns {
    /// So many passes at most.
    pub fn new(most: usize) -> Turns {
        Turns {
            left: most.max(1),
            last: None,
            change: f64::INFINITY,
        }
    }

    /// True where the next pass is the last.
    pub fn end(&self) -> bool {
        self.left <= 1
    }

    /// The correction of the next pass, where the last march adds so much to what is read.
    ///
    /// That is the last where the correction has settled, or would move farther than before: it stays then.
    pub fn take(&mut self, added: &[f64], resonance: Resonance) -> &[f64] {
        let largest = |x: f64, y: f64| x.max(y.abs());
        let mut correction = self.last.take().unwrap_or_else(|| vec![0.0; added.len()]);
        let lacks: Vec<f64> = added.iter().zip(&correction).map(|(a, c)| a - c).collect();
        let moves = resonance.answer(&lacks);
        let change = moves.iter().copied().fold(0.0, largest);
        let strays = change >= self.change;
        if !strays {
            correction.iter_mut().zip(&moves).for_each(|(c, m)| *c += m);
        }
        let size = correction.iter().copied().fold(0.0, largest);
        self.left = match strays || change <= SETTLED * size {
            true => 1,
            false => self.left - 1,
        };
        self.change = change;
        self.last.insert(correction)
    }
}

/// Inertia over elastic force of a motion from sample to sample, `q = m C/Δt²`: what a mass `m` takes off the force on a
/// joint of compliance `C`, `(1 + m C d²/dt²) F = F_meas`, is found by the inverse of that.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Resonance {
    ratio: f64,
}

/// Damping of the inverse, as a share of the elastic force. Near the frequency at which mass and joint would ring it
/// answers with 1/(2 · 0.5) of what is lacking, however little they resist: the compliance is a mean one, and what is
/// wrong with it counts most there.
const DAMPED: f64 = 0.5;

impl Resonance {
    /// Of a mass \[kg\] on a joint that moves so in a record.
    pub fn of(mass: f64, truth: &Trajectory) -> Resonance {
        let samples = truth.time.len();
        if mass == 0.0 || samples < 2 {
            return Resonance::default();
        }
        let compliance = rms(&truth.displacement) / rms(&truth.force);
        let step = (truth.time[samples - 1] - truth.time[0]) / (samples - 1) as f64;
        let ratio = mass * compliance / (step * step);
        Resonance {
            ratio: if ratio.is_finite() { ratio } else { 0.0 },
        }
    }

    /// `Re (A − i ε)⁻¹ r` with `A = 1 + q D²`, D² the second difference with level ends (Thomas).
    fn answer(self, lacks: &[f64]) -> Vec<f64> {
        let (q, count) = (self.ratio, lacks.len());
        if q == 0.0 || count < 3 {
            return lacks.to_vec();
        }
        let diagonal = |i: usize| match i == 0 || i + 1 == count {
            true => Complex::new(1.0 - q, -DAMPED),
            false => Complex::new(1.0 - 2.0 * q, -DAMPED),
        };
        // Eliminated downwards, solved upwards.
        let mut eliminated = Vec::with_capacity(count);
        let (mut factor, mut right) = (Complex::default(), Complex::default());
        for (i, r) in lacks.iter().enumerate() {
            let pivot = diagonal(i) - factor * q;
            right = (Complex::from(*r) - right * q) / pivot;
            factor = Complex::from(q) / pivot;
            eliminated.push((factor, right));
        }
        let mut above = Complex::default();
        let mut answer = vec![0.0; count];
        for (answer, (factor, right)) in answer.iter_mut().zip(eliminated).rev() {
            above = right - factor * above;
            *answer = above.re;
        }
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Passes taken by a correction that goes over by this factor of what it lacks in every turn.
    fn passes(over: f64, most: usize) -> (usize, f64) {
        let (mut turns, mut correction, mut passes) = (Turns::new(most), 0.0, 1);
        while !turns.end() {
            let added = 1.0 - over * (1.0 - correction);
            correction = turns.take(&[added, 0.5], Resonance::default())[0];
            passes += 1;
        }
        (passes, correction)
    }

    /// What a spring bore, of the force that moved a mass as well.
    #[test]
    fn the_inverse_leaves_what_the_joint_bore() {
        let time: Vec<f64> = (0..2000).map(f64::from).collect();
        let bore: Vec<f64> = time
            .iter()
            .map(|t| (0.05 * t).sin() - (0.013 * t).cos())
            .collect();
        for ratio in [0.1, 1.0, 20.0] {
            let acceleration = |i: usize| bore[i - 1] - 2.0 * bore[i] + bore[i + 1];
            let lacks: Vec<f64> = (0..2000)
                .map(|i| bore[i] + ratio * acceleration(i.clamp(1, 1998)))
                .collect();
            let found = Resonance { ratio }.answer(&lacks);
            // Below the resonance the damping takes a fifth; untouched, the heaviest mass would take another.
            let off = |i: usize| (found[i] * (1.0 + DAMPED * DAMPED) - bore[i]).abs();
            let worst = (500..1500).map(off).fold(0.0, f64::max);
            assert!(worst < 0.1, "{ratio}: {worst}");
        }
    }

    #[test]
    fn they_end_where_nothing_moves_any_more_or_all_moves_farther() {
        let (count, settled) = passes(-0.3, 20);
        assert!(count < 10 && (settled - 1.0).abs() < 1e-3, "{count}");
        assert_eq!(passes(-0.9, 12).0, 12);
        // The first turn's: the next would be farther off.
        assert_eq!(passes(-1.5, 12), (3, 2.5));
        assert_eq!(passes(-0.3, 1).0, 1);
    }
}
