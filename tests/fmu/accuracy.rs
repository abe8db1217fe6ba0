//! How near the answer comes where a host gives value and slope of the input at successive points.

use super::communication::uniform;
use super::host::*;
use iwan::fmu::*;
use iwan::joint::{Drive, Joint, Simulation};
use std::f64::consts::TAU;

/// Steps in a cycle of the fastest part of a load.
const PER_CYCLE: f64 = 100.0;

/// A sum of sines.
struct Load {
    /// Amplitude, angular frequency \[rad/s\] and phase of each.
    parts: Vec<[f64; 3]>,
}

impl Load {
    /// One cycle a second, turning half-way between two points: where a cubic misses most.
    fn worst_sine() -> Load {
        let parts = vec![[1.0, TAU, 0.5 * TAU / PER_CYCLE]];
        Load { parts }
    }

    /// One cycle a second and, beside it, `faster` parts; its peak is 1.
    fn drawn(random: &mut u64, faster: usize) -> Load {
        let mut parts = vec![[1.0, TAU, TAU * uniform(random)]];
        for _ in 0..faster {
            let ratio = 2.0 + (7.0 * uniform(random)).floor();
            let size = 0.8 * uniform(random);
            parts.push([size, TAU * ratio, TAU * uniform(random)]);
        }
        let mut load = Load { parts };
        let peak = (0..2000).fold(0.0_f64, |a, i| {
            a.max(load.value(f64::from(i) / 2000.0).abs())
        });
        load.parts.iter_mut().for_each(|part| part[0] /= peak);
        load
    }

    fn value(&self, t: f64) -> f64 {
        let each = self.parts.iter();
        each.map(|[a, w, phase]| a * (w * t + phase).sin()).sum()
    }

    fn rate(&self, t: f64) -> f64 {
        let each = self.parts.iter();
        each.map(|[a, w, phase]| a * w * (w * t + phase).cos())
            .sum()
    }

    /// Length of a step \[s\].
    fn step(&self) -> f64 {
        let fastest = self.parts.iter().fold(0.0_f64, |a, part| a.max(part[1]));
        TAU / fastest / PER_CYCLE
    }

    /// Largest distance of the cubic through value and slope at two points from the load: h⁴/384
    /// times its fourth derivative.
    fn interpolation_error(&self) -> f64 {
        let fourth: f64 = self.parts.iter().map(|[a, w, _]| a * w.powi(4)).sum();
        self.step().powi(4) / 384.0 * fourth
    }

    /// Times at which it turns.
    fn turns(&self, end: f64) -> Vec<f64> {
        let grid = self.step() / 4.0;
        let mut turns = Vec::new();
        let mut from = 0.0;
        while from < end {
            let (mut low, mut high) = (from, from + grid);
            if self.rate(low) * self.rate(high) < 0.0 {
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if self.rate(low) * self.rate(middle) > 0.0 {
                        low = middle;
                    } else {
                        high = middle;
                    }
                }
                turns.push(0.5 * (low + high));
            }
            from += grid;
        }
        turns
    }
}

/// Dissipation \[J\] of the joint led from turning value to turning value, each of them further out
/// by a share of the load's size.
fn exact(joint: &Joint, drive: Drive, load: &Load, size: f64, end: f64, out: f64) -> f64 {
    let mut simulation = Simulation::new(joint, drive).unwrap();
    simulation.step(0.0, size * load.value(0.0)).unwrap();
    for t in load.turns(end).into_iter().filter(|t| *t < end) {
        let outwards = load.rate(t - 0.1 * load.step()).signum();
        let value = load.value(t) + out * outwards;
        simulation.step(t, size * value).unwrap();
    }
    simulation.step(end, size * load.value(end)).unwrap();
    simulation.output().dissipation
}

/// The same by the FMU, from value and slope at the communication points.
fn stepped(resources: &Resources, drive: Drive, load: &Load, size: f64, count: u32) -> f64 {
    let unit = Unit::initializing(resources, drive);
    let input = match drive {
        Drive::Force => FORCE,
        Drive::Displacement => DISPLACEMENT,
    };
    unit.ok(unit.set(input, size * load.value(0.0)));
    unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
    let time = |i: u32| f64::from(i) * load.step();
    for i in 0..count {
        let (from, to) = (time(i), time(i + 1));
        let length = to - from;
        let [here, there] = [from, to].map(|t| size * load.value(t));
        let [leaving, coming] = [from, to].map(|t| size * load.rate(t));
        let rise = (there - here) / length;
        unit.ok(unit.set(input, here));
        derive(
            &unit,
            input,
            [
                leaving,
                (6.0 * rise - 4.0 * leaving - 2.0 * coming) / length,
                (6.0 * (leaving + coming) - 12.0 * rise) / (length * length),
            ],
        );
        unit.ok(unit.step(from, length));
    }
    unit.get(&[DISSIPATION])[0]
}

