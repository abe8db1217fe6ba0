//! The joint refit: dictionary coefficients, offsets and effect parameters together, by
//! damped Gauss–Newton (Levenberg–Marquardt) steps on the exact march with non-negative coefficients
//! (variable projection after Kaufman: the dictionary is linear, only effect parameters are stepped).

use super::nonnegative::Normal;
use super::operators::Form;
use super::prepared::Prepared;
use super::problem::{Prediction, Problem};
use super::reached::Reached;
use super::rows::each_row;
use super::series;
use super::slopes::{Slope, hold, moved, slopes};
use super::strides::strided;
use super::summed::Summed;
use crate::joint::effect::{Acting, Place};
use rayon::prelude::*;

/// A fitted model.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Elastic coefficient first, then one per threshold; all non-negative.
    pub coefficients: Vec<f64>,
    /// One offset of the judged channel per record.
    pub offsets: Vec<f64>,
    /// Effects with their fitted values.
    pub effects: Vec<Acting>,
    /// Compliance of the spring in series \[m/N\] where an effect on the slip tells it apart from
    /// the network's own; part of the elastic coefficient elsewhere.
    pub series: Option<f64>,
    /// Whitened sum of squares over the weighted samples.
    pub misfit: f64,
}

impl Fit {
    /// Predictions of every record, offsets included.
    pub fn predict(&self, problem: &Problem) -> Vec<Prediction> {
        let mut predictions = problem.predict(&self.coefficients, &self.acting());
        for (prediction, offset) in predictions.iter_mut().zip(&self.offsets) {
            prediction.judged.iter_mut().for_each(|y| *y += offset);
        }
        predictions
    }

    /// Measured less predicted, of every sample of every record.
    pub fn residuals(&self, problem: &Problem) -> Vec<Vec<f64>> {
        let one = |(k, prediction): (usize, &Prediction)| {
            let (_, judged) = problem.channels(k);
            let both = judged.iter().zip(&prediction.judged);
            both.map(|(y, p)| y - p).collect()
        };
        self.predict(problem).iter().enumerate().map(one).collect()
    }

    /// The effect of a name as it was fitted; `None` where the fit is without.
    pub fn effect(&self, name: &str) -> Option<&Acting> {
        self.effects.iter().find(|a| a.effect.name() == name)
    }

    /// Its effects but for the one at a place.
    pub fn others(&self, place: usize) -> Vec<Acting> {
        let mut others = self.effects.clone();
        others.remove(place);
        others
    }

    /// Values of its effects that it chose, none of which is at its neutral value.
    pub fn free(&self) -> usize {
        self.effects.iter().map(Acting::free).sum()
    }

    /// Everything that acts in a march of this fit: its effects and the spring in series.
    pub fn acting(&self) -> Vec<Acting> {
        let spring = self.series.map(series::acting);
        self.effects.iter().cloned().chain(spring).collect()
    }
}

/// Gauss–Newton steps of one refit, and those that it may take as long as each takes a [`STEADY`] share
/// of the misfit away: a way that goes down in a valley is long.
const STEPS: usize = 10;
const LONGEST: usize = 40;
const STEADY: f64 = 0.01;

/// Dampings tried within one step.
const TRIALS: usize = 7;

/// First damping of a step that failed undamped, relative to the column's own norm: a derivative
/// that the dictionary explains to a part in ten thousand is still free to move.
const LEAST_DAMPING: f64 = 1e-4;

/// Share of the fall that a step foretells below which the dictionary has to follow where it led: it was linear on
/// the way there, and is not.
const FORETOLD: f64 = 0.1;

/// Relative fall of the misfit below which a refit ends.
const SETTLED: f64 = 1e-6;

/// The baseline: any Masing joint, no effect. Convex, so its minimum is the global one.
pub fn baseline(problem: &Problem) -> Fit {
    let zero = vec![0.0; problem.operators.columns()];
    let once = Steps {
        most: 1,
        longest: 1,
        ..Steps::full()
    };
    refine(problem, zero, Vec::new(), once)
}

