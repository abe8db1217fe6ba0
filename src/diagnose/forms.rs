//! Laws of several forms: a sensor or a load cell, a spring in the load path or across the joint.

use super::refinements::refined;
use super::trials::{PROMISING, Trial, scored};
use crate::causes::Scale;
use crate::identify::{Fit, Problem, Score, refit};
use crate::joint::effect::Acting;
use rayon::prelude::*;

/// Of the scores behind the first `count` the best of every form that those before it do not have: which of several
/// forms a law takes, first order tells less well than its size.
pub(super) fn of_other_forms(scores: &[Score], count: usize) -> impl Iterator<Item = &Score> {
    let behind = scores.iter().enumerate().skip(count);
    behind
        .filter(move |(i, s)| scores[..*i].iter().all(|before| form(before) != form(s)))
        .map(|(_, s)| s)
}

/// The form of a law that a score begins with: which of its values are not zero.
fn form(score: &Score) -> Vec<bool> {
    score.acting.values.iter().map(|v| *v != 0.0).collect()
}

/// Scores sorted into forms, these and theirs in the order given.
pub(super) fn by_form<'a>(scores: &[&'a Score]) -> Vec<Vec<&'a Score>> {
    let mut forms: Vec<Vec<&Score>> = Vec::new();
    for score in scores {
        match forms.iter_mut().find(|own| form(own[0]) == form(score)) {
            Some(own) => own.push(score),
            None => forms.push(vec![score]),
        }
    }
    forms
}

/// Causes that were tried beside a set, each in its likeliest form that acts at another place than the one that did
/// best: a load cell that bends instead of a sensor, a spring across the joint instead of one in its load path.
pub(super) fn at_other_places(
    problem: &Problem,
    scale: &Scale,
    current: &Fit,
    trials: &[Trial],
) -> Vec<Trial> {
    let tried = |a: &Acting| {
        let mut own = trials.iter().filter(|t| t.plausible);
        own.find_map(|t| t.own().filter(|own| own.effect.name() == a.effect.name()))
    };
    let elsewhere = |a: &Acting| tried(a).is_some_and(|own| own.places().ne(a.places()));
    let scored = scored((|_| true, elsewhere), problem, scale, current);
    let best = scored
        .iter()
        .filter_map(|(cause, scores)| Some((*cause, scores.first()?)));
    let best: Vec<_> = best.filter(|(_, s)| s.fall > PROMISING).collect();
    let refits = best.into_par_iter().map(|(cause, score)| {
        let mut effects = current.effects.clone();
        effects.push(score.acting.clone());
        let fit = refit(problem, current, effects);
        let fit = refined((problem, scale), cause, current.misfit, fit);
        Trial::of((problem, scale), cause, current, fit)
    });
    refits.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;

    /// Two shapes of one form, then the first of each other.
    #[test]
    fn of_a_law_of_several_forms_each_is_tried() {
        let effect = find("sensor_delay").unwrap().effect();
        let score = |values: [f64; 3], fall: f64| Score {
            acting: Acting {
                effect,
                values: values.to_vec(),
            },
            fall,
        };
        let scores = [
            score([1.0, 0.0, 0.0], 9.0),
            score([2.0, 0.0, 0.0], 8.0),
            score([3.0, 0.0, 0.0], 7.0),
            score([0.0, 1.0, 0.0], 6.0),
            score([0.0, 2.0, 0.0], 5.0),
            score([0.0, 0.0, 1.0], 4.0),
        ];
        let falls: Vec<f64> = of_other_forms(&scores, 2).map(|s| s.fall).collect();
        assert_eq!(falls, [6.0, 4.0]);
        assert_eq!(of_other_forms(&scores, 6).count(), 0);
        let all: Vec<&Score> = scores.iter().collect();
        let sizes: Vec<usize> = by_form(&all).iter().map(Vec::len).collect();
        assert_eq!(sizes, [3, 2, 1]);
    }
}
