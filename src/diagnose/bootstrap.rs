//! Intervals by a bootstrap over blocks: what is alike within a block is drawn together.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Resamples.
const RESAMPLES: usize = 500;

/// Fewest blocks that have an interval.
pub const FEWEST: usize = 3;

/// 95 % interval of a value computed from blocks: blocks drawn with replacement; `None` with fewer
/// than three blocks, or where the value is no number.
pub fn interval<T: Copy>(blocks: &[T], value: impl Fn(&[T]) -> f64) -> Option<(f64, f64)> {
    if blocks.len() < FEWEST {
        return None;
    }
    // A fixed seed: the same records give the same interval.
    let mut random = ChaCha8Rng::seed_from_u64(20_010_811);
    let mut drawn = blocks.to_vec();
    let mut resampled: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            for block in &mut drawn {
                *block = blocks[random.random_range(0..blocks.len())];
            }
            value(&drawn)
        })
        .collect();
    resampled.sort_by(f64::total_cmp);
    let quantile = |q: f64| resampled[(q * (RESAMPLES - 1) as f64).round() as usize];
    let (lower, upper) = (quantile(0.025), quantile(0.975));
    (lower.is_finite() && upper.is_finite()).then_some((lower, upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_of_a_mean_holds_the_mean_and_narrows() {
        let mean = |blocks: &[f64]| blocks.iter().sum::<f64>() / blocks.len() as f64;
        // 0, 1, … 9 over and over: standard deviation 2.87.
        let blocks = |count: usize| (0..count).map(|i| (i % 10) as f64).collect::<Vec<_>>();
        let (lower, upper) = interval(&blocks(100), mean).expect("enough blocks");
        assert!(lower < 4.5 && upper > 4.5);
        // 2 × 1.96 × 2.87 / √100 = 1.13.
        assert!((upper - lower - 1.13).abs() < 0.2, "{lower} {upper}");
        let (low, high) = interval(&blocks(1000), mean).expect("enough blocks");
        assert!(high - low < 0.5 * (upper - lower));
        assert_eq!(interval(&blocks(2), mean), None);
    }
}
