//! Directional derivatives as an implicit master uses them, and derivatives over time.

use super::host::*;
use iwan::fmu::*;
use iwan::joint::Drive;

const SLIP: u32 = 5;
const TANGENT: u32 = 6;

fn slopes(unit: &Unit, unknowns: &[u32], known: u32) -> Result<Vec<f64>, String> {
    let mut slopes = vec![f64::NAN; unknowns.len()];
    let (references, count, places) = (unknowns.as_ptr(), unknowns.len(), slopes.as_mut_ptr());
    let status = unsafe {
        fmi2GetDirectionalDerivative(unit.handle, references, count, &known, 1, &1.0, places)
    };
    if status == Status::Ok {
        return Ok(slopes);
    }
    assert!(slopes.iter().all(|x| x.is_nan()), "written only on success");
    Err(unit.error(status))
}

fn rates(unit: &Unit, references: &[u32], order: i32) -> Result<Vec<f64>, String> {
    let (count, orders) = (references.len(), vec![order; references.len()]);
    let mut rates = vec![f64::NAN; count];
    let (references, orders) = (references.as_ptr(), orders.as_ptr());
    let status = unsafe {
        fmi2GetRealOutputDerivatives(unit.handle, references, count, orders, rates.as_mut_ptr())
    };
    if status == Status::Ok {
        return Ok(rates);
    }
    assert!(rates.iter().all(|x| x.is_nan()), "written only on success");
    Err(unit.error(status))
}

/// An implicit master's way: take a step, go back, take it with a slightly different input. The
/// difference is what the derivative says, for every answer, at every step of a history with
/// reversals and loops.
#[test]
fn directional_derivatives_are_those_of_the_repeated_step() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        for (drive, input, output, scale) in [
            (Drive::Force, FORCE, DISPLACEMENT, 1.0),
            (Drive::Displacement, DISPLACEMENT, FORCE, 1e-7),
        ] {
            let unit = Unit::stepping(&resources, drive);
            let answers = [output, DISSIPATION, DISSIPATION_RATE, STORED_ENERGY, SLIP];
            let width = 1e-5 * 700.0 * scale;
            let (mut before, mut last) = (0.0, 0.0);
            let mut rows = Vec::new();
            for (t, force) in history().skip(1) {
                let state = unit.save();
                let at = |value: f64| {
                    unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
                    unit.ok(unit.set(input, value));
                    unit.ok(unit.step(before, t - before));
                    unit.get(&answers)
                };
                let value = scale * force;
                let (above, below) = (at(value + width), at(value - width));
                at(value);
                let found = slopes(&unit, &answers, input).unwrap();
                // A reversal within the difference is seen by no two-sided quotient.
                if (value - last).abs() > 4.0 * width {
                    let quotients: Vec<f64> = above
                        .iter()
                        .zip(&below)
                        .map(|(above, below)| (above - below) / (2.0 * width))
                        .collect();
                    rows.push((t, found, quotients));
                }
                unit.free_state(state);
                (before, last) = (t, value);
            }
            assert!(rows.len() > 350);
            for place in 0..answers.len() {
                let largest = rows
                    .iter()
                    .fold(0.0_f64, |a, row| a.max(row.1[place].abs()));
                for (t, found, quotients) in &rows {
                    // The causes' network has 256 sliders: at a corner the quotient is in between.
                    let corner = if json == BOLT { 1e-4 } else { 3e-2 };
                    assert!(
                        (found[place] - quotients[place]).abs() <= corner * largest,
                        "{drive:?} at {t}, answer {place}: {} {}",
                        found[place],
                        quotients[place]
                    );
                }
            }
        }
    }
}

/// Newton's method with it: a force that a spring beside the joint takes its share of.
#[test]
fn an_implicit_coupling_converges_in_a_few_steps() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let stiffness = 5e6; // of the spring beside the joint [N/m]
    for (step, load) in [(0, 800.0), (1, -900.0), (2, 300.0), (3, 1000.0)] {
        let state = unit.save();
        let time = f64::from(step) * 0.1;
        let mut force = 0.0;
        let mut iterations = 0;
        loop {
            unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
            unit.ok(unit.set(FORCE, force));
            unit.ok(unit.step(time, 0.1));
            let displacement = unit.get(&[DISPLACEMENT])[0];
            let missing = load - stiffness * displacement - force;
            if missing.abs() < 1e-9 * f64::abs(load) {
                break;
            }
            let compliance = slopes(&unit, &[DISPLACEMENT], FORCE).unwrap()[0];
            // Short of full slip, where no displacement answers.
            force = (force + missing / (1.0 + stiffness * compliance)).clamp(-990.0, 990.0);
            iterations += 1;
            assert!(iterations < 12, "{load}: {force} {missing}");
        }
        unit.free_state(state);
    }
}

