//! A named cause has to predict: each is taken back that does not lower the error on held-out
//! cycles beside the others.

use super::gain::ratio;
use super::places::{beyond_scatter, scatter};
use super::prepare::Bench;
use super::trials::{ALARM, all_plausible, dispersion, penalty};
use crate::identify::{Fit, refit};

/// The set without the causes that gain nothing on held-out data.
///
/// A single cause has to lower the held-out error or most of the misfit, and where all samples together do not make it
/// evident, the held-out error beyond its scatter (95 % interval of the bootstrap) or so far that chance would once in
/// forty. Every one of several has to lower it beyond the scatter of the held-out cycles (95 % interval of the
/// bootstrap): the more causes, the more ways to mend by one what another's law is wrong about. One that takes most of
/// the misfit away, and a substantial part of the baseline's, stays: what happens once, or at one rate,
/// few held-out cycles show. So does one of a set that leaves noise alone, by which held-out samples
/// are likelier than chance makes them once in forty: of a few cycles, or of slow noise, a bootstrap tells little.
pub fn tested(bench: &Bench, baseline: &Fit, mut fit: Fit) -> Fit {
    let beyond = baseline.misfit - bench.train.rows() as f64;
    let substantial = SUBSTANTIAL * beyond;
    while fit.effects.len() > 1 {
        // Of a set that leaves noise alone nothing but noise makes a gain by chance.
        let noise_alone =
            beyond_scatter(&bench.train, &fit) <= 0.0 && unseen_beyond_scatter(bench, &fit) <= 0.0;
        let after = fit.predict(&bench.train);
        let weakest = (0..fit.effects.len())
            .map(|place| {
                let mut others = fit.effects.clone();
                others.remove(place);
                let less = refit(&bench.train, &fit, others);
                let (value, interval) = ratio(bench, &less.predict(&bench.train), &after);
                let prospect = Prospect::of(bench, &less, &fit);
                let telling = prospect.dominates() && prospect.fitted > substantial;
                let upper = match telling || noise_alone && prospect.is_likelier() {
                    true => 0.0,
                    false => interval.map_or(value, |(_, upper)| upper),
                };
                (upper, less)
            })
            .filter(|(_, less)| all_plausible(&bench.scale, less))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match weakest {
            Some((upper, less)) if upper >= 1.0 => fit = less,
            _ => return fit,
        }
    }
    let evidence = (baseline.misfit - fit.misfit) / dispersion(&bench.train, &fit)
        - penalty(&bench.train, fit.free());
    let proven = || {
        let both = [baseline, &fit].map(|f| f.predict(&bench.train));
        let (_, interval) = ratio(bench, &both[0], &both[1]);
        interval.is_none_or(|(_, upper)| upper < 1.0)
    };
    let holds = || {
        let prospect = Prospect::of(bench, baseline, &fit);
        let evident = evidence + prospect.held_out > ALARM;
        prospect.holds() && (evident || prospect.is_likelier() || proven())
    };
    if fit.effects.is_empty() || holds() {
        fit
    } else {
        baseline.clone()
    }
}

/// Likelihood ratio of held-out samples that chance reaches as rarely as a bootstrap's interval of 95 % misses at one end.
const LIKELIER: f64 = 40.0;

/// Difference that two models make on held-out samples, in noise variances, below which those
/// samples cannot tell them apart: right and wrong differ by twice it, with four standard deviations
/// between them.
const TELLING: f64 = 16.0;

/// Share of the misfit beyond noise from which a cause is named although held-out cycles are
/// predicted worse: its law then goes on differently from the joint's, but nothing else is at work.
const DOMINANT: f64 = 0.5;

/// Share of the fall of the misfit that the squared errors have to fall by. Judged: a cause that acts as loads do falls
/// by as much beside white noise and by far more beside slow noise; what a prescribed displacement's own noise
/// does to a force, by a sixth or none.
const SLOW: f64 = 0.25;

