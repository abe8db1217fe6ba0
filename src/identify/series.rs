//! The spring in series with the network, told apart from it where something else acts on the slip
//! alone: without that the data hold only the sum of their compliances.

use super::operators::Form;
use crate::joint::effect::{Acting, Effect, Place, Response};
use crate::joint::parameters::Parameter;

/// A linear compliance in the load path, `F/K_1` (SAND2001-0811, Eq. 52); no cause, but an unknown
/// of every fit with an effect beside the slip.
pub struct SeriesCompliance;

static PARAMETERS: [Parameter; 1] = [Parameter {
    name: "series_compliance",
    symbol: "1/K_1",
    unit: "m/N",
    lower: 0.0,
    upper: 1e6,
    vanishes_at: Some(0.0),
    neutral: None,
    meaning: "displacement of the spring in series per force",
}];

impl Effect for SeriesCompliance {
    fn name(&self) -> &'static str {
        "series_compliance"
    }
    fn place(&self) -> Place {
        Place::Spring
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn spring(&self, values: &[f64], force: f64) -> Response {
        Response {
            value: values[0] * force,
            slope: values[0],
            damping: 0.0,
        }
    }
}

/// Share of the small-amplitude compliance that a fit starts with outside the network.
const SHARE: f64 = 0.02;

/// True where the split of the compliance shows: an effect works against the slip itself.
pub fn shows(effects: &[Acting]) -> bool {
    effects.iter().any(|a| a.acts_at(Place::BesideSlip))
}

/// The compliance to start from, taken out of the network's own where its form is linear in it.
pub fn start(form: Form, coefficients: &mut [f64]) -> f64 {
    match form {
        Form::Play => {
            let moved = SHARE * coefficients[0];
            coefficients[0] -= moved;
            moved
        }
        Form::Stop => {
            let stiffness: f64 = coefficients.iter().sum();
            if stiffness > 0.0 {
                SHARE / stiffness
            } else {
                0.0
            }
        }
    }
}

/// The compliance as an effect of the march.
pub fn acting(compliance: f64) -> Acting {
    Acting {
        effect: &SeriesCompliance,
        values: vec![compliance],
    }
}

/// True for the spring in series.
pub fn is(acting: &Acting) -> bool {
    acting.effect.name() == SeriesCompliance.name()
}
