//! Where a variable's value lives in a joint, and the parameters that a joint has.

use super::table::{CAUSE_REFERENCES, PARAMETER_REFERENCES, REFERENCES_PER_CAUSE};
use super::{Causality, Signal, Variable};
use crate::joint::{Density, Joint, JointError, Parameter, PowerLawTable, Sliders};

/// Where a variable's value lives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Input or answer of the simulation.
    Signal(Signal),
    /// K_1 of the joint.
    SeriesStiffness,
    /// A parameter of the density, by its place in the family's glossary.
    Density(usize),
    /// A parameter of a cause, by the places of both.
    Effect {
        /// Place in [`Joint::effects`].
        effect: usize,
        /// Place in the cause's glossary.
        parameter: usize,
    },
}

impl Place {
    /// Value of a parameter in this joint [SI]; `None` for signals, which a joint does not hold.
    pub fn read(self, joint: &Joint) -> Option<f64> {
        match self {
            Place::Signal(_) => None,
            Place::SeriesStiffness => Some(joint.series_stiffness),
            Place::Density(parameter) => joint.density.values().get(parameter).copied(),
            Place::Effect { effect, parameter } => {
                joint.effects.get(effect)?.values.get(parameter).copied()
            }
        }
    }
}

/// The joint with these values in these places.
pub fn apply(
    joint: &Joint,
    values: impl Iterator<Item = (Place, f64)>,
) -> Result<Joint, JointError> {
    let mut changed = joint.clone();
    let mut density = joint.density.values();
    for (place, value) in values {
        let slot = match place {
            Place::Signal(_) => None,
            Place::SeriesStiffness => Some(&mut changed.series_stiffness),
            Place::Density(parameter) => density.get_mut(parameter),
            Place::Effect { effect, parameter } => changed
                .effects
                .get_mut(effect)
                .and_then(|acting| acting.values.get_mut(parameter)),
        };
        if let Some(slot) = slot {
            *slot = value;
        }
    }
    if density != joint.density.values() {
        changed.density = with_values(&joint.density, &density)?;
    }
    Ok(changed)
}

/// The density with other scalar parameters; its table or sliders stay.
fn with_values(density: &Density, values: &[f64]) -> Result<Density, JointError> {
    match (density, values) {
        (Density::PowerLawTable(table), &[coefficient, exponent, slider_stiffness, stiffness]) => {
            let (break_free, density) = (table.break_free.clone(), table.density.clone());
            PowerLawTable::new(
                coefficient,
                exponent,
                slider_stiffness,
                stiffness,
                break_free,
                density,
            )
            .map(Density::PowerLawTable)
        }
        (Density::Sliders(sliders), &[elastic]) => {
            Sliders::new(sliders.weight.clone(), sliders.slip_at.clone(), elastic)
                .map(Density::Sliders)
        }
        _ => Density::from_values(density.family(), values),
    }
}

/// Why a joint cannot be shown as FMI variables.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VariableError {
    /// A parameter of a density that the table does not know.
    #[error("parameter `{name}` has no value reference: add it to modelDescription/parameters.csv")]
    UnknownParameter {
        /// Glossary name.
        name: String,
    },
    /// A cause that the table does not know.
    #[error("cause `{name}` has no value references: add it to modelDescription/causes.csv")]
    UnknownCause {
        /// Contract name.
        name: String,
    },
    /// More parameters than a cause has references.
    #[error("cause `{name}` has {count} parameters: value references hold {room} of them")]
    TooManyParameters {
        /// Contract name.
        name: String,
        /// Length of its glossary.
        count: usize,
        /// References per cause.
        room: u32,
    },
    /// A cause that acts twice: its parameters' names would be the same.
    #[error("cause `{name}` stands twice in the joint: its parameters would have the same names")]
    CauseTwice {
        /// Contract name.
        name: String,
    },
    /// A cause of the measuring chain in a joint.
    #[error("cause `{name}` belongs to the measuring chain and is never part of an exported joint")]
    MeasurementCause {
        /// Contract name.
        name: String,
    },
}

/// Parameters of a joint: K_1, the density's glossary, the causes'. What is infinite in this joint
/// is left out, since neither XML nor an importer's field could hold it.
pub fn parameters(joint: &Joint) -> Result<Vec<Variable>, VariableError> {
    let reference = reference_of("series_stiffness")?;
    let mut list = vec![variable(
        reference,
        "",
        &SERIES_STIFFNESS,
        Place::SeriesStiffness,
    )];
    for (index, entry) in joint.density.parameters().iter().enumerate() {
        list.push(variable(
            reference_of(entry.name)?,
            "",
            entry,
            Place::Density(index),
        ));
    }
    for effect in 0..joint.effects.len() {
        list.extend(cause_parameters(joint, effect)?);
    }
    list.retain(|variable| variable.place.read(joint).is_some_and(f64::is_finite));
    Ok(list)
}

/// Glossary entry of K_1.
static SERIES_STIFFNESS: Parameter = Parameter {
    name: "series_stiffness",
    symbol: "K_1",
    unit: "N/m",
    lower: 1e-12,
    upper: f64::INFINITY,
    vanishes_at: None,
    neutral: None,
    meaning: "Stiffness of the spring in series with the Iwan network",
};

fn cause_parameters(joint: &Joint, effect: usize) -> Result<Vec<Variable>, VariableError> {
    let acting = joint.effects[effect].effect;
    let name = acting.name();
    let glossary = acting.parameters();
    if acting.place().is_measurement() {
        return Err(VariableError::MeasurementCause {
            name: name.to_owned(),
        });
    }
    if joint.effects[..effect]
        .iter()
        .any(|other| other.effect.name() == name)
    {
        return Err(VariableError::CauseTwice {
            name: name.to_owned(),
        });
    }
    if glossary.len() > REFERENCES_PER_CAUSE as usize {
        return Err(VariableError::TooManyParameters {
            name: name.to_owned(),
            count: glossary.len(),
            room: REFERENCES_PER_CAUSE,
        });
    }
    let first = find(CAUSE_REFERENCES, name).ok_or_else(|| VariableError::UnknownCause {
        name: name.to_owned(),
    })?;
    let places = (first..).zip(glossary).enumerate();
    Ok(places
        .map(|(parameter, (reference, entry))| {
            variable(reference, name, entry, Place::Effect { effect, parameter })
        })
        .collect())
}

/// Bound of a parameter that has none of its own: importers that draw or optimise values need one.
const LARGEST: f64 = 1e300;

fn variable(reference: u32, owner: &str, entry: &Parameter, place: Place) -> Variable {
    let name = if owner.is_empty() {
        entry.name.to_owned()
    } else {
        format!("{owner}.{}", entry.name)
    };
    Variable {
        reference,
        name,
        unit: entry.unit,
        causality: Causality::Parameter,
        lower: entry.lower,
        upper: entry.upper.min(LARGEST),
        description: format!("{} ({})", entry.meaning.trim_end_matches('.'), entry.symbol),
        place,
    }
}

fn reference_of(name: &str) -> Result<u32, VariableError> {
    find(PARAMETER_REFERENCES, name).ok_or_else(|| VariableError::UnknownParameter {
        name: name.to_owned(),
    })
}

fn find(table: &[(&str, u32)], name: &str) -> Option<u32> {
    table.iter().find(|row| row.0 == name).map(|row| row.1)
}
