//! Steps: sizes, times, refusals, input derivatives.

use super::communication::uniform;
use super::host::*;
use iwan::fmu::*;
use iwan::joint::{Drive, Simulation};

#[test]
fn the_answer_is_the_simulations_to_the_last_bit() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        for (drive, input, scale) in [
            (Drive::Force, FORCE, 1.0),
            (Drive::Displacement, DISPLACEMENT, 1e-7),
        ] {
            let unit = Unit::stepping(&resources, drive);
            let mut simulation = Simulation::new(&resources.joint(), drive).unwrap();
            simulation.step(0.0, 0.0).unwrap();
            let mut before = 0.0;
            for (t, force) in history().skip(1) {
                unit.ok(unit.set(input, scale * force));
                unit.ok(unit.step(before, t - before));
                let expected = simulation
                    .step(before + (t - before), scale * force)
                    .unwrap();
                let references = [
                    FORCE,
                    DISPLACEMENT,
                    DISSIPATION,
                    DISSIPATION_RATE,
                    STORED_ENERGY,
                    5,
                    6,
                ];
                let expected = [
                    expected.force,
                    expected.displacement,
                    expected.dissipation,
                    expected.dissipation_rate,
                    expected.stored_energy,
                    expected.slip_displacement,
                    expected.tangent_stiffness,
                ];
                assert_eq!(unit.get(&references), expected, "{drive:?} at {t}");
                before = t;
            }
        }
    }
}

#[test]
fn impossible_steps_are_refused_and_tiny_ones_are_fine() {
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let unit = Unit::stepping(&resources, Drive::Force);
    let answer = unit.drive(FORCE, 200.0, 0.0, 0.01);
    for size in [f64::NAN, f64::INFINITY, -1e-3, -1e-17, f64::NEG_INFINITY] {
        assert!(
            unit.error(unit.step(0.01, size))
                .contains("communicationStepSize")
        );
    }
    for point in [f64::NAN, f64::INFINITY, 0.0, 0.011, -0.01] {
        assert!(
            unit.error(unit.step(point, 0.01))
                .contains("currentCommunicationPoint")
        );
    }
    assert_eq!(unit.get(&ANSWERS), answer);
    for size in [0.0, 1e-17, 1.4e-17, 0.0] {
        unit.ok(unit.step(0.01, size));
        // A step of some units in the last place of the time is a step: rounding may differ.
        for (found, before) in unit.get(&ANSWERS)[..2].iter().zip(&answer) {
            assert!(
                (found - before).abs() <= 1e-12 * before.abs(),
                "{size}: {found} {before}"
            );
        }
    }
    // Importers that sum their steps come back 1e-9 late or early.
    unit.ok(unit.step(0.01 + 1e-9, 0.01));
    unit.ok(unit.step(0.02 - 1e-9, 0.01));
    unit.ok(unit.step(0.03 - 1e-9, 1e-17));
}

#[test]
fn a_step_refused_by_the_physics_leaves_everything_as_before() {
    let resources = Resources::new(BOLT);
    let troubled = Unit::stepping(&resources, Drive::Force);
    let calm = Unit::stepping(&resources, Drive::Force);
    let mut before = 0.0;
    for (t, force) in history().skip(1).take(100) {
        troubled.ok(troubled.set(FORCE, 1500.0));
        let told = troubled.error(troubled.step(before, t - before));
        assert!(told.contains("full slip"), "{told}");
        let size = t - before;
        let answers = troubled.drive(FORCE, force, before, size);
        assert_eq!(answers, calm.drive(FORCE, force, before, size));
        before = t;
    }
}

