//! Load programs: blocks of sine, triangle and hold, played on an even clock.

use crate::record::colour::Colour;
use crate::record::written::quantity;
use std::f64::consts::{PI, TAU};

/// What the rig can do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rig {
    /// Least value of the prescribed channel, N or m.
    pub lower: f64,
    /// Its largest value.
    pub upper: f64,
    /// Highest rate of a cycle \[Hz\].
    pub rate: f64,
    /// Longest test \[s\].
    pub duration: f64,
    /// Time between samples \[s\].
    pub step: f64,
    /// One over the deviation of what is new in the noise of every sample of the judged channel, 1/N or 1/m.
    pub weight: f64,
    /// How alike neighbours are in that noise.
    pub colour: Colour,
}

/// One block of a program; amplitude and mean as shares of the rig's reach, the mean from the middle of its range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Amplitude over reach.
    pub amplitude: f64,
    /// Mean less the middle of the range, over reach.
    pub mean: f64,
    /// Rate over the rig's highest.
    pub rate: f64,
    /// Whole cycles at full amplitude.
    pub cycles: usize,
    /// Ramps with rounded corners instead of a sine.
    pub ramps: bool,
    /// Seconds of rest at the peak of the last cycle.
    pub hold: f64,
}

impl Block {
    /// Seconds it lasts: a cycle to ease in, the cycles, the rest at the peak.
    pub fn seconds(&self, rig: &Rig) -> f64 {
        (self.cycles as f64 + 1.0) / (self.rate * rig.rate) + self.hold
    }

    /// The block in words.
    pub fn words(&self, rig: &Rig, unit: &str) -> String {
        let wave = if self.ramps { "ramps" } else { "sine" };
        let mut words = format!(
            "{} cycles of {wave}, amplitude {}, {}",
            self.cycles,
            quantity(self.amplitude * rig.reach(), unit),
            quantity(self.rate * rig.rate, "Hz")
        );
        let mean = rig.middle() + self.mean * rig.reach();
        if mean != 0.0 {
            words += &format!(", about {}", quantity(mean, unit));
        }
        if self.hold > 0.0 {
            words += &format!(", then {} of rest at the peak", quantity(self.hold, "s"));
        }
        words
    }
}

/// Samples of a cycle that a look ahead needs.
const PER_CYCLE: f64 = 100.0;

/// A program as it is played.
#[derive(Debug, Clone, PartialEq)]
pub struct Played {
    /// Time of every sample \[s\].
    pub time: Vec<f64>,
    /// Value of the prescribed channel, N or m.
    pub values: Vec<f64>,
    /// Samples that show the course of the program, and for how many each stands: a slow cycle needs no more
    /// than a fast one.
    pub shown: Vec<(usize, usize)>,
}

/// Most samples of a program.
const MOST_SAMPLES: f64 = 12_000.0;

impl Rig {
    /// Largest amplitude that the range has room for.
    pub fn reach(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }

    /// What a block without a mean of its own swings about: zero only where the range is as wide to either side.
    pub fn middle(&self) -> f64 {
        0.5 * (self.lower + self.upper)
    }

    /// Where a program begins and ends: zero, or what of the range is nearest to it.
    pub fn rest(&self) -> f64 {
        0.0_f64.max(self.lower).min(self.upper)
    }

    /// The same rig with its range drawn in towards rest to so large a share.
    pub fn drawn_in(&self, share: f64) -> Rig {
        let towards = |bound: f64| self.rest() + share * (bound - self.rest());
        Rig {
            lower: towards(self.lower),
            upper: towards(self.upper),
            ..*self
        }
    }

