//! What is not in the catalogue and may be at work in place of what was named.

use super::growing::leaves_structure;
use super::prepare::Bench;
use super::refinements::better;
use super::search::Found;
use super::trials::{SHAPES, UNREFINED, alarm, dispersion, penalty};
use crate::causes::find;
use crate::identify::{Fit, Prediction, Score, refit, refit_below, scores};
use crate::joint::effect::Acting;
use crate::joint::parameters::Parameter;
use crate::outside::{OUTSIDE, Outsider};
use crate::record::written::quantity;
use rayon::prelude::*;

/// What a named cause of the set says itself of its doubles, with its name.
pub fn doubles(whole: &Fit, predictions: &[Prediction]) -> Vec<String> {
    let double = |acting: &Acting| {
        let cause = find(acting.effect.name())?;
        let mut tests = predictions.iter();
        let clause = tests.find_map(|p| cause.double(&acting.values, &p.truth))?;
        Some(format!("{}: {clause}", cause.name()))
    };
    whole.effects.iter().filter_map(double).collect()
}

/// Laws outside the catalogue that explain the records better than the set that was found, in the place of one of
/// its causes and beside the others; where nothing was found, than the baseline.
pub fn outsiders(bench: &Bench, found: &Found, timed: bool) -> Vec<String> {
    let best = &found.best;
    let places: Vec<Option<usize>> = match best.effects.is_empty() {
        true if !leaves_structure(&bench.train, best) => Vec::new(),
        true => vec![None],
        false => (0..best.effects.len()).map(Some).collect(),
    };
    let tried: Vec<(Option<usize>, &dyn Outsider)> = usable(timed)
        .into_iter()
        .flat_map(|one| places.iter().map(move |place| (*place, one)))
        .collect();
    tried
        .par_iter()
        .filter_map(|(place, one)| in_place_of(bench, found, (*place, *one)))
        .collect()
}

/// Laws outside the catalogue that records tell anything of.
fn usable(timed: bool) -> Vec<&'static dyn Outsider> {
    let all = OUTSIDE.iter().copied();
    all.filter(|one| timed || !one.needs_time()).collect()
}

/// True where one law outside the catalogue does alone what takes several causes, and better by as much as a cause has to
/// bring: what they have in common is its work.
pub fn one_does_it_all(bench: &Bench, found: &Found, timed: bool) -> bool {
    let set = &found.best.effects;
    if set.len() < 2 {
        return false;
    }
    let passes = |one: &&dyn Outsider| {
        let passes_for = one.passes_for();
        set.iter().any(|a| passes_for.contains(&a.effect.name()))
    };
    let margin = alarm(&bench.train);
    let enough = least_likely(bench, (&found.best, margin), &found.baseline);
    usable(timed).into_par_iter().filter(passes).any(|one| {
        let alone = fitted(bench, &found.baseline, one, enough);
        alone.is_some_and(|fit| likelier_by(bench, &fit, &found.best) > margin)
    })
}

/// What is said of one law in the place of one of the causes, or of none.
fn in_place_of(
    bench: &Bench,
    found: &Found,
    (place, one): (Option<usize>, &dyn Outsider),
) -> Option<String> {
    let (train, best) = (&bench.train, &found.best);
    let mut others = best.effects.clone();
    let named = place.map(|k| others.remove(k).effect.name());
    if named.is_some_and(|name| !one.passes_for().contains(&name)) {
        return None;
    }
    let start = match others.is_empty() {
        true => found.baseline.clone(),
        false => refit(train, best, others),
    };
    // A law that is to be named in no other's place has to prove itself as a cause has.
    let margin = if named.is_some() { 0.0 } else { alarm(train) };
    let fit = fitted(
        bench,
        &start,
        one,
        least_likely(bench, (best, margin), &start),
    )?;
    let values = &fit.effect(one.name())?.values;
    let said = one
        .parameters()
        .iter()
        .zip(values)
        .map(|(parameter, value)| {
            let Parameter { name, unit, .. } = parameter;
            format!("{name} {}", quantity(*value, unit))
        });
    let said: Vec<String> = said.collect();
    let place = named.map_or_else(String::new, |name| format!("{name}: "));
    (likelier_by(bench, &fit, best) > margin)
        .then(|| format!("{place}{} ({})", one.words(), said.join(", ")))
}

/// Evidence for one fit against another.
fn likelier_by(bench: &Bench, one: &Fit, other: &Fit) -> f64 {
    let train = &bench.train;
    let scale = dispersion(train, one).min(dispersion(train, other));
    let unlikely = |fit: &Fit| fit.misfit / scale + penalty(train, fit.free());
    unlikely(other) - unlikely(one)
}

/// Misfit above which no fit that grows from a start is likelier than another one by a margin.
fn least_likely(bench: &Bench, (other, margin): (&Fit, f64), start: &Fit) -> f64 {
    let train = &bench.train;
    let fewer = penalty(train, other.free()) - penalty(train, start.free()) - margin;
    other.misfit + dispersion(train, other) * fewer.max(0.0)
}

/// The best fit with a law beside a set, where its values are no cause's; without a prospect of a misfit below `enough`
/// only begun.
fn fitted(bench: &Bench, start: &Fit, one: &dyn Outsider, enough: f64) -> Option<Fit> {
    // What a refinement takes away is not known before it is fitted.
    let bound = enough + UNREFINED * (start.misfit - enough).max(0.0);
    let shapes = one.starts(&bench.scale).into_iter().map(|values| Acting {
        effect: one.effect(),
        values,
    });
    let mut scored: Vec<Score> = scores(&bench.train, start, &shapes.collect::<Vec<_>>());
    scored.sort_by(|a, b| b.fall.total_cmp(&a.fall));
    let fits = scored.into_iter().take(SHAPES).map(|score| {
        let mut effects = start.effects.clone();
        effects.push(score.acting);
        let fit = refit_below(&bench.train, start, effects, bound);
        if fit.misfit > bound {
            return fit;
        }
        let place = fit.effects.len() - 1;
        let refined = one.refined(&fit.effects[place].values, &bench.scale);
        let nearby = fit.misfit;
        better(&bench.train, fit, (place, refined), nearby)
    });
    let own = |fit: &Fit| {
        let acting = fit.effect(one.name());
        acting.is_some_and(|a| one.plausible(&a.values, &bench.scale))
    };
    fits.filter(own)
        .min_by(|a, b| a.misfit.total_cmp(&b.misfit))
}
