//! What happens in the last cycles, which the fit does not see at first, has its cause looked for as well.

mod plays;

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261127;

const CYCLE: usize = 80;
const CYCLES: usize = 24;

/// Deviation of the noise \[m\].
const NOISE: f64 = 2e-8;

/// Forty plays in series under cycles of force of three levels; the sensor slips by `jump` a cycle before the end.
fn record(jump: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let count = CYCLES * CYCLE;
    let bears =
        |i: usize| [300.0, 500.0, 400.0][3 * i / count] * (TAU * i as f64 / CYCLE as f64).sin();
    let force: Vec<f64> = (0..count).map(bears).collect();
    let reads = |(i, u): (usize, f64)| {
        let slipped = if i > count - CYCLE { jump } else { 0.0 };
        u + slipped + NOISE * noise()
    };
    let truth = plays::displacement(&force).into_iter();
    let displacement = truth.enumerate().map(reads).collect();
    Record {
        name: "late".to_string(),
        time: Some((0..count).map(|i| 0.01 * i as f64).collect()),
        force,
        displacement,
        ..Record::default()
    }
}

#[test]
fn a_sensor_that_slips_in_the_last_cycle_is_found() {
    let noted = |notes: &[String]| notes.iter().any(|note| note.contains("The last cycles"));
    let still = diagnose(&[record(0.0)], |_| ()).unwrap();
    assert_eq!(still.verdict, Verdict::Clean, "seed {SEED}");
    assert!(!noted(&still.notes), "seed {SEED}");
    for jump in [5.0 * NOISE, -20.0 * NOISE] {
        let findings = diagnose(&[record(jump)], |_| ()).unwrap();
        let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["offset_step"], "seed {SEED}, {jump}");
        assert_eq!(findings.verdict, Verdict::Explained, "seed {SEED}, {jump}");
        let height = findings.causes[0].parameters[0].value;
        assert!(
            (height / jump - 1.0).abs() < 0.1,
            "seed {SEED}: {height} for {jump}"
        );
        assert!(noted(&findings.notes), "seed {SEED}, {jump}");
    }
}
