//! Sizes of the records that the starts of the search are measured in.

use super::mains_phase::loudest_mains;
use crate::causes::Scale;
use crate::identify::beginning::BAND;
use crate::identify::prepared::Prepared;
use crate::identify::{Fit, Form, Problem};
use crate::record::cycles::turning_points;
use crate::record::jumps::jumps;
use crate::record::ringing::ringing;

/// Sizes of the records, from the baseline's truth.
pub fn sizes(problem: &Problem, first: &Fit) -> Scale {
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let (mut force, mut displacement, mut velocity) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut dissipation, mut path) = (0.0_f64, 0.0_f64);
    let (mut step, mut finest) = (0.0_f64, f64::INFINITY);
    let mut slowest = 0.0_f64;
    let mut first_turns: Option<(f64, f64)> = None;
    let mut tones = Vec::new();
    for (k, record) in problem.records.iter().enumerate() {
        let (mut last, mut early) = (0.0, 0.0);
        let turns = turning_points(problem.channels(k).0, BAND);
        let turned = match turns[..] {
            [_, _, turned, _, ..] => Some(turned),
            _ => None,
        };
        let prediction = problem.pass(k, &first.coefficients, &[], |i, march, _| {
            last = march.dissipation();
            if i.is_some() && i == turned {
                early = last;
            }
        });
        let truth = &prediction.truth;
        let way = |displacement: &[f64]| -> f64 {
            let moves = displacement.windows(2);
            moves.map(|two| (two[1] - two[0]).abs()).sum()
        };
        path = path.max(way(&truth.displacement));
        if let Some(turned) = turned {
            let (energy, path) = first_turns.unwrap_or((f64::INFINITY, f64::INFINITY));
            let to_turn = way(&truth.displacement[..=turned]);
            first_turns = Some((energy.min(early), path.min(to_turn)));
        }
        force = force.max(largest(&truth.force));
        displacement = displacement.max(largest(&truth.displacement));
        dissipation = dissipation.max(last);
        for i in 1..truth.displacement.len() {
            let rate = (truth.displacement[i] - truth.displacement[i - 1]) / record.steps[i];
            velocity = velocity.max(rate.abs());
        }
        let frequency = truth.frequency();
        slowest = slowest.max(std::f64::consts::TAU / frequency);
        let own = record.steps.get(1).copied().unwrap_or(1.0);
        step = own.max(step);
        finest = own.min(finest);
        let (_, measured) = problem.channels(k);
        let both = measured.iter().zip(&prediction.judged);
        let left: Vec<f64> = both.map(|(y, p)| y - p - first.offsets[k]).collect();
        tones.extend(ringing(own, &left, FASTER * frequency));
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
        first_turns: first_turns.unwrap_or_default(),
        lengths: problem.records.iter().map(Prepared::length).collect(),
        jumps: possible_jumps(problem),
        period,
        slowest,
        step,
        finest,
        judges_force: problem.operators.form == Form::Stop,
        ringing: tones,
        mains: loudest_mains(problem, first),
    }
}

/// Times the frequency of a load above which what rings is looked for.
const FASTER: f64 = 2.0;

/// Places of every channel at which its reading may have jumped.
const JUMPS: usize = 2;

/// Times in the middle of the steps that stand out most.
fn possible_jumps(problem: &Problem) -> Vec<f64> {
    let mut begins = 0.0;
    let mut times = Vec::new();
    for record in &problem.records {
        let first = record.time.first().copied().unwrap_or(0.0);
        let (driven, judged) = record.channels(problem.operators.form);
        let channels = match problem.operators.form {
            Form::Play => vec![judged],
            Form::Stop => vec![driven, judged],
        };
        for i in channels
            .into_iter()
            .flat_map(|channel| jumps(channel, JUMPS))
        {
            times.push(begins + record.time[i] - 0.5 * record.steps[i] - first);
        }
        begins += record.length();
    }
    times
}
