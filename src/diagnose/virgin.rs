//! Records of virgin joints before any search: the baseline, every cause alone, and other beginnings worth a search.

use super::coarsely::trials;
use super::first_turns::tells_of_first_turns_alone;
use super::growing::{leaves_structure, noise_alone};
use super::investigation::Investigation;
use super::prepare::{Bench, prepare};
use super::search::alone;
use super::searched::SEARCHING;
use super::taught::left_on_own_cells;
use super::trials::{ALARM, Effort, Trial, one_leaves, penalty};
use crate::identify::beginning::{Beginning, at_zero, beginnings};
use crate::identify::{Fit, Form, Problem, baseline};
use crate::record::Record;
use rayon::prelude::*;

/// Records of virgin joints before any search.
pub(super) struct Virgin {
    pub(super) bench: Bench,
    pub(super) first: Fit,
    /// Other beginnings that are worth a search, once they were [sought](Virgin::seek_beginnings).
    pub(super) others: Vec<Vec<Beginning>>,
    /// Every cause alone, where that was asked.
    pub(super) alone: Option<Vec<Trial>>,
}

impl Virgin {
    /// Every cause is asked alone where records that start at zero show structure.
    pub(super) fn of(
        (form, records): (Form, &[Record]),
        timed: bool,
        progress: &mut impl FnMut(&str),
    ) -> Virgin {
        progress("noise and baseline");
        let virgin = vec![Beginning::default(); records.len()];
        let bench = prepare(form, records, &virgin);
        let first = baseline(&bench.train);
        let train = &bench.train;
        let mut inputs = (0..records.len()).map(|k| train.channels(k).0);
        let asked =
            inputs.all(at_zero) && bench.noise_is_repeated() && leaves_structure(train, &first);
        let alone = asked.then(|| {
            progress(SEARCHING);
            alone(&bench, timed, &first)
        });
        Virgin {
            bench,
            first,
            others: Vec::new(),
            alone,
        }
    }

    /// Seeks the other beginnings.
    ///
    /// Who starts at zero has a joint without a past as a rule: where one cause leaves noise alone of such records, and
    /// not of their first turns only, nothing is asked of what they went through before.
    pub(super) fn seek_beginnings(&mut self) {
        let doubted = !self.likeliest_alone().is_some_and(|t| self.does_alone(t));
        self.others = beginnings(&self.bench.train, &self.first, doubted);
    }

    /// Of the causes that were asked alone the one that leaves least.
    pub(super) fn likeliest_alone(&self) -> Option<&Trial> {
        let all = self.alone.iter().flatten();
        let own = all.filter(|t| t.plausible);
        own.min_by(|a, b| a.fit.misfit.total_cmp(&b.fit.misfit))
    }

    /// True where a cause leaves noise alone, and does not tell of first turns only.
    fn does_alone(&self, trial: &Trial) -> bool {
        let leaves = trial.fit.misfit;
        let noise = leaves < noise_alone(&self.bench.train, &self.first);
        noise && !tells_of_first_turns_alone(&self.bench, &trial.fit)
    }

    /// True where causes were asked alone and none leaves noise alone.
    pub(super) fn no_cause_explains(&self) -> bool {
        let train = &self.bench.train;
        let asked = self.alone.as_ref();
        asked.is_some_and(|alone| !leaves_noise(train, &self.first, alone))
    }

    /// True where one cause of a virgin joint leaves as little as a past alone does, but for what that costs.
    ///
    /// A single cause that takes the better part may leave as little on cells that suit it.
    pub(super) fn one_cause_does(&self, past: &Investigation, timed: bool) -> bool {
        let Virgin { bench, first, .. } = self;
        let sought: usize = past.beginnings().map(Beginning::values).sum();
        let beyond = 2.0 * ALARM + penalty(&past.bench.train, sought);
        let near = past.found.best.misfit + beyond * past.dispersion();
        let half = 0.5 * (first.misfit + near);
        let asked_now;
        let singles = match &self.alone {
            Some(known) => known,
            None => {
                let asked = (Effort::Full, half);
                asked_now = trials(&bench.train, &bench.scale, timed, first, asked);
                &asked_now
            }
        };
        let suits = |t: &Trial| {
            t.plausible && t.fit.misfit < half && left_on_own_cells(&bench.train, &t.fit) < near
        };
        one_leaves(singles, near) || singles.par_iter().any(suits)
    }
}

/// True where one of these causes alone leaves noise alone.
pub(super) fn leaves_noise(train: &Problem, plain: &Fit, alone: &[Trial]) -> bool {
    one_leaves(alone, noise_alone(train, plain))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::causes::find;
    use crate::joint::effect::Acting;
    use crate::record::noise::tests::drawn;
    use std::f64::consts::TAU;

    /// A virgin joint in white noise whose limits follow the force, which reads so much at rest.
    pub(in crate::diagnose) fn pressed(zero: f64) -> Record {
        let level = |i: usize| [0.6, 0.8, 1.0, 0.7][i / 400];
        let mut record = Record {
            name: "pressed".to_string(),
            displacement: vec![0.0; 1600],
            force: (0..1600)
                .map(|i| level(i) * (TAU * i as f64 / 80.0).sin())
                .collect(),
            time: Some((0..1600).map(|i| 0.01 * f64::from(i)).collect()),
            ..Record::default()
        };
        let plain = Problem::new(Form::Play, std::slice::from_ref(&record));
        let mut joint = vec![0.02; plain.operators.columns()];
        joint[0] = 1.0;
        let effect = find("normal_load_variation").unwrap().effect();
        let mut values = vec![0.0; effect.parameters().len()];
        values[0] = 0.4;
        let mut noise = drawn(20261130);
        let answer = &plain.predict(&joint, &[Acting { effect, values }])[0].judged;
        record.displacement = answer.iter().map(|u| u + 0.01 * noise()).collect();
        record.force.iter_mut().for_each(|f| *f += zero);
        record
    }

    /// What one cause leaves noise alone of is asked for no loads before it, which would take a search of their own.
    #[test]
    fn records_from_zero_that_one_cause_explains_are_asked_for_no_past() {
        let records = [pressed(0.0)];
        let mut virgin = Virgin::of((Form::Play, &records), true, &mut |_| {});
        let doubted = beginnings(&virgin.bench.train, &virgin.first, true);
        assert!(!doubted.is_empty());
        virgin.seek_beginnings();
        assert_eq!(virgin.others, Vec::<Vec<Beginning>>::new());
        // Where nothing was asked alone, nothing speaks against a past.
        virgin.alone = None;
        virgin.seek_beginnings();
        assert_eq!(virgin.others, doubted);
    }
}
