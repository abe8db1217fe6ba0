//! `fixture_inertia`: mass between load cell and joint.

use super::{Cause, Page, Scale};
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::parameters::Parameter;

/// The load cell reads the force that moves a mass as well, `F_meas = F + m Ü`.
pub struct FixtureInertia;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "mass",
    symbol: "m",
    unit: "kg",
    lower: 0.0,
    upper: 1e6,
    vanishes_at: Some(0.0),
    meaning: "moving mass between the load cell and the joint",
}];

/// Reach of the second difference, in radians of the motion's own frequency: its value for a sine
/// is 0.8 % low, and noise of the displacement comes in as if sampled that coarsely.
const REACH: f64 = 0.3;

/// Ü \[m/s²\] by second differences over [`REACH`]; constant within that of either end.
fn acceleration(truth: &Trajectory) -> Vec<f64> {
    let count = truth.displacement.len();
    let reach = reach(&truth.displacement).min(count.saturating_sub(1) / 2);
    if reach == 0 {
        return vec![0.0; count];
    }
    let rate = |from: usize, to: usize| {
        (truth.displacement[to] - truth.displacement[from]) / (truth.time[to] - truth.time[from])
    };
    (0..count)
        .map(|sample| {
            let middle = sample.clamp(reach, count - 1 - reach);
            let (before, after) = (middle - reach, middle + reach);
            let change = rate(middle, after) - rate(before, middle);
            2.0 * change / (truth.time[after] - truth.time[before])
        })
        .collect()
}

/// Samples of one reach: the motion's frequency is the ratio of its rate to its size.
fn reach(displacement: &[f64]) -> usize {
    let count = displacement.len().max(1) as f64;
    let mean = displacement.iter().sum::<f64>() / count;
    let size: f64 = displacement.iter().map(|u| (u - mean).powi(2)).sum();
    let moved: f64 = displacement
        .windows(2)
        .map(|two| (two[1] - two[0]).powi(2))
        .sum();
    // No motion, no acceleration, whatever the reach.
    if moved > 0.0 {
        ((REACH * (size / moved).sqrt()).round() as usize).max(1)
    } else {
        1
    }
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
    fn channel(&self, values: &[f64], truth: &Trajectory) -> Vec<f64> {
        acceleration(truth).iter().map(|a| values[0] * a).collect()
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
            displacement: time.iter().map(|t| 2e-6 * (20.0 * t).sin()).collect(),
            force: vec![0.0; time.len()],
            time,
        };
        let added = FixtureInertia.channel(&[3.0], &truth);
        for (added, u) in added.iter().zip(&truth.displacement).skip(30).take(3900) {
            // REACH²/12 = 0.75 % low; the edges of the record are left out.
            assert!((added + 3.0 * 400.0 * u).abs() < 0.01 * 3.0 * 400.0 * 2e-6);
        }
    }

    #[test]
    fn rest_and_short_records_have_none() {
        let still = |count| Trajectory {
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
