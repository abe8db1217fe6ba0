//! How long one step of the FMU takes at most: `cargo bench --bench real_time`, half a minute.
//!
//! Ten million steps through the C boundary, each timed by itself: set the input, fmi2DoStep, get
//! the output. Worst case and percentiles include whatever else the machine did meanwhile; the
//! column `timer` is what the clock shows around nothing. A number behind the command divides the
//! count of steps.

#[path = "../tests/fmu/host.rs"]
#[allow(dead_code)] // an importer's other half
mod host;

use host::*;
use iwan::fmu::*;
use iwan::joint::Drive;
use std::time::Instant;

const STEPS: usize = 10_000_000;
/// Width of a class \[ns\], and classes; what is longer counts as worst only.
const CLASS: usize = 10;
const CLASSES: usize = 100_000;

/// Durations in classes.
struct Durations {
    classes: Vec<u32>,
    count: usize,
    sum: f64,
    worst: u128,
}

impl Durations {
    fn new() -> Durations {
        Durations {
            classes: vec![0; CLASSES],
            count: 0,
            sum: 0.0,
            worst: 0,
        }
    }

    fn take(&mut self, nanoseconds: u128) {
        let class = usize::try_from(nanoseconds).map_or(CLASSES - 1, |n| n / CLASS);
        self.classes[class.min(CLASSES - 1)] += 1;
        self.count += 1;
        self.sum += nanoseconds as f64;
        self.worst = self.worst.max(nanoseconds);
    }

    /// Upper edge \[µs\] of the class below which this share lies.
    fn percentile(&self, share: f64) -> f64 {
        let wanted = (share * self.count as f64).ceil() as usize;
        let mut passed = 0;
        for (class, count) in self.classes.iter().enumerate() {
            passed += *count as usize;
            if passed >= wanted {
                return ((class + 1) * CLASS) as f64 * 1e-3;
            }
        }
        f64::INFINITY
    }

    fn tell(&self, name: &str) {
        println!(
            "{name:<44} {:>10} {:>8.3} {:>8.2} {:>8.2} {:>9.2}",
            self.count,
            self.sum / self.count as f64 * 1e-3,
            self.percentile(0.5),
            self.percentile(0.9999),
            self.worst as f64 * 1e-3
        );
    }
}

/// One timed step.
fn step(unit: &Unit, (input, output): (u32, u32), value: f64, point: f64, size: f64) -> u128 {
    let mut answer = 0.0;
    let begun = Instant::now();
    let statuses = unsafe {
        [
            fmi2SetReal(unit.handle, &input, 1, &value),
            fmi2DoStep(unit.handle, point, size, TRUE),
            fmi2GetReal(unit.handle, &output, 1, &mut answer),
        ]
    };
    let taken = begun.elapsed().as_nanos();
    assert_eq!(statuses, [Status::Ok; 3]);
    taken
}

/// A two-tone load of nested loops whose amplitude wanders.
fn load(i: usize) -> f64 {
    let t = 0.02 * i as f64;
    (0.5 * t.sin() + 0.5 * (6.3 * t).sin()) * (0.6 + 0.4 * (1e-4 * t).sin())
}

fn run(name: &str, json: &'static str, drive: Drive, steps: usize) {
    let resources = Resources::new(json);
    let unit = Unit::stepping(&resources, drive);
    let (variables, scale) = match drive {
        Drive::Force => ((FORCE, DISPLACEMENT), 800.0),
        Drive::Displacement => ((DISPLACEMENT, FORCE), 1e-4),
    };
    let mut durations = Durations::new();
    let size = 1e-4;
    for i in 0..steps {
        durations.take(step(
            &unit,
            variables,
            scale * load(i),
            i as f64 * size,
            size,
        ));
    }
    durations.tell(name);
}

/// The step that costs most by construction: every reversal beyond a full memory looks for the loop
/// to forget, and one step out of it closes all loops.
fn full_memory(drive: Drive, name: &str) {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, drive);
    let (variables, scale) = match drive {
        Drive::Force => ((FORCE, DISPLACEMENT), 900.0),
        Drive::Displacement => ((DISPLACEMENT, FORCE), 1e-4),
    };
    let (mut beyond, mut out) = (Durations::new(), Durations::new());
    let mut number = 0;
    let swings = 4 * TURNING_POINTS;
    for _ in 0..20 {
        for i in 0..swings {
            let size = scale * (0.99 - 0.98 * i as f64 / swings as f64);
            let value = if i.is_multiple_of(2) { size } else { -size };
            let taken = step(&unit, variables, value, f64::from(number) * 1e-3, 1e-3);
            if i > TURNING_POINTS {
                beyond.take(taken);
            }
            number += 1;
        }
        out.take(step(
            &unit,
            variables,
            scale,
            f64::from(number) * 1e-3,
            1e-3,
        ));
        number += 1;
    }
    beyond.tell(&format!("{name}, reversal beyond a full memory"));
    out.tell(&format!("{name}, out of a full memory at once"));
}

fn main() {
    let divisor = std::env::args().find_map(|word| word.parse::<usize>().ok());
    let steps = STEPS / divisor.unwrap_or(1).max(1);
    println!(
        "{:<44} {:>10} {:>8} {:>8} {:>8} {:>9}",
        "[µs]", "steps", "mean", "median", "99.99 %", "worst"
    );
    let mut timer = Durations::new();
    for _ in 0..steps / 10 {
        timer.take(Instant::now().elapsed().as_nanos());
    }
    timer.tell("timer");
    run("exact, driven in force", BOLT, Drive::Force, steps);
    run(
        "exact, driven in displacement",
        BOLT,
        Drive::Displacement,
        steps,
    );
    let causes = BOLT_WITH_CAUSES;
    run(
        "two causes, driven in force",
        causes,
        Drive::Force,
        steps / 20,
    );
    run(
        "two causes, driven in displacement",
        causes,
        Drive::Displacement,
        steps / 20,
    );
    full_memory(Drive::Force, "force");
    full_memory(Drive::Displacement, "displacement");
}
