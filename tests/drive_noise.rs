//! What the driving channel's own noise does to a model is no cause: the joint felt nothing of it.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

const CYCLE: usize = 90;

/// Sixty sliders under cycles of displacement that grow, which are read with noise that the stiffest answer would make
/// 0.7 N, and a force with noise of 3 N whose neighbours correlate by 0.9.
fn record(seed: u64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let count = 24 * CYCLE;
    let mut reached = [0.0_f64; 60];
    let (mut before, mut slow) = (0.0, 0.0);
    let (mut force, mut displacement) = (Vec::new(), Vec::new());
    for i in 0..count {
        let level = 1e-6 * (2 + 2 * (i / CYCLE / 6)) as f64;
        let u = level * (TAU * i as f64 / CYCLE as f64).sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 1e-7 * (j + 1) as f64;
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        slow = 0.9 * slow + 3.0 * (1.0_f64 - 0.81).sqrt() * noise();
        force.push(2e6 * reached.iter().sum::<f64>() + slow);
        displacement.push(u + 6e-9 * noise());
    }
    Record {
        name: "noisy".to_string(),
        time: Some((0..count).map(|i| 0.01 * i as f64).collect()),
        force,
        displacement,
        ..Record::default()
    }
}

/// Seeds of the noise; printed with every failure.
const SEEDS: std::ops::Range<u64> = 20_261_124..20_261_130;

#[test]
fn a_clean_joint_is_clean_whatever_noise_its_drive_has() {
    for seed in SEEDS {
        let findings = diagnose(&[record(seed)], |_| ()).unwrap();
        let named: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(
            findings.verdict,
            Verdict::Clean,
            "seed {seed}: {named:?}, {:?}",
            findings.notes
        );
        assert!(findings.notes.iter().any(|n| n.contains("was smoothed")));
    }
}
