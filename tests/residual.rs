//! The residual views on residuals built to have one sign each.

use iwan::record::Record;
use iwan::residual::{
    Judged, Residual, energy_per_cycle, even_share, harmonics, over_amplitude, over_cycles,
    over_displacement, over_phase, over_time, over_velocity, trend,
};
use std::f64::consts::{PI, TAU};

const PER_CYCLE: usize = 200;
const CYCLES: usize = 12;
const STEP: f64 = 0.005;

/// Begins before a trough and ends behind one, so that all cuts lie between whole halves, and half a
/// sample beside zero, so that rounding does not move them.
fn angle(i: usize) -> f64 {
    TAU * ((i as f64 + 0.5) / PER_CYCLE as f64 - 0.3)
}

/// A sine of force with a linear displacement, and a prediction wrong by `error(i)`.
fn with_error(level: impl Fn(usize) -> f64, error: impl Fn(usize) -> f64) -> (Record, Vec<f64>) {
    let count = PER_CYCLE * CYCLES + PER_CYCLE / 10;
    let force: Vec<f64> = (0..count).map(|i| level(i) * angle(i).sin()).collect();
    let predicted: Vec<f64> = force.iter().map(|f| 1e-8 * f).collect();
    let displacement = predicted
        .iter()
        .enumerate()
        .map(|(i, p)| p + error(i))
        .collect();
    let record = Record {
        name: "built".into(),
        time: Some((0..count).map(|i| STEP * i as f64).collect()),
        force,
        displacement,
        ..Record::default()
    };
    (record, predicted)
}

fn residual<'a>(record: &'a Record, predicted: &'a [f64]) -> Residual<'a> {
    Residual::new(record, Judged::Displacement, predicted).expect("same length")
}

fn steady(_: usize) -> f64 {
    100.0
}

#[test]
fn a_prediction_of_another_length_is_refused() {
    let (record, predicted) = with_error(steady, |_| 0.0);
    let error = Residual::new(&record, Judged::Force, &predicted[1..]).expect_err("shorter");
    assert_eq!(
        (error.samples, error.predicted),
        (record.len(), record.len() - 1)
    );
}

#[test]
fn a_drift_is_seen_over_time_and_over_cycles() {
    let (record, predicted) = with_error(steady, |i| 2e-9 * STEP * i as f64);
    let view = residual(&record, &predicted);
    let line = trend(&view).expect("long enough");
    assert!((line.slope / 2e-9 - 1.0).abs() < 1e-9);
    let bins = over_time(&view, 10);
    assert_eq!(bins.iter().map(|b| b.count).sum::<usize>(), record.len());
    let length = STEP * (record.len() - 1) as f64;
    let last = bins.last().expect("ten");
    // The mean of the last tenth lies at 0.95 of the length, to within a sample.
    assert!((last.mean / (2e-9 * 0.95 * length) - 1.0).abs() < 1e-3);
    let rows = over_cycles(&view);
    let per_cycle = 2e-9 * STEP * PER_CYCLE as f64;
    for pair in rows.windows(2) {
        assert!(((pair[1].mean - pair[0].mean) / per_cycle - 1.0).abs() < 1e-6);
    }
}

#[test]
fn even_harmonics_come_from_asymmetry_only() {
    let symmetric = with_error(steady, |i| 1e-10 * angle(i).sin().powi(3));
    let one_sided = with_error(steady, |i| 1e-10 * angle(i).sin().max(0.0));
    let share =
        |built: &(Record, Vec<f64>)| even_share(&harmonics(&residual(&built.0, &built.1), 8));
    // Whole cycles: rounding only.
    assert!(share(&symmetric) < 1e-20);
    // max(0, sin): amplitudes 1/2 and 2/(π(n²−1)) for even n.
    let even: f64 = [2, 4, 6, 8]
        .iter()
        .map(|&n| (2.0 / (PI * f64::from(n * n - 1))).powi(2))
        .sum();
    let expected = even / (even + 0.25);
    assert!((share(&one_sided) / expected - 1.0).abs() < 1e-3);
}

