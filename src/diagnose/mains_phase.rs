//! One phase of the mains for all records: each test starts at a moment of its own.

use crate::causes::{Cause, find};
use crate::identify::prepared::Prepared;
use crate::identify::{Fit, Prediction, Problem, refit};
use crate::joint::effect::Acting;
use crate::record::mains;
use rayon::prelude::*;

/// Frequencies tried to either side of a nominal one at most.
const MOST: usize = 200;

/// Moves the clocks of all records but the first by less than a period of the mains, so that a hum
/// in what the baseline leaves has the same phase over time in all of them.
///
/// No other cause minds: time enters them by its steps, or over lengths beside which a period of the
/// mains is nothing. Where there is no hum the moves are as good as drawn by lot.
pub fn align(problem: &mut Problem, first: &Fit) {
    let Some(hum) = find("mains_hum").filter(|_| problem.records.len() > 1) else {
        return;
    };
    let of_hum = &hum.parameters()[2];
    let left_by_first = first.residuals(problem);
    let residuals = in_scatters(&left_by_first);
    let within = |(_, f): &(f64, f64)| (of_hum.lower..of_hum.upper).contains(f);
    let loudest = mains::NOMINAL
        .into_iter()
        .filter_map(|nominal| loudest(problem, &residuals, nominal))
        .filter(within)
        .max_by(|a, b| a.0.total_cmp(&b.0));
    let Some((fall, frequency)) = loudest else {
        return;
    };
    let found = lines(problem, &residuals, frequency);
    set_clocks(problem, &found, frequency);
    let samples: usize = residuals.iter().map(Vec::len).sum();
    if fall > STRONG * samples as f64 {
        let seen = line(&problem.records[0].time, &left_by_first[0], frequency);
        let begun = begun(problem, first, hum, (frequency, seen));
        anew(problem, first, begun);
    }
}

/// Frequencies near each of those of the mains at which residuals are loudest \[Hz\].
pub fn loudest_mains(problem: &Problem, first: &Fit) -> Vec<f64> {
    let residuals = in_scatters(&first.residuals(problem));
    let near = |nominal| loudest(problem, &residuals, nominal).map(|(_, frequency)| frequency);
    mains::NOMINAL.into_iter().filter_map(near).collect()
}

/// Fall of the sum of squares by sines of the frequency near a nominal one that takes most, one of each record, and
/// that frequency.
fn loudest(problem: &Problem, residuals: &[Vec<f64>], nominal: f64) -> Option<(f64, f64)> {
    let lengths = problem.records.iter().map(Prepared::length);
    let longest = lengths.fold(0.0, f64::max);
    let fall = |f: f64| {
        lines(problem, residuals, f)
            .iter()
            .map(|l| l.0)
            .sum::<f64>()
    };
    mains::near(nominal, longest, MOST)
        .into_par_iter()
        .map(|f| (fall(f), f))
        .max_by(|a, b| a.0.total_cmp(&b.0))
}

fn lines(problem: &Problem, residuals: &[Vec<f64>], frequency: f64) -> Vec<(f64, f64)> {
    let both = problem.records.iter().zip(residuals);
    both.map(|(record, residual)| line(&record.time, residual, frequency))
        .collect()
}

/// The hum that gives the judged channel of the first record the line `seen`: a prescribed displacement's
/// comes out as a force, by the joint's stiffness and the other way round.
fn begun(
    problem: &Problem,
    first: &Fit,
    hum: &'static dyn Cause,
    (frequency, seen): (f64, (f64, f64)),
) -> Acting {
    let record = &problem.records[0];
    let small = SMALL * crate::record::cycles::rms(&record.displacement);
    let of = |size: f64, phase: f64| Acting {
        effect: hum.effect(),
        values: vec![
            size * phase.cos(),
            size * phase.sin(),
            frequency,
            0.0,
            0.0,
            0.0,
            0.0,
        ],
    };
    let given = &judged_part(problem, first, &[of(small, seen.1)])[0];
    let given = line(&record.time, given, frequency);
    let size = small * (seen.0 / given.0.max(f64::MIN_POSITIVE)).sqrt();
    of(size, 2.0 * seen.1 - given.1)
}

/// Amplitude of a hum, over the displacement's own, by which the joint's answer to one is told.
const SMALL: f64 = 1e-3;

