//! The load under which an archive is compared.

use crate::cli::input::{Foreign, tell_notes};
use crate::joint::{Drive, Joint, JointError, Simulation};
use crate::pack::Nominal;
use crate::read::{self, Quantity};
use anyhow::Context;
use std::path::Path;

/// Input over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Time \[s\], strictly increasing.
    pub time: Vec<f64>,
    /// Force \[N\] or displacement \[m\], by the drive.
    pub input: Vec<f64>,
    /// The other quantity as it was measured, where the file has it.
    pub answer: Option<Vec<f64>>,
}

/// Samples of the load that is made, and its length in seconds.
const SAMPLES: usize = 2000;
const DURATION: f64 = 4.0;
/// Tries with a halved load before a joint is given up that refuses them all.
const HALVINGS: usize = 40;

impl Load {
    /// The load of a file, which the joint must be able to answer.
    ///
    /// # Errors
    /// [`read::ReadError`]; [`JointError`] with the line of the file.
    pub fn read(
        file: &Path,
        foreign: &Foreign,
        joint: &Joint,
        drive: Drive,
    ) -> anyhow::Result<Load> {
        let table = read::load_table(file, &foreign.options()?)?;
        tell_notes(file, &table.notes);
        let (quantity, input, answer) = match drive {
            Drive::Force => (Quantity::Force, &table.force, &table.displacement),
            Drive::Displacement => (Quantity::Displacement, &table.displacement, &table.force),
        };
        let answer = answer.clone();
        let input = input.clone().ok_or_else(|| table.missing(quantity))?;
        let mut simulation = Simulation::new(joint, drive)?;
        for (row, (time, input)) in table.time.iter().zip(&input).enumerate() {
            let spot = || table.spot(quantity, row);
            let place = || spot().map_or(String::new(), |spot| spot.to_string());
            simulation.step(*time, *input).with_context(place)?;
        }
        Ok(Load {
            time: table.time,
            input,
            answer,
        })
    }

    /// A two-tone load that grows until the network has lost a fifth of its stiffness, so that
    /// loops nest and close. Halved while the joint refuses it, as effects may lower full slip.
    ///
    /// # Errors
    /// What the joint says to the smallest load.
    pub fn made_for(joint: &Joint, drive: Drive) -> anyhow::Result<Load> {
        let nominal = Nominal::of(joint);
        let mut size = match drive {
            Drive::Force => nominal.force,
            Drive::Displacement => nominal.displacement,
        };
        let mut refused = Ok(());
        for _ in 0..HALVINGS {
            let load = Load::two_tone(size);
            match load.runs(joint, drive) {
                Ok(()) => return Ok(load),
                Err(error) => refused = Err(error),
            }
            size /= 2.0;
        }
        Ok(refused.map(|()| Load::two_tone(size))?)
    }

    fn two_tone(size: f64) -> Load {
        let time: Vec<f64> = (0..=SAMPLES)
            .map(|i| DURATION * i as f64 / SAMPLES as f64)
            .collect();
        let input = time.iter().map(|t| {
            let turns = std::f64::consts::TAU * t;
            size * (t / DURATION) * ((2.0 * turns).sin() + 0.5 * (11.0 * turns).sin()) / 1.5
        });
        Load {
            input: input.collect(),
            time,
            answer: None,
        }
    }

    fn runs(&self, joint: &Joint, drive: Drive) -> Result<(), JointError> {
        let mut simulation = Simulation::new(joint, drive)?;
        let mut rows = self.time.iter().zip(&self.input);
        rows.try_for_each(|(time, input)| simulation.step(*time, *input).map(|_| ()))
    }
}
