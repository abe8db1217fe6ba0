//! Which channel drives and which is judged: the form of the problem.

use super::full_slip::full_slip;
use crate::identify::Form;
use crate::record::Record;
use crate::record::calm::fastest;
use crate::record::cut::is_cut;
use crate::record::cycles::{rms, span};
use crate::record::mains::beneath_mains;
use crate::record::noise::from_differences;
use crate::record::repeats::from_repeats;
use crate::record::resolution::resolution_of_drive;
use std::cmp::Ordering;

/// Ratio of largest to smallest secant compliance beyond which the force-driven form is
/// ill-conditioned (compliance grows without bound at full slip).
const DEEP_SLIP: f64 = 8.0;

/// Chooses the form: the channel with less noise is the input, unless the joint slips in full or so deeply that displacement
/// has to be. Short of full slip, where every force still has its displacement, force drives if it is plainly the one
/// with less noise. What the end of a channel's range cuts off drove nothing: such a channel is judged if the other one
/// may drive.
pub fn form(records: &[Record]) -> Form {
    let deep = is_deep(records);
    let judges_a_cut_one = |form: Form| {
        let mut channels = records.iter().map(|record| form.channels(record));
        channels.any(|(drive, judged)| is_cut(judged, drive))
    };
    if judges_a_cut_one(Form::Stop) {
        return Form::Stop;
    }
    let slipped_in_full = full_slip(records).is_some();
    if !deep && !slipped_in_full && judges_a_cut_one(Form::Play) {
        return Form::Play;
    }
    let (force, displacement) = noise(records);
    let force_drives = displacement > ALIKE * force;
    if slipped_in_full || deep && !force_drives {
        return Form::Stop;
    }
    let alike = (force / displacement).max(displacement / force) < ALIKE;
    if alike && let Some(drives) = commanded(records) {
        return drives;
    }
    // Of two that show no noise at all neither is the more.
    if displacement >= force * (1.0 - f64::EPSILON.sqrt()) {
        Form::Play
    } else {
        Form::Stop
    }
}

/// Noise of force and of displacement as shares of what they do, summed over the records.
fn noise(records: &[Record]) -> (f64, f64) {
    let (mut force, mut displacement) = (0.0, 0.0);
    for record in records {
        let noise = |channel: &[f64], answer: &[f64]| {
            // A hum on a prescribed displacement is the sensor's: it says nothing of who drives.
            let fast = match &record.time {
                Some(time) => beneath_mains(time, channel),
                None => from_differences(channel),
            };
            // Nor is what a few samples of a smooth channel bend by.
            let fast = fast.deviation.min(fastest(channel));
            let repeated = from_repeats(&record.force, channel)
                .or_else(|| from_repeats(&record.displacement, channel));
            // What drifts or jumps from cycle to cycle is no noise; what is sharp in every cycle neither.
            let noise = repeated.map_or(fast, |noise| noise.deviation.min(fast));
            // What repeats to the last digit was still read by a converter.
            noise.max(resolution_of_drive(channel, answer)) / rms(channel)
        };
        force += noise(&record.force, &record.displacement);
        displacement += noise(&record.displacement, &record.force);
    }
    (force, displacement)
}

fn is_deep(records: &[Record]) -> bool {
    records.iter().any(|r| compliance_ratio(r) > DEEP_SLIP)
}

/// The other form of records whose channels' noise is alike, where it is one that their joint has; and the noise of the
/// channel that is judged in the first over that of the one that drives, as shares of what both do.
pub(super) fn other_form(records: &[Record], form: Form) -> Option<(Form, f64)> {
    let (force, displacement) = noise(records);
    let (other, by) = match form {
        Form::Play => (Form::Stop, displacement / force),
        Form::Stop => (Form::Play, force / displacement),
    };
    let alike = by.max(by.recip()) < ALIKE;
    let has = || other == Form::Stop || !is_deep(records) && full_slip(records).is_none();
    (alike && has()).then_some((other, by))
}

/// Ratio of the channels' fast noise up to which it does not tell which of them drives: of slow noise, which only
/// cycles that repeat show whole, a third is fast.
const ALIKE: f64 = 3.0;

/// The form in which the channel that repeats by itself drives: what answers it repeats up to its noise alone. Cycles whose
/// differences are no noise repeat nothing.
/// `None` where neither or both do.
fn commanded(records: &[Record]) -> Option<Form> {
    let repeats = |form: Form| {
        let judged = records.iter().filter(|record| {
            let (drive, response) = form.channels(record);
            from_repeats(drive, response).is_some_and(|noise| !noise.is_rather_structure())
        });
        judged.count()
    };
    match repeats(Form::Play).cmp(&repeats(Form::Stop)) {
        Ordering::Greater => Some(Form::Play),
        Ordering::Less => Some(Form::Stop),
        Ordering::Equal => None,
    }
}

