//! A displacement that comes late, read ahead: its corners come with it.

use super::problem::Prepared;
use crate::joint::effect::{Acting, Place};
use crate::joint::passed::Passed;
use crate::record::peaks::{Between, Peak, is_between};

/// Time by which the displacement comes late; `None` where something else acts on it as well.
pub(super) fn lateness(effects: &[Acting]) -> Option<f64> {
    let mut late = None;
    for acting in effects {
        if acting.effect.place() == Place::DisplacementChannel {
            *late.get_or_insert(0.0) += acting.effect.lateness(&acting.values)?;
        }
    }
    late
}

/// The displacement as it was at each sample's time, and what it did between: `U(t) = U_measured(t + τ)`.
///
/// A repetition that takes off what the delay adds does not settle at a corner, whose fast parts are turned
/// by more than a sixth of their period.
pub(super) fn read_ahead(record: &Prepared, measured: &[f64], late: f64) -> (Vec<f64>, Between) {
    let time = &record.time;
    let corners = corners(record, measured);
    let mut course = Course {
        time,
        measured,
        corners: &corners,
        passed: Passed::default(),
    };
    let input: Vec<f64> = time.iter().map(|t| course.at(t + late)).collect();
    let mut found = Between::default();
    let mut put = |peak: f64, value: f64, corner: bool| {
        let before = time.partition_point(|&t| t <= peak);
        if before == 0 || before >= time.len() {
            return;
        }
        let step = time[before] - time[before - 1];
        let within = (peak - time[before - 1]) / step;
        if is_between(within) {
            found.peaks.push(Peak {
                before,
                ahead: time[before] - peak,
                value,
            });
        }
        if corner {
            found.kinks.push(before);
        }
    };
    let smooth = |peak: &&Peak| corners.iter().all(|c| c.before != peak.before);
    for peak in record.between.peaks.iter().filter(smooth) {
        put(time[peak.before] - peak.ahead - late, peak.value, false);
    }
    for corner in &corners {
        put(corner.time - late, corner.value, true);
    }
    (input, found.in_order())
}

/// A point at which the rate jumps.
struct Corner {
    /// The first sample behind it.
    before: usize,
    time: f64,
    value: f64,
}

fn corners(record: &Prepared, measured: &[f64]) -> Vec<Corner> {
    let mut peaks = record.between.peaks.iter().peekable();
    let kinks = record.between.kinks.iter().filter(|&&kink| kink > 0);
    kinks
        .map(|&before| {
            while peaks.next_if(|peak| peak.before < before).is_some() {}
            let (time, value) = match peaks.peek() {
                Some(peak) if peak.before == before => {
                    (record.time[before] - peak.ahead, peak.value)
                }
                _ => (record.time[before - 1], measured[before - 1]),
            };
            Corner {
                before,
                time,
                value,
            }
        })
        .collect()
}

/// The measured displacement between its samples, by pieces that do not reach across corners.
struct Course<'a> {
    time: &'a [f64],
    measured: &'a [f64],
    corners: &'a [Corner],
    passed: Passed,
}

impl Course<'_> {
    fn at(&mut self, time: f64) -> f64 {
        let (t, u) = (self.time, self.measured);
        let after = self.passed.at(t, time);
        if after == 0 || t.len() < 4 {
            return u[after.saturating_sub(1)];
        }
        // Behind the end the last piece goes on.
        let after = after.min(t.len() - 1);
        if let Some(corner) = self.corner(after)
            && corner.time > t[after - 1]
        {
            let line =
                |a: (f64, f64), b: (f64, f64)| a.1 + (b.1 - a.1) * (time - a.0) / (b.0 - a.0);
            let tip = (corner.time, corner.value);
            return match time < corner.time {
                true => line((t[after - 1], u[after - 1]), tip),
                false => line(tip, (t[after], u[after])),
            };
        }
        let low =
            match after < 2 || self.corner(after - 1).is_some() || self.corner(after).is_some() {
                true => after - 1,
                false => after - 2,
            };
        let high = match after + 1 >= t.len() || self.corner(after + 1).is_some() {
            true => after,
            false => after + 1,
        };
        through(&t[low..=high], &u[low..=high], time)
    }

    fn corner(&self, before: usize) -> Option<&Corner> {
        let found = self.corners.binary_search_by_key(&before, |c| c.before);
        found.ok().map(|i| &self.corners[i])
    }
}

/// The polynomial through two to four points (Lagrange).
fn through(times: &[f64], values: &[f64], time: f64) -> f64 {
    let weight = |i: usize| {
        let others = (0..times.len()).filter(|&j| j != i);
        others
            .map(|j| (time - times[j]) / (times[i] - times[j]))
            .product::<f64>()
    };
    let points = values.iter().enumerate();
    points.map(|(i, value)| weight(i) * value).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::Form;
    use crate::record::Record;

    fn prepared(wave: impl Fn(f64) -> f64) -> Prepared {
        let time: Vec<f64> = (0..600).map(|i| 0.0167 * f64::from(i)).collect();
        let displacement: Vec<f64> = time.iter().map(|t| wave(*t)).collect();
        let record = Record {
            name: "late".to_string(),
            force: displacement.clone(),
            displacement,
            time: Some(time),
            preload: None,
            temperature: None,
            acceleration: None,
        };
        Prepared::new(&record, Form::Stop)
    }

    #[test]
    fn what_came_late_is_what_it_was_with_its_corners() {
        let sine = |t: f64| (std::f64::consts::TAU * t).sin();
        let triangle = |t: f64| 4.0 * (t - 0.25 - (t - 0.25).round()).abs() - 1.0;
        for (wave, off) in [(&sine as &dyn Fn(f64) -> f64, 1e-5), (&triangle, 1e-9)] {
            // Less than a sample, and several.
            for late in [0.004, 0.0402] {
                let record = prepared(|t| wave(t - late));
                let (input, between) = read_ahead(&record, &record.displacement, late);
                for (t, u) in record.time.iter().zip(&input).take(590).skip(5) {
                    assert!((u - wave(*t)).abs() < off, "{late}: {u} at {t}");
                }
                // Straight lines of rounded numbers have corners of their own.
                let inside = between
                    .peaks
                    .iter()
                    .filter(|p| (6..590).contains(&p.before));
                let inside = inside.filter(|p| p.value.abs() > 0.5);
                let mut count = 0;
                for peak in inside {
                    let time = record.time[peak.before] - peak.ahead;
                    assert!((wave(time).abs() - 1.0).abs() < 2e-5, "{peak:?}");
                    count += 1;
                }
                assert!(count >= 16, "{count}");
            }
        }
    }
}
