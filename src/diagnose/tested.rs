//! A named cause has to predict: each is taken back that does not lower the error on held-out
//! cycles beside the others.

use super::gain::ratio;
use super::prepare::Bench;
use crate::identify::{Fit, refit};

/// The set without the causes that gain nothing on held-out data.
///
/// A single cause has to lower the held-out error. Every one of several has to do so beyond the
/// scatter of the held-out cycles (95 % interval of the bootstrap): the more causes, the more ways
/// to mend by one what another's law is wrong about.
pub fn tested(bench: &Bench, baseline: &Fit, mut fit: Fit) -> Fit {
    while fit.effects.len() > 1 {
        let after = fit.predict(&bench.train);
        let weakest = (0..fit.effects.len())
            .map(|place| {
                let mut others = fit.effects.clone();
                others.remove(place);
                let less = refit(&bench.train, &fit, others);
                let (value, interval) = ratio(bench, &less.predict(&bench.train), &after);
                (interval.map_or(value, |(_, upper)| upper), less)
            })
            .max_by(|a, b| a.0.total_cmp(&b.0));
        match weakest {
            Some((upper, less)) if upper >= 1.0 => fit = less,
            _ => return fit,
        }
    }
    if fit.effects.is_empty() || predicts(bench, baseline, &fit) {
        return fit;
    }
    baseline.clone()
}

/// True where a set predicts held-out cycles better than the smaller one it has grown from.
pub fn predicts(bench: &Bench, smaller: &Fit, larger: &Fit) -> bool {
    let (before, after) = (smaller.predict(&bench.train), larger.predict(&bench.train));
    ratio(bench, &before, &after).0 < 1.0
}
