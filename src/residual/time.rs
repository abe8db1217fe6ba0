//! Over time: drift, steps, wear.

use super::Residual;
use super::bin::{Bin, bins};

/// Bins over time \[s\], or over sample number where the record has no time.
pub fn over_time(residual: &Residual, count: usize) -> Vec<Bin> {
    bins(&residual.record.clock(), &residual.values, count)
}

/// A straight line through the residual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trend {
    /// Rise per second (or per sample).
    pub slope: f64,
    /// Its standard error, samples taken as independent.
    pub standard_error: f64,
}

/// Least squares trend over time; `None` below three samples.
pub fn trend(residual: &Residual) -> Option<Trend> {
    let time = residual.record.clock();
    let n = time.len() as f64;
    if time.len() < 3 {
        return None;
    }
    let mean_time = time.iter().sum::<f64>() / n;
    let mean = residual.values.iter().sum::<f64>() / n;
    let pairs = || {
        time.iter()
            .zip(&residual.values)
            .map(|(t, v)| (t - mean_time, v - mean))
    };
    let squares: f64 = pairs().map(|(t, _)| t * t).sum();
    let slope = pairs().map(|(t, v)| t * v).sum::<f64>() / squares;
    let misfit: f64 = pairs().map(|(t, v)| (v - slope * t).powi(2)).sum();
    Some(Trend {
        slope,
        standard_error: (misfit / (n - 2.0) / squares).sqrt(),
    })
}
