//! `fixture_inertia`: mass between load cell and joint.

use super::{Cause, Page, Scale};
use crate::joint::course::Course;
use crate::joint::effect::{Effect, Place, Trajectory};
use crate::joint::elementary::{sin, square};
use crate::joint::parameters::Parameter;
use crate::joint::passed::Passed;

/// The load cell reads the force that moves a mass as well, `F_meas = F + m Ü`.
///
/// Where force drives, mass and joint are a system that rings, and the measured force drives it. A cell or a record
/// too slow for that shows the inertia of the joint's forced motion alone: with a driven mass `F_meas = F + m_d Ü` is
/// solved for the F that the joint bore in turns. Where displacement drives, m is read from sample to sample where its rate
/// jumps, and from no sample beyond; with m_d Ü reaches over [`SLOW`] samples, across all jumps.
pub struct FixtureInertia;

static PARAMETERS: [Parameter; 2] = [
    Parameter {
        name: "mass",
        symbol: "m",
        unit: "kg",
        lower: 0.0,
        upper: 1e9,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "moving mass between the load cell and the joint",
    },
    Parameter {
        name: "driven_mass",
        symbol: "m_d",
        unit: "kg",
        lower: 0.0,
        upper: 1e9,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "such a mass, where the cell is too slow for its ringing on the joint",
    },
];

/// Inertia at the starts, as a share of the force. Where force drives, a mass too small by far rings on where the
/// right one does not, and no slope of the misfit leads from there to it.
const STARTS: [f64; 2] = [0.002, 0.05];

/// The same where nothing rings, and the slope at a small one leads on.
const DRIVEN_STARTS: [f64; 3] = [1e-4, 0.002, 0.05];

/// Noise of the acceleration over the acceleration itself, in rms, above which differences reach further.
const NOISY: f64 = 0.1;

/// Samples to either side from which on a noisy motion is read: the noise of one sample stands in the force that the joint
/// is said to bear there and, whitened, in the next one, and a mass must not make it good.
const OWN: f64 = 2.0;

/// Share of a record that a difference reaches over at most, to either side.
const REACH: f64 = 0.125;

/// Samples that a slow cell's acceleration reaches over where displacement drives: corners of the motion are blurred by
/// its amplifier.
const SLOW: f64 = 4.0;

/// Samples between two jumps of the rate from which on there is a smooth motion between them.
const SMOOTH: usize = 7;

/// Ü \[m/s²\] by differences over at least so many samples to either side, and so far that a measured displacement's noise
/// is small beside it. None reaches across jumps of the rate at or before these samples; at those it is what the samples
/// beside them say, the mean from sample to sample.
fn acceleration(truth: &Trajectory, samples: f64, kinks: &[usize]) -> Vec<f64> {
    let (time, displacement) = (&truth.time, &truth.displacement);
    let count = time.len();
    let frequency = truth.frequency();
    if count < 3 || !frequency.is_normal() {
        return vec![0.0; count];
    }
    let mean = displacement.iter().sum::<f64>() / count as f64;
    let size = displacement.iter().map(|u| square(u - mean)).sum::<f64>() / count as f64;
    let wanted = NOISY * square(frequency) * size.sqrt();
    // A second difference has six times the variance of its samples.
    let noisy = (6.0_f64.sqrt() * noise(displacement) / wanted).sqrt();
    let from_sample_to_sample = |sample: usize| {
        let i = sample.clamp(1, count - 2);
        let rate = |i: usize| (displacement[i] - displacement[i - 1]) / (time[i] - time[i - 1]);
        2.0 * (rate(i + 1) - rate(i)) / (time[i + 1] - time[i - 1])
    };
    let kinks = || {
        kinks
            .iter()
            .copied()
            .filter(|kink| (1..count).contains(kink))
    };
    let mut accelerations = Vec::with_capacity(count);
    for end in kinks().chain([count]) {
        let stretch = accelerations.len()..end;
        let motion = Course {
            time: &time[stretch.clone()],
            values: &displacement[stretch.clone()],
            corners: &[],
        };
        match stretch.len() < SMOOTH.min(count) {
            true => accelerations.extend(stretch.map(from_sample_to_sample)),
            false => accelerations.extend(smooth(motion, frequency, (samples, noisy))),
        }
    }
    for kink in kinks() {
        for sample in [kink - 1, kink] {
            accelerations[sample] = from_sample_to_sample(sample);
        }
    }
    accelerations
}

