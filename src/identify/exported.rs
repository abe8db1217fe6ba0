//! From fitted coefficients to a joint that simulates alone.

use super::fit::Fit;
use super::operators::{Form, Operators};
use crate::joint::{Acting, Density, Joint, JointError, Sliders, play::Plays};

/// The fitted joint: its dictionary as a finite set of sliders (exactly dual where it was fitted as
/// plays), K_1 where the fit tells it (else rigid: the network carries all the compliance), and
/// the effects of the joint (those of the measuring chain stay behind).
///
/// # Errors
/// [`JointError`] where the fit holds no stiffness at all.
pub fn joint(operators: &Operators, fit: &Fit) -> Result<Joint, JointError> {
    let acting = operators.spread(&fit.coefficients[1..], |c| c > 0.0);
    let (thresholds, weights): (Vec<f64>, Vec<f64>) = acting.unzip();
    let sliders = match operators.form {
        Form::Play => {
            let total: f64 = fit.coefficients.iter().sum();
            // A fit may leave no elastic compliance; a joint cannot be rigid, and a millionth of
            // the total is far below what any record resolves.
            let compliance = fit.coefficients[0].max(1e-6 * total);
            Plays {
                compliance,
                weight: weights,
                threshold: thresholds,
            }
            .sliders()?
        }
        Form::Stop => Sliders::new(weights, thresholds, fit.coefficients[0])?,
    };
    let effects: Vec<Acting> = fit
        .effects
        .iter()
        .filter(|a| !a.effect.place().is_measurement())
        .cloned()
        .collect();
    let compliance = fit.series.unwrap_or(0.0);
    let spring = match compliance > 0.0 {
        true => 1.0 / compliance,
        false => f64::INFINITY,
    };
    Joint::new(Density::Sliders(sliders), spring, effects)
}
