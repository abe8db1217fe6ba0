//! `ac_coupling`: a channel forgets what stands still.

use super::{Cause, Page, Scale, chain};
use crate::joint::effect::{Effect, Place, Places, Trajectory};
use crate::joint::parameters::Parameter;

/// A first-order high-pass, `U_meas = U − l` with `l̇ = 2π f_c (U − l)`, solved exactly for a
/// displacement that goes straight from sample to sample; a second one may follow it. The load cell may have it
/// instead, `F_meas = F − l` with `f_F`.
pub struct AcCoupling;

static PARAMETERS: [Parameter; 3] = [
    Parameter {
        name: "corner_frequency",
        symbol: "f_c",
        unit: "Hz",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "frequency below which the channel loses the displacement",
    },
    Parameter {
        name: "second_stage",
        symbol: "r",
        unit: "1",
        lower: 0.0,
        upper: 100.0,
        vanishes_at: None,
        neutral: Some(0.0),
        meaning: "corner of a second stage over that of the first; 0: there is none",
    },
    Parameter {
        name: "cell_corner",
        symbol: "f_F",
        unit: "Hz",
        lower: 0.0,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "frequency below which the load cell loses the force",
    },
];

/// What a stage loses of its input, for inputs at these times.
fn lost(corner: f64, time: &[f64], input: &[f64]) -> Vec<f64> {
    chain::lagging(std::f64::consts::TAU * corner, 0.0, time, input)
}

impl Effect for AcCoupling {
    fn name(&self) -> &'static str {
        "ac_coupling"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn places(&self, values: &[f64]) -> Places {
        chain::places(values[0] != 0.0, values[2] != 0.0)
    }
    fn channel(&self, values: &[f64], place: Place, truth: &Trajectory) -> Vec<f64> {
        let corner = values[chain::first(place, 2)];
        let channel = truth.channel(place);
        let mut all = lost(corner, &truth.time, channel);
        if values[1] > 0.0 {
            let both = channel.iter().zip(&all);
            let passed: Vec<f64> = both.map(|(u, lost)| u - lost).collect();
            let further = lost(corner * values[1], &truth.time, &passed);
            all.iter_mut().zip(&further).for_each(|(a, f)| *a += f);
        }
        all.iter().map(|lost| -lost).collect()
    }
}

impl Cause for AcCoupling {
    fn page(&self) -> Page {
        Page {
            happens: "The amplifier is AC-coupled, or the sensor (piezoelectric, velocity integrated) or the load cell (piezoelectric) answers to changes only: slow parts leak away.",
            sign: "Held readings and mean values fade to zero by the exponential; slow loops are turned ahead of the force and can enclose negative area; fast ones are right.",
            mistaken_for: &[
                "creep",
                "sensor_delay",
                "displacement_drift",
                "viscous_damping",
            ],
            separated_by: "A hold under load: the reading comes back to zero here and goes on with creep; two decades of frequency: the phase lead falls with frequency while that of a delay grows; a dummy specimen.",
            formula: "U_measured = U - l, dl/dt = 2 pi f_c (U - l), and once more with r f_c; or so of the load cell, with f_F",
            source: "First-order high-pass of an AC-coupled or charge amplifier.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &AcCoupling
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let corner = 0.002 / scale.period;
        vec![vec![corner, 0.0, 0.0], vec![0.0, 0.0, corner]]
    }
    fn refined(&self, values: &[f64], _scale: &Scale) -> Vec<f64> {
        vec![values[0], 0.5, values[2]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_held_displacement_fades_by_the_exponential() {
        let time: Vec<f64> = (0..200).map(|i| 0.01 * f64::from(i)).collect();
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            displacement: vec![3.0; time.len()],
            force: vec![],
            time,
            ..Trajectory::default()
        };
        let added = AcCoupling.channel(&[0.5, 0.0, 0.0], Place::DisplacementChannel, &truth);
        for (added, t) in added.iter().zip(&truth.time) {
            let left = (-std::f64::consts::PI * t).exp();
            assert!((3.0 + added - 3.0 * left).abs() < 1e-12);
        }
    }

    #[test]
    fn two_stages_of_one_corner_overshoot_a_held_displacement() {
        let time: Vec<f64> = (0..4000).map(|i| 0.001 * f64::from(i)).collect();
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            displacement: vec![3.0; time.len()],
            force: vec![],
            time,
            ..Trajectory::default()
        };
        let added = AcCoupling.channel(&[0.5, 1.0, 0.0], Place::DisplacementChannel, &truth);
        for (added, t) in added.iter().zip(&truth.time) {
            let x = std::f64::consts::PI * t;
            // The step response of a double pole, (1 − x) exp(−x).
            assert!((3.0 + added - 3.0 * (1.0 - x) * (-x).exp()).abs() < 1e-5);
        }
    }

    #[test]
    fn a_fast_sine_keeps_its_size_and_a_slow_one_leads() {
        let time: Vec<f64> = (0..4000).map(|i| 0.005 * f64::from(i)).collect();
        let rate = std::f64::consts::TAU * 0.2; // the corner itself
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            displacement: time.iter().map(|t| (rate * t).sin()).collect(),
            force: vec![],
            time,
            ..Trajectory::default()
        };
        let added = AcCoupling.channel(&[0.2, 0.0, 0.0], Place::DisplacementChannel, &truth);
        let samples = truth.time.iter().zip(&truth.displacement).zip(&added);
        for ((time, displacement), added) in samples.skip(3000) {
            let phase = rate * time + std::f64::consts::FRAC_PI_4;
            // At the corner a high-pass leaves 1/√2 and leads by an eighth of a cycle.
            assert!((displacement + added - phase.sin() / 2.0_f64.sqrt()).abs() < 1e-5);
        }
    }
}
