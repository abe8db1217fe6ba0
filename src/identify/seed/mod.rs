//! The report's own procedure ("Selecting Parameters"): χ and ϑ from the growth of the cyclic loss,
//! the series stiffness from small loads, ρ from the curvature of a monotonic pull, both joined at
//! φ̄, and K_T with its closure residual.

mod cycle_point;
mod dissipation;
mod findings;
mod level;
mod limits;
mod line;
mod monotonic;
mod residual_slip;
mod stiffness;

pub use cycle_point::{CyclePoint, cycle_points};
pub use dissipation::{DissipationLaw, LocalSlope, Over, dissipation_law};
pub use findings::frequency_finding;
pub use level::{APART, Level, levels, table_levels};
pub use monotonic::{Matching, Monotonic, Source, monotonic};
pub use residual_slip::{ResidualSlip, residual_slip};
pub use stiffness::{Stiffness, series_stiffness};

use crate::identify::table::at_resonance;
use crate::record::cycles::turning_points;
use crate::record::{AmplitudeTable, Record};

/// Why no seed could be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SeedError {
    /// Nothing given.
    #[error("no record given")]
    NoRecord,
    /// Channels of different length.
    #[error("record `{name}` has {force} force and {displacement} displacement samples")]
    UnequalChannels {
        /// The record.
        name: String,
        /// Count of force samples.
        force: usize,
        /// Count of displacement samples.
        displacement: usize,
    },
    /// A channel that never moves.
    #[error("record `{name}`: the {channel} never changes, nothing can be identified from it")]
    Still {
        /// The record.
        name: String,
        /// `force` or `displacement`.
        channel: &'static str,
    },
    /// A number that is none.
    #[error("record `{name}`, sample {sample}: {channel} is {value}, not a finite number")]
    NotFinite {
        /// The record.
        name: String,
        /// Which sample.
        sample: usize,
        /// `force` or `displacement`.
        channel: &'static str,
        /// The value.
        value: f64,
    },
}

/// What the procedure found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Seed {
    /// Settled cycles of all records.
    pub points: Vec<CyclePoint>,
    /// Load levels, of rising force amplitude.
    pub levels: Vec<Level>,
    /// χ and ϑ; `None` below two levels.
    pub dissipation: Option<DissipationLaw>,
    /// Series stiffness and reach; `None` without displacements of the joint itself.
    pub stiffness: Option<Stiffness>,
    /// Measured against predicted residual slip; `None` without loops.
    pub residual_slip: Option<ResidualSlip>,
    /// The deepest virgin curve.
    pub monotonic: Option<Monotonic>,
    /// ρ above φ̄ joined to the power law, and K_T twice.
    pub matching: Option<Matching>,
    /// Largest |F| \[N\].
    pub largest_force: f64,
    /// How full the loops are: ∫F dU over (force amplitude × path of U), the largest of the
    /// records; 0 elastic, 1 rigid-plastic, small in micro-slip.
    pub fullness: f64,
    /// What a power-law joint would not do, in sentences.
    pub findings: Vec<String>,
    /// What the data do not reach, in sentences.
    pub not_identifiable: Vec<String>,
}

