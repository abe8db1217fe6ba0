//! A filter of first order in either channel is a channel that comes late, and no dashpot.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261126;

/// Samples of the records, and of each the steps between.
const SAMPLES: usize = 4000;
const PARTS: usize = 20;

/// Time between samples \[s\].
const STEP: f64 = 0.01;

/// Time constant of the filter \[s\].
const LAG: f64 = 0.02;

/// Deviation of the noise of the force \[N\].
const NOISE: f64 = 0.02;

/// A filter of first order that follows what it is given, in small implicit steps.
struct Filter {
    lag: f64,
    reads: f64,
}

impl Filter {
    fn follow(&mut self, truth: f64, step: f64) -> f64 {
        self.reads += step / (self.lag + step) * (truth - self.reads);
        self.reads
    }
}

/// Forty sliders under a displacement of two rates and growing levels, read through filters.
fn record(sensor_lag: f64, cell_lag: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let mut stretched = [0.0_f64; 40];
    let mut before = 0.0;
    let (mut time, mut force, mut displacement) = (Vec::new(), Vec::new(), Vec::new());
    let mut filters = [sensor_lag, cell_lag].map(|lag| Filter { lag, reads: 0.0 });
    for i in 0..SAMPLES * PARTS {
        let t = STEP / PARTS as f64 * i as f64;
        let level = 3e-6 * (0.4 + 0.6 * (0.5 * TAU * t / (STEP * SAMPLES as f64)).sin());
        let u = level * (0.7 * (TAU * 0.5 * t).sin() + 0.3 * (TAU * 2.3 * t).sin());
        for (j, d) in stretched.iter_mut().enumerate() {
            let most = 1e-7 * (j + 1) as f64;
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        let joint = 1e6 * stretched.iter().sum::<f64>();
        let step = STEP / PARTS as f64;
        let read = [u, joint];
        let read = [0, 1].map(|k| filters[k].follow(read[k], step));
        if i % PARTS == 0 {
            time.push(t);
            displacement.push(read[0]);
            force.push(read[1] + NOISE * noise());
        }
    }
    Record {
        name: "filtered".to_string(),
        time: Some(time),
        force,
        displacement,
        ..Record::default()
    }
}

#[test]
fn a_filter_of_either_channel_is_a_channel_that_comes_late() {
    for (sensor_lag, cell_lag) in [(LAG, 0.0), (0.0, LAG)] {
        let findings = diagnose(&[record(sensor_lag, cell_lag)], |_| ()).unwrap();
        let said = |what: &str| format!("seed {SEED}, {sensor_lag}, {cell_lag}: {what}");
        let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["sensor_delay"], "{}", said("names"));
        assert_eq!(findings.verdict, Verdict::Explained, "{}", said("verdict"));
        let values = findings.causes[0].parameters.iter();
        let found: f64 = values.map(|p| p.value).sum();
        let off = found / LAG - 1.0;
        assert!(off.abs() < 0.02, "{}", said(&format!("{found}")));
    }
}
