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
    let fit = refined_nearby((problem, scale), cause, fit);
    let Some(place) = place(cause, &fit) else {
        return fit;
    };
    match cause.begun_anew(&fit.effects[place].values, scale) {
        // Far from what was fitted, what it begins with is worse.
        Some(values) => better(problem, fit, (place, values), without),
        None => fit,
    }
}

/// The same by those refinements alone that are fitted from where the fit is.
pub(super) fn refined_nearby(
    (problem, scale): (&Problem, &Scale),
    cause: &dyn Cause,
    fit: Fit,
) -> Fit {
    let Some(place) = place(cause, &fit) else {
        return fit;
    };
    let values = cause.refined(&fit.effects[place].values, scale);
    let nearby = fit.misfit;
    better(problem, fit, (place, values), nearby)
}

fn place(cause: &dyn Cause, fit: &Fit) -> Option<usize> {
    let mut effects = fit.effects.iter();
    effects.position(|a| a.effect.name() == cause.name())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::identify::{Form, baseline};
    use crate::joint::effect::Acting;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// Three tests at three rates of a joint that creeps by three elements.
    fn creeping(elements: &[f64]) -> Problem {
        let record = |period: f64| {
            let time: Vec<f64> = (0..600).map(|i| period * f64::from(i) / 100.0).collect();
            let level = |i: usize| 0.5 + 0.1 * (i / 100) as f64;
            let turn = |i: usize| std::f64::consts::TAU * i as f64 / 100.0;
            Record {
                name: format!("{period} s"),
                force: (0..600).map(|i| 700.0 * level(i) * turn(i).sin()).collect(),
                displacement: vec![0.0; 600],
                time: Some(time),
                ..Record::default()
            }
        };
        let mut records = [5.4, 1.8, 0.54].map(record).to_vec();
        let plain = Problem::new(Form::Play, &records);
        let mut joint = vec![0.0; plain.operators.columns()];
        joint[0] = 1e-8;
        joint[1..=plain.operators.edges.len()].fill(1e-11);
        let creep = Acting {
            effect: find("creep").unwrap().effect(),
            values: elements.to_vec(),
        };
        let answers = plain.predict(&joint, &[creep]);
        let mut noise = drawn(20261128);
        for (record, answer) in records.iter_mut().zip(&answers) {
            record.displacement = answer.judged.iter().map(|u| u + 3e-8 * noise()).collect();
        }
        let mut problem = Problem::new(Form::Play, &records);
        for record in &mut problem.records {
            record.weight.fill(1.0 / (3e-8 * 12_f64.sqrt().recip()));
        }
        problem
    }

    /// A series that begins half a decade off ends between its elements, and begun anew at them.
    #[test]
    fn a_series_of_elements_is_begun_anew_half_a_decade_on() {
        let problem = creeping(&[2.5e-10, 0.276, 2.8, 1.08]);
        let scale = Scale {
            period: 0.54,
            lengths: vec![32.0, 11.0, 3.2],
            ..Scale::default()
        };
        let first = baseline(&problem);
        let cause = find("creep").unwrap();
        let with = |values: [f64; 4]| {
            vec![Acting {
                effect: cause.effect(),
                values: values.to_vec(),
            }]
        };
        let off = refit(&problem, &first, with([4.1e-10, 0.066, 1.2, 0.6]));
        let on = refined((&problem, &scale), cause, first.misfit, off.clone());
        let truth = refit(&problem, &first, with([2.5e-10, 0.276, 2.8, 1.08]));
        assert!(off.misfit > 1.1 * truth.misfit && off.misfit < 0.1 * first.misfit);
        assert!(
            on.misfit < 1.001 * truth.misfit,
            "{:?}",
            on.effects[0].values
        );
    }
}
