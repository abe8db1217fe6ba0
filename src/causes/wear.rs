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
    lower: 1e-45,
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

/// Share of the longest record's dissipated energy or path over which friction that falls settles as it runs in:
/// what takes longer is lost preload.
const SOON: f64 = 0.2;

/// Share below which a loss that is over is called running in first.
const LATE: f64 = 0.08;

/// True of a change that is over as the records begin, before the load has turned twice in any of them: so answers
/// a joint that was loaded before.
pub(super) fn at_once(values: &[f64], scale: &Scale) -> bool {
    let (dissipation, path) = scale.first_turns;
    worn(dissipation, path, values) > 1.0
}

/// True of a change that is mostly over so soon that it may be running in.
pub(super) fn soon(values: &[f64], scale: &Scale) -> bool {
    worn(SOON * scale.dissipation, SOON * scale.path, values) > 1.0
}

/// True of a change that goes on for so long that it may be lost preload.
pub(super) fn late(values: &[f64], scale: &Scale) -> bool {
    worn(LATE * scale.dissipation, LATE * scale.path, values) < 1.0
}

/// Shapes of a change of this size that happens over shares of the records' energy, and of their path.
pub(super) fn shapes(size: f64, shares: &[f64], scale: &Scale) -> Vec<Vec<f64>> {
    let by_energy = |share: &f64| vec![size, share * scale.dissipation, 0.0, 0.0];
    let by_path = |share: &f64| vec![size, ENDLESS, 0.0, 1.0 / (share * scale.path)];
    let energies = shares.iter().map(by_energy);
    energies.chain(shares.iter().map(by_path)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Scale, find};

    /// Friction that falls by the same law is called by either word where both fit, and by one elsewhere.
    #[test]
    fn friction_that_falls_has_two_names_in_between() {
        let scale = Scale {
            dissipation: 10.0,
            path: 2.0,
            first_turns: (1e-3, 1e-4),
            ..Scale::default()
        };
        let (lost, run_in) = (find("preload_loss").unwrap(), find("running_in").unwrap());
        for (energy, loss, settling) in [(0.5, false, true), (1.2, true, true), (3.0, true, false)]
        {
            let falls = [0.3, energy, 0.0, 0.0];
            let settles = [-0.3, energy, 0.0, 0.0, 0.0];
            assert_eq!(lost.plausible(&falls, &scale), loss, "{energy} J");
            assert_eq!(run_in.plausible(&settles, &scale), settling, "{energy} J");
            if loss {
                let other = settling.then_some("running_in");
                assert_eq!(lost.also_called(&falls, &scale), other, "{energy} J");
            }
            if settling {
                // Parts embed as soon as they are loaded.
                let other = Some("preload_loss");
                assert_eq!(run_in.also_called(&settles, &scale), other, "{energy} J");
            }
        }
        // What is over as the records begin is nobody's.
        for settles in [[-0.3, 5e-4, 0.0, 0.0, 0.0], [0.3, 5e-4, 0.0, 0.0, 0.0]] {
            assert!(!run_in.plausible(&settles, &scale));
            assert!(run_in.plausible(
                &settles,
                &Scale {
                    first_turns: (1e-4, 1e-4),
                    ..scale.clone()
                }
            ));
        }
        // Stiffness that is lost as late as that is nobody else's.
        assert!(run_in.plausible(&[0.0, 3.0, 0.0, 0.0, -1e-9], &scale));
        // Friction that grows, and stiffness, have one name.
        for grows in [[0.3, 1.2, 0.0, 0.0, 0.0], [0.0, 1.2, 0.0, 0.0, -1e-9]] {
            assert_eq!(run_in.also_called(&grows, &scale), None);
        }
    }
}
