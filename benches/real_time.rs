//! How long one step of the FMU takes at most: `cargo bench --bench real_time`, some five minutes.
//!
//! Ten million steps (a million of those with every cause) through the C boundary, each timed by
//! itself: set the input, fmi2DoStep, get the output. By the wall clock they include whatever else
//! the machine did meanwhile; by the thread's own processor time they do not, but for interrupts.
//! The row `nothing but the clock` is what both clocks show around nothing.
//!
//! Both clocks go to stderr, the table of README.md (processor time) to stdout. Words behind `--`:
//! `--readme` puts the table into README.md, between its markers; a number divides the count of
//! steps, to try it.

#[path = "real_time/readme.rs"]
mod readme;

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

    fn tell(&self, name: &str, rows: &mut Vec<readme::Row>) {
        let [wall, processor] = [&self.wall, &self.processor].map(|d| {
            let worst = d.worst as f64 * 1e-3;
            [d.percentile(0.5), d.percentile(0.9999), worst]
        });
        let columns = wall.iter().chain(&processor).map(|x| format!("{x:>9.2}"));
        let columns: String = columns.collect();
        eprintln!("{name:<66}{:>9}{columns}", self.wall.count);
        rows.push(readme::Row {
            name: name.to_owned(),
            steps: self.wall.count,
            microseconds: processor,
        });
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

fn run(resources: &Resources, (drive, share): (Drive, f64), steps: usize) -> Clocks {
    let unit = Unit::stepping(resources, drive);
    let (variables, scale) = variables(drive);
    let mut durations = Clocks::new();
    let size = 1e-4;
    for i in 0..steps {
        let value = share * scale * load(i);
        durations.take(|| step(&unit, variables, value, i as f64 * size, size));
    }
    durations
}

/// Two turns within each step, by derivatives of the input: there, most of the way back, and on.
fn turning(resources: &Resources, (drive, share): (Drive, f64), steps: usize) -> Clocks {
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
    durations
}

/// The steps that cost most by construction: a reversal within the memory; one beyond a full memory,
/// which looks for the loop to forget; and the one out of it, which closes all loops.
fn full_memory(drive: Drive, rounds: usize) -> [Clocks; 3] {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, drive);
    let (variables, scale) = variables(drive);
    let (mut within, mut beyond, mut out) = (Clocks::new(), Clocks::new(), Clocks::new());
    let mut number = 0;
    let swings = 4 * TURNING_POINTS;
    for _ in 0..rounds {
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
    [within, beyond, out]
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let divisor = words.iter().find_map(|word| word.parse().ok());
    let divisor = divisor.unwrap_or(1).max(1);
    let steps = STEPS / divisor;
    let machine = readme::Machine::now();
    let mut rows = Vec::new();
    eprintln!(
        "{:<66}{:>9}{:>27}{:>27}",
        "median, 99.99 %, worst [µs]", "steps", "wall clock", "processor time"
    );
    let mut clock = Clocks::new();
    for _ in 0..steps / 10 {
        clock.take(|| ());
    }
    clock.tell("nothing but the clock", &mut rows);
    let (exact, two) = (Resources::new(BOLT), Resources::new(BOLT_WITH_CAUSES));
    let all = bolt_with_all_causes();
    let drives = [
        (Drive::Force, "by force"),
        (Drive::Displacement, "by displacement"),
    ];
    // With every cause, below the force at which all of them together let the joint go.
    for (name, resources, share, steps) in [
        ("without causes", &exact, 1.0, steps),
        ("two causes", &two, 1.0, steps),
        ("all fifteen causes", &all, 0.6, steps / 10),
    ] {
        for (drive, by) in drives {
            let clocks = run(resources, (drive, share), steps);
            clocks.tell(&format!("{name}, {by}"), &mut rows);
        }
    }
    for (drive, by) in drives {
        let clocks = turning(&all, (drive, 0.6), steps / 10);
        let name = format!("all, two turns within each step, {by}");
        clocks.tell(&name, &mut rows);
    }
    for (drive, by) in drives {
        let names = [
            "reversal within the memory",
            "reversal beyond a full memory",
            "out of a full memory at once: 2048 loops close",
        ];
        let clocks = full_memory(drive, (20 / divisor).max(1));
        for (name, clocks) in names.iter().zip(clocks) {
            clocks.tell(&format!("without causes, {name}, {by}"), &mut rows);
        }
    }
    let table = readme::table(&rows, &machine);
    println!("{table}");
    if words.iter().any(|word| word == "--readme") {
        readme::write(&table);
    }
}
