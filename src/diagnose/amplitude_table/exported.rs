//! From a model of levels to a joint, where the table determines one.

use super::effects::Shown;
use super::levels::{Levels, Over};
use super::model::Model;
use crate::causes::find;
use crate::diagnose::findings::Estimate;
use crate::identify::table::Known;
use crate::joint::parameters::Parameter;
use crate::joint::play::Plays;
use crate::joint::{Acting, Density, Joint, JointError, Sliders};

/// What is missing for a joint; `None` where the table and what is known beside it determine one.
pub fn missing(levels: &Levels, known: &Known) -> Option<String> {
    match levels.over {
        Over::Displacement if levels.mass_unknown => Some(
            "the table is taken at phase resonance: its force is the exciter's, so that stiffness is \
             known up to the modal mass; give --modal-mass KG or --stiffness N/m"
                .to_string(),
        ),
        Over::Displacement if !levels.has_stiffness() && known.stiffness.is_none() => Some(
            "the table is taken at phase resonance and has neither frequency nor stiffness; give \
             --stiffness N/m"
                .to_string(),
        ),
        Over::Force if known.stiffness.is_none() => Some(
            "the table has no displacement amplitude, so no stiffness: add the column `displacement \
             amplitude [m]`, or give --stiffness N/m"
                .to_string(),
        ),
        _ => None,
    }
}

/// The joint of a model: its sliders (dual of its plays), K_1 rigid because the network carries all
/// the compliance that a table can tell, and the effects. Where the stiffness is missing this is
/// the slipping part alone.
///
/// # Errors
/// [`JointError`] where the levels hold no joint at all.
pub fn joint(levels: &Levels, model: &Model, known: &Known) -> Result<Joint, JointError> {
    let acting = model
        .threshold
        .iter()
        .zip(&model.weight)
        .filter(|(_, w)| **w > 0.0);
    let (threshold, weight): (Vec<f64>, Vec<f64>) = acting.map(|(d, w)| (*d, *w)).unzip();
    let total: f64 = model.elastic + weight.iter().sum::<f64>();
    let slipping: f64 = weight.iter().sum();
    let sliders = match (levels.over, known.stiffness) {
        (Over::Displacement, Some(stiffness)) if !levels.has_stiffness() => {
            Sliders::new(weight, threshold, (stiffness - slipping).max(0.0))?
        }
        (Over::Displacement, _) => Sliders::new(weight, threshold, model.elastic)?,
        (Over::Force, stiffness) => Plays {
            compliance: stiffness.map_or(total, |stiffness| 1.0 / stiffness),
            weight,
            threshold,
        }
        .sliders()?,
    };
    let effects = model
        .effects
        .iter()
        .filter(|(_, size)| *size != 0.0)
        .filter_map(|(shown, size)| {
            let effect = find(shown.name())?.effect();
            let values = parameters(*shown, *size, total);
            Some(Acting { effect, values })
        })
        .collect();
    Joint::new(Density::Sliders(sliders), f64::INFINITY, effects)
}

/// Values of the catalogue's parameters for an effect of that size, neutral ones but for those that a table shows;
/// `stiffness` is that of the joint before slip, by which a cube of the displacement that softens becomes one of the
/// force, `b = −κ/K⁴` to leading order: that holds at any load, where a force across the joint would fall.
pub fn parameters(shown: Shown, size: f64, stiffness: f64) -> Vec<f64> {
    let seen: Vec<(&str, f64)> = match shown {
        Shown::Viscous | Shown::Quadratic => vec![("coefficient", size)],
        Shown::Cubic if size > 0.0 => vec![("across", size)],
        Shown::Cubic => vec![("cubic_compliance", -size / stiffness.powi(4))],
        Shown::Pinning { gap } => {
            vec![
                ("stiffness", size),
                ("gap_positive", gap),
                ("gap_negative", gap),
            ]
        }
    };
    let value = |parameter: &Parameter| {
        let seen = seen.iter().find(|(name, _)| *name == parameter.name);
        seen.map_or(parameter.neutral.unwrap_or_default(), |(_, value)| *value)
    };
    glossary(shown).iter().map(value).collect()
}

/// Parameters of an effect in the catalogue.
pub fn glossary(shown: Shown) -> &'static [Parameter] {
    find(shown.name()).map_or(&[][..], |cause| cause.effect().parameters())
}

/// Parameters of an effect with the intervals of their values over refits of simulated tables; without one where
/// no refit moves the value: it was taken from a grid, or a refinement that a table does not show is absent.
pub fn estimates(shown: Shown, values: &[f64], refits: &[Vec<f64>]) -> Vec<Estimate> {
    let interval = |index: usize| {
        let mut over: Vec<f64> = refits
            .iter()
            .filter_map(|v| v.get(index).copied())
            .collect();
        over.sort_by(f64::total_cmp);
        let at = |share: f64| over.get((share * over.len() as f64) as usize).copied();
        let bounds = at(0.025).zip(at(0.975)).filter(|_| over.len() >= 40);
        bounds.filter(|(lower, upper)| lower < upper)
    };
    glossary(shown)
        .iter()
        .zip(values)
        .enumerate()
        .map(|(index, (parameter, value))| Estimate {
            name: parameter.name.to_string(),
            value: *value,
            unit: parameter.unit.to_string(),
            interval: interval(index),
        })
        .collect()
}
