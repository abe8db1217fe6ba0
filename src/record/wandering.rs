//! White and slow noise at once where no cycles repeat: what a model leaves wanders, and does not come back where the load does.

use super::blended::Blended;
use super::colour::{Colour, White};
use super::cycles::turning_points;
use super::noise::Noise;
use super::white_and_slow::white_and_slow;

/// Samples of a part of a residual, of which some are enough in a long one: many times as long as slow noise lasts.
const LONG: usize = 2048;

/// Share of the range of the drive below which it does not turn.
const TURN: f64 = 0.05;

/// Parts of the way from one turn to the next.
const PARTS: usize = 8;

/// Share of the way by which the ends of two ways may lie apart that are taken for alike: what a model misses on them
/// is alike as well.
const APART: f64 = 0.25;

/// Fewest parts of ways that have one alike behind them.
const FEWEST: usize = 4 * PARTS;

/// Standard errors beyond which what a model leaves comes back.
const COMES_BACK: f64 = 2.0;

/// Noise that a residual is likelier of than of first-order noise, white and slow at once, which does not come back where the
/// drive goes a way like one before; `None` of any other, and where too few ways are alike to tell.
///
/// Structure that a model misses is slow as well, and goes with the load: what is left of it on one way is left on the next one like
/// it. See [`comes_back`].
pub fn wandering(drive: &[f64], residual: &[f64]) -> Option<Noise> {
    let part = |samples: &[f64]| Blended {
        differences: samples.to_vec(),
        taps: vec![[1.0, 0.0, 0.0, 0.0]],
    };
    let parts: Vec<Blended> = residual.chunks(LONG).map(part).collect();
    let (deviation, colour) = white_and_slow(&parts.iter().collect::<Vec<_>>())?;
    let back = comes_back(drive, residual, colour)?;
    (back < COMES_BACK).then_some(Noise {
        deviation,
        colour,
        beyond: 0.0,
        samples: residual.len(),
        repeated: false,
    })
}

/// Standard errors by which whitened parts of ways go together with those of the next ways like them:
/// `Σ s s' / √(Σ n n')`, with `s` the sum of the `n` samples of a part, of unit variance; normal where
/// nothing comes back. `None` of too few.
fn comes_back(drive: &[f64], residual: &[f64], colour: Colour) -> Option<f64> {
    let (mut whitening, mut white) = (colour.whitening(), White::default());
    let new = |(i, left): (usize, &f64)| white.next(&whitening.step(i == 0), *left);
    let new: Vec<f64> = residual.iter().enumerate().map(new).collect();
    let variance = new.iter().map(|w| w * w).sum::<f64>() / new.len().max(1) as f64;
    let turns = turning_points(drive, TURN);
    let ways: Vec<Way> = turns
        .windows(2)
        .map(|ends| Way::of(drive, &new, (ends[0], ends[1])))
        .collect();
    let (mut together, mut chance, mut parts) = (0.0, 0.0, 0);
    for (k, way) in ways.iter().enumerate() {
        let Some(next) = ways[k + 1..].iter().find(|other| way.is_like(other)) else {
            continue;
        };
        for (one, other) in way.parts.iter().zip(&next.parts) {
            together += one.sum * other.sum;
            chance += one.count * other.count;
            parts += usize::from(one.count * other.count > 0.0);
        }
    }
    (parts >= FEWEST && variance > 0.0).then(|| together / variance / chance.sqrt())
}

/// From one turn of the drive to the next.
struct Way {
    from: f64,
    to: f64,
    parts: [Part; PARTS],
}

#[derive(Clone, Copy, Default)]
struct Part {
    sum: f64,
    count: f64,
}

impl Way {
    fn of(drive: &[f64], new: &[f64], (first, last): (usize, usize)) -> Way {
        let (from, to) = (drive[first], drive[last]);
        let mut parts = [Part::default(); PARTS];
        for i in first..last {
            let passed = (drive[i] - from) / (to - from);
            let at = (passed.clamp(0.0, 1.0) * PARTS as f64) as usize;
            let part = &mut parts[at.min(PARTS - 1)];
            part.sum += new[i];
            part.count += 1.0;
        }
        Way { from, to, parts }
    }

    /// True of one between about the same ends, in the same direction.
    fn is_like(&self, other: &Way) -> bool {
        let near = APART * (self.to - self.from).abs();
        (other.from - self.from).abs() < near && (other.to - self.to).abs() < near
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::drawn;

    /// A sine that grows and sinks all the time, about a middle that moves.
    fn drive() -> Vec<f64> {
        let at = |i: usize| {
            let t = i as f64 / 60.0;
            let level = 0.7 + 0.3 * (0.37 * t).sin();
            level * (std::f64::consts::TAU * t).sin() + 0.1 * (0.9 * t).sin()
        };
        (0..3600).map(at).collect()
    }

    /// White noise, and as much of a correlation of neighbours.
    fn noise(seed: u64, slow: f64) -> Vec<f64> {
        let mut random = drawn(seed);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let mut last = 0.0;
        (0..3600)
            .map(|_| {
                last = slow * last + (1.0 - slow * slow).sqrt() * white();
                (last + white()) * 0.5_f64.sqrt()
            })
            .collect()
    }

    #[test]
    fn what_wanders_is_told_for_white_and_slow_noise() {
        let drive = drive();
        let told: Vec<Noise> = (1..=20)
            .filter_map(|seed| wandering(&drive, &noise(seed, 0.93)))
            .collect();
        // One in forty comes back by chance.
        assert!(told.len() >= 17, "{}", told.len());
        let truth = Colour {
            slow: 0.93,
            share: 0.5,
        };
        let counts: f64 = told.iter().map(|n| n.colour.independence()).sum();
        let times = counts / told.len() as f64 / truth.independence();
        assert!((times - 1.0).abs() < 0.3, "{times}");
    }

    #[test]
    fn white_noise_and_noise_of_first_order_do_not_wander() {
        let drive = drive();
        for seed in 1..=20 {
            assert!(wandering(&drive, &noise(seed, 0.0)).is_none(), "{seed}");
            let mut last = 0.0;
            let first_order = noise(seed, 0.0).into_iter().map(|new| {
                last = 0.9 * last + new;
                last
            });
            let first_order: Vec<f64> = first_order.collect();
            assert!(wandering(&drive, &first_order).is_none(), "{seed}");
        }
    }

    /// A third of the noise in rms that goes with the load is as slow.
    #[test]
    fn what_comes_back_with_the_load_is_no_noise() {
        let drive = drive();
        let with = |seed: u64, share: f64, slow: f64| {
            let both = noise(seed, slow).into_iter().zip(&drive);
            let left: Vec<f64> = both
                .map(|(n, x)| n + share * (x * x.abs() - 0.6 * x) * 12.0_f64)
                .collect();
            left
        };
        let taken = |share: f64| {
            let one = |seed: &u64| wandering(&drive, &with(*seed, share, 0.93)).is_some();
            (1..=20).filter(one).count()
        };
        let (none, some) = (taken(0.0), taken(0.3));
        assert!(none >= 17 && some <= 3, "{none} {some}");
        // Beside white noise alone the structure is all that is slow.
        let alone = (1..=20).filter(|&seed| wandering(&drive, &with(seed, 0.5, 0.0)).is_some());
        assert!(alone.count() == 0);
    }
}
