//! Records that begin in the middle of a test, or whose zero is off, are no joints with a cause.

mod plays;

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

const CYCLE: usize = 80;

/// Sixty sliders under a stepped sine of displacement with noise in the force: 22 cycles, of which the record
/// keeps those from sample `from` on, reading `zero` too much.
fn record(seed: u64, from: usize, zero: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let levels = [1e-6, 2e-6, 4e-6, 3e-6];
    let mut reached = [0.0_f64; 60];
    let mut before = 0.0;
    let (mut force, mut displacement) = (Vec::new(), Vec::new());
    for i in 0..22 * CYCLE {
        let level = levels[(i / CYCLE / 6).min(3)];
        let u = level * (TAU * i as f64 / CYCLE as f64).sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 1e-7 * (j + 1) as f64;
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        if i >= from {
            force.push(2e6 * reached.iter().sum::<f64>() + 0.3 * noise());
            displacement.push(u + zero);
        }
    }
    plays::record("cut", force, displacement)
}

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261122;

#[test]
fn a_clean_joint_is_clean_wherever_its_record_begins() {
    // Behind a peak of the second level, behind a valley of the third; and a zero that is off by a quarter.
    for (from, zero, said) in [
        (6 * CYCLE + 120, 0.0, "in the middle of a test"),
        (12 * CYCLE + 145, 0.0, "in the middle of a test"),
        (0, 1e-6, "zero of its sensor"),
    ] {
        let findings = diagnose(&[record(SEED, from, zero)], |_| ()).unwrap();
        let place = format!("seed {SEED}, from {from}, zero {zero}");
        assert_eq!(findings.verdict, Verdict::Clean, "{place}: {findings:?}");
        let noted = findings.notes.iter().any(|note| note.contains(said));
        assert!(noted, "{place}: {:?}", findings.notes);
    }
}

#[test]
fn a_joint_from_rest_is_taken_for_what_it_is() {
    let findings = diagnose(&[record(SEED, 0, 0.0)], |_| ()).unwrap();
    assert_eq!(findings.verdict, Verdict::Clean);
    let begins = |note: &&String| note.contains("begins");
    assert_eq!(findings.notes.iter().find(begins), None);
}

/// Forty plays in series under cycles of force that grow, with noise in the displacement, which drifts by `drift`; the
/// record is kept from sample `from` on.
fn drifting(from: usize, drift: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let count = 24 * CYCLE;
    let passed = |i: usize| i as f64 / count as f64;
    let bears = |i: usize| (350.0 + 150.0 * passed(i)) * (TAU * i as f64 / CYCLE as f64).sin();
    let mut force: Vec<f64> = (0..count).map(bears).collect();
    let truth = plays::displacement(&force).into_iter();
    let reads = |(i, u): (usize, f64)| u + drift * passed(i) + 2e-8 * noise();
    let displacement = truth.enumerate().skip(from).map(reads).collect();
    force.drain(..from);
    plays::record("cut", force, displacement)
}

#[test]
fn turns_before_a_record_are_found_whatever_drifts() {
    for (from, drift) in [(3 * CYCLE + 36, 2e-6), (3 * CYCLE + 36, -4e-6)] {
        let findings = diagnose(&[drifting(from, drift)], |_| ()).unwrap();
        let named: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        let place = format!("seed {SEED}, from {from}, drift {drift}");
        assert_eq!(
            named,
            ["displacement_drift"],
            "{place}: {:?}",
            findings.notes
        );
    }
}

/// Forty plays in series through three tests one after the other, each from zero force to zero force; each but the
/// first is as the one before left it, or new; behind loads of which no record tells.
fn tests_in_order(loads: &[f64], go_on: [bool; 2]) -> Vec<Record> {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let levels = [
        [150.0, 300.0, 500.0],
        [250.0, 500.0, 350.0],
        [500.0, 250.0, 400.0],
    ];
    let mut before = loads.to_vec();
    let mut records = Vec::new();
    for (k, levels) in levels.into_iter().enumerate() {
        let bears = |i: usize| {
            let level: f64 = levels[(i / CYCLE / 4).min(2)];
            level * (TAU * i as f64 / CYCLE as f64).sin()
        };
        let force: Vec<f64> = (0..=12 * CYCLE).map(bears).collect();
        if k > 0 && !go_on[k - 1] {
            before = loads.to_vec();
        }
        before.extend_from_slice(&force);
        let truth = plays::displacement(&before);
        let read = truth[before.len() - force.len()..].iter();
        let displacement = read.map(|u| u + 2e-8 * noise()).collect();
        records.push(plays::record(&format!("test-{k}"), force, displacement));
    }
    records
}

#[test]
fn joints_that_go_on_from_test_to_test_or_are_new_are_clean() {
    for go_on in [[true, true], [true, false], [false, true], [false, false]] {
        let findings = diagnose(&tests_in_order(&[], go_on), |_| ()).unwrap();
        let place = format!("seed {SEED}, go on: {go_on:?}");
        assert_eq!(findings.verdict, Verdict::Clean, "{place}: {findings:?}");
        let noted = [1, 2].map(|k| {
            let said = format!("test-{k}: the joint goes on where the record before left it");
            findings.notes.iter().any(|note| note.contains(&said))
        });
        assert_eq!(noted, go_on, "{place}: {:?}", findings.notes);
        // Nothing of them wears.
        let worn = findings.notes.iter().any(|n| n.contains("Wear goes on"));
        assert!(!worn, "{place}: {:?}", findings.notes);
    }
}

/// A pull or a push at the assembly of which no record tells.
#[test]
fn joints_that_were_loaded_before_their_tests_are_clean() {
    for (loads, go_on) in [(&[420.0, 0.0][..], true), (&[-560.0, 0.0], false)] {
        let findings = diagnose(&tests_in_order(loads, [go_on; 2]), |_| ()).unwrap();
        let place = format!("seed {SEED}, loads {loads:?}, go on: {go_on}");
        assert_eq!(findings.verdict, Verdict::Clean, "{place}: {findings:?}");
        let said =
            "test-0 begins in the middle of a test, or behind a load of which no record tells";
        let noted = findings.notes.iter().any(|note| note.contains(said));
        assert!(noted, "{place}: {:?}", findings.notes);
    }
}
