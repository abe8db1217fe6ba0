//! The parametric families: Segalman's four parameters and the small-force power law, fitted to the
//! records themselves with the exact response.

mod branches;
mod descent;
mod estimates;
mod levenberg;
mod shape;
mod start;
mod target;
mod told;
mod uncertainty;

pub use branches::Branches;
pub use levenberg::{Free, Minimum, minimise};
pub use shape::{Shape, Size};
pub use target::driven;

use super::interval::Estimated;
use super::seed::{Over, Seed};
use crate::joint::{Density, Drive, Joint, JointError, PowerLaw};
use crate::record::Record;
use descent::Best;
use estimates::Known;
use target::Target;
use told::Told;
use uncertainty::Uncertainty;

/// Why no family could be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum FamilyError {
    /// Too little to fit.
    #[error("{samples} samples are too few to fit a joint: at least {least} are needed")]
    TooShort {
        /// Count given.
        samples: usize,
        /// Count needed.
        least: usize,
    },
    /// No joint of the family comes near.
    #[error(
        "no joint with positive stiffness and slip follows these records: check the sign and the order of the force and displacement columns"
    )]
    NoJoint,
    /// Levels that do not hold what a joint needs.
    #[error("no joint follows from these levels alone: {missing}")]
    NotMeasured {
        /// What is missing, and what would give it.
        missing: &'static str,
    },
    /// The best joint leaves the glossary.
    #[error("the best fit is no joint: {0}")]
    OutOfGlossary(#[from] JointError),
}

/// A fitted joint.
#[derive(Debug, Clone, PartialEq)]
pub struct FamilyFit {
    /// Prescribed channel; the other is judged.
    pub drive: Drive,
    /// The family's coordinates at the best fit.
    pub shape: Shape,
    /// The joint: `four_parameter` where full slip is told, `power_law` where it is not.
    pub joint: Joint,
    /// Numbers with 95 % intervals; `None` as interval where the data do not tell.
    pub estimates: Vec<Estimated>,
    /// rms of measured less fitted in the judged channel \[m or N\].
    pub rms: f64,
    /// That over the rms of the judged channel.
    pub relative_rms: f64,
    /// Correlation of neighbouring residuals.
    pub autoregression: f64,
    /// Count of samples judged.
    pub samples: usize,
    /// Iterations of the best descent.
    pub iterations: usize,
    /// False where the iterations ran out.
    pub converged: bool,
    /// What these records do not tell, in sentences.
    pub not_identifiable: Vec<String>,
}

/// Tangent over initial stiffness below which force-driven response is ill-conditioned and the
/// joint is fitted under displacement.
const DEEP: f64 = 0.3;
/// Fullness of the loops from which on the same holds: an elastoplastic joint has it at 1.2 times
/// its yield displacement.
const FULL: f64 = 0.17;
/// Samples of all records together below which nothing is fitted.
pub const LEAST_SAMPLES: usize = 20;
/// Samples judged where a fit is one of many numbers of a diagnosis.
const FEW_SAMPLES: usize = 3000;

/// Which channel to prescribe: force, unless the deepest curve goes near full slip.
pub fn drive_for(seed: &Seed) -> Drive {
    match &seed.monotonic {
        _ if seed.fullness > FULL => Drive::Displacement,
        Some(curve) if curve.softening() < DEEP => Drive::Displacement,
        _ => Drive::Force,
    }
}

/// Fits the family to all records at once, one offset per record, with the exact response.
///
/// The four parameters and K_1 are fitted by bounded Levenberg–Marquardt from several starts. What
/// the data leave open (the split of the compliance below macro-slip, F_S and β below full slip) is
/// set to the middle of its range or to zero, counted in the intervals of the others, and said.
///
/// # Errors
/// [`FamilyError`]. Checked in tests/identification.rs on noise-free records of an independent
/// generator: ϑ to 0.5 %, χ to 0.01, joint stiffness to 0.1 %.
pub fn fit(records: &[&Record], seed: &Seed, drive: Drive) -> Result<FamilyFit, FamilyError> {
    let initial = seed.stiffness.as_ref().map(|s| s.series.value);
    fit_target(&Target::of_records(records, drive), initial)
}

/// Fits the family to a virgin curve given by points (U, F) rising from zero: a dictionary's
/// baseline, say, without the effects found beside it.
///
/// # Errors
/// [`FamilyError`].
pub fn fit_curve(
    displacement: &[f64],
    force: &[f64],
    drive: Drive,
) -> Result<FamilyFit, FamilyError> {
    let first = displacement.iter().zip(force).find(|(u, _)| **u > 0.0);
    fit_target(
        &Target::of_curve(displacement, force, drive),
        first.map(|(u, f)| f / u),
    )
}

