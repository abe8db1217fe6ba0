//! A mass that was found, marched in shorter steps or with more turns, or in its other form.

use super::places::scatter;
use super::prepare::Bench;
use crate::causes::find;
use crate::identify::weighing::whitened;
use crate::identify::{self, Fit, Form, Problem, refit, refit_below};
use crate::joint::effect::Acting;
use rayon::prelude::*;

/// Parts of a step in which a mass that was found moves with the joint, and turns in which its share of a prescribed
/// force is taken off.
const HAULING: Fineness = (4, 12);

/// The same where a mass is looked for.
const COARSE: Fineness = (identify::HAULING, identify::TURNS);

/// Whitened square that counts at most, of three standard deviations: where a load breaks off, neither a coarse nor a
/// fine pass follows, and how far each is off there tells nothing of the mass.
const MOST: f64 = 9.0;

/// Times what a mass that rings leaves beyond noise that one which does not may leave, and be taken, if they do not agree
/// about its size: where a load breaks off between samples the first rings by as much as its force is read too early or
/// too late, and is fitted to that.
const CLAIMED: f64 = 2.0;

/// Part of its size by which the two forms of a mass may differ and still agree: what is fitted to breaks is lighter by
/// more. Judged: few turns err by 5 %, few steps by 3 %.
const AGREE: f64 = 0.1;

/// The set on a bench that marches in shorter steps or more turns, where it has a mass and they suit all samples
/// better, held-out ones included.
///
/// Where force drives, either form of a mass is begun from the size that the other was found with, which no slope may
/// lead to; where noise is told apart and they do not agree, it is one that rings on the joint only if that explains far
/// more.
pub(super) fn finely(bench: &mut Bench, best: Fit) -> Fit {
    if !best.effects.iter().any(|a| a.effect.follows_motion()) {
        return best;
    }
    let coarse = (bench.train.hauling, bench.train.turns);
    let found = Fitted {
        left: capped(bench, &best),
        fineness: coarse,
        fit: best,
    };
    let finer = Fitted::at(bench, HAULING, &found.fit);
    let one = found.or_nearer(finer);
    bench.haul(one.fineness);
    let other: Vec<Acting> = one.fit.effects.iter().map(otherwise).collect();
    if other == one.fit.effects || bench.train.operators.form == Form::Stop {
        return one.fit;
    }
    let begun = Fit {
        effects: other,
        misfit: f64::INFINITY,
        ..one.fit.clone()
    };
    let finer = Fitted::at(bench, HAULING, &begun);
    let other = Fitted::at(bench, coarse, &begun).or_nearer(finer);
    let rings = one.fit.effects.iter().any(|a| bench.train.hauls(a));
    let (ringing, calm) = if rings { (one, other) } else { (other, one) };
    let formed: Vec<Acting> = calm.fit.effects.iter().map(otherwise).collect();
    let told_apart = bench.noise_is_repeated() && !agree(&ringing.fit.effects, &formed);
    let taken = match ringing.explains_more(&calm, bench.whole.rows() as f64, told_apart) {
        true => ringing,
        false => calm,
    };
    bench.haul(taken.fineness);
    taken.fit
}

/// The same of a set that was settled on since another one was marched so; of the same causes as they are.
///
/// A mass beside no other cause may have been found ringing where beside one it does not.
pub(super) fn finely_anew(bench: &mut Bench, before: &Fit, settled: Fit) -> Fit {
    let names = |fit: &Fit| -> Vec<&str> { fit.effects.iter().map(|a| a.effect.name()).collect() };
    match names(before) == names(&settled) {
        true => settled,
        false => finely(bench, settled),
    }
}

/// The same causes on records that are marched in shorter steps and more turns than these, or in longer ones and fewer,
/// and with the other form of a mass, where they leave as much but for scatter and agree: a size that hangs on that is
/// known no better. Each in the form of the given ones; none where nothing hangs on it.
pub(super) fn marched_otherwise(problem: &Problem, fit: &Fit) -> Vec<Vec<Acting>> {
    let moves = fit.effects.iter().any(|a| a.effect.follows_motion());
    if !moves || problem.operators.form == Form::Stop {
        return Vec::new();
    }
    let own = (problem.hauling, problem.turns);
    let as_much = fit.misfit + scatter(problem.rows() as f64);
    let otherwise_formed: Vec<Acting> = fit.effects.iter().map(otherwise).collect();
    let ways = [COARSE, HAULING].into_iter().flat_map(|fineness| {
        let both = [&fit.effects, &otherwise_formed];
        both.map(|effects| (fineness, effects))
    });
    let others: Vec<_> = ways
        .filter(|(fineness, effects)| *fineness != own || **effects != fit.effects)
        .collect();
    let marched = others.into_par_iter().filter_map(|(fineness, effects)| {
        let mut other = problem.clone();
        (other.hauling, other.turns) = fineness;
        let begun = Fit {
            misfit: f64::INFINITY,
            ..fit.clone()
        };
        let other = refit_below(&other, &begun, effects.clone(), as_much);
        let same = *effects == fit.effects;
        let back = |a: &Acting| if same { a.clone() } else { otherwise(a) };
        let back: Vec<Acting> = other.effects.iter().map(back).collect();
        (other.misfit < as_much && (same || agree(&fit.effects, &back))).then_some(back)
    });
    marched.collect()
}

