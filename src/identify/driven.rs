//! What a drive does between its samples: a measured one turns there, one that a program made goes straight.

use super::beginning::FALL;
use super::fit::least_misfit;
use super::operators::Form;
use super::problem::Problem;
use crate::record::Record;
use rayon::prelude::*;

/// The records with their drive as it leaves less of them: smooth, with tips between samples, as it is taken to be
/// where that makes no difference, or straight from sample to sample.
///
/// Told by the best joint without any cause, for all records together, each by its own joint: one that begins otherwise
/// than a virgin joint's leaves too much to tell anything, and takes no say from the others. A record that a program made
/// of a joint's law, sample by sample, holds no answer to tips between them; a joint that is given those remembers turns
/// that never were.
pub fn as_driven(form: Form, records: &[Record]) -> Vec<Record> {
    let straight = |record: &Record| Record {
        straight: true,
        ..record.clone()
    };
    let left = |record: Record| least_misfit(&Problem::new(form, &[record]));
    // Twice the logarithm of how much likelier a straight drive is, of noise that is what the joint leaves.
    let likelier = |record: &Record| {
        let (smooth, other) = rayon::join(|| left(record.clone()), || left(straight(record)));
        let [smooth, other] = [smooth, other].map(|left| left.max(f64::MIN_POSITIVE));
        record.len() as f64 * (smooth / other).ln()
    };
    match records.par_iter().map(likelier).sum::<f64>() > FALL {
        true => records.iter().map(straight).collect(),
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
        // A joint that was loaded before its record takes nothing from what the other record tells.
        let mut late = record(1, 0.02);
        for channel in [&mut late.force, &mut late.displacement] {
            channel.drain(..311);
        }
        late.time.as_mut().unwrap().drain(..311);
        assert!(as_driven(Form::Play, &[record(1, 0.02), late])[1].straight);
        // Where noise hides the difference a drive is a measured one.
        assert!(!as_driven(Form::Play, &[record(1, 5.0)])[0].straight);
    }
}
