//! What the records do not reach, said from the records.

use super::Seed;
use super::dissipation::Over;

/// A tangent below this share of the initial stiffness counts as full slip.
const FULL_SLIP: f64 = 0.05;

/// Sentences on what these records cannot show; none where they show everything the seed asks for.
pub fn not_identifiable(seed: &Seed) -> Vec<String> {
    let mut said = Vec::new();
    match &seed.dissipation {
        None if seed.levels.is_empty() => said.push(
            "No settled cycles: χ and ϑ cannot be read from the growth of the loss; they come \
             from the shape of the branches alone."
                .to_string(),
        ),
        None => said.push(format!(
            "{} load level(s), too close for a slope: the growth of the loss with load, and so χ, is \
             not measured by it.",
            seed.levels.len()
        )),
        Some(law) if law.used.1 - law.used.0 < 3 => said.push(
            "Two load levels give χ without any check that the slope is constant, and no interval."
                .to_string(),
        ),
        Some(law) if law.over == Over::Displacement => said.push(
            "The table is taken at phase resonance: its force is the exciter's and its \
             force/displacement is no stiffness of the joint; ϑ in terms of the joint's own force \
             and the series stiffness need the modal mass."
                .to_string(),
        ),
        Some(_) => {}
    }
    if let Some(stiffness) = &seed.stiffness {
        let softening = seed.monotonic.as_ref().map(super::Monotonic::softening);
        if softening.is_none_or(|s| s > FULL_SLIP) {
            let slope = softening.map_or(String::new(), |s| {
                format!(", its tangent {:.0} % of the initial stiffness", 100.0 * s)
            });
            said.push(format!(
                "Full slip is not reached (largest over initial secant compliance {:.3}{slope}): \
                 slip force F_S is above {:.4} N, and F_S and β are not separately observable.",
                stiffness.reach, seed.largest_force
            ));
        }
        if softening.is_none_or(|s| s > 0.5) {
            said.push(format!(
                "The small-load slope {:.4e} N/m is K_1 K_T/(K_1+K_T); its split into K_1 and K_T \
                 is not told by the seed procedure.",
                stiffness.series.value
            ));
        }
    } else if seed
        .dissipation
        .as_ref()
        .is_none_or(|l| l.over == Over::Force)
    {
        said.push(
            "No displacement amplitudes: neither the series stiffness nor K_1 nor K_T is measured."
                .to_string(),
        );
    }
    said
}