/// The seed of time histories: several records are several tests of one joint.
///
/// # Errors
/// [`SeedError`] for records that hold nothing to identify. Checked in tests/identification.rs on
/// records of an independent generator.
pub fn of_records(records: &[&Record]) -> Result<Seed, SeedError> {
    if records.is_empty() {
        return Err(SeedError::NoRecord);
    }
    records.iter().try_for_each(|record| sound(record))?;
    let points: Vec<CyclePoint> = records
        .iter()
        .enumerate()
        .flat_map(|(i, record)| cycle_points(i, record))
        .collect();
    let largest_force = records
        .iter()
        .flat_map(|r| &r.force)
        .fold(0.0, |largest: f64, f| largest.max(f.abs()));
    let mut seed = Seed {
        levels: levels(&points),
        largest_force,
        fullness: records.iter().map(|r| fullness(r)).fold(0.0, f64::max),
        ..Seed::default()
    };
    seed.dissipation = dissipation_law(&seed.levels, Over::Force);
    seed.stiffness = stiffness_of(&seed);
    let law = seed.dissipation.clone().filter(|law| law.constant);
    if let Some(law) = &law {
        seed.residual_slip = residual_slip(&seed.levels, law);
    }
    seed.monotonic = monotonic(records, &points);
    if law.is_none()
        && let Some(curve) = &seed.monotonic
    {
        seed.stiffness = Some(stiffness::of_curve(curve));
    }
    if let (Some(curve), Some(law), Some(stiffness)) = (&seed.monotonic, &law, &seed.stiffness) {
        let join = law.range.1.min(0.5 * curve.force[curve.force.len() - 1]);
        seed.matching = curve.matching(
            law.coefficient.value,
            law.exponent.value,
            stiffness.series.value,
            join,
        );
    }
    seed.points = points;
    Ok(concluded(seed))
}

/// The seed of an amplitude table: no loops, so neither residual slip nor ρ above φ̄.
///
/// # Errors
/// [`SeedError::NoRecord`] for a table without rows.
pub fn of_table(table: &AmplitudeTable) -> Result<Seed, SeedError> {
    let levels = table_levels(table);
    let largest_force = levels.last().ok_or(SeedError::NoRecord)?.force_amplitude;
    let over = if at_resonance(table) {
        Over::Displacement
    } else {
        Over::Force
    };
    let mut seed = Seed {
        dissipation: dissipation_law(&levels, over),
        levels,
        largest_force,
        ..Seed::default()
    };
    if over == Over::Force {
        seed.stiffness = stiffness_of(&seed);
    }
    Ok(concluded(seed))
}

fn concluded(mut seed: Seed) -> Seed {
    seed.findings = findings::findings(&seed);
    seed.not_identifiable = limits::not_identifiable(&seed);
    seed
}

fn stiffness_of(seed: &Seed) -> Option<Stiffness> {
    let (exponent, used) = match &seed.dissipation {
        Some(law) if law.constant => (law.exponent.value, law.used.1),
        _ => (0.0, 1),
    };
    series_stiffness(&seed.levels, exponent, used)
}

/// ∫F dU over the path of U times the force amplitude; for a settled loop `D/(4 F_0 U_0)`.
fn fullness(record: &Record) -> f64 {
    let (force, displacement) = (&record.force, &record.displacement);
    let high = force.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = force.iter().copied().fold(f64::INFINITY, f64::min);
    let mid = 0.5 * (high + low);
    let work: f64 = (1..force.len())
        .map(|i| (0.5 * (force[i] + force[i - 1]) - mid) * (displacement[i] - displacement[i - 1]))
        .sum();
    let path: f64 = turning_points(displacement, 0.02)
        .windows(2)
        .map(|pair| (displacement[pair[1]] - displacement[pair[0]]).abs())
        .sum();
    let whole = 0.5 * (high - low) * path;
    if whole > 0.0 { work / whole } else { 0.0 }
}

fn sound(record: &Record) -> Result<(), SeedError> {
    let name = || record.name.clone();
    if record.force.len() != record.displacement.len() {
        return Err(SeedError::UnequalChannels {
            name: name(),
            force: record.force.len(),
            displacement: record.displacement.len(),
        });
    }
    let channels = [
        ("force", &record.force),
        ("displacement", &record.displacement),
    ];
    for (channel, values) in channels {
        if let Some(sample) = values.iter().position(|v| !v.is_finite()) {
            let value = values[sample];
            return Err(SeedError::NotFinite {
                name: name(),
                sample,
                channel,
                value,
            });
        }
        if values.windows(2).all(|w| w[0] == w[1]) {
            return Err(SeedError::Still {
                name: name(),
                channel,
            });
        }
    }
    Ok(())
}