    /// Blocks worth trying: steps of amplitude over two decades of rate, ramps, small cycles about
    /// a mean to either side of the middle, rest at the peak, equal blocks repeated. None takes more
    /// than a third of the time there is.
    pub fn menu(&self) -> Vec<Block> {
        let plain = Block {
            amplitude: 1.0,
            mean: 0.0,
            rate: 1.0,
            cycles: 6,
            ramps: false,
            hold: 0.0,
        };
        let mut menu = Vec::new();
        for rate in [1.0, 0.32, 0.1, 0.032, 0.01] {
            for amplitude in [1.0, 0.6, 0.3] {
                menu.push(Block {
                    amplitude,
                    rate,
                    ..plain
                });
            }
            menu.push(Block {
                ramps: true,
                rate,
                ..plain
            });
        }
        for mean in [0.65, -0.65] {
            for rate in [1.0, 0.1] {
                menu.push(Block {
                    amplitude: 0.3,
                    mean,
                    rate,
                    ..plain
                });
            }
        }
        let third = self.longest() / 3.0;
        for amplitude in [1.0, 0.5] {
            menu.push(Block {
                amplitude,
                cycles: 2,
                hold: 0.5 * third,
                ..plain
            });
        }
        menu.push(Block {
            cycles: 12,
            ..plain
        });
        menu.retain_mut(|block| {
            while block.cycles > 2 && block.seconds(self) > third {
                block.cycles -= 1;
            }
            block.seconds(self) <= third
        });
        menu
    }

    /// Seconds that a program may take: the rig's own limit and that of samples.
    pub fn longest(&self) -> f64 {
        self.duration.min(MOST_SAMPLES * self.step)
    }

    /// Plays blocks one after the other: time \[s\] and the prescribed channel, from rest
    /// back to rest, at every sample of the rig's clock.
    pub fn play(&self, blocks: &[Block]) -> Played {
        let mut tape = Tape::new(self);
        for block in blocks {
            let rate = block.rate * self.rate;
            tape.ramps = block.ramps;
            tape.write(1.0 / rate, rate, block.amplitude, block.mean);
            let cycles = block.cycles as f64 / rate;
            if block.hold > 0.0 {
                tape.write(cycles - 0.75 / rate, rate, block.amplitude, block.mean);
                tape.write(block.hold, 0.0, block.amplitude, block.mean);
                tape.write(0.75 / rate, rate, block.amplitude, block.mean);
            } else {
                tape.write(cycles, rate, block.amplitude, block.mean);
            }
        }
        let rate = blocks.last().map_or(self.rate, |b| b.rate * self.rate);
        tape.write(1.0 / rate, rate, 0.0, tape.rest());
        let time = (0..tape.values.len()).map(|i| i as f64 * self.step);
        Played {
            time: time.collect(),
            values: tape.values,
            shown: tape.shown,
        }
    }
}

/// A program being written: amplitude and mean ease from block to block, the phase runs on.
struct Tape<'a> {
    rig: &'a Rig,
    values: Vec<f64>,
    shown: Vec<(usize, usize)>,
    phase: f64,
    amplitude: f64,
    mean: f64,
    ramps: bool,
}

