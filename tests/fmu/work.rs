//! How much a step has to do at most, where causes act.

use super::bolts::{bolt_with_all_causes, bolts_with_one_cause};
use super::communication::uniform;
use iwan::joint::{Drive, MOST_TRIALS, Simulation};

/// Jumps, rests and steps from a nanosecond to a second, up to full slip and beyond, where they are
/// refused: the search for the slip keeps far from the limit of its work.
#[test]
fn the_search_for_the_slip_keeps_to_its_limit() {
    let seed = 20_261_121;
    println!("seed {seed}");
    let mut joints = bolts_with_one_cause();
    joints.push(("all causes", bolt_with_all_causes()));
    let (mut worst, mut steps) = ((0, "none"), 0);
    for (name, resources) in &joints {
        for (drive, largest) in [(Drive::Force, 1100.0), (Drive::Displacement, 2e-4)] {
            let mut simulation = Simulation::new(&resources.joint(), drive).unwrap();
            let (mut random, mut time) = (seed, 0.0);
            for _ in 0..1000 {
                if uniform(&mut random) < 0.8 {
                    time += 10.0_f64.powf(-9.0 * uniform(&mut random));
                }
                let share = uniform(&mut random) * uniform(&mut random);
                let sign = (uniform(&mut random) - 0.5).signum();
                if simulation.step(time, sign * share * largest).is_err() {
                    continue;
                }
                steps += 1;
                if simulation.trials() > worst.0 {
                    worst = (simulation.trials(), *name);
                }
            }
        }
    }
    println!(
        "{} trials at most, with {}, of {steps} steps",
        worst.0, worst.1
    );
    assert!(steps > 25_000);
    assert!(worst.0 > 1 && worst.0 <= MOST_TRIALS / 2, "{worst:?}");
}
