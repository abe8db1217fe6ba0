//! Laws of several forms: a sensor or a load cell, a spring in the load path or across the joint.

use super::refinements::refined;
use super::trials::{PROMISING, Trial, alarm, scored, trial_of};
use crate::causes::Scale;
use crate::identify::{Fit, PROSPECT, Problem, Score, glanced, refit};
use crate::joint::effect::Acting;
use rayon::prelude::*;

/// Of the scores behind the first `count` the best of every form that those before it do not have: which of several
/// forms a law takes, first order tells less well than its size.
pub(super) fn of_other_forms(scores: &[Score], count: usize) -> impl Iterator<Item = &Score> {
    let behind = scores.iter().enumerate().skip(count);
    behind
        .filter(move |(i, s)| {
            scores[..*i]
                .iter()
                .all(|before| form(&before.acting) != form(&s.acting))
        })
        .map(|(_, s)| s)
}

/// The form of a law: which of its values are not zero.
pub(super) fn form(acting: &Acting) -> (&'static str, Vec<bool>) {
    let set = acting.values.iter().map(|v| *v != 0.0);
    (acting.effect.name(), set.collect())
}

/// Scores sorted into forms, these and theirs in the order given.
pub(super) fn by_form<'a>(scores: &[&'a Score]) -> Vec<Vec<&'a Score>> {
    let mut forms: Vec<Vec<&Score>> = Vec::new();
    for score in scores {
        match forms
            .iter_mut()
            .find(|own| form(&own[0].acting) == form(&score.acting))
        {
            Some(own) => own.push(score),
            None => forms.push(vec![score]),
        }
    }
    forms
}

/// Steps after which the starts are sorted out that leave more than others.
const FIRST: usize = 2;

/// Fits to begin with, the set's own with one of the scored shapes each, and true where they have a prospect of a
/// misfit below `bound`; of more than `most` those that leave least after their first steps, from where these led. What
/// the answer follows in jumps, slopes lead nowhere: only strides tell its prospect.
pub(super) fn starts(
    problem: &Problem,
    current: &Fit,
    shapes: &[&Score],
    (most, bound): (usize, f64),
) -> Vec<(Fit, bool)> {
    let with = |s: &&Score| {
        let mut effects = current.effects.clone();
        effects.push(s.acting.clone());
        Fit {
            effects,
            ..current.clone()
        }
    };
    let starts = shapes.iter().map(with);
    if shapes.len() <= most {
        return starts.map(|start| (start, true)).collect();
    }
    let glanced = |start: &Fit, steps| glanced(problem, start, start.effects.clone(), steps);
    let starts: Vec<Fit> = starts.collect();
    let mut led: Vec<Fit> = starts.par_iter().map(|s| glanced(s, FIRST)).collect();
    led.sort_by(|a, b| a.misfit.total_cmp(&b.misfit));
    led.truncate(most);
    let onward = led.into_par_iter().map(|led| {
        let next = glanced(&led, 1);
        let prospect = next.misfit - PROSPECT * (led.misfit - next.misfit);
        let jumps = next.effects.last().is_some_and(jumps);
        match prospect < bound || jumps {
            true => {
                let misfit = current.misfit;
                (Fit { misfit, ..next }, true)
            }
            false => (next, false),
        }
    });
    onward.collect()
}

