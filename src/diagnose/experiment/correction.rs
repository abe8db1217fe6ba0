//! A learned correction where no cause explains what is left: sparse in named features of the
//! record, with a held-out gain of its own. It is no cause and enters no joint.

use crate::diagnose::gain;
use crate::diagnose::prepare::Bench;
use crate::identify::problem::Weighing;
use crate::identify::{Form, Prediction};
use crate::record::cycles::cycles;

/// A correction of the judged channel that is worth offering.
#[derive(Debug, Clone, PartialEq)]
pub struct Correction {
    /// Features with the coefficients of their values over their own largest magnitude, in the
    /// judged channel's unit: at its largest a feature adds this much.
    pub terms: Vec<(String, f64)>,
    /// Unit of the coefficients.
    pub unit: String,
    /// Held-out rms with the correction over without.
    pub ratio: f64,
    /// Its 95 % interval, by a bootstrap over whole held-out cycles; it excludes 1.
    pub interval: (f64, f64),
}

/// Most features of a correction.
const MOST: usize = 5;

/// The features, each over its own largest magnitude: name and one value per sample and record.
fn features(bench: &Bench, predictions: &[Prediction]) -> Vec<(&'static str, Vec<Vec<f64>>)> {
    let problem = &bench.whole;
    let force_driven = problem.operators.form == Form::Play;
    let mut all: Vec<(&'static str, Vec<Vec<f64>>)> = Vec::new();
    for (k, prediction) in predictions.iter().enumerate() {
        let record = &problem.records[k];
        let (input, _) = problem.channels(k);
        let output = &prediction.judged;
        let count = input.len();
        let names = match force_driven {
            true => ("force", "displacement"),
            false => ("displacement", "force"),
        };
        let x = unit(input);
        let y = unit(output);
        let mut turns = vec![0.0; count];
        for (n, cycle) in cycles(input).iter().enumerate() {
            turns[cycle.start..].fill(n as f64 + 1.0);
        }
        let age = unit(&turns);
        let rate = unit(&rate_of(&x, &record.steps));
        let rate_out = unit(&rate_of(&y, &record.steps));
        let mut work = 0.0;
        let work: Vec<f64> = (0..count)
            .map(|i| {
                if i > 0 {
                    work += (y[i] - y[i - 1]).abs() * x[i].abs();
                }
                work
            })
            .collect();
        let work = unit(&work);
        let late: Vec<f64> = age.iter().map(|n| 1.0 - (-5.0 * n).exp()).collect();
        let by = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect::<Vec<f64>>();
        let each = |a: &[f64], of: fn(f64) -> f64| a.iter().map(|a| of(*a)).collect::<Vec<f64>>();
        let own: [(&'static str, Vec<f64>); 17] = [
            (names.0, x.clone()),
            ("square of the input", each(&x, |x| x * x)),
            ("cube of the input", each(&x, |x| x * x * x)),
            ("magnitude of the input", each(&x, f64::abs)),
            (names.1, y.clone()),
            ("square of the response", each(&y, |y| y * y)),
            ("cube of the response", each(&y, |y| y * y * y)),
            ("rate of the input", rate.clone()),
            ("rate of the response", rate_out.clone()),
            ("direction of the input", each(&rate, f64::signum)),
            (
                "direction times magnitude of the input",
                by(&each(&rate, f64::signum), &each(&x, f64::abs)),
            ),
            ("cycle number", age.clone()),
            ("cycle number times the input", by(&age, &x)),
            ("first cycles times the input", by(&late, &x)),
            (
                "first cycles times the direction",
                by(&late, &each(&rate, f64::signum)),
            ),
            ("work so far times the input", by(&work, &x)),
            ("work so far times the response", by(&work, &y)),
        ];
        if all.is_empty() {
            all = own.iter().map(|(name, _)| (*name, Vec::new())).collect();
        }
        for (feature, (_, values)) in all.iter_mut().zip(own) {
            feature.1.push(values);
        }
    }
    all
}

/// Over its own largest magnitude.
fn unit(values: &[f64]) -> Vec<f64> {
    let largest = values.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
    let scale = if largest > 0.0 { largest.recip() } else { 0.0 };
    values.iter().map(|v| v * scale).collect()
}

/// Backward differences per step.
fn rate_of(values: &[f64], steps: &[f64]) -> Vec<f64> {
    (0..values.len())
        .map(|i| match i > 0 && steps[i] > 0.0 {
            true => (values[i] - values[i - 1]) / steps[i],
            false => 0.0,
        })
        .collect()
}

/// Learns a correction on the samples of the fit, one feature after the other as long as the
/// penalised likelihood gains, and offers it only where its held-out gain is sure.
pub fn correction(bench: &Bench, after: &[Prediction], unit: &str) -> Option<Correction> {
    let features = features(bench, after);
    let problem = &bench.train;
    let columns = features.len();
    // Products of the whitened features, offsets first, with the whitened residual last.
    let records = problem.records.len();
    let size = records + columns + 1;
    let mut products = vec![0.0; size * size];
    let mut rows = 0.0_f64;
    for k in 0..records {
        let (_, judged) = problem.channels(k);
        let mut weighing = Weighing::new(&problem.records[k], size);
        let mut row = vec![0.0; size];
        row[k] = 1.0;
        for (i, measured) in judged.iter().enumerate() {
            for (value, feature) in row[records..].iter_mut().zip(&features) {
                *value = feature.1[k][i];
            }
            row[size - 1] = measured - after[k].judged[i];
            if let Some(white) = weighing.weigh(i, &row) {
                rows += 1.0;
                for (a, x) in white.iter().enumerate() {
                    for (b, y) in white.iter().enumerate() {
                        products[a * size + b] += x * y;
                    }
                }
            }
        }
    }
    let mut gram = super::gram::Gram { size, products };
    gram.sweep(&(0..records).collect::<Vec<_>>());
    let target = size - 1;
    let mut chosen: Vec<usize> = Vec::new();
    let mut left = gram.at(target, target);
    while chosen.len() < MOST {
        let best = (records..target)
            .filter(|c| !chosen.contains(c))
            .map(|c| {
                let mut with = chosen.clone();
                with.push(c);
                (gram.left(target, &with), c)
            })
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((less, feature)) = best else { break };
        // BIC, counted in what is left per sample: noise is not white where structure is.
        let scale = (less / rows.max(1.0)).max(1.0);
        if (left - less) / scale < 3.0 * rows.max(3.0).ln() {
            break;
        }
        chosen.push(feature);
        left = less;
    }
    if chosen.is_empty() {
        return None;
    }
    let coefficients = gram.coefficients(target, &chosen)?;
    let corrected: Vec<Prediction> = after
        .iter()
        .enumerate()
        .map(|(k, prediction)| {
            let mut corrected = prediction.clone();
            for (c, &feature) in coefficients.iter().zip(&chosen) {
                let values = &features[feature - records].1[k];
                let both = corrected.judged.iter_mut().zip(values);
                both.for_each(|(y, x)| *y += c * x);
            }
            corrected
        })
        .collect();
    let (ratio, interval) = gain::ratio(bench, after, &corrected);
    let interval = interval.filter(|i| i.1 < 1.0)?;
    let names = chosen.iter().map(|&f| features[f - records].0.to_string());
    Some(Correction {
        terms: names.zip(coefficients).collect(),
        unit: unit.to_string(),
        ratio,
        interval,
    })
}
