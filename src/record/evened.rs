//! Records whose samples are not evenly spaced in time, read off at even steps: noise, peaks and repeats are told from
//! neighbours, and neighbours have to be as far apart as others.

use super::Record;

/// Samples below which nothing is told of how even a clock is.
const FEWEST: usize = 32;

/// Multiple of the median step beyond which a step is a pause: nothing was measured there.
const PAUSE: f64 = 10.0;

/// Deviation of a step from the median one, as a share of it, from which a clock may be uneven.
const UNEVEN: f64 = 0.01;

/// Samples of a divided difference: its order is one less.
const TAPS: usize = 6;

/// Part of a channel's roughness at even steps that the clock has to leave of it: stamps that are only rounded, or set
/// late by a busy computer, make it rougher.
const SMOOTHER: f64 = 0.8;

/// Samples to either side over which steps are averaged.
const ABOUT: usize = 50;

/// Ratio of the steps about a sample up to which the cubic through four samples is read, and the chord beyond it: close
/// neighbours would say all of what lies far from them.
const REGULAR: f64 = 3.0;

/// The record at even steps where its own clock tells that they were not; `None` where they were, where the channels go
/// more smoothly at even steps than on that clock, or where there is no clock.
///
/// As many samples as before, between pauses each; where the rate changes, steps change slowly. Values are those of the
/// cubic through four neighbours (Lagrange), or of the chord. A sample that is read off one that stood alone does so
/// too. Checked by the tests below and by tests/uneven.rs.
pub fn evened(record: &Record) -> Option<Record> {
    let time = record.time.as_deref()?;
    if time.len() < FEWEST || !is_uneven(time) {
        return None;
    }
    let smoother = [&record.force, &record.displacement]
        .into_iter()
        .any(|channel| roughness(time, channel) < SMOOTHER * roughness(&counted(time), channel));
    if !smoother {
        return None;
    }
    let even = even_clock(time);
    let read = |channel: &Vec<f64>| read_off(time, channel, &even);
    let alone = (0..even.len()).filter(|&i| {
        let left = bracket(time, even[i]);
        let of = |at: usize| record.alone.binary_search(&at).is_ok();
        (left.saturating_sub(1)..left + 3).any(of)
    });
    Some(Record {
        name: record.name.clone(),
        force: read(&record.force),
        displacement: read(&record.displacement),
        preload: record.preload.as_ref().map(read),
        temperature: record.temperature.as_ref().map(read),
        acceleration: record.acceleration.as_ref().map(read),
        straight: record.straight,
        drawn: record.drawn,
        noisy_drive: record.noisy_drive,
        calmed: record.calmed,
        alone: match record.alone.is_empty() {
            true => Vec::new(),
            false => alone.collect(),
        },
        time: Some(even),
    })
}

/// Sample numbers.
fn counted(time: &[f64]) -> Vec<f64> {
    (0..time.len()).map(|i| i as f64).collect()
}

/// The upper median; zero of no values.
pub fn median(mut values: Vec<f64>) -> f64 {
    let middle = values.len() / 2;
    match values.is_empty() {
        true => 0.0,
        false => *values.select_nth_unstable_by(middle, f64::total_cmp).1,
    }
}

/// Median distance of neighbours.
fn usual_step(time: &[f64]) -> f64 {
    median(time.windows(2).map(|w| w[1] - w[0]).collect())
}

/// True where one step in a hundred differs from the median one; pauses do not count.
fn is_uneven(time: &[f64]) -> bool {
    let usual = usual_step(time);
    let steps = time.windows(2).map(|w| w[1] - w[0]);
    let steps: Vec<f64> = steps.filter(|step| *step < PAUSE * usual).collect();
    let off = steps.iter().filter(|s| (*s / usual - 1.0).abs() > UNEVEN);
    100 * off.count() > steps.len()
}

/// Median magnitude of divided differences of the fifth order, scaled so that white noise has the same on every clock:
/// `Σ w y/√(Σ w²)` with `w_j = 1/Π_(m≠j) (t_j − t_m)`. Those across a pause do not count.
fn roughness(time: &[f64], channel: &[f64]) -> f64 {
    let longest = PAUSE * usual_step(time);
    let all = time.windows(TAPS).zip(channel.windows(TAPS));
    let told = all.filter(|(t, _)| t.windows(2).all(|w| w[1] - w[0] < longest));
    let difference = |(t, y): (&[f64], &[f64])| {
        let (mut sum, mut squares) = (0.0, 0.0);
        for j in 0..TAPS {
            let others = (0..TAPS).filter(|m| *m != j);
            let weight: f64 = others.map(|m| longest / (t[j] - t[m])).product();
            sum += weight * y[j];
            squares += weight * weight;
        }
        (sum / squares.sqrt()).abs()
    };
    let told: Vec<f64> = told.map(difference).collect();
    match told.is_empty() {
        true => f64::INFINITY,
        false => median(told),
    }
}

/// The clock with even steps between pauses, or with such that change slowly, of the same ends and counts.
fn even_clock(time: &[f64]) -> Vec<f64> {
    let longest = PAUSE * usual_step(time);
    let mut even = Vec::with_capacity(time.len());
    let mut from = 0;
    for to in 1..=time.len() {
        if to == time.len() || time[to] - time[to - 1] > longest {
            even.extend(slowly(&time[from..to]));
            from = to;
        }
    }
    even
}