/// With a turning value inside the step that is refused: the part before it must not stay.
#[test]
fn a_step_refused_after_a_turn_leaves_everything_as_before() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let before = unit.drive(FORCE, 500.0, 0.0, 0.1);
    // 500 N, down to 400 N after 0.1 s, up beyond full slip: 500 − 2000 t + 10000 t² at 0.5 s.
    let (references, orders, values) = ([FORCE; 2], [1, 2], [-2000.0, 20000.0]);
    let status = unsafe {
        let (r, o, v) = (references.as_ptr(), orders.as_ptr(), values.as_ptr());
        fmi2SetRealInputDerivatives(unit.handle, r, 2, o, v)
    };
    unit.ok(status);
    let state = unit.save();
    assert!(unit.error(unit.step(0.1, 0.5)).contains("full slip"));
    assert_eq!(unit.get(&ANSWERS), before);
    let after = unit.save();
    assert_eq!(unit.serialize(state), unit.serialize(after));
    unit.free_state(state);
    unit.free_state(after);
}

#[test]
fn times_of_the_experiment() {
    let resources = Resources::new(BOLT);
    let setup = |unit: &Unit, start: f64, stop: f64| unsafe {
        fmi2SetupExperiment(unit.handle, TRUE, 1e-6, start, TRUE, stop)
    };
    let unit = Unit::instantiated(&resources, Drive::Force);
    for (start, stop) in [
        (0.0, -1.0),
        (f64::NAN, 1.0),
        (0.0, f64::NAN),
        (f64::INFINITY, 1.0),
    ] {
        assert!(
            unit.error(setup(&unit, start, stop))
                .contains("expected finite times")
        );
    }
    unit.ok(setup(&unit, 10.0, 11.0));
    unit.ok(unsafe { fmi2EnterInitializationMode(unit.handle) });
    unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
    unit.ok(unit.step(10.0, 0.9));
    assert!(unit.error(unit.step(10.9, 0.2)).contains("stop time 11 s"));
    unit.ok(unit.step(10.9, 0.1 + 1e-12));
}

/// With derivatives the input goes on as their polynomial: one step over a cubic gives what the
/// simulation gives when it is led to each turning value and to the end.
#[test]
fn input_derivatives_find_the_turning_values_inside_a_step() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    // F = 600 · (t − 0.2)(t − 0.6) t · 10 has its turns where 3t² − 1.6t + 0.12 = 0.
    let cubic = |t: f64| 6000.0 * t * (t - 0.2) * (t - 0.6);
    let (references, orders) = ([FORCE; 3], [1, 2, 3]);
    let values = [6000.0 * 0.12, 6000.0 * 2.0 * -0.8, 6000.0 * 6.0];
    let status = unsafe {
        let (r, o, v) = (references.as_ptr(), orders.as_ptr(), values.as_ptr());
        fmi2SetRealInputDerivatives(unit.handle, r, 3, o, v)
    };
    unit.ok(status);
    unit.ok(unit.step(0.0, 0.7));
    let root = (1.6_f64 * 1.6 - 4.0 * 3.0 * 0.12).sqrt();
    let mut simulation = Simulation::new(&resources.joint(), Drive::Force).unwrap();
    for t in [0.0, (1.6 - root) / 6.0, (1.6 + root) / 6.0, 0.7] {
        simulation.step(t, cubic(t)).unwrap();
    }
    let expected = simulation.output();
    let found = unit.get(&[DISPLACEMENT, DISSIPATION]);
    // Rounding of the polynomial, some 1e-13 N in 400 N, at twice the compliance of the start.
    let close = |found: f64, expected: f64| (found - expected).abs() <= 1e-12 * expected.abs();
    assert!(
        close(found[0], expected.displacement),
        "{found:?} {expected:?}"
    );
    assert!(
        close(found[1], expected.dissipation),
        "{found:?} {expected:?}"
    );
    assert!(found[1] > 0.0);
    let rate = unit.get(&[DISSIPATION_RATE])[0];
    assert!(close(rate, found[1] / 0.7));
    // Afterwards they are forgotten: the input as set, zero, holds.
    unit.ok(unit.step(0.7, 0.1));
    let expected = simulation.step(0.8, 0.0).unwrap();
    assert!(close(unit.get(&[DISPLACEMENT])[0], expected.displacement));
}

