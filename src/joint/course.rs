//! A channel between its samples.

use super::passed::Passed;

/// A point at which the rate of a channel jumps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// The first sample behind it.
    pub before: usize,
    /// Time \[s\].
    pub time: f64,
    /// Value, in the channel's unit.
    pub value: f64,
}

/// A channel between its samples, by the polynomials through the four about each step (Lagrange), which do not
/// reach across corners. Before the record it rests, behind it it goes straight on.
#[derive(Debug, Clone, Copy)]
pub struct Course<'a> {
    /// Times of the samples \[s\], rising.
    pub time: &'a [f64],
    /// Value at each.
    pub values: &'a [f64],
    /// Corners in order.
    pub corners: &'a [Corner],
}

impl Course<'_> {
    /// The value at `time`; `passed` finds its place from the last one's.
    pub fn at(&self, time: f64, passed: &mut Passed) -> f64 {
        let (t, u) = (self.time, self.values);
        let after = passed.at(t, time);
        if after == 0 || t.len() < 2 {
            return u.first().copied().unwrap_or_default();
        }
        if after == t.len() {
            return through(&t[after - 2..], &u[after - 2..], time);
        }
        if let Some(corner) = self.corner(after)
            && corner.time > t[after - 1]
        {
            let line =
                |a: (f64, f64), b: (f64, f64)| a.1 + (b.1 - a.1) * (time - a.0) / (b.0 - a.0);
            let tip = (corner.time, corner.value);
            return match time < corner.time {
                true => line((t[after - 1], u[after - 1]), tip),
                false => line(tip, (t[after], u[after])),
            };
        }
        let low =
            match after < 2 || self.corner(after - 1).is_some() || self.corner(after).is_some() {
                true => after - 1,
                false => after - 2,
            };
        let high = match after + 1 >= t.len() || self.corner(after + 1).is_some() {
            true => after,
            false => after + 1,
        };
        through(&t[low..=high], &u[low..=high], time)
    }

    fn corner(&self, before: usize) -> Option<&Corner> {
        let found = self.corners.binary_search_by_key(&before, |c| c.before);
        found.ok().map(|i| &self.corners[i])
    }
}

/// The polynomial through two to four points (Lagrange).
fn through(times: &[f64], values: &[f64], time: f64) -> f64 {
    // One division a point: twelve of them would take longer than all else.
    let term = |(i, value): (usize, &f64)| {
        let others = times.iter().enumerate().filter(|(j, _)| *j != i);
        let (mut above, mut below) = (*value, 1.0);
        for (_, other) in others {
            above *= time - other;
            below *= times[i] - other;
        }
        above / below
    };
    values.iter().enumerate().map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_course_goes_through_the_samples() {
        let even: Vec<f64> = (0..100).map(|i| 0.3 + 0.01 * f64::from(i)).collect();
        let uneven: Vec<f64> = even.iter().map(|t| t.powi(5)).collect();
        for time in [even, uneven, vec![2.0], vec![2.0, 3.0]] {
            let course = Course {
                time: &time,
                values: &time,
                corners: &[],
            };
            let mut passed = Passed::default();
            for at in &time {
                assert!((course.at(*at, &mut passed) - at).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn no_piece_reaches_across_a_corner() {
        let time: Vec<f64> = (0..40).map(f64::from).collect();
        // At a sample, and between two.
        for (tip, before) in [(20.0, 21), (20.3, 21)] {
            let wave = |t: f64| (t - tip).abs();
            let values: Vec<f64> = time.iter().map(|t| wave(*t)).collect();
            let corner = Corner {
                before,
                time: tip,
                value: 0.0,
            };
            let off = |corners: &[Corner]| {
                let course = Course {
                    time: &time,
                    values: &values,
                    corners,
                };
                let mut passed = Passed::default();
                (100..300).fold(0.0_f64, |worst, i| {
                    let t = 0.1 * f64::from(i);
                    worst.max((course.at(t, &mut passed) - wave(t)).abs())
                })
            };
            assert!(off(&[corner]) < 1e-12);
            assert!(off(&[]) > 0.05);
        }
    }
}
