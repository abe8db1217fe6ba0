//! Two causes at once, of which one hid what the other is.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::{Findings, Verdict};
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

const STEPS: u32 = 4000;

const CYCLES: f64 = 40.0;

/// Length of a step \[s\]: no whole number of them in a period of the mains.
const STEP: f64 = 0.0041;

/// Largest displacement \[m\].
const LARGEST: f64 = 4e-6;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261124;

/// Coefficient of the dashpot \[N s/m\] and amplitude of the hum \[m\].
const DASHPOT: f64 = 5e4;
const HUM: f64 = 2e-8;

/// Sixty sliders beside a dashpot under a displacement that is prescribed, with noise in the force; its sensor reads
/// the mains as well.
fn record() -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let mut stretched = [0.0_f64; 60];
    let mut before = 0.0;
    let (mut time, mut force, mut displacement) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..STEPS {
        let share = f64::from(i) / f64::from(STEPS);
        let t = STEP * f64::from(i);
        // Level and rate go up and down, smoothly.
        let (level, level_by_share) = (
            LARGEST * (0.6 - 0.4 * (3.0 * TAU * share).cos()),
            LARGEST * 0.4 * 3.0 * TAU * (3.0 * TAU * share).sin(),
        );
        let phase = TAU * (CYCLES * share + 0.1 * CYCLES * (TAU * share).sin());
        let phase_by_share = TAU * CYCLES * (1.0 + 0.1 * TAU * (TAU * share).cos());
        let u = level * phase.sin();
        let by_share = level_by_share * phase.sin() + level * phase.cos() * phase_by_share;
        let velocity = by_share / (STEP * f64::from(STEPS));
        for (j, d) in stretched.iter_mut().enumerate() {
            let most = 1e-7 * (j + 1) as f64;
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        let joint = 2e6 * stretched.iter().sum::<f64>();
        time.push(t);
        force.push(joint + DASHPOT * velocity + 0.3 * noise());
        displacement.push(u + HUM * (TAU * 50.0 * t).sin());
    }
    Record {
        name: "two".to_string(),
        time: Some(time),
        force,
        displacement,
        ..Record::default()
    }
}

/// Names in the order of the alphabet.
fn named(findings: &Findings) -> Vec<&str> {
    let mut names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
    names.sort_unstable();
    names
}

#[test]
fn a_dashpot_is_no_late_sensor_where_hum_lies_on_the_displacement() {
    let findings = diagnose(&[record()], |_| ()).unwrap();
    let names = named(&findings);
    assert_eq!(names, ["mains_hum", "viscous_damping"], "seed {SEED}");
    assert_eq!(findings.verdict, Verdict::Explained, "seed {SEED}");
    let found = findings.causes.iter().find(|c| c.name == names[1]);
    let coefficient = found.unwrap().parameters[0].value;
    let off = coefficient / DASHPOT - 1.0;
    assert!(off.abs() < 0.03, "seed {SEED}: {coefficient}");
}
