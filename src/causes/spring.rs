//! Springs in series with the joint, across it, or across its contact, and dashpots in the latter two.

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

/// Where a dashpot acts with its values: across the contact where its size there is not nought, and across the joint where
/// its size there is not, or neither.
pub(super) fn beside(across_joint: f64, across_contact: f64) -> Places {
    let contact = across_contact != 0.0;
    [
        (across_joint != 0.0 || !contact).then_some(Place::BesideJoint),
        contact.then_some(Place::BesideSlip),
        None,
    ]
}