/// Times as averages of those about them say.
fn slowly(time: &[f64]) -> Vec<f64> {
    let last = time.len() - 1;
    let rates = |about: usize| {
        let each = (0..=last).step_by(about.max(1));
        let ends: Vec<f64> = each.map(|i| time[i]).collect();
        let steps: Vec<f64> = ends.windows(2).map(|w| w[1] - w[0]).collect();
        let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
        steps.iter().copied().fold(0.0, f64::max) / least
    };
    // Steps that scatter have one rate; those of two rates in one record do not.
    if last < 2 * ABOUT || rates(ABOUT) < 2.0 {
        let step = (time[last] - time[0]) / last.max(1) as f64;
        return (0..=last)
            .map(|i| {
                if i == last {
                    time[last]
                } else {
                    time[0] + step * i as f64
                }
            })
            .collect();
    }
    (0..=last)
        .map(|i| {
            // Ends go on as evenly as what is about the nearest sample that has as many on either side.
            let middle = i.clamp(ABOUT, last - ABOUT);
            let near = &time[middle - ABOUT..=middle + ABOUT];
            let mean = near.iter().sum::<f64>() / near.len() as f64;
            let step = (near[2 * ABOUT] - near[0]) / (2 * ABOUT) as f64;
            mean + step * (i as f64 - middle as f64)
        })
        .collect()
}

/// The sample before a time, or the last but one.
fn bracket(time: &[f64], at: f64) -> usize {
    let behind = time.partition_point(|t| *t <= at);
    behind.clamp(1, time.len() - 1) - 1
}

fn read_off(time: &[f64], channel: &[f64], at: &[f64]) -> Vec<f64> {
    let read = |at: &f64| {
        let left = bracket(time, *at);
        let within = (at - time[left]) / (time[left + 1] - time[left]);
        let chord = channel[left] + within * (channel[left + 1] - channel[left]);
        if left == 0 || left + 2 >= time.len() {
            return chord;
        }
        let t = &time[left - 1..left + 3];
        let steps = [t[1] - t[0], t[2] - t[1], t[3] - t[2]];
        let least = steps.iter().copied().fold(f64::INFINITY, f64::min);
        if steps.iter().any(|step| *step > REGULAR * least) {
            return chord;
        }
        let basis = |j: usize| {
            let others = (0..4).filter(move |m| *m != j);
            others.map(|m| (at - t[m]) / (t[j] - t[m])).product::<f64>()
        };
        (0..4).map(|j| basis(j) * channel[left - 1 + j]).sum()
    };
    at.iter().map(read).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::drawn;
    use std::f64::consts::TAU;

    /// A sine of 100 samples a cycle on a clock that is off by up to a share of its step, with a pause in it.
    fn record(share: f64, noise: f64) -> Record {
        let mut random = drawn(20_261_127);
        let time: Vec<f64> = (0..1000)
            .map(|i| {
                let pause = if i < 600 { 0.0 } else { 30.0 };
                pause + 0.01 * (f64::from(i) + 2.0 * share * (random() - 0.5))
            })
            .collect();
        let force = time.iter().map(|t| 1000.0 * (TAU * t).sin()).collect();
        let read = |t: &f64| 1e-5 * (TAU * t).sin() + noise * (random() - 0.5);
        Record {
            displacement: time.iter().map(read).collect(),
            force,
            time: Some(time),
            ..Record::default()
        }
    }

    #[test]
    fn a_record_off_its_clock_is_read_at_even_steps() {
        let uneven = record(0.2, 0.0);
        let even = evened(&uneven).expect("uneven");
        let time = even.time.as_ref().unwrap();
        assert_eq!(time.len(), uneven.len());
        let steps: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
        for (i, step) in steps.iter().enumerate() {
            match i == 599 {
                true => assert!(*step > 29.0),
                false => assert!((step - 0.01).abs() < 1e-4, "{i}: {step}"),
            }
        }
        for (t, force) in time.iter().zip(&even.force).skip(1).take(990) {
            let true_force = 1000.0 * (TAU * t).sin();
            assert!((force - true_force).abs() < 0.1, "{t}: {force}");
        }
    }

    #[test]
    fn even_records_and_those_that_only_their_stamps_call_uneven_are_left() {
        assert_eq!(evened(&record(0.0, 1e-7)), None);
        // Sampled evenly, with stamps that are off.
        let stamped = Record {
            time: record(0.2, 0.0).time,
            ..record(0.0, 1e-7)
        };
        assert_eq!(evened(&stamped), None);
        let timeless = Record {
            time: None,
            ..record(0.2, 0.0)
        };
        assert_eq!(evened(&timeless), None);
    }

    #[test]
    fn where_the_rate_changes_steps_change_slowly() {
        let mut random = drawn(7);
        let mut now = 0.0;
        let time: Vec<f64> = (0..2000)
            .map(|i| {
                now += if i < 1000 { 0.01 } else { 0.05 } * (0.8 + 0.4 * random());
                now
            })
            .collect();
        let even = even_clock(&time);
        assert!(even.windows(2).all(|w| w[1] > w[0]));
        let ratio = |w: &[f64]| (w[2] - w[1]) / (w[1] - w[0]);
        assert!(even.windows(3).all(|w| (ratio(w) - 1.0).abs() < 0.1));
        assert!((even[1999] - time[1999]).abs() < 0.05);
    }

    #[test]
    fn what_is_read_off_a_sample_that_stands_alone_stands_alone() {
        let mut uneven = record(0.2, 0.0);
        uneven.alone = vec![300];
        let even = evened(&uneven).unwrap();
        assert!((2..=5).contains(&even.alone.len()), "{:?}", even.alone);
        assert!(even.alone.iter().all(|i| i.abs_diff(300) <= 3));
    }
}
