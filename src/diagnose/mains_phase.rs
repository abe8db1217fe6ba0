//! One phase of the mains for all records: each test starts at a moment of its own.

use crate::causes::{Cause, find};
use crate::identify::{Fit, Problem, refit};
use crate::joint::effect::{Acting, Trajectory};

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
    let left_by_first = left(problem, first);
    let residuals = in_scatters(&left_by_first);
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
    let Some((fall, frequency)) = best else {
        return;
    };
    let found = lines(frequency);
    set_clocks(problem, &found, frequency);
    let samples: usize = residuals.iter().map(Vec::len).sum();
    if fall > STRONG * samples as f64 {
        let (sine, cosine) = found[0].1.sin_cos();
        let share = 2.0 * found[0].0 / residuals[0].len().max(1) as f64;
        let amplitude = share.sqrt() * super::prepare::rms(&left_by_first[0]);
        let values = vec![amplitude * cosine, amplitude * sine, frequency, 0.0, 0.0];
        anew(problem, first, hum, values);
    }
}

/// Share of what the baseline leaves that a hum takes from which its phases are looked at again.
const STRONG: f64 = 0.1;

/// Times they are.
const AGAIN: usize = 3;

/// Sets the clocks anew by phases beside a joint that was fitted with the hum: a baseline without it
/// takes up some of a short record's, and leaves some of the drive.
fn anew(problem: &mut Problem, first: &Fit, hum: &'static dyn Cause, values: Vec<f64>) {
    let mut effects = vec![Acting {
        effect: hum.effect(),
        values,
    }];
    let mut fit = first.clone();
    for _ in 0..AGAIN {
        fit = refit(problem, &fit, effects);
        effects = fit.effects.clone();
        let values = &effects[0].values;
        let lines: Vec<(f64, f64)> = problem
            .records
            .iter()
            .zip(left(problem, &fit))
            .map(|(record, left)| {
                let clock = Trajectory {
                    time: record.time.clone(),
                    ..Trajectory::default()
                };
                let added = hum.channel(values, &clock);
                let both = left.iter().zip(&added);
                let whole: Vec<f64> = both.map(|(left, added)| left + added).collect();
                line(&record.time, &whole, values[2])
            })
            .collect();
        set_clocks(problem, &lines, values[2]);
    }
}

/// Moves the clocks of all records but the first until the phases of their lines are the first's.
fn set_clocks(problem: &mut Problem, lines: &[(f64, f64)], frequency: f64) {
    for (record, line) in problem.records.iter_mut().zip(lines).skip(1) {
        // The nearer way round: a clock that is right already stays.
        let away = (line.1 - lines[0].1) / std::f64::consts::TAU;
        let turns = away - away.round();
        record.time.iter_mut().for_each(|t| *t += turns / frequency);
    }
}

/// What a fit leaves of each record.
fn left(problem: &Problem, fit: &Fit) -> Vec<Vec<f64>> {
    let predictions = fit.predict(problem);
    let one = |(k, prediction): (usize, &crate::identify::Prediction)| {
        let (_, judged) = problem.channels(k);
        let both = judged.iter().zip(&prediction.judged);
        both.map(|(y, p)| y - p).collect()
    };
    predictions.iter().enumerate().map(one).collect()
}

/// The same in units of its own scatter.
fn in_scatters(left: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let one = |left: &Vec<f64>| {
        let scatter = super::prepare::rms(left).max(f64::MIN_POSITIVE);
        left.iter().map(|r| r / scatter).collect()
    };
    left.iter().map(one).collect()
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
