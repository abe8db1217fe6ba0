//! One phase of the mains for all records: each test starts at a moment of its own.

use crate::causes::find;
use crate::identify::{Fit, Problem};

/// Frequencies tried about a nominal one, per cycle of the longest record.
const PER_CYCLE: f64 = 4.0;

/// Share by which mains leave their nominal frequency.
const AWAY: f64 = 0.002;

/// Most frequencies tried.
const MOST: usize = 400;

/// Moves the clocks of all records but the first by less than a period of the mains, so that a hum
/// in what the baseline leaves has the same phase over time in all of them.
///
/// No other cause minds: time enters them by its steps, or over lengths beside which a period of the
/// mains is nothing. Where there is no hum the moves are as good as drawn by lot.
pub fn align(problem: &mut Problem, first: &Fit) {
    let Some(hum) = find("mains_hum").filter(|_| problem.records.len() > 1) else {
        return;
    };
    let frequency = &hum.parameters()[2];
    let residuals = residuals(problem, first);
    let longest = problem
        .records
        .iter()
        .map(|r| r.time.last().unwrap_or(&0.0) - r.time.first().unwrap_or(&0.0))
        .fold(0.0, f64::max);
    let lines = |f: f64| -> Vec<(f64, f64)> {
        let both = problem.records.iter().zip(&residuals);
        both.map(|(record, residual)| line(&record.time, residual, f))
            .collect()
    };
    let strength = |f: f64| lines(f).iter().map(|l| l.0).sum::<f64>();
    let best = [50.0, 60.0]
        .into_iter()
        .flat_map(|nominal| {
            let half = ((AWAY * nominal * PER_CYCLE * longest).ceil() as usize).min(MOST / 2);
            let step = AWAY * nominal / half.max(1) as f64;
            (0..=2 * half).map(move |i| nominal + step * (i as f64 - half as f64))
        })
        .filter(|f| (frequency.lower..frequency.upper).contains(f))
        .map(|f| (strength(f), f))
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, frequency)) = best else {
        return;
    };
    let phases: Vec<f64> = lines(frequency).iter().map(|l| l.1).collect();
    for (record, phase) in problem.records.iter_mut().zip(&phases).skip(1) {
        let turns = ((phase - phases[0]) / std::f64::consts::TAU).rem_euclid(1.0);
        record.time.iter_mut().for_each(|t| *t += turns / frequency);
    }
}

/// What the baseline leaves of each record, in units of its own scatter.
fn residuals(problem: &Problem, first: &Fit) -> Vec<Vec<f64>> {
    let predictions = first.predict(problem);
    let one = |(k, prediction): (usize, &crate::identify::Prediction)| {
        let (_, judged) = problem.channels(k);
        let left: Vec<f64> = judged
            .iter()
            .zip(&prediction.judged)
            .map(|(y, p)| y - p)
            .collect();
        let scatter = super::prepare::rms(&left).max(f64::MIN_POSITIVE);
        left.iter().map(|r| r / scatter).collect()
    };
    predictions.iter().enumerate().map(one).collect()
}

/// Fall of the sum of squares by a sine of the frequency, and its phase at time zero.
fn line(time: &[f64], residual: &[f64], frequency: f64) -> (f64, f64) {
    let (mut sine, mut cosine) = (0.0, 0.0);
    for (t, r) in time.iter().zip(residual) {
        let (s, c) = (std::f64::consts::TAU * frequency * t).sin_cos();
        sine += r * s;
        cosine += r * c;
    }
    let count = time.len().max(1) as f64;
    (
        2.0 * (sine * sine + cosine * cosine) / count,
        cosine.atan2(sine),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_phase_of_a_sine_is_found_at_its_frequency() {
        let time: Vec<f64> = (0..4000).map(|i| 0.5 + 1e-3 * f64::from(i)).collect();
        let hum = |t: &f64| (std::f64::consts::TAU * 50.0 * t + 0.7).sin();
        let residual: Vec<f64> = time.iter().map(hum).collect();
        let (fall, phase) = line(&time, &residual, 50.0);
        assert!((phase - 0.7).abs() < 1e-6);
        assert!((fall - 2000.0).abs() < 1e-3);
        assert!(line(&time, &residual, 51.0).0 < 0.01 * fall);
    }
}
