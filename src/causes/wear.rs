//! How far an interface has worn: the work that changes of friction go by, shared by the causes that
//! follow it.

use super::Scale;
use crate::joint::effect::Situation;
use crate::joint::elementary::{exp, log1p};
use crate::joint::parameters::Parameter;

/// E_0; second of the values of a cause that wears.
pub(super) const ENERGY: Parameter = Parameter {
    name: "energy",
    symbol: "E_0",
    unit: "J",
    lower: 1e-15,
    upper: ENDLESS,
    vanishes_at: None,
    neutral: Some(ENDLESS),
    meaning: "dissipated energy over which the change happens",
};

/// q; third of them.
pub(super) const TAIL: Parameter = Parameter {
    name: "tail",
    symbol: "q",
    unit: "1",
    lower: 0.0,
    upper: 5.0,
    vanishes_at: None,
    neutral: Some(0.0),
    meaning: "how slowly the change dies out: exponentially for 0, as 1/(1 + E/E_0) for 1",
};

/// 1/L; last of them.
pub(super) const PER_PATH: Parameter = Parameter {
    name: "per_path",
    symbol: "1/L",
    unit: "1/m",
    lower: 0.0,
    upper: 1e15,
    vanishes_at: None,
    neutral: Some(0.0),
    meaning: "one over the path of the slip over which the change happens, where it follows that and not the energy",
};

/// An energy over which nothing wears \[J\].
pub(super) const ENDLESS: f64 = 1e12;

/// Numbers of history that [`follow_path`] keeps.
pub(super) const PATH_MEMORY: usize = 2;

/// Takes a sample into the history `[path of the slip, u]`.
pub(super) fn follow_path(now: &Situation, memory: &mut [f64]) {
    if let [path, slip] = memory {
        *path += (now.slip - *slip).abs();
        *slip = now.slip;
    }
}

/// Work done in units of what a change takes, `E/E_0 + s/L`: wear goes with the dissipated energy
/// (Fouvry), or with the path s under a load that is the same everywhere (Archard).
pub(super) fn worn(dissipation: f64, path: f64, values: &[f64]) -> f64 {
    dissipation / values[1] + path * values[3]
}

/// What is left of a change after the work `x` in units of its energy, `(1 + q x)^(−1/q)`.
pub(super) fn remaining(work: f64, tail: f64) -> f64 {
    if tail > 0.0 {
        exp(-log1p(tail * work) / tail)
    } else {
        exp(-work)
    }
}

/// Shapes of a change of this size that happens over shares of the records' energy, and of their path.
pub(super) fn shapes(size: f64, shares: &[f64], scale: &Scale) -> Vec<Vec<f64>> {
    let by_energy = |share: &f64| vec![size, share * scale.dissipation, 0.0, 0.0];
    let by_path = |share: &f64| vec![size, ENDLESS, 0.0, 1.0 / (share * scale.path)];
    let energies = shares.iter().map(by_energy);
    energies.chain(shares.iter().map(by_path)).collect()
}
