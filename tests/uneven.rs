//! Records off an uneven clock: what is sampled unevenly is no noise, no delay and no damping.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use iwan::record::evened::evened;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Seed of clock and noise; printed with every failure.
const SEED: u64 = 20261127;

/// When a sample is taken that is due at a time \[s\]; never, where it is lost.
type Clock<'a> = &'a dyn Fn(&mut ChaCha8Rng, f64) -> Option<f64>;

/// Sixty sliders and a cubic spring across them under steps of a sine, each reading where `clock` says, in noise of 50 nm; the joint
/// itself is marched ten times as finely.
fn record(clock: Clock, cubic: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut reached = [0.0_f64; 60];
    let mut before = 0.0;
    let mut fine: Vec<(f64, f64, f64)> = Vec::new();
    for i in 0..16_000 {
        let time = 5e-4 * f64::from(i);
        let level = [0.4, 0.7, 1.0, 0.7][i as usize / 4000];
        let u = 2e-5 * level * (TAU * 2.0 * time).sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 1e-6 * (j + 1) as f64;
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        let force = 2e6 * reached.iter().sum::<f64>() + 5e7 * u * (1.0 + cubic * u * u);
        fine.push((time, force, u));
    }
    let (mut time, mut force, mut displacement) = (Vec::new(), Vec::new(), Vec::new());
    for i in 0..1590 {
        let Some(at) = clock(&mut random, 5e-3 * f64::from(i)) else {
            continue;
        };
        // Stamps of 0.5 ms, as the march has them.
        let (stamp, reading, u) = fine[((at / 5e-4).round() as usize).min(15_999)];
        if time.last().is_some_and(|last| stamp <= *last) {
            continue;
        }
        let noise = (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        time.push(stamp);
        force.push(reading);
        displacement.push(u + 5e-8 * noise);
    }
    Record {
        name: "uneven".to_string(),
        time: Some(time),
        force,
        displacement,
        ..Record::default()
    }
}

#[test]
fn an_uneven_clock_is_no_cause() {
    let jitter = |random: &mut ChaCha8Rng, at: f64| {
        Some((at + 2e-3 * (random.random::<f64>() - 0.5)).max(0.0))
    };
    let lost = |random: &mut ChaCha8Rng, at: f64| (random.random::<f64>() > 0.25).then_some(at);
    let clocks: [Clock; 2] = [&jitter, &lost];
    for (which, clock) in clocks.into_iter().enumerate() {
        let place = format!("seed {SEED}, clock {which}");
        let clean = record(clock, 0.0);
        assert!(evened(&clean).is_some(), "{place}");
        let findings = diagnose(&[clean], |_| ()).unwrap();
        assert_eq!(findings.verdict, Verdict::Clean, "{place}: {findings:?}");
        let said = findings.notes.join(" ");
        assert!(said.contains("Sampled unevenly"), "{place}: {said}");
        let findings = diagnose(&[record(clock, 6e8)], |_| ()).unwrap();
        let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["cubic_stiffness"], "{place}");
    }
}

#[test]
fn an_even_clock_is_left_alone() {
    assert_eq!(evened(&record(&|_, at| Some(at), 0.0)), None);
}