/// True where the answer follows one of the values in small jumps.
fn jumps(acting: &Acting) -> bool {
    let law = acting.effect;
    (0..law.parameters().len()).any(|p| law.jumps_with(p))
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
        let own = trial_of(trials, a.effect.name()).filter(|t| t.plausible);
        own.and_then(Trial::own)
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

impl Trial {
    /// True of a form of a cause that is likelier than another one. A form that tells the spring apart has to be so by what a
    /// cause has to have: less may be what a grid of break-free forces gains by another spring.
    pub(super) fn beats(&self, problem: &Problem, other: &Trial) -> bool {
        let worth = |trial: &Trial| match trial.own().is_some_and(Acting::splits_spring) {
            true => trial.evidence - alarm(problem),
            false => trial.evidence,
        };
        self.own().is_some() && worth(self) > worth(other)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::identify::{Form, baseline};
    use crate::record::Record;

    /// A film between the surfaces, against a dashpot across the joint, of four thousand samples: a tenth of the noise counts.
    #[test]
    fn a_form_that_splits_the_spring_has_to_be_better_by_what_a_cause_has_to_have() {
        let force: Vec<f64> = (0..4000).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let record = Record {
            displacement: force.iter().map(|f| 1e-8 * f).collect(),
            force,
            ..Record::default()
        };
        let problem = Problem::new(Form::Play, &[record]);
        let plain = baseline(&problem);
        let cause = find("viscous_damping").unwrap();
        let trial = |values: [f64; 2], evidence: f64| Trial {
            cause,
            evidence,
            plausible: true,
            fit: Fit {
                effects: vec![Acting {
                    effect: cause.effect(),
                    values: values.to_vec(),
                }],
                ..plain.clone()
            },
        };
        let (across, film) = ([1.0, 0.0], [0.0, 1.0]);
        let least = alarm(&problem);
        assert!(least > 39.0);
        let beats = |one: [f64; 2], by: f64, other: [f64; 2]| {
            trial(one, 100.0 + by).beats(&problem, &trial(other, 100.0))
        };
        assert!(!beats(film, 0.9 * least, across) && beats(film, 1.1 * least, across));
        assert!(beats(across, -0.9 * least, film) && !beats(across, -1.1 * least, film));
        assert!(beats(film, 1.0, film) && beats(across, 1.0, across));
        // A form whose refit was not worth beginning is none.
        let mut none = trial(across, 500.0);
        none.fit.effects.clear();
        assert!(!none.beats(&problem, &trial(across, 100.0)));
    }

    /// A hum, begun at frequencies that are more and less off.
    #[test]
    fn of_many_starts_those_go_on_that_lead_somewhere() {
        let time: Vec<f64> = (0..1000).map(|i| 1e-3 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 100.0 * (9.0 * t).sin()).collect();
        let hum = |t: &f64| 1e-7 * (std::f64::consts::TAU * 50.0 * t).sin();
        let both = force.iter().zip(&time);
        let record = Record {
            name: "hum".to_string(),
            displacement: both.map(|(force, t)| 1e-8 * force + hum(t)).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let mut problem = Problem::new(Form::Play, &[record]);
        problem.records[0].weight.fill(1e9);
        let current = baseline(&problem);
        let effect = find("mains_hum").unwrap().effect();
        let scores = [60.0, 50.1, 54.0, 49.95].map(|frequency| Score {
            acting: Acting {
                effect,
                values: vec![5e-8, 0.0, frequency, 0.0, 0.0, 0.0, 0.0],
            },
            fall: 1.0,
        });
        let shapes: Vec<&Score> = scores.iter().collect();
        let all = starts(&problem, &current, &shapes[..2], (2, 0.0));
        let as_given = |(fit, leads_on): &(Fit, bool)| *leads_on && fit.misfit == current.misfit;
        assert!(all.len() == 2 && all.iter().all(as_given));
        let best = starts(&problem, &current, &shapes, (2, 0.5 * current.misfit));
        let frequency = |(fit, _): &(Fit, bool)| fit.effects[0].values[2];
        assert!(best.iter().all(|one| (frequency(one) - 50.0).abs() < 0.01));
        assert!(best.iter().all(|(_, leads_on)| *leads_on));
        // What leads nowhere is as good as it has become.
        let none = starts(&problem, &current, &shapes, (2, -1e3 * current.misfit));
        assert!(none.len() == 2 && none.iter().all(|(_, leads_on)| !leads_on));
        assert!(
            none.iter()
                .all(|(fit, _)| fit.misfit < 0.5 * current.misfit)
        );
        // What is followed in jumps leads on all the same.
        let effect = find("fixture_inertia").unwrap().effect();
        let masses = [1.0, 2.0, 3.0].map(|mass| Score {
            acting: Acting {
                effect,
                values: vec![0.0, mass],
            },
            fall: 1.0,
        });
        let shapes: Vec<&Score> = masses.iter().collect();
        let jumping = starts(&problem, &current, &shapes, (2, -1e3 * current.misfit));
        assert!(jumping.len() == 2 && jumping.iter().all(|(_, leads_on)| *leads_on));
    }

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
