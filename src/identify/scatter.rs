//! How far fitted values of effects may be off: what noise, misfit that goes on for a while and the
//! grid of thresholds make of them.

use super::finer::finer;
use super::fit::Fit;
use super::linearised::{Influence, Linearised};
use super::problem::Problem;
use super::slopes::Slope;

/// Times its own size beyond which a value's linearised deviation says nothing of other values any more: the length over
/// which a hard clip is rounded is none, and moves the level at which it clips by less than itself.
const FAR: f64 = 10.0;

/// Standard deviation of every value of the fit's effects, by effect and parameter; infinite where
/// the data do not bound a value.
///
/// That of least squares, inflated as [`Linearised::inflation`] says, and with it the move that a
/// grid of half the spacing gives the value, to first order: the grid is nothing that the data
/// chose. A value that hardly shows moves the others by what [`FAR`] times its size does at most. Checked, over
/// hundreds of drawn cases, by the scorecard's coverage, and by the test below.
pub fn scatter(problem: &Problem, fit: &Fit) -> Vec<Vec<f64>> {
    let effects = fit.effects.iter();
    let mut deviations: Vec<Vec<f64>> = effects
        .map(|a| vec![f64::INFINITY; a.values.len()])
        .collect();
    if fit.effects.is_empty() {
        return deviations;
    }
    let (problem, coefficients) = finer(problem, &fit.coefficients);
    let acting = fit.acting();
    let mut step = Linearised::new(&problem, &coefficients, &acting);
    let first = step.first();
    // What values that hardly show move the others by at most.
    let mut moved_by_others = vec![0.0; step.slopes.len()];
    let mut free: Vec<usize> = (0..step.slopes.len()).collect();
    loop {
        let influences: Vec<Influence> =
            free.iter().map(|k| step.influence_of(first + k)).collect();
        let inflation = step.inflation(&influences);
        let mut farthest = (FAR, None);
        for (n, &k) in free.iter().enumerate() {
            let Slope {
                effect,
                parameter,
                unit,
                ..
            } = step.slopes[k];
            let white = influences[n].variance;
            let square = white * inflation[n] + step.solution[first + k].powi(2);
            if effect >= fit.effects.len() || !square.is_finite() || white <= 0.0 {
                continue;
            }
            let deviation = (square + moved_by_others[k]).sqrt() * unit.abs();
            deviations[effect][parameter] = deviation;
            let value = fit.effects[effect].values[parameter].abs();
            if value > 0.0 && deviation / value > farthest.0 {
                farthest = (deviation / value, Some((n, FAR * value / unit.abs())));
            }
        }
        let (_, Some((n, reach))) = farthest else {
            return deviations;
        };
        let k = free.remove(n);
        for &other in &free {
            let along = influences[n].of(first + other) / influences[n].of(first + k);
            moved_by_others[other] += (along * reach).powi(2);
        }
        step.hold(first + k);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::Form;
    use crate::identify::fit::{baseline, refit};
    use crate::joint::effect::{Acting, Effect, Place, Response};
    use crate::joint::parameters::Parameter;
    use crate::record::Record;

    /// A level L beyond which a way in the load path is lost, all of it from `1/kappa` behind the level on.
    struct Clip;

    static VALUES: [Parameter; 2] = [value("level"), value("kappa")];

    const fn value(name: &'static str) -> Parameter {
        Parameter {
            name,
            symbol: "v",
            unit: "1",
            lower: 0.0,
            upper: 1e15,
            vanishes_at: None,
            neutral: None,
            meaning: "of the test",
        }
    }

    impl Effect for Clip {
        fn name(&self) -> &'static str {
            "clip"
        }
        fn place(&self) -> Place {
            Place::Spring
        }
        fn parameters(&self) -> &'static [Parameter] {
            &VALUES
        }
        fn spring(&self, values: &[f64], force: f64) -> Response {
            let depth = (force.abs() - values[0]).max(0.0);
            let (value, slope) = match depth * values[1] < 1.0 {
                true => (0.5 * values[1] * depth * depth, values[1] * depth),
                false => (depth - 0.5 / values[1], 1.0),
            };
            Response {
                value: -1e-9 * value.copysign(force),
                slope: -1e-9 * slope,
                damping: 0.0,
            }
        }
    }

    /// What a clip is rounded over is far below what noise lets see: nothing bounds it, and it moves the level by ten times
    /// itself at most, where least squares to first order let it take the level anywhere.
    #[test]
    fn a_level_is_known_where_its_rounding_is_not() {
        let time: Vec<f64> = (0..4000).map(|i| 0.0025 * f64::from(i)).collect();
        let force: Vec<f64> = time
            .iter()
            .map(|t| 100.0 * (0.4 + 0.06 * t) * (std::f64::consts::TAU * t).sin())
            .collect();
        let (level, rounding) = (60.0, 1e-3);
        let clip = Acting {
            effect: &Clip,
            values: vec![level, 1.0 / rounding],
        };
        let spread = 2e-9;
        let noise = crate::record::noise::tests::white(force.len());
        let read = |(force, noise): (&f64, &f64)| {
            let lost = clip.effect.spring(&clip.values, *force).value;
            4e-9 * force + lost + spread * noise
        };
        let record = Record {
            name: "clipped".into(),
            displacement: force.iter().zip(&noise).map(read).collect(),
            force: force.clone(),
            time: Some(time),
            ..Record::default()
        };
        let mut problem = Problem::new(Form::Play, &[record]);
        let weights = problem.records.iter_mut().flat_map(|r| &mut r.weight);
        weights.for_each(|w| *w = 1.0 / spread);
        let fit = refit(&problem, &baseline(&problem), vec![clip]);
        let [of_level, of_kappa] = scatter(&problem, &fit)[0][..] else {
            unreachable!("the clip has two values")
        };
        let (found, kappa) = (fit.effects[0].values[0], fit.effects[0].values[1]);
        assert!(of_kappa > FAR * kappa, "{of_kappa} of {kappa}");
        assert!(
            (found - level).abs() < 3.0 * of_level,
            "{found} +- {of_level}"
        );
        assert!(of_level < 0.01 * level, "{of_level}");
    }
}
