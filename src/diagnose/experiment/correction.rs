//! A learned correction where no cause explains what is left: sparse in named features of the
//! record, with a held-out gain of its own. It is no cause and enters no joint.

use super::features::{Feature, features};
use super::gram::Gram;
use crate::diagnose::gain::{edges, ratio};
use crate::diagnose::prepare::Bench;
use crate::identify::Prediction;
use crate::identify::weighing::Weighing;

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
const MOST: usize = 6;

/// Parts the cycles of the fit are dealt to, each predicted by the others.
const FOLDS: usize = 5;

/// Share of the error across the parts that a further feature must take away.
const FURTHER: f64 = 0.005;

/// Held-out rms, with over without, from which a correction is worth offering.
const WORTH: f64 = 0.98;

/// Learns a correction on the samples of the fit, one feature after the other as long as cycles
/// that the coefficients have not seen are predicted better, and offers it only where its gain on the
/// held-out samples, which had no part in that, is sure.
pub fn correction(bench: &Bench, after: &[Prediction], unit: &str) -> Option<Correction> {
    let features = features(bench, after);
    let learning = Learning::new(bench, after, &features);
    let chosen = learning.chosen();
    if chosen.is_empty() {
        return None;
    }
    let coefficients = learning.coefficients(&learning.whole, &chosen)?;
    let corrected: Vec<Prediction> = after
        .iter()
        .enumerate()
        .map(|(k, prediction)| {
            let mut corrected = prediction.clone();
            corrected
                .judged
                .iter_mut()
                .for_each(|y| *y += coefficients[k]);
            for (c, &feature) in coefficients[learning.records..].iter().zip(&chosen) {
                let both = corrected
                    .judged
                    .iter_mut()
                    .zip(&features[feature].values[k]);
                both.for_each(|(y, x)| *y += c * x);
            }
            corrected
        })
        .collect();
    let (ratio, interval) = ratio(bench, after, &corrected);
    let interval = interval.filter(|i| i.1 < 1.0 && ratio < WORTH)?;
    let names = chosen.iter().map(|&f| features[f].name.clone());
    Some(Correction {
        terms: names
            .zip(coefficients[learning.records..].iter().copied())
            .collect(),
        unit: unit.to_string(),
        ratio,
        interval,
    })
}

/// Products of the whitened columns: an offset per record, the features, and the residual last.
struct Learning {
    records: usize,
    features: usize,
    whole: Gram,
    parts: Vec<Gram>,
}

impl Learning {
    fn new(bench: &Bench, after: &[Prediction], features: &[Feature]) -> Learning {
        let problem = &bench.train;
        let records = problem.records.len();
        let size = records + features.len() + 1;
        let mut parts = vec![Gram::new(size); FOLDS];
        for k in 0..records {
            let (input, judged) = problem.channels(k);
            let edges = edges(input);
            let mut weighing = Weighing::new(&problem.records[k], size);
            let mut row = vec![0.0; size];
            row[k] = 1.0;
            let mut block = 0;
            for (i, measured) in judged.iter().enumerate() {
                while edges.get(block + 1).is_some_and(|end| i >= *end) {
                    block += 1;
                }
                for (value, feature) in row[records..].iter_mut().zip(features) {
                    *value = feature.values[k][i];
                }
                row[size - 1] = measured - after[k].judged[i];
                if let Some(white) = weighing.weigh(i, &row) {
                    let products = &mut parts[block % FOLDS].products;
                    for (a, x) in white.iter().enumerate() {
                        let line = products[a * size..(a + 1) * size].iter_mut();
                        line.zip(white).for_each(|(p, y)| *p += x * y);
                    }
                }
            }
        }
        let whole = parts.iter().fold(Gram::new(size), |sum, p| sum.plus(p));
        Learning {
            records,
            features: features.len(),
            whole,
            parts,
        }
    }

    /// Columns of the offsets and of the given features.
    fn members(&self, chosen: &[usize]) -> Vec<usize> {
        let features = chosen.iter().map(|f| self.records + f);
        (0..self.records).chain(features).collect()
    }

    fn coefficients(&self, gram: &Gram, chosen: &[usize]) -> Option<Vec<f64>> {
        gram.coefficients(self.whole.size - 1, &self.members(chosen))
    }

    /// Squared error of every part as the others predict it.
    fn across(&self, chosen: &[usize]) -> Option<f64> {
        let members = self.members(chosen);
        let target = self.whole.size - 1;
        let mut error = 0.0;
        for part in &self.parts {
            let coefficients = self.coefficients(&self.whole.minus(part), chosen)?;
            let both = || coefficients.iter().zip(&members);
            error += part.at(target, target);
            for (c, &i) in both() {
                error -= 2.0 * c * part.at(i, target);
                error += both().map(|(d, &j)| c * d * part.at(i, j)).sum::<f64>();
            }
        }
        error.is_finite().then_some(error)
    }

    /// Features, one after the other, that predict the parts best.
    fn chosen(&self) -> Vec<usize> {
        let mut chosen: Vec<usize> = Vec::new();
        let Some(mut left) = self.across(&chosen) else {
            return chosen;
        };
        while chosen.len() < MOST {
            let others = (0..self.features).filter(|f| !chosen.contains(f));
            let best = others
                .filter_map(|f| {
                    let with: Vec<usize> = chosen.iter().copied().chain([f]).collect();
                    Some((self.across(&with)?, f))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((less, feature)) = best else { break };
            if less > (1.0 - FURTHER) * left {
                break;
            }
            chosen.push(feature);
            left = less;
        }
        chosen
    }
}
