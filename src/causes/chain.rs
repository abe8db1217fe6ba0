//! Laws of the measuring chain that a displacement sensor or the load cell may have.

use crate::joint::effect::Place;

/// Where such a law acts with its values: on the sensor's channel unless it is the load cell's.
pub(super) fn places(of_sensor: bool, of_cell: bool) -> [Option<Place>; 2] {
    [
        (of_sensor || !of_cell).then_some(Place::DisplacementChannel),
        of_cell.then_some(Place::ForceChannel),
    ]
}
