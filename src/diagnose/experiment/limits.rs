//! What the rig can do: what the records show it doing, unless the user says otherwise.

use super::program::Rig;
use crate::diagnose::prepare::Bench;
use crate::identify::Form;
use crate::record::cycles::cycles;

/// Limits given by the user; `None` takes the largest that the records show.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Largest magnitude of the force \[N\].
    pub force: Option<f64>,
    /// Largest magnitude of the displacement \[m\].
    pub displacement: Option<f64>,
    /// Highest rate of a cycle \[Hz\].
    pub rate: Option<f64>,
    /// Longest test \[s\].
    pub duration: Option<f64>,
}

/// Samples in the fastest cycle at least.
const PER_CYCLE: f64 = 80.0;

/// Multiple of the highest rate measured that a rig goes to before it goes to its highest.
const FASTER: f64 = 3.0;

/// The rig within the user's limits, in up to four steps: as far as the records went, a little
/// faster, farther in the prescribed channel as well, and all that it can. A joint that slips more
/// deeply than it was ever seen to is known less than one that slips faster. Its clock is the
/// records' own unless the highest rate needs a faster one.
pub fn rigs(bench: &Bench, limits: &Limits) -> Vec<Rig> {
    let problem = &bench.whole;
    let (mut reach, mut duration) = (0.0_f64, 0.0);
    let (mut fastest, mut steps) = (Vec::new(), Vec::new());
    for (k, record) in problem.records.iter().enumerate() {
        let (input, _) = problem.channels(k);
        reach = input.iter().fold(reach, |a, b| a.max(b.abs()));
        if let (Some(first), Some(last)) = (record.time.first(), record.time.last()) {
            duration += last - first;
        }
        steps.extend(record.steps.iter().skip(1).copied());
        let found = cycles(input);
        let lengths = found
            .iter()
            .map(|c| record.time[c.end - 1] - record.time[c.start]);
        fastest.extend(lengths.filter(|l| *l > 0.0).map(f64::recip));
    }
    fastest.sort_by(f64::total_cmp);
    steps.sort_by(f64::total_cmp);
    // Not the very fastest: a cycle cut short by noise is none that the rig was asked for.
    let seen = fastest.get(fastest.len() * 9 / 10).copied();
    let seen = seen.unwrap_or(1.0 / bench.scale.period);
    let rate = limits.rate.unwrap_or(seen);
    let step = steps.get(steps.len() / 2).copied().unwrap_or(1.0);
    let given = match problem.operators.form {
        Form::Play => limits.force,
        Form::Stop => limits.displacement,
    };
    let most = given.unwrap_or(reach);
    let of = |reach: f64, rate: f64| Rig {
        reach,
        rate,
        duration: limits.duration.unwrap_or(duration),
        step: step.min(1.0 / (PER_CYCLE * rate)),
    };
    let mut rigs = vec![
        of(reach.min(most), seen.min(rate)),
        of(reach.min(most), (FASTER * seen).min(rate)),
        of(most, (FASTER * seen).min(rate)),
        of(most, rate),
    ];
    rigs.dedup();
    rigs
}
