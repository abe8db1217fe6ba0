//! One FMI 2.0 archive in the `fmu-runner` crate.
//!
//!     run-in-fmu-runner JOINT.fmu force|displacement LOAD.txt STEP OUT.txt
//!
//! LOAD.txt holds the input, a force \[N\] or a displacement \[m\], per communication point, STEP seconds
//! apart. OUT.txt gets the other of the two, dissipation and stored energy at every point after the
//! first; the standard output the seconds of processor time that the steps took. Where the unit has saved states, its state is serialized halfway, a step the
//! other way is taken and the state is put back: the second half comes from a restored state.

use fmu_runner::{Fmu, FmuInstance, fmi2Type};
use std::collections::HashMap;
use std::error::Error;
use std::fmt::Write;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [archive, drive, load, step, out] = arguments.as_slice() else {
        return Err(
            "usage: run-in-fmu-runner JOINT.fmu force|displacement LOAD.txt STEP OUT.txt".into(),
        );
    };
    let answer = match drive.as_str() {
        "force" => "displacement",
        _ => "force",
    };
    let step: f64 = step.parse()?;
    let load = std::fs::read_to_string(load)?;
    let load = load
        .lines()
        .map(str::parse)
        .collect::<Result<Vec<f64>, _>>()?;
    let library = Fmu::unpack(archive)?.load(fmi2Type::fmi2CoSimulation)?;
    let unit = FmuInstance::instantiate(&library, false)?;
    let variables = unit.lib.variables();
    let input = &variables[drive];
    let signals = [answer, "dissipation", "stored_energy"].map(|name| &variables[name]);
    unit.setup_experiment(0.0, None, None)?;
    unit.enter_initialization_mode()?;
    unit.exit_initialization_mode()?;
    let states = unit.get_set_state_capability();
    let states = states.zip(unit.serialize_state_capability());
    let mut rows = String::new();
    let begun = processor_seconds()?;
    for (row, value) in load.iter().enumerate().skip(1) {
        if let (Some((states, serial)), true) = (&states, row == load.len() / 2) {
            let bytes = serial.serialize_state(&states.get_state()?)?;
            unit.set_reals(&HashMap::from([(input, -value)]))?;
            unit.do_step((row - 1) as f64 * step, step, true)?;
            states.set_state(serial.deserialize_state(&bytes)?)?;
        }
        unit.set_reals(&HashMap::from([(input, *value)]))?;
        unit.do_step((row - 1) as f64 * step, step, true)?;
        let found = unit.get_reals(&signals)?;
        for signal in signals {
            write!(rows, "{} ", found[signal])?;
        }
        rows.push('\n');
    }
    let took = processor_seconds()? - begun;
    std::fs::write(out, rows)?;
    println!("{took}");
    Ok(())
}

/// Of this thread, by Linux's first number in schedstat, in nanoseconds.
fn processor_seconds() -> Result<f64, Box<dyn Error>> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat")?;
    let first = text.split_whitespace().next().ok_or("an empty schedstat")?;
    Ok(first.parse::<f64>()? * 1e-9)
}