#[test]
fn before_the_first_step_it_is_the_initial_stiffness() {
    let resources = Resources::new(BOLT);
    let initial = resources.joint().initial_stiffness();
    for unit in [
        Unit::initializing(&resources, Drive::Displacement),
        Unit::stepping(&resources, Drive::Displacement),
    ] {
        let found = slopes(&unit, &[FORCE, DISSIPATION, DISSIPATION_RATE], DISPLACEMENT).unwrap();
        assert!((found[0] / initial - 1.0).abs() < 1e-12);
        assert_eq!(found[1..], [0.0, 0.0]);
        unit.ok(unit.set(DISPLACEMENT, 4e-5));
    }
    let unit = Unit::initializing(&resources, Drive::Displacement);
    unit.ok(unit.set(DISPLACEMENT, 4e-5));
    assert!(slopes(&unit, &[FORCE], DISPLACEMENT).unwrap()[0] < 0.9 * initial);
}

#[test]
fn what_has_no_derivative_is_refused() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    unit.drive(FORCE, 300.0, 0.0, 0.1);
    let refused = |unknown: u32, known: u32, expected: &str| {
        let told = slopes(&unit, &[DISPLACEMENT, unknown], known).unwrap_err();
        assert!(told.contains(expected), "{told}");
    };
    refused(DISPLACEMENT, DISPLACEMENT, "reference of the input, came 1");
    refused(
        DISPLACEMENT,
        SERIES_STIFFNESS,
        "reference of the input, came 100",
    );
    refused(DISPLACEMENT, 77, "type Real, came 77");
    refused(FORCE, FORCE, "reference of an output, came 0");
    refused(SERIES_STIFFNESS, FORCE, "reference of an output, came 100");
    refused(99, FORCE, "type Real, came 99");
    refused(TANGENT, FORCE, "`tangent_stiffness` has no derivative");
    assert!(
        rates(&unit, &[DISPLACEMENT, FORCE], 1)
            .unwrap_err()
            .contains("came 0")
    );
    assert!(rates(&unit, &[77], 1).unwrap_err().contains("came 77"));
    assert!(
        rates(&unit, &[TANGENT], 1)
            .unwrap_err()
            .contains("no derivative")
    );
    for order in [0, 2, -1, i32::MAX] {
        let told = rates(&unit, &[DISPLACEMENT], order).unwrap_err();
        assert!(told.contains("order from 1 to 1"), "{told}");
    }
    let null = std::ptr::null_mut();
    unit.error(unsafe {
        fmi2GetDirectionalDerivative(unit.handle, &DISPLACEMENT, 1, &FORCE, 1, &1.0, null)
    });
    unit.ok(unsafe {
        fmi2GetDirectionalDerivative(unit.handle, null.cast(), 0, null.cast(), 0, null, null)
    });
}

/// Rates at the end of a step, against the answers one step before and one after.
#[test]
fn output_derivatives_are_the_rates_at_the_end_of_the_step() {
    for json in [BOLT, BOLT_WITH_CAUSES] {
        let resources = Resources::new(json);
        for (drive, input, output, scale) in [
            (Drive::Force, FORCE, DISPLACEMENT, 1.0),
            (Drive::Displacement, DISPLACEMENT, FORCE, 1e-7),
        ] {
            let unit = Unit::stepping(&resources, drive);
            let answers = [output, DISSIPATION, STORED_ENERGY, SLIP];
            assert_eq!(rates(&unit, &answers, 1).unwrap(), [0.0; 4]);
            let size = 1e-3;
            let (mut found, mut values) = (Vec::new(), Vec::new());
            for i in 0..300 {
                let end = f64::from(i + 1) * size;
                unit.ok(unit.set(input, scale * 500.0 * (30.0 * end).sin()));
                unit.ok(unit.step(f64::from(i) * size, size));
                values.push(unit.get(&answers));
                found.push(rates(&unit, &answers, 1).unwrap());
            }
            for place in 0..answers.len() {
                let quotient =
                    |i: usize| (values[i + 1][place] - values[i - 1][place]) / (2.0 * size);
                let largest = (1..299).fold(0.0_f64, |a, i| a.max(quotient(i).abs()));
                // The input's rate is that of the step's middle: half a step apart, 15 mrad.
                let apart = |i: usize| (found[i][place] - quotient(i)).abs();
                let close = (1..299).filter(|&i| apart(i) <= 0.06 * largest).count();
                // All but the steps within which the load turns, two in 210 and their neighbours.
                assert!(close >= 289, "{drive:?}, answer {place}: {close} of 298");
            }
        }
    }
}

