//! What the seed procedure notices that a power-law joint would not do.

use super::dissipation::Over;
use super::{Level, Seed};

/// Sentences, in the order of the procedure.
pub fn findings(seed: &Seed) -> Vec<String> {
    let mut said = Vec::new();
    if let Some(law) = &seed.dissipation {
        if !law.single && law.local_slopes.len() >= 2 {
            let first = law.local_slopes[0].slope;
            let last = law.local_slopes[law.local_slopes.len() - 1].slope;
            let over = match law.over {
                Over::Force => "force",
                Over::Displacement => "displacement",
            };
            said.push(format!(
                "No single power law: the slope of log dissipation over log {over} amplitude goes \
                 from {first:.2} at the lowest levels to {last:.2} at the highest."
            ));
        }
        if law.exponent.at_boundary.is_some() {
            said.push(
                "The loss grows as the square of the load: that of a linear viscous or hysteretic \
                 element, not of slip."
                    .to_string(),
            );
        }
    }
    if let Some(slip) = &seed.residual_slip
        && !slip.agrees
    {
        said.push(format!(
            "Residual slip is {:.2} ± {:.2} times what the cyclic losses predict: the loops are not \
             those of a power-law Masing joint.",
            slip.ratio, slip.half_width
        ));
    }
    // Test frequencies of a rig are prescribed; only a table at resonance speaks of stiffness.
    if seed
        .dissipation
        .as_ref()
        .is_some_and(|law| law.over == Over::Displacement)
    {
        said.extend(frequency_finding(&seed.levels));
    }
    if let Some(matching) = &seed.matching {
        said.push(format!(
            "K_T is fixed twice (p. 34 step 5): {:.4e} N/m by Eq. 51, {:.4e} N/m by Λ_0(∞); closure \
             residual {:+.1} %.",
            matching.stiffness,
            matching.stiffness_by_sum,
            100.0 * matching.closure_residual()
        ));
    }
    said
}

/// A resonance that turns: any Iwan network only softens with amplitude.
pub fn frequency_finding(levels: &[Level]) -> Option<String> {
    let frequency: Vec<f64> = levels.iter().filter_map(|l| l.frequency).collect();
    let (first, last) = (*frequency.first()?, *frequency.last()?);
    let lowest = frequency.iter().copied().fold(f64::INFINITY, f64::min);
    let step = 5e-4 * first;
    if last - lowest <= step {
        return None;
    }
    Some(if first - lowest > step {
        format!(
            "The resonance falls from {first:.3} Hz to {lowest:.3} Hz and rises again to {last:.3} \
             Hz with amplitude: no Iwan network stiffens."
        )
    } else {
        format!(
            "The resonance rises from {lowest:.3} Hz to {last:.3} Hz with amplitude: no Iwan \
             network stiffens."
        )
    })
}
