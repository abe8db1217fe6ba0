//! Sizes of the records that the starts of the search are measured in.

use crate::causes::Scale;
use crate::identify::problem::Prepared;
use crate::identify::{Fit, Form, Problem};
use crate::record::jumps::jumps;

/// Sizes of the records, from the baseline's truth.
pub fn sizes(problem: &Problem, first: &Fit) -> Scale {
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let (mut force, mut displacement, mut velocity) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut dissipation, mut path, mut step) = (0.0_f64, 0.0_f64, 0.0_f64);
    let mut slowest = 0.0_f64;
    for (k, record) in problem.records.iter().enumerate() {
        let mut last = 0.0;
        let prediction = problem.pass(k, &first.coefficients, &[], |_, march, _| {
            last = march.dissipation();
        });
        let truth = prediction.truth;
        let moves = truth.displacement.windows(2);
        path = path.max(moves.map(|two| (two[1] - two[0]).abs()).sum());
        force = force.max(largest(&truth.force));
        displacement = displacement.max(largest(&truth.displacement));
        dissipation = dissipation.max(last);
        let rates = truth.displacement.windows(2).zip(&record.steps[1..]);
        let rates: Vec<f64> = rates.map(|(two, step)| (two[1] - two[0]) / step).collect();
        velocity = velocity.max(largest(&rates));
        slowest = slowest.max(period(&truth.displacement, &rates));
        step = record.steps.get(1).copied().unwrap_or(1.0).max(step);
    }
    let stiffness = match problem.operators.form {
        Form::Play => 1.0 / first.coefficients[0].max(1e-3 * displacement / force),
        Form::Stop => first.coefficients.iter().sum::<f64>(),
    };
    let period = std::f64::consts::TAU * displacement / velocity.max(f64::MIN_POSITIVE);
    Scale {
        force,
        displacement,
        velocity,
        stiffness,
        dissipation,
        path,
        lengths: problem.records.iter().map(Prepared::length).collect(),
        jumps: possible_jumps(problem),
        period,
        slowest,
        step,
    }
}

/// Period of the sine that moves as far and as fast as a motion does, `2π rms(U)/rms(U̇)` \[s\].
fn period(displacement: &[f64], rates: &[f64]) -> f64 {
    let mean_square =
        |values: &[f64]| values.iter().map(|x| x * x).sum::<f64>() / values.len().max(1) as f64;
    let mean = displacement.iter().sum::<f64>() / displacement.len().max(1) as f64;
    let about = mean_square(displacement) - mean * mean;
    std::f64::consts::TAU * (about.max(0.0) / mean_square(rates).max(f64::MIN_POSITIVE)).sqrt()
}

/// Places of every record at which the displacement may have jumped.
const JUMPS: usize = 2;

/// Times in the middle of the steps that stand out most.
fn possible_jumps(problem: &Problem) -> Vec<f64> {
    let mut begins = 0.0;
    let mut times = Vec::new();
    for record in &problem.records {
        let first = record.time.first().copied().unwrap_or(0.0);
        for i in jumps(&record.displacement, JUMPS) {
            times.push(begins + record.time[i] - 0.5 * record.steps[i] - first);
        }
        begins += record.length();
    }
    times
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_period_of_a_motion_is_that_of_its_sine_wherever_it_is_about() {
        let expected = 1.3;
        let step = 0.01 * expected;
        let angle = |i: i32| 0.01 * std::f64::consts::TAU * f64::from(i);
        let motion: Vec<f64> = (0..3000).map(|i| 3.0 + 2.0 * angle(i).sin()).collect();
        let rates: Vec<f64> = motion
            .windows(2)
            .map(|two| (two[1] - two[0]) / step)
            .collect();
        let found = period(&motion, &rates);
        // A chord is shorter than its arc by x²/24, 1.6e-4, and one rate is missing, 1.7e-4.
        assert!((found / expected - 1.0).abs() < 4e-4, "{found}");
    }
}
