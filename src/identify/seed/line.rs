//! A weighted straight line and what its scatter says of it.

use crate::identify::interval::student_95;

/// `y = intercept + slope · x`, with half-widths of the 95 % intervals.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Value at x = 0.
    pub intercept: f64,
    /// dy/dx.
    pub slope: f64,
    /// Half-width of the intercept's interval; infinite where two points leave no scatter.
    pub intercept_half_width: f64,
    /// Half-width of the slope's interval; infinite where two points leave no scatter.
    pub slope_half_width: f64,
    /// Weighted rms distance of the points from the line.
    pub scatter: f64,
}

/// Least squares line through points `(x, y)` with weights; `None` below two different `x`.
///
/// The variance is taken from the scatter about the line, so weights matter by ratio only.
pub fn line(x: &[f64], y: &[f64], weight: &[f64]) -> Option<Line> {
    let total: f64 = weight.iter().sum();
    let mean = |v: &[f64]| v.iter().zip(weight).map(|(v, w)| v * w).sum::<f64>() / total;
    let (mx, my) = (mean(x), mean(y));
    let sum = |f: &dyn Fn(usize) -> f64| (0..x.len()).map(|i| weight[i] * f(i)).sum::<f64>();
    let sxx = sum(&|i| (x[i] - mx).powi(2));
    if x.len() < 2 || sxx <= 1e-24 * total * mx.powi(2) || sxx == 0.0 {
        return None;
    }
    let slope = sum(&|i| (x[i] - mx) * (y[i] - my)) / sxx;
    let misfit = sum(&|i| (y[i] - my - slope * (x[i] - mx)).powi(2));
    let degrees = x.len() - 2;
    let factor = student_95(degrees);
    let variance = if degrees > 0 {
        misfit / degrees as f64
    } else {
        0.0
    };
    let width = |unit_variance: f64| {
        if degrees > 0 {
            factor * (variance * unit_variance).sqrt()
        } else {
            f64::INFINITY
        }
    };
    Some(Line {
        intercept: my - slope * mx,
        slope,
        intercept_half_width: width(1.0 / total + mx.powi(2) / sxx),
        slope_half_width: width(1.0 / sxx),
        scatter: (misfit / total).sqrt(),
    })
}

/// How the slope changes from one end of the points to the other, with the half-width of its
/// interval: the quadratic term of a weighted parabola times twice the range of `x`. `None` below
/// four points, where a parabola leaves no scatter.
pub fn slope_drift(x: &[f64], y: &[f64], weight: &[f64]) -> Option<(f64, f64)> {
    if x.len() < 4 {
        return None;
    }
    // The quadratic column made orthogonal to the line (Frisch–Waugh), then one-column regression.
    let square: Vec<f64> = x.iter().map(|x| x * x).collect();
    let of_square = line(x, &square, weight)?;
    let of_value = line(x, y, weight)?;
    let rest = |base: &Line, v: f64, x: f64| v - base.intercept - base.slope * x;
    let (mut qq, mut qy, mut yy) = (0.0, 0.0, 0.0);
    for i in 0..x.len() {
        let q = rest(&of_square, square[i], x[i]);
        let r = rest(&of_value, y[i], x[i]);
        qq += weight[i] * q * q;
        qy += weight[i] * q * r;
        yy += weight[i] * r * r;
    }
    let degrees = x.len() - 3;
    let quadratic = qy / qq;
    let variance = (yy - quadratic * qy).max(0.0) / degrees as f64 / qq;
    let high = x.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = x.iter().copied().fold(f64::INFINITY, f64::min);
    let range = 2.0 * (high - low);
    Some((
        quadratic * range,
        student_95(degrees) * variance.sqrt() * range,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_has_the_slope_drift_of_its_ends() {
        let x = [0.0, 1.0, 2.0, 3.0, 4.0];
        let y: Vec<f64> = x.iter().map(|x| 1.0 + 2.0 * x + 0.5 * x * x).collect();
        let (drift, _) = slope_drift(&x, &y, &[1.0; 5]).expect("five points");
        assert!((drift - 4.0).abs() < 1e-12);
    }

    #[test]
    fn the_interval_of_a_line_covers_its_slope_as_often_as_it_says() {
        // A small multiplicative generator, for independent repeatable noise.
        let mut state = 12345_u64;
        let mut uniform = move || {
            state = state
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let x: Vec<f64> = (0..6).map(f64::from).collect();
        let mut covered = 0;
        for _ in 0..2000 {
            let y: Vec<f64> = x
                .iter()
                .map(|x| 3.0 - 0.7 * x + (0..12).map(|_| uniform()).sum::<f64>() - 6.0)
                .collect();
            let fit = line(&x, &y, &[1.0; 6]).expect("six points");
            covered += usize::from((fit.slope + 0.7).abs() <= fit.slope_half_width);
        }
        // 0.95 ± 4 standard deviations of a binomial share of 2000.
        assert!((covered as f64 / 2000.0 - 0.95).abs() < 0.02, "{covered}");
    }
}
