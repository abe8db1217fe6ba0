//! Tests of one joint whose sensors drift each at a rate of its own.

mod sliders;

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use sliders::test;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261127;

/// As far in tests of other lengths, and there and back.
#[test]
fn every_test_drifts_at_its_own_rate() {
    for drifts in [[4e-7, 4e-7], [4e-7, -3e-7]] {
        let mut random = ChaCha8Rng::seed_from_u64(SEED);
        let records = [(2.0, drifts[0]), (15.0, drifts[1])]
            .map(|(rate, drifted)| test(rate, (0.0, 0.0), drifted, &mut random));
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