/// Largest over smallest secant compliance, from the peaks of the loops: the smallest from the
/// steepest tenth of local slopes, the largest from the overall range.
pub fn compliance_ratio(record: &Record) -> f64 {
    let (force, displacement) = (span(&record.force), span(&record.displacement));
    if !(force > 0.0 && displacement > 0.0) {
        return 1.0;
    }
    // Slopes over pieces of a twentieth of the force range, so that noise matters little.
    let mut slopes = Vec::new();
    let mut from = 0;
    for i in 1..record.len() {
        let rise = record.force[i] - record.force[from];
        if rise.abs() > 0.05 * force {
            slopes.push((record.displacement[i] - record.displacement[from]) / rise);
            from = i;
        }
    }
    slopes.retain(|s| *s > 0.0);
    if slopes.is_empty() {
        return 1.0;
    }
    slopes.sort_by(f64::total_cmp);
    let stiff = slopes[slopes.len() / 10];
    displacement / force / stiff
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::gridded::tests::slid;
    use crate::record::noise::tests::white;
    use std::f64::consts::TAU;

    /// Displacement `F/(1 − |F|)` under growing cycles of force up to a share `reach` of 1 N, the force of full slip, with
    /// noise of either channel as a share of its peak.
    fn loaded(reach: f64, (of_force, of_displacement): (f64, f64)) -> Record {
        let (force_noise, noise) = (white(2000), white(4000).split_off(2000));
        let mut record = Record::default();
        for i in 0..2000 {
            let t = f64::from(i) / 2000.0;
            let force = reach * (0.4 + t).min(1.0) * (TAU * 5.0 * t).sin();
            let displacement = force / (1.0 - force.abs());
            let range = reach / (1.0 - reach);
            record
                .force
                .push(force + of_force * reach * force_noise[i as usize]);
            let noise = of_displacement * range * noise[i as usize];
            record.displacement.push(displacement + noise);
        }
        record
    }

    #[test]
    fn a_quiet_force_drives_short_of_full_slip_however_deep() {
        let deep = loaded(0.9, (1e-6, 1e-3));
        assert!(compliance_ratio(&deep) > DEEP_SLIP);
        assert_eq!(form(&[deep]), Form::Play);
        // Where noise does not plainly tell, or tells the other, a deeply slipping joint is driven by displacement.
        for noise in [(1e-3, 1e-3), (2e-3, 1e-3), (1e-3, 1e-6)] {
            assert_eq!(form(&[loaded(0.9, noise)]), Form::Stop, "{noise:?}");
        }
        let shallow = loaded(0.3, (1e-3, 2e-3));
        assert!(compliance_ratio(&shallow) < DEEP_SLIP);
        assert_eq!(form(&[shallow]), Form::Play);
    }

    /// Be its noise as it may.
    #[test]
    fn a_channel_that_its_range_cuts_is_judged() {
        let mut of_sensor = loaded(0.3, (1e-3, 1e-6));
        let mut of_cell = loaded(0.3, (1e-6, 1e-3));
        assert_eq!(form(std::slice::from_ref(&of_sensor)), Form::Stop);
        assert_eq!(form(std::slice::from_ref(&of_cell)), Form::Play);
        let cut = |channel: &mut Vec<f64>, end: f64| {
            channel.iter_mut().for_each(|x| *x = x.clamp(-end, end));
        };
        cut(&mut of_sensor.displacement, 0.36);
        cut(&mut of_cell.force, 0.27);
        assert_eq!(form(&[of_sensor]), Form::Play);
        assert_eq!(form(&[of_cell]), Form::Stop);
    }

    /// Force that repeats, and a displacement that drifts: steadily, or ever faster, by which its cycles differ.
    #[test]
    fn cycles_that_differ_by_what_is_no_noise_command_nothing() {
        let drifted = |power: i32| {
            let noise = white(4000);
            let mut record = Record::default();
            for (i, noise) in noise.iter().enumerate() {
                let (force, t) = ((TAU * i as f64 / 200.0).sin(), i as f64 / 4000.0);
                record.force.push(force);
                let drift = 3.0 * t.powi(power);
                record.displacement.push(force + drift + 1e-4 * noise);
            }
            commanded(&[record])
        };
        assert_eq!(drifted(1), Some(Form::Play));
        assert_eq!(drifted(2), None);
    }

    /// Be the force the quieter by far, and the slip less deep than would ask for it by its compliance.
    #[test]
    fn displacement_drives_where_a_stiff_joint_slipped_in_full() {
        let limits: Vec<f64> = (1..=40).map(|j| 0.025 * f64::from(j)).collect();
        let displacement: Vec<f64> = (0..3000)
            .map(|i| 2.0 * (TAU * f64::from(i) / 100.0).sin())
            .collect();
        let noise = white(6000);
        let (of_force, of_displacement) = noise.split_at(3000);
        let read = |truth: &[f64], noise: &[f64], loud: f64| -> Vec<f64> {
            let both = truth.iter().zip(noise);
            both.map(|(x, e)| x + loud * e).collect()
        };
        let records = [Record {
            force: read(&slid(&limits, &displacement), of_force, 0.05),
            displacement: read(&displacement, of_displacement, 0.02),
            ..Record::default()
        }];
        assert!(!is_deep(&records) && full_slip(&records).is_some());
        let (force, displacement) = super::noise(&records);
        assert!(displacement > ALIKE * force);
        assert_eq!(form(&records), Form::Stop);
    }

    /// A force that stays while the displacement goes on has no displacement of its own, however quiet it is.
    #[test]
    fn displacement_drives_where_the_joint_slipped_in_full() {
        let noise = white(2000);
        let mut record = Record::default();
        for (i, noise) in noise.iter().enumerate() {
            let displacement = 20.0 * (TAU * i as f64 / 500.0).sin();
            record.force.push(displacement.clamp(-1.0, 1.0));
            record.displacement.push(displacement + 1e-3 * noise);
        }
        assert!(full_slip(std::slice::from_ref(&record)).is_some());
        assert_eq!(form(&[record]), Form::Stop);
    }
}
