//! What a dummy shows by itself, whatever the records ask of it: that it is no solid specimen, or what the measuring
//! chain does to it.

use super::dummy::{Dummy, Ruling};
use crate::causes::{CATALOGUE, Kind};
use crate::diagnose::sizes::sizes;
use crate::diagnose::trials::{ALARM, dispersion};
use crate::identify::{Fit, Problem, baseline, refit, scores};
use crate::joint::effect::Acting;
use crate::record::Record;

/// Starts of a cause that are refitted, the best by their scores.
const REFITTED: usize = 2;

/// Share of what a spring leaves beyond the noise that slip has to take away to be what the dummy does.
const MOST_OF_IT: f64 = 0.5;

/// A dummy as a spring, beside each cause of the measuring chain and beside slip.
pub struct Alone {
    /// Said where it slips as no solid specimen does.
    pub slips: Option<Dummy>,
    /// Fall of its misfit with each cause of the chain, in noise variances.
    falls: Vec<(&'static str, f64)>,
}

impl Alone {
    /// Fits the dummy's record, `plain` as a spring.
    pub fn of(problem: &Problem, plain: &Fit, dummy: &Record) -> Alone {
        let scale = sizes(problem, plain);
        let timed = dummy.time.is_some();
        let chain = CATALOGUE
            .iter()
            .filter(|cause| cause.kind() == Kind::Measurement && cause.is_told(timed));
        let fits: Vec<(&'static str, f64, f64)> = chain
            .map(|cause| {
                let starts = cause.starts(&scale).into_iter();
                let starts = starts.filter(|values| values.iter().all(|v| v.is_finite()));
                let starts: Vec<Acting> = starts
                    .map(|values| Acting {
                        effect: cause.effect(),
                        values,
                    })
                    .collect();
                let mut scored = scores(problem, plain, &starts);
                scored.sort_by(|a, b| b.fall.total_cmp(&a.fall));
                let fits = scored
                    .iter()
                    .take(REFITTED)
                    .map(|score| refit(problem, plain, vec![score.acting.clone()]));
                let best = fits.min_by(|a, b| a.misfit.total_cmp(&b.misfit));
                match best.filter(|fit| fit.misfit < plain.misfit) {
                    Some(fit) => {
                        let fall = (plain.misfit - fit.misfit) / dispersion(problem, &fit);
                        (cause.name(), fall, fit.misfit)
                    }
                    None => (cause.name(), 0.0, plain.misfit),
                }
            })
            .collect();
        let least = fits.iter().map(|f| f.2).fold(plain.misfit, f64::min);
        Alone {
            slips: slips(problem, plain, dummy, least),
            falls: fits.into_iter().map(|f| (f.0, f.1)).collect(),
        }
    }

    /// What is to be said beside what the records asked: the cause that the dummy shows all the same, or that it shows
    /// none. Where it shows one that was asked about, what is like that one falls with it, and nothing more is said.
    pub fn beside(&self, said: &[Dummy]) -> Vec<Dummy> {
        if self.slips.is_some() || said.iter().any(|d| d.ruling == Ruling::Shown) {
            return Vec::new();
        }
        let others = self.falls.iter();
        let others = others.filter(|(name, _)| !said.iter().any(|d| d.name == *name));
        let line = |(name, fall): &(&'static str, f64), ruling| Dummy {
            name: (*name).to_string(),
            fall: *fall,
            power: 0.0,
            ruling,
        };
        let most = others.clone().max_by(|a, b| a.1.total_cmp(&b.1));
        match most.filter(|(_, fall)| *fall > ALARM) {
            Some(shown) => vec![line(shown, Ruling::Shown)],
            None => others.map(|other| line(other, Ruling::Absent)).collect(),
        }
    }
}

/// Slip in the dummy, where a joint explains its loop better than any single cause of the chain, which leaves `least`.
fn slips(problem: &Problem, plain: &Fit, dummy: &Record, least: f64) -> Option<Dummy> {
    let mut joint = Problem::new(problem.operators.form, std::slice::from_ref(dummy));
    joint.records.clone_from(&problem.records);
    let slipping = baseline(&joint);
    let variance = dispersion(&joint, &slipping);
    let beyond_noise = plain.misfit - problem.rows() as f64 * variance;
    let taken = plain.misfit - slipping.misfit;
    let better = (least - slipping.misfit) / variance > ALARM;
    (better && taken > MOST_OF_IT * beyond_noise).then(|| Dummy {
        name: "slip".to_string(),
        fall: taken / variance,
        power: (plain.misfit - least) / variance,
        ruling: Ruling::Slips,
    })
}
