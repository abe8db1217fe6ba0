//! Sliders that stand for any density over its whole range, where no amplitude is known.

use crate::joint::density::Sliders;
use crate::joint::elementary::{exp, log, square};
use crate::joint::simulation::JointError;
use crate::joint::virgin::VirginCurve;

/// Edges lie at `end (i/count)⁸`: spacing 3 % of the slip at full range, 10 % at 1e-4 of it
/// and 25 % at 1e-7 (for 256 cells), since a simulation meets any amplitude.
fn grading(share: f64) -> f64 {
    square(square(square(share)))
}

/// Share of the slipping stiffness that may be missing at the end of the range.
const MISSING: f64 = 1e-13;

/// At most `count + 1` sliders with the exact stiffness and force of their cells, `[kΛ_0]` and
/// `[Λ_1]`; sliders that let go together at the end of the range are a cell of their own.
///
/// Differs from [`Density::cells`](crate::joint::Density::cells), which is told the largest slip,
/// by its finer grading towards zero. Checked in tests/extended against the exact response.
pub(in crate::joint) fn fine_cells(
    curve: &impl VirginCurve,
    count: usize,
) -> Result<Sliders, JointError> {
    let (last_before, end) = range_end(curve);
    let mut edges: Vec<f64> = (1..count)
        .map(|i| end * grading(i as f64 / count as f64))
        .collect();
    edges.extend([last_before, end]);
    let (mut weight, mut slip_at) = (Vec::new(), Vec::new());
    let (mut below, mut stiffness, mut force) = (0.0, 0.0, 0.0);
    for edge in edges {
        let (reached, carried) = (curve.slipped_stiffness(edge), curve.slipped_force(edge));
        let mass = reached - stiffness;
        if mass > MISSING * reached {
            weight.push(mass);
            // Rounding must not carry a centroid out of its cell.
            slip_at.push(((carried - force) / mass).clamp(below, edge));
            (stiffness, force) = (reached, carried);
        }
        below = edge;
    }
    let elastic = (curve.initial_stiffness() - stiffness).max(0.0);
    // What rounding leaves of a network that slips fully is no elastic remainder.
    let remains = curve.full_slip_force().is_infinite();
    Sliders::new(weight, slip_at, if remains { elastic } else { 0.0 })
}

/// Neighbouring slips between which the last slider lets go \[m\].
fn range_end(curve: &impl VirginCurve) -> (f64, f64) {
    let all = curve.slipped_stiffness(f64::MAX);
    let complete = |slip: f64| curve.slipped_stiffness(slip) >= all * (1.0 - MISSING);
    let (mut low, mut high) = (f64::MIN_POSITIVE, f64::MAX);
    // Halves the exponent first, then the digits: 1100 halvings of the ratio at most.
    loop {
        let ratio = (log(low) + log(high)) / 2.0;
        let middle = if high / low > 4.0 {
            exp(ratio)
        } else {
            low + (high - low) / 2.0
        };
        if middle <= low || middle >= high {
            return (low, high);
        }
        if complete(middle) {
            high = middle
        } else {
            low = middle
        }
    }
}
