//! Loops that run backwards: columns that were exchanged, a sensor that comes late.

use crate::record::Record;
use crate::record::cycles::cycles;

/// What is said of a record whose loops give back more than they take: no joint does.
pub fn runs_backwards(record: &Record) -> Option<String> {
    let loops: Vec<f64> = cycles(&record.force)
        .iter()
        .filter(|cycle| cycle.steady)
        .map(|cycle| work(record, cycle.start..cycle.end))
        .collect();
    let backwards = loops.iter().filter(|work| **work < 0.0).count();
    // Noise turns the loops of a joint that hardly slips either way.
    let sum: f64 = loops.iter().sum();
    let squares: f64 = loops.iter().map(|work| work * work).sum();
    let surely = loops.len() >= FEWEST_LOOPS && 10 * backwards > 9 * loops.len();
    (surely && sum * sum > SURE * SURE * (squares - sum * sum / loops.len() as f64)).then(|| {
        format!(
            "Record {}: {backwards} of its {} steady loops run backwards, as if the joint gave energy back: the columns of force and displacement may be exchanged, or one channel comes late.",
            record.name,
            loops.len()
        )
    })
}

/// Work done on the joint over some samples, `Σ F ΔU` by trapezoids \[J\], closed by the chord.
fn work(record: &Record, part: std::ops::Range<usize>) -> f64 {
    let (force, displacement) = (&record.force[part.clone()], &record.displacement[part]);
    let last = force.len() - 1;
    let step =
        |i: usize, j: usize| 0.5 * (force[i] + force[j]) * (displacement[j] - displacement[i]);
    (0..last).map(|i| step(i, i + 1)).sum::<f64>() + step(last, 0)
}

/// Fewest steady loops of which it is said that they run backwards.
const FEWEST_LOOPS: usize = 3;

/// Standard deviations by which their sum has to lie below zero.
const SURE: f64 = 4.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::drawn;
    use std::f64::consts::TAU;

    /// Ten ellipses whose displacement comes so much later than the force \[rad\], in noise.
    fn ellipses(late: f64) -> Record {
        let mut noise = drawn(20_261_127);
        let phase = |i: u32| TAU * f64::from(i) / 100.0;
        Record {
            name: "ellipses".to_string(),
            force: (0..1000).map(|i| 80.0 * phase(i).sin()).collect(),
            displacement: (0..1000)
                .map(|i| 1e-6 * (phase(i) - late).sin() + 1e-8 * (noise() - 0.5))
                .collect(),
            ..Record::default()
        }
    }

    #[test]
    fn loops_that_give_energy_back_are_told() {
        assert_eq!(runs_backwards(&ellipses(0.1)), None);
        assert_eq!(runs_backwards(&ellipses(0.0)), None);
        let told = runs_backwards(&ellipses(-0.1)).unwrap();
        assert!(
            told.contains("9 of its 9 steady loops run backwards"),
            "{told}"
        );
        let late = ellipses(0.1);
        let exchanged = Record {
            force: late.displacement,
            displacement: late.force,
            ..ellipses(0.0)
        };
        assert!(runs_backwards(&exchanged).is_some());
    }
}
