//! Full slip, where records show it: a force that stays while the displacement goes on.

use crate::record::Record;
use crate::record::cycles::span;

/// Share of the largest force of its sign from which a sample may be one of full slip.
const NEAR: f64 = 0.97;

/// Share of the samples of a sign that noise may lift above the force of full slip.
const LIFTED: f64 = 0.02;

/// Share of the displacement's range over which the force stays in full slip. A joint below it, whose compliance has
/// grown fourfold, takes less than half of that to the last three hundredths of its force.
const GOES_ON: f64 = 0.2;

/// Samples below the level that do not end a stretch of it: noise.
const GAP: usize = 3;

/// Fewest samples of a stretch.
const FEWEST: usize = 8;

/// Share by which the force of a stretch may still rise in its second half.
const STAYS: f64 = 0.01;

/// Force of full slip \[N\] with a 95 % interval, from the second halves of all stretches in which the force stays while
/// the displacement goes on; `None` where there is no such stretch, so that full slip was not reached.
///
/// The interval is of the stretches' own means, and no narrower than what the force still rises by within one.
pub fn full_slip(records: &[Record]) -> Option<(f64, (f64, f64))> {
    let stretches: Vec<Stretch> = records
        .iter()
        .flat_map(|record| [1.0, -1.0].map(|sign| stretches(record, sign)))
        .flatten()
        .collect();
    let count = stretches.len() as f64;
    let mean = stretches.iter().map(|s| s.force).sum::<f64>() / count;
    let square: f64 = stretches.iter().map(|s| (s.force - mean).powi(2)).sum();
    let own = stretches.iter().fold(0.0_f64, |most, s| most.max(s.wide));
    let wide = own.max(2.0 * (square / count).sqrt());
    (!stretches.is_empty()).then_some((mean, (mean - wide, mean + wide)))
}

/// A stretch of full slip: its force and half the width of that number's interval.
struct Stretch {
    force: f64,
    wide: f64,
}

fn stretches(record: &Record, sign: f64) -> Vec<Stretch> {
    let force: Vec<f64> = record.force.iter().map(|f| sign * f).collect();
    let mut sorted: Vec<f64> = force.iter().copied().filter(|f| *f > 0.0).collect();
    sorted.sort_by(f64::total_cmp);
    let lifted = (LIFTED * sorted.len() as f64) as usize;
    let Some(&level) = sorted.len().checked_sub(lifted + 1).map(|k| &sorted[k]) else {
        return Vec::new();
    };
    let near: Vec<usize> = (0..force.len())
        .filter(|&i| force[i] >= NEAR * level)
        .collect();
    let runs = near.chunk_by(|a, b| b - a <= GAP + 1);
    let range = span(&record.displacement);
    let told = runs.filter_map(|run| {
        let (first, last) = (*run.first()?, *run.last()?);
        // On the way up alone: from its peak the displacement goes back while the force falls.
        let along = |i: usize| sign * record.displacement[i];
        let top = (first..=last).max_by(|&a, &b| along(a).total_cmp(&along(b)))?;
        let half = first + (top - first) / 2;
        let goes_on = along(top) - along(first) > GOES_ON * range;
        (goes_on && top - first >= FEWEST).then(|| told(&force[half..=top]))?
    });
    told.collect()
}

/// What the second half of a stretch tells; `None` where its force still rises.
fn told(force: &[f64]) -> Option<Stretch> {
    let count = force.len() as f64;
    let mean = force.iter().sum::<f64>() / count;
    let middle = 0.5 * (count - 1.0);
    let (mut along, mut spread, mut square) = (0.0, 0.0, 0.0);
    for (i, f) in force.iter().enumerate() {
        let from_middle = i as f64 - middle;
        along += from_middle * (f - mean);
        spread += from_middle * from_middle;
        square += (f - mean).powi(2);
    }
    let rises = along / spread * count;
    let error = (square / count / count).sqrt();
    (rises.abs() < STAYS * mean).then_some(Stretch {
        force: mean,
        wide: 2.0 * error + 0.5 * rises.abs(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::white;
    use std::f64::consts::TAU;

    /// Sliders with limits up to `1`, together of slip force 800 N, under growing cycles of displacement of amplitude
    /// `reach` in units of the last one's limit.
    fn driven(reach: f64) -> Record {
        let sliders = 100;
        let mut at = vec![0.0_f64; sliders];
        let noise = white(2000);
        let displacement: Vec<f64> = (0..2000)
            .map(|i| f64::from(i) / 2000.0)
            .map(|t| reach * (0.3 + 0.7 * t) * (TAU * 5.0 * t).sin())
            .collect();
        let force = displacement.iter().zip(&noise).map(|(u, noise)| {
            let each = at.iter_mut().enumerate().map(|(k, at)| {
                let limit = (k + 1) as f64 / sliders as f64;
                *at = at.clamp(u - limit, u + limit);
                u - *at
            });
            let whole = sliders as f64 * (sliders + 1) as f64 / 2.0 / sliders as f64;
            800.0 / whole * each.sum::<f64>() + 2.0 * noise
        });
        Record {
            force: force.collect(),
            displacement,
            ..Record::default()
        }
    }

    #[test]
    fn a_plateau_tells_the_slip_force_and_a_joint_below_it_does_not() {
        for reach in [1.8, 4.0] {
            let (force, (low, high)) = full_slip(&[driven(reach)]).unwrap();
            assert!((force / 800.0 - 1.0).abs() < 0.005, "{reach}: {force}");
            assert!(low < 800.0 && 800.0 < high, "{low} {high}");
            assert!(high - low < 0.02 * 800.0, "{low} {high}");
        }
        for reach in [0.3, 0.7, 0.9] {
            assert_eq!(full_slip(&[driven(reach)]), None, "{reach}");
        }
        assert_eq!(full_slip(&[Record::default()]), None);
    }
}
