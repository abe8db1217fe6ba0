//! Springs in series with the joint, across it, or across its contact.

use crate::joint::effect::{Place, Places};

/// Where such a law acts with its values: always in series, where a size of nought adds nothing, and besides across the
/// joint or across its contact where its size there is not nought.
pub(super) fn places(across_joint: f64, across_contact: f64) -> Places {
    [
        Some(Place::Spring),
        (across_joint != 0.0).then_some(Place::BesideJoint),
        (across_contact != 0.0).then_some(Place::BesideSlip),
    ]
}