/// What effects add to the judged channels beside a fit's dictionary.
fn judged_part(problem: &Problem, fit: &Fit, effects: &[Acting]) -> Vec<Vec<f64>> {
    let with = problem.predict(&fit.coefficients, effects);
    let without = problem.predict(&fit.coefficients, &[]);
    let part = |(with, without): (&Prediction, &Prediction)| {
        let both = with.judged.iter().zip(&without.judged);
        both.map(|(with, without)| with - without).collect()
    };
    with.iter().zip(&without).map(part).collect()
}

/// Share of what the baseline leaves that a hum takes from which its phases are looked at again.
const STRONG: f64 = 0.1;

/// Times they are.
const AGAIN: usize = 3;

/// Sets the clocks anew by phases beside a joint that was fitted with the hum: a baseline without it
/// takes up some of a short record's, and leaves some of the drive. A clock is away by as much as its
/// record's line is from the one that the hum has there.
fn anew(problem: &mut Problem, first: &Fit, begun: Acting) {
    let mut fit = first.clone();
    let mut effects = vec![begun];
    for _ in 0..AGAIN {
        fit = refit(problem, &fit, effects);
        effects = fit.effects.clone();
        let frequency = effects[0].values[2];
        let lines: Vec<(f64, f64)> = problem
            .records
            .iter()
            .zip(fit.residuals(problem))
            .zip(judged_part(problem, &fit, &effects))
            .map(|((record, left), part)| {
                let both = left.iter().zip(&part);
                let whole: Vec<f64> = both.map(|(left, part)| left + part).collect();
                let (fall, phase) = line(&record.time, &whole, frequency);
                (fall, phase - line(&record.time, &part, frequency).1)
            })
            .collect();
        set_clocks(problem, &lines, frequency);
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

/// What a fit leaves of each record, in units of its own scatter.
fn in_scatters(left: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let one = |left: &Vec<f64>| {
        let scatter = crate::record::cycles::rms(left).max(f64::MIN_POSITIVE);
        left.iter().map(|r| r / scatter).collect()
    };
    left.iter().map(one).collect()
}

/// Fall of the sum of squares by a sine of the frequency, and its phase at time zero.
fn line(time: &[f64], residual: &[f64], frequency: f64) -> (f64, f64) {
    let (sine, cosine) = mains::line(time, residual, frequency);
    let half = 0.5 * time.len() as f64;
    (half * (sine * sine + cosine * cosine), cosine.atan2(sine))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::{Form, baseline};
    use crate::record::Record;

    /// A joint that gives way a little at half its force, under 7 Hz; its sensor reads a hum as well, whose
    /// phase the three tests begin at are the given ones.
    fn humming(form: Form, phases: [f64; 3]) -> Vec<Record> {
        let test = |(k, phase): (usize, f64)| {
            let time: Vec<f64> = (0..1500).map(|i| 7e-4 * f64::from(i)).collect();
            let rate = std::f64::consts::TAU * (5.0 + 2.0 * k as f64);
            let force = |t: &f64| 200.0 * (rate * t).sin();
            let hum = |t: &f64| 4e-8 * (std::f64::consts::TAU * 50.02 * t + phase).sin();
            let share = match form {
                Form::Play => 1.0,
                // A softer one, so that the force's line is not the displacement's times one number.
                Form::Stop => 0.3,
            };
            Record {
                name: format!("test {k}"),
                force: time.iter().map(force).collect(),
                displacement: time
                    .iter()
                    .map(|t| force(t) / (share * 1e8) + hum(t))
                    .collect(),
                time: Some(time),
                ..Record::default()
            }
        };
        phases.into_iter().enumerate().map(test).collect()
    }

    #[test]
    fn clocks_are_set_whichever_channel_is_judged() {
        for form in [Form::Play, Form::Stop] {
            let phases = [0.3, 2.1, -1.9];
            let mut problem = Problem::new(form, &humming(form, phases));
            let first = baseline(&problem);
            let before: Vec<f64> = problem.records.iter().map(|r| r.time[0]).collect();
            align(&mut problem, &first);
            for (k, record) in problem.records.iter().enumerate() {
                let turned = std::f64::consts::TAU * 50.02 * (record.time[0] - before[k]);
                let away = (phases[k] - turned - phases[0]) / std::f64::consts::TAU;
                let away = away - away.round();
                assert!(away.abs() < 0.01, "{form:?}, test {k}: {away} of a period");
            }
        }
    }

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
