//! The noise of the channel that drives, of which the joint felt nothing.

use super::judged_channel::compliance_ratio;
use super::smooth_drive::{felt, smooth, unfelt};
use crate::identify::{Form, Problem, baseline};
use crate::record::Record;
use crate::record::calm::{calmed, fastest, fastest_part, slow};
use crate::record::cycles::span;
use crate::record::mains::beneath_mains;
use crate::record::ramps::ramped;
use crate::record::resolution::{of_step, resolution, step_of_drive};

/// What a drive's noise may add to the misfit of a record, in variances of the judged channel's noise, before it counts:
/// by what the joint makes of it where that is most. A mass that answers to it was seen to take a fifth of that, and to
/// pass for a cause at a few alarms; to smooth costs something as well, where a drive turns sharply.
const COUNTS: f64 = 300.0;

/// The same of a drive that goes straight from turn to turn or is smooth throughout: to draw it so costs nothing, while what
/// its noise does at turns stays until the next one, and a rate that is read off it is louder than itself.
const DRAWN: f64 = 1.0;

/// Correlation of neighbours in the fast part of what the baseline leaves from which the judged channel's noise is slow.
const SLOW: f64 = 0.3;

/// Share of the deviation of a converter's steps that a channel shows sample by sample where it goes on by about one in each.
const SHOWN: f64 = 0.5;

/// The records without the noise of the driving channel where it counts: sliders that stick answer it with their whole
/// stiffness; taken for the joint's, that looks like causes. A hum of the mains is no noise: it is a cause's to explain.
///
/// What the baseline leaves tells of that noise, and is taken off by as much as both go together, see [`apart`]; what is
/// left of it is calmed as far as the drive is smooth, for at a turn it stays in what sliders remember until the next one.
pub fn without_drive_noise(form: Form, records: &[Record]) -> Vec<Record> {
    let noise: Vec<[f64; 2]> = records.iter().map(|r| drive_noise(form, r)).collect();
    let loud = |counts: f64| -> Vec<Option<f64>> {
        let one = |&[noise, adds]: &[f64; 2]| (adds > counts).then_some(noise);
        noise.iter().map(one).collect()
    };
    let (heard, loud) = (loud(DRAWN), loud(COUNTS));
    let straight = straight(form, records, &heard);
    let smooth = smooth(form, records, &heard);
    let none = |of: &[Option<Record>]| of.iter().all(Option::is_none);
    if loud.iter().all(Option::is_none) && none(&straight) && none(&smooth) {
        return records.to_vec();
    }
    let residuals = residuals(form, records);
    let straight = drawn(form, records, straight, &residuals);
    let smooth = unfelt(form, records, smooth, &residuals);
    let plain = straight.into_iter().zip(smooth).map(|(a, b)| a.or(b));
    let both = records.iter().zip(&residuals).zip(loud).zip(plain);
    both.map(|(((record, residual), noise), plain)| {
        if let Some(plain) = plain {
            return Record {
                calmed: true,
                ..plain
            };
        }
        let (drive, judged) = form.channels(record);
        // A load that is held after each step has a fast part that is none of noise.
        let Some(noise) = noise.filter(|_| !felt(drive, judged, residual)) else {
            return record.clone();
        };
        let mut record = record.clone();
        let (drive, judged) = form.channels_mut(&mut record);
        let told = match stairs(drive, judged) {
            Some(_) => None,
            None => apart(drive, residual, noise),
        };
        let is_told = told.is_some();
        let (read, left) = told.unwrap_or_else(|| (drive.clone(), noise));
        *drive = calmed(&read, left);
        record.noisy_drive |= is_told;
        record.calmed = true;
        record
    })
    .collect()
}

/// What the baseline leaves of records as they were read.
pub(super) fn residuals(form: Form, records: &[Record]) -> Vec<Vec<f64>> {
    let problem = Problem::new(form, records);
    baseline(&problem).residuals(&problem)
}

/// Those of the records with noise in the drive of which that goes straight from turn to turn, drawn so.
fn straight(form: Form, records: &[Record], noise: &[Option<f64>]) -> Vec<Option<Record>> {
    let drawn = |(record, noise): (&Record, &Option<f64>)| {
        noise.as_ref()?;
        let mut record = record.clone();
        let clock = record.clock();
        let (drive, _) = form.channels_mut(&mut record);
        *drive = ramped(&clock, drive, fastest(drive))?;
        record.drawn = true;
        Some(record)
    };
    records.iter().zip(noise).map(drawn).collect()
}