/// Misfit of the [`baseline`] beside a steady drift of the judged channel, by its normal equations alone: no march
/// predicts what it leaves.
pub(super) fn least_misfit(problem: &Problem) -> f64 {
    let nothing = vec![0.0; problem.operators.columns()];
    let at: Vec<Prediction> = problem.records.iter().map(Prediction::of_nothing).collect();
    let passed = |record: &Prepared| {
        let (begins, length) = (record.time[0], record.length());
        record.time.iter().map(|t| (t - begins) / length).collect()
    };
    let drift = Slope {
        effect: 0,
        parameter: 0,
        unit: 1.0,
        values: problem.records.iter().map(passed).collect(),
    };
    let normal = normal(problem, &nothing, &[], &at, &[drift]);
    let solution = normal.solve(&bounded(problem, &normal));
    normal.misfit(&solution)
}

/// Which unknowns may not be negative: the dictionary's.
pub(super) fn bounded(problem: &Problem, normal: &Normal) -> Vec<bool> {
    let columns = problem.operators.columns();
    (0..normal.size).map(|i| i < columns).collect()
}

/// Refits everything from the given start.
pub fn refit(problem: &Problem, start: &Fit, effects: Vec<Acting>) -> Fit {
    refit_below(problem, start, effects, f64::INFINITY)
}

/// The fit with other effects, as they are, and the dictionary as it suits them.
pub fn suited(problem: &Problem, fit: &Fit, effects: Vec<Acting>) -> Fit {
    let (reached, other) = with(problem, fit, effects);
    reached.suited(problem).fit(other)
}

/// The same, where it leaves less than a misfit.
pub(super) fn suited_below(
    problem: &Problem,
    fit: &Fit,
    effects: Vec<Acting>,
    misfit: f64,
) -> Option<Fit> {
    let (reached, other) = with(problem, fit, effects);
    let suited = reached.suited_below(problem, misfit)?;
    Some(suited.fit(other))
}

/// What a fit reaches with other effects, its dictionary as it is.
fn with(problem: &Problem, fit: &Fit, effects: Vec<Acting>) -> (Reached, Fit) {
    let other = Fit {
        effects,
        ..fit.clone()
    };
    let reached = Reached::at(problem, other.coefficients.clone(), other.acting());
    (reached, other)
}

/// The fit without one of its effects, the others as they are and the dictionary as it suits them.
pub fn without(problem: &Problem, fit: &Fit, place: usize) -> Fit {
    suited(problem, fit, fit.others(place))
}

/// Refits as [`refit`] does, as long as there is a prospect of a misfit below `bound`.
pub fn refit_below(problem: &Problem, start: &Fit, effects: Vec<Acting>, bound: f64) -> Fit {
    let steps = Steps {
        bound,
        before: start.misfit,
        ..Steps::full()
    };
    begin(problem, start, effects, steps)
}

/// So many steps of a refit alone, without strides: enough to tell which of several starts leads on.
pub fn glanced(problem: &Problem, start: &Fit, effects: Vec<Acting>, count: usize) -> Fit {
    let steps = Steps {
        most: count,
        longest: count,
        strides: false,
        before: start.misfit,
        ..Steps::full()
    };
    begin(problem, start, effects, steps)
}

