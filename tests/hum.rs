//! A hum is found over a long record, however far the mains are from their nominal frequency.

use iwan::diagnose::diagnose;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Forty plays in series under three levels of force for half a minute, two hundred samples a second; noise of
/// 20 nm in the displacement and a hum of 20 nm at `frequency` \[Hz\].
fn record(seed: u64, frequency: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let mut plays = [0.0_f64; 40];
    let (mut time, mut force, mut displacement) = (vec![], vec![], vec![]);
    for i in 0..6000 {
        let t = i as f64 / 200.0;
        let level = [250.0, 500.0, 400.0][i / 2000];
        let bears = level * (TAU * 1.5 * t).sin();
        for (j, play) in plays.iter_mut().enumerate() {
            let threshold = 15.0 * (j + 1) as f64;
            *play = play.clamp(bears - threshold, bears + threshold);
        }
        let u = 1e-8 * bears + 1e-9 * plays.iter().sum::<f64>();
        time.push(t);
        force.push(bears);
        displacement.push(u + 2e-8 * (noise() + (TAU * frequency * t + 0.4).sin()));
    }
    Record {
        name: "long".to_string(),
        time: Some(time),
        force,
        displacement,
        ..Record::default()
    }
}

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20_261_124;

#[test]
fn a_hum_is_named_over_half_a_minute_away_from_its_nominal_frequency() {
    for frequency in [49.953, 50.04, 60.07] {
        let findings = diagnose(&[record(SEED, frequency)], |_| ()).unwrap();
        let named: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(named, ["mains_hum"], "seed {SEED}, {frequency} Hz");
        let of_hum = &findings.causes[0].parameters;
        let told = of_hum.iter().find(|e| e.name == "frequency").unwrap();
        assert!(
            (told.value - frequency).abs() < 0.003,
            "{frequency} Hz: {}",
            told.value
        );
    }
}
