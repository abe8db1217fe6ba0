//! Tips of triangles that a generator or a servo rounds within a step or two of the samples.

use super::cycles::span;

/// Coefficients of y² + A·y·t + B·t² + C·y + D·t + F = 0.
const TERMS: usize = 5;

/// Share of the interval after sample `left`, and value there, at which a rounded tip turns: the vertex of the hyperbola
/// through the six samples about it, by least squares. None where no branch of one turns there.
///
/// A hyperbola is as straight on both sides as the flanks, and as round between them as need be: its limits are
/// the corner and the parabola. Flanks need not be equally steep: where the amplitude grows they are not.
pub fn vertex(channel: &[f64], left: usize) -> Option<(f64, f64)> {
    let about = channel.get(left.checked_sub(2)?..left + 4)?;
    let least = about.iter().copied().fold(f64::INFINITY, f64::min);
    let span = span(about);
    let mut equations = [[0.0; TERMS + 1]; TERMS];
    for (i, value) in about.iter().enumerate() {
        let (t, y) = (i as f64 - 2.5, (value - least) / span);
        let terms = [y * t, t * t, y, t, 1.0, -y * y];
        for (equation, one) in equations.iter_mut().zip(terms) {
            for (sum, other) in equation.iter_mut().zip(terms) {
                *sum += one * other;
            }
        }
    }
    let [a, b, c, d, f] = solved(equations)?;
    // With asymptotes, and those neither upright nor level.
    if a * a <= 4.0 * b || b == 0.0 {
        return None;
    }
    // A slope of nought, 2B·t = −(A·y + D), put into the conic: square·y² + 2·half·y + rest = 0.
    let square = 1.0 - 0.25 * a * a / b;
    let half = 0.5 * c - 0.25 * a * d / b;
    let root = (half * half - square * (f - 0.25 * d * d / b)).sqrt();
    [root, -root]
        .map(|root| (root - half) / square)
        .map(|y| (0.5 - 0.5 * (a * y + d) / b, least + span * y))
        .into_iter()
        .find(|&(within, value)| bounded(channel, left, within, value))
}

/// True where a vertex lies in the interval, beyond its samples and within the lines through the flanks' steps.
fn bounded(channel: &[f64], left: usize, within: f64, value: f64) -> bool {
    let (start, end) = (channel[left], channel[left + 1]);
    let (rise, fall) = (start - channel[left - 1], channel[left + 2] - end);
    let lines = [start + rise * within, end - fall * (1.0 - within)];
    let sense = rise.signum();
    (0.0..=1.0).contains(&within)
        && [start, end].iter().all(|at| sense * (value - at) >= 0.0)
        && lines.iter().all(|at| sense * (value - at) <= 0.0)
}

/// Solves a square system, its right-hand side in the last column, by elimination with pivots; none where it is singular.
fn solved(mut equations: [[f64; TERMS + 1]; TERMS]) -> Option<[f64; TERMS]> {
    for column in 0..TERMS {
        let largest = (column..TERMS).max_by(|&i, &j| {
            equations[i][column]
                .abs()
                .total_cmp(&equations[j][column].abs())
        })?;
        equations.swap(column, largest);
        let lead = equations[column];
        if !lead[column].is_normal() {
            return None;
        }
        for (row, equation) in equations.iter_mut().enumerate() {
            if row != column {
                let share = equation[column] / lead[column];
                for (value, of_lead) in equation.iter_mut().zip(lead) {
                    *value -= share * of_lead;
                }
            }
        }
    }
    Some(std::array::from_fn(|i| {
        equations[i][TERMS] / equations[i][i]
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A triangle rounded by less than a step, growing, wherever the samples fall; the parabola is 2 % wrong there.
    #[test]
    fn a_rounded_tip_is_found_between_its_samples() {
        let tip = |t: f64| 3.0 + 0.2 * t - (t * t + 0.3).sqrt();
        // Where the slope is 0.2 = t/√(t² + 0.3).
        let at = 0.2 * (0.3_f64 / 0.96).sqrt();
        for shift in [-0.35, -0.2, 0.0, 0.3, 0.55] {
            let channel: Vec<f64> = (0..6).map(|i| tip(f64::from(i) - 2.5 + shift)).collect();
            for sense in [1.0, -1.0] {
                let turned: Vec<f64> = channel.iter().map(|value| sense * value).collect();
                let (within, value) = vertex(&turned, 2).expect("a tip in the interval");
                assert!((within - (at - shift + 0.5)).abs() < 1e-5, "{within}");
                assert!((value - sense * tip(at)).abs() < 1e-6, "{value}");
            }
        }
    }

    /// A parabola, a line and rest have no such tip.
    #[test]
    fn what_is_no_hyperbola_has_none() {
        let line: Vec<f64> = (0..6).map(f64::from).collect();
        assert_eq!(vertex(&line, 2), None);
        assert_eq!(vertex(&[1.0; 6], 2), None);
        assert_eq!(vertex(&[0.0, 1.0, 2.0], 1), None);
    }
}
