//! The report's measured density: a power law below φ̄, a table above.

use super::cells::graded;
use super::power_law::{COEFFICIENT, EXPONENT, SLIDER_STIFFNESS, STIFFNESS, cut_seed};
use super::seed::Seed;
use super::small_force::SmallForce;
use super::{Sliders, checked, checked_at};
use crate::joint::parameters::Parameter;
use crate::joint::simulation::JointError;
use crate::joint::virgin::VirginCurve;

const BREAK_FREE: Parameter = Parameter {
    name: "break_free",
    symbol: "phi_i",
    unit: "N",
    lower: 1e-300,
    upper: 1e300,
    vanishes_at: None,
    neutral: None,
    meaning: "Break-free forces of the table, rising; the first is the end of the power law.",
};
const DENSITY: Parameter = Parameter {
    name: "density",
    symbol: "rho_i",
    unit: "1/N",
    lower: 0.0,
    upper: 1e300,
    vanishes_at: None,
    neutral: None,
    meaning: "Density of break-free forces at the table's places.",
};

/// `ρ(φ) = R φ^χ` below φ̄ (Eq. 45), piecewise linear between the points `(φ_i, ρ_i)` of a table
/// above it, with `φ̄ = φ_0` ("Selecting Parameters", steps 1–6); what then remains of K_T is elastic.
///
/// Step 5 fixes K_T twice, by Eq. 51 and by `K_T = k Λ_0(∞)`: here K_T is given and the difference,
/// the closure residual, is [`PowerLawTable::remaining_stiffness`]. Made by
/// [`PowerLawTable::new`]; the fields are for reading.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLawTable {
    /// R, in N^−(1+χ) with k in N/m.
    pub coefficient: f64,
    /// χ.
    pub exponent: f64,
    /// k \[N/m\].
    pub slider_stiffness: f64,
    /// K_T \[N/m\].
    pub stiffness: f64,
    /// φ_i \[N\], rising; `φ̄ = φ_0`.
    pub break_free: Vec<f64>,
    /// ρ_i \[1/N\], not negative, one per φ_i.
    pub density: Vec<f64>,
    seed: Seed,
    pieces: Vec<Piece>,
}

/// A piece of the curve on which `−G''` is linear in u; the last one is straight and endless.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    /// u_i \[m\], where it begins.
    slip: f64,
    /// G, G', Λ_1 and d at u_i \[N, N/m, N, J\].
    force: f64,
    stiffness: f64,
    sliding: f64,
    lost: f64,
    /// −G'' at u_i \[N/m²\] and its slope \[N/m³\].
    bend: f64,
    bend_slope: f64,
}

impl Piece {
    /// G, G', Λ_1 and d at the way t = u − u_i into the piece: the moments of a linear density.
    fn at(&self, way: f64) -> (f64, f64, f64, f64) {
        let (t, u, q, s) = (way, self.slip, self.bend, self.bend_slope);
        let force = self.force + t * (self.stiffness - t * (q / 2.0 + t * s / 6.0));
        let stiffness = self.stiffness - t * (q + t * s / 2.0);
        let sliding = self.sliding + t * (u * q + t * ((q + u * s) / 2.0 + t * s / 3.0));
        let lost = t * (self.sliding + t * (u * q / 2.0 + t * ((q + u * s) / 6.0 + t * s / 12.0)));
        (force, stiffness, sliding, self.lost + lost)
    }
}

impl PowerLawTable {
    /// Glossary of the scalar parameters, in the order of [`PowerLawTable::new`]; the table is two
    /// vectors beside it.
    pub const PARAMETERS: &'static [Parameter] =
        &[COEFFICIENT, EXPONENT, SLIDER_STIFFNESS, STIFFNESS];

    /// Checks R, χ, k \[N/m\], K_T \[N/m\] and the table (φ_i \[N\], ρ_i \[1/N\]).
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] names the parameter: `break_free` where it does not rise or is
    /// empty, `density` where it has another length (`density count`) or is negative, `stiffness`
    /// where the population needs more than K_T.
    pub fn new(
        coefficient: f64,
        exponent: f64,
        slider_stiffness: f64,
        stiffness: f64,
        break_free: Vec<f64>,
        density: Vec<f64>,
    ) -> Result<PowerLawTable, JointError> {
        let values = [coefficient, exponent, slider_stiffness, stiffness];
        for (parameter, value) in Self::PARAMETERS.iter().zip(values) {
            checked(parameter, value)?;
        }
        let count = break_free.len() as f64;
        if break_free.is_empty() || density.len() != break_free.len() {
            return Err(JointError::OutOfRange {
                name: "density count".into(),
                value: density.len() as f64,
                lower: count.max(1.0),
                upper: count.max(1.0),
            });
        }
        let mut lowest = BREAK_FREE;
        for (j, (&phi, &rho)) in break_free.iter().zip(&density).enumerate() {
            checked_at(&lowest, j, phi)?;
            lowest.lower = phi.next_up();
            checked_at(&DENSITY, j, rho)?;
        }

        let seed = cut_seed(
            coefficient,
            exponent,
            slider_stiffness,
            break_free[0],
            stiffness,
        );
        let pieces = pieces(&seed, slider_stiffness, &break_free, &density);
        let needed = stiffness - pieces[pieces.len() - 1].stiffness;
        // K_T taken from the table's own sum may miss it by rounding.
        if needed > stiffness * (1.0 + 1e-12) || seed.limit < break_free[0] / slider_stiffness {
            return Err(JointError::OutOfRange {
                name: STIFFNESS.name.into(),
                value: stiffness,
                lower: needed,
                upper: STIFFNESS.upper,
            });
        }
        let mut table = PowerLawTable {
            coefficient,
            exponent,
            slider_stiffness,
            stiffness,
            break_free,
            density,
            seed,
            pieces,
        };
        let last = table.pieces.len() - 1;
        if table.pieces[last].stiffness < stiffness * 1e-12 {
            table.pieces[last].stiffness = 0.0;
        }
        Ok(table)
    }

    /// `K_T − k Λ_0(φ_last)` \[N/m\]: the closure residual of step 5; zero where the table ends in
    /// full slip.
    pub fn remaining_stiffness(&self) -> f64 {
        self.end().stiffness
    }

    /// ϑ and χ of the small-force laws (Eq. 51).
    pub fn small_force(&self) -> SmallForce {
        SmallForce::of_density(
            self.coefficient,
            self.exponent,
            self.slider_stiffness,
            self.stiffness,
        )
    }

    /// `count` cells for what slips by `largest_slip` \[m\]; the rest elastic.
    pub fn cells(&self, count: usize, largest_slip: f64) -> Sliders {
        let end = self.end().slip.min(largest_slip.max(0.0));
        let moments = |slip| (self.slipped_stiffness(slip), self.slipped_force(slip));
        let cells = graded(moments, count.max(1), end);
        Sliders::sorted(cells.weight, cells.slip_at, self.stiffness(end))
    }

    /// The straight piece beyond the table.
    fn end(&self) -> &Piece {
        &self.pieces[self.pieces.len() - 1]
    }

    /// The piece that holds slip `u ≥ u_0`, and the way into it.
    fn piece(&self, slip: f64) -> (&Piece, f64) {
        let begun = self.pieces.partition_point(|piece| piece.slip <= slip);
        let piece = &self.pieces[begun.max(1) - 1];
        (piece, slip - piece.slip)
    }
}

