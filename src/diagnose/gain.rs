//! What an extension gains on samples that no fit has seen.

use super::bootstrap::{FEWEST, interval};
use super::findings::Errors;
use super::prepare::Bench;
use crate::identify::{Fit, Form, Prediction, Problem};
use crate::record::cycles::{cycles, rms};

/// Held-out rms after over before, with its 95 % interval by a bootstrap over whole held-out
/// cycles, over quarters of them where fewer than three are held out.
pub fn ratio(
    bench: &Bench,
    before: &[Prediction],
    after: &[Prediction],
) -> (f64, Option<(f64, f64)>) {
    let blocks = squares(bench, before, after);
    (of_squares(&blocks), interval(&blocks, of_squares))
}

/// The same without its interval.
pub fn ratio_alone(bench: &Bench, before: &[Prediction], after: &[Prediction]) -> f64 {
    of_squares(&squares(bench, before, after))
}

/// Squared errors (before, after) per block.
fn squares(bench: &Bench, before: &[Prediction], after: &[Prediction]) -> Vec<(f64, f64)> {
    let (old, new) = (blocks(bench, before), blocks(bench, after));
    old.iter().zip(&new).map(|(o, n)| (o.0, n.0)).collect()
}

/// rms after over rms before, of squared errors (before, after) per block.
pub(super) fn of_squares(blocks: &[(f64, f64)]) -> f64 {
    let sum = blocks
        .iter()
        .fold((0.0, 0.0), |s, b| (s.0 + b.0, s.1 + b.1));
    if sum.0 > 0.0 {
        (sum.1 / sum.0).sqrt()
    } else {
        1.0
    }
}

/// Where a channel is cut into blocks: at its cycles and around them, or evenly where it has too few.
pub fn edges(input: &[f64]) -> Vec<usize> {
    let mut edges: Vec<usize> = cycles(input).iter().map(|c| c.start).collect();
    if edges.len() < 4 {
        edges = (0..input.len())
            .step_by((input.len() / 64).max(8))
            .collect();
    }
    if edges.first() != Some(&0) {
        edges.insert(0, 0);
    }
    edges.push(input.len());
    edges
}

/// First and last time of every stretch of held-out samples, record by record.
pub fn stretches(bench: &Bench) -> Vec<Vec<(f64, f64)>> {
    let each = bench.held.iter().zip(&bench.whole.records);
    each.map(|(held, record)| {
        let runs = held.chunk_by(|a, b| a == b);
        let ends = runs.scan(0, |end, run| {
            *end += run.len();
            Some((run[0], *end - run.len(), *end - 1))
        });
        ends.filter(|(held, ..)| *held)
            .map(|(_, first, last)| (record.time[first], record.time[last]))
            .collect()
    })
    .collect()
}

/// Parts of a cycle that are blocks of their own where too few whole cycles are held out.
const QUARTERS: usize = 4;

/// Squared errors in each held-out cycle (or run of samples without cycles), and their count; in each quarter of
/// them where that gives too few blocks for an interval.
fn blocks(bench: &Bench, predictions: &[Prediction]) -> Vec<(f64, f64)> {
    let whole = blocks_of(bench, predictions, 1);
    match whole.len() < FEWEST {
        true => blocks_of(bench, predictions, QUARTERS),
        false => whole,
    }
}

fn blocks_of(bench: &Bench, predictions: &[Prediction], parts: usize) -> Vec<(f64, f64)> {
    let mut blocks = Vec::new();
    for (k, prediction) in predictions.iter().enumerate() {
        let (input, judged) = bench.whole.channels(k);
        let edges = edges(input);
        let cut = edges.windows(2).flat_map(|pair| {
            let at = |part: usize| pair[0] + (pair[1] - pair[0]) * part / parts;
            (0..parts).map(move |part| (at(part), at(part + 1)))
        });
        for (from, to) in cut {
            let (mut square, mut count) = (0.0, 0.0);
            for i in (from..to).filter(|&i| bench.is_unseen(k, i)) {
                square += (judged[i] - prediction.judged[i]).powi(2);
                count += 1.0;
            }
            if count > 0.0 {
                blocks.push((square, count));
            }
        }
    }
    blocks
}

