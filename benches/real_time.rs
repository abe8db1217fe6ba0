//! How long one step of the FMU takes at most: `cargo bench --bench real_time`, four minutes.
//!
//! Ten million steps (a million of those with every cause) through the C boundary, each timed by
//! itself: set the input, fmi2DoStep, get the output. By the wall clock they include whatever else the machine did meanwhile; by the
//! thread's own processor time they do not, but for interrupts. The row `timer` is what both clocks
//! show around nothing. A number behind the command divides the count of steps.

#[path = "../tests/fmu/bolts.rs"]
#[allow(dead_code)] // those with one cause are the tests'
mod bolts;
#[path = "../tests/fmu/host.rs"]
#[allow(dead_code)] // an importer's other half
mod host;

use bolts::bolt_with_all_causes;
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
    worst: u64,
}

impl Durations {
    fn new() -> Durations {
        Durations {
            classes: vec![0; CLASSES],
            count: 0,
            worst: 0,
        }
    }

    fn take(&mut self, nanoseconds: u64) {
        let class = usize::try_from(nanoseconds).map_or(CLASSES - 1, |n| n / CLASS);
        self.classes[class.min(CLASSES - 1)] += 1;
        self.count += 1;
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
}

/// The two clocks over the same steps.
struct Clocks {
    wall: Durations,
    processor: Durations,
}

impl Clocks {
    fn new() -> Clocks {
        Clocks {
            wall: Durations::new(),
            processor: Durations::new(),
        }
    }

    fn take(&mut self, body: impl FnOnce()) {
        let (wall, processor) = (Instant::now(), processor_time());
        body();
        let used = processor_time() - processor;
        self.wall.take(wall.elapsed().as_nanos() as u64);
        self.processor.take(used);
    }

    fn tell(&self, name: &str) {
        let (wall, processor) = (&self.wall, &self.processor);
        println!(
            "{name:<44} {:>9} {:>8.2} {:>8.2} {:>10.2} {:>8.2} {:>8.2} {:>9.2}",
            wall.count,
            wall.percentile(0.5),
            wall.percentile(0.9999),
            wall.worst as f64 * 1e-3,
            processor.percentile(0.5),
            processor.percentile(0.9999),
            processor.worst as f64 * 1e-3
        );
    }
}

/// Time that this thread has spent on a processor \[ns\].
#[cfg(unix)]
fn processor_time() -> u64 {
    let mut now = libc::timespec {
        tv_sec: 0,
        tv_nsec: 0,
    };
    // SAFETY: one timespec may be written.
    let status = unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut now) };
    assert_eq!(status, 0, "no clock of processor time");
    now.tv_sec as u64 * 1_000_000_000 + now.tv_nsec as u64
}

/// No such clock here: its columns are zero.
#[cfg(not(unix))]
fn processor_time() -> u64 {
    0
}

/// One step as an importer makes it.
fn step(unit: &Unit, (input, output): (u32, u32), value: f64, point: f64, size: f64) {
    let mut answer = 0.0;
    let statuses = unsafe {
        [
            fmi2SetReal(unit.handle, &input, 1, &value),
            fmi2DoStep(unit.handle, point, size, TRUE),
            fmi2GetReal(unit.handle, &output, 1, &mut answer),
        ]
    };
    assert_eq!(statuses, [Status::Ok; 3]);
}

/// A two-tone load of nested loops whose amplitude wanders.
fn load(i: usize) -> f64 {
    let t = 0.02 * i as f64;
    (0.5 * t.sin() + 0.5 * (6.3 * t).sin()) * (0.6 + 0.4 * (1e-4 * t).sin())
}

/// Input and output of a drive, and the input's largest value [N or m].
fn variables(drive: Drive) -> ((u32, u32), f64) {
    match drive {
        Drive::Force => ((FORCE, DISPLACEMENT), 800.0),
        Drive::Displacement => ((DISPLACEMENT, FORCE), 1e-4),
    }
}

