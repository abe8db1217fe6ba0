//! The place of each cause in a set of several: who else would do there, beside the others.

use super::beside::Beside;
use super::coarsely::trials;
use super::growing::FURTHER_SHARE;
use super::prepare::Bench;
use super::probability::temperature;
use super::tested::{Prospect, beyond_unseen, unseen_rows};
use super::trials::{ALARM, Effort, Trial, all_plausible, dispersion, penalty, trial_of};
use super::verdict::NEGLIGIBLE;
use crate::causes;
use crate::identify::weighing::deviation;
use crate::identify::{Fit, Problem, refit, without};
use crate::joint::effect::Acting;

/// One cause's place.
#[derive(Debug, Clone)]
pub struct Place {
    /// Name of the cause that has it.
    named: &'static str,
    /// Misfit that the named cause takes away beside the others.
    pub brought: f64,
    /// Every cause tried there; refits end where they have no prospect of doing as well.
    trials: Vec<Trial>,
}

/// The places of a set, in the order of its effects; `first` are the trials beside the baseline, which
/// are those of a single cause's place, those `beside` others are from before, and `known` those of the last place, where the
/// others have not changed since they were made.
pub fn places(
    bench: &Bench,
    timed: bool,
    best: &Fit,
    (first, beside): (&[Trial], &[Beside]),
    mut known: Option<Vec<Trial>>,
) -> Vec<Place> {
    let problem = &bench.train;
    let exchanged = match best.effects.len() {
        0 | 1 => best.misfit,
        _ => worth_exchanging(bench, best),
    };
    (0..best.effects.len())
        .map(|place| {
            let named = best.effects[place].effect.name();
            let less = alone(problem, best, best.others(place), first);
            let brought = less.misfit - best.misfit;
            let wanted = as_well(problem, best, brought).max(exchanged);
            let known = known.take_if(|_| place + 1 == best.effects.len());
            let trials = match (best.effects.len(), known) {
                (_, Some(known)) => known,
                (1, None) => first.to_vec(),
                // The others as they are beside the named one: refitted without it they take parts of it.
                _ => {
                    let held = without(problem, best, place);
                    let start = match held.misfit - best.misfit < HELD * brought {
                        true => held,
                        false => less,
                    };
                    let scaled = (problem, &bench.scale);
                    Beside::again(beside, scaled, &start, wanted).unwrap_or_else(|| {
                        trials(problem, &bench.scale, timed, &start, (Effort::Full, wanted))
                    })
                }
            };
            Place {
                named,
                brought,
                trials,
            }
        })
        .collect()
}

/// Misfit below which another cause in the place of one may make the set better: it may leave more of fitted samples where
/// held-out ones are predicted worse than those, and is itself taken to leave as much of each kind.
fn worth_exchanging(bench: &Bench, best: &Fit) -> f64 {
    let rows = bench.train.rows() as f64;
    let left = left_of_all(bench, best);
    let beyond = left - exchange_gains(bench, best, left);
    let fitted = rows / (rows + unseen_rows(bench));
    best.misfit.max(rows + fitted * beyond)
}

/// What an exchange has to gain: more than chance, and a share of what the set leaves beyond noise; of two that leave as
/// much as that neither is right.
fn exchange_gains(bench: &Bench, best: &Fit, left: f64) -> f64 {
    let chance = ALARM * dispersion(&bench.train, best);
    chance.max(FURTHER_SHARE * left)
}

/// Misfit beyond noise of fitted samples and of held-out ones.
fn left_of_all(bench: &Bench, best: &Fit) -> f64 {
    let rows = bench.train.rows() as f64;
    (best.misfit - rows).max(0.0) + beyond_unseen(bench, best).max(0.0)
}

/// The refit of what remains of a set; a single cause that did better when it was tried alone stays as
/// it was then: beside the others it may have taken a part that is not its own.
pub fn alone(problem: &Problem, best: &Fit, others: Vec<Acting>, first: &[Trial]) -> Fit {
    let before = match others.as_slice() {
        [one] => trial_of(first, one.effect.name()),
        _ => None,
    };
    let anew = refit(problem, best, others);
    match before {
        Some(trial) if trial.fit.misfit < anew.misfit => trial.fit.clone(),
        _ => anew,
    }
}

/// The set with one cause exchanged for another that lowers the squared error most, held-out samples and what
/// its values cost included: a cause was chosen, and its values found, before those that came after it were known.
/// The new one comes last, and its place's trials come along.
pub fn exchanged(bench: &Bench, best: &Fit, places: &[Place]) -> Option<(Fit, Vec<Trial>)> {
    let scale = dispersion(&bench.train, best);
    let least = exchange_gains(bench, best, left_of_all(bench, best));
    let cost = |fit: &Fit| scale * penalty(&bench.train, fit.free());
    let own = cost(best);
    places
        .iter()
        .flat_map(|place| place.able().map(move |t| (place, &t.fit)))
        .filter(|(_, fit)| all_plausible(&bench.scale, fit))
        .map(|(place, fit)| {
            let gain = Prospect::of(bench, best, fit).total() + own - cost(fit);
            (gain, place, fit)
        })
        .filter(|(gain, ..)| *gain > least)
        .max_by(|(a, ..), (b, ..)| a.total_cmp(b))
        .map(|(_, place, fit)| (fit.clone(), place.trials.clone()))
}

