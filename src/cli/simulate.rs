//! `iwan simulate`: a joint under a prescribed load.

use super::input::{Foreign, tell_notes};
use super::output;
use crate::joint::{Drive, Joint, Output, Simulation};
use crate::read::{self, LoadTable, Quantity};
use crate::record::written::quantity;
use anyhow::Context;
use std::path::PathBuf;

/// Simulate a joint under the force or displacement of a file.
#[derive(Debug, clap::Args)]
pub struct Simulate {
    /// The joint: a joint.json of `iwan identify` or `iwan diagnose`
    joint: PathBuf,
    /// The load: columns time, and force or displacement
    load: PathBuf,
    /// File to write: time, force, displacement, dissipation, stored energy; `-` for the screen
    #[arg(short, long, value_name = "OUT.csv")]
    output: PathBuf,
    /// What is prescribed; by default force where the load has it, else displacement
    #[arg(long, value_enum)]
    drive: Option<DriveName>,
    #[command(flatten)]
    foreign: Foreign,
}

/// What is prescribed.
#[derive(Debug, Clone, Copy, clap::ValueEnum)]
pub enum DriveName {
    /// Force in, displacement out
    Force,
    /// Displacement in, force out
    Displacement,
}

/// Columns of the result; others read them by these names.
const HEADER: &str = "time [s],force [N],displacement [m],dissipation [J],stored energy [J]";

/// Simulates and writes, one row per row of the load. Numbers are written so that reading them
/// gives the same double back.
///
/// # Errors
/// Of reading the joint or the load; [`crate::joint::JointError`] with the line of the load.
pub fn run(arguments: &Simulate) -> anyhow::Result<()> {
    let inputs = [arguments.joint.as_path(), arguments.load.as_path()];
    output::admit(&arguments.output, &inputs)?;
    let (saved, _) = super::input::saved(&arguments.joint)?;
    let joint = saved.joint;
    let load = read::load_table(&arguments.load, &arguments.foreign.options()?)?;
    tell_notes(&arguments.load, &load.notes);
    let outputs = simulate(&joint, &load, arguments.drive)?;
    if let Some(said) = beyond(&outputs, saved.provenance.largest_force()) {
        output::tell(&said);
    }
    output::write(&arguments.output, |out| {
        writeln!(out, "{HEADER}")?;
        for at in &outputs {
            let Output {
                time,
                force,
                displacement,
                dissipation,
                stored_energy,
                ..
            } = at;
            writeln!(
                out,
                "{time:?},{force:?},{displacement:?},{dissipation:?},{stored_energy:?}"
            )?;
        }
        Ok(())
    })
}

/// Share beyond the largest measured force that a load may go without a word: a zero is off by as much.
const BEYOND: f64 = 0.05;

/// What is said where the joint bears more than was measured of it.
fn beyond(outputs: &[Output], measured: Option<f64>) -> Option<String> {
    let largest = outputs
        .iter()
        .fold(0.0_f64, |most, at| most.max(at.force.abs()));
    let measured = measured.filter(|measured| largest > (1.0 + BEYOND) * measured)?;
    Some(format!(
        "the joint bears up to {} here, and was measured up to {}: beyond that the answer is a continuation of the model, which no record supports",
        quantity(largest, "N"),
        quantity(measured, "N")
    ))
}

/// The answer to every row of the load.
fn simulate(
    joint: &Joint,
    load: &LoadTable,
    asked: Option<DriveName>,
) -> anyhow::Result<Vec<Output>> {
    let quantity = match asked {
        Some(DriveName::Force) => Quantity::Force,
        Some(DriveName::Displacement) => Quantity::Displacement,
        None if load.force.is_some() => Quantity::Force,
        None => Quantity::Displacement,
    };
    let (drive, input) = match quantity {
        Quantity::Force => (Drive::Force, &load.force),
        _ => (Drive::Displacement, &load.displacement),
    };
    let input = input.as_ref().ok_or_else(|| load.missing(quantity))?;
    let mut simulation = Simulation::new(joint, drive)?;
    let rows = load.time.iter().zip(input).enumerate();
    rows.map(|(row, (time, input))| {
        let place = || {
            load.spot(quantity, row)
                .map_or(String::new(), |spot| spot.to_string())
        };
        simulation.step(*time, *input).with_context(place)
    })
    .collect()
}
