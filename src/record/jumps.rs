//! Where a channel may have jumped: one step unlike both its neighbours.

/// Share of the largest step by which steps differ that are alike.
const ROUNDING: f64 = 1e-9;

/// Samples behind the steps that stand out most, the largest first; none where all steps are alike but for
/// rounding.
///
/// A step stands out by the smaller of its differences from the step before and the one behind: a jump
/// differs from both, a corner of a ramp from one.
pub fn jumps(channel: &[f64], most: usize) -> Vec<usize> {
    let mut found: Vec<(f64, usize)> = channel
        .windows(4)
        .enumerate()
        .map(|(i, four)| {
            let step = four[2] - four[1];
            let unlike = |other: f64| (step - other).abs();
            let least = unlike(four[1] - four[0]).min(unlike(four[3] - four[2]));
            (least, i + 2)
        })
        .collect();
    let largest = channel
        .windows(2)
        .map(|two| (two[1] - two[0]).abs())
        .fold(0.0, f64::max);
    found.retain(|(least, _)| *least > ROUNDING * largest);
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    found.into_iter().take(most).map(|(_, i)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_is_found_among_corners_and_a_spike_beside_it() {
        let ramp = |i: i32| f64::from((i % 40 - 20).abs());
        let mut channel: Vec<f64> = (0..200).map(ramp).collect();
        channel[133..].iter_mut().for_each(|x| *x += 0.7);
        assert_eq!(jumps(&channel, 2), vec![133]);
        assert_eq!(jumps(&channel[..133], 2), Vec::<usize>::new());
        channel[50] += 5.0;
        assert_eq!(jumps(&channel, 3).last(), Some(&133));
        assert_eq!(jumps(&[1.0, 2.0, 4.0], 2), Vec::<usize>::new());
    }
}
