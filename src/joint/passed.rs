//! Where a time falls among samples.

/// Counts the samples that are no later than a time, from where it was left: times that follow each other
/// find it next door.
#[derive(Debug, Clone, Copy, Default)]
pub struct Passed(usize);

impl Passed {
    /// Samples, in order of time, that are no later than `time`.
    pub fn at(&mut self, samples: &[f64], time: f64) -> usize {
        while samples.get(self.0).is_some_and(|&sample| sample <= time) {
            self.0 += 1;
        }
        while self.0 > 0 && samples[self.0 - 1] > time {
            self.0 -= 1;
        }
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_a_time_is_found_from_any_other() {
        let even: Vec<f64> = (0..100).map(|i| 0.3 + 0.01 * f64::from(i)).collect();
        let uneven: Vec<f64> = even.iter().map(|t| t * t * t).collect();
        for samples in [even, uneven, vec![2.0], vec![]] {
            let mut passed = Passed::default();
            // Up, down and in leaps.
            for i in (-20..260)
                .chain((-20..260).rev())
                .chain((0..260).step_by(97))
            {
                let time = 0.01 * f64::from(i);
                let expected = samples.partition_point(|&t| t <= time);
                assert_eq!(passed.at(&samples, time), expected, "{time} of {samples:?}");
            }
        }
    }
}