impl<'a> Tape<'a> {
    fn new(rig: &'a Rig) -> Tape<'a> {
        let mut tape = Tape {
            rig,
            values: vec![rig.rest()],
            shown: vec![(0, 1)],
            phase: 0.0,
            amplitude: 0.0,
            mean: 0.0,
            ramps: false,
        };
        tape.mean = tape.rest();
        tape
    }

    /// Rest as a mean.
    fn rest(&self) -> f64 {
        match self.rig.reach() {
            reach if reach > 0.0 => (self.rig.rest() - self.rig.middle()) / reach,
            _ => 0.0,
        }
    }

    fn write(&mut self, seconds: f64, rate: f64, amplitude: f64, mean: f64) {
        let (lower, upper) = (self.rig.lower, self.rig.upper);
        let (reach, middle) = (self.rig.reach(), self.rig.middle());
        let count = (seconds / self.rig.step).round().max(1.0);
        // A whole number of samples per piece moves the rate by less than a sample in a piece.
        let turn = seconds * rate / count;
        // A rest is a hundredth of its own length at a time.
        let cycle = if rate > 0.0 { 1.0 / rate } else { seconds };
        let every = ((cycle / self.rig.step / PER_CYCLE) as usize).max(1);
        for i in 1..=count as usize {
            let ease = 0.5 - 0.5 * (PI * i as f64 / count).cos();
            let (level, about) = (
                self.amplitude + (amplitude - self.amplitude) * ease,
                self.mean + (mean - self.mean) * ease,
            );
            let phase = self.phase + turn * i as f64;
            let sine = (TAU * phase).sin();
            let wave = match self.ramps {
                // Two terms of a triangle: no rig turns on the spot, and corners between samples
                // would separate numerical differences of causes, not causes.
                true => (sine - (3.0 * TAU * phase).sin() / 9.0) / (1.0 + 1.0 / 9.0),
                false => sine,
            };
            if i % every == 0 || i as f64 == count {
                let stands = if i % every == 0 { every } else { i % every };
                self.shown.push((self.values.len(), stands));
            }
            // Between two blocks that stay inside, so does what eases from one to the other; but for the last bit.
            let value = middle + reach * (level * wave + about);
            self.values.push(value.max(lower).min(upper));
        }
        self.phase += seconds * rate;
        (self.amplitude, self.mean) = (amplitude, mean);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_keeps_to_the_rig() {
        let rig = Rig {
            lower: -250.0,
            upper: 250.0,
            rate: 5.0,
            duration: 30.0,
            step: 0.004,
            weight: 1.0,
            colour: Colour::WHITE,
        };
        let menu = rig.menu();
        assert!(menu.len() > 8);
        for block in &menu {
            let Played {
                time,
                values,
                shown,
            } = rig.play(std::slice::from_ref(block));
            let peak = values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
            assert!(peak <= 250.0 * (1.0 + 1e-12), "{block:?}: {peak}");
            assert!(peak >= 0.25 * 250.0, "{block:?}: {peak}");
            assert!(values[0] == 0.0 && values[values.len() - 1].abs() < 1.0);
            let lasts = block.seconds(&rig) + 1.0 / (block.rate * rig.rate);
            assert!((time[time.len() - 1] - lasts).abs() < 0.05);
            // Every sample is stood for once, and slow cycles by no more than fast ones.
            let stood: usize = shown.iter().map(|(_, every)| every).sum();
            assert_eq!(stood, values.len(), "{block:?}");
            assert!(shown.windows(2).all(|w| w[1].0 - w[0].0 == w[1].1));
            let cycles = block.cycles as f64 + 2.0;
            assert!(
                shown.len() as f64 <= 2.0 * PER_CYCLE * (cycles + 1.0),
                "{block:?}"
            );
            // No faster than the rig: |dF/dt| ≤ 2π f reach, and what easing in adds.
            let fastest = values.windows(2).map(|v| (v[1] - v[0]).abs() / rig.step);
            assert!(fastest.fold(0.0, f64::max) < 1.6 * TAU * 5.0 * 250.0);
        }
    }

    #[test]
    fn a_program_stays_on_the_side_that_the_rig_has() {
        for (lower, upper, rest) in [
            (0.0, 4700.0, 0.0),
            (-900.0, 0.0, 0.0),
            (-7.4, 18.4, 0.0),
            (5.0, 9.0, 5.0),
        ] {
            let rig = Rig {
                lower,
                upper,
                rate: 2.0,
                duration: 60.0,
                step: 0.005,
                weight: 1.0,
                colour: Colour::WHITE,
            };
            let menu = rig.menu();
            for blocks in menu.iter().map(std::slice::from_ref).chain([&menu[..]]) {
                let values = rig.play(blocks).values;
                let inside = |v: &f64| (lower..=upper).contains(v);
                assert!(values.iter().all(inside), "{lower} {upper} {blocks:?}");
                assert_eq!(values[0], rest);
                let last = values[values.len() - 1];
                assert!((last - rest).abs() < 1e-9 * (upper - lower), "{last}");
            }
            // All of the range is used.
            let values = rig.play(&menu[..1]).values;
            let span = |from: f64, to: f64| {
                values
                    .iter()
                    .any(|v| (v - from).abs() < 0.01 * (upper - lower))
                    && values
                        .iter()
                        .any(|v| (v - to).abs() < 0.01 * (upper - lower))
            };
            assert!(span(lower, upper), "{lower} {upper}");
            assert!(menu[0].words(&rig, "N").contains(", about "));
        }
    }

    #[test]
    fn a_short_test_leaves_out_slow_cycles() {
        let rig = Rig {
            lower: -1.0,
            upper: 1.0,
            rate: 1.0,
            duration: 12.0,
            step: 0.01,
            weight: 1.0,
            colour: Colour::WHITE,
        };
        assert!(rig.menu().iter().all(|b| b.seconds(&rig) <= 4.0));
    }
}
