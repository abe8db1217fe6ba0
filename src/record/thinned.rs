//! Long records with fewer samples: a search through the catalogue costs as many passes whatever a
//! record's length, and a densely sampled cycle says no more than a well sampled one.

use super::Record;
use super::cycles::{cycles, turning_points};

/// Samples per cycle that are never undercut: the height of a peak between two samples is then right
/// to `(π/100)²/2`, 5·10⁻⁴ of the amplitude, and the turning points themselves are kept.
const PER_CYCLE: usize = 100;

/// Every `k`-th sample and all turning points, with the smallest `k` for which at most about `most`
/// samples remain; `None` where the record is short enough or not sampled densely enough.
pub fn thinned(record: &Record, most: usize) -> Option<Record> {
    let count = record.len();
    let per_cycle = count / cycles(&record.force).len().max(1);
    let step = (count / most.max(1)).min(per_cycle / PER_CYCLE);
    if step < 2 {
        return None;
    }
    let mut kept = vec![false; count];
    (0..count).step_by(step).for_each(|i| kept[i] = true);
    for channel in [&record.force, &record.displacement] {
        for turn in turning_points(channel, 0.02) {
            kept[turn] = true;
        }
    }
    let pick = |channel: &[f64]| -> Vec<f64> {
        let both = channel.iter().zip(&kept);
        both.filter(|(_, kept)| **kept).map(|(v, _)| *v).collect()
    };
    let behind: Vec<usize> = (0..count).filter(|&i| kept[i]).collect();
    let alone = record.alone.iter();
    let alone = alone.filter_map(|i| behind.binary_search(i).ok());
    let optional = |channel: &Option<Vec<f64>>| channel.as_ref().map(|c| pick(c));
    Some(Record {
        name: record.name.clone(),
        time: optional(&record.time),
        force: pick(&record.force),
        displacement: pick(&record.displacement),
        preload: optional(&record.preload),
        temperature: optional(&record.temperature),
        acceleration: optional(&record.acceleration),
        straight: record.straight,
        drawn: record.drawn,
        noisy_drive: record.noisy_drive,
        calmed: record.calmed,
        alone: alone.collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dense_record_keeps_its_turning_points_and_a_sparse_one_everything() {
        let wave = |samples: usize| Record {
            force: (0..20 * samples)
                .map(|i| (std::f64::consts::TAU * i as f64 / samples as f64).sin())
                .collect(),
            displacement: (0..20 * samples).map(|i| i as f64).collect(),
            ..Record::default()
        };
        let dense = wave(1000);
        let thin = thinned(&dense, 4000).expect("dense enough");
        assert!((4000..4100).contains(&thin.len()), "{}", thin.len());
        let highest = |r: &Record| r.force.iter().copied().fold(f64::MIN, f64::max);
        assert_eq!(highest(&thin), highest(&dense));
        assert_eq!(thinned(&wave(150), 1000), None);
        assert_eq!(thinned(&dense, 20_000), None);
    }
}
