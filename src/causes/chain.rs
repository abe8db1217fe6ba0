//! Laws of the measuring chain that a displacement sensor or the load cell may have.

use super::Scale;
use super::creep::lag;
use crate::joint::effect::{Place, Places};

/// What follows a channel with a first-order lag, `l̇ = r (U − l)` from `begins`, at every sample; exact for a
/// channel that goes straight from sample to sample.
pub(super) fn lagging(rate: f64, begins: f64, time: &[f64], channel: &[f64]) -> Vec<f64> {
    let mut lagging = begins;
    let mut before = None;
    let samples = time.iter().zip(channel);
    samples
        .map(|(&time, &value)| {
            if let Some((earlier, from)) = before {
                let [kept, old, new] = lag(rate * (time - earlier));
                lagging = kept * lagging + old * from + new * value;
            }
            before = Some((time, value));
            lagging
        })
        .collect()
}

/// Where such a law acts with its values: on the sensor's channel unless it is the load cell's.
pub(super) fn places(of_sensor: bool, of_cell: bool) -> Places {
    [
        (of_sensor || !of_cell).then_some(Place::DisplacementChannel),
        of_cell.then_some(Place::ForceChannel),
        None,
    ]
}

/// Place among the values of the first one of the channel that such a law acts on; those of the load cell begin at
/// `of_cell`.
pub(super) fn first(place: Place, of_cell: usize) -> usize {
    match place {
        Place::ForceChannel => of_cell,
        _ => 0,
    }
}

/// The load cell's values from which such a law is begun anew where force drives and the sensor's were fitted: what
/// a load cell adds to a prescribed force the joint does not feel, and moves the less for it. The first `count` of
/// the values are heights on their channels, from 0 on the sensor's and from `of_cell` on the load cell's.
pub(super) fn on_the_cell(
    values: &[f64],
    (count, of_cell): (usize, usize),
    scale: &Scale,
) -> Option<Vec<f64>> {
    let (sensor, cell) = (0..count, of_cell..of_cell + count);
    let is_zero = |range: std::ops::Range<usize>| values[range].iter().all(|v| *v == 0.0);
    if scale.judges_force || is_zero(sensor.clone()) || !is_zero(cell.clone()) {
        return None;
    }
    let stiffness = scale.force / scale.displacement;
    let mut moved = values.to_vec();
    for (from, to) in sensor.zip(cell) {
        moved[to] = -stiffness * values[from];
        moved[from] = 0.0;
    }
    Some(moved)
}

#[cfg(test)]
mod tests {
    use super::super::{Scale, find};
    use crate::joint::effect::{Acting, Place, Trajectory};

    /// Laws of both channels, and at which of their values those of the load cell begin.
    const BOTH: [(&str, usize, bool); 5] = [
        ("ac_coupling", 2, true),
        ("mains_hum", 5, false),
        ("offset_step", 3, false),
        ("sensor_nonlinearity", 4, true),
        ("sensor_saturation", 4, true),
    ];

    /// A load cell errs as a sensor that reads as much does; each start acts on one channel, and on the load cell
    /// only where its faults show.
    #[test]
    fn a_load_cell_errs_as_a_sensor_does() {
        let time: Vec<f64> = (0..400).map(|i| 0.01 * f64::from(i)).collect();
        let wave = time.iter().map(|t| 3.0 * (5.0 * t).sin() + t);
        let moved = Trajectory {
            displacement: wave.clone().collect(),
            force: vec![0.0; 400],
            time: time.clone(),
            begins: 0.0,
            test: 0,
            ..Trajectory::default()
        };
        let loaded = Trajectory {
            displacement: vec![0.0; 400],
            force: wave.collect(),
            ..moved.clone()
        };
        let scale = |judges_force| Scale {
            force: 6.0,
            displacement: 6.0,
            lengths: vec![4.0],
            period: 1.25,
            step: 0.01,
            judges_force,
            ..Scale::default()
        };
        for (name, of_cell, under_force) in BOTH {
            let cause = find(name).unwrap();
            let places = |values: Vec<f64>| -> Vec<Place> {
                let effect = cause.effect();
                Acting { effect, values }.places().collect()
            };
            let both = cause.starts(&scale(true));
            let is_cell = |values: &&Vec<f64>| places(values.to_vec()) == [Place::ForceChannel];
            let (cells, sensors): (Vec<_>, Vec<_>) = both.iter().partition(is_cell);
            assert_eq!(cells.len(), sensors.len(), "{name}");
            for sensor in &sensors {
                assert_eq!(
                    places(sensor.to_vec()),
                    [Place::DisplacementChannel],
                    "{name}"
                );
            }
            let mut seen = 0.0_f64;
            for (cell, sensor) in cells.iter().zip(&sensors) {
                assert!(cell[of_cell..].iter().any(|value| *value != 0.0), "{name}");
                let read = cause.channel(cell, Place::ForceChannel, &loaded);
                let same = cause.channel(sensor, Place::DisplacementChannel, &moved);
                assert_eq!(read, same, "{name}: {cell:?} and {sensor:?}");
                seen = read.iter().fold(seen, |most, x| most.max(x.abs()));
            }
            assert!(seen > 0.0, "{name}");
            let starts = if under_force {
                both.len()
            } else {
                sensors.len()
            };
            assert_eq!(cause.starts(&scale(false)).len(), starts, "{name}");
        }
    }
    /// A jump and a hum of the sensor begin anew as the load cell's where force drives, and there alone.
    #[test]
    fn what_is_a_sensors_may_be_a_load_cells_that_drives() {
        let scale = |judges_force| Scale {
            force: 6.0,
            displacement: 3.0,
            judges_force,
            ..Scale::default()
        };
        for (name, sensor, cell) in [
            (
                "offset_step",
                vec![0.5, 1.0, 3.0, 0.0],
                vec![0.0, 1.0, 3.0, -1.0],
            ),
            (
                "mains_hum",
                vec![0.5, 0.0, 50.0, 0.1, 0.2, 0.0, 0.0],
                vec![0.0, 0.0, 50.0, 0.1, 0.2, -1.0, 0.0],
            ),
        ] {
            let anew =
                |values: &[f64], judges| find(name).unwrap().begun_anew(values, &scale(judges));
            assert_eq!(anew(&sensor, false), Some(cell.clone()), "{name}");
            assert_eq!(anew(&sensor, true), None, "{name}");
            assert_eq!(anew(&cell, false), None, "{name}");
        }
    }
}
