//! Table 1 of the report: `F = ½ (sin t + ½ sin 6t)` on two joints of the same ϑ.

use super::histories::Random;
use iwan::joint::{Density, ExactResponse, PowerLaw};
use std::f64::consts::TAU;

/// Dissipation \[J\] of (case 1, case 2), exact: virgin over t = 0 … 2π, and per 2π once steady.
const VIRGIN: [f64; 2] = [2.290084423596e-10, 2.290086727746e-10];
const STEADY: [f64; 2] = [2.784083274606e-10, 2.784086213165e-10];
/// What the report prints.
const PRINTED: [f64; 2] = [2.74149e-10, 2.74159e-10];
/// ρ_0, k, K_T.
const CASES: [[f64; 3]; 2] = [[4.0, 0.5, 1000.0], [2.0, 2.0, 2000.0]];

fn joint([coefficient, slider_stiffness, stiffness]: [f64; 3]) -> PowerLaw {
    PowerLaw::new(coefficient, 0.0, slider_stiffness, f64::INFINITY, stiffness).unwrap()
}

fn load(t: f64) -> f64 {
    0.5 * (t.sin() + 0.5 * (6.0 * t).sin())
}

/// Turning values in one period: roots of F' by bisection to the last bit.
fn turning_values() -> Vec<f64> {
    let rate = |t: f64| 0.5 * (t.cos() + 3.0 * (6.0 * t).cos());
    let grid: Vec<f64> = (0..=600).map(|i| TAU * i as f64 / 600.0).collect();
    let mut values = Vec::new();
    for pair in grid.windows(2) {
        let (mut low, mut high) = (pair[0], pair[1]);
        if rate(low) * rate(high) > 0.0 {
            continue;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if rate(low) * rate(middle) <= 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        values.push(load(0.5 * (low + high)));
    }
    values
}

/// Dissipation after each of `periods` periods, driven by turning values alone.
fn by_turning_values(case: [f64; 3], periods: usize) -> Vec<f64> {
    let mut response = ExactResponse::new(Density::PowerLaw(joint(case)));
    let turnings = turning_values();
    (0..periods)
        .map(|_| {
            for &force in turnings.iter().chain(&[0.0]) {
                response.drive_force(force).unwrap();
            }
            response.dissipation()
        })
        .collect()
}

#[test]
fn turning_values_are_those_of_the_load() {
    let found = turning_values();
    // Printed to six decimals.
    let expected = [0.392281, 0.096291, 0.733846, 0.231979, 0.610260, -0.133847];
    assert_eq!(found.len(), 12);
    for (value, wanted) in found.iter().zip(expected) {
        assert!((value - wanted).abs() < 5.1e-7, "{value} for {wanted}");
    }
    // The second half period mirrors the first backwards.
    for (value, mirrored) in found.iter().zip(found.iter().rev()) {
        assert!((value + mirrored).abs() < 1e-14);
    }
    let largest = found.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    assert!(
        (largest - 0.7338463233).abs() < 1e-10,
        "F_max = 1 in the table is a bound"
    );
}

#[test]
fn both_cases_have_the_coefficient_of_the_table() {
    for case in CASES {
        let small = joint(case).small_force();
        assert!((small.coefficient - 6.66667e-10).abs() < 5e-16, "{small:?}");
        assert_eq!(small.exponent, 0.0);
    }
}

#[test]
fn dissipation_from_virgin_and_steady() {
    for (i, case) in CASES.into_iter().enumerate() {
        let energy = by_turning_values(case, 4);
        let virgin = energy[0];
        assert!((virgin / VIRGIN[i] - 1.0).abs() < 1e-9, "virgin {virgin:e}");
        for pair in energy.windows(2) {
            let steady = pair[1] - pair[0];
            assert!((steady / STEADY[i] - 1.0).abs() < 1e-9, "steady {steady:e}");
        }
    }
}

/// The answer depends on turning values only: whatever lies between them changes nothing.
#[test]
fn samples_between_the_turning_values_change_nothing() {
    let mut random = Random(5);
    let turnings = turning_values();
    let mut response = ExactResponse::new(joint_density(CASES[0]));
    let mut from = 0.0;
    for &to in turnings.iter().chain(&[0.0]) {
        let mut places: Vec<f64> = (0..50).map(|_| random.uniform()).collect();
        places.sort_by(f64::total_cmp);
        for place in places {
            response.drive_force(from + (to - from) * place).unwrap();
        }
        response.drive_force(to).unwrap();
        from = to;
    }
    let exact = by_turning_values(CASES[0], 1)[0];
    assert!((response.dissipation() / exact - 1.0).abs() < 1e-12);
}

/// Why the printed values differ: they lie 1.53 % below the steady ones in both cases alike, and
/// their gap between the cases is some 35 times the true one. An error common to both cases and
/// larger than what separates them is one of the time integration, not of the joint: sampling
/// that misses the peaks loses energy in this measure, and the exact response driven by as coarse a
/// record of the load loses it too.
#[test]
fn printed_values_are_low_by_their_integration() {
    let steady: Vec<f64> = CASES
        .into_iter()
        .map(|case| by_turning_values(case, 2))
        .map(|energy| energy[1] - energy[0])
        .collect();
    for (printed, exact) in PRINTED.iter().zip(&steady) {
        let short = 1.0 - printed / exact;
        assert!((short - 0.0153).abs() < 1e-4, "printed is short by {short}");
    }
    let gap = |pair: &[f64]| pair[1] / pair[0] - 1.0;
    let ratio = gap(&PRINTED) / gap(&steady);
    assert!((gap(&steady) - 1.06e-6).abs() < 1e-8, "{:e}", gap(&steady));
    assert!((33.0..37.0).contains(&ratio), "gap ratio {ratio}");

    let sampled = |count: usize| {
        let mut response = ExactResponse::new(joint_density(CASES[0]));
        let mut energy = [0.0; 2];
        for after in &mut energy {
            for i in 1..=count {
                response
                    .drive_force(load(TAU * i as f64 / count as f64))
                    .unwrap();
            }
            *after = response.dissipation();
        }
        1.0 - (energy[1] - energy[0]) / steady[0]
    };
    // Some ten samples on each of the six fast cycles are as short as the print; the load well
    // resolved is not.
    assert!(sampled(60) > 0.0153 && sampled(80) < 0.0153);
    assert!(sampled(2000).abs() < 1e-4, "{}", sampled(2000));
}

fn joint_density(case: [f64; 3]) -> Density {
    Density::PowerLaw(joint(case))
}