impl Place {
    /// What was tried here, beside `others`.
    pub(super) fn beside(&self, problem: &Problem, others: Vec<Acting>) -> Beside {
        Beside::asked(problem, others, self.trials.clone())
    }

    /// Causes in this place, the named one as it was fitted here included; not those whose refit was not worth
    /// beginning.
    fn able(&self) -> impl Iterator<Item = &Trial> {
        let able = |t: &&Trial| t.plausible && t.own().is_some();
        self.trials.iter().filter(able)
    }

    /// Causes in place of the named one.
    fn others(&self) -> impl Iterator<Item = &Trial> {
        self.able().filter(|t| t.cause.name() != self.named)
    }

    /// Who does as well as the named cause, best first; and what it is also called.
    pub fn rivals(&self, bench: &Bench, best: &Fit) -> Vec<String> {
        let as_well = as_well(&bench.train, best, self.brought);
        // What values more than another a law needs, be it the rival's, its misfit has to pay for.
        let cost = |acting: Option<&Acting>| {
            let free = acting.map_or(0, Acting::free);
            dispersion(&bench.train, best) * penalty(&bench.train, free)
        };
        let own = cost(best.effect(self.named));
        let as_good = self
            .others()
            .filter(|t| t.fit.misfit + cost(t.own()) < as_well + own);
        let mut rivals: Vec<String> = as_good.map(|t| t.cause.name().to_string()).collect();
        let named = best.effect(self.named).zip(causes::find(self.named));
        let also = named.and_then(|(own, cause)| cause.also_called(&own.values, &bench.scale));
        let known = |also: &&str| best.effect(also).is_some() || rivals.iter().any(|r| r == also);
        if let Some(also) = also.filter(|also| !known(also)) {
            rivals.push(also.to_string());
        }
        rivals
    }
}

/// Misfit below which a cause counts as good as the one named, which has `brought` so much.
///
/// The law of a cause is only nearly that of the joint measured, so a strong effect tells two causes apart no better
/// than laws are true: differences count over the [`temperature`] of probabilities. What the named cause leaves beyond
/// the scatter of noise bounds it, for a law that leaves nothing is right, and so does what the test of structure would
/// not see, [`NEGLIGIBLE`] of the noise. A rival whose stated probability is a tenth of its own or more is as good in any case:
/// scatter hides more than such laws differ by.
fn as_well(problem: &Problem, best: &Fit, brought: f64) -> f64 {
    let scale = dispersion(problem, best);
    let rows = problem.rows() as f64;
    let left = beyond_scatter(problem, best).max(0.0);
    let temperature = temperature(brought);
    let untrue = (temperature - 1.0) * MARGIN;
    let negligible = NEGLIGIBLE * rows * scale;
    let unseen = left.min(untrue).min(negligible);
    let likely = (2.0 * temperature * TENFOLD * scale).min(negligible);
    best.misfit + (MARGIN * scale + unseen).max(likely)
}

/// Logarithm of the odds, ten to one, up to which a rival is named: of 302 drawn effects named alone four had a rival
/// likelier than that, which was right in two.
const TENFOLD: f64 = std::f64::consts::LN_10;

/// Misfit beyond what noise alone leaves, its scatter included.
pub fn beyond_scatter(problem: &Problem, fit: &Fit) -> f64 {
    let rows = problem.rows() as f64;
    fit.misfit - rows - scatter(rows)
}

/// The same, beyond what the noise's variance may be wrong by as well.
pub fn beyond_doubt(bench: &Bench, fit: &Fit) -> f64 {
    let rows = bench.train.rows() as f64;
    let doubt = deviation(rows).hypot(rows * bench.noise_error());
    fit.misfit - rows - SCATTER * doubt
}

/// What a sum of squares of noise alone may exceed its mean by, in noise variances.
pub fn scatter(rows: f64) -> f64 {
    SCATTER * deviation(rows)
}

/// Times what a cause brought that the others may leave without it as they were beside it: beyond, a dictionary that
/// suits them was not found from where it stood.
const HELD: f64 = 10.0;

/// Difference of misfit, in noise variances, within which two causes count as equally good.
///
/// Two laws that noise-free records tell apart by λ differ by λ ± 2√λ; that the wrong one does better by the margin m is
/// likeliest at λ = m, and then beyond √m standard deviations: seven in a thousand.
const MARGIN: f64 = 6.0;