/// The same of a smooth motion, by differences over so many samples and so much time at least, with the loss that they have
/// at a frequency made good.
fn smooth(
    motion: Course<'_>,
    frequency: f64,
    (samples, noisy): (f64, f64),
) -> impl Iterator<Item = f64> {
    let (time, displacement) = (motion.time, motion.values);
    let count = time.len();
    let noisy = noisy.min(REACH * (time[count - 1] - time[0]));
    let mut places = [Passed::default(); 4];
    (0..count).map(move |sample| {
        let (before, after) = (sample.saturating_sub(1), (sample + 1).min(count - 1));
        let step = (time[after] - time[before]) / (after - before) as f64;
        let reach = noisy.max(samples * step);
        // Beyond what the noise of the sample itself, which the joint's force has too, takes part in.
        let inner = if noisy > step { OWN * step } else { 0.0 };
        let outer = (square(reach) + square(inner)).sqrt();
        // Constant near either end.
        let middle = time[sample]
            .max(time[0] + outer)
            .min(time[count - 1] - outer);
        let [earlier, early, late, later] = &mut places;
        let at = |way: f64, passed: &mut Passed| motion.at(middle + way, passed);
        let outside = at(-outer, earlier) + at(outer, later);
        let inside = match middle == time[sample] && inner == 0.0 {
            true => 2.0 * displacement[sample],
            false => at(-inner, early) + at(inner, late),
        };
        let loss = |way: f64| {
            let half = (0.5 * way * frequency).min(1.0);
            if half > 0.0 { sin(half) / half } else { 1.0 }
        };
        (outside - inside) / (square(reach) * loss(outer + inner) * loss(outer - inner))
    })
}

/// Differences that are taken of a channel to leave its noise alone.
const DIFFERENCES: usize = 6;

/// Variance of such a difference over that of a sample, the sum of the squared binomials, 12!/(6!)².
const OF_DIFFERENCE: f64 = 924.0;

/// Median of the magnitude of a normal variable over its standard deviation.
const MEDIAN: f64 = 0.6745;

/// Standard deviation of a channel's noise, from the median of its sixth differences: motion and its corners
/// take no part.
fn noise(channel: &[f64]) -> f64 {
    let mut differences = channel.to_vec();
    for _ in 0..DIFFERENCES {
        differences = differences.windows(2).map(|two| two[1] - two[0]).collect();
    }
    let mut sizes: Vec<f64> = differences.iter().map(|d| d.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    let median = sizes.get(sizes.len() / 2).copied().unwrap_or_default();
    median / (MEDIAN * OF_DIFFERENCE.sqrt())
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
    fn follows_motion(&self) -> bool {
        true
    }
    fn driven(&self, values: &[f64]) -> Option<f64> {
        Some(values[1])
    }
    fn inertia(&self, values: &[f64]) -> Option<f64> {
        (values[1] == 0.0).then_some(values[0])
    }
    /// What a mass changes of the force's peaks moves the turning points of every operator.
    fn jumps_with(&self, _parameter: usize) -> bool {
        true
    }
    fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
        inertia(
            [(values[0], 1.0, &truth.kinks), (values[1], SLOW, &[])],
            truth,
        )
    }
    fn in_turns(&self, values: &[f64], truth: &Trajectory) -> Vec<f64> {
        inertia([(values[0], 1.0, &[]), (values[1], 1.0, &[])], truth)
    }
}

