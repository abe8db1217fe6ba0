//! 95 % intervals of the values of named causes.

use super::finely::marched_otherwise;
use crate::causes::{Scale, find};
use crate::identify::interval::student_95;
use crate::identify::linearised::STRETCHES_OF_FACTOR;
use crate::identify::{Fit, Problem, refit, scatter};
use crate::joint::effect::Acting;

/// Values and deviations of one law, and how likely it is among the laws compared.
struct Reading {
    values: Vec<Vec<f64>>,
    deviations: Vec<Vec<f64>>,
    /// Half of what Akaike's criterion is lower than the named law's.
    log_likelihood: f64,
}

/// Times a value's own deviation beyond which a refinement is one that the data cannot tell from the law itself, as a third
/// harmonic whose alias is the fundamental: it says nothing of the law's values.
const BLIND: f64 = 30.0;

/// Interval of every value of the fit's effects, by effect and parameter; `None` where the data do
/// not bound it.
///
/// A refinement that the data do not ask for is left out of the law, yet they seldom rule it out:
/// the interval is that of the mixture of both laws, weighed by Akaike's criterion, and
/// reaches to the named values, and to those of a march in other steps.
pub fn intervals(problem: &Problem, scale: &Scale, fit: &Fit) -> Vec<Vec<Option<(f64, f64)>>> {
    let factor = student_95(STRETCHES_OF_FACTOR - 1);
    let mut readings = vec![reading(problem, fit, 0.0)];
    for place in 0..fit.effects.len() {
        if let Some((refined, fall)) = refined(problem, scale, fit, place) {
            readings.push(reading(problem, &refined, fall));
        }
        for (other, fall) in beside(problem, fit, place) {
            readings.push(reading(problem, &other, fall));
        }
    }
    let marched = marched_otherwise(problem, fit);
    let likeliest = readings
        .iter()
        .fold(0.0_f64, |most, r| most.max(r.log_likelihood));
    let bounds = |effect: usize, parameter: usize| {
        let own = readings[0].deviations[effect][parameter];
        let parts: Vec<(f64, f64, f64)> = readings
            .iter()
            .map(|r| {
                let deviation = r.deviations[effect][parameter];
                let likelihood = (r.log_likelihood - likeliest).exp();
                (likelihood, r.values[effect][parameter], deviation)
            })
            .filter(|(_, _, deviation)| deviation.is_finite() && *deviation <= BLIND * own)
            .collect();
        own.is_finite().then(|| {
            let glossary = &fit.effects[effect].effect.parameters()[parameter];
            let (lower, upper) = mixed(&parts, factor);
            // A likelier refinement may lie elsewhere altogether.
            let named = readings[0].values[effect][parameter];
            let others = marched.iter().map(|other| other[effect].values[parameter]);
            let (lower, upper) = others.fold(
                (lower.min(named), upper.max(named)),
                |(lower, upper), value| (lower.min(value), upper.max(value)),
            );
            (lower.max(glossary.lower), upper.min(glossary.upper))
        })
    };
    let effects = fit.effects.iter().enumerate();
    effects
        .map(|(e, acting)| (0..acting.values.len()).map(|p| bounds(e, p)).collect())
        .collect()
}

fn reading(problem: &Problem, fit: &Fit, fall: f64) -> Reading {
    Reading {
        values: fit.effects.iter().map(|a| a.values.clone()).collect(),
        deviations: scatter(problem, fit),
        log_likelihood: 0.5 * fall,
    }
}

/// The fit with the neutral refinements of one effect freed, and by how much that lowers Akaike's
/// criterion; `None` where the law has none, or where they do not lower the misfit at all.
fn refined(problem: &Problem, scale: &Scale, fit: &Fit, place: usize) -> Option<(Fit, f64)> {
    let acting = &fit.effects[place];
    let cause = find(acting.effect.name())?;
    let mut effects = fit.effects.clone();
    effects[place].values = cause.refined(&acting.values, scale);
    let freed = effects[place]
        .values
        .iter()
        .zip(&acting.values)
        .zip(cause.parameters())
        .filter(|((new, old), p)| new != old && p.neutral == Some(**old))
        .count();
    if freed == 0 {
        return None;
    }
    let (other, fall) = instead(problem, fit, effects);
    // A refit that ends worse has not found its way, and tells nothing.
    (fall >= 0.0).then_some((other, fall - 2.0 * freed as f64))
}

