//! How large a joint's quantities are: the sizes at which it softens.

use crate::joint::{Density, Joint, VirginCurve};

/// Sizes at which the network has lost a fifth of its stiffness, SI units. Importers scale their
/// tolerances by them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nominal {
    /// Force \[N\].
    pub force: f64,
    /// Total displacement \[m\].
    pub displacement: f64,
    /// Displacement of the network \[m\].
    pub slip: f64,
    /// Work of that force over that displacement \[J\].
    pub energy: f64,
    /// Tangent of the whole joint before it softens \[N/m\].
    pub stiffness: f64,
}

impl Nominal {
    /// Sizes of a joint; of its causes nothing enters.
    pub fn of(joint: &Joint) -> Nominal {
        let slip = softened(&joint.density);
        let force = joint.density.force(slip);
        let displacement = slip + force / joint.series_stiffness;
        let network = joint.density.initial_stiffness();
        Nominal {
            force,
            displacement,
            slip,
            energy: force * displacement,
            stiffness: network / (1.0 + network / joint.series_stiffness),
        }
    }

    /// Nominal value of a variable that has this name or, for parameters, this start value; `None`
    /// where there is no size to tell.
    pub fn value(&self, name: &str, start: Option<f64>) -> Option<f64> {
        let value = match name {
            "force" => self.force,
            "displacement" => self.displacement,
            "slip_displacement" => self.slip,
            "dissipation" | "stored_energy" => self.energy,
            // one such cycle per second
            "dissipation_rate" => self.energy,
            "tangent_stiffness" => self.stiffness,
            _ => start?.abs(),
        };
        (value.is_finite() && value > 0.0).then_some(value)
    }
}

/// Slip \[m\] at which the network has lost a fifth of its stiffness, to a factor of two; a joint
/// that never softens gets one metre.
fn softened(density: &Density) -> f64 {
    let wanted = 0.8 * density.initial_stiffness();
    let slips = std::iter::successors(Some(1e-15), |slip| Some(slip * 2.0));
    let mut slips = slips.take_while(|slip| *slip < 1.0);
    slips
        .find(|slip| density.stiffness(*slip) <= wanted)
        .unwrap_or(1.0)
}
