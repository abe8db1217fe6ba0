//! A joint for tests that any load may drive, forty plays in series, and a record of its test.

use iwan::record::Record;

/// Displacement \[m\] of forty plays in series, virgin at first, under a force \[N\].
pub fn displacement(force: &[f64]) -> Vec<f64> {
    let mut plays = [0.0_f64; 40];
    let answers = force.iter().map(|&bears| {
        for (j, play) in plays.iter_mut().enumerate() {
            let threshold = 15.0 * (j + 1) as f64;
            *play = play.clamp(bears - threshold, bears + threshold);
        }
        1e-8 * bears + 1e-9 * plays.iter().sum::<f64>()
    });
    answers.collect()
}

/// A record of a hundred samples a second.
pub fn record(name: &str, force: Vec<f64>, displacement: Vec<f64>) -> Record {
    Record {
        name: name.to_string(),
        time: Some((0..force.len()).map(|i| 0.01 * i as f64).collect()),
        force,
        displacement,
        ..Record::default()
    }
}
