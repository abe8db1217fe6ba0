//! What an archive's instance is put through: a load, a saved state, a reset.

use super::unit::{Refused, Unit};
use crate::cli::check::load::Load;

/// What an importer saw.
#[derive(Debug, PartialEq)]
pub struct Run {
    /// Answers at the start and at the end of every step.
    pub rows: Vec<Vec<f64>>,
    /// True where a state saved halfway and put back gave the same second half.
    pub state_continues: bool,
    /// True where the whole came out the same after a reset.
    pub reset_repeats: bool,
}

/// An instance under a load, by the references of its input and of its answers.
pub struct Driven<'a> {
    /// The instance.
    pub unit: &'a mut dyn Unit,
    /// Input over time.
    pub load: &'a Load,
    /// Reference of the input.
    pub input: u32,
    /// References of what is read.
    pub answers: &'a [u32],
}

impl Driven<'_> {
    /// Runs the load. Halfway the state is saved, serialized, and the second half is run twice from
    /// it; at the end the instance is reset and runs once more.
    ///
    /// # Errors
    /// [`Refused`] where the archive refuses a call.
    pub fn run(mut self) -> Result<Run, Refused> {
        let mut rows = self.first_half()?;
        let state = self.unit.save()?;
        let second = self.second_half()?;
        self.unit.restore(&state)?;
        let state_continues = same(&second, &self.second_half()?);
        rows.extend(second);
        self.unit.reset()?;
        let mut again = self.first_half()?;
        again.extend(self.second_half()?);
        let reset_repeats = same(&rows, &again);
        Ok(Run {
            rows,
            state_continues,
            reset_repeats,
        })
    }

    fn half(&self) -> usize {
        (self.load.time.len() / 2).max(1)
    }

    /// Through Initialization Mode to the first communication point, and on.
    fn first_half(&mut self) -> Result<Vec<Vec<f64>>, Refused> {
        self.unit.enter_initialization(self.load.time[0])?;
        self.unit.set(self.input, self.load.input[0])?;
        self.unit.exit_initialization()?;
        let mut rows = vec![self.unit.read(self.answers)?];
        for row in 1..self.half() {
            rows.push(self.step(row)?);
        }
        Ok(rows)
    }

    fn second_half(&mut self) -> Result<Vec<Vec<f64>>, Refused> {
        (self.half()..self.load.time.len())
            .map(|row| self.step(row))
            .collect()
    }

    /// One step to the time of a row, under the input of that row.
    fn step(&mut self, row: usize) -> Result<Vec<f64>, Refused> {
        let (from, to) = (self.load.time[row - 1], self.load.time[row]);
        self.unit.set(self.input, self.load.input[row])?;
        self.unit.step(from, to - from)?;
        self.unit.read(self.answers)
    }
}

/// To the last bit; a NaN is no answer, and differs from itself.
fn same(once: &[Vec<f64>], again: &[Vec<f64>]) -> bool {
    once == again
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums its input over the steps, and may be bad at one thing.
    #[derive(Default)]
    struct Sum {
        input: f64,
        sum: f64,
        keeps_its_way: bool,
        keeps_its_past: bool,
    }

    impl Unit for Sum {
        fn enter_initialization(&mut self, _: f64) -> Result<(), Refused> {
            Ok(())
        }
        fn exit_initialization(&mut self) -> Result<(), Refused> {
            Ok(())
        }
        fn set(&mut self, _: u32, value: f64) -> Result<(), Refused> {
            self.input = value;
            Ok(())
        }
        fn step(&mut self, _: f64, _: f64) -> Result<(), Refused> {
            self.sum += self.input;
            Ok(())
        }
        fn read(&mut self, _: &[u32]) -> Result<Vec<f64>, Refused> {
            Ok(vec![self.sum])
        }
        fn reset(&mut self) -> Result<(), Refused> {
            if !self.keeps_its_past {
                self.sum = 0.0;
            }
            Ok(())
        }
        fn save(&mut self) -> Result<Vec<u8>, Refused> {
            Ok(self.sum.to_le_bytes().to_vec())
        }
        fn restore(&mut self, bytes: &[u8]) -> Result<(), Refused> {
            if !self.keeps_its_way {
                self.sum = f64::from_le_bytes(bytes.try_into().unwrap());
            }
            Ok(())
        }
    }

    fn run(mut unit: Sum) -> (bool, bool) {
        let load = Load {
            time: vec![0.0, 1.0, 2.0, 3.0],
            input: vec![0.0, 1.0, -3.0, 4.0],
            answer: None,
        };
        let driven = Driven {
            unit: &mut unit,
            load: &load,
            input: 1,
            answers: &[2],
        };
        let found = driven.run().unwrap();
        assert_eq!(found.rows, [[0.0], [1.0], [-2.0], [2.0]]);
        (found.state_continues, found.reset_repeats)
    }

    #[test]
    fn a_state_that_is_not_restored_is_told() {
        assert_eq!(run(Sum::default()), (true, true));
        let deaf = Sum {
            keeps_its_way: true,
            ..Sum::default()
        };
        assert_eq!(run(deaf), (false, true));
    }

    #[test]
    fn a_reset_that_forgets_nothing_is_told() {
        let stubborn = Sum {
            keeps_its_past: true,
            ..Sum::default()
        };
        assert_eq!(run(stubborn), (true, false));
    }
}
