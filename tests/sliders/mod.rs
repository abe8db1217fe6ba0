//! Tests of forty sliders beside a spring, for diagnoses of several records.

use iwan::record::Record;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Steps of a sine of so many hertz, driven in force by the sliders' own answer; the joint is so much stiffer and so much
/// more firmly held, and the displacement is read with noise of 20 nm and moves off by so many metres until the end.
pub fn test(
    rate: f64,
    (stiffer, firmer): (f64, f64),
    drifted: f64,
    random: &mut ChaCha8Rng,
) -> Record {
    let mut reached = [0.0_f64; 40];
    let mut before = 0.0;
    let samples = 1600;
    let mut record = Record {
        name: format!("at-{rate}-Hz"),
        time: Some((0..samples).map(|i| i as f64 / 80.0 / rate).collect()),
        ..Record::default()
    };
    for i in 0..samples {
        let level = [0.4, 0.7, 1.0, 0.6][4 * i / samples];
        let u = 8e-6 * level * (TAU * i as f64 / 80.0).sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 3e-7 * (j + 1) as f64 * (1.0 + firmer) / (1.0 + stiffer);
            *d = (*d + u - before).clamp(-most, most);
        }
        before = u;
        let noise = (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
        let of_one = 3e6 * reached.iter().sum::<f64>() + 4e7 * u;
        record.force.push((1.0 + stiffer) * of_one);
        let drift = drifted * i as f64 / samples as f64;
        record.displacement.push(u + drift + 2e-8 * noise);
    }
    record
}
