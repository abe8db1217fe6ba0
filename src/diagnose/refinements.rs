//! Refinements of a law, fitted where they bring more than they cost.

use super::trials::{dispersion, penalty};
use crate::causes::{Cause, Scale};
use crate::identify::{Fit, Problem, refit};

/// Fall of the misfit beyond the information criterion's for a refinement of a law: one in a
/// thousand by chance.
const REFINED: f64 = 10.0;

/// The fit with the refinements of the cause's law, where they bring more than they cost; `without` the cause the
/// misfit is larger.
pub(super) fn refined(
    (problem, scale): (&Problem, &Scale),
    cause: &dyn Cause,
    without: f64,
    fit: Fit,
) -> Fit {
    let place = fit
        .effects
        .iter()
        .position(|a| a.effect.name() == cause.name());
    let Some(place) = place else {
        return fit;
    };
    let values = cause.refined(&fit.effects[place].values, scale);
    let nearby = fit.misfit;
    let fit = better(problem, fit, (place, values), nearby);
    match cause.begun_anew(&fit.effects[place].values, scale) {
        // Far from what was fitted, what it begins with is worse.
        Some(values) => better(problem, fit, (place, values), without),
        None => fit,
    }
}

/// The refit from other values of one of its effects, where it brings more than they cost; they begin smaller where
/// they leave more than `most`.
pub(super) fn better(
    problem: &Problem,
    fit: Fit,
    (place, values): (usize, Vec<f64>),
    most: f64,
) -> Fit {
    let before = fit.effects[place].free();
    let mut effects = fit.effects.clone();
    effects[place].values = values;
    if effects == fit.effects {
        return fit;
    }
    let start = Fit {
        misfit: most,
        ..fit.clone()
    };
    let other = refit(problem, &start, effects);
    let after = other.effects[place].free();
    let more = after.saturating_sub(before);
    let fall = (fit.misfit - other.misfit) / dispersion(problem, &other);
    if fall > penalty(problem, more) + REFINED {
        other
    } else {
        fit
    }
}
