//! The values of the effects as unknowns of a step: derivative columns, and moves inside their bounds.

use super::nonnegative::Normal;
use super::problem::{Prediction, Problem};
use crate::joint::effect::Acting;
use rayon::prelude::*;

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
    let all = effects.iter().enumerate();
    let values: Vec<(usize, usize)> = all
        .flat_map(|(e, acting)| (0..acting.values.len()).map(move |p| (e, p)))
        .collect();
    let slope = |(effect, parameter): (usize, usize)| {
        let acting = &effects[effect];
        let law = &acting.effect.parameters()[parameter];
        let value = acting.values[parameter];
        if law.neutral == Some(value) {
            return None;
        }
        let share = match acting.effect.jumps_with(parameter) {
            true => WIDE,
            false => 1e-4,
        };
        let mut unit = share * size_of(acting, parameter);
        if value + unit > law.upper {
            unit = -unit;
        }
        let mut shifted = effects.to_vec();
        shifted[effect].values[parameter] = value + unit;
        let values = problem.gained((coefficients, at), &shifted, acting);
        let answers = values.iter().flatten().any(|v| *v != 0.0);
        answers.then_some(Slope {
            effect,
            parameter,
            unit,
            values,
        })
    };
    values.into_par_iter().filter_map(slope).collect()
}

/// The size of a value, of which a difference takes a share; of one that stands at zero the largest of the law's others in
/// the same unit, or, where there is none, a millionth of its range or of one.
pub fn size_of(acting: &Acting, parameter: usize) -> f64 {
    if acting.values[parameter] != 0.0 {
        return acting.values[parameter].abs();
    }
    let all = acting.effect.parameters();
    let of_unit = all.iter().zip(&acting.values);
    let largest = of_unit
        .filter(|(other, _)| other.unit == all[parameter].unit)
        .fold(0.0, |largest: f64, (_, value)| largest.max(value.abs()));
    match largest > 0.0 {
        true => largest,
        false => 1e-6 * (all[parameter].upper - all[parameter].lower).min(1.0),
    }
}

/// Factor by which a value that cannot be zero falls in one step at most.
const DEEPEST: f64 = 10.0;

/// Effects after a step along the moves, kept inside their bounds.
///
/// A value `v` that cannot be zero, a time or a rate, is a scale: a fall by `d` takes it to `v/(1 + d/v)`, the
/// same to first order. At a bound decades below, where a straight step ends, nothing depends on it any more.
pub(super) fn moved(effects: &[Acting], slopes: &[Slope], moves: &[f64]) -> Vec<Acting> {
    let mut moved = effects.to_vec();
    for (slope, step) in slopes.iter().zip(moves) {
        let parameter = &effects[slope.effect].effect.parameters()[slope.parameter];
        let value = &mut moved[slope.effect].values[slope.parameter];
        let step = step * slope.unit;
        let reached = match step < 0.0 && parameter.lower > 0.0 {
            true => (*value / (1.0 - step / *value)).max(*value / DEEPEST),
            false => *value + step,
        };
        *value = reached.clamp(parameter.lower, parameter.upper);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint::effect::{Effect, Place};
    use crate::joint::parameters::Parameter;

    /// A law of a size, a time and a limit of the size.
    struct Slow;

    static VALUES: [Parameter; 3] = [
        Parameter {
            name: "size",
            symbol: "a",
            unit: "1",
            lower: -5.0,
            upper: 5.0,
            vanishes_at: Some(0.0),
            neutral: None,
            meaning: "may have any sign",
        },
        Parameter {
            name: "time",
            symbol: "t",
            unit: "s",
            lower: 1e-9,
            upper: 1e9,
            vanishes_at: None,
            neutral: None,
            meaning: "cannot be zero",
        },
        Parameter {
            name: "limit",
            symbol: "l",
            unit: "1",
            lower: 0.0,
            upper: 1e9,
            vanishes_at: None,
            neutral: None,
            meaning: "may stand at zero",
        },
    ];

    impl Effect for Slow {
        fn name(&self) -> &'static str {
            "slow"
        }
        fn place(&self) -> Place {
            Place::SlipLimit
        }
        fn parameters(&self) -> &'static [Parameter] {
            &VALUES
        }
    }

    #[test]
    fn a_time_falls_by_no_step_to_where_nothing_depends_on_it() {
        let effect: &'static dyn Effect = &Slow;
        let from = [Acting {
            effect,
            values: vec![1.0, 2.0, 0.0],
        }];
        let slopes = [0, 1].map(|parameter| Slope {
            effect: 0,
            parameter,
            unit: 0.1,
            values: Vec::new(),
        });
        let after = |moves: [f64; 2]| moved(&from, &slopes, &moves)[0].values[..2].to_vec();
        // The size goes straight on, to its bound; so does the time upwards.
        assert_eq!(after([-30.0, 30.0]), [-2.0, 5.0]);
        assert_eq!(after([-90.0, 0.0]), [-5.0, 2.0]);
        // Downwards as far as it would rise by the same step backwards.
        assert_eq!(after([0.0, -20.0]), [1.0, 1.0]);
        assert_eq!(after([0.0, -1e9]), [1.0, 0.2]);
        let little = after([0.0, -1e-3])[1];
        assert!((little - (2.0 - 1e-4)).abs() < 1e-8, "{little}");
    }
    #[test]
    fn a_limit_at_zero_has_the_size_of_what_it_limits() {
        let of = |values: [f64; 3]| {
            let law = Acting {
                effect: &Slow,
                values: values.to_vec(),
            };
            [0, 1, 2].map(|p| size_of(&law, p))
        };
        assert_eq!(of([-300.0, 2.0, 0.0]), [300.0, 2.0, 300.0]);
        // Nothing of its unit: a millionth of its range, at most of one.
        assert_eq!(of([0.0, 0.0, 0.0]), [1e-6, 1e-6, 1e-6]);
    }
}