#[test]
fn wrong_derivatives_are_refused() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let set = |reference: u32, order: i32, value: f64| unsafe {
        fmi2SetRealInputDerivatives(unit.handle, &reference, 1, &order, &value)
    };
    for order in [0, 4, -1, i32::MIN, i32::MAX] {
        assert!(
            unit.error(set(FORCE, order, 1.0))
                .contains("order from 1 to 3")
        );
    }
    assert!(
        unit.error(set(DISPLACEMENT, 1, 1.0))
            .contains("reference of the input")
    );
    assert!(unit.error(set(99, 1, 1.0)).contains("came 99"));
    assert!(
        unit.error(set(FORCE, 1, f64::NAN))
            .contains("derivative 1 of force")
    );
}

#[test]
fn reset_starts_anew_from_any_mode() {
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let run = |unit: &Unit| -> Vec<Vec<f64>> {
        let mut before = 0.0;
        let rows = history().skip(1).map(|(t, force)| {
            let answers = unit.drive(FORCE, force, before, t - before);
            before = t;
            answers
        });
        rows.collect()
    };
    let unit = Unit::instantiated(&resources, Drive::Force);
    unit.ok(unit.set(SLIP_FORCE, 5000.0));
    unit.ok(unsafe { fmi2Reset(unit.handle) });
    let start = |unit: &Unit| {
        unit.ok(unsafe { fmi2EnterInitializationMode(unit.handle) });
        assert_eq!(unit.get(&[SLIP_FORCE]), [1000.0]);
        unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
    };
    start(&unit);
    let first = run(&unit);
    unit.ok(unsafe { fmi2Reset(unit.handle) });
    start(&unit);
    assert_eq!(run(&unit), first);
}

/// A turn within a step that rounding makes none: what is lost in no time has no power.
#[test]
fn a_turn_in_a_step_of_no_time_has_no_power() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        let unit = Unit::stepping(&resources, Drive::Force);
        unit.drive(FORCE, 300.0, 0.0, 1.0);
        for set in [300.0, 310.0] {
            unit.ok(unit.set(FORCE, set));
            derive(&unit, FORCE, [1e-15, -100.0, 0.0]);
            unit.ok(unit.step(1.0, 2e-17));
            let answers = unit.get(&ANSWERS);
            assert!(
                answers.iter().all(|answer| answer.is_finite()),
                "{answers:?}"
            );
            assert_eq!(unit.get(&[DISSIPATION_RATE]), [0.0]);
        }
    }
}

/// The input is set elsewhere than where the joint is, and goes on from there: the value set is a
/// turning value.
#[test]
fn a_jump_to_where_derivatives_begin_is_a_turning_value() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    unit.drive(FORCE, 500.0, 0.0, 0.1);
    unit.ok(unit.set(FORCE, 900.0));
    derive(&unit, FORCE, [-4000.0, 0.0, 0.0]);
    unit.ok(unit.step(0.1, 0.1));
    let mut simulation = Simulation::new(&resources.joint(), Drive::Force).unwrap();
    for (time, force) in [(0.0, 0.0), (0.1, 500.0), (0.1, 900.0), (0.2, 500.0)] {
        simulation.step(time, force).unwrap();
    }
    let expected = simulation.output();
    println!("dissipation {} J", expected.dissipation);
    let found = unit.get(&[DISPLACEMENT, DISSIPATION, STORED_ENERGY]);
    let expected = [
        expected.displacement,
        expected.dissipation,
        expected.stored_energy,
    ];
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found / expected - 1.0).abs() <= 1e-12,
            "{found} {expected}"
        );
    }
}

