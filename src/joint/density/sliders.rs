//! A finite set of sliders: the discrete density, and the cells of every other one.

use super::cells::graded;
use super::{checked, checked_at};
use crate::joint::parameters::Parameter;
use crate::joint::simulation::JointError;
use crate::joint::virgin::VirginCurve;

const WEIGHT: Parameter = Parameter {
    name: "weight",
    symbol: "w_j",
    unit: "N/m",
    lower: 1e-300,
    upper: 1e300,
    vanishes_at: None,
    neutral: None,
    meaning: "Stiffness of one slider.",
};
const SLIP_AT: Parameter = Parameter {
    name: "slip_at",
    symbol: "d_j",
    unit: "m",
    lower: 1e-300,
    upper: 1e300,
    vanishes_at: None,
    neutral: None,
    meaning: "Slip displacement at which one slider lets go.",
};
const ELASTIC: Parameter = Parameter {
    name: "elastic",
    symbol: "S_inf",
    unit: "N/m",
    lower: 0.0,
    upper: 1e300,
    vanishes_at: None,
    neutral: None,
    meaning: "Stiffness that remains after every slider has slipped; zero at full slip.",
};

/// Sliders in parallel, sorted by the displacement at which they slip, with an elastic remainder.
///
/// Slider j is a spring `w_j` \[N/m\] in series with a friction element of strength `w_j d_j` \[N\]:
/// `G(u) = S_∞ u + Σ w_j min(u, d_j)`. Made by [`Sliders::new`]; the fields are for reading, a
/// changed set is a new one.
#[derive(Debug, Clone, PartialEq)]
pub struct Sliders {
    /// `w_j` \[N/m\], positive.
    pub weight: Vec<f64>,
    /// `d_j` \[m\], the slip displacement at which slider j lets go; not decreasing.
    pub slip_at: Vec<f64>,
    /// `S_∞` \[N/m\], stiffness that remains after every slider has slipped; zero at full slip.
    pub elastic: f64,
    /// The corners of G: the origin, then one per slider.
    corners: Vec<Corner>,
}

/// A corner of the piecewise-linear virgin curve and the straight line that leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Corner {
    /// d_j \[m\].
    slip: f64,
    /// r_j = G(d_j) \[N\].
    force: f64,
    /// S_j \[N/m\], stiffness beyond.
    stiffness: f64,
    /// Λ_1 beyond \[N\]: force of the sliders that slide.
    sliding: f64,
    /// d(d_j) \[J\].
    lost: f64,
}

impl Default for Sliders {
    /// No slider and no stiffness.
    fn default() -> Sliders {
        Sliders::sorted(Vec::new(), Vec::new(), 0.0)
    }
}

impl Sliders {
    /// Glossary of the scalar parameters; weights and slip displacements are vectors beside it.
    pub const PARAMETERS: &'static [Parameter] = &[ELASTIC];

    /// Sliders `(w_j \[N/m\], d_j \[m\])` in any order with the elastic remainder \[N/m\].
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] for a weight or slip displacement that is not positive (with its place), a
    /// negative remainder, or vectors of different length (named `slip_at count`).
    pub fn new(weight: Vec<f64>, slip_at: Vec<f64>, elastic: f64) -> Result<Sliders, JointError> {
        if weight.len() != slip_at.len() {
            let count = weight.len() as f64;
            return Err(JointError::OutOfRange {
                name: "slip_at count".into(),
                value: slip_at.len() as f64,
                lower: count,
                upper: count,
            });
        }
        for (j, (&w, &d)) in weight.iter().zip(&slip_at).enumerate() {
            checked_at(&WEIGHT, j, w)?;
            checked_at(&SLIP_AT, j, d)?;
        }
        checked(&ELASTIC, elastic)?;
        let mut order: Vec<usize> = (0..weight.len()).collect();
        order.sort_by(|&a, &b| slip_at[a].total_cmp(&slip_at[b]));
        let weight = order.iter().map(|&j| weight[j]).collect();
        let slip_at = order.iter().map(|&j| slip_at[j]).collect();
        Ok(Sliders::sorted(weight, slip_at, elastic))
    }

    /// Sliders that are already checked and in order.
    pub(super) fn sorted(weight: Vec<f64>, slip_at: Vec<f64>, elastic: f64) -> Sliders {
        // Summed from the stiffness that is left upwards: small remainders keep their digits.
        let mut stiffness = vec![elastic; weight.len() + 1];
        for j in (0..weight.len()).rev() {
            stiffness[j] = stiffness[j + 1] + weight[j];
        }
        let mut last = Corner {
            slip: 0.0,
            force: 0.0,
            stiffness: stiffness[0],
            sliding: 0.0,
            lost: 0.0,
        };
        let mut corners = vec![last];
        for (j, (&w, &d)) in weight.iter().zip(&slip_at).enumerate() {
            let way = d - last.slip;
            last = Corner {
                slip: d,
                force: last.force + last.stiffness * way,
                stiffness: stiffness[j + 1],
                sliding: last.sliding + w * d,
                lost: last.lost + last.sliding * way,
            };
            corners.push(last);
        }
        Sliders {
            weight,
            slip_at,
            elastic,
            corners,
        }
    }

    /// At most `count` sliders for those that slip by `largest_slip` \[m\], merged in cells by mass
    /// and centroid where there are more; the rest elastic.
    pub fn cells(&self, count: usize, largest_slip: f64) -> Sliders {
        let within = self.slip_at.partition_point(|&d| d <= largest_slip);
        let elastic = self.corners[within].stiffness;
        if within <= count {
            let (weight, slip_at) = (&self.weight[..within], &self.slip_at[..within]);
            return Sliders::sorted(weight.to_vec(), slip_at.to_vec(), elastic);
        }
        let moments = |slip| (self.slipped_stiffness(slip), self.slipped_force(slip));
        let cells = graded(moments, count.max(1), self.slip_at[within - 1]);
        Sliders::sorted(cells.weight, cells.slip_at, elastic)
    }

    /// The last corner at or before slip `u`: O(log N).
    fn corner(&self, slip: f64) -> &Corner {
        let passed = self.slip_at.partition_point(|&d| d <= slip);
        &self.corners[passed]
    }
}

impl VirginCurve for Sliders {
    fn force(&self, slip: f64) -> f64 {
        let corner = self.corner(slip);
        if corner.stiffness > 0.0 {
            corner.force + corner.stiffness * (slip - corner.slip)
        } else {
            corner.force
        }
    }
    fn stiffness(&self, slip: f64) -> f64 {
        self.corner(slip).stiffness
    }
    fn displacement(&self, force: f64) -> f64 {
        let passed = self.corners[1..].partition_point(|corner| corner.force <= force);
        let corner = &self.corners[passed];
        if corner.stiffness > 0.0 {
            corner.slip + (force - corner.force) / corner.stiffness
        } else {
            f64::INFINITY
        }
    }
    fn leg_dissipation(&self, slip: f64) -> f64 {
        let corner = self.corner(slip);
        corner.lost + corner.sliding * (slip - corner.slip)
    }
    fn full_slip_force(&self) -> f64 {
        match self.corners.last() {
            Some(last) if last.stiffness <= 0.0 => last.force,
            _ => f64::INFINITY,
        }
    }
    fn initial_stiffness(&self) -> f64 {
        self.corners[0].stiffness
    }
    fn slipped_force(&self, slip: f64) -> f64 {
        self.corner(slip).sliding
    }
}