/// Squared error of held-out samples beyond their noise, in noise variances.
pub fn beyond_unseen(bench: &Bench, fit: &Fit) -> f64 {
    let predictions = fit.predict(&bench.train);
    let mut beyond = 0.0;
    each_unseen(bench, |k, i, measured, weight| {
        let error = measured - predictions[k].judged[i];
        beyond += weight * (error.powi(2) - bench.noise[k].deviation.powi(2));
    });
    beyond
}

/// Squared error of held-out samples beyond what noise alone leaves, its scatter included.
pub fn unseen_beyond_scatter(bench: &Bench, fit: &Fit) -> f64 {
    beyond_unseen(bench, fit) - scatter(unseen_rows(bench))
}

/// Held-out samples, neighbours that vary together as fewer.
pub fn unseen_rows(bench: &Bench) -> f64 {
    let mut rows = 0.0;
    each_unseen(bench, |k, _, _, weight| {
        rows += weight * bench.noise[k].deviation.powi(2);
    });
    rows
}

/// Every held-out sample: its record and index, the measured value, and what its square weighs in noise
/// variances, neighbours that vary together as fewer.
pub(super) fn each_unseen(bench: &Bench, mut each: impl FnMut(usize, usize, f64, f64)) {
    for (k, held) in bench.held.iter().enumerate() {
        let (_, judged) = bench.whole.channels(k);
        let noise = &bench.noise[k];
        let weight = noise.colour.independence() / noise.deviation.powi(2);
        for i in (0..held.len()).filter(|&i| bench.is_unseen(k, i)) {
            each(k, i, judged[i], weight);
        }
    }
}

/// Share of the baseline's misfit beyond noise that no other cause's law is wrong by.
const SUBSTANTIAL: f64 = 1.0 / 3.0;

/// What a larger set of causes does on fitted and on held-out samples, in noise variances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prospect {
    /// Fall of the misfit on fitted samples.
    fitted: f64,
    /// Fall of the squared error itself on fitted samples: where noise is slow, what a misfit of innovations shows may
    /// be what the drive's own noise does from sample to sample.
    slow: f64,
    /// Fall of the squared error on held-out samples.
    held_out: f64,
    /// Square of the difference between the two predictions of held-out samples.
    difference: f64,
    /// Misfit of the smaller set beyond the noise, on fitted samples.
    beyond: f64,
    /// What noise alone may leave beyond.
    scatter: f64,
}

impl Prospect {
    /// Compares a set with the smaller one it has grown from.
    ///
    /// Held-out samples that neither predicts as well as fitted ones are predicted, as of loads that no fitted sample has
    /// shown, count for as much less: what is wrong there says little of either.
    pub fn of(bench: &Bench, smaller: &Fit, larger: &Fit) -> Prospect {
        let (before, after) = (smaller.predict(&bench.train), larger.predict(&bench.train));
        let mut prospect = Prospect {
            fitted: smaller.misfit - larger.misfit,
            slow: 0.0,
            held_out: 0.0,
            difference: 0.0,
            beyond: smaller.misfit - bench.train.rows() as f64,
            scatter: scatter(bench.train.rows() as f64),
        };
        let (mut without, mut with) = (0.0, 0.0);
        each_unseen(bench, |k, i, measured, weight| {
            let (old, new) = (before[k].judged[i], after[k].judged[i]);
            without += weight * (measured - old).powi(2);
            with += weight * (measured - new).powi(2);
            prospect.difference += weight * (new - old).powi(2);
        });
        let rows = unseen_rows(bench).max(1.0);
        let unforeseen = (with.min(without) - scatter(rows)) / rows;
        let doubt = (unforeseen / dispersion(&bench.train, larger)).max(1.0);
        prospect.held_out = (without - with) / doubt;
        prospect.difference /= doubt;
        for (k, record) in bench.train.records.iter().enumerate() {
            let (_, judged) = bench.train.channels(k);
            let error = |of: f64, i: usize| ((judged[i] - of) / bench.noise[k].deviation).powi(2);
            for i in (0..judged.len()).filter(|&i| record.counts(i)) {
                prospect.slow += error(before[k].judged[i], i) - error(after[k].judged[i], i);
            }
        }
        prospect
    }