/// Those of which the baseline leaves less as they are drawn: where a drive did what its noise says it leaves more.
fn drawn(
    form: Form,
    records: &[Record],
    straight: Vec<Option<Record>>,
    residuals: &[Vec<f64>],
) -> Vec<Option<Record>> {
    if straight.iter().all(Option::is_none) {
        return straight;
    }
    let both = records.iter().zip(&straight);
    let all: Vec<Record> = both
        .map(|(was, drawn)| drawn.as_ref().unwrap_or(was).clone())
        .collect();
    let then = self::residuals(form, &all);
    let square = |residual: &[f64]| residual.iter().map(|r| r * r).sum::<f64>();
    let less = straight.into_iter().zip(&then).zip(residuals);
    less.map(|((drawn, then), before)| drawn.filter(|_| square(then) < square(before)))
        .collect()
}

/// Deviation `Δ/√12` of a drive that is read in steps and stays on each for some samples: it shows none sample by sample,
/// and what it is off by follows the drive. `None` where the joint felt the steps.
fn stairs(drive: &[f64], judged: &[f64]) -> Option<f64> {
    let deviation = of_step(step_of_drive(drive, judged)?);
    (fastest(drive) < SHOWN * deviation).then_some(deviation)
}

/// Noise of the channel that drives, and what it may add to the misfit of the record.
pub(super) fn drive_noise(form: Form, record: &Record) -> [f64; 2] {
    let (drive, judged) = form.channels(record);
    let steepest = match form {
        Form::Play => 1.0,
        Form::Stop => compliance_ratio(record),
    };
    let noise = match &record.time {
        Some(time) => fastest(drive).min(beneath_mains(time, drive).deviation),
        None => fastest(drive),
    };
    let noise = noise.max(stairs(drive, judged).unwrap_or(0.0));
    let answered = noise * steepest * span(judged) / span(drive);
    let share = answered / fastest(judged).max(resolution(judged));
    [noise, share * share * judged.len() as f64]
}

