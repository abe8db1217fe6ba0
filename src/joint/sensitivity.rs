//! Slopes of the answer over the input: the algorithmic tangent.

/// Derivatives of the last answer with respect to the input that led to it, the state before that
/// step held: what Newton's method of an implicit master asks for. SI units, per unit of the input.
///
/// One-sided along the direction of the last step, as the answer has a kink at every reversal; a
/// step without motion keeps the direction. With the network's slope `G'` and the sliding part's
/// force `F_sl = s Λ_1` at the present point of the branch,
///
/// ```text
/// force-driven   dU/dF = 1/G' + 1/K_1     dE/dF = F_sl/G'     dW/dF = (F − F_sl)/G' + F/K_1
/// driven by U    dF/dU = 1/(1/G' + 1/K_1) dE/dU = F_sl dF/dU/G'   dW/dU = F − dE/dU
/// ```
/// (E dissipated, W stored). With effects the same follows from the equation of the step, rates
/// and creep of that step included. Checked against differences in tests/tangent.rs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// Of the force; 1 where it is the input.
    pub force: f64,
    /// Of the displacement; 1 where it is the input.
    pub displacement: f64,
    /// Of the network's displacement u.
    pub slip_displacement: f64,
    /// Of the energy dissipated.
    pub dissipation: f64,
    /// Of the energy stored.
    pub stored_energy: f64,
}

impl Sensitivity {
    /// From slopes over any other quantity to slopes over the input, whose own slope this is.
    pub(super) fn over(self, input: f64) -> Sensitivity {
        Sensitivity {
            force: self.force / input,
            displacement: self.displacement / input,
            slip_displacement: self.slip_displacement / input,
            dissipation: self.dissipation / input,
            stored_energy: self.stored_energy / input,
        }
    }
}
