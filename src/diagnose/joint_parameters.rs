//! What the records tell of the joint's own parameters, the named causes taken out.

use super::findings::Estimate;
use super::full_slip::full_slip;
use crate::identify::initial::initial_stiffness;
use crate::identify::linearised::{RIGHT_TO, lasting};
use crate::identify::{Estimated, FamilyFit, Fit, Form, Problem, family, series};
use crate::joint::{Drive, FourParameter, Joint, VirginCurve};
use crate::record::Record;
use crate::record::cycles::rms;

/// Points of the virgin curve that the family starts from.
const POINTS: usize = 60;

/// Misfit of the family over that of the joint of any density from which on the joint is none of the
/// family, and a number of the family says nothing of it.
const OTHER: f64 = 1.1;

/// The same before the family is fitted to the records, by the virgin curve alone.
const FAR: f64 = 1.5;

/// Parameters of the joint with their 95 % intervals, and what is to be said of them.
///
/// The stiffness at small amplitude is the dictionary's own ([`initial_stiffness`]). Exponent and loss
/// are those of the four-parameter family, fitted to the records less what the named causes do in
/// them. Its slip force, K_T and K_1 follow from the form of its density more than from the
/// records (intervals made of them held the truth in under half of drawn cases): the slip force is that at which the joint
/// went on by itself ([`full_slip`]), else the largest force is given as its bound, and nothing of the other two.
pub fn joint_parameters(
    problem: &Problem,
    fit: &Fit,
    joint: &Joint,
) -> (Vec<Estimate>, Option<String>) {
    let (stiffness, bounds) = initial_stiffness(problem, fit);
    let mut estimates = vec![Estimate {
        name: "initial_stiffness".to_string(),
        value: stiffness,
        unit: "N/m".to_string(),
        interval: Some(bounds),
    }];
    let records = without_effects(problem, fit);
    let largest = records
        .iter()
        .flat_map(|r| &r.force)
        .fold(0.0_f64, |most, f| most.max(f.abs()));
    let (value, interval) = full_slip(&records).unwrap_or((largest, (largest, f64::INFINITY)));
    let slip_force = Estimate {
        name: "slip_force".to_string(),
        value,
        unit: "N".to_string(),
        interval: Some(interval),
    };
    let least = left(problem, fit);
    let found = of_family(problem.operators.form, joint, &records, FAR * least);
    let Some(found) = found.filter(|f| f.rms <= OTHER * least) else {
        estimates.push(slip_force);
        return (
            estimates,
            Some("No joint of the four-parameter family comes near the joint of any density that these records identify: the exponent of a power law does not describe it.".to_string()),
        );
    };
    let more = found.rms / least;
    // What the family leaves more than any density does is no noise, and lasts.
    let wider = (1.0 + lasting(problem, more.powi(2).max(1.0) - 1.0 + RIGHT_TO)).sqrt();
    for told in &found.estimates {
        if let ("exponent" | "dissipation_coefficient", Some(interval)) = (told.name, told.interval)
        {
            let widened = Estimated {
                interval: Some(widened(told, interval, wider)),
                ..told.clone()
            };
            estimates.push(Estimate {
                name: told.name.to_string(),
                value: told.value,
                unit: unit(told, &found),
                interval: widened.within(FourParameter::PARAMETERS).interval,
            });
        }
    }
    estimates.push(slip_force);
    (estimates, None)
}

/// True where the slip force has an upper bound: full slip was reached.
pub fn bounds_slip_force(estimates: &[Estimate]) -> bool {
    let mut slip_forces = estimates.iter().filter(|e| e.name == "slip_force");
    slip_forces.any(|e| e.interval.is_some_and(|(_, upper)| upper.is_finite()))
}

/// The unit as it is shown; that of ϑ depends on χ.
fn unit(told: &Estimated, found: &FamilyFit) -> String {
    match told.name {
        "dissipation_coefficient" => format!("J/N^({:.3})", 3.0 + found.shape.exponent),
        _ => told.unit.clone(),
    }
}

/// An interval `factor` times as wide, in the logarithm where the number is a coefficient.
fn widened(told: &Estimated, (lower, upper): (f64, f64), factor: f64) -> (f64, f64) {
    let value = told.value;
    if told.name == "exponent" {
        (
            value - factor * (value - lower),
            value + factor * (upper - value),
        )
    } else {
        (
            value * (lower / value).powf(factor),
            value * (upper / value).powf(factor),
        )
    }
}

