//! What is not in the catalogue and may be at work in place of what was named.

use super::growing::leaves_structure;
use super::prepare::Bench;
use super::probability::temperature;
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
/// its causes and beside the others, or beside all of them, where they leave structure or it is told that there is more;
/// where nothing was found, than the baseline.
pub fn outsiders(bench: &Bench, found: &Found, (timed, beside): (bool, bool)) -> Vec<String> {
    let best = &found.best;
    let more = beside || leaves_structure(&bench.train, best);
    let in_places = (0..best.effects.len()).map(Some);
    let places: Vec<Option<usize>> = in_places.chain(more.then_some(None)).collect();
    let asked = |one: &dyn Outsider, place: Option<usize>| {
        place.is_some() || best.effects.is_empty() || one.stands_for_one()
    };
    let tried: Vec<(Option<usize>, &dyn Outsider)> = usable(bench, timed)
        .into_iter()
        .flat_map(|one| places.iter().map(move |place| (*place, one)))
        .filter(|(place, one)| asked(*one, *place))
        .collect();
    let said = tried.par_iter().filter_map(|(place, one)| {
        let (likelier, said) = in_place_of(bench, found, (*place, *one))?;
        Some((*place, likelier, said))
    });
    let mut said: Vec<(Option<usize>, f64, String)> = said.collect();
    // In one place only one law can be at work: the likeliest.
    said.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    said.dedup_by_key(|(place, ..)| *place);
    said.into_iter().map(|(_, _, said)| said).collect()
}

/// Laws outside the catalogue that records tell anything of, of joints made anew none of one that goes on from record to
/// record.
fn usable(bench: &Bench, timed: bool) -> Vec<&'static dyn Outsider> {
    let goes_on = bench.train.records.iter().any(|r| r.beginning.goes_on);
    let all = OUTSIDE.iter().copied();
    let told = |one: &&dyn Outsider| timed || !one.needs_time();
    all.filter(told)
        .filter(|one| !(goes_on && one.is_made_anew()))
        .collect()
}

/// Places of named causes that one law outside the catalogue stands for, better by as much as a cause has to bring, over the
/// [`temperature`] of probabilities, as no law is quite true: of all
/// where it does alone what takes several, as what they have in common is its work; else of the one in whose place it does
/// most, of a law that stands for a single one.
pub fn stood_for(bench: &Bench, found: &Found, timed: bool) -> Vec<usize> {
    let set = &found.best.effects;
    let margin = alarm(&bench.train) * temperature(found.brings(&bench.train));
    let passes = |one: &dyn Outsider, k: usize| one.passes_for(set[k].effect.name());
    let all = 0..set.len();
    let alone = usable(bench, timed).into_par_iter().any(|one| {
        let stands = set.len() > 1 || one.stands_for_one();
        let asked = stands && all.clone().any(|k| passes(one, k));
        asked && beside(bench, found, (one, Vec::new()), margin).is_some()
    });
    if alone {
        return all.collect();
    }
    let likelier = |one, k| beside(bench, found, (one, others(set, k)), margin);
    let tried = usable(bench, timed)
        .into_par_iter()
        .filter(|one| one.stands_for_one() && set.len() > 1)
        .flat_map_iter(|one| all.clone().map(move |k| (k, one)))
        .filter(|(k, one)| passes(*one, *k))
        .filter_map(|(k, one)| Some((likelier(one, k)?.0, k)));
    let most = tried.max_by(|a, b| a.0.total_cmp(&b.0));
    most.map(|(_, k)| k).into_iter().collect()
}

/// The causes of a set but for one.
fn others(set: &[Acting], k: usize) -> Vec<Acting> {
    let mut others = set.to_vec();
    others.remove(k);
    others
}

/// Evidence beyond a margin for one law beside these causes against the named ones, and the fit with it.
fn beside(
    bench: &Bench,
    found: &Found,
    (one, others): (&dyn Outsider, Vec<Acting>),
    margin: f64,
) -> Option<(f64, Fit)> {
    let start = match others.is_empty() {
        true => found.baseline.clone(),
        false if others == found.best.effects => found.best.clone(),
        false => refit(&bench.train, &found.best, others),
    };
    let enough = least_likely(bench, (&found.best, margin), &start);
    let fit = fitted(bench, &start, one, enough)?;
    let likelier = likelier_by(bench, &fit, &found.best);
    (likelier > margin).then_some((likelier, fit))
}

/// Evidence for one law in the place of one of the causes, or beside all of them, and what is said of it.
fn in_place_of(
    bench: &Bench,
    found: &Found,
    (place, one): (Option<usize>, &dyn Outsider),
) -> Option<(f64, String)> {
    let set = &found.best.effects;
    let named = place.map(|k| set[k].effect.name());
    if named.is_some_and(|name| !one.passes_for(name)) {
        return None;
    }
    let others = place.map_or_else(|| set.clone(), |k| others(set, k));
    let lead = match named {
        Some(name) => format!("{name}: "),
        None if others.is_empty() => String::new(),
        None => "beside them: ".to_string(),
    };
    // A law that is to be named in no other's place has to prove itself as a cause has.
    let margin = if named.is_some() {
        0.0
    } else {
        alarm(&bench.train)
    };
    let (likelier, fit) = beside(bench, found, (one, others), margin)?;
    let values = &fit.effect(one.name())?.values;
    let values = one.parameters().iter().zip(values);
    let said = values
        .filter(|(parameter, value)| parameter.neutral != Some(**value))
        .map(|(parameter, value)| {
            let Parameter { name, unit, .. } = parameter;
            format!("{name} {}", quantity(*value, unit))
        });
    let said: Vec<String> = said.collect();
    Some((
        likelier,
        format!("{lead}{} ({})", one.words(), said.join(", ")),
    ))
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::identify::Form;
    use crate::identify::beginning::Beginning;
    use crate::record::Record;

    #[test]
    fn a_joint_that_goes_on_is_none_that_was_made_anew() {
        let force: Vec<f64> = (0..400).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let record = Record {
            displacement: force.iter().map(|f| 1e-8 * f).collect(),
            force,
            ..Record::default()
        };
        let virgin = [Beginning::default(), Beginning::default()];
        let mut bench = prepare(Form::Play, &[record.clone(), record], &virgin);
        let told = |bench: &Bench| usable(bench, true).iter().any(|one| one.is_made_anew());
        assert!(told(&bench));
        bench.train.records[1].beginning.goes_on = true;
        assert!(!told(&bench));
        assert_eq!(usable(&bench, true).len(), OUTSIDE.len() - 1);
    }
}
