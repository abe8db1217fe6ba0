//! Records whose own preload says that they are not of one joint.

use crate::read::Loaded;
use crate::record::cycles::rms;
use crate::record::written::{percent, quantity};

/// Share by which a preload differs or moves before it is said.
const TOLERATED: f64 = 0.05;
/// Parts of a record whose means tell whether its preload moves: noise of single samples does not.
const PARTS: usize = 20;

/// The preload of one record.
struct Preload<'a> {
    record: &'a str,
    mean: f64,
    /// Standard deviation within the record.
    scatter: f64,
    /// Smallest and largest of the means of its parts.
    range: (f64, f64),
    /// Standard deviation within its parts.
    noise: f64,
}

impl Preload<'_> {
    fn of<'a>(record: &'a str, channel: &[f64]) -> Preload<'a> {
        let mean_of = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let mean = mean_of(channel);
        let parts = || channel.chunks(channel.len().div_ceil(PARTS));
        let left = parts().flat_map(|part| {
            let mean = mean_of(part);
            part.iter().map(move |x| (x - mean).powi(2))
        });
        Preload {
            record,
            mean,
            scatter: rms(channel),
            noise: (left.sum::<f64>() / channel.len() as f64).sqrt(),
            range: parts()
                .map(mean_of)
                .fold((mean, mean), |(least, most), part| {
                    (least.min(part), most.max(part))
                }),
        }
    }

    /// Beyond the scatter within both, and by more than is tolerated.
    fn is_unlike(&self, other: &Preload) -> bool {
        let difference = (self.mean - other.mean).abs();
        let size = self.mean.abs().max(other.mean.abs());
        difference > self.scatter.max(other.scatter) && difference > TOLERATED * size
    }

    /// Share of the mean by which it moves, where that is beyond its noise.
    fn moves(&self) -> Option<f64> {
        let moves = self.range.1 - self.range.0;
        let share = moves / self.mean.abs();
        (moves > self.noise && share > TOLERATED).then_some(share)
    }
}

/// What the measured preloads of the records say of them, in sentences.
pub fn notes(loaded: &[Loaded]) -> Vec<String> {
    let preloads: Vec<Preload> = loaded
        .iter()
        .filter_map(|loaded| {
            let record = loaded.measurement.history()?;
            let channel = record.preload.as_deref().filter(|p| !p.is_empty())?;
            Some(Preload::of(&record.name, channel))
        })
        .collect();
    let mut notes = Vec::new();
    let least = preloads.iter().min_by(|a, b| a.mean.total_cmp(&b.mean));
    let most = preloads.iter().max_by(|a, b| a.mean.total_cmp(&b.mean));
    if let (Some(least), Some(most)) = (least, most)
        && least.is_unlike(most)
    {
        notes.push(format!(
            "Records that were measured at different preloads are records of different joints: diagnose \
             them apart. The preload is {} in {} and {} in {}.",
            quantity(least.mean, "N"),
            least.record,
            quantity(most.mean, "N"),
            most.record
        ));
    }
    let moving = preloads.iter().filter_map(|p| Some((p, p.moves()?)));
    notes.extend(moving.map(|(p, share)| {
        format!(
            "The measured preload of record {} moves between {} and {}, by {}: a joint answers \
             otherwise as its preload changes, and no cause reads that column.",
            p.record,
            quantity(p.range.0, "N"),
            quantity(p.range.1, "N"),
            percent(share)
        )
    }));
    notes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{Measurement, Record};

    fn record(name: &str, preload: impl Fn(usize) -> f64) -> Loaded {
        Loaded {
            measurement: Measurement::History(Record {
                name: name.into(),
                preload: Some((0..400).map(preload).collect()),
                ..Record::default()
            }),
            sha256: String::new(),
            notes: Vec::new(),
        }
    }

    #[test]
    fn unlike_and_moving_preloads_are_told_and_scatter_is_not() {
        let noise =
            |size: f64| move |i: usize| 1e4 + size * f64::from((i * 37 % 11) as u32 as i32 - 5);
        let quiet = record("quiet", noise(10.0));
        let loose = record("loose", |i| 0.9 * noise(10.0)(i));
        let noisy = record("noisy", |i| 0.9 * noise(500.0)(i));
        let falls = record("falls", |i| 1e4 * (1.0 - 2e-4 * i as f64));
        let told = |records: &[&Loaded]| {
            let records: Vec<Loaded> = records.iter().map(|r| (*r).clone()).collect();
            notes(&records)
        };
        assert_eq!(told(&[&quiet, &quiet]), Vec::<String>::new());
        assert_eq!(told(&[&quiet, &noisy]), Vec::<String>::new());
        let unloaded = record("unloaded", |i| noise(10.0)(i) - 1e4);
        let nothing = record("nothing", |_| 0.0);
        assert_eq!(told(&[&unloaded, &nothing]), Vec::<String>::new());
        let apart = told(&[&quiet, &loose]);
        assert!(apart[0].contains("diagnose them apart"), "{apart:?}");
        assert!(
            apart[0].contains("9.00 kN in loose and 10.0 kN in quiet"),
            "{apart:?}"
        );
        let moves = told(&[&falls]);
        assert!(moves[0].contains("moves between"), "{moves:?}");
    }
}
