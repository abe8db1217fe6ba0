//! Speed of one step: `cargo bench --bench joint`, or with a part of a name behind it.
//!
//! Each benchmark takes the 4000 samples of the same load; divan shows the time per record and
//! the throughput in samples.

use std::hint::black_box;

use divan::Bencher;
use divan::counter::ItemsCount;
use iwan::joint::{
    Density, Drive, FourParameter, Joint, JointError, Network, Output, PlayNetwork, Plays,
    Simulation, Sliders, SlipLimit, VirginCurve,
};

#[path = "../tests/fmu/host.rs"]
#[allow(dead_code)] // an importer's other half
mod host;

fn main() {
    divan::main();
}

const SAMPLES: usize = 4000;
const SLIDERS: usize = 100;

fn four_parameter() -> Result<FourParameter, JointError> {
    FourParameter::new(1000.0, 1e7, -0.4, 0.5)
}

fn sliders() -> Result<Sliders, JointError> {
    let density = four_parameter()?;
    Ok(density.cells(SLIDERS, density.largest_slip()))
}

/// A two-tone load of many nested loops, in units of its bound.
fn load() -> Vec<f64> {
    (0..SAMPLES)
        .map(|i| {
            let t = 0.02 * i as f64;
            0.5 * t.sin() + 0.5 * (6.3 * t).sin()
        })
        .collect()
}

/// Runs a fresh copy of `start` through the load, scaled by `amplitude`.
fn run(bencher: Bencher, start: Result<Simulation, JointError>, amplitude: f64) {
    let Ok(start) = start else { return };
    let load: Vec<f64> = load().iter().map(|share| amplitude * share).collect();
    bencher
        .counter(ItemsCount::new(SAMPLES))
        .with_inputs(|| start.clone())
        .bench_values(|mut simulation| {
            let mut last = Ok(Output::default());
            for (i, input) in load.iter().enumerate() {
                last = simulation.step(1e-3 * i as f64, black_box(*input));
            }
            last
        });
}

fn simulation(
    density: Result<Density, JointError>,
    drive: Drive,
) -> Result<Simulation, JointError> {
    let joint = Joint::new(density?, 5e7, vec![])?;
    Simulation::new(&joint, drive)
}

/// Force in, displacement out, no discretisation.
#[divan::bench]
fn exact_force_driven(bencher: Bencher) {
    let density = four_parameter().map(Density::FourParameter);
    run(bencher, simulation(density, Drive::Force), 800.0);
}

/// Displacement in, force out, with K_1: the inverse is solved on the virgin curve.
#[divan::bench]
fn exact_displacement_driven(bencher: Bencher) {
    let density = four_parameter().map(Density::FourParameter);
    run(bencher, simulation(density, Drive::Displacement), 3e-4);
}

/// A discrete density through the same memory.
#[divan::bench]
fn exact_sliders_force_driven(bencher: Bencher) {
    run(
        bencher,
        simulation(sliders().map(Density::Sliders), Drive::Force),
        800.0,
    );
}

/// The network of 100 sliders in stop form, driven by slip.
#[divan::bench]
fn network_of_100_sliders_displacement(bencher: Bencher) {
    let Ok(sliders) = sliders() else { return };
    let start = Network::new(&sliders);
    let load: Vec<f64> = load().iter().map(|share| 3e-4 * share).collect();
    bencher
        .counter(ItemsCount::new(SAMPLES))
        .with_inputs(|| start.clone())
        .bench_values(|mut network| {
            let (mut force, mut lost) = (0.0, 0.0);
            for slip in &load {
                network.begin(SlipLimit::UNCHANGED);
                force += network.trial(*slip, true).force;
                lost += network.accept(black_box(*slip));
            }
            (force, lost)
        });
}

