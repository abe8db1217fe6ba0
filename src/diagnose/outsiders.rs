//! What is not in the catalogue and may be at work in place of what was named.

use super::coarsely::Coarsely;
use super::drawn_drives::Drives;
use super::growing::leaves_structure;
use super::prepare::Bench;
use super::probability::temperature;
use super::refinements::better;
use super::search::Found;
use super::trials::{SHAPES, UNREFINED, alarm, dispersion, penalty};
use crate::causes::{Scale, find};
use crate::identify::{Fit, Prediction, Problem, Score, refit, refit_below, scores};
use crate::joint::effect::Acting;
use crate::joint::parameters::Parameter;
use crate::outside::{OUTSIDE, Outsider};
use crate::record::written::quantity;
use rayon::prelude::*;

/// A law that is not in the catalogue.
type Law = &'static dyn Outsider;

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
/// its causes and beside the others, or beside all of them, where they leave structure or it is told that there is more,
/// and noise of the drives makes less of it; where nothing was found, than the baseline.
pub(super) fn outsiders(
    (bench, drives): (&Bench, Option<&Drives>),
    found: &Found,
    (timed, beside): (bool, bool),
) -> Vec<String> {
    let best = &found.best;
    let more = beside || leaves_structure(&bench.train, best);
    let in_places = (0..best.effects.len()).map(Some);
    let places: Vec<Option<usize>> = more.then_some(None).into_iter().chain(in_places).collect();
    let usable = usable(bench, timed);
    let said = places
        .into_par_iter()
        .filter_map(|place| said_of((bench, drives), found, place, &usable));
    said.collect()
}

/// What is said of the law that is likeliest in the place of one of the causes, or beside all of them.
fn said_of(
    (bench, drives): (&Bench, Option<&Drives>),
    found: &Found,
    place: Option<usize>,
    usable: &[Law],
) -> Option<String> {
    let best = &found.best;
    let named = place.map(|k| best.effects[k].effect.name());
    let asked = |one: &Law| match named {
        Some(name) => one.passes_for(name),
        None => best.effects.is_empty() || one.stands_for_one(),
    };
    let others = place.map_or_else(|| best.effects.clone(), |k| best.others(k));
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
    let Likelier { law, fit, .. } = likeliest(bench, found, those(usable, asked), others, margin)?;
    let of_noise = |drives: &Drives| place.is_none() && drives.make_as_much((best, &fit));
    if drives.is_some_and(of_noise) {
        return None;
    }
    let values = &fit.effect(law.name())?.values;
    let values = law.parameters().iter().zip(values);
    let said = values
        .filter(|(parameter, value)| parameter.neutral != Some(**value))
        .map(|(parameter, value)| {
            let Parameter { name, unit, .. } = parameter;
            format!("{name} {}", quantity(*value, unit))
        });
    let said: Vec<String> = said.collect();
    Some(format!("{lead}{} ({})", law.words(), said.join(", ")))
}

/// Laws outside the catalogue that records tell anything of, of joints made anew none of one that goes on from record to
/// record.
fn usable(bench: &Bench, timed: bool) -> Vec<Law> {
    let goes_on = bench.train.records.iter().any(|r| r.beginning.goes_on);
    let all = OUTSIDE.iter().copied();
    let told = |one: &Law| timed || !one.needs_time();
    all.filter(told)
        .filter(|one| !(goes_on && one.is_made_anew()))
        .collect()
}

/// Places of named causes that one law outside the catalogue stands for, better by as much as a cause has to bring, over the
/// [`temperature`] of probabilities, as no law is quite true: of all
/// where it does alone what takes several, as what they have in common is its work; else of the one in whose place it does
/// most, of a law that stands for a single one.
pub fn stood_for(bench: &Bench, found: &Found, timed: bool) -> Vec<usize> {
    let best = &found.best;
    let all = 0..best.effects.len();
    let several = all.len() > 1;
    let margin = alarm(&bench.train) * temperature(found.brings(&bench.train));
    let usable = usable(bench, timed);
    let passes = |one: &Law, k: usize| one.passes_for(best.effects[k].effect.name());
    let alone = |one: &Law| {
        let stands = several || one.stands_for_one();
        stands && all.clone().any(|k| passes(one, k))
    };
    if likeliest(bench, found, those(&usable, alone), Vec::new(), margin).is_some() {
        return all.collect();
    }
    let likelier = |k: usize| {
        let asked = |one: &Law| several && one.stands_for_one() && passes(one, k);
        let one = likeliest(bench, found, those(&usable, asked), best.others(k), margin)?;
        Some((one.by, k))
    };
    let tried = all.clone().into_par_iter().filter_map(likelier);
    let most = tried.max_by(|a, b| a.0.total_cmp(&b.0));
    most.map(|(_, k)| k).into_iter().collect()
}

/// A law outside the catalogue that is likelier than the named causes.
struct Likelier {
    law: Law,
    /// Its evidence against them.
    by: f64,
    /// The fit with it.
    fit: Fit,
}

/// The usable laws that are asked.
fn those(usable: &[Law], asked: impl Fn(&Law) -> bool) -> Vec<Law> {
    usable.iter().copied().filter(asked).collect()
}