/// True where two sets of the same causes have masses of the same size, both in the same form.
fn agree(ones: &[Acting], others: &[Acting]) -> bool {
    let same = |(one, other): (&f64, &f64)| (one - other).abs() <= AGREE * one.abs();
    let mut masses = ones
        .iter()
        .zip(others)
        .filter(|(one, _)| one.effect.follows_motion());
    masses.all(|(one, other)| one.values.iter().zip(&other.values).all(same))
}

/// Parts of a step, and turns.
type Fineness = (u32, usize);

/// A fit, the fineness at which it was made, and what it leaves of all samples, counted as [`capped`] does.
struct Fitted {
    left: f64,
    fineness: Fineness,
    fit: Fit,
}

impl Fitted {
    /// A fit refitted at a fineness, which the bench has from now on.
    fn at(bench: &mut Bench, fineness: Fineness, fit: &Fit) -> Fitted {
        bench.haul(fineness);
        let fit = refit(&bench.train, fit, fit.effects.clone());
        Fitted {
            left: capped(bench, &fit),
            fineness,
            fit,
        }
    }

    /// True where this leaves less of so many rows than another, be it far less.
    fn explains_more(&self, other: &Fitted, rows: f64, far: bool) -> bool {
        let beyond = |of: &Fitted| (of.left - rows).max(scatter(rows));
        match far {
            true => beyond(other) > CLAIMED * beyond(self),
            false => other.left > self.left,
        }
    }

    /// This, or the other where that leaves less.
    fn or_nearer(self, other: Fitted) -> Fitted {
        if other.left < self.left { other } else { self }
    }
}

/// The effect with the same size in the other form of its cause.
fn otherwise(acting: &Acting) -> Acting {
    let values = find(acting.effect.name()).and_then(|c| c.otherwise(&acting.values));
    Acting {
        values: values.unwrap_or_else(|| acting.values.clone()),
        ..acting.clone()
    }
}

