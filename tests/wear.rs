//! What wears in one test is worn in the next one of the same joint, unless the joint was made new between them.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Findings;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

const CYCLE: usize = 80;

/// Sixty sliders whose friction falls by a third with the way they have gone, under two tests of a stepped sine of
/// displacement with noise in the force.
fn records(seed: u64, made_new: bool) -> Vec<Record> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let mut way = 0.0;
    let mut test = |name: &str, step: f64| {
        let mut reached = [0.0_f64; 60];
        let mut before = 0.0;
        let (mut force, mut displacement) = (Vec::new(), Vec::new());
        if made_new {
            way = 0.0;
        }
        for i in 0..20 * CYCLE {
            let level = [1.5e-6, 3e-6, 5e-6, 4e-6][(i / CYCLE / 5).min(3)];
            let u: f64 = level * (TAU * i as f64 / CYCLE as f64).sin();
            way += (u - before).abs();
            let friction = 1.0 - 0.33 * (1.0 - (-way / 2e-4_f64).exp());
            for (j, d) in reached.iter_mut().enumerate() {
                let most = 1e-7 * (j + 1) as f64 * friction;
                *d = (*d + u - before).clamp(-most, most);
            }
            before = u;
            force.push(2e6 * reached.iter().sum::<f64>() + 1.5 * noise());
            displacement.push(u);
        }
        Record {
            name: name.to_string(),
            time: Some((0..force.len()).map(|i| step * i as f64).collect()),
            force,
            displacement,
            ..Record::default()
        }
    };
    vec![test("first", 0.01), test("second", 0.003)]
}

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261123;

fn names(findings: &Findings) -> Vec<&str> {
    findings.causes.iter().map(|c| c.name.as_str()).collect()
}

#[test]
fn wear_is_told_whether_or_not_it_goes_on_from_test_to_test() {
    for made_new in [false, true] {
        let findings = diagnose(&records(SEED, made_new), |_| ()).unwrap();
        let place = format!("seed {SEED}, made new {made_new}");
        // The law of these sliders is not the catalogue's: what little it leaves is not asked about here.
        assert_eq!(names(&findings), ["preload_loss"], "{place}");
        let noted = findings.notes.iter().any(|n| n.contains("Wear goes on"));
        assert_eq!(noted, !made_new, "{place}: {:?}", findings.notes);
    }
}