/// Fits by laws that have a refinement of one effect elsewhere, with as many values, and by how much each lowers
/// Akaike's criterion.
fn beside(problem: &Problem, fit: &Fit, place: usize) -> Vec<(Fit, f64)> {
    let acting = &fit.effects[place];
    let laws = find(acting.effect.name()).map(|cause| cause.beside(&acting.values));
    let refitted = |law: Acting| {
        let mut effects = fit.effects.clone();
        effects[place] = law;
        instead(problem, fit, effects)
    };
    laws.unwrap_or_default().into_iter().map(refitted).collect()
}

/// The fit with other effects, and by how much its misfit is lower in the noise's own variance.
fn instead(problem: &Problem, fit: &Fit, effects: Vec<Acting>) -> (Fit, f64) {
    let other = refit(problem, fit, effects);
    let spread = (other.misfit / problem.rows().max(1) as f64).max(1.0);
    let fall = (fit.misfit - other.misfit) / spread;
    (other, fall)
}

/// 95 % interval of a mixture of (likelihood, value, deviation), each a bell whose own 95 % half-width
/// is `factor` deviations.
fn mixed(parts: &[(f64, f64, f64)], factor: f64) -> (f64, f64) {
    let total: f64 = parts.iter().map(|p| p.0).sum();
    let most = parts.iter().fold(0.0_f64, |most, p| most.max(p.2));
    let lowest = parts.iter().fold(f64::INFINITY, |least, p| least.min(p.1));
    let highest = parts
        .iter()
        .fold(f64::NEG_INFINITY, |most, p| most.max(p.1));
    let below = |x: f64| -> f64 {
        let each = parts.iter().map(|&(likelihood, value, deviation)| {
            let z = if deviation > 0.0 {
                (x - value) / deviation * crate::identify::interval::NORMAL_95 / factor
            } else {
                f64::INFINITY.copysign(x - value)
            };
            likelihood * normal(z)
        });
        each.sum::<f64>() / total
    };
    let quantile = |share: f64| {
        let (mut low, mut high) = (lowest - 4.0 * factor * most, highest + 4.0 * factor * most);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if below(middle) < share {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    };
    (quantile(0.025), quantile(0.975))
}

/// Distribution function of the normal law (Zelen and Severo, Abramowitz & Stegun 26.2.17; right to
/// 7.5e-8).
fn normal(z: f64) -> f64 {
    if z < 0.0 {
        return 1.0 - normal(-z);
    }
    let t = 1.0 / (1.0 + 0.231_641_9 * z);
    let series = t
        * (0.319_381_530
            + t * (-0.356_563_782
                + t * (1.781_477_937 + t * (-1.821_255_978 + t * 1.330_274_429))));
    1.0 - (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt() * series
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::interval::NORMAL_95;

    #[test]
    fn one_law_gives_its_own_interval_and_two_apart_reach_over_both() {
        let (lower, upper) = mixed(&[(1.0, 3.0, 0.5)], NORMAL_95);
        assert!((lower - 3.0 + 0.5 * NORMAL_95).abs() < 1e-5);
        assert!((upper - 3.0 - 0.5 * NORMAL_95).abs() < 1e-5);
        let (lower, upper) = mixed(&[(1.0, 0.0, 1.0), (1.0, 10.0, 1.0)], NORMAL_95);
        // 2.5 % below of half the mass is 5 % of one bell.
        assert!((lower + 1.644_85).abs() < 1e-3, "{lower}");
        assert!((upper - 11.644_85).abs() < 1e-3, "{upper}");
    }

    #[test]
    fn a_law_that_is_hardly_likely_does_not_widen_the_interval() {
        let (lower, upper) = mixed(&[(1.0, 0.0, 1.0), (1e-6, 50.0, 9.0)], NORMAL_95);
        assert!((lower + NORMAL_95).abs() < 1e-3 && (upper - NORMAL_95).abs() < 1e-3);
    }
}