/// Sum of the whitened squares of what a model leaves of all samples, each counted up to [`MOST`].
fn capped(bench: &Bench, fit: &Fit) -> f64 {
    let whole = &bench.whole;
    let of_record = |(k, residuals): (usize, &Vec<f64>)| {
        let record = &whole.records[k];
        let both = residuals.iter().zip(&record.weight);
        let white = whitened(record.colour, both.map(|(left, w)| (*left, *w > 0.0)));
        let weighed = white.iter().zip(&record.weight);
        let each = weighed.map(|(white, w)| (w * white).powi(2).min(MOST));
        each.sum::<f64>()
    };
    fit.residuals(whole).iter().enumerate().map(of_record).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::intervals::intervals;
    use crate::diagnose::prepare::prepare;
    use crate::identify::baseline;
    use crate::identify::beginning::Beginning;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// Of noise alone nearly all is counted; a jump that no joint makes counts no more than its samples.
    #[test]
    fn what_no_model_follows_counts_by_its_samples() {
        let mut noise = drawn(20261125);
        let time: Vec<f64> = (0..3000).map(|i| 0.01 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.0 * t).sin()).collect();
        let record = Record {
            name: "jump".to_string(),
            displacement: force.iter().map(|f| 1e-8 * f + 1e-9 * noise()).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let mut bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        let fit = baseline(&bench.train);
        let rows = bench.whole.rows() as f64;
        let calm = capped(&bench, &fit);
        assert!((calm / rows - 1.0).abs() < 0.1, "{calm} of {rows}");
        let jump = 1000..1010;
        let displacement = &mut bench.whole.records[0].displacement;
        displacement[jump.clone()]
            .iter_mut()
            .for_each(|u| *u += 1e-6);
        let jumped = capped(&bench, &fit);
        let most = MOST * (jump.len() + 1) as f64;
        assert!(jumped > calm && jumped < calm + most, "{calm}, {jumped}");
    }

    /// A mass that rings on the joint.
    fn ringing(mass: f64) -> Acting {
        Acting {
            effect: find("fixture_inertia").unwrap().effect(),
            values: vec![mass, 0.0],
        }
    }

    /// Mass \[kg\] of [`bursts`].
    const MASS: f64 = 350.0;

    /// A spring that moves in bursts and breaks off between samples; its cell reads the mean inertia of a sample.
    fn bursts() -> Record {
        let (stiffness, step) = (1.6e8, 1.0 / 700.0);
        let mut noise = drawn(20261126);
        // Whole cycles, which end between two samples and begin at full speed, and rest.
        let (burst, rate) = (150.0 * step, 71.3);
        let moves = |t: f64| (t % burst).min(std::f64::consts::TAU / rate);
        let motion = |t: f64| 2e-5 * (rate * moves(t)).sin();
        let fine = 1e-3 * step;
        let speed = |t: f64| (motion(t + fine) - motion(t - fine)) / (2.0 * fine);
        let time: Vec<f64> = (0..2000).map(|i| step * f64::from(i)).collect();
        let inertia = |t: f64| MASS * (speed(t + 0.5 * step) - speed(t - 0.5 * step)) / step;
        Record {
            name: "bursts".to_string(),
            displacement: time.iter().map(|t| motion(*t) + 2e-8 * noise()).collect(),
            force: time
                .iter()
                .map(|t| stiffness * motion(*t) + inertia(*t))
                .collect(),
            time: Some(time),
            ..Record::default()
        }
    }

    #[test]
    fn a_mass_is_not_fitted_to_ringing_where_its_load_breaks_off() {
        let mut bench = prepare(Form::Play, &[bursts()], &[Beginning::default()]);
        let plain = baseline(&bench.train);
        let rings = refit(&bench.train, &plain, vec![ringing(250.0)]);
        assert_eq!(finely_anew(&mut bench, &rings, rings.clone()), rings);
        let calm = finely_anew(&mut bench, &plain, rings);
        // A sample's mean jumps where the motion breaks off; the difference of displacements reaches over two.
        let off = (calm.effects[0].values[1] / MASS - 1.0).abs();
        assert!(off < 0.15, "{calm:?}");
    }

    /// The steps of a march have a part in the size that is told by it.
    #[test]
    fn the_interval_of_a_mass_reaches_to_its_size_in_other_steps() {
        let bench = prepare(Form::Play, &[bursts()], &[Beginning::default()]);
        let plain = baseline(&bench.train);
        let calm = otherwise(&ringing(350.0));
        let calm = refit(&bench.train, &plain, vec![calm]);
        let others = marched_otherwise(&bench.train, &calm);
        let here = calm.effects[0].values[1];
        let there: Vec<f64> = others.iter().map(|o| o[0].values[1]).collect();
        let farthest = there.iter().map(|m| (m / here - 1.0).abs());
        assert!(farthest.fold(0.0, f64::max) > 0.02, "{here} {there:?}");
        let intervals = intervals(&bench.train, &bench.scale, &calm);
        let (lower, upper) = intervals[0][1].unwrap();
        assert!(there.iter().all(|m| (lower..=upper).contains(m)));
        assert!(marched_otherwise(&bench.train, &plain).is_empty());
    }

    #[test]
    fn of_two_forms_that_agree_the_one_that_leaves_less_is_right() {
        let fitted = |acting: Acting, left: f64| Fitted {
            left,
            fineness: HAULING,
            fit: Fit {
                effects: vec![acting],
                misfit: left,
                coefficients: Vec::new(),
                offsets: Vec::new(),
                series: None,
            },
        };
        let rings = fitted(ringing(100.0), 6400.0);
        let calm = |mass: f64| fitted(otherwise(&ringing(mass)), 6600.0);
        let agrees = |mass: f64| agree(&[ringing(100.0)], &[ringing(mass)]);
        assert!(agrees(91.0) && agrees(109.0) && !agrees(125.0));
        // Beyond noise a half more.
        assert!(rings.explains_more(&calm(109.0), 6000.0, false));
        assert!(!rings.explains_more(&calm(125.0), 6000.0, true));
        assert!(fitted(ringing(100.0), 6250.0).explains_more(&calm(125.0), 6000.0, true));
    }

    /// A mass on a damped spring (4 % of critical) that bursts of force set ringing, sixteen samples to a period, marched
    /// here in a hundred steps a sample: a march in a few damps it otherwise.
    #[test]
    fn the_size_of_a_mass_that_rings_is_told() {
        let (stiffness, mass, step) = (1.6e8_f64, 350.0, 5.8e-4);
        let (natural, cycle) = ((stiffness / mass).sqrt(), std::f64::consts::TAU / 100.0);
        let damping = 0.08 * natural * mass;
        let force = |t: f64| match t % 0.15 < cycle {
            true => 3000.0 * (100.0 * (t % 0.15)).sin(),
            false => 0.0,
        };
        let mut noise = drawn(20261128);
        let (mut u, mut v) = (0.0_f64, 0.0_f64);
        let (mut displacement, parts) = (Vec::new(), 100);
        for i in 0..4000 * parts {
            if i % parts == 0 {
                displacement.push(u + 5e-7 * noise());
            }
            let h = step / f64::from(parts);
            v += h * (force(h * f64::from(i)) - damping * v - stiffness * u) / mass;
            u += h * v;
        }
        let time: Vec<f64> = (0..4000).map(|i| step * f64::from(i)).collect();
        let record = Record {
            name: "rings".to_string(),
            displacement,
            force: time.iter().map(|t| force(*t)).collect(),
            time: Some(time),
            ..Record::default()
        };
        let mut bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        let begun = Fit {
            effects: vec![ringing(340.0)],
            misfit: f64::INFINITY,
            ..baseline(&bench.train)
        };
        let rings = refit(&bench.train, &begun, begun.effects.clone());
        let found = finely(&mut bench, rings);
        let size: f64 = found.effects[0].values.iter().sum();
        assert!((size / mass - 1.0).abs() < 0.03, "{:?}", found.effects);
    }
}
