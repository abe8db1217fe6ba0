//! What the records tell of the joint's own parameters, the named causes taken out.

use super::findings::Estimate;
use super::prepare::rms;
use crate::identify::initial::initial_stiffness;
use crate::identify::{Estimated, FamilyFit, Fit, Form, Problem, family, series};
use crate::joint::{Drive, Joint, VirginCurve};
use crate::record::Record;

/// Points of the virgin curve that the family starts from.
const POINTS: usize = 60;

/// Misfit of the family over that of the joint of any density from which on the joint is none of the
/// family, and a number of the family says nothing of it.
const OTHER: f64 = 1.1;

/// Parameters of the joint with their 95 % intervals, and what is to be said of them.
///
/// The stiffness at small amplitude is the dictionary's own ([`initial_stiffness`]). Exponent, loss and
/// slip force are those of the four-parameter family, fitted to the records less what the named
/// causes do in them; where the records do not reach full slip, the largest force is a bound of
/// the slip force.
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
    let at_least = Estimate {
        name: "slip_force".to_string(),
        value: largest,
        unit: "N".to_string(),
        interval: Some((largest, f64::INFINITY)),
    };
    let Some(found) = of_family(problem.operators.form, joint, &records) else {
        estimates.push(at_least);
        return (estimates, None);
    };
    let more = found.rms / left(problem, fit);
    let said = (more > OTHER).then(|| {
        format!(
            "The four-parameter family leaves {more:.2} times the misfit of the joint of any density: exponent, loss and slip force of a power law do not describe this joint."
        )
    });
    let told = |name: &str| found.estimates.iter().find(|e| e.name == name);
    let wanted = [
        "exponent",
        "dissipation_coefficient",
        "stiffness",
        "series_stiffness",
    ];
    if said.is_none() {
        let named = wanted.iter().filter_map(|name| told(name));
        estimates.extend(named.filter(|e| e.interval.is_some()).map(estimate));
    }
    match told("slip_force") {
        Some(force) if said.is_none() && force.interval.is_some() => {
            estimates.push(estimate(force));
        }
        _ => estimates.push(at_least),
    }
    (estimates, said)
}

fn estimate(told: &Estimated) -> Estimate {
    Estimate {
        name: told.name.to_string(),
        value: told.value,
        unit: told.unit.clone(),
        interval: told.interval,
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
    let predictions = fit.predict(problem);
    let (mut square, mut count) = (0.0, 0.0);
    for (k, prediction) in predictions.iter().enumerate() {
        let (_, measured) = problem.channels(k);
        let residual: Vec<f64> = measured
            .iter()
            .zip(&prediction.judged)
            .map(|(y, p)| y - p)
            .collect();
        let n = residual.len() as f64;
        square += n * rms(&residual).powi(2);
        count += n;
    }
    (square / count).sqrt()
}

/// The family's joint of these records, from the virgin curve of the dictionary's.
fn of_family(form: Form, joint: &Joint, records: &[Record]) -> Option<FamilyFit> {
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
    family::fit_from(&records, &near.shape, drive).ok()
}
