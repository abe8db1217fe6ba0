//! Tests of joints that were made alike and are not quite the same are explained by no cause.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::{Findings, Verdict};
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261127;

/// Rate of each test \[Hz\].
const RATES: [f64; 3] = [2.0, 15.0, 2.0];

/// Forty sliders beside a spring under steps of a sine, one test, so much stiffer and so much more firmly held than the first
/// test's; the displacement is read with noise of 20 nm and moves off by so many metres until the end.
fn test(rate: f64, (stiffer, firmer): (f64, f64), drifted: f64, random: &mut ChaCha8Rng) -> Record {
    let mut reached = [0.0_f64; 40];
    let mut before = 0.0;
    let samples = 1600;
    let mut record = Record {
        name: format!("at-{rate}-Hz"),
        time: Some((0..samples).map(|i| i as f64 / 80.0 / rate).collect()),
        ..Record::default()
    };
    for i in 0..samples {
        let level = [0.4, 0.7, 1.0, 0.6][4 * i / samples];
        let u = 8e-6 * level * (TAU * i as f64 / 80.0).sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 3e-7 * (j + 1) as f64 * (1.0 + firmer) / (1.0 + stiffer);
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        let noise = (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        let of_one = 3e6 * reached.iter().sum::<f64>() + 4e7 * u;
        record.force.push((1.0 + stiffer) * of_one);
        let drift = drifted * i as f64 / samples as f64;
        record.displacement.push(u + drift + 2e-8 * noise);
    }
    record
}

/// What is said of tests of joints that differ by so much, whose sensor drifts as far in each, with the names of the causes.
fn said(joints: [(f64, f64); 3], drifted: f64) -> (Findings, Vec<String>, String) {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let both = RATES.into_iter().zip(joints);
    let records: Vec<Record> = both
        .map(|(rate, joint)| test(rate, joint, drifted, &mut random))
        .collect();
    let findings = diagnose(&records, |_| ()).unwrap();
    let names = findings.causes.iter().map(|c| c.name.clone()).collect();
    let doubles = findings.unexplained.doubles.join("; ");
    (findings, names, doubles)
}

const DIFFER: [(f64, f64); 3] = [(0.0, 0.0), (0.015, 0.005), (-0.01, 0.008)];

#[test]
fn joints_that_differ_are_told_and_no_cause_is_blamed() {
    let (findings, names, doubles) = said(DIFFER, 0.0);
    let place = format!("seed {SEED}: {findings:?}");
    assert_eq!(names, [""; 0], "{place}");
    assert_eq!(findings.verdict, Verdict::Unexplained, "{place}");
    assert!(doubles.contains("another joint in every test"), "{place}");
    let told = |name: &str| -> f64 {
        let (_, behind) = doubles.split_once(name).expect(name);
        let number = behind.trim().split([',', ')']).next().unwrap();
        number.parse().expect(number)
    };
    let parts = ["second", "third"].into_iter().zip(&DIFFER[1..]);
    for (test, (stiffer, firmer)) in parts {
        let force = told(&format!("{test}_force"));
        let further = told(&format!("{test}_displacement"));
        // Noise of 0.3 % in each of 1600 samples tells a scale to 0.03 %, and the two scales of one test apart ten times worse.
        assert!((force - firmer).abs() < 3e-3, "{force}: {place}");
        let expected = (1.0 + firmer) / (1.0 + stiffer) - 1.0;
        assert!((further - expected).abs() < 3e-3, "{further}: {place}");
    }
}

#[test]
fn a_cause_beside_joints_that_differ_is_named_alone() {
    let (findings, names, doubles) = said(DIFFER, 4e-7);
    let place = format!("seed {SEED}: {findings:?}");
    assert_eq!(names, ["displacement_drift"], "{place}");
    assert_eq!(findings.verdict, Verdict::PartlyExplained, "{place}");
    assert!(
        doubles.contains("beside them: another joint in every test"),
        "{place}"
    );
}

#[test]
fn joints_that_are_the_same_are_clean() {
    let (findings, names, doubles) = said([(0.0, 0.0); 3], 0.0);
    assert_eq!(findings.verdict, Verdict::Clean, "seed {SEED}");
    assert_eq!((names.len(), doubles.as_str()), (0, ""), "seed {SEED}");
}
