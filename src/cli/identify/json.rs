//! The fit report as JSON, schema `iwan-identification/1`.

use super::found::Found;
use crate::identify::interval::{Boundary, Estimated};
use crate::identify::seed::Seed;
use crate::joint::Drive;
use serde_json::{Value, json};

/// The whole report.
pub fn report(found: &Found) -> String {
    let value = json!({
        "schema": "iwan-identification/1",
        "records": found
            .files
            .iter()
            .map(|(name, rows)| json!({"name": name, "rows": rows}))
            .collect::<Vec<_>>(),
        "procedure": procedure(&found.seed),
        "tables": found
            .tables
            .iter()
            .map(|(name, seed)| json!({"name": name, "procedure": procedure(seed)}))
            .collect::<Vec<_>>(),
        "fit": found.fit.as_ref().map(|fit| json!({
            "judged": match fit.drive {
                Drive::Force => "displacement",
                Drive::Displacement => "force",
            },
            "samples": fit.samples,
            "rms": fit.rms,
            "relative_rms": fit.relative_rms,
            "any_density_rms": found.any_joint_rms,
            "autoregression": fit.autoregression,
            "settled": fit.converged,
            "family": fit.joint.density.family(),
        })),
        "parameters": found.estimates().iter().map(estimated).collect::<Vec<_>>(),
        "not_identifiable": found.not_identifiable,
        "noticed": found.noticed,
        "no_joint": found.joint.as_ref().err(),
    });
    format!("{value:#}\n")
}

fn procedure(seed: &Seed) -> Value {
    json!({
        "settled_cycles": seed.points.len(),
        "levels": seed
            .levels
            .iter()
            .map(|l| json!({
                "force_amplitude": l.force_amplitude,
                "displacement_amplitude": l.displacement_amplitude,
                "dissipation": l.dissipation,
                "frequency": l.frequency,
                "cycles": l.count,
            }))
            .collect::<Vec<_>>(),
        "exponent": seed.dissipation.as_ref().map(|law| estimated(&law.exponent)),
        "dissipation_coefficient": seed.dissipation.as_ref().map(|law| estimated(&law.coefficient)),
        "single_power_law": seed.dissipation.as_ref().map(|law| law.single),
        "local_slopes": seed.dissipation.as_ref().map(|law| {
            law.local_slopes
                .iter()
                .map(|s| json!({"amplitude": s.amplitude, "slope": s.slope}))
                .collect::<Vec<_>>()
        }),
        "joint_stiffness": seed.stiffness.as_ref().map(|s| estimated(&s.series)),
        "largest_over_initial_compliance": seed.stiffness.as_ref().map(|s| s.reach),
        "residual_slip_ratio": seed.residual_slip.as_ref().map(|slip| json!({
            "value": slip.ratio, "half_width": slip.half_width, "agrees": slip.agrees,
        })),
        "closure_residual": seed.matching.as_ref().map(|m| m.closure_residual()),
    })
}

/// A number that is none becomes null: JSON has no infinity.
fn estimated(estimate: &Estimated) -> Value {
    json!({
        "name": estimate.name,
        "symbol": estimate.symbol,
        "unit": estimate.unit,
        "value": estimate.value,
        "interval": estimate.interval.map(|(lower, upper)| [lower, upper]),
        "at_boundary": estimate.at_boundary.map(|b| match b {
            Boundary::Lower => "lower",
            Boundary::Upper => "upper",
        }),
    })
}