/// Share of what the named cause brings below which what is left is no second one.
pub const NEARLY: f64 = 0.01;

/// Standard deviations by which a sum of squares of noise alone may exceed its mean.
const SCATTER: f64 = 2.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::Cause;
    use crate::diagnose::search::tests::dashpot;
    use crate::identify::{Form, baseline};
    use crate::record::Record;

    /// A record of a sine, of so many samples.
    fn of_samples(count: i32) -> Problem {
        let displacement: Vec<f64> = (0..count).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let record = Record {
            force: displacement.clone(),
            displacement,
            ..Record::default()
        };
        Problem::new(Form::Stop, &[record])
    }

    #[test]
    fn a_rival_that_no_probability_supports_is_none() {
        let problem = of_samples(400_000);
        let best = Fit {
            // Beyond scatter as much as anything brings here.
            misfit: 1.02 * problem.rows() as f64,
            ..baseline(&problem)
        };
        for brought in [50.0, 5e3, 5e5] {
            let behind = as_well(&problem, &best, brought) - best.misfit;
            let against = 0.5 * behind / dispersion(&problem, &best);
            assert!((-against / temperature(brought)).exp() > 0.04, "{brought}");
            assert!(behind >= MARGIN, "{brought}");
        }
    }

    /// What predicts held-out samples as it fits the others is exchanged for what leaves less of those; what predicts them far
    /// worse, for what may leave more.
    #[test]
    fn what_an_exchange_may_leave_of_fitted_samples_is_told_by_those_held_out() {
        let bench = dashpot(20261130);
        let rows = bench.train.rows() as f64;
        // A tenth too soft at every sample.
        let mut soft = baseline(&bench.train);
        soft.coefficients.iter_mut().for_each(|c| *c *= 1.1);
        soft.misfit = bench.train.misfit(&soft.predict(&bench.train)).0;
        let unseen = beyond_unseen(&bench, &soft) / unseen_rows(&bench);
        let fitted = soft.misfit / rows - 1.0;
        assert!(fitted > 1.0 && (unseen / fitted - 1.0).abs() < 0.1);
        assert_eq!(worth_exchanging(&bench, &soft), soft.misfit);
        let overfitted = Fit {
            misfit: 1.2 * rows,
            ..soft
        };
        assert!(worth_exchanging(&bench, &overfitted) > 1.4 * rows);
    }

    /// A dashpot: a delay does as well, and pinning with five values, but not for one.
    #[test]
    fn what_needs_more_values_to_do_as_well_is_no_rival() {
        let bench = dashpot(20261129);
        let plain = baseline(&bench.train);
        let with = |name: &str, values: &[f64]| {
            let cause = causes::find(name).unwrap();
            let own = Acting {
                effect: cause.effect(),
                values: values.to_vec(),
            };
            (cause, own)
        };
        let (_, own) = with("viscous_damping", &[1e6, 0.0]);
        let best = refit(&bench.train, &plain, vec![own]);
        let behind = |(cause, own): (&'static dyn Cause, Acting), by: f64| {
            let fit = Fit {
                effects: vec![own],
                misfit: best.misfit + by,
                ..best.clone()
            };
            Trial {
                cause,
                evidence: 0.0,
                plausible: true,
                fit,
            }
        };
        let delay = || with("sensor_delay", &[0.01, 0.0, 0.0]);
        let pinning = || with("pinning", &[1e8, 1e-6, 1e-6, 1e-6, 0.7]);
        let rivals = |trials: Vec<Trial>| {
            let place = Place {
                named: "viscous_damping",
                brought: plain.misfit - best.misfit,
                trials,
            };
            place.rivals(&bench, &best)
        };
        assert_eq!(pinning().1.free(), 5);
        let both = vec![behind(delay(), 2.0), behind(pinning(), 2.0)];
        assert_eq!(rivals(both), ["sensor_delay"]);
        // Four values more are paid for.
        let cost = dispersion(&bench.train, &best) * penalty(&bench.train, 4);
        assert_eq!(rivals(vec![behind(pinning(), 2.0 - cost)]), ["pinning"]);
    }

    /// Whatever the scatter: at ten to one a rival is named, at twenty to one none is.
    #[test]
    fn a_rival_of_a_tenth_of_the_probability_is_named_where_nothing_is_left() {
        let problem = of_samples(40_000);
        let best = Fit {
            misfit: problem.rows() as f64,
            ..baseline(&problem)
        };
        for brought in [5e3, 5e4] {
            let behind = as_well(&problem, &best, brought) - best.misfit;
            let odds = (0.5 * behind / temperature(brought)).exp();
            assert!((9.99..20.0).contains(&odds), "{brought}: {odds}");
        }
    }
}
