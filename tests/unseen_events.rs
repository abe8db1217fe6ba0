//! What happens in cycles that the fit does not see at first, the last ones or a level before them, has its cause looked for
//! as well, and its gain measured on others.

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

/// Forty plays in series under cycles of force of three levels; the sensor slips by `jump` at a sample.
fn record_with(jump: f64, slips: usize) -> Record {
    drawn(SEED, jump, slips)
}

fn drawn(seed: u64, jump: f64, slips: usize) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let count = CYCLES * CYCLE;
    let bears =
        |i: usize| [300.0, 500.0, 400.0][3 * i / count] * (TAU * i as f64 / CYCLE as f64).sin();
    let force: Vec<f64> = (0..count).map(bears).collect();
    let reads = |(i, u): (usize, f64)| {
        let slipped = if i > slips { jump } else { 0.0 };
        u + slipped + NOISE * noise()
    };
    let truth = plays::displacement(&force).into_iter();
    let displacement = truth.enumerate().map(reads).collect();
    plays::record("late", force, displacement)
}

/// The same, a cycle before the end.
fn record(jump: f64) -> Record {
    record_with(jump, (CYCLES - 1) * CYCLE)
}

#[test]
fn a_sensor_that_slips_within_the_level_set_aside_is_placed() {
    // The second level begins with those that are set aside as a rule.
    let slips = 9 * CYCLE + CYCLE / 3;
    let findings = diagnose(&[record_with(6.0 * NOISE, slips)], |_| ()).unwrap();
    let [stretches] = &findings.held_out[..] else {
        panic!("seed {SEED}: one record");
    };
    let at = 0.01 * slips as f64;
    assert!(
        stretches.iter().all(|(from, to)| at < *from || *to < at),
        "seed {SEED}: {stretches:?}"
    );
    let summary = &findings.summary;
    assert_eq!(
        findings.verdict,
        Verdict::Explained,
        "seed {SEED}: {summary} {:?} {:?}",
        findings.unexplained,
        findings.gain
    );
    assert_eq!(findings.causes[0].name, "offset_step", "seed {SEED}");
    let (ratio, interval) = findings.gain;
    let (_, upper) = interval.expect("cycles enough");
    assert!(ratio < upper && upper < 1.0, "seed {SEED}: {ratio} {upper}");
    let noted = |note: &String| note.contains("within the cycles that are set aside as a rule");
    assert!(findings.notes.iter().any(noted), "seed {SEED}");
}

/// Whatever the noise is taken for: its variance is known to its scatter only.
#[test]
fn a_sensor_that_slips_far_within_the_level_set_aside_is_explained() {
    for seed in SEED..SEED + 4 {
        let slips = 9 * CYCLE + CYCLE / 3 + 7 * (seed - SEED) as usize;
        let findings = diagnose(&[drawn(seed, 36.0 * NOISE, slips)], |_| ()).unwrap();
        let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["offset_step"], "seed {seed}");
        let summary = &findings.summary;
        assert_eq!(
            findings.verdict,
            Verdict::Explained,
            "seed {seed}: {summary}"
        );
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