/// Inertia \[N\] of masses \[kg\] whose acceleration reaches over so many samples, and not across some jumps of the rate.
fn inertia(masses: [(f64, f64, &[usize]); 2], truth: &Trajectory) -> Vec<f64> {
    let mut sum = vec![0.0; truth.time.len()];
    for (mass, samples, kinks) in masses.into_iter().filter(|(mass, ..)| *mass != 0.0) {
        let moved = acceleration(truth, samples, kinks).into_iter();
        sum.iter_mut().zip(moved).for_each(|(s, a)| *s += mass * a);
    }
    sum
}

impl Cause for FixtureInertia {
    fn page(&self) -> Page {
        Page {
            happens: "Grips, adapters or half of the specimen move between the load cell and the joint; the cell reads the force that accelerates them too.",
            sign: "Loops tilt with the square of the frequency and keep their area: less force at the turning points than at slow rates; peaks in force where the motion is jerky.",
            mistaken_for: &["sensor_delay", "quadratic_damping", "creep"],
            separated_by: "Two frequencies: stiffness falls with the square of the frequency and the area stays; a delay changes the area; an accelerometer at the grip, or a run without specimen, gives the mass itself.",
            formula: "F_measured = F + m d2U/dt2, with m_d for m where nothing rings",
            source: "Newton; inertia correction of dynamic load cells, ISO 4965.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &FixtureInertia
    }
    fn needs_time(&self) -> bool {
        true
    }
    /// A mass that rings and one that does not.
    fn otherwise(&self, values: &[f64]) -> Option<Vec<f64>> {
        let one = (values[0] == 0.0) != (values[1] == 0.0);
        one.then(|| vec![values[1], values[0]])
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let acceleration = scale.velocity * scale.velocity / scale.displacement;
        let whole = scale.force / acceleration;
        // A mass that rings on the joint does so at its own frequency.
        let rings = scale.ringing.iter().map(|w| scale.stiffness / square(*w));
        let shares = STARTS.map(|share| share * whole);
        let marched = shares.into_iter().chain(rings).map(|m| vec![m, 0.0]);
        let driven = DRIVEN_STARTS.map(|share| vec![0.0, share * whole]);
        marched.chain(driven).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of Lehmer's generator about zero, whose neighbours tell nothing of each other.
    fn numbers(mut state: u64) -> impl FnMut() -> f64 {
        move || {
            state = state * 48_271 % 2_147_483_647;
            state as f64 / 2_147_483_647.0 - 0.5
        }
    }

    #[test]
    fn a_sine_is_accelerated_by_its_frequency_squared() {
        let time: Vec<f64> = (0..4000).map(|i| 1e-3 * f64::from(i)).collect();
        let truth = Trajectory {
            displacement: time.iter().map(|t| 2e-6 * (20.0 * t).sin()).collect(),
            force: time.iter().map(|t| 50.0 * (20.0 * t).sin()).collect(),
            time,
            ..Trajectory::default()
        };
        // From nothing to a tenth of the force, where the reach is a radian.
        for mass in [1.0, 300.0, 6250.0] {
            let marched = FixtureInertia.channel(&[mass, 0.0], Place::ForceChannel, &truth);
            let driven = FixtureInertia.channel(&[0.0, mass], Place::ForceChannel, &truth);
            // Near either end, within twice the reach, it is held constant.
            let both = marched.iter().zip(&driven).zip(&truth.displacement);
            for ((marched, driven), u) in both.skip(200).take(3600) {
                // The record holds no whole number of cycles: its frequency is known to 0.1 %.
                let (right, close) = (-mass * 400.0 * u, 1e-3 * mass * 400.0 * 2e-6);
                assert!((marched - right).abs() < close && (driven - right).abs() < close);
            }
        }
    }

    /// Of clean records in slow noise one in a hundred had a mass by that.
    #[test]
    fn what_a_sample_reads_wrongly_is_not_in_its_acceleration_nor_in_the_next_one() {
        let mut random = numbers(20_261_128);
        let noise: Vec<f64> = (0..4000).map(|_| 3e-9 * random()).collect();
        let sine = |i: usize| 2e-6 * (0.02 * i as f64).sin();
        let truth = |noise: &[f64]| Trajectory {
            time: (0..4000).map(|i| 1e-3 * f64::from(i)).collect(),
            displacement: noise.iter().enumerate().map(|(i, n)| sine(i) + n).collect(),
            force: vec![0.0; 4000],
            ..Trajectory::default()
        };
        let read = acceleration(&truth(&noise), 1.0, &[]);
        // By the same differences.
        let other: Vec<f64> = noise.iter().map(|n| -n).collect();
        let wrongly = acceleration(&truth(&other), 1.0, &[]);
        let by_noise: Vec<f64> = read
            .iter()
            .zip(&wrongly)
            .map(|(a, b)| 0.5 * (a - b))
            .collect();
        let size = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
        for lag in [0, 1] {
            let both = by_noise[lag..]
                .iter()
                .zip(&noise)
                .chain(by_noise.iter().zip(&noise[lag..]));
            let shared: f64 = both.map(|(a, n)| a * n).sum();
            let correlation = 0.5 * shared / (size(&by_noise) * size(&noise));
            // Four standard deviations of 4000 samples; of the own sample −0.8.
            assert!(
                correlation.abs() < 4.0 / 4000_f64.sqrt(),
                "{lag}: {correlation}"
            );
        }
    }

    /// A sine whose size is stepped up as it passes zero, a quarter of the way from one sample to the next, in noise.
    #[test]
    fn a_jump_of_the_rate_is_in_the_samples_beside_it_alone() {
        let mut random = numbers(20_261_129);
        let (rate, step, tip) = (20.0, 1e-3, 2000.25);
        let size = |i: f64| if i < tip { 2e-6 } else { 3e-6 };
        let sine = |i: f64| size(i) * (rate * step * (i - tip)).sin();
        let truth = Trajectory {
            time: (0..4000).map(|i| step * f64::from(i)).collect(),
            displacement: (0..4000)
                .map(|i| sine(f64::from(i)) + 6e-9 * random())
                .collect(),
            force: vec![0.0; 4000],
            kinks: vec![2001],
            ..Trajectory::default()
        };
        // Of inertia as large as the noise leaves it.
        let off = |kinks: &[usize]| {
            let read = acceleration(&truth, 1.0, kinks);
            let off =
                |i: usize| (read[i] + rate * rate * sine(i as f64)).abs() / (rate * rate * 3e-6);
            let near = (1950..2050).filter(|i| ![2000, 2001].contains(i));
            let jumped = (read[2000] + read[2001]) * step / (rate * 1e-6);
            (near.map(off).fold(0.0, f64::max), jumped)
        };
        let (smooth, jumped) = off(&truth.kinks);
        assert!(smooth < 0.4, "{smooth}");
        // Three standard deviations of the noise in four samples, 2 · 6e-9/√12 over the step, and its share of the jump.
        assert!((jumped - 1.0).abs() < 0.52, "{jumped}");
        // Differences that reach over eight samples spread the jump over all of them.
        let (across, _) = off(&[]);
        assert!(across > 1.0, "{across}");
    }

    #[test]
    fn rest_and_short_records_have_none() {
        let still = |count| Trajectory {
            time: (0..count).map(|i| i as f64).collect(),
            force: vec![0.0; count],
            displacement: vec![5.0; count],
            ..Trajectory::default()
        };
        for count in [0, 1, 2, 3, 50] {
            assert_eq!(
                FixtureInertia.channel(&[3.0, 4.0], Place::ForceChannel, &still(count)),
                vec![0.0; count]
            );
        }
    }
}
