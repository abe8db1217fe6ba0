//! What the rig can do: what the records show it doing, unless the user says otherwise.

use super::program::Rig;
use crate::diagnose::prepare::Bench;
use crate::identify::{Form, Prepared};
use crate::record::colour::Colour;
use crate::record::cycles::cycles;

/// Limits given by the user; `None` takes what the records show.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Largest force to either side of zero \[N\].
    pub force: Option<f64>,
    /// Largest displacement to either side of zero \[m\].
    pub displacement: Option<f64>,
    /// Highest rate of a cycle \[Hz\].
    pub rate: Option<f64>,
    /// Longest test \[s\].
    pub duration: Option<f64>,
}

impl Limits {
    /// Limit of the channel that drives.
    pub fn of_drive(&mut self, form: Form) -> &mut Option<f64> {
        match form {
            Form::Play => &mut self.force,
            Form::Stop => &mut self.displacement,
        }
    }

    /// Limit of the channel that answers.
    pub fn of_answer(&self, form: Form) -> Option<f64> {
        match form {
            Form::Play => self.displacement,
            Form::Stop => self.force,
        }
    }
}

/// Least and largest value of a channel.
type Range = (f64, f64);

/// Share of the longer side of a range that the shorter has at least where the range is taken for symmetric: what a
/// controller misses a turn by, and what a sensor's zero is off by.
const EVEN: f64 = 0.95;

/// The range, as wide to either side where it nearly is: a rig that swings about zero is not made to swing about
/// something else for that.
fn evened((lower, upper): Range) -> Range {
    let shorter = upper.min(-lower);
    match shorter >= EVEN * upper.max(-lower) {
        true => (-shorter, shorter),
        false => (lower, upper),
    }
}

/// As far as the records went, and as far as the rig may go. Where the records stay on one side of zero, nobody but
/// the user can say that the rig has another; who names a magnitude names it for both.
fn ranges((lower, upper): Range, given: Option<f64>) -> (Range, Range) {
    let Some(most) = given else {
        return (evened((lower, upper)), evened((lower, upper)));
    };
    let inside = (lower.max(-most), upper.min(most));
    let near = match inside.0 < inside.1 {
        true => evened(inside),
        // The records never were within what the user allows.
        false => (-most, most),
    };
    (near, (-most, most))
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
    let (mut range, mut duration) = ((f64::INFINITY, f64::NEG_INFINITY), 0.0);
    let (mut fastest, mut steps) = (Vec::new(), Vec::new());
    for (k, record) in problem.records.iter().enumerate() {
        let (input, _) = problem.channels(k);
        range = input.iter().fold(range, |(a, b), x| (a.min(*x), b.max(*x)));
        if let (Some(first), Some(last)) = (record.time.first(), record.time.last()) {
            duration += last - first;
        }
        steps.extend(record.steps.iter().skip(1).copied());
        let found = cycles(input);
        let lengths = found
            .iter()
            .map(|c| record.time[c.end.min(input.len() - 1)] - record.time[c.start]);
        fastest.extend(lengths.filter(|l| *l > 0.0).map(f64::recip));
    }
    fastest.sort_by(f64::total_cmp);
    steps.sort_by(f64::total_cmp);
    // Not the very fastest: a cycle cut short by noise is none that the rig was asked for.
    let seen = fastest.get(fastest.len() * 9 / 10).copied();
    let seen = seen.unwrap_or(1.0 / bench.scale.period);
    let rate = limits.rate.unwrap_or(seen);
    let step = steps.get(steps.len() / 2).copied().unwrap_or(1.0);
    let mut own = *limits;
    let (near, far) = ranges(range, *own.of_drive(problem.operators.form));
    // The noisiest of the records as they were measured: nothing is promised beyond it.
    let heavy = |r: &Prepared| r.weight.iter().copied().fold(0.0, f64::max);
    let noisiest = (problem.records.iter()).min_by(|a, b| heavy(a).total_cmp(&heavy(b)));
    let of = |(lower, upper): Range, rate: f64| Rig {
        lower,
        upper,
        rate,
        duration: limits.duration.unwrap_or(duration),
        step: step.min(1.0 / (PER_CYCLE * rate)),
        weight: noisiest.map_or(1.0, heavy),
        colour: noisiest.map_or(Colour::WHITE, |r| r.colour),
    };
    let mut rigs = vec![
        of(near, seen.min(rate)),
        of(near, (FASTER * seen).min(rate)),
        of(far, (FASTER * seen).min(rate)),
        of(far, rate),
    ];
    rigs.dedup();
    rigs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_side_that_no_record_shows_is_the_users_to_open() {
        let tension = (0.0, 4700.0);
        assert_eq!(ranges(tension, None), (tension, tension));
        // Farther on both sides, once what was seen does not settle the question.
        assert_eq!(ranges(tension, Some(6000.0)), (tension, (-6000.0, 6000.0)));
        assert_eq!(
            ranges(tension, Some(2000.0)),
            ((0.0, 2000.0), (-2000.0, 2000.0))
        );
        assert_eq!(ranges((5.0, 9.0), Some(2.0)), ((-2.0, 2.0), (-2.0, 2.0)));
        assert_eq!(ranges((-7.4, 18.4), None).1, (-7.4, 18.4));
    }

    #[test]
    fn a_nearly_symmetric_range_is_symmetric_and_no_wider() {
        assert_eq!(ranges((-98.0, 100.0), None).1, (-98.0, 98.0));
        assert_eq!(ranges((-100.0, 100.0), None).1, (-100.0, 100.0));
        assert_eq!(ranges((-27.3, 23.7), None).1, (-27.3, 23.7));
        assert_eq!(ranges((-900.0, 900.0), Some(800.0)).0, (-800.0, 800.0));
    }
    /// A cycle lasts until the first sample of the next one.
    #[test]
    fn the_rig_is_as_fast_as_the_records_were() {
        let bench = crate::diagnose::search::tests::dashpot(20261128);
        let asked = rigs(&bench, &Limits::default())[0].rate;
        let driven = 5.0 / std::f64::consts::TAU;
        assert!((asked / driven - 1.0).abs() < 0.008, "{asked} {driven}");
    }
}
