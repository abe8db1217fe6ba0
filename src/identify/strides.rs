//! Search along a value that the answer follows in small jumps: between them there is no slope that
//! would lead on.

use super::fit::{Fit, suited_below};
use super::problem::Problem;
use super::series;
use super::weighing::deviation;

/// Factors tried at once: a first size comes from a slope, and slopes between jumps tell little.
const LEAPS: [f64; 3] = [3.0, 9.0, 27.0];

/// Share of the value that a stride goes.
const STRIDE: f64 = 0.2;

/// Most strides one way.
const MOST: usize = 8;

/// Standard deviations of noise within which a misfit tells nothing of how much an effect has to take.
const SCATTER: f64 = 3.0;

/// The fit with such values a few strides on, the newest effect's first a leap where it takes less than
/// half of what noise does not explain of the misfit `before` it, or noise may explain all of that; the dictionary's
/// coefficients suited to each. The same fit where none lowers the misfit.
pub(super) fn strided(problem: &Problem, mut fit: Fit, before: f64) -> Fit {
    let rows = problem.rows() as f64;
    let half = 0.5 * (before + rows);
    let hidden = before < rows + SCATTER * deviation(rows);
    let newest = fit.effects.iter().rposition(|acting| !series::is(acting));
    for e in 0..fit.effects.len() {
        let law = fit.effects[e].effect;
        for p in (0..law.parameters().len()).filter(|&p| law.jumps_with(p)) {
            if Some(e) == newest && (hidden || fit.misfit > half) {
                let leaps = LEAPS.map(|factor| moved(problem, &fit, (e, p), factor));
                let lowest = leaps.into_iter().flatten();
                fit = lowest
                    .min_by(|a, b| a.misfit.total_cmp(&b.misfit))
                    .unwrap_or(fit);
            }
            for factor in [1.0 + STRIDE, 1.0 / (1.0 + STRIDE)] {
                let began = fit.misfit;
                for _ in 0..MOST {
                    let Some(next) = moved(problem, &fit, (e, p), factor) else {
                        break;
                    };
                    fit = next;
                }
                if fit.misfit < began {
                    break;
                }
            }
        }
    }
    fit
}

/// The fit with one value times a factor, inside its bounds, where that leaves less.
fn moved(problem: &Problem, fit: &Fit, (e, p): (usize, usize), factor: f64) -> Option<Fit> {
    let mut effects = fit.effects.clone();
    let parameter = &effects[e].effect.parameters()[p];
    let value = &mut effects[e].values[p];
    *value = (*value * factor).clamp(parameter.lower, parameter.upper);
    suited_below(problem, fit, effects, fit.misfit)
}