/// Refits with the spring in series among the unknowns where it shows, first without it.
fn begin(problem: &Problem, start: &Fit, effects: Vec<Acting>, steps: Steps) -> Fit {
    let mut coefficients = start.coefficients.clone();
    let compliance = match (series::shows(&effects), start.series) {
        (true, Some(compliance)) => compliance,
        (true, None) => {
            let fit = refine(problem, coefficients, effects, steps);
            let mut split = fit.clone();
            let compliance = series::start(problem.operators.form, &mut split.coefficients);
            split.series = Some(compliance);
            let split = begin(problem, &split, fit.effects.clone(), steps);
            return if split.misfit < fit.misfit {
                split
            } else {
                fit
            };
        }
        (false, Some(compliance)) => {
            if problem.operators.form == Form::Play {
                coefficients[0] += compliance;
            }
            return refine(problem, coefficients, effects, steps);
        }
        (false, None) => return refine(problem, coefficients, effects, steps),
    };
    let mut acting = effects;
    acting.push(series::acting(compliance));
    let mut fit = refine(problem, coefficients, acting, steps);
    fit.series = fit.effects.pop().map(|spring| spring.values[0]);
    fit
}

/// When a refit ends.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Steps {
    most: usize,
    longest: usize,
    /// A refit is given up that would need more than [`PROSPECT`] steps like its last one, [`FIRST`] at first, to come below this misfit,
    /// or more than [`CREDITED`] as the next one is foretold.
    bound: f64,
    /// Misfit without the newest effect: a start that is worse begins smaller.
    before: f64,
    /// Whether strides follow where the answer follows a value in small jumps.
    strides: bool,
}

/// Steps like the last one that a refit is credited with: Gauss–Newton steps shrink.
pub const PROSPECT: f64 = 4.0;

/// The same behind its first steps, which are often short. Judged: of 321 refits that came below their bound four had
/// needed more.
const FIRST: [f64; 3] = [100.0, 20.0, 8.0];

/// Falls, as the linearised model foretells the next one, that a refit is credited with. Judged: of 843 refits with a
/// bound 129 came below it, none of which had at any step been farther from it than 6.5 such falls.
const CREDITED: f64 = 8.0;

impl Steps {
    fn full() -> Steps {
        Steps {
            most: STEPS,
            longest: LONGEST,
            bound: f64::INFINITY,
            before: f64::INFINITY,
            strides: true,
        }
    }
}

/// Share of the misfit that the newest effect must have taken away for strides to be tried: less is
/// what noise gives to any effect.
const WORTH_STRIDES: f64 = 1e-3;

/// Steps from the given start; where the answer follows a value in small jumps, strides over them and
/// steps again, if that may lead below the bound.
fn refine(problem: &Problem, coefficients: Vec<f64>, effects: Vec<Acting>, steps: Steps) -> Fit {
    let fit = descend(problem, coefficients, effects, steps);
    let prospect = fit.misfit - PROSPECT * (steps.before - fit.misfit) < steps.bound;
    if !steps.strides || !prospect || fit.misfit > (1.0 - WORTH_STRIDES) * steps.before {
        return fit;
    }
    let reached = fit.misfit;
    let farther = strided(problem, fit, steps.before);
    if farther.misfit >= reached {
        return farther;
    }
    descend(problem, farther.coefficients, farther.effects, steps)
}

