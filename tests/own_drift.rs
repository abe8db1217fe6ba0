//! Tests of one joint whose sensors drift each at a rate of its own.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261127;

/// Forty sliders in parallel with a spring under steps of a sine of so many hertz, driven in force by their own answer; the
/// displacement is read with noise of 20 nm and moves off by so many metres until the end.
fn test(name: &str, (rate, drifted): (f64, f64), random: &mut ChaCha8Rng) -> Record {
    let mut reached = [0.0_f64; 40];
    let mut before = 0.0;
    let mut record = Record {
        name: name.to_string(),
        time: Some(Vec::new()),
        ..Record::default()
    };
    let samples = 1600;
    for i in 0..samples {
        let level = [0.4, 0.7, 1.0, 0.6][4 * i / samples];
        let u = 8e-6 * level * (TAU * i as f64 / 80.0).sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 3e-7 * (j + 1) as f64;
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        let noise = (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        record
            .time
            .iter_mut()
            .for_each(|t| t.push(i as f64 / 80.0 / rate));
        record
            .force
            .push(3e6 * reached.iter().sum::<f64>() + 4e7 * u);
        let drift = drifted * i as f64 / samples as f64;
        record.displacement.push(u + drift + 2e-8 * noise);
    }
    record
}

/// As far in tests of other lengths, and there and back.
#[test]
fn every_test_drifts_at_its_own_rate() {
    for drifts in [[4e-7, 4e-7], [4e-7, -3e-7]] {
        let mut random = ChaCha8Rng::seed_from_u64(SEED);
        let records = [(2.0, drifts[0]), (15.0, drifts[1])]
            .map(|of| test(&format!("at-{}-Hz", of.0), of, &mut random));
        let findings = diagnose(&records, |_| ()).unwrap();
        let place = format!("seed {SEED}, {drifts:?}: {findings:?}");
        let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["displacement_drift"], "{place}");
        assert_eq!(findings.verdict, Verdict::Explained, "{place}");
        let value = |name: &str| {
            let all = &findings.causes[0].parameters;
            all.iter().find(|p| p.name == name).map_or(0.0, |p| p.value)
        };
        // Lengths of 10 s and 4/3 s.
        let ends = [
            value("rate") * 10.0,
            (value("rate") + value("second_test")) * 4.0 / 3.0,
        ];
        for (found, planted) in ends.iter().zip(drifts) {
            assert!(
                (found - planted).abs() < 2e-8,
                "{found} for {planted}: {place}"
            );
        }
    }
}
