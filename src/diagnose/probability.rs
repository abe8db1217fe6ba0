//! Probabilities of the causes: what the evidence is worth where no law is quite true.

use super::search::Found;

/// Share of the misfit a cause takes away to which its law is taken to be right: evidence counts up
/// to one over it and no further, however long the record.
///
/// Found, with [`LEFT`], on drawn cases of a generator whose laws are not the catalogue's.
const LAW: f64 = 0.001;

/// Share of the explainable misfit left by the named causes at which something that is not in the
/// catalogue is as probable as they are.
const LEFT: f64 = 0.25;

/// Weight of what is not in the catalogue where nothing is left, over that of the best.
const UNLISTED: f64 = 0.01;

/// Probability of every trial's cause, in the order of the trials, that it is at work.
///
/// A hypothesis weighs `exp(E/2T)`, with E its penalised fall of the misfit (none: 0) and
/// `T = 1 + E_best LAW/2`: the likelihood tempered by what the laws are wrong about. Something unlisted
/// weighs [`UNLISTED`]` + left/`[`LEFT`] of the best, `left` being the share of the explainable misfit
/// that the named causes leave. Named causes, which predicted unseen cycles best, weigh no less than the best; several
/// share one weight, as they are one hypothesis together. Where nothing is named although the evidence
/// is there, held-out cycles spoke against it, and "none" weighs no less.
pub fn probabilities(found: &Found, left: f64) -> Vec<f64> {
    weighed(&evidence(found), &named(found), left)
}

/// Probability that something which is not in the catalogue is at work, by the same weights.
pub fn unlisted(found: &Found, left: f64) -> f64 {
    let listed: Vec<(&str, f64)> = evidence(found);
    let named = named(found);
    (UNLISTED + left / LEFT) / total(&listed, &named, left)
}

fn evidence(found: &Found) -> Vec<(&str, f64)> {
    let both = found.trials.iter().map(|t| (t.cause.name(), t.evidence));
    both.collect()
}

fn named(found: &Found) -> Vec<&str> {
    let effects = found.best.effects.iter();
    effects.map(|a| a.effect.name()).collect()
}

fn weighed(evidence: &[(&str, f64)], named: &[&str], left: f64) -> Vec<f64> {
    let total = total(evidence, named, left);
    let weight = tempered(evidence);
    let one = |(name, e): &(&str, f64)| match named.contains(name) {
        true => 1.0,
        false => weight(*e),
    };
    evidence.iter().map(|pair| one(pair) / total).collect()
}

/// Weight of an evidence over that of the best.
fn tempered(evidence: &[(&str, f64)]) -> impl Fn(f64) -> f64 {
    let best = evidence.iter().fold(0.0_f64, |most, (_, e)| most.max(*e));
    let temperature = temperature(best);
    move |e: f64| (0.5 * (e - best) / temperature).exp()
}

/// What differences of evidence are divided by where a law takes so much misfit away: `T = 1 + brought LAW/2`.
pub(super) fn temperature(brought: f64) -> f64 {
    1.0 + 0.5 * brought * LAW
}

/// Sum of the weights of all hypotheses.
fn total(evidence: &[(&str, f64)], named: &[&str], left: f64) -> f64 {
    let weight = tempered(evidence);
    let others = evidence.iter().filter(|(name, _)| !named.contains(name));
    let rest: f64 = others.map(|(_, e)| weight(*e)).sum();
    // Of "none" and the named set one weighs as much as the best.
    let (none, set) = match named.is_empty() {
        true => (1.0, 0.0),
        false => (weight(0.0), 1.0),
    };
    rest + none + set + UNLISTED + left / LEFT
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evidence_decides_until_the_laws_are_not_true_enough() {
        let short = weighed(&[("a", 60.0), ("b", 40.0)], &["a"], 0.0);
        assert!(short[0] > 0.98 && short[1] < 1e-3);
        // The same difference beside a fall of ten million says nothing.
        let long = weighed(&[("a", 10_000_060.0), ("b", 10_000_040.0)], &["a"], 0.0);
        assert!((long[0] / long[1] - 1.0).abs() < 0.01);
    }

    #[test]
    fn what_is_left_speaks_for_something_unlisted() {
        let all = weighed(&[("a", 5000.0), ("b", -9.0)], &["a"], 0.0);
        let most = weighed(&[("a", 5000.0), ("b", -9.0)], &["a"], LEFT);
        assert!(all[0] > 0.98 && (most[0] - 0.5).abs() < 0.01);
    }

    #[test]
    fn a_name_that_was_not_given_is_less_likely_than_none() {
        let rejected = weighed(&[("a", 5000.0), ("b", -9.0)], &[], 0.0);
        assert!(rejected[0] < 0.5);
        let together = weighed(&[("a", 900.0), ("b", 200.0)], &["a", "b"], 0.0);
        assert!(together[0] > 0.98 && together[0] == together[1]);
    }
}
