//! What a joint went through before a record begins.
//!
//! A joint remembers where its load has turned. A record that begins in the middle of a test, or whose
//! driving channel does not read zero where the joint is at rest, is answered by another joint than a
//! virgin one until its own load has been everywhere before; taken for virgin, it would look as if friction
//! changed over the first cycles.

use super::before_all::before_all;
use super::fit::{Fit, baseline, least_misfit};
use super::gone_on::{from_readings, gone_on};
use super::operators::Form;
use super::past::{finely_moved, past, reconsidered};
use super::prepared::Prepared;
use super::problem::Problem;
use crate::record::cycles::{span, turning_points};
use rayon::prelude::*;

/// How a record begins, in units of the driving channel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Beginning {
    /// Reading at which the joint is at rest: the zero of the driving channel.
    pub zero: f64,
    /// Readings at which the load had turned before, oldest first; none for a virgin joint.
    pub turned: Vec<f64>,
    /// True where those are the turns of the record before, and not sought.
    pub goes_on: bool,
}

impl Beginning {
    /// A virgin joint that is at rest at a reading.
    pub fn at(zero: f64) -> Beginning {
        Beginning {
            zero,
            ..Beginning::default()
        }
    }

    /// A joint whose load had turned at these readings, oldest first.
    pub(super) fn behind(turned: Vec<f64>) -> Beginning {
        Beginning {
            turned,
            ..Beginning::default()
        }
    }

    /// True for a virgin joint at the zero of its channel.
    pub fn is_virgin(&self) -> bool {
        *self == Beginning::default()
    }

    /// Count of values that it takes to say: turns before the record; a zero is its first reading.
    pub fn values(&self) -> usize {
        match self.goes_on {
            true => 0,
            false => self.turned.len(),
        }
    }

    /// True where there are turns before the record that were sought.
    pub fn is_sought(&self) -> bool {
        self.values() > 0
    }
}

/// Share of the largest reading below which the first one is zero.
const ZERO: f64 = 0.02;

/// Share of the largest reading from which the first one may be an offset of the zero: below it no noise of a cell
/// shows the difference.
const OFFSET: f64 = 0.002;

/// Mean square of what the baseline leaves in the beginning, over that of the rest, above which another
/// beginning is tried.
const DOUBTFUL: f64 = 2.0;

/// Share of what a virgin joint leaves in the beginning that another beginning may leave.
const HALF: f64 = 0.5;

/// Fall of the misfit, over what is left per sample, that another beginning must bring.
pub(super) const FALL: f64 = 30.0;

/// Share of the range below which a turn of the load is none.
pub const BAND: f64 = 0.02;

/// Other beginnings of the records that are worth a search, none where no other comes near the truth of any.
///
/// Each record is asked alone, by the misfit of the best joint for it: another beginning has to take away half of
/// what a virgin joint leaves until the load has turned twice; where the first reading is not zero, which a
/// virgin joint's is as a rule, any part of it. The first readings themselves as the zeros are another alternative to
/// the turns before them, however much they leave beside causes not yet known. A joint that goes on where the record
/// before left it is one more, see [`gone_on`], and one that went through the same before each of them, see [`before_all`].
/// `first` is the baseline of virgin joints. A record whose first reading is zero is asked only where it is `doubted` that
/// its joint is virgin: nothing but the misfit of its beginning speaks against that.
pub fn beginnings(problem: &Problem, first: &Fit, doubted: bool) -> Vec<Vec<Beginning>> {
    let form = problem.operators.form;
    let predictions = first.predict(problem);
    let both = problem.records.par_iter().zip(&predictions);
    let nearest: Vec<Beginning> = both
        .map(|(record, prediction)| beginning((form, doubted), record, &prediction.judged))
        .collect();
    let reading = |record: &Prepared| {
        let (input, _) = record.channels(form);
        match begins_within(OFFSET, input) {
            true => Beginning::default(),
            false => Beginning::at(input[0]),
        }
    };
    let readings = problem.records.iter().map(reading).collect();
    let on = gone_on(problem, nearest);
    let mut all = match doubted {
        true => before_all(problem, on),
        false => on,
    };
    all.push(readings);
    for zeros in zeros(problem) {
        all.extend(from_readings(problem, &zeros));
    }
    all.dedup();
    all.retain(|one| one.iter().any(|b| !b.is_virgin()));
    all
}

