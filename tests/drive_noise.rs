//! What the driving channel's own noise does to a model is no cause: the joint felt nothing of it.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

const CYCLE: usize = 90;

/// Cycles of a level, levels, noise of the displacement \[m\] and of the force \[N\], and what of that goes on in the next
/// sample.
struct Measured {
    cycles: usize,
    levels: usize,
    drive: f64,
    response: f64,
    alike: f64,
}

/// Read with noise that the stiffest answer would make 0.7 N, and a force with noise of 3 N whose neighbours correlate by
/// 0.9.
const LOUD: Measured = Measured {
    cycles: 6,
    levels: 4,
    drive: 6e-9,
    response: 3.0,
    alike: 0.9,
};

/// Sixty sliders under cycles of displacement that grow.
fn record(seed: u64, measured: &Measured) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let alike = measured.alike;
    let count = measured.levels * measured.cycles * CYCLE;
    let mut reached = [0.0_f64; 60];
    let (mut before, mut slow) = (0.0, 0.0);
    let (mut force, mut displacement) = (Vec::new(), Vec::new());
    for i in 0..count {
        let level = 1e-6 * (2 + 2 * (i / CYCLE / measured.cycles)) as f64;
        let u = level * (TAU * i as f64 / CYCLE as f64).sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 1e-7 * (j + 1) as f64;
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        slow = alike * slow + measured.response * (1.0 - alike * alike).sqrt() * noise();
        force.push(2e6 * reached.iter().sum::<f64>() + slow);
        displacement.push(u + measured.drive * noise());
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
        let findings = diagnose(&[record(seed, &LOUD)], |_| ()).unwrap();
        let named: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(
            findings.verdict,
            Verdict::Clean,
            "seed {seed}: {named:?}, {:?}",
            findings.notes
        );
        assert!(
            findings
                .notes
                .iter()
                .any(|n| n.contains("driving channel is noisy"))
        );
    }
}

/// So little noise of the drive that it adds a few hundredths to the misfit, in so many samples that a mass which answers to it
/// would be beyond doubt.
#[test]
fn little_noise_in_many_samples_is_no_mass() {
    let little = Measured {
        cycles: 60,
        drive: 6e-9,
        response: 3.0,
        alike: 0.0,
        ..LOUD
    };
    for seed in SEEDS.take(2) {
        let findings = diagnose(&[record(seed, &little)], |_| ()).unwrap();
        let named: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(findings.verdict, Verdict::Clean, "seed {seed}: {named:?}");
    }
}

/// As loud as the stiffest answer to it is the noise of the force, and both are white: the joint felt neither.
#[test]
fn equal_noise_in_both_channels_is_no_cause() {
    let equal = Measured {
        drive: 2.5e-8,
        response: 3.0,
        alike: 0.0,
        ..LOUD
    };
    for seed in SEEDS {
        let findings = diagnose(&[record(seed, &equal)], |_| ()).unwrap();
        let named: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(findings.verdict, Verdict::Clean, "seed {seed}: {named:?}");
    }
}

/// The fast part of slow noise is no louder than the drive's: what repeats tells which of them drives.
#[test]
fn the_channel_that_repeats_drives() {
    for seed in SEEDS {
        let records = [record(
            seed,
            &Measured {
                drive: 1.6e-8,
                ..LOUD
            },
        )];
        let judged = iwan::diagnose::judged_channel::form(&records).judged();
        assert_eq!(judged, ("force", "N"), "seed {seed}");
        let mut swapped = records;
        for record in &mut swapped {
            std::mem::swap(&mut record.force, &mut record.displacement);
        }
        let judged = iwan::diagnose::judged_channel::form(&swapped).judged();
        assert_eq!(judged, ("displacement", "m"), "seed {seed}");
    }
}