/// A bolt of drawn size, stiffness, exponent and ratio; and its slip force.
fn drawn_bolt(random: &mut u64) -> (Resources, f64) {
    let mut between = |low: f64, high: f64| low + (high - low) * uniform(random);
    let slip_force = 10.0_f64.powf(between(2.0, 4.0));
    let stiffness = slip_force * 10.0_f64.powf(between(3.5, 5.0));
    let (exponent, ratio) = (between(-0.8, 0.5), between(0.0, 2.0));
    let series = stiffness * between(0.5, 5.0);
    let json = BOLT
        .replace(
            "\"slip_force\": 1000.0",
            &format!("\"slip_force\": {slip_force}"),
        )
        .replace("1.5e7", &stiffness.to_string())
        .replace("-0.4", &exponent.to_string())
        .replace("\"ratio\": 0.3", &format!("\"ratio\": {ratio}"))
        .replace("4e7", &series.to_string());
    (Resources::new(Box::leak(json.into_boxed_str())), slip_force)
}

/// Amplitude over that of full slip.
const SHARES: [f64; 7] = [0.01, 0.1, 0.5, 0.8, 0.9, 0.95, 0.98];
const DRIVES: [Drive; 2] = [Drive::Force, Drive::Displacement];
/// What is wanted of the dissipation at a hundred points a cycle.
const WANTED: f64 = 2e-7;
/// By how much turning values are moved for the growth: the difference is then far above rounding,
/// and little beyond the slope.
const OUTWARDS: f64 = 1e-3;

/// The cubic misses a sine by h⁴ω⁴/384 = 4.1e-8 of its amplitude at most, half-way between two
/// points. No more is lost than a load would gain whose turning values all lie that much further
/// out: for a sine its growth d ln D / d ln A times 4.1e-8. Growths are 2 to 4 as a rule, and beyond
/// 4.9, where 2e-7 are passed, only where a force comes near to slipping all of a joint that has
/// little left to hold it (a small ratio β). What is lost there the polynomial loses, not the joint.
#[test]
fn slopes_at_a_hundred_points_per_cycle_give_the_dissipation_to_2e_7() {
    let seed = 20_261_121;
    println!("seed {seed}");
    let mut random = seed;
    let mut worst = [[0.0_f64; DRIVES.len()]; SHARES.len()];
    let (mut of_bound, mut beyond) = (0.0_f64, Vec::new());
    for number in 0..16 {
        let (resources, slip_force) = drawn_bolt(&mut random);
        let joint = resources.joint();
        let mut loads = vec![Load::worst_sine()];
        loads.extend((0..3).map(|faster| Load::drawn(&mut random, faster)));
        for (load, share, drive) in cases(&loads) {
            let mut virgin = Simulation::new(&joint, Drive::Force).unwrap();
            let ends = virgin.step(0.0, SHARES[share] * slip_force).unwrap();
            let size = match DRIVES[drive] {
                Drive::Force => ends.force,
                Drive::Displacement => ends.displacement,
            };
            let count = (3.0 / load.step()).round() as u32;
            let end = f64::from(count) * load.step();
            let of = |out: f64| exact(&joint, DRIVES[drive], load, size, end, out);
            let expected = of(0.0);
            let growth = (of(OUTWARDS) / expected - 1.0) / OUTWARDS;
            let found = stepped(&resources, DRIVES[drive], load, size, count);
            let apart = (found / expected - 1.0).abs();
            worst[share][drive] = worst[share][drive].max(apart);
            let what = format!(
                "joint {number}, {} parts, {} of full slip, {:?}: off by {apart:.2e}, growth {growth:.2}",
                load.parts.len(),
                SHARES[share],
                DRIVES[drive],
            );
            let bound = growth * load.interpolation_error();
            of_bound = of_bound.max(apart / bound);
            assert!(apart <= bound, "{what}: beyond {bound:.2e}");
            if apart > WANTED {
                assert!(growth > 4.9, "{what}");
                assert_eq!((DRIVES[drive], share >= 3), (Drive::Force, true), "{what}");
                beyond.push(what);
            }
        }
    }
    for (share, [force, displacement]) in SHARES.iter().zip(worst) {
        println!("{share} of full slip: {force:.1e} by force, {displacement:.1e} by displacement");
    }
    println!("{of_bound:.2} of the bound at most; beyond 2e-7: {beyond:#?}");
    assert!(of_bound > 0.8, "the bound is not met nearly");
}

/// Every load at every amplitude under either drive.
fn cases(loads: &[Load]) -> impl Iterator<Item = (&Load, usize, usize)> {
    let each = loads
        .iter()
        .flat_map(|load| (0..SHARES.len()).map(move |share| (load, share)));
    each.flat_map(|(load, share)| (0..DRIVES.len()).map(move |drive| (load, share, drive)))
}

/// The same points without slopes miss the turning values by chance, a thousand times as far.
#[test]
fn values_alone_lose_a_thousand_times_as_much() {
    let resources = Resources::new(BOLT);
    let load = Load::worst_sine();
    let unit = Unit::stepping(&resources, Drive::Force);
    let end = 500.0 * load.step();
    let mut before = 0.0;
    unit.ok(unit.set(FORCE, 500.0 * load.value(0.0)));
    unit.ok(unit.step(0.0, 0.0));
    for t in (1..=500).map(|i| f64::from(i) * load.step()) {
        unit.drive(FORCE, 500.0 * load.value(t), before, t - before);
        before = t;
    }
    let expected = exact(&resources.joint(), Drive::Force, &load, 500.0, end, 0.0);
    let apart = (unit.get(&[DISSIPATION])[0] / expected - 1.0).abs();
    assert!(apart > 5e-4, "{apart}");
}
