//! Jolts of a load: what stands alone in the force where the load goes on at another rate.

use super::Record;
use super::outliers::{APART, typical};

/// Samples of a stretch whose rate is told.
const ASKED: usize = 6;

/// Typical changes of the rate, 1.15 standard deviations where they are noise, beyond which the load goes on at another
/// one: by chance one sample in two hundred thousand does.
const SUDDEN: f64 = 4.0;

/// The record with jolts of its load as they were read, and no longer marked, of one whose samples that stand alone were
/// `struck` out; `None` where there are none.
///
/// A load cell before a mass reads a jolt where the rate of the load changes at once, as from one level of a stepped sine
/// to the next. The joint has felt it: without it a model's mass goes on moving as it did. A spark knows nothing of
/// the load's rate.
pub fn felt(record: &Record, struck: &Record) -> Option<Record> {
    let changes = changes(&struck.force);
    let sudden = SUDDEN * typical(changes.clone());
    let jolts: Vec<usize> = struck
        .alone
        .iter()
        .copied()
        .filter(|&i| record.force[i] != struck.force[i])
        .filter(|&i| changes[i] > sudden)
        .collect();
    let mut felt = struck.clone();
    for &i in &jolts {
        felt.force[i] = record.force[i];
    }
    let lost = |i: &usize| !jolts.contains(i) || record.displacement[*i] != struck.displacement[*i];
    felt.alone.retain(lost);
    (!jolts.is_empty()).then_some(felt)
}

/// By how much the rate that one side foretells of every sample, by the parabola through it, differs from what the
/// other does, per sample; zero near the ends.
fn changes(channel: &[f64]) -> Vec<f64> {
    let reach = APART + ASKED;
    let middle = 0.5 * (ASKED - 1) as f64;
    let away = |j: usize| j as f64 - middle;
    let spread: f64 = (0..ASKED).map(|j| away(j).powi(2)).sum();
    let mean = spread / ASKED as f64;
    let bent = |j: usize| away(j).powi(2) - mean;
    let bends: f64 = (0..ASKED).map(|j| bent(j).powi(2)).sum();
    let outward = |at: &dyn Fn(usize) -> f64| {
        let slope = (0..ASKED).map(|j| away(j) * at(j)).sum::<f64>() / spread;
        let bend = (0..ASKED).map(|j| bent(j) * at(j)).sum::<f64>() / bends;
        slope - 2.0 * bend * (middle + (APART + 1) as f64)
    };
    let change = |i: usize| {
        if i < reach || i + reach >= channel.len() {
            return 0.0;
        }
        let behind = outward(&|j| channel[i + APART + 1 + j]);
        let before = -outward(&|j| channel[i - APART - 1 - j]);
        (behind - before).abs()
    };
    (0..channel.len()).map(change).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::drawn;
    use crate::record::outliers::struck_out;

    /// A stepped sine of force with a spike where each level begins, or where nothing does.
    fn spiked(at_levels: bool) -> Record {
        let mut noise = drawn(20261128);
        let level = |i: usize| 0.3 + 0.2 * (i / 400) as f64;
        let sine = |i: usize| (std::f64::consts::TAU * i as f64 / 100.0).sin();
        let mut force: Vec<f64> = (0..2000)
            .map(|i| level(i) * sine(i) + 1e-4 * noise())
            .collect();
        let displacement = force.iter().map(|f| 1e-6 * f).collect();
        for k in 1..5 {
            force[400 * k + if at_levels { 0 } else { 30 }] += 0.5;
        }
        Record {
            displacement,
            force,
            ..Record::default()
        }
    }

    #[test]
    fn what_stands_alone_where_the_load_changes_its_rate_is_a_jolt() {
        let record = spiked(true);
        let struck = struck_out(&record);
        assert_eq!(struck.alone, [400, 800, 1200, 1600]);
        let felt = felt(&record, &struck).unwrap();
        assert!(felt.alone.is_empty());
        assert_eq!(felt.force, record.force);
    }

    #[test]
    fn sparks_elsewhere_are_none() {
        let record = spiked(false);
        let struck = struck_out(&record);
        assert_eq!(struck.alone, [430, 830, 1230, 1630]);
        assert_eq!(felt(&record, &struck), None);
    }
}
