//! Noise of a drive that is smooth throughout: it need not be loud to be in the way of what is read off the drive's rate.

use crate::identify::Form;
use crate::record::Record;
use crate::record::calm::{fastest_part, smoothed};

/// Those of the records with noise in the drive of which that is smooth throughout, smoothed.
///
/// A dashpot of the coefficient c answers noise e in every sample of the displacement with `c (eᵢ − eᵢ₋₁)/Δt`: of 450
/// samples a cycle that is seventy times its share of the displacement. What is beside it in the records is then
/// fitted with less of it than is at work, and a delay does better.
pub(super) fn smooth(form: Form, records: &[Record], noise: &[Option<f64>]) -> Vec<Option<Record>> {
    let smooth = |(record, noise): (&Record, &Option<f64>)| {
        let calm = smoothed(form.channels(record).0, (*noise)?)?;
        let mut record = record.clone();
        *form.channels_mut(&mut record).0 = calm;
        Some(record)
    };
    records.iter().zip(noise).map(smooth).collect()
}

/// Those of which the joint did not feel the noise, by what the baseline leaves of the records as they were.
pub(super) fn unfelt(
    form: Form,
    records: &[Record],
    smooth: Vec<Option<Record>>,
    residuals: &[Vec<f64>],
) -> Vec<Option<Record>> {
    let both = records.iter().zip(residuals).zip(smooth);
    both.map(|((record, residual), smooth)| {
        let (drive, judged) = form.channels(record);
        smooth.filter(|_| !felt(drive, judged, residual))
    })
    .collect()
}

/// True where the judged channel followed the fastest part of a drive: by more than half of what a model makes of that,
/// of which `residual` is left.
pub(super) fn felt(drive: &[f64], judged: &[f64], residual: &[f64]) -> bool {
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let of_drive = fastest_part(drive);
    let followed = product(&fastest_part(judged), &of_drive);
    let left = product(&fastest_part(residual), &of_drive);
    // What the model makes of it is what is followed without what is left.
    followed > 0.5 * (followed - left)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::diagnose;
    use crate::diagnose::gridded::tests::slid;
    use crate::record::noise::tests::drawn;

    /// Tests at so many cycles a second, of amplitudes that grow and of 300 samples a cycle: forces of sliders, and of a
    /// dashpot, at a displacement that is read with noise which the joint felt or not; noise in the force as well.
    fn swung(rate: f64, felt: bool, coefficient: f64) -> Record {
        let mut random = drawn(20_261_128 + rate as u64);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let step = 1.0 / (300.0 * rate);
        let limits: Vec<f64> = (1..=30).map(|j| 0.04 * f64::from(j)).collect();
        let swings = |i: usize| {
            let cycle = i as f64 / 300.0;
            (0.2 + 0.1 * cycle) * (std::f64::consts::TAU * cycle).sin()
        };
        let bare: Vec<f64> = (0..2400).map(swings).collect();
        let read: Vec<f64> = bare.iter().map(|u| u + 1.5e-3 * white()).collect();
        let moved = if felt { &read } else { &bare };
        let largest = 20.0;
        let rates = bare.windows(3).map(|w| (w[2] - w[0]) / (2.0 * step));
        let mut rates: Vec<f64> = rates.collect();
        rates.insert(0, rates[0]);
        rates.push(rates[rates.len() - 1]);
        let force = slid(&limits, moved).into_iter().zip(rates);
        Record {
            name: format!("at {rate}"),
            force: force
                .map(|(f, rate)| f + coefficient * rate + 2.5e-3 * largest * white())
                .collect(),
            displacement: read,
            time: Some((0..2400).map(|i| step * i as f64).collect()),
            ..Record::default()
        }
    }

    #[test]
    fn noise_that_the_joint_felt_stays() {
        for is_felt in [true, false] {
            let record = swung(2.0, is_felt, 0.0);
            let model: Vec<f64> = record.displacement.iter().map(|u| 30.0 * u).collect();
            let left = record.force.iter().zip(model).map(|(f, m)| f - m);
            let left = vec![left.collect()];
            let records = [record];
            let smooth = smooth(Form::Stop, &records, &[Some(1.5e-3)]);
            assert!(smooth[0].is_some());
            let found = unfelt(Form::Stop, &records, smooth, &left);
            assert_eq!(found[0].is_none(), is_felt);
        }
    }

    #[test]
    fn a_dashpot_is_told_beneath_the_noise_of_its_rate() {
        let records = [swung(2.0, false, 4e-3), swung(20.0, false, 4e-3)];
        let found = diagnose(&records, |_| {}).unwrap();
        let names: Vec<&str> = found.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["viscous_damping"]);
        let coefficient = found.causes[0].parameters[0].value;
        assert!((coefficient / 4e-3 - 1.0).abs() < 0.02, "{coefficient}");
    }
}
