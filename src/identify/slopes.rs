//! The values of the effects as unknowns of a step: derivative columns, and moves inside their bounds.

use super::nonnegative::Normal;
use super::problem::{Prediction, Problem};
use crate::joint::effect::Acting;

/// One derivative column: effect, parameter, step of the difference, values per record.
pub(super) struct Slope {
    pub(super) effect: usize,
    pub(super) parameter: usize,
    pub(super) unit: f64,
    pub(super) values: Vec<Vec<f64>>,
}

/// Share of a value over which a difference is taken where the answer follows it in small jumps.
const WIDE: f64 = 0.05;

pub(super) fn slopes(
    problem: &Problem,
    coefficients: &[f64],
    effects: &[Acting],
    at: &[Prediction],
) -> Vec<Slope> {
    let mut slopes = Vec::new();
    for (e, acting) in effects.iter().enumerate() {
        for (p, parameter) in acting.effect.parameters().iter().enumerate() {
            let value = acting.values[p];
            if parameter.neutral == Some(value) {
                continue;
            }
            let share = match acting.effect.jumps_with(p) {
                true => WIDE,
                false => 1e-4,
            };
            let mut unit = share
                * match value.abs() {
                    // No size to go by.
                    0.0 => 1e-6 * (parameter.upper - parameter.lower).min(1.0),
                    size => size,
                };
            if value + unit > parameter.upper {
                unit = -unit;
            }
            let mut shifted = effects.to_vec();
            shifted[e].values[p] = value + unit;
            let place = acting.effect.place();
            let values = problem.gained((coefficients, at), &shifted, place);
            if values.iter().flatten().any(|v| *v != 0.0) {
                slopes.push(Slope {
                    effect: e,
                    parameter: p,
                    unit,
                    values,
                });
            }
        }
    }
    slopes
}

/// Effects after a step along the moves, kept inside their bounds.
pub(super) fn moved(effects: &[Acting], slopes: &[Slope], moves: &[f64]) -> Vec<Acting> {
    let mut moved = effects.to_vec();
    for (slope, step) in slopes.iter().zip(moves) {
        let parameter = &effects[slope.effect].effect.parameters()[slope.parameter];
        let value = &mut moved[slope.effect].values[slope.parameter];
        *value = (*value + step * slope.unit).clamp(parameter.lower, parameter.upper);
    }
    moved
}

/// Takes out of the unknowns what would leave its bounds, or its side, at once; true where there is
/// such a one.
pub(super) fn hold(
    normal: &mut Normal,
    effects: &[Acting],
    slopes: &[Slope],
    moves: &[f64],
    first: usize,
) -> bool {
    let mut held = false;
    for (k, (slope, step)) in slopes.iter().zip(moves).enumerate() {
        let parameter = &effects[slope.effect].effect.parameters()[slope.parameter];
        let value = effects[slope.effect].values[slope.parameter];
        let outward = step * slope.unit;
        let acting = effects[slope.effect].effect;
        let reached = value * (value + outward) <= 0.0;
        let across = acting.keeps_side(slope.parameter) && value != 0.0 && reached;
        let below = value <= parameter.lower && outward < 0.0;
        let above = value >= parameter.upper && outward > 0.0;
        if across || below || above {
            normal.hold(first + k);
            held = true;
        }
    }
    held
}
