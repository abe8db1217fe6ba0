//! Search along a value that the answer follows in small jumps: between them there is no slope that
//! would lead on.

use super::fit::{Fit, projected};
use super::problem::Problem;

/// Share of the value that a stride goes.
const STRIDE: f64 = 0.2;

/// Most strides one way.
const MOST: usize = 8;

/// The fit with such values a few strides on, the dictionary's coefficients suited to each; the same
/// fit where no stride lowers the misfit.
pub(super) fn strided(problem: &Problem, mut fit: Fit) -> Fit {
    for e in 0..fit.effects.len() {
        let law = fit.effects[e].effect;
        for (p, parameter) in law.parameters().iter().enumerate() {
            if !law.jumps_with(p) {
                continue;
            }
            for factor in [1.0 + STRIDE, 1.0 / (1.0 + STRIDE)] {
                let began = fit.misfit;
                for _ in 0..MOST {
                    let value = fit.effects[e].values[p] * factor;
                    let next = value.clamp(parameter.lower, parameter.upper);
                    let mut effects = fit.effects.clone();
                    effects[e].values[p] = next;
                    let at = problem.predict(&fit.coefficients, &effects);
                    let coefficients = projected(problem, &fit.coefficients, &effects, &at);
                    let (misfit, offsets) =
                        problem.misfit(&problem.predict(&coefficients, &effects));
                    if misfit >= fit.misfit {
                        break;
                    }
                    fit = Fit {
                        coefficients,
                        offsets,
                        effects,
                        series: fit.series,
                        misfit,
                    };
                }
                if fit.misfit < began {
                    break;
                }
            }
        }
    }
    fit
}