/// The pieces of the curve above φ̄, each beginning where the one before ends.
fn pieces(seed: &Seed, slider_stiffness: f64, break_free: &[f64], density: &[f64]) -> Vec<Piece> {
    let square = slider_stiffness * slider_stiffness;
    let start = break_free[0] / slider_stiffness;
    let mut piece = Piece {
        slip: start,
        force: seed.force(start),
        stiffness: seed.stiffness - seed.population_stiffness(start),
        sliding: seed.population_force(start),
        lost: seed.leg_dissipation(start),
        bend: 0.0,
        bend_slope: 0.0,
    };
    let mut pieces = Vec::with_capacity(break_free.len());
    for (phi, rho) in break_free.windows(2).zip(density.windows(2)) {
        let way = (phi[1] - phi[0]) / slider_stiffness;
        piece.bend = square * rho[0];
        piece.bend_slope = square * (rho[1] - rho[0]) / way;
        pieces.push(piece);
        let (force, stiffness, sliding, lost) = piece.at(way);
        piece = Piece {
            slip: phi[1] / slider_stiffness,
            force,
            stiffness,
            sliding,
            lost,
            bend: 0.0,
            bend_slope: 0.0,
        };
    }
    pieces.push(piece);
    pieces
}

impl VirginCurve for PowerLawTable {
    fn force(&self, slip: f64) -> f64 {
        if slip < self.pieces[0].slip {
            return self.seed.force(slip);
        }
        let end = self.end();
        if slip >= end.slip && end.stiffness <= 0.0 {
            return end.force;
        }
        let (piece, way) = self.piece(slip);
        piece.at(way).0
    }

    fn stiffness(&self, slip: f64) -> f64 {
        if slip < self.pieces[0].slip {
            return self.seed.stiffness(slip);
        }
        let (piece, way) = self.piece(slip.min(self.end().slip));
        piece.at(way).1.max(0.0)
    }

    /// Newton's method on the cubic of the piece, from its left end: G is concave.
    fn displacement(&self, force: f64) -> f64 {
        let begun = self.pieces.partition_point(|piece| piece.force <= force);
        if begun == 0 {
            return self.seed.displacement(force);
        }
        let piece = &self.pieces[begun - 1];
        let Some(next_piece) = self.pieces.get(begun) else {
            return if piece.stiffness > 0.0 {
                piece.slip + (force - piece.force) / piece.stiffness
            } else {
                f64::INFINITY
            };
        };
        let longest = next_piece.slip - piece.slip;
        let mut way = 0.0;
        loop {
            let (reached, slope, ..) = piece.at(way);
            let next = (way + (force - reached) / slope).min(longest);
            if next.is_nan() || next <= way * (1.0 + f64::EPSILON) {
                return piece.slip + way;
            }
            way = next;
        }
    }

    fn leg_dissipation(&self, slip: f64) -> f64 {
        if slip < self.pieces[0].slip {
            return self.seed.leg_dissipation(slip);
        }
        let (piece, way) = self.piece(slip);
        piece.at(way).3
    }

    fn full_slip_force(&self) -> f64 {
        if self.end().stiffness > 0.0 {
            f64::INFINITY
        } else {
            self.end().force
        }
    }

    fn initial_stiffness(&self) -> f64 {
        self.stiffness
    }

    fn slipped_stiffness(&self, slip: f64) -> f64 {
        if slip < self.pieces[0].slip {
            self.seed.population_stiffness(slip)
        } else {
            self.stiffness - self.stiffness(slip)
        }
    }

    fn slipped_force(&self, slip: f64) -> f64 {
        if slip < self.pieces[0].slip {
            return self.seed.population_force(slip);
        }
        let (piece, way) = self.piece(slip.min(self.end().slip));
        piece.at(way).2
    }
}
