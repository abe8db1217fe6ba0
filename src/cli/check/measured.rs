//! The joint's answer beside the measured one.

use super::load::Load;
use crate::joint::{Drive, Output};

/// A record's answer and the joint's, SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Measured {
    /// `displacement` or `force`.
    pub name: &'static str,
    /// `m` or `N`.
    pub unit: &'static str,
    /// Median of measured minus simulated: the sensor's zero, taken out below.
    pub offset: f64,
    /// Root mean square of what is left.
    pub rms: f64,
    /// Largest of what is left.
    pub largest: f64,
    /// Standard deviation of the measured answer.
    pub swing: f64,
    /// Work done on the joint over the record \[J\], measured and simulated.
    pub work: (f64, f64),
}

impl Measured {
    /// Of a record that holds both channels; `None` where the answer is not in it.
    pub fn of(load: &Load, drive: Drive, simulated: &[Output]) -> Option<Measured> {
        let measured = load.answer.as_deref()?;
        let (name, unit) = match drive {
            Drive::Force => ("displacement", "m"),
            Drive::Displacement => ("force", "N"),
        };
        let answer: Vec<f64> = simulated
            .iter()
            .map(|output| match drive {
                Drive::Force => output.displacement,
                Drive::Displacement => output.force,
            })
            .collect();
        let mut apart: Vec<f64> = measured.iter().zip(&answer).map(|(m, s)| m - s).collect();
        let offset = median(&apart)?;
        apart.iter_mut().for_each(|value| *value -= offset);
        let mean = measured.iter().sum::<f64>() / measured.len() as f64;
        let spread: Vec<f64> = measured.iter().map(|value| value - mean).collect();
        Some(Measured {
            name,
            unit,
            offset,
            rms: rms(&apart),
            largest: apart.iter().fold(0.0, |most, value| most.max(value.abs())),
            swing: rms(&spread),
            work: (
                work(drive, &load.input, measured),
                work(drive, &load.input, &answer),
            ),
        })
    }
}

fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}

fn rms(values: &[f64]) -> f64 {
    let sum: f64 = values.iter().map(|value| value * value).sum();
    (sum / values.len() as f64).sqrt()
}

/// ∫ F dU \[J\] by the trapezoidal rule.
fn work(drive: Drive, input: &[f64], answer: &[f64]) -> f64 {
    let (force, displacement) = match drive {
        Drive::Force => (input, answer),
        Drive::Displacement => (answer, input),
    };
    let forces = force.windows(2);
    let steps = displacement.windows(2);
    forces
        .zip(steps)
        .map(|(f, u)| (f[0] + f[1]) / 2.0 * (u[1] - u[0]))
        .sum()
}
