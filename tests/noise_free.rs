//! Records without noise, as simulations and coarse converters give them: no cause is found in what nothing resolves.

mod plays;

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::{Findings, Verdict};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Levels of force \[N\] of four cycles each.
const LEVELS: [f64; 3] = [200.0, 400.0, 550.0];

/// Samples per cycle.
const CYCLE: usize = 200;

fn force() -> Vec<f64> {
    let count = LEVELS.len() * 4 * CYCLE;
    let level = |i: usize| LEVELS[i / (4 * CYCLE)];
    let sine = |i: usize| (TAU * i as f64 / CYCLE as f64).sin();
    (0..count).map(|i| level(i) * sine(i)).collect()
}

fn noted(findings: &Findings, what: &str) -> bool {
    findings.notes.iter().any(|note| note.contains(what))
}

/// A hundred sliders between limits of 1 and 600 N, whose spacing grows by a ratio: no grid of a fit is theirs.
fn sliders(force: &[f64]) -> Vec<f64> {
    let limit = |k: usize| 600.0_f64.powf(k as f64 / 99.0);
    let mut plays = [0.0_f64; 100];
    let answers = force.iter().map(|&bears| {
        for (k, play) in plays.iter_mut().enumerate() {
            *play = play.clamp(bears - limit(k), bears + limit(k));
        }
        1e-8 * bears + 5e-10 * plays.iter().sum::<f64>()
    });
    answers.collect()
}

#[test]
fn a_simulated_joint_is_clean_and_so_is_a_spring() {
    let joints = [plays::displacement(&force()), sliders(&force())];
    let spring = force().iter().map(|f| 5e-9 * f).collect();
    for displacement in joints.into_iter().chain([spring]) {
        let findings = diagnose(&[plays::record("still", force(), displacement)], |_| ()).unwrap();
        assert_eq!(findings.verdict, Verdict::Clean, "{}", findings.summary);
        assert!(noted(&findings, "less noise than a ten-thousandth"));
    }
}

#[test]
fn steps_of_a_converter_are_its_noise() {
    let step = 5e-8;
    let displacement = plays::displacement(&force());
    let read: Vec<f64> = displacement
        .iter()
        .map(|u| (u / step).round() * step)
        .collect();
    let findings = diagnose(&[plays::record("still", force(), read)], |_| ()).unwrap();
    assert_eq!(findings.verdict, Verdict::Clean, "{}", findings.summary);
    assert!(
        noted(&findings, "is read in steps of 50.0 nm"),
        "{:?}",
        findings.notes
    );
    let noise = findings.noise.rms * 12.0_f64.sqrt() / step;
    assert!((noise - 1.0).abs() < 0.2, "{noise}");
}

#[test]
fn channels_that_do_not_go_together_are_no_clean_joint() {
    let mut random = ChaCha8Rng::seed_from_u64(20261124);
    let mut drawn = |size: f64| -> Vec<f64> {
        let each = (0..2400).map(|_| size * (random.random::<f64>() - 0.5));
        each.collect()
    };
    let (force, displacement) = (drawn(1000.0), drawn(1e-5));
    let findings = diagnose(&[plays::record("still", force, displacement)], |_| ()).unwrap();
    assert_eq!(
        findings.verdict,
        Verdict::Unexplained,
        "{}",
        findings.summary
    );
    assert!(noted(&findings, "columns are those of one test"));
}