/// Readings of a joint at rest that goes on through all records, none where all of them begin at zero: those of a sensor that
/// none has touched, of one set anew where each test begins at rest, and of one set anew while the joint stayed where it was.
fn zeros(problem: &Problem) -> Vec<Vec<f64>> {
    let inputs: Vec<&[f64]> = (0..problem.records.len())
        .map(|k| problem.channels(k).0)
        .collect();
    if inputs.iter().all(|input| begins_within(OFFSET, input)) {
        return Vec::new();
    }
    let own: Vec<f64> = inputs.iter().map(|input| input[0]).collect();
    let mut stayed = vec![own[0]];
    for (k, pair) in inputs.windows(2).enumerate() {
        let reached = pair[0][pair[0].len() - 1] - stayed[k];
        stayed.push(own[k + 1] - reached);
    }
    let mut all = vec![own.clone()];
    for other in [vec![own[0]; own.len()], stayed] {
        let near = |one: &Vec<f64>| {
            let mut apart = one.iter().zip(&other).zip(&inputs);
            apart.all(|((a, b), input)| (a - b).abs() <= OFFSET * span(input))
        };
        if !all.iter().any(near) {
            all.push(other);
        }
    }
    all
}

/// True where the first reading is none beside the largest.
pub fn at_zero(input: &[f64]) -> bool {
    begins_within(ZERO, input)
}

fn begins_within(share: f64, input: &[f64]) -> bool {
    let largest = input.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    input.first().is_none_or(|x| x.abs() <= share * largest)
}

fn beginning((form, doubted): (Form, bool), record: &Prepared, predicted: &[f64]) -> Beginning {
    let (input, judged) = record.channels(form);
    let forgotten = early(input);
    if forgotten == 0 {
        return Beginning::default();
    }
    let left = |predicted: &[f64]| -> (f64, f64) {
        let square = |i: usize| match record.counts(i) {
            true => (judged[i] - predicted[i]).powi(2),
            false => 0.0,
        };
        let sum = |from: usize, to: usize| (from..to).map(square).sum::<f64>();
        (sum(0, forgotten), sum(forgotten, judged.len()))
    };
    let (early, late) = left(predicted);
    let rest = judged.len() - forgotten;
    let doubtful = doubted && rest > 0 && early / forgotten as f64 > DOUBTFUL * late / rest as f64;
    let offset = !at_zero(input);
    if !doubtful && !offset {
        return Beginning::default();
    }
    let left_early = |beginning: &Beginning| {
        let one = alone(form, record, beginning);
        left(&baseline(&one).predict(&one)[0].judged).0
    };
    let virgin = Beginning::default();
    let few = thinned(form, record, forgotten);
    // Slow noise is followed by any freedom: it counts for as few samples as vary by themselves.
    let weighted = record.weight.iter().filter(|w| **w > 0.0).count() as f64;
    let samples = match few.colour == record.colour {
        true => weighted,
        false => weighted * record.colour.independence(),
    };
    let altogether = |beginning: &Beginning| least_misfit(&alone(form, &few, beginning));
    let (virgin_early, virgin_all) = rayon::join(|| left_early(&virgin), || altogether(&virgin));
    let best = past((input, samples), altogether);
    let Some((_, best)) = best.filter(|(all, _)| *all < virgin_all) else {
        return virgin;
    };
    let (all, best) = finely_moved(best, altogether);
    // Another zero is the simpler way to begin, where it leaves as little.
    let zero_suits = offset && !wins(all, altogether(&Beginning::at(input[0])), samples);
    let other = match zero_suits {
        true => None,
        false => reconsidered((all, &best), (&altogether, samples), input),
    };
    let (all, best) = match other {
        Some(other) => finely_moved(other, altogether),
        None => (all, best),
    };
    let nearer = offset || left_early(&best) < HALF * virgin_early;
    match nearer && wins(all, virgin_all, samples) {
        true => best,
        false => virgin,
    }
}