fn run(name: &str, resources: &Resources, (drive, share): (Drive, f64), steps: usize) {
    let unit = Unit::stepping(resources, drive);
    let (variables, scale) = variables(drive);
    let mut durations = Clocks::new();
    let size = 1e-4;
    for i in 0..steps {
        let value = share * scale * load(i);
        durations.take(|| step(&unit, variables, value, i as f64 * size, size));
    }
    durations.tell(name);
}

/// Two turns within each step, by derivatives of the input: there, most of the way back, and on.
fn turning(name: &str, resources: &Resources, (drive, share): (Drive, f64), steps: usize) {
    let unit = Unit::stepping(resources, drive);
    let (variables, scale) = variables(drive);
    let mut durations = Clocks::new();
    let (size, mut from) = (1e-4, 0.0);
    for i in 0..steps {
        let to = 0.8 * share * scale * load(i);
        // Over the share s of the step, from + b s (1 − s)(1 − 2 s) + (to − from) s.
        let (bend, rise) = (0.5 * share * scale, to - from);
        let orders = [
            (bend + rise) / size,
            -6.0 * bend / (size * size),
            12.0 * bend / (size * size * size),
        ];
        durations.take(|| {
            derive(&unit, variables.0, orders);
            step(&unit, variables, from, i as f64 * size, size);
        });
        from = to;
    }
    durations.tell(name);
}

/// The step that costs most by construction: every reversal beyond a full memory looks for the loop
/// to forget, and one step out of it closes all loops.
fn full_memory(drive: Drive, name: &str) {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, drive);
    let (variables, scale) = variables(drive);
    let (mut within, mut beyond, mut out) = (Clocks::new(), Clocks::new(), Clocks::new());
    let mut number = 0;
    let swings = 4 * TURNING_POINTS;
    for _ in 0..20 {
        for i in 0..swings {
            let size = scale * (0.99 - 0.98 * i as f64 / swings as f64);
            let value = if i.is_multiple_of(2) { size } else { -size };
            let clocks = if i > TURNING_POINTS {
                &mut beyond
            } else {
                &mut within
            };
            let time = f64::from(number) * 1e-3;
            clocks.take(|| step(&unit, variables, value, time, 1e-3));
            number += 1;
        }
        let time = f64::from(number) * 1e-3;
        out.take(|| step(&unit, variables, scale, time, 1e-3));
        number += 1;
    }
    within.tell(&format!("{name}, reversal within the memory"));
    beyond.tell(&format!("{name}, reversal beyond a full memory"));
    out.tell(&format!("{name}, out of a full memory at once"));
}

fn main() {
    let divisor = std::env::args().find_map(|word| word.parse::<usize>().ok());
    let steps = STEPS / divisor.unwrap_or(1).max(1);
    println!(
        "{:<44} {:>9} {:>8} {:>8} {:>10} {:>8} {:>8} {:>9}",
        "[µs]", "steps", "median", "99.99 %", "worst", "median", "99.99 %", "worst"
    );
    println!("{:<54} {:<28} processor time", "", "wall clock");
    let mut timer = Clocks::new();
    for _ in 0..steps / 10 {
        timer.take(|| ());
    }
    timer.tell("timer");
    let (exact, two) = (Resources::new(BOLT), Resources::new(BOLT_WITH_CAUSES));
    let all = bolt_with_all_causes();
    for (drive, name) in [
        (Drive::Force, "force"),
        (Drive::Displacement, "displacement"),
    ] {
        run(&format!("exact, {name}"), &exact, (drive, 1.0), steps);
        run(&format!("two causes, {name}"), &two, (drive, 1.0), steps);
        // Below the force at which all of them together let the joint go.
        let some = (drive, 0.6);
        run(&format!("every cause, {name}"), &all, some, steps / 10);
        let name = format!("every cause, two turns in a step, {name}");
        turning(&name, &all, some, steps / 10);
    }
    full_memory(Drive::Force, "force");
    full_memory(Drive::Displacement, "displacement");
}
