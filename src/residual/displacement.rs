//! Over displacement, each direction of travel by itself: stops, gaps, one-sided contact.

use super::Residual;
use super::bin::{Bin, bins};

/// Bins of the two directions.
#[derive(Debug, Clone, PartialEq)]
pub struct Sides {
    /// Displacement rising.
    pub rising: Vec<Bin>,
    /// Displacement falling.
    pub falling: Vec<Bin>,
}

/// Bins over displacement \[m\], split by the direction of the force: an elastic effect looks the
/// same both ways, friction changes sign.
///
/// The force decides the direction: in deep slip the displacement does as well, in micro-slip the
/// noise of a displacement's differences would.
pub fn over_displacement(residual: &Residual, count: usize) -> Sides {
    let force = &residual.record.force;
    let mut rising = (Vec::new(), Vec::new());
    let mut falling = (Vec::new(), Vec::new());
    let mut up = None;
    for i in 1..force.len() {
        if force[i] != force[i - 1] {
            up = Some(force[i] > force[i - 1]);
        }
        let side = match up {
            Some(true) => &mut rising,
            Some(false) => &mut falling,
            None => continue,
        };
        side.0.push(residual.record.displacement[i]);
        side.1.push(residual.values[i]);
    }
    Sides {
        rising: bins(&rising.0, &rising.1, count),
        falling: bins(&falling.0, &falling.1, count),
    }
}
