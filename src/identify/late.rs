//! A displacement that comes late, read ahead: its corners come with it.

use crate::joint::course::{Corner, Course};
use crate::joint::effect::{Acting, Place};
use crate::joint::passed::Passed;
use crate::record::cycles::turning_points;
use crate::record::peaks::{BAND, Between, Peak, is_between};

/// Time by which the displacement comes late; `None` where something else acts on it as well.
pub(super) fn lateness(effects: &[Acting]) -> Option<f64> {
    let mut late = None;
    for acting in effects {
        if acting.acts_at(Place::DisplacementChannel) {
            *late.get_or_insert(0.0) += acting.effect.lateness(&acting.values)?;
        }
    }
    late
}

/// The displacement as it was at each sample's time, and what it did between: `U(t) = U_measured(t + τ)`.
///
/// A repetition that takes off what the delay adds does not settle at a corner, whose fast parts are turned
/// by more than a sixth of their period.
pub(super) fn read_ahead(
    time: &[f64],
    (measured, between): (&[f64], &Between),
    late: f64,
) -> (Vec<f64>, Between) {
    let corners = corners(time, measured, between);
    let course = Course {
        time,
        values: measured,
        corners: &corners,
    };
    let mut passed = Passed::default();
    let ahead = time.iter().map(|t| course.at(t + late, &mut passed));
    let input: Vec<f64> = ahead.collect();
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
    for peak in between.peaks.iter().filter(smooth) {
        put(time[peak.before] - peak.ahead - late, peak.value, false);
    }
    for corner in &corners {
        put(corner.time - late, corner.value, true);
    }
    if between.straight {
        // It turned at samples, and what came late turned between them.
        for turn in turning_points(measured, BAND) {
            put(time[turn] - late, measured[turn], false);
        }
    }
    found.straight = between.straight;
    (input, found.in_order())
}

/// Corners of an input: where its kinks are, between samples or at one.
pub(super) fn corners(time: &[f64], input: &[f64], between: &Between) -> Vec<Corner> {
    let mut peaks = between.peaks.iter().peekable();
    let kinks = between.kinks.iter().filter(|&&kink| kink > 0);
    kinks
        .map(|&before| {
            while peaks.next_if(|peak| peak.before < before).is_some() {}
            let (time, value) = match peaks.peek() {
                Some(peak) if peak.before == before => (time[before] - peak.ahead, peak.value),
                _ => (time[before - 1], input[before - 1]),
            };
            Corner {
                before,
                time,
                value,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::{Form, Prepared, Problem};
    use crate::joint::effect::{Effect, Response};
    use crate::joint::parameters::Parameter;
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
            straight: false,
            drawn: false,
            noisy_drive: false,
            calmed: false,
            alone: Vec::new(),
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
                let (input, between) =
                    read_ahead(&record.time, (&record.displacement, &record.between), late);
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

    struct Late;

    impl Effect for Late {
        fn name(&self) -> &'static str {
            "late"
        }
        fn place(&self) -> Place {
            Place::DisplacementChannel
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn lateness(&self, values: &[f64]) -> Option<f64> {
            Some(values[0])
        }
    }

    struct Gap;

    impl Effect for Gap {
        fn name(&self) -> &'static str {
            "gap"
        }
        fn place(&self) -> Place {
            Place::Spring
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn spring(&self, values: &[f64], force: f64) -> Response {
            let filled = force.tanh();
            Response {
                value: values[0] * filled,
                slope: values[0] * (1.0 - filled * filled),
                damping: 0.0,
            }
        }
    }

    /// A sensor that comes late by less than a sample, and by more, shows what the joint did before: the corners of
    /// its load between samples, and the gap that it crosses within one.
    #[test]
    fn where_force_drives_the_joint_is_read_as_it_was() {
        let triangle = |t: f64| 100.0 * (4.0 * (t - 0.25 - (t - 0.25).round()).abs() - 1.0);
        let problem = |late: f64| {
            let time: Vec<f64> = (0..600).map(|i| 0.0167 * f64::from(i)).collect();
            let force: Vec<f64> = time.iter().map(|t| triangle((t - late).max(0.0))).collect();
            let record = Record {
                name: "late".to_string(),
                displacement: vec![0.0; time.len()],
                force,
                time: Some(time),
                ..Record::default()
            };
            Problem::new(Form::Play, &[record])
        };
        let acting = |effect: &'static dyn Effect, value: f64| Acting {
            effect,
            values: vec![value],
        };
        let gap = acting(&Gap, 1e-6);
        let now = problem(0.0);
        let mut coefficients = vec![0.0; now.operators.columns()];
        (coefficients[0], coefficients[5], coefficients[20]) = (1e-8, 1e-9, 1e-9);
        for late in [0.004, 0.0402] {
            let read = now.predict(&coefficients, &[gap.clone(), acting(&Late, late)]);
            let was = problem(late).predict(&coefficients, std::slice::from_ref(&gap));
            let pairs = read[0].judged.iter().zip(&was[0].judged).skip(8).take(580);
            for (i, (read, was)) in pairs.enumerate() {
                assert!((read - was).abs() < 1e-10, "{late}, {i}: {read} and {was}");
            }
        }
    }
}