/// The likeliest of these laws beside these causes, by more than a margin.
fn likeliest(
    bench: &Bench,
    found: &Found,
    laws: Vec<Law>,
    causes: Vec<Acting>,
    margin: f64,
) -> Option<Likelier> {
    if laws.is_empty() {
        return None;
    }
    let beside = Beside::of(bench, found, causes);
    let enough = least_likely(bench, (&found.best, margin), &beside.start);
    let likelier = |law: Law| {
        let fit = beside.fitted(law, enough)?;
        let by = likelier_by(bench, &fit, &found.best);
        (by > margin).then_some(Likelier { law, by, fit })
    };
    let tried = laws.into_par_iter().filter_map(likelier);
    tried.max_by(|a, b| a.by.total_cmp(&b.by))
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

/// Causes beside which laws are tried, fitted without them, of long records to few samples as well.
struct Beside<'a> {
    bench: &'a Bench,
    start: Fit,
    coarsely: Option<Coarsely>,
}

impl Beside<'_> {
    fn of<'a>(bench: &'a Bench, found: &Found, causes: Vec<Acting>) -> Beside<'a> {
        let start = match causes.is_empty() {
            true => found.baseline.clone(),
            false if causes == found.best.effects => found.best.clone(),
            false => refit(&bench.train, &found.best, causes),
        };
        Beside {
            bench,
            coarsely: Coarsely::of(&bench.train, &start),
            start,
        }
    }

    /// The best fit with a law beside them, where its values are no cause's; without a prospect of a misfit below `enough`
    /// only begun.
    fn fitted(&self, law: Law, enough: f64) -> Option<Fit> {
        let Bench { train, scale, .. } = self.bench;
        let own = |fit: &Fit| {
            fit.effect(law.name())
                .is_some_and(|a| law.plausible(&a.values, scale))
        };
        // What a refinement takes away is not known before it is fitted.
        let bound = enough + UNREFINED * (self.start.misfit - enough).max(0.0);
        let best = |problem: &Problem, start: &Fit, bound: f64| {
            let shapes = shapes(problem, scale, start, law).into_iter();
            let fits = shapes.map(|effects| {
                let fit = refit_below(problem, start, effects, bound);
                refined((problem, scale), law, fit, bound)
            });
            let own = fits.filter(own);
            own.min_by(|a, b| a.misfit.total_cmp(&b.misfit))
        };
        let fit = match &self.coarsely {
            None => best(train, &self.start, bound),
            Some(coarsely) => {
                let fit = coarsely.fitted((train, &self.start), bound, best)?;
                Some(refined((train, scale), law, fit, bound))
            }
        };
        fit.filter(own)
    }
}

/// Sets with the shapes of a law that take most away to first order.
fn shapes(problem: &Problem, scale: &Scale, start: &Fit, law: Law) -> Vec<Vec<Acting>> {
    let shapes = law.starts(scale).into_iter().map(|values| Acting {
        effect: law.effect(),
        values,
    });
    let mut scored: Vec<Score> = scores(problem, start, &shapes.collect::<Vec<_>>());
    scored.sort_by(|a, b| b.fall.total_cmp(&a.fall));
    let with = |score: Score| [start.effects.as_slice(), &[score.acting]].concat();
    scored.into_iter().take(SHAPES).map(with).collect()
}

/// The fit with the refinements of the law, which comes last, where it leaves less than `bound`.
fn refined((problem, scale): (&Problem, &Scale), law: Law, fit: Fit, bound: f64) -> Fit {
    match fit.effects.last() {
        Some(own) if fit.misfit <= bound => {
            let place = fit.effects.len() - 1;
            let refined = law.refined(&own.values, scale);
            let nearby = fit.misfit;
            better(problem, fit, (place, refined), nearby)
        }
        _ => fit,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// A displacement whose amplifier warms up within the first third of 16 000 samples, in white noise.
    fn warming() -> Bench {
        let mut noise = drawn(20261130);
        let time: Vec<f64> = (0..16_000).map(|i| 0.01 * f64::from(i)).collect();
        let level = |t: &f64| if *t < 80.0 { 40.0 } else { 60.0 };
        let force: Vec<f64> = time.iter().map(|t| level(t) * (0.5 * t).sin()).collect();
        let read = |(f, t): (&f64, &f64)| {
            let gain = 1.0 + 0.02 * (1.0 - (-t / 30.0).exp());
            1e-8 * f * gain + 3e-9 * noise()
        };
        let record = Record {
            name: "warming".to_string(),
            displacement: force.iter().zip(&time).map(read).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        prepare(Form::Play, &[record], &[Beginning::default()])
    }

    /// What few samples have told of a law is fitted to all, as if all had been asked.
    #[test]
    fn laws_outside_are_tried_by_few_samples_with_the_same_end() {
        let bench = warming();
        let plain = baseline(&bench.train);
        let found = Found::unasked(plain.clone(), plain.clone(), Vec::new());
        let mut beside = Beside::of(&bench, &found, Vec::new());
        let enough = least_likely(&bench, (&plain, alarm(&bench.train)), &plain);
        let fitted = |beside: &Beside| {
            let all = usable(&bench, true).into_iter();
            let fits = all.filter_map(|law| Some((beside.fitted(law, enough)?, law.name())));
            fits.min_by(|a, b| a.0.misfit.total_cmp(&b.0.misfit))
                .unwrap()
        };
        assert!(beside.coarsely.is_some());
        let (few, law) = fitted(&beside);
        beside.coarsely = None;
        let (all, same) = fitted(&beside);
        assert_eq!((law, same), ("warming_gain", "warming_gain"));
        assert!((few.misfit - all.misfit).abs() < 0.5 && few.misfit < enough);
        let rates = [few, all].map(|fit| fit.effects[0].values[1] * 30.0);
        assert!(
            rates.iter().all(|rate| (rate - 1.0).abs() < 0.3),
            "{rates:?}"
        );
    }

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