/// Errors of one model in the judged channel's unit: on the fitted samples, on the held-out ones,
/// and of energy and stiffness per held-out cycle; intervals by a bootstrap over these cycles.
pub fn errors(bench: &Bench, predictions: &[Prediction]) -> Errors {
    let mut fitted = (0.0, 0.0);
    let (mut energies, mut slopes) = (Vec::new(), Vec::new());
    for (k, held) in bench.held.iter().enumerate() {
        let (input, judged) = bench.whole.channels(k);
        let predicted = &predictions[k].judged;
        for i in (0..held.len()).filter(|&i| bench.train.records[k].counts(i)) {
            fitted.0 += (judged[i] - predicted[i]).powi(2);
            fitted.1 += 1.0;
        }
        let form = bench.whole.operators.form;
        for cycle in cycles(input)
            .iter()
            .filter(|c| held[c.start..c.end].iter().all(|held| *held))
        {
            let loss = |y: &[f64]| energy(form, input, y, cycle.start, cycle.end);
            let measured = loss(judged);
            if measured > 0.0 {
                energies.push((loss(predicted) / measured - 1.0).abs());
            }
            let stiffness = |y: &[f64]| slope(form, input, y, cycle.start, cycle.end);
            if let Some((measured, predicted)) = stiffness(judged).zip(stiffness(predicted)) {
                slopes.push((predicted / measured - 1.0).abs());
            }
        }
    }
    let rms = |blocks: &[(f64, f64)]| {
        let sum = blocks
            .iter()
            .fold((0.0, 0.0), |s, b| (s.0 + b.0, s.1 + b.1));
        if sum.1 > 0.0 {
            (sum.0 / sum.1).sqrt()
        } else {
            f64::NAN
        }
    };
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len() as f64;
    let held_out = blocks(bench, predictions);
    Errors {
        train_rms: rms(&[fitted]),
        held_out_rms: rms(&held_out),
        held_out_interval: interval(&held_out, rms),
        dissipation_error: (!energies.is_empty()).then(|| mean(&energies)),
        dissipation_interval: interval(&energies, mean),
        stiffness_error: (!slopes.is_empty()).then(|| mean(&slopes)),
        stiffness_interval: interval(&slopes, mean),
    }
}

/// Share of the judged channel's variance that a model answers, of all records together.
pub fn follows(bench: &Bench, predictions: &[Prediction]) -> f64 {
    let (mut left, mut all) = (0.0, 0.0);
    for (k, prediction) in predictions.iter().enumerate() {
        let (_, judged) = bench.whole.channels(k);
        let errors = judged.iter().zip(&prediction.judged);
        left += errors.map(|(y, p)| (y - p).powi(2)).sum::<f64>();
        all += judged.len() as f64 * rms(judged).powi(2);
    }
    if all > 0.0 { 1.0 - left / all } else { 0.0 }
}

/// Slope of the loop over samples `from..to`, force over displacement \[N/m\]: of the line that
/// fits the judged channel over the prescribed one best, so that noise on the judged channel does not
/// bias it; `None` where it is not positive.
pub fn slope(form: Form, input: &[f64], judged: &[f64], from: usize, to: usize) -> Option<f64> {
    let (x, y) = (&input[from..to], &judged[from..to]);
    let count = x.len().max(1) as f64;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / count;
    let (about_x, about_y) = (mean(x), mean(y));
    let both = x.iter().zip(y);
    let product: f64 = both.map(|(x, y)| (x - about_x) * (y - about_y)).sum();
    let square: f64 = x.iter().map(|x| (x - about_x).powi(2)).sum();
    let slope = match form {
        Form::Play => square / product,
        Form::Stop => product / square,
    };
    (slope.is_finite() && slope > 0.0).then_some(slope)
}

/// Energy `∮ F dU` over samples `from..to` \[J\] (trapezium rule, closed by a straight line).
pub fn energy(form: Form, input: &[f64], judged: &[f64], from: usize, to: usize) -> f64 {
    let (force, displacement) = match form {
        Form::Play => (input, judged),
        Form::Stop => (judged, input),
    };
    let leg =
        |a: usize, b: usize| 0.5 * (force[a] + force[b]) * (displacement[b] - displacement[a]);
    (from + 1..to).map(|i| leg(i - 1, i)).sum::<f64>() + leg(to - 1, from)
}

/// Share of the energy that the fitted joint dissipates in all cycles by which taking an effect away changes it,
/// `Σ |D - D_without| / Σ D`: cycles count by what they dissipate, for of one that hardly does any change is many times it.
pub fn share_of_energy(problem: &Problem, fit: &Fit, without: usize) -> f64 {
    let less = Fit {
        effects: fit.others(without),
        ..fit.clone()
    };
    let (with, without) = (fit.predict(problem), less.predict(problem));
    let (mut changed, mut dissipated) = (0.0, 0.0);
    for k in 0..problem.records.len() {
        let (input, _) = problem.channels(k);
        for cycle in cycles(input) {
            let form = problem.operators.form;
            let all = energy(form, input, &with[k].judged, cycle.start, cycle.end);
            let rest = energy(form, input, &without[k].judged, cycle.start, cycle.end);
            if all > 0.0 {
                changed += (all - rest).abs();
                dissipated += all;
            }
        }
    }
    match dissipated > 0.0 {
        true => changed / dissipated,
        false => 0.0,
    }
}
