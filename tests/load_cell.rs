//! A fault of the load cell is found where the force drives, too: the model is then driven by a wrong reading.

mod plays;

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::{Findings, Verdict};
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

const PER_CYCLE: usize = 90;

/// Largest force \[N\].
const LARGEST: f64 = 500.0;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261123;

/// Forty plays in series under twenty cycles of stepped sine, with noise in the displacement; `read` is the cell.
fn record(read: impl Fn(usize, f64) -> f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let bears = |i: usize| {
        let level = [0.4, 0.7, 1.0, 0.8, 0.5][i / PER_CYCLE / 4];
        LARGEST * level * (TAU * i as f64 / PER_CYCLE as f64).sin()
    };
    let truth: Vec<f64> = (0..20 * PER_CYCLE).map(bears).collect();
    let displacement = plays::displacement(&truth).into_iter();
    let displacement = displacement.map(|u| u + 2e-8 * noise()).collect();
    let cell = truth.iter().enumerate();
    let force: Vec<f64> = cell.map(|(i, &bears)| read(i, bears)).collect();
    plays::record("by_force", force, displacement)
}

fn named(findings: &Findings) -> Vec<&str> {
    findings.causes.iter().map(|c| c.name.as_str()).collect()
}

#[test]
fn a_cell_that_reads_right_is_none() {
    let findings = diagnose(&[record(|_, force| force)], |_| ()).unwrap();
    assert_eq!(findings.verdict, Verdict::Clean, "{findings:?}");
}

#[test]
fn a_cell_that_bends_is_no_joint_that_opens() {
    let bent = |_, force: f64| force + 0.02 * force * force / LARGEST;
    let findings = diagnose(&[record(bent)], |_| ()).unwrap();
    assert_eq!(named(&findings), ["sensor_nonlinearity"], "seed {SEED}");
    assert_eq!(findings.verdict, Verdict::Explained);
}

#[test]
fn a_cell_behind_a_high_pass_is_no_creep() {
    // Of a corner at a hundredth of the load's rate; what it loses is stepped exactly.
    let corner = 0.01 / (0.01 * PER_CYCLE as f64);
    let kept = (-TAU * corner * 0.01).exp();
    let (mut last, mut reads) = (0.0, 0.0);
    let mut all = Vec::new();
    for force in record(|_, force| force).force {
        reads = kept * reads + (force - last) * (1.0 - kept) / (TAU * corner * 0.01);
        last = force;
        all.push(reads);
    }
    let findings = diagnose(&[record(|i, _| all[i])], |_| ()).unwrap();
    assert_eq!(named(&findings), ["ac_coupling"], "seed {SEED}");
}
