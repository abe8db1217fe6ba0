//! Means over stretches of an abscissa.

/// Residuals of one stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bin {
    /// Begin of the stretch.
    pub from: f64,
    /// End of the stretch.
    pub to: f64,
    /// Mean residual.
    pub mean: f64,
    /// Standard error of the mean, taking samples as independent: multiply by
    /// `√((1+a)/(1−a))` for neighbours of correlation a. Infinite below two samples.
    pub standard_error: f64,
    /// Count of samples.
    pub count: usize,
}

/// Equal stretches of the range of `at`; stretches without samples are left out.
pub fn bins(at: &[f64], values: &[f64], count: usize) -> Vec<Bin> {
    let high = at.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = at.iter().copied().fold(f64::INFINITY, f64::min);
    let width = (high - low) / count.max(1) as f64;
    // No range, or no samples (the range is then minus infinity).
    if width <= 0.0 || !width.is_finite() {
        return Vec::new();
    }
    let mut sums = vec![(0.0, 0.0, 0_usize); count];
    for (x, v) in at.iter().zip(values) {
        let place = (((x - low) / width) as usize).min(count - 1);
        sums[place].0 += v;
        sums[place].2 += 1;
    }
    let mean = |sum: &(f64, f64, usize)| sum.0 / sum.2 as f64;
    // Squares about the mean in a second pass: residuals may sit on a large offset.
    let means: Vec<f64> = sums.iter().map(mean).collect();
    for (x, v) in at.iter().zip(values) {
        let place = (((x - low) / width) as usize).min(count - 1);
        sums[place].1 += (v - means[place]).powi(2);
    }
    sums.iter()
        .enumerate()
        .filter(|(_, sum)| sum.2 > 0)
        .map(|(i, sum)| Bin {
            from: low + width * i as f64,
            to: low + width * (i + 1) as f64,
            mean: means[i],
            standard_error: if sum.2 > 1 {
                (sum.1 / (sum.2 - 1) as f64 / sum.2 as f64).sqrt()
            } else {
                f64::INFINITY
            },
            count: sum.2,
        })
        .collect()
}
