//! What an extension gains on samples that no fit has seen.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::findings::Errors;
use super::prepare::Bench;
use crate::identify::{Fit, Form, Prediction, Problem};
use crate::record::cycles::cycles;

/// Resamples of the block bootstrap.
const RESAMPLES: usize = 500;

/// Held-out rms after over before, with its 95 % interval by a bootstrap over whole held-out
/// cycles; an empty interval where fewer than three of them are held out.
pub fn ratio(
    bench: &Bench,
    before: &[Prediction],
    after: &[Prediction],
) -> (f64, Option<(f64, f64)>) {
    let blocks = blocks(bench, before, after);
    let of = |blocks: &mut dyn Iterator<Item = (f64, f64)>| {
        let (mut old, mut new) = (0.0, 0.0);
        for (b, a) in blocks {
            old += b;
            new += a;
        }
        if old > 0.0 { (new / old).sqrt() } else { 1.0 }
    };
    let value = of(&mut blocks.iter().copied());
    if blocks.len() < 3 {
        return (value, None);
    }
    // A fixed seed: the same records give the same interval.
    let mut random = ChaCha8Rng::seed_from_u64(20_010_811);
    let mut resampled: Vec<f64> = (0..RESAMPLES)
        .map(|_| of(&mut (0..blocks.len()).map(|_| blocks[random.random_range(0..blocks.len())])))
        .collect();
    resampled.sort_by(f64::total_cmp);
    let quantile = |q: f64| resampled[(q * (RESAMPLES - 1) as f64).round() as usize];
    (value, Some((quantile(0.025), quantile(0.975))))
}

/// Squared errors before and after in each held-out cycle (or run of samples without cycles).
fn blocks(bench: &Bench, before: &[Prediction], after: &[Prediction]) -> Vec<(f64, f64)> {
    let mut blocks = Vec::new();
    for (k, held) in bench.held.iter().enumerate() {
        let (input, judged) = bench.whole.channels(k);
        let mut edges: Vec<usize> = cycles(input).iter().map(|c| c.start).collect();
        if edges.len() < 4 {
            edges = (0..judged.len())
                .step_by((judged.len() / 64).max(8))
                .collect();
        }
        edges.push(judged.len());
        for pair in edges.windows(2) {
            let (mut old, mut new, mut count) = (0.0, 0.0, 0);
            for i in (pair[0]..pair[1]).filter(|&i| held[i]) {
                old += (judged[i] - before[k].judged[i]).powi(2);
                new += (judged[i] - after[k].judged[i]).powi(2);
                count += 1;
            }
            if count > 0 {
                blocks.push((old, new));
            }
        }
    }
    blocks
}

/// Errors of one model in the judged channel's unit: on the fitted samples, on the held-out ones,
/// and of the energy per held-out cycle.
pub fn errors(bench: &Bench, predictions: &[Prediction]) -> Errors {
    let mut sums = [(0.0, 0.0); 2];
    let (mut wrong, mut counted) = (0.0, 0.0);
    for (k, held) in bench.held.iter().enumerate() {
        let (input, judged) = bench.whole.channels(k);
        for (i, &held) in held.iter().enumerate() {
            let sum = &mut sums[usize::from(held)];
            *sum = (
                sum.0 + (judged[i] - predictions[k].judged[i]).powi(2),
                sum.1 + 1.0,
            );
        }
        for cycle in cycles(input)
            .iter()
            .filter(|c| held[c.start] && held[c.end - 1])
        {
            let form = bench.whole.operators.form;
            let measured = energy(form, input, judged, cycle.start, cycle.end);
            let predicted = energy(form, input, &predictions[k].judged, cycle.start, cycle.end);
            if measured > 0.0 {
                wrong += (predicted / measured - 1.0).abs();
                counted += 1.0;
            }
        }
    }
    let rms = |sum: (f64, f64)| {
        if sum.1 > 0.0 {
            (sum.0 / sum.1).sqrt()
        } else {
            f64::NAN
        }
    };
    Errors {
        train_rms: rms(sums[0]),
        held_out_rms: rms(sums[1]),
        dissipation_error: (counted > 0.0).then(|| wrong / counted),
    }
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

/// Mean share by which taking the effects away changes the energy per cycle of the fitted joint.
pub fn share_of_energy(problem: &Problem, fit: &Fit, without: usize) -> f64 {
    let mut less = fit.clone();
    less.effects.remove(without);
    let (with, without) = (fit.predict(problem), less.predict(problem));
    let (mut share, mut count) = (0.0, 0.0);
    for k in 0..problem.records.len() {
        let (input, _) = problem.channels(k);
        for cycle in cycles(input) {
            let form = problem.operators.form;
            let all = energy(form, input, &with[k].judged, cycle.start, cycle.end);
            let rest = energy(form, input, &without[k].judged, cycle.start, cycle.end);
            if all > 0.0 {
                share += ((all - rest) / all).abs();
                count += 1.0;
            }
        }
    }
    if count > 0.0 { share / count } else { 0.0 }
}
