//! The cycles of a record, as its plots pick them.

use std::ops::Range;

/// Stretches between upward crossings of the middle of the drive's range; a band of a tenth of the
/// range keeps noise from crossing twice.
pub(super) fn cycles(drive: &[f64]) -> Vec<Range<usize>> {
    let (lower, upper) = range(drive);
    let (middle, band) = (0.5 * (lower + upper), 0.05 * (upper - lower));
    let mut below = false;
    let mut crossings = Vec::new();
    for (sample, value) in drive.iter().enumerate() {
        if *value < middle - band {
            below = true;
        } else if below && *value > middle + band {
            below = false;
            crossings.push(sample);
        }
    }
    // One sample more closes the loop.
    let stretches = crossings.windows(2);
    stretches
        .map(|pair| pair[0]..(pair[1] + 1).min(drive.len()))
        .collect()
}

/// The stretch over which the drive spans most.
pub(super) fn largest(drive: &[f64], cycles: &[Range<usize>]) -> Range<usize> {
    let span = |cycle: &Range<usize>| {
        let (lower, upper) = range(&drive[cycle.clone()]);
        upper - lower
    };
    let widest = cycles.iter().max_by(|a, b| span(a).total_cmp(&span(b)));
    widest.cloned().unwrap_or(0..drive.len())
}

fn range(values: &[f64]) -> (f64, f64) {
    let values = values.iter().copied();
    let values = values.filter(|value| value.is_finite());
    values.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |(lower, upper), value| (value.min(lower), value.max(upper)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_cycle_is_found_in_noise() {
        let drive: Vec<f64> = (0..1000)
            .map(|i| {
                let phase = f64::from(i) / 100.0;
                let growth = if (6.0..7.0).contains(&phase) {
                    2.0
                } else {
                    1.0
                };
                let ripple = 0.02 * f64::from(i % 3);
                growth * (std::f64::consts::TAU * phase).sin() + ripple
            })
            .collect();
        let cycles = cycles(&drive);
        assert_eq!(cycles.len(), 8);
        let widest = largest(&drive, &cycles);
        assert!(widest.contains(&625) && widest.contains(&675) && widest.len() < 110);
        assert_eq!(largest(&[1.0, 2.0], &[]), 0..2);
    }
}
