//! What a drive does between its samples: a measured one turns there, one that a program made goes straight.

use super::beginning::wins;
use super::fit::least_misfit;
use super::operators::Form;
use super::problem::Problem;
use crate::record::Record;

/// The records with their drive as it leaves less of them: smooth, with tips between samples, as it is taken to be
/// where that makes no difference, or straight from sample to sample.
///
/// Told by the best joint without any cause, for all records together. A record that a program made of a joint's law, sample
/// by sample, holds no answer to tips between them; a joint that is given those remembers turns that never were.
pub fn as_driven(form: Form, records: &[Record]) -> Vec<Record> {
    let straight: Vec<Record> = records
        .iter()
        .map(|record| Record {
            straight: true,
            ..record.clone()
        })
        .collect();
    let left = |records: &[Record]| least_misfit(&Problem::new(form, records));
    let (smooth, other) = rayon::join(|| left(records), || left(&straight));
    let samples: usize = records.iter().map(Record::len).sum();
    match wins(other, smooth, samples as f64) {
        true => straight,
        false => records.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twelve sliders in parallel under a force, 25 samples a cycle and as many steps between two as given, with noise.
    fn record(parts: usize, noise: f64) -> Record {
        let force = |i: f64| 0.02 * i.min(250.0) * (0.2513 * i + 0.1).sin();
        let mut reached = [0.0_f64; 12];
        let mut random = crate::record::noise::tests::drawn(20261126);
        let (mut drive, mut answer) = (Vec::new(), Vec::new());
        for i in 0..400 {
            for part in 1..=parts {
                let now = force(f64::from(i) - 1.0 + part as f64 / parts as f64);
                for (j, p) in reached.iter_mut().enumerate() {
                    let limit = 0.3 * (j + 1) as f64;
                    *p = p.clamp(now - limit, now + limit);
                }
            }
            drive.push(force(f64::from(i)));
            let slipped: f64 = reached.iter().sum();
            answer.push(5.0 * drive[drive.len() - 1] + slipped + noise * random());
        }
        Record {
            name: "driven".to_string(),
            time: Some((0..400).map(f64::from).collect()),
            force: drive,
            displacement: answer,
            ..Record::default()
        }
    }

    #[test]
    fn a_drive_is_straight_where_the_joint_felt_no_tips_between_samples() {
        for (parts, straight) in [(1, true), (50, false)] {
            let found = as_driven(Form::Play, &[record(parts, 0.02)]);
            assert_eq!(found[0].straight, straight, "{parts} parts of a step");
        }
        // Where noise hides the difference a drive is a measured one.
        assert!(!as_driven(Form::Play, &[record(1, 5.0)])[0].straight);
    }
}