/// Fits the family to all records at once from a shape that is known to be near, such as that of
/// [`fit_curve`] for a joint of the dictionary fitted to the same records.
///
/// # Errors
/// [`FamilyError::NoJoint`] where the shape leaves more than `most` rms of the judged channel.
pub fn fit_from(
    records: &[&Record],
    near: &Shape,
    drive: Drive,
    most: f64,
) -> Result<FamilyFit, FamilyError> {
    let target = Target::of_some(records, drive, FEW_SAMPLES);
    let left = target.residuals(near).ok_or(FamilyError::NoJoint)?;
    let square = left.iter().map(|r| r * r).sum::<f64>() / left.len().max(1) as f64;
    if target.scale() * square.sqrt() > most {
        return Err(FamilyError::NoJoint);
    }
    let start = match drive {
        Drive::Force => near.by_loss(target.largest_way()),
        Drive::Displacement => *near,
    };
    fit_starts(&target, &[start])
}

fn fit_target(target: &Target, initial: Option<f64>) -> Result<FamilyFit, FamilyError> {
    fit_starts(target, &start::starts(target, initial))
}

fn fit_starts(target: &Target, starts: &[Shape]) -> Result<FamilyFit, FamilyError> {
    let samples = target.respond(&|_| 0.0).iter().map(Vec::len).sum();
    if samples < LEAST_SAMPLES {
        return Err(FamilyError::TooShort {
            samples,
            least: LEAST_SAMPLES,
        });
    }
    let best = descent::global(target, starts).ok_or(FamilyError::NoJoint)?;
    let known = best.uncertainty(target).ok_or(FamilyError::NoJoint)?;
    if Told::of(target, &best.shape, &known).everything() {
        return concluded(target, best, known);
    }
    // What the data leave open is drawn softly to the middle of its range, so that it neither
    // wanders nor drags the others along; β, where nothing at all depends on it, is zero.
    let best = descent::settled(target, &best, &known);
    let known = best.uncertainty(target).ok_or(FamilyError::NoJoint)?;
    concluded(target, best, known)
}

/// The joint of load levels alone (an amplitude table): the power law (ϑ, χ), all compliance in the
/// network, extended as far as its stiffness lasts.
///
/// # Errors
/// [`FamilyError::NotMeasured`] without the growth of the loss or without the joint's stiffness.
pub fn joint_of_law(seed: &Seed) -> Result<Joint, FamilyError> {
    let missing = |missing| Err(FamilyError::NotMeasured { missing });
    let Some(law) = &seed.dissipation else {
        return missing("give at least two load levels with a positive dissipation");
    };
    if law.over == Over::Displacement {
        return missing(
            "at phase resonance the table's force is the exciter's; give --modal-mass KG or \
             --stiffness N/m, from which the joint's own force follows, or a time history",
        );
    }
    if !law.constant {
        return missing(
            "no three levels share a slope of log dissipation over log force; give more levels at \
             smaller forces, or a time history",
        );
    }
    let Some(stiffness) = &seed.stiffness else {
        return missing(
            "give the column `displacement amplitude [m]`, or --stiffness N/m, for the stiffness",
        );
    };
    if law.exponent.at_boundary.is_some() {
        return missing(
            "the loss grows as the square of the force, as a linear viscous or hysteretic element's does, or more \
             steeply than slip's; give levels at which friction is what loses, or a time history",
        );
    }
    let reference = seed.largest_force;
    let shape = Shape {
        series_stiffness: stiffness.series.value,
        size: Size::Loss {
            log: law.coefficient.value.ln() + (law.exponent.value + 3.0) * reference.ln(),
            reference_force: reference,
        },
        exponent: law.exponent.value,
        network_share: 1.0,
        last_share: 0.0,
    };
    // A stiffness and a loss that no slip lets go together.
    if shape.slip_force() <= reference {
        return missing(
            "a joint of this loss and stiffness would have slipped in full below the largest force; give a time \
             history",
        );
    }
    Ok(joint(&shape, false)?)
}

fn concluded(target: &Target, best: Best, known: Uncertainty) -> Result<FamilyFit, FamilyError> {
    let told = Told::of(target, &best.shape, &known);
    let shape = best.shape;
    let samples = best.residual.len();
    let relative_rms = best.rms();
    let estimates = Known {
        shape: &shape,
        uncertainty: &known,
        along_exponent: descent::along_exponent(target, &best, &known),
        told,
    }
    .estimates();
    Ok(FamilyFit {
        drive: target.drive(),
        shape,
        joint: joint(&shape, told.slip_force)?,
        estimates,
        rms: relative_rms * target.scale(),
        relative_rms,
        autoregression: target.autoregression(&best.residual),
        samples,
        iterations: best.iterations,
        converged: best.converged,
        not_identifiable: told.sentences(target, &shape, &known, relative_rms * target.scale()),
    })
}

/// The joint of a shape. Below full slip the two families are one and the same curve; the power law
/// is the one that claims no more than was seen.
fn joint(shape: &Shape, slip_told: bool) -> Result<Joint, JointError> {
    let density = if slip_told {
        Density::FourParameter(shape.network()?)
    } else {
        let (chi, limit) = (shape.exponent, shape.largest_slip());
        let coefficient = shape.coefficient();
        let stiffness = shape.network_stiffness();
        Density::PowerLaw(PowerLaw::new(coefficient, chi, 1.0, limit, stiffness)?)
    };
    Ok(Joint {
        density,
        series_stiffness: shape.spring(),
        effects: Vec::new(),
    })
}
