//! First turns of records, which may follow from loads before them.

use super::investigation::Investigation;
use super::prepare::Bench;
use super::search::Begun;
use super::searched::searched;
use super::trials::{ALARM, dispersion};
use crate::identify::beginning::{at_zero, early};
use crate::identify::{Fit, Problem, baseline, refit, without};

/// Share of a record that is left behind its first turns where those are taken for no witnesses.
const LEFT: f64 = 0.5;

impl Investigation {
    /// True where a cause brings nothing behind the first turns: it may do the work of loads before the record, which
    /// are forgotten by then.
    pub(super) fn tells_of_first_turns_alone(&self) -> bool {
        tells_of_first_turns_alone(&self.bench, &self.found.best)
    }

    /// The same, searched anew behind the first turns of records that do not begin at zero and are without a past:
    /// what they went through was sought, but nothing told it beside the noise. A cause is not to rest on it.
    pub(super) fn behind_unknown_pasts(
        self,
        timed: bool,
        progress: &mut impl FnMut(&str),
    ) -> Investigation {
        if self.found.best.effects.is_empty() {
            return self;
        }
        let Some(behind) = behind_unknown(&self.bench) else {
            return self;
        };
        progress("once more: what records went through that do not begin at zero is not known");
        let plain = baseline(&behind.train);
        searched(
            behind,
            (plain, Begun::default()),
            (timed, f64::INFINITY),
            progress,
        )
    }
}

/// The same of one fit.
pub(super) fn tells_of_first_turns_alone(bench: &Bench, fit: &Fit) -> bool {
    let behind = behind(bench, |_, _| true);
    let train = &behind.train;
    let best = refit(train, fit, fit.effects.clone());
    let margin = ALARM * dispersion(train, &best);
    let brings = |place| suited_without(train, &best, place) - best.misfit;
    (0..fit.effects.len()).any(|place| brings(place) < margin)
}

/// The bench with the first turns of every record that is wanted, by its place and how many samples they are, as no
/// witnesses.
fn behind(bench: &Bench, wanted: impl Fn(usize, usize) -> bool) -> Bench {
    let mut behind = bench.clone();
    for (k, unsure) in behind.unsure.iter_mut().enumerate() {
        let early = early(bench.train.channels(k).0);
        if wanted(k, early) {
            *unsure = early;
        }
    }
    behind.weigh(bench.noise.clone());
    behind
}

/// The same of every record that does not begin at zero and is without a past, where enough is left behind them; `None`
/// where there is no such record.
fn behind_unknown(bench: &Bench) -> Option<Bench> {
    let unknown = |k: usize, early: usize| {
        let (input, _) = bench.train.channels(k);
        let begins = &bench.train.records[k].beginning;
        let most = (1.0 - LEFT) * input.len() as f64;
        begins.turned.is_empty() && !begins.goes_on && !at_zero(input) && early as f64 <= most
    };
    let behind = behind(bench, unknown);
    (behind.unsure != bench.unsure).then_some(behind)
}

/// What is left without one of the effects, the others refitted.
fn suited_without(train: &Problem, best: &Fit, place: usize) -> f64 {
    let less = without(train, best, place);
    refit(train, &less, less.effects.clone()).misfit
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::identify::Form;
    use crate::identify::beginning::Beginning;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// A sine of 200 samples a second and ten cycles, from a share of its period on.
    fn of_sine(begins: f64) -> Bench {
        let time: Vec<f64> = (0..2000).map(|i| 0.01 * f64::from(i)).collect();
        let turn = |t: f64| std::f64::consts::TAU * (0.5 * t + begins);
        let force: Vec<f64> = time.iter().map(|t| 80.0 * turn(*t).sin()).collect();
        let record = Record {
            name: "sine".to_string(),
            displacement: force.iter().map(|force| 1e-8 * force).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        prepare(Form::Play, &[record], &[Beginning::default()])
    }

    #[test]
    fn a_record_that_does_not_begin_at_zero_is_no_witness_before_it_has_turned_twice() {
        assert!(behind_unknown(&of_sine(0.0)).is_none());
        // From half the way up: the valley comes 5/6 - 1/4 of a period of two seconds later, and its sample.
        let begun = behind_unknown(&of_sine(1.0 / 12.0)).unwrap();
        let weight = &begun.train.records[0].weight;
        let first = weight.iter().position(|w| *w > 0.0).unwrap();
        assert_eq!(first, 134);
    }

    #[test]
    fn a_jump_within_the_first_turns_may_be_a_past_and_one_behind_them_is_none() {
        for (jumps_at, tells) in [(0.5, true), (9.0, false)] {
            let mut noise = drawn(20261127);
            let time: Vec<f64> = (0..2000).map(|i| 0.01 * f64::from(i)).collect();
            let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.0 * t).sin()).collect();
            let jump = |t: f64| if t > jumps_at { 0.5 } else { 0.0 };
            let both = time.iter().zip(&force);
            let record = Record {
                name: "jump".to_string(),
                displacement: both
                    .map(|(t, force)| 1e-8 * (force + jump(*t)) + 1e-9 * noise())
                    .collect(),
                force,
                time: Some(time),
                ..Record::default()
            };
            let bench = prepare(Form::Play, &[record], &[Beginning::default()]);
            let first = baseline(&bench.train);
            let found = searched(
                bench,
                (first, Begun::default()),
                (true, f64::INFINITY),
                &mut |_| (),
            );
            let effects = &found.found.best.effects;
            assert_eq!(effects[0].effect.name(), "offset_step");
            assert_eq!(found.tells_of_first_turns_alone(), tells, "{jumps_at} s");
        }
    }
}