#[test]
fn harmonics_keep_their_phase_to_the_force() {
    // From the force's peak, x − π/2 = y: sin x = cos y in phase, −cos x = sin y in quadrature.
    let (record, predicted) =
        with_error(steady, |i| 3e-10 * angle(i).sin() - 4e-10 * angle(i).cos());
    let found = harmonics(&residual(&record, &predicted), 3);
    assert!((found[0].in_phase / 3e-10 - 1.0).abs() < 1e-9);
    assert!((found[0].quadrature / 4e-10 - 1.0).abs() < 1e-9);
    assert!(found[1].amplitude() < 1e-16 && found[2].amplitude() < 1e-16);
    assert!(found[0].cycles >= CYCLES - 2);
}

#[test]
fn a_friction_error_changes_sign_with_direction_and_an_elastic_one_does_not() {
    let friction = with_error(steady, |i| 1e-9 * angle(i).cos().signum());
    let view = residual(&friction.0, &friction.1);
    let sides = over_displacement(&view, 8);
    assert!(sides.rising.iter().filter(|b| b.mean > 0.9e-9).count() >= 6);
    assert!(sides.falling.iter().filter(|b| b.mean < -0.9e-9).count() >= 6);
    let elastic = with_error(steady, |i| 1e-9 * angle(i).sin().powi(3));
    let view = residual(&elastic.0, &elastic.1);
    let sides = over_displacement(&view, 8);
    for (up, down) in sides.rising.iter().zip(&sides.falling) {
        assert!((up.mean - down.mean).abs() < 0.03e-9);
    }
}

#[test]
fn a_viscous_error_is_a_straight_line_over_velocity() {
    let (record, predicted) = with_error(steady, |i| 1e-9 * angle(i).cos());
    let view = residual(&record, &predicted);
    let bins = over_velocity(&view, 2, 9);
    assert_eq!(bins.len(), 9);
    for pair in bins.windows(2) {
        assert!(pair[1].mean > pair[0].mean + 1e-10);
    }
    assert!(bins[4].mean.abs() < 1e-11);
}

#[test]
fn levels_are_told_apart_by_amplitude() {
    // The level changes at a cut.
    let level = |i: usize| {
        if angle(i) < TAU * (CYCLES / 2) as f64 {
            50.0
        } else {
            100.0
        }
    };
    let (record, predicted) = with_error(level, |i| 1e-13 * (level(i) * angle(i).sin()).powi(2));
    let rows = over_amplitude(&residual(&record, &predicted));
    let low = rows.first().expect("two levels");
    let high = rows.last().expect("two levels");
    assert!((low.force_amplitude - 50.0).abs() < 0.1 && (high.force_amplitude - 100.0).abs() < 0.1);
    // The square of the force: four times the residual at twice the load.
    assert!((high.rms / low.rms - 4.0).abs() < 0.01);
}

#[test]
fn the_phase_of_the_cycle_shows_where_the_error_sits() {
    let (record, predicted) = with_error(steady, |i| {
        if angle(i).rem_euclid(TAU) < PI / 2.0 {
            1e-9
        } else {
            0.0
        }
    });
    let bins = over_phase(&residual(&record, &predicted), 4);
    assert!(bins[0].mean > 0.9e-9);
    assert!(bins[1..].iter().all(|b| b.mean < 0.1e-9));
}

#[test]
fn energy_per_cycle_is_the_area_of_the_loop() {
    // Displacement lags the force: π F_0 a, the prediction is elastic and loses nothing.
    let (record, predicted) = with_error(steady, |i| -2e-9 * angle(i).cos());
    let rows = energy_per_cycle(&residual(&record, &predicted));
    assert!(rows.len() >= CYCLES - 2);
    let area = PI * 100.0 * 2e-9;
    for row in rows.iter().filter(|r| r.steady) {
        // Polygon of 200 corners: 2π²/3/200² = 1.6e-4 below the ellipse.
        assert!((row.measured / area - 1.0).abs() < 2e-4);
        assert!(row.predicted.abs() < 1e-6 * area);
        assert!((row.relative_error() - 1.0).abs() < 1e-6);
    }
}