/// The drive without what a model's residual tells of its noise, and the noise that is left.
///
/// Of a drive `x + e` a model of the slope K leaves `r = f − K e`, with f the noise of the judged channel. The estimate of
/// e with the least square error is `β r`, `β = −K var(e)/var(r)`, and what it leaves of e does not go with what the model
/// then leaves: else whatever follows the drive's own noise, its acceleration first of all, explains a part of that.
/// K is told by the fastest part of both channels, and the fast part of r alone is taken off: what a load or a cause does
/// in more than some samples is no noise. `None` where the judged channel's own noise is slow: other samples of r tell more
/// of e then, and a smooth drive is enough.
fn apart(drive: &[f64], residual: &[f64], noise: f64) -> Option<(Vec<f64>, f64)> {
    let less = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (slow, kept) = slow(residual);
    let left = less(residual, &slow);
    let (of_drive, of_left) = (fastest_part(drive), fastest_part(residual));
    let (square, both) = (product(&of_drive, &of_drive), product(&of_drive, &of_left));
    let variance = product(&left, &left) / kept / left.len() as f64;
    let alike = product(&left[1..], &left[..left.len() - 1]) / product(&left, &left);
    // Written so that what is no number is none.
    let told = square > 0.0 && variance > 0.0 && alike < SLOW;
    if !told {
        return None;
    }
    let slope = both / square;
    let by = slope * noise * noise / variance;
    let read = drive.iter().zip(&left).map(|(x, r)| x - by / kept * r);
    let left = noise * (1.0 - slope * by).clamp(0.0, 1.0).sqrt();
    Some((read.collect(), left))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::drawn;

    /// A sine of 60 samples a cycle in unit noise, and what a model of slope 2 leaves of a channel with noise of its own,
    /// white or with neighbours that go together.
    fn read(alike: f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let mut random = drawn(20_261_127);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let errors: Vec<f64> = (0..4000).map(|_| noise()).collect();
        let drive = errors.iter().enumerate();
        let drive = drive
            .map(|(i, e)| 1000.0 * (0.1 * i as f64).sin() + e)
            .collect();
        let mut own = 0.0;
        let left = errors.iter().map(|e| {
            own = alike * own + 2.0 * (1.0 - alike * alike).sqrt() * noise();
            own - 2.0 * e
        });
        let left = left.collect();
        (drive, left, errors)
    }

    /// Of two channels as loud as each other half the variance of the drive's noise is told, and what is left of it does not
    /// go with what the model leaves then.
    #[test]
    fn what_is_left_of_a_drive_s_noise_goes_with_nothing() {
        let (drive, left, errors) = read(0.0);
        let (read, noise) = apart(&drive, &left, 1.0).unwrap();
        let taken: Vec<f64> = drive.iter().zip(&read).map(|(x, y)| x - y).collect();
        let still: Vec<f64> = errors.iter().zip(&taken).map(|(e, t)| e - t).collect();
        let then: Vec<f64> = left.iter().zip(&taken).map(|(r, t)| r + 2.0 * t).collect();
        let mean = |a: &[f64], b: &[f64]| {
            let both = a.iter().zip(b).map(|(a, b)| a * b);
            both.sum::<f64>() / a.len() as f64
        };
        let correlation = |a: &[f64], b: &[f64]| mean(a, b) / (mean(a, a) * mean(b, b)).sqrt();
        assert!(correlation(&errors, &left) < -0.65);
        // The slow part of what is left, a ninth of its variance, is not taken off.
        assert!(
            correlation(&still, &then).abs() < 0.2,
            "{}",
            correlation(&still, &then)
        );
        assert!(
            (mean(&still, &still) - 0.5).abs() < 0.1,
            "{}",
            mean(&still, &still)
        );
        assert!((noise * noise - 0.5).abs() < 0.1, "{noise}");
    }

    #[test]
    fn slow_noise_of_the_judged_channel_tells_nothing_sample_by_sample() {
        let (drive, left, _) = read(0.95);
        let slow: Vec<f64> = left.iter().map(|r| 20.0 * r).collect();
        let (_, white, _) = read(0.0);
        assert!(apart(&drive, &white, 1.0).is_some());
        let mut level = 0.0;
        let slow: Vec<f64> = slow
            .iter()
            .map(|r| {
                level = 0.9 * level + r;
                level
            })
            .collect();
        assert_eq!(apart(&drive, &slow, 1.0), None);
    }

    /// Displacement of twenty plays whose limits are so far apart \[N\] under a force, with noise as a force.
    fn played(force: &[f64], apart: f64, mut noise: impl FnMut() -> f64) -> Vec<f64> {
        let mut reached = [0.0_f64; 20];
        let one = |force: &f64| {
            for (j, play) in reached.iter_mut().enumerate() {
                let limit = apart * (j + 1) as f64;
                *play = play.clamp(force - limit, force + limit);
            }
            1e-9 * (force + reached.iter().sum::<f64>() / 10.0 + noise())
        };
        force.iter().map(one).collect()
    }

    /// Cycles whose amplitude jumps from one to the next, so that parabolas do not suit the whole, with noise in both channels of
    /// which the joint felt none: an error at a turn is remembered until the next one.
    #[test]
    fn turns_are_calmed_of_a_drive_that_is_not_smooth_throughout() {
        let mut random = drawn(20_261_201);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let swings = |i: usize| {
            let amplitude = [100.0, 40.0, 70.0][i / 140 % 3];
            amplitude * (std::f64::consts::TAU * i as f64 / 140.0).sin()
        };
        let bare: Vec<f64> = (0..4200).map(swings).collect();
        let read: Vec<f64> = bare.iter().map(|force| force + 0.15 * noise()).collect();
        let records = [Record {
            time: Some((0..4200).map(|i| 0.01 * f64::from(i)).collect()),
            displacement: played(&bare, 5.0, || 0.25 * noise()),
            force: read.clone(),
            ..Record::default()
        }];
        assert!(smooth(Form::Play, &records, &[Some(0.15)])[0].is_none());
        let calm = without_drive_noise(Form::Play, &records);
        let off = |drive: &[f64]| {
            let turns = (35..4200).step_by(70);
            let off: Vec<f64> = turns.map(|i| (drive[i] - bare[i]).powi(2)).collect();
            (off.iter().sum::<f64>() / off.len() as f64).sqrt()
        };
        assert!(
            off(&calm[0].force) < 0.5 * off(&read),
            "{}",
            off(&calm[0].force) / off(&read)
        );
    }

    /// A triangle of force read with noise, of which the joint felt nothing, or all.
    #[test]
    fn ramps_are_drawn_where_the_joint_felt_no_noise() {
        let mut random = drawn(20_261_128);
        let mut noise = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let triangle = |i: usize| {
            let cycle = i as f64 / 73.0;
            100.0 * (4.0 * ((cycle + 0.75).fract() - 0.5).abs() - 1.0)
        };
        let bare: Vec<f64> = (0..1500).map(triangle).collect();
        let read: Vec<f64> = bare.iter().map(|force| force + 0.5 * noise()).collect();
        let mut answer = |force: &[f64]| played(force, 6.0, || 0.1 * noise());
        for (felt, displacement) in [(false, answer(&bare)), (true, answer(&read))] {
            let record = Record {
                time: Some((0..1500).map(|i| 0.01 * f64::from(i)).collect()),
                force: read.clone(),
                displacement,
                ..Record::default()
            };
            let found = &without_drive_noise(Form::Play, &[record])[0];
            assert_eq!(found.drawn, !felt);
            let off = found.force.iter().zip(&bare).map(|(x, y)| (x - y).powi(2));
            let rms = (off.sum::<f64>() / 1500.0).sqrt();
            assert_eq!(rms < 0.2, !felt, "{rms}");
        }
    }

    /// Its jumps, every fifth sample, are in all differences, and the joint felt every one.
    #[test]
    fn a_load_that_is_held_after_each_step_stays_as_it_is() {
        let swings = |i: usize| (400.0 * (0.004 * i as f64).sin()).round();
        let (own, others) = (
            crate::record::noise::tests::white(4000),
            crate::record::noise::tests::white(8000).split_off(4000),
        );
        for loud in [0.0, 0.2] {
            let held: Vec<f64> = (0..4000).map(|i| swings(i / 5 * 5)).collect();
            let record = Record {
                displacement: (0..4000).map(|i| 1e-8 * (held[i] + 0.3 * own[i])).collect(),
                force: (0..4000).map(|i| held[i] + loud * others[i]).collect(),
                time: Some((0..4000).map(|i| 1e-3 * f64::from(i)).collect()),
                ..Record::default()
            };
            let [noise, adds] = drive_noise(Form::Play, &record);
            assert!(noise > 0.1 && adds > COUNTS, "{noise} {adds}");
            let calm = without_drive_noise(Form::Play, std::slice::from_ref(&record));
            assert_eq!(calm[0].force, record.force);
        }
    }

    /// A load cell that reads in coarse steps shows no noise from sample to sample, and is off by its steps all the same.
    #[test]
    fn a_drive_that_stays_on_steps_is_smoothed() {
        let swings = |i: usize| 100.0 * (std::f64::consts::TAU * i as f64 / 800.0).sin();
        let force: Vec<f64> = (0..4000).map(swings).collect();
        let read: Vec<f64> = force.iter().map(|f| (f / 3.0).round() * 3.0).collect();
        assert_eq!(fastest(&read), 0.0);
        let noise = crate::record::noise::tests::white(4000);
        let both = force.iter().zip(&noise);
        let record = Record {
            displacement: both.map(|(f, e)| 1e-8 * (f + 0.5 * e)).collect(),
            force: read.clone(),
            time: Some((0..4000).map(|i| 1e-3 * f64::from(i)).collect()),
            ..Record::default()
        };
        let calm = without_drive_noise(Form::Play, &[record]);
        let off = |read: &[f64]| {
            let off = read.iter().zip(&force).map(|(a, b)| (a - b).powi(2));
            (off.sum::<f64>() / force.len() as f64).sqrt()
        };
        assert!(off(&calm[0].force) < 0.6 * off(&read));
        // One that goes on by a step in each sample shows what it is off by.
        let fast: Vec<f64> = read.iter().step_by(40).copied().collect();
        let answer: Vec<f64> = calm[0].displacement.iter().step_by(40).copied().collect();
        assert!(stairs(&fast, &answer).is_none());
    }
}
