//! `fixture_inertia`: mass between load cell and joint.

use super::sensor_delay::Course;
use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::elementary::{sin, square};
use crate::joint::parameters::Parameter;
use crate::joint::passed::Passed;

/// The load cell reads the force that moves a mass as well, `F_meas = F + m Ü`.
pub struct FixtureInertia;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "mass",
    symbol: "m",
    unit: "kg",
    lower: 0.0,
    upper: 1e6,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "moving mass between the load cell and the joint",
}];

/// Share of the joint's own stiffness that the mass may add at any frequency. Motion beyond the
/// resonance of mass and joint is noise: were it resolved, taking `m Ü` off a measured force would
/// raise that noise each time. A joint followed by a few dozen operators moves in as many straight
/// pieces, and the bends between them are noise to a second difference, too.
const SHARE: f64 = 0.15;

/// Largest factor of a difference of the fourth order, over the square of its reach.
const GAIN: f64 = 17.0 / 3.0;

/// Ü \[m/s²\] by differences of the fourth order over a reach of `√(GAIN m/(SHARE K))`, at least a sample,
/// and over twice as much, with the loss that they have at the motion's own frequency made good.
fn acceleration(mass: f64, truth: &Trajectory) -> Vec<f64> {
    let (time, displacement) = (&truth.time, &truth.displacement);
    let count = time.len();
    let (moved, pushed) = (moves(displacement), moves(&truth.force));
    if count < 3 || moved == 0.0 {
        return vec![0.0; count];
    }
    let reach = (GAIN * mass / SHARE * (moved / pushed).sqrt()).sqrt();
    let reach = reach.min(0.125 * (time[count - 1] - time[0]));
    let half = (0.5 * reach * truth.frequency()).min(1.0);
    let kept = |half: f64| square(sin(half) / half);
    let made_good = if half > 0.0 {
        3.0 / (4.0 * kept(half) - kept(2.0 * half))
    } else {
        1.0
    };
    let course = Course::of(truth);
    let mut places = [Passed::default(); 5];
    (0..count)
        .map(|sample| {
            let (before, after) = (sample.saturating_sub(1), (sample + 1).min(count - 1));
            let reach = reach.max((time[after] - time[before]) / (after - before) as f64);
            // Constant near either end.
            let middle = time[sample]
                .max(time[0] + 2.0 * reach)
                .min(time[count - 1] - 2.0 * reach);
            let mut at =
                |shift: f64, place: usize| course.at(middle + shift * reach, &mut places[place]);
            let [earliest, earlier, now, later, latest] =
                [at(-2.0, 0), at(-1.0, 1), at(0.0, 2), at(1.0, 3), at(2.0, 4)];
            let near = (later - 2.0 * now + earlier) / square(reach);
            let far = (latest - 2.0 * now + earliest) / square(2.0 * reach);
            made_good * (4.0 * near - far) / 3.0
        })
        .collect()
}

/// Sum of squares of the moves from sample to sample.
fn moves(channel: &[f64]) -> f64 {
    channel.windows(2).map(|two| square(two[1] - two[0])).sum()
}

impl Effect for FixtureInertia {
    fn name(&self) -> &'static str {
        "fixture_inertia"
    }
    fn place(&self) -> Place {
        Place::ForceChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    /// What a mass changes of the force's peaks moves the turning points of every operator.
    fn jumps_with(&self, _parameter: usize) -> bool {
        true
    }
    fn channel(&self, values: &[f64], truth: &Trajectory) -> Vec<f64> {
        acceleration(values[0], truth)
            .iter()
            .map(|a| values[0] * a)
            .collect()
    }
}

impl Cause for FixtureInertia {
    fn page(&self) -> Page {
        Page {
            happens: "Grips, adapters or half of the specimen move between the load cell and the joint; the cell reads the force that accelerates them too.",
            sign: "Loops tilt with the square of the frequency and keep their area: less force at the turning points than at slow rates; peaks in force where the motion is jerky.",
            mistaken_for: &["sensor_delay", "quadratic_damping", "creep"],
            separated_by: "Two frequencies: stiffness falls with the square of the frequency and the area stays; a delay changes the area; an accelerometer at the grip, or a run without specimen, gives the mass itself.",
            formula: "F_measured = F + m d2U/dt2",
            source: "Newton; inertia correction of dynamic load cells, ISO 4965.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &FixtureInertia
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let acceleration = scale.velocity * scale.velocity / scale.displacement;
        vec![vec![0.002 * scale.force / acceleration]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sine_is_accelerated_by_its_frequency_squared() {
        let time: Vec<f64> = (0..4000).map(|i| 1e-3 * f64::from(i)).collect();
        let truth = Trajectory {
            begins: 0.0,
            displacement: time.iter().map(|t| 2e-6 * (20.0 * t).sin()).collect(),
            force: time.iter().map(|t| 50.0 * (20.0 * t).sin()).collect(),
            time,
        };
        // From nothing to a tenth of the force, where the reach is a radian.
        for mass in [1.0, 300.0, 6250.0] {
            let added = FixtureInertia.channel(&[mass], &truth);
            // Near either end, within twice the reach, it is held constant.
            for (added, u) in added.iter().zip(&truth.displacement).skip(200).take(3600) {
                // The record holds no whole number of cycles: its frequency is known to 0.1 %.
                assert!((added + mass * 400.0 * u).abs() < 1e-3 * mass * 400.0 * 2e-6);
            }
        }
    }

    #[test]
    fn rest_and_short_records_have_none() {
        let still = |count| Trajectory {
            begins: 0.0,
            time: (0..count).map(|i| i as f64).collect(),
            force: vec![0.0; count],
            displacement: vec![5.0; count],
        };
        for count in [0, 1, 2, 3, 50] {
            assert_eq!(
                FixtureInertia.channel(&[3.0], &still(count)),
                vec![0.0; count]
            );
        }
    }
}