/// True where what is left falls by enough for another beginning.
pub(super) fn wins(all: f64, before: f64, samples: f64) -> bool {
    before - all > FALL * all / samples
}

/// Samples until the load has turned twice: what came before the record is forgotten by then, or nearly so.
pub fn early(input: &[f64]) -> usize {
    turns(input).get(1).map_or(0, |second| second + 1)
}

/// Where the load turns within the record: not at the first sample, nor where a load at rest only trembles before it
/// sets out.
pub(super) fn turns(input: &[f64]) -> Vec<usize> {
    let dead = BAND * span(input);
    let set_out = |turn: &usize| (input[*turn] - input[0]).abs() > dead;
    let all = turning_points(input, BAND).into_iter();
    all.skip_while(|turn| !set_out(turn)).collect()
}

pub(super) fn low_high(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

/// The record with every sample of its beginning and fewer behind, which tell the joint but not where it was before.
fn thinned(form: Form, record: &Prepared, forgotten: usize) -> Prepared {
    let every = record.sparsest_of_cycles(form).unwrap_or(1);
    let mut few = record.clone();
    few.thin(form, (forgotten, every, record.time.len()));
    few
}

/// One record with a beginning, on a grid for its own range.
fn alone(form: Form, record: &Prepared, beginning: &Beginning) -> Problem {
    let mut record = record.clone();
    record.begin(form, beginning);
    Problem::of(form, vec![record])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Record;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    const SAMPLES: usize = 1500;

    /// What the force does of which records are cut: blocks of five levels.
    fn force(levels: [f64; 5]) -> Vec<f64> {
        let level = |i: usize| levels[i * 5 / (2 * SAMPLES)];
        let sine = |i: usize| (std::f64::consts::TAU * 0.01 * i as f64).sin();
        (0..2 * SAMPLES).map(|i| level(i) * sine(i)).collect()
    }

    /// A joint under blocks up and down from sample `from` on, with noise of a thousandth, as a record of its own
    /// whose force reads `zero` too much.
    fn record(from: usize, zero: f64) -> Problem {
        record_of(force([400.0, 1000.0, 700.0, 900.0, 500.0]), from, zero)
    }

    fn record_of(force: Vec<f64>, from: usize, zero: f64) -> Problem {
        let test = |force: &[f64]| Record {
            displacement: vec![0.0; force.len()],
            time: Some((0..force.len()).map(|i| 0.01 * i as f64).collect()),
            force: force.to_vec(),
            ..Record::default()
        };
        let played = Problem::new(Form::Play, &[test(&force)]);
        let mut joint = vec![0.0; played.operators.columns()];
        joint[0] = 1e-9;
        joint[1..=played.operators.edges.len()].fill(1e-10);
        let answer = &played.predict(&joint, &[])[0].judged;
        let mut random = ChaCha8Rng::seed_from_u64(20261122);
        let mut noise = || 3e-9 * (random.random::<f64>() - 0.5);
        let kept = from..from + SAMPLES;
        let read: Vec<f64> = force[kept.clone()].iter().map(|f| f + zero).collect();
        let mut cut = test(&read);
        cut.displacement = answer[kept].iter().map(|u| u + noise()).collect();
        Problem::new(Form::Play, &[cut])
    }

    fn found(problem: &Problem) -> Option<Beginning> {
        let all = beginnings(problem, &baseline(problem), true);
        all.first().map(|one| one[0].clone())
    }

    #[test]
    fn what_a_baseline_leaves_is_told_by_its_normal_equations_whatever_drifts() {
        let mut problem = record(0, 0.0);
        let left = baseline(&problem).misfit;
        // One value more of 1500 samples.
        let told = least_misfit(&problem);
        assert!(told < left && told > 0.99 * left, "{told} {left}");
        for (i, u) in problem.records[0].displacement.iter_mut().enumerate() {
            *u += 1e-9 * i as f64;
        }
        let beside_drift = least_misfit(&problem);
        assert!(
            (beside_drift / told - 1.0).abs() < 1e-3,
            "{beside_drift} {told}"
        );
    }

    #[test]
    fn a_virgin_joint_has_no_other_beginning() {
        assert_eq!(found(&record(0, 0.0)), None);
    }

    #[test]
    fn the_zero_of_a_force_is_where_it_begins() {
        let problem = record(0, 150.0);
        let left = |other: &Beginning| {
            let mut begun = problem.clone();
            begun.records[0].begin(Form::Play, other);
            baseline(&begun).misfit
        };
        let all = beginnings(&problem, &baseline(&problem), true);
        let others = all.iter().map(|one| &one[0]);
        let nearest = others.min_by(|a, b| left(a).total_cmp(&left(b))).unwrap();
        assert!((nearest.zero - 150.0).abs() < 1e-9 && nearest.turned.is_empty());
    }

    #[test]
    fn a_record_that_begins_late_is_answered_from_where_the_load_turned() {
        // In the level of 1000 N, behind its valley and behind its peak.
        for (from, last, within) in [(690, -1000.0, 20.0), (640, 1000.0, 20.0)] {
            let problem = record(from, 0.0);
            let other = found(&problem).unwrap();
            let turn = *other.turned.last().unwrap();
            assert!((turn - last).abs() < within, "{from}: {other:?}");
            leaves_noise_alone(&problem, &other);
        }
    }

    /// Every level that shrank left a turn up and one down, which later loads close one by one.
    #[test]
    fn a_record_from_a_test_that_shrinks_is_answered_from_all_its_turns() {
        for from in [1290, 1320] {
            let problem = record_of(force([1000.0, 650.0, 350.0, 500.0, 1000.0]), from, 0.0);
            leaves_noise_alone(&problem, &found(&problem).unwrap());
        }
    }

    /// From a large block the load went over to a small one on its way, and left two turns between them.
    #[test]
    fn turns_that_came_to_nothing_in_the_search_make_room_for_an_older_one() {
        let levels = [1000.0, 250.0, 400.0, 600.0, 1000.0];
        let mut load = force(levels);
        let over = 20;
        for (i, f) in load
            .iter_mut()
            .enumerate()
            .skip(600 - over)
            .take(125 + over)
        {
            let part = (i + over - 600) as f64 / (125 + over) as f64;
            let level = levels[0] + part * (levels[1] - levels[0]);
            *f *= level / levels[if i < 600 { 0 } else { 1 }];
        }
        for from in [960, 1010, 1060, 1100] {
            let problem = record_of(load.clone(), from, 0.0);
            leaves_noise_alone(&problem, &found(&problem).unwrap());
        }
    }

    #[test]
    fn a_load_that_trembles_at_rest_has_not_turned() {
        let load: Vec<f64> = (0..400).map(|i| (0.05 * f64::from(i)).sin()).collect();
        let at_rest = (0..20).map(|i| if i == 7 { -1e-3 } else { 0.0 });
        let later: Vec<f64> = at_rest.chain(load.iter().copied()).collect();
        let two = early(&load);
        assert_eq!(early(&later), 20 + two);
        // Three quarters of a circle.
        assert_eq!(
            two,
            (0.75 * std::f64::consts::TAU / 0.05).round() as usize + 1
        );
    }

    /// With that beginning, where a virgin joint leaves far more.
    fn leaves_noise_alone(problem: &Problem, beginning: &Beginning) {
        let virgin = baseline(problem).misfit;
        let mut begun = problem.clone();
        begun.records[0].begin(Form::Play, beginning);
        // A twelfth of the square of its width for every sample.
        let noise = SAMPLES as f64 * 9e-18 / 12.0;
        let left = baseline(&begun).misfit;
        assert!(
            virgin > 3.0 * noise && left < 1.15 * noise,
            "{beginning:?}: {virgin} {left} {noise}"
        );
    }
}
