//! Cells of a density: weighted by exact mass, placed at their centroid.

use crate::joint::elementary::cube;

/// Weights and places of the cells between graded edges.
pub(super) struct Cells {
    /// Stiffness of each cell \[N/m\].
    pub weight: Vec<f64>,
    /// Slip displacement of each cell \[m\].
    pub slip_at: Vec<f64>,
}

/// Cuts the slip range `(0, end]` at `end (i/count)³` and puts into each cell one slider with the
/// cell's own stiffness and force, `w = [kΛ_0]`, `w d = [Λ_1]` over the cell.
///
/// `moments` gives `(kΛ_0, Λ_1)` up to a slip \[N/m, N\]. Both moments being exact, the error of the
/// virgin curve is zero at every edge and of second order between them: O(N⁻²) for every χ > −1,
/// where the midpoint rule of Eq. 54 is O(N^−(1+χ)). Cells that hold nothing are left out.
pub(super) fn graded(moments: impl Fn(f64) -> (f64, f64), count: usize, end: f64) -> Cells {
    let mut cells = Cells {
        weight: Vec::with_capacity(count),
        slip_at: Vec::with_capacity(count),
    };
    let mut below = 0.0;
    let mut before = (0.0, 0.0);
    for i in 1..=count {
        let edge = end * cube(i as f64 / count as f64);
        let after = moments(edge);
        let weight = after.0 - before.0;
        if weight > 0.0 {
            cells.weight.push(weight);
            // Rounding must not carry a centroid out of its cell.
            let centroid = (after.1 - before.1) / weight;
            cells.slip_at.push(centroid.clamp(below, edge));
        }
        below = edge;
        before = after;
    }
    cells
}
