//! Probabilities of the causes: what the evidence is worth where no law is quite true.

use super::search::Found;
use crate::identify::Problem;
use crate::joint::effect::Acting;

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
/// share one weight, as they are one hypothesis together, of what they take away together, and one in whose place
/// others do as well shares it with them. Where nothing is named although the evidence
/// is there, held-out cycles spoke against it, and "none" weighs no less.
pub fn probabilities(problem: &Problem, found: &Found, left: f64) -> Vec<f64> {
    weighed(&evidence(found), &Named::of(problem, found), left)
}

/// Probability that something which is not in the catalogue is at work, by the same weights.
pub fn unlisted(problem: &Problem, found: &Found, left: f64) -> f64 {
    let listed: Vec<(&str, f64)> = evidence(found);
    let named = Named::of(problem, found);
    (UNLISTED + left / LEFT) / total(&listed, &named, left)
}

fn evidence(found: &Found) -> Vec<(&str, f64)> {
    let both = found.trials.iter().map(|t| (t.cause.name(), t.evidence));
    both.collect()
}

/// The causes that are named, with what they bring together.
#[derive(Debug, Clone, Default)]
struct Named<'a> {
    /// Each with those that do as well in its place.
    places: Vec<(&'a str, Vec<&'a str>)>,
    /// Penalised fall of the misfit.
    evidence: f64,
}

impl<'a> Named<'a> {
    fn of(problem: &Problem, found: &'a Found) -> Named<'a> {
        let effects = found.best.effects.iter().zip(&found.rivals);
        let of_place = |(acting, rivals): (&'a Acting, &'a Vec<String>)| {
            let rivals = rivals.iter().map(String::as_str).collect();
            (acting.effect.name(), rivals)
        };
        Named {
            places: effects.map(of_place).collect(),
            evidence: found.brings(problem),
        }
    }

    fn has(&self, name: &str) -> bool {
        self.places.iter().any(|(own, _)| *own == name)
    }

    /// Part of the weight of the named causes that is this one's. A single one is held against its rivals by the
    /// evidence of each; of those in one place of several all that is known is that they do as well.
    fn share(&self, name: &str) -> f64 {
        let several = self.places.len() > 1;
        let of_place = |(own, rivals): &(&str, Vec<&str>)| match several {
            true if *own == name || rivals.contains(&name) => 1.0 / (1 + rivals.len()) as f64,
            false if *own == name => 1.0,
            _ => 0.0,
        };
        self.places.iter().map(of_place).fold(0.0, f64::max)
    }
}

fn weighed(evidence: &[(&str, f64)], named: &Named, left: f64) -> Vec<f64> {
    let total = total(evidence, named, left);
    let weight = tempered(evidence, named);
    let one = |(name, e): &(&str, f64)| match named.has(name) {
        true => named.share(name),
        false => weight(*e).max(named.share(name)),
    };
    evidence.iter().map(|pair| one(pair) / total).collect()
}

/// Weight of an evidence over that of the best.
fn tempered(evidence: &[(&str, f64)], named: &Named) -> impl Fn(f64) -> f64 + use<> {
    let together = named.evidence.max(0.0);
    let best = evidence.iter().fold(together, |most, (_, e)| most.max(*e));
    let temperature = temperature(best);
    move |e: f64| (0.5 * (e - best) / temperature).exp()
}

/// What differences of evidence are divided by where a law takes so much misfit away: `T = 1 + brought LAW/2`.
pub(super) fn temperature(brought: f64) -> f64 {
    1.0 + 0.5 * brought * LAW
}

/// Sum of the weights of all hypotheses.
fn total(evidence: &[(&str, f64)], named: &Named, left: f64) -> f64 {
    let weight = tempered(evidence, named);
    let others = evidence.iter().filter(|(name, _)| !named.has(name));
    let rest: f64 = others.map(|(_, e)| weight(*e)).sum();
    // Of "none" and the named set one weighs as much as the best.
    let (none, set) = match named.places.is_empty() {
        true => (1.0, 0.0),
        false => (weight(0.0), 1.0),
    };
    rest + none + set + UNLISTED + left / LEFT
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Causes without rivals, that bring so much together.
    fn set<'a>(names: &[&'a str], evidence: f64) -> Named<'a> {
        Named {
            places: names.iter().map(|name| (*name, Vec::new())).collect(),
            evidence,
        }
    }

    /// The best alone may be neither of two that explain all together.
    #[test]
    fn what_does_best_alone_is_no_rival_of_a_set_that_does_more() {
        let alone = [("c", 700.0), ("a", 500.0), ("b", 200.0)];
        let weights = weighed(&alone, &set(&["a", "b"], 900.0), 0.0);
        assert!(weights[0] < 1e-3 && weights[1] > 0.98 && weights[1] == weights[2]);
        // Where they do no more than it does, the three are two hypotheses.
        let even = weighed(&alone, &set(&["a", "b"], 700.0), 0.0);
        assert!((even[0] - 0.5).abs() < 0.01 && even[0] == even[1]);
    }

    #[test]
    fn who_does_as_well_in_one_place_of_several_shares_it() {
        let named = Named {
            places: vec![("a", vec!["c"]), ("b", Vec::new())],
            evidence: 900.0,
        };
        let alone = [("a", 500.0), ("b", 200.0), ("c", -9.0), ("d", -9.0)];
        let weights = weighed(&alone, &named, 0.0);
        assert!((weights[0] - 0.5).abs() < 0.01 && weights[1] > 0.98);
        assert!(weights[2] == weights[0] && weights[3] < 1e-3);
    }

    #[test]
    fn evidence_decides_until_the_laws_are_not_true_enough() {
        let short = weighed(&[("a", 60.0), ("b", 40.0)], &set(&["a"], 60.0), 0.0);
        assert!(short[0] > 0.98 && short[1] < 1e-3);
        // The same difference beside a fall of ten million says nothing.
        let named = set(&["a"], 10_000_060.0);
        let long = weighed(&[("a", 10_000_060.0), ("b", 10_000_040.0)], &named, 0.0);
        assert!((long[0] / long[1] - 1.0).abs() < 0.01);
    }

    #[test]
    fn what_is_left_speaks_for_something_unlisted() {
        let named = set(&["a"], 5000.0);
        let all = weighed(&[("a", 5000.0), ("b", -9.0)], &named, 0.0);
        let most = weighed(&[("a", 5000.0), ("b", -9.0)], &named, LEFT);
        assert!(all[0] > 0.98 && (most[0] - 0.5).abs() < 0.01);
    }

    #[test]
    fn a_name_that_was_not_given_is_less_likely_than_none() {
        let rejected = weighed(&[("a", 5000.0), ("b", -9.0)], &Named::default(), 0.0);
        assert!(rejected[0] < 0.5);
        let together = weighed(
            &[("a", 900.0), ("b", 200.0)],
            &set(&["a", "b"], 1000.0),
            0.0,
        );
        assert!(together[0] > 0.98 && together[0] == together[1]);
    }
}