fn descend(problem: &Problem, coefficients: Vec<f64>, effects: Vec<Acting>, steps: Steps) -> Fit {
    let columns = problem.operators.columns();
    let mut now = Reached::at(problem, coefficients, effects).begun(problem, steps.before);
    let mut damping = 0.0;
    // Limits that follow what the joint does, and what shares the force with it or, where displacement drives, takes of
    // the way, make the answer less than linear in the dictionary.
    let drives = problem.operators.form == Form::Play;
    let shares =
        |a: &Acting| a.acts_at(Place::BesideJoint) || a.effect.inertia(&a.values).is_some();
    let yields = |a: &Acting| a.acts_at(Place::Spring) || a.acts_at(Place::InSeries);
    let answers = |a: &Acting| if drives { shares(a) } else { yields(a) };
    let follows = |a: &Acting| a.acts_at(Place::SlipLimit) || answers(a);
    let implicit = now.effects.iter().any(follows);
    for round in 0..steps.longest {
        let slopes = slopes(problem, &now.coefficients, &now.effects, &now.predictions);
        let normal = normal(
            problem,
            &now.coefficients,
            &now.effects,
            &now.predictions,
            &slopes,
        );
        let records = problem.records.len();
        let first = columns + records;
        let bounded = bounded(problem, &normal);
        let solution = normal.solve(&bounded);
        let foretold = now.misfit - normal.misfit(&solution);
        let hopeless = now.misfit - CREDITED * foretold > steps.bound;
        if round > 0 && (foretold < SETTLED * now.misfit || hopeless) {
            break;
        }
        let mut accepted = false;
        for tried in 0..TRIALS {
            let mut damped = normal.clone();
            (first..normal.size).for_each(|i| damped.damp(i, damping));
            if implicit && damping > 0.0 {
                let at = now.coefficients.iter().enumerate();
                at.for_each(|(i, &c)| damped.anchor(i, damping, c));
            }
            let mut solution = damped.solve(&bounded);
            if hold(
                &mut damped,
                &now.effects,
                &slopes,
                &solution[first..],
                first,
            ) {
                solution = damped.solve(&bounded);
            }
            let values = moved(&now.effects, &slopes, &solution[first..]);
            solution.truncate(columns);
            let trial = Reached::at(problem, solution, values);
            let once = round == 0 && steps.most == 1;
            let least = if once {
                trial.misfit
            } else {
                trial.misfit.min(now.misfit)
            };
            let trial = match implicit && trial.misfit > now.misfit - FORETOLD * foretold {
                true => trial.suited_below(problem, least).unwrap_or(trial),
                false => trial,
            };
            if trial.misfit.is_finite() && (trial.misfit < now.misfit || once) {
                let fall = now.misfit - trial.misfit;
                let credited = FIRST.get(round).unwrap_or(&PROSPECT);
                let prospect = trial.misfit - credited * fall < steps.bound;
                let least = match round + 1 < steps.most {
                    true => SETTLED,
                    false => STEADY,
                };
                accepted = fall > least * now.misfit && prospect;
                now = trial;
                // What has just failed is not tried again at once.
                damping *= if tried == 0 { 0.1 } else { 1.0 };
                break;
            }
            if slopes.is_empty() {
                break;
            }
            damping = (10.0 * damping).max(LEAST_DAMPING);
        }
        if !accepted {
            break;
        }
    }
    Fit {
        coefficients: now.coefficients,
        offsets: now.offsets,
        effects: now.effects,
        series: None,
        misfit: now.misfit,
    }
}

/// Normal equations of the linearised model: coefficients, offsets, moves of the parameters.
pub(super) fn normal(
    problem: &Problem,
    coefficients: &[f64],
    effects: &[Acting],
    at: &[Prediction],
    slopes: &[Slope],
) -> Normal {
    let size = problem.operators.columns() + problem.records.len() + slopes.len();
    let parts: Vec<Normal> = (0..problem.records.len())
        .into_par_iter()
        .map(|k| {
            let mut summed = Summed::new(size);
            let model = (coefficients, effects);
            each_row(problem, k, model, &at[k], slopes, |row| summed.add(row));
            summed.finish()
        })
        .collect();
    let mut normal = Normal::new(size);
    parts.iter().for_each(|part| normal.merge(part));
    normal.mirror();
    normal
}

/// Dictionary coefficients that suit the effects as they are, and what the linearised model foretells that they leave:
/// the joint without an effect is not the joint beside it.
pub(super) fn projected(
    problem: &Problem,
    (coefficients, effects): (&[f64], &[Acting]),
    at: &[Prediction],
) -> (Vec<f64>, f64) {
    let columns = problem.operators.columns();
    let normal = normal(problem, coefficients, effects, at, &[]);
    let mut solution = normal.solve(&bounded(problem, &normal));
    let foretold = normal.misfit(&solution);
    solution.truncate(columns);
    (solution, foretold)
}
