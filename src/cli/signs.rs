//! Force and displacement whose signs do not belong to one joint, told before any fit.

use super::BadInput;
use crate::record::Record;
use std::path::Path;

/// Correlation of the two below which the one falls where the other rises, whatever else the joint or
/// its measuring chain does: a damper in which friction and viscosity are all has it near zero.
const OPPOSED: f64 = -0.5;
/// Share `Σ F dU` over `Σ |F dU|` below which a joint gives work.
const GIVES_WORK: f64 = -0.3;

/// Refuses records in which the displacement falls where the force rises.
///
/// # Errors
/// [`BadInput`] naming the files and the way out.
pub fn admit<'a>(
    records: impl IntoIterator<Item = (&'a Path, &'a Record)>,
) -> Result<(), BadInput> {
    let opposed = |(_, record): &(&Path, &Record)| is_opposed(&record.force, &record.displacement);
    let files = records.into_iter().filter(opposed);
    let files: Vec<String> = files.map(|(file, _)| file.display().to_string()).collect();
    if files.is_empty() {
        return Ok(());
    }
    Err(BadInput(format!(
        "{}: the displacement falls where the force rises; change the sign of one of the two columns, or \
         check which column is which",
        files.join(", ")
    )))
}

/// True where stiffness, or stiffness and loss together, have the wrong sign. In deep slip, where there
/// is hardly any stiffness, a joint whose sign is reversed gives work instead of taking it.
fn is_opposed(force: &[f64], displacement: &[f64]) -> bool {
    let (force, displacement) = (about_mean(force), about_mean(displacement));
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let sizes = sum(&force, &force) * sum(&displacement, &displacement);
    let correlation = sum(&force, &displacement) / sizes.sqrt();
    let steps = force.windows(2).zip(displacement.windows(2));
    let work = steps.map(|(f, u)| 0.5 * (f[0] + f[1]) * (u[1] - u[0]));
    let (taken, moved) = work.fold((0.0, 0.0), |(taken, moved), work: f64| {
        (taken + work, moved + work.abs())
    });
    correlation < OPPOSED || (correlation < 0.0 && taken < GIVES_WORK * moved)
}

/// A channel about its mean, over its largest value: squares of it are numbers, whatever its unit.
fn about_mean(channel: &[f64]) -> Vec<f64> {
    let largest = channel.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mean = channel.iter().map(|x| x / largest).sum::<f64>() / channel.len() as f64;
    channel.iter().map(|x| x / largest - mean).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Loops of a sine: stiffness, viscous loss over it, and what they stand about.
    fn loops(stiffness: f64, loss: f64, mean: f64) -> (Vec<f64>, Vec<f64>) {
        let phase = (0..400).map(|i| 0.05 * f64::from(i));
        phase
            .map(|p| (mean + stiffness * p.sin() + loss * p.cos(), 1e-6 * p.sin()))
            .unzip()
    }

    #[test]
    fn reversed_signs_are_told_from_loss_drift_and_holds() {
        let negative = |channel: &[f64]| channel.iter().map(|x| -x).collect::<Vec<_>>();
        for (stiffness, loss) in [(1e3, 0.0), (1e3, 300.0), (100.0, 1e3)] {
            let (force, moved) = loops(stiffness, loss, 5e3);
            assert!(!is_opposed(&force, &moved), "{stiffness} {loss}");
            assert!(is_opposed(&negative(&force), &moved), "{stiffness} {loss}");
            assert!(is_opposed(&force, &negative(&moved)), "{stiffness} {loss}");
        }
        // A damper whose gas pulls a little gives no work.
        let (force, moved) = loops(-100.0, 1e3, 0.0);
        assert!(!is_opposed(&force, &moved));
        // A drift against the load, larger than the motion.
        let (force, moved) = loops(1e3, 100.0, 0.0);
        let drifts: Vec<f64> = (0..)
            .zip(&moved)
            .map(|(i, u)| u - 1e-8 * f64::from(i))
            .collect();
        assert!(!is_opposed(&force, &drifts));
        // A pull, and rest at the peak while the force relaxes and the joint gives way.
        let rests = (0..400).map(|i| match i {
            0..20 => (f64::from(i), f64::from(i)),
            _ => (20.0 - 0.005 * f64::from(i), 20.0 + 0.001 * f64::from(i)),
        });
        let (force, moved): (Vec<f64>, Vec<f64>) = rests.unzip();
        assert!(!is_opposed(&force, &moved));
        // Nothing at all is for others to refuse.
        assert!(!is_opposed(&[0.0; 50], &[0.0; 50]));
        assert!(!is_opposed(&[], &[]));
    }
}