/// Where a quadratic changes its sign between two points, if it does; it is monotone between them.
fn sign_change(quadratic: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> Option<f64> {
    if low >= high || quadratic(low) * quadratic(high) >= 0.0 {
        return None;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if quadratic(low) * quadratic(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(0.5 * (low + high))
}

/// Random polynomials of every set of orders, from the present input or after a jump: as the
/// simulation led through their extrema, which bisection finds on either side of the vertex.
#[test]
fn random_input_polynomials_are_followed_through_their_extrema() {
    let mut seed = 20_260_121;
    println!("seed {seed}");
    let mut uniform = |low: f64, high: f64| low + (high - low) * uniform(&mut seed);
    let resources = Resources::new(BOLT);
    for (drive, input, output, range) in [
        (Drive::Force, FORCE, DISPLACEMENT, 900.0),
        (Drive::Displacement, DISPLACEMENT, FORCE, 1e-4),
    ] {
        let unit = Unit::stepping(&resources, drive);
        let mut simulation = Simulation::new(&resources.joint(), drive).unwrap();
        simulation.step(0.0, 0.0).unwrap();
        let (mut time, mut largest, mut turns, mut worst) = (0.0, [0.0_f64; 3], 0, 0.0_f64);
        for number in 0..700 {
            let orders = 1 + number % 7;
            let size = 10.0_f64.powf(uniform(-4.0, 0.0));
            let jumps = uniform(0.0, 1.0) < 0.4;
            let mut from = simulation.input() / range;
            if jumps {
                from = uniform(-0.95, 0.95);
            }
            let part = |order: i32, value: f64| if orders & order > 0 { value } else { 0.0 };
            // In shares of the step and of the range; smaller until it stays within.
            let mut shares = [
                part(1, uniform(-4.0, 4.0)),
                part(2, uniform(-8.0, 8.0)),
                part(4, uniform(-8.0, 8.0)),
            ];
            let way = loop {
                let [a, b, c] = shares;
                let value = |s: f64| from + s * (a + s * (b + s * c));
                let rate = |s: f64| a + s * (2.0 * b + s * 3.0 * c);
                let vertex = (-b / (3.0 * c)).clamp(0.0, 1.0);
                let vertex = if vertex.is_nan() { 0.0 } else { vertex };
                let extrema = [
                    sign_change(rate, 0.0, vertex),
                    sign_change(rate, vertex, 1.0),
                ];
                let mut way = vec![(0.0, from)];
                way.extend(extrema.into_iter().flatten().map(|s| (s, value(s))));
                way.push((1.0, value(1.0)));
                if way.iter().all(|(_, value)| value.abs() <= 0.99) {
                    break way;
                }
                shares = shares.map(|share| 0.7 * share);
            };
            turns += way.len() - 2;
            if jumps || number == 0 {
                unit.ok(unit.set(input, range * from));
            } else {
                unit.ok(unit.set(input, simulation.input()));
            }
            let [a, b, c] = shares.map(|share| range * share);
            let derivatives = [
                a / size,
                2.0 * b / (size * size),
                6.0 * c / (size * size * size),
            ];
            derive(&unit, input, derivatives);
            unit.ok(unit.step(time, size));
            for (share, value) in way {
                let at = (time + share * size).max(simulation.output().time);
                simulation.step(at, range * value).unwrap();
            }
            time = simulation.output().time;
            let expected = simulation.output();
            let expected = [
                match drive {
                    Drive::Force => expected.displacement,
                    Drive::Displacement => expected.force,
                },
                expected.dissipation,
                expected.stored_energy,
            ];
            let found = unit.get(&[output, DISSIPATION, STORED_ENERGY]);
            for place in 0..3 {
                largest[place] = largest[place].max(expected[place].abs());
                let apart = (found[place] - expected[place]).abs() / largest[place];
                worst = worst.max(apart);
                assert!(
                    apart <= 1e-9,
                    "{drive:?}, {number}, answer {place}: {found:?} {expected:?}"
                );
            }
        }
        println!("{drive:?}: {turns} turns, largest difference {worst:e}");
        assert!(turns > 100);
    }
}
