//! What the records tell of a fitted joint and what they do not, decided from the fit.

use super::shape::{LAST_SHARE, NETWORK_SHARE, Shape};
use super::target::Target;
use super::uncertainty::Uncertainty;
use crate::identify::interval::NORMAL_95;
use crate::joint::Drive;

/// Which of the family's numbers the records tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Told {
    /// The split of the initial compliance, and so K_1 and K_T.
    pub split: bool,
    /// F_S.
    pub slip_force: bool,
    /// β.
    pub ratio: bool,
}

/// Standard deviation of a logarithm (or of χ) from which on a number counts as not told.
const LOOSE: f64 = 0.25;

impl Told {
    /// From the reach of the records and the uncertainty of the fit.
    pub fn of(target: &Target, shape: &Shape, known: &Uncertainty) -> Told {
        let ratio = known.knows_share(LAST_SHARE);
        // Before the last sliders slip, F_S follows from what is assumed of them.
        let reached = target.drive() == Drive::Displacement
            && target.largest_way() >= shape.largest_slip() + shape.slip_force() / shape.spring();
        let close = known.of(shape, &|s| s.slip_force().ln()) < LOOSE;
        Told {
            split: known.knows_share(NETWORK_SHARE),
            slip_force: (ratio || reached) && close,
            ratio,
        }
    }

    /// True where the records tell all five numbers.
    pub fn everything(&self) -> bool {
        self.split && self.slip_force && self.ratio
    }

    /// One sentence for each number that the records do not tell; `rms` is the misfit.
    pub fn sentences(
        &self,
        target: &Target,
        shape: &Shape,
        known: &Uncertainty,
        rms: f64,
    ) -> Vec<String> {
        let (channel, unit) = match target.drive() {
            Drive::Force => ("displacement", "m"),
            Drive::Displacement => ("force", "N"),
        };
        let mut said = Vec::new();
        if !self.slip_force {
            said.push(format!(
                "F_S and β: these loads do not reach the sliders that slip last. Moving F_S and β \
                 together by the whole range of β changes the {channel} by {:.1e} {unit} rms \
                 against {rms:.1e} {unit} of misfit; the joint written takes β = {:.2} and extends \
                 the power law.",
                known.sensitivity(LAST_SHARE) * target.scale(),
                shape.ratio()
            ));
        } else if !self.ratio {
            said.push(format!(
                "β: the share of the sliders that slip last, β/(1+β), is known to ± {:.2} of 1, \
                 against ± 0.57 without any data.",
                NORMAL_95 * known.deviation(LAST_SHARE)
            ));
        }
        if !self.split {
            said.push(format!(
                "K_1 and K_T: only K_1 K_T/(K_1+K_T) = {:.5e} N/m is told, K_T is at least that. \
                 The share of the network in the compliance is known to ± {:.2} of 1, against ± \
                 0.57 without any data; the joint written has K_T = {:.3e} N/m.",
                shape.series_stiffness,
                NORMAL_95 * known.deviation(NETWORK_SHARE),
                shape.network_stiffness()
            ));
        }
        if known.deviation(2) > LOOSE {
            said.push(format!(
                "χ: its standard deviation is {:.2}; the loads span too little, or the noise covers \
                 the bend of the curve.",
                known.deviation(2)
            ));
        }
        if known.deviation(0) > LOOSE {
            said.push(format!(
                "K_1 K_T/(K_1+K_T): known to a factor of {:.1} only; too little of the record lies \
                 on the steep flanks after reversals.",
                (NORMAL_95 * known.deviation(0)).exp().min(1e9)
            ));
        }
        said
    }
}