/// With derivatives of the input the rate is that of the polynomial at the end, exactly.
#[test]
fn output_derivatives_follow_the_input_polynomial() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    unit.drive(FORCE, 100.0, 0.0, 0.1);
    let (references, orders, values) = ([FORCE; 2], [1, 2], [-500.0, 20000.0]);
    unit.ok(unsafe {
        let (r, o, v) = (references.as_ptr(), orders.as_ptr(), values.as_ptr());
        fmi2SetRealInputDerivatives(unit.handle, r, 2, o, v)
    });
    unit.ok(unit.step(0.1, 0.2));
    let answers = [DISPLACEMENT, DISSIPATION, STORED_ENERGY];
    let slopes = slopes(&unit, &answers, FORCE).unwrap();
    let rate = -500.0 + 20000.0 * 0.2;
    let expected: Vec<f64> = slopes.iter().map(|slope| slope * rate).collect();
    assert_eq!(rates(&unit, &answers, 1).unwrap(), expected);
    let power = rates(&unit, &[DISSIPATION, DISSIPATION_RATE], 1).unwrap();
    let mean = unit.get(&[DISSIPATION_RATE])[0];
    assert!((power[1] - 2.0 * (power[0] - mean) / 0.2).abs() <= 1e-12 * power[1].abs());
}

/// Where the input turns within a step, the derivative is that over the input at the step's end, with
/// the turning value held: that of a step which goes a little further along the same polynomial.
#[test]
fn behind_a_turn_within_the_step_derivatives_are_those_at_its_end() {
    let resources = Resources::new(BOLT);
    for (drive, input, output, scale) in [
        (Drive::Force, FORCE, DISPLACEMENT, 1.0),
        (Drive::Displacement, DISPLACEMENT, FORCE, 1e-7),
    ] {
        let unit = Unit::stepping(&resources, drive);
        unit.ok(unit.set(input, 300.0 * scale));
        unit.ok(unit.step(0.0, 0.1));
        // Up to 400 after 0.05 s, and down to 200 at 0.12 s.
        let (first, second) = (4000.0 * scale, -80000.0 * scale);
        derive(&unit, input, [first, second, 0.0]);
        let answers = [output, DISSIPATION, STORED_ENERGY, SLIP];
        let state = unit.save();
        let further = |size: f64| {
            unit.ok(unsafe { fmi2SetFMUstate(unit.handle, state) });
            unit.ok(unit.step(0.1, size));
            unit.get(&answers)
        };
        let (size, more) = (0.12, 1e-7);
        let (before, behind) = (further(size - more), further(size + more));
        further(size);
        let rate = first + second * size;
        let over_input = slopes(&unit, &answers, input).unwrap();
        let over_time = rates(&unit, &answers, 1).unwrap();
        for place in 0..answers.len() {
            let quotient = (behind[place] - before[place]) / (2.0 * more);
            let close = |found: f64, expected: f64| {
                assert!(
                    (found - expected).abs() <= 1e-6 * expected.abs(),
                    "{drive:?}, answer {}: {found} {expected}",
                    answers[place]
                );
            };
            close(over_time[place], quotient);
            close(over_input[place] * rate, quotient);
        }
        unit.free_state(state);
    }
}

#[test]
fn a_seed_that_is_no_finite_number_is_refused() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    unit.drive(FORCE, 300.0, 0.0, 0.1);
    for (seed, came) in [
        (f64::NAN, "NaN"),
        (f64::INFINITY, "inf"),
        (f64::NEG_INFINITY, "-inf"),
    ] {
        let (knowns, seeds, mut slope) = ([FORCE; 2], [1.0, seed], 7.0);
        let status = unsafe {
            let (knowns, seeds) = (knowns.as_ptr(), seeds.as_ptr());
            fmi2GetDirectionalDerivative(
                unit.handle,
                &DISPLACEMENT,
                1,
                knowns,
                2,
                seeds,
                &mut slope,
            )
        };
        let told = unit.error(status);
        let expected = format!("dvKnown[1]: expected a finite number, came {came}");
        assert!(told.contains(&expected), "{told}");
        assert_eq!(slope, 7.0, "written only on success");
    }
}