/// The records as they would be without the effects: the input corrected, the judged channel less
/// what the effects do in it.
fn without_effects(problem: &Problem, fit: &Fit) -> Vec<Record> {
    let with = fit.predict(problem);
    let mut corrected = problem.clone();
    for (record, prediction) in corrected.records.iter_mut().zip(&with) {
        match problem.operators.form {
            Form::Play => record.force.clone_from(&prediction.truth.force),
            Form::Stop => record
                .displacement
                .clone_from(&prediction.truth.displacement),
        }
    }
    let spring: Vec<_> = fit.series.map(series::acting).into_iter().collect();
    let alone = corrected.predict(&fit.coefficients, &spring);
    (0..problem.records.len())
        .map(|k| {
            let (input, _) = corrected.channels(k);
            let (_, measured) = problem.channels(k);
            let kept: Vec<f64> = measured
                .iter()
                .zip(&with[k].judged)
                .zip(&alone[k].judged)
                .map(|((y, with), alone)| y - with + alone)
                .collect();
            let (force, displacement) = match problem.operators.form {
                Form::Play => (input.to_vec(), kept),
                Form::Stop => (kept, input.to_vec()),
            };
            Record {
                name: problem.records[k].name.clone(),
                force,
                displacement,
                ..Record::default()
            }
        })
        .collect()
}

/// rms of what the joint of any density leaves.
fn left(problem: &Problem, fit: &Fit) -> f64 {
    let (mut square, mut count) = (0.0, 0.0);
    for residual in fit.residuals(problem) {
        let n = residual.len() as f64;
        square += n * rms(&residual).powi(2);
        count += n;
    }
    (square / count).sqrt()
}

/// The family's joint of these records, from the virgin curve of the dictionary's.
fn of_family(form: Form, joint: &Joint, records: &[Record], most: f64) -> Option<FamilyFit> {
    let drive = match form {
        Form::Play => Drive::Force,
        Form::Stop => Drive::Displacement,
    };
    let reach = |channel: &dyn Fn(&Record) -> Vec<f64>| {
        let all = records.iter().flat_map(channel);
        all.fold(0.0_f64, |most, x| most.max(x.abs()))
    };
    let slip = match form {
        Form::Play => joint
            .density
            .displacement(0.999 * reach(&|r: &Record| r.force.clone())),
        Form::Stop => reach(&|r: &Record| r.displacement.clone()),
    };
    let (mut displacement, mut force) = (Vec::new(), Vec::new());
    for j in 1..=POINTS {
        let u = slip * (j as f64 / POINTS as f64).powi(2);
        let f = joint.density.force(u);
        force.push(f);
        displacement.push(u + f / joint.series_stiffness);
    }
    let near = family::fit_curve(&displacement, &force, drive).ok()?;
    let records: Vec<&Record> = records.iter().collect();
    family::fit_from(&records, &near.shape, drive, most).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::identify::{baseline, exported};
    use crate::joint::effect::Acting;

    /// Whose limits differ by the direction, so that some of its stiffness lies beyond the range of the displacement: the
    /// force without the cause is that of the whole joint.
    #[test]
    fn a_joint_driven_by_displacement_is_no_softer_without_its_cause() {
        let displacement: Vec<f64> = (0..400).map(|i| (0.1 * f64::from(i)).sin()).collect();
        let force = displacement.clone();
        let mut problem = Problem::new(
            Form::Stop,
            &[Record {
                force,
                displacement,
                ..Record::default()
            }],
        );
        let cells = problem.operators.edges.len();
        let mut coefficients = vec![0.0; problem.operators.columns()];
        (
            coefficients[0],
            coefficients[cells / 2],
            coefficients[1 + cells],
        ) = (1.0, 1.0, 3.0);
        let uneven = Acting {
            effect: find("asymmetric_friction").unwrap().effect(),
            values: vec![0.1],
        };
        let effects = vec![uneven];
        let judged = problem.predict(&coefficients, &effects).remove(0).judged;
        let largest = judged.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        problem.records[0].force = judged;
        let fit = Fit {
            coefficients,
            effects,
            ..baseline(&problem)
        };
        let joint = exported::joint(&problem.operators, &fit).unwrap();
        let (estimates, _) = joint_parameters(&problem, &fit, &joint);
        let bound = estimates.iter().find(|e| e.name == "slip_force").unwrap();
        // Limits are a tenth larger one way: of the one cell that slips alone, that is less than a hundredth of the force.
        assert!(
            (bound.value / largest - 1.0).abs() < 0.01,
            "{bound:?}, {largest}"
        );
    }
}