    /// Fall on fitted and held-out samples together.
    pub fn total(&self) -> f64 {
        self.fitted + self.held_out
    }

    /// False where held-out samples could have shown the set to be better and show it to be worse,
    /// unless it takes most of the misfit away; and where the errors themselves on fitted ones do not fall.
    pub fn holds(&self) -> bool {
        let unseen = self.difference < TELLING || self.dominates();
        self.slow > SLOW * self.fitted && unseen || self.slow > 0.0 && self.held_out > 0.0
    }

    /// Twice the logarithm of how much likelier held-out samples are by the larger set; none where they are not.
    ///
    /// What was fitted without them owes them nothing: they are x times as likely by chance once in x records at most.
    pub fn held_out_evidence(&self) -> f64 {
        self.held_out.max(0.0)
    }

    /// True where held-out samples are that much likelier by the larger set that one in forty would be by chance.
    pub fn is_likelier(&self) -> bool {
        self.held_out_evidence() > 2.0 * LIKELIER.ln()
    }

    /// True where the set takes most of the misfit beyond noise away, held-out samples included, and the errors
    /// themselves fall. What it takes is beyond noise by itself where the noise was told too large to leave any.
    pub fn dominates(&self) -> bool {
        self.fitted > DOMINANT * self.beyond
            && self.beyond.max(self.fitted) > self.scatter
            && self.total() > 0.0
            && self.slow > SLOW * self.fitted
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::joint::effect::Acting;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// Share to which held-out samples count for a cubic spring where they hold what no fitted one has shown, so many
    /// times as large as the noise.
    fn counted(unforeseen: f64) -> f64 {
        let mut noise = drawn(20261127);
        let time: Vec<f64> = (0..4000).map(|i| 0.01 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.1 * t).sin()).collect();
        let heard = force.iter().map(|f| 1e-8 * (f + noise() - 0.5));
        let mut record = Record {
            name: "unforeseen".to_string(),
            displacement: heard.collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let virgin = [Beginning::default()];
        let calm = prepare(Form::Play, std::slice::from_ref(&record), &virgin);
        for i in (0..record.len()).filter(|&i| calm.is_unseen(0, i)) {
            record.displacement[i] += 3e-9 * unforeseen * (0.9 * i as f64).sin();
        }
        let bench = prepare(Form::Play, &[record], &virgin);
        let smaller = baseline(&bench.train);
        let effect = find("cubic_stiffness").unwrap().effect();
        let larger = Fit {
            effects: vec![Acting {
                effect,
                values: vec![2e-15, 0.0, 0.0, 0.0, 0.0, 0.0],
            }],
            ..smaller.clone()
        };
        let beyond = |fit: &Fit| beyond_unseen(&bench, fit);
        let prospect = Prospect::of(&bench, &smaller, &larger);
        prospect.held_out / (beyond(&smaller) - beyond(&larger))
    }

    #[test]
    fn what_no_model_foresees_says_little_of_any() {
        let (calm, unforeseen) = (counted(0.0), counted(20.0));
        assert!((calm - 1.0).abs() < 0.05, "{calm}");
        assert!((0.0..0.02).contains(&unforeseen), "{unforeseen}");
    }

    /// Noise told 1.3 % too large, a cause that takes 360 noise variances and tells nothing of the cycles held out.
    #[test]
    fn what_takes_more_than_noise_scatters_by_holds_however_large_the_noise_is_told() {
        let prospect = |fitted: f64| Prospect {
            fitted,
            slow: fitted,
            held_out: -2.0,
            difference: 26.0,
            beyond: 150.0,
            scatter: 190.0,
        };
        assert!(prospect(360.0).holds());
        // As much as noise may do.
        assert!(!prospect(100.0).holds());
    }
}