/// The network of 100 sliders in play form, driven by force.
#[divan::bench]
fn network_of_100_sliders_force(bencher: Bencher) {
    let Ok(sliders) = sliders() else { return };
    let start = PlayNetwork::new(Plays::from(&sliders));
    let amplitude = 0.8 * sliders.full_slip_force();
    let load: Vec<f64> = load().iter().map(|share| amplitude * share).collect();
    bencher
        .counter(ItemsCount::new(SAMPLES))
        .with_inputs(|| start.clone())
        .bench_values(|mut network| {
            load.iter()
                .map(|force| network.drive_force(black_box(*force)))
                .sum::<f64>()
        });
}

/// 100 sliders with an effect in the load path, through the extended solver.
mod extended {
    use super::*;
    use iwan::joint::{Acting, Effect, Parameter, Place, Response};

    struct Gap;
    impl Effect for Gap {
        fn name(&self) -> &'static str {
            "gap"
        }
        fn place(&self) -> Place {
            Place::InSeries
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[Parameter {
                name: "gap",
                symbol: "g",
                unit: "m",
                lower: 0.0,
                upper: 1.0,
                vanishes_at: Some(0.0),
                neutral: None,
                meaning: "Free play.",
            }]
        }
        fn in_series(&self, values: &[f64], force: f64, _: f64, _: &[f64]) -> Response {
            let slope = if force.abs() < 1.0 {
                0.5 * values[0]
            } else {
                0.0
            };
            Response {
                value: 0.5 * values[0] * force.clamp(-1.0, 1.0),
                slope,
                damping: 0.0,
            }
        }
    }

    fn with_gap(drive: Drive) -> Result<Simulation, JointError> {
        let effects = vec![Acting {
            effect: &Gap,
            values: vec![2e-5],
        }];
        Simulation::new(
            &Joint::new(Density::Sliders(sliders()?), 5e7, effects)?,
            drive,
        )
    }

    #[divan::bench]
    fn force_driven(bencher: Bencher) {
        run(bencher, with_gap(Drive::Force), 800.0);
    }

    #[divan::bench]
    fn displacement_driven(bencher: Bencher) {
        run(bencher, with_gap(Drive::Displacement), 3e-4);
    }
}

/// One step of the FMU: the same load through the C entry points of an instance, so that its cost
/// over `exact_force_driven` is the price of the boundary.
mod co_simulation {
    use super::*;
    use crate::host::{DISPLACEMENT, FORCE, Resources, Unit};
    use iwan::fmu::{Status, TRUE, fmi2DoStep, fmi2GetReal, fmi2SetReal};

    /// The joint of `exact_force_driven`.
    const JOINT: &str = r#"{
      "format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
      "density": {"family": "four_parameter", "slip_force": 1000.0, "stiffness": 1e7,
                  "exponent": -0.4, "ratio": 0.5},
      "series_stiffness": 5e7, "causes": []
    }"#;

    fn steps(bencher: Bencher, drive: Drive, (input, output): (u32, u32), amplitude: f64) {
        let resources = Resources::new(JOINT);
        let load: Vec<f64> = load().iter().map(|share| amplitude * share).collect();
        bencher
            .counter(ItemsCount::new(SAMPLES))
            .with_inputs(|| Unit::stepping(&resources, drive))
            .bench_refs(|unit| {
                let mut answer = 0.0;
                let mut fine = true;
                for (i, value) in load.iter().enumerate() {
                    // SAFETY: a living handle, and one item behind each pointer.
                    let statuses = unsafe {
                        [
                            fmi2SetReal(unit.handle, &input, 1, black_box(value)),
                            fmi2DoStep(unit.handle, 1e-3 * i as f64, 1e-3, TRUE),
                            fmi2GetReal(unit.handle, &output, 1, &mut answer),
                        ]
                    };
                    fine &= statuses == [Status::Ok; 3];
                }
                assert!(fine);
                answer
            });
    }

    #[divan::bench]
    fn force_driven(bencher: Bencher) {
        steps(bencher, Drive::Force, (FORCE, DISPLACEMENT), 800.0);
    }

    #[divan::bench]
    fn displacement_driven(bencher: Bencher) {
        steps(bencher, Drive::Displacement, (DISPLACEMENT, FORCE), 3e-4);
    }
}
