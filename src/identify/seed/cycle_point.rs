//! What one settled cycle gives the report's procedure: amplitude, energy, stiffness, residual slip.

use crate::record::Record;
use crate::record::cycles::{Cycle, alike, cycles, turning_points};

/// One settled cycle of a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CyclePoint {
    /// Which record, in the order given.
    pub record: usize,
    /// First sample.
    pub start: usize,
    /// One past the last sample.
    pub end: usize,
    /// F_0 \[N\].
    pub force_amplitude: f64,
    /// Mid force \[N\].
    pub mean_force: f64,
    /// U_0 \[m\].
    pub displacement_amplitude: f64,
    /// D = ∮ F dU \[J\].
    pub dissipation: f64,
    /// u_R \[m\]: half the width of the loop at its mid force; for a Masing joint this is the
    /// residual slip H(F_0) − 2H(F_0/2) after a virgin pull to F_0.
    pub residual_slip: f64,
    /// Frequency \[Hz\], where the record has time.
    pub frequency: Option<f64>,
}

/// Settled cycles of a record: those that repeat their predecessor and are simple loops.
///
/// The cycle after a change of level is left out: its first quarter still belongs to the old one.
pub fn cycle_points(index: usize, record: &Record) -> Vec<CyclePoint> {
    let mut found = points_cut_by(index, record, &record.force);
    // Near full slip the force is a plateau that noise cuts badly; displacement cuts better there.
    let by_displacement = points_cut_by(index, record, &record.displacement);
    if by_displacement.len() > found.len() + found.len() / 4 {
        found = by_displacement;
    }
    found
}

fn points_cut_by(index: usize, record: &Record, channel: &[f64]) -> Vec<CyclePoint> {
    let all = cycles(channel);
    all.windows(2)
        .filter(|pair| pair[0].end == pair[1].start && alike(&pair[0], &pair[1]))
        .filter(|pair| pair[1].len() >= 12 && simple(&channel[pair[1].start..pair[1].end]))
        .filter_map(|pair| point(index, record, channel, &pair[1]))
        .collect()
}

/// One maximum and one minimum only: the loop holds no nested loops.
fn simple(part: &[f64]) -> bool {
    turning_points(part, 0.1).len() <= 4
}

fn point(index: usize, record: &Record, channel: &[f64], cycle: &Cycle) -> Option<CyclePoint> {
    let Cycle { start, end, .. } = *cycle;
    if end >= record.len() || start == 0 {
        return None;
    }
    let force_peaks = peaks(&record.force[start..end]);
    let displacement_peaks = peaks(&record.displacement[start..end]);
    let force_amplitude = 0.5 * (force_peaks.1 - force_peaks.0);
    let mean_force = 0.5 * (force_peaks.1 + force_peaks.0);
    let loop_points = closed_loop(record, channel, cycle);
    let frequency = record.time.as_ref().map(|t| 1.0 / (t[end] - t[start]));
    Some(CyclePoint {
        record: index,
        start,
        end,
        force_amplitude,
        mean_force,
        displacement_amplitude: 0.5 * (displacement_peaks.1 - displacement_peaks.0),
        dissipation: energy(&loop_points, mean_force),
        residual_slip: half_width(&loop_points, mean_force)?,
        frequency,
    })
}

/// Vertices (U, F) of a cycle, begun and ended by interpolation at the cutting level.
fn closed_loop(record: &Record, channel: &[f64], cycle: &Cycle) -> Vec<(f64, f64)> {
    let level = cycle.mean;
    let crossing = |after: usize| {
        let (a, b) = (channel[after - 1], channel[after]);
        // A crossing that is no longer between its samples is taken at the nearer one.
        let share = ((level - a) / (b - a)).clamp(0.0, 1.0);
        let at = |v: &[f64]| v[after - 1] + share * (v[after] - v[after - 1]);
        (at(&record.displacement), at(&record.force))
    };
    let mut vertices = vec![crossing(cycle.start)];
    vertices.extend((cycle.start..cycle.end).map(|i| (record.displacement[i], record.force[i])));
    vertices.push(crossing(cycle.end));
    vertices
}

/// ∮ (F − F_m) dU by the trapezoid rule, closed by a straight segment.
fn energy(vertices: &[(f64, f64)], mean_force: f64) -> f64 {
    let closing = [vertices[vertices.len() - 1], vertices[0]];
    vertices
        .windows(2)
        .chain(closing.windows(2))
        .map(|pair| {
            let ((u, f), (next_u, next_f)) = (pair[0], pair[1]);
            (0.5 * (f + next_f) - mean_force) * (next_u - u)
        })
        .sum()
}

/// Half the distance between the two crossings of the mid force: falling minus rising.
fn half_width(vertices: &[(f64, f64)], mean_force: f64) -> Option<f64> {
    let mut falling = Vec::new();
    let mut rising = Vec::new();
    let closing = [vertices[vertices.len() - 1], vertices[0]];
    let height = vertices
        .iter()
        .map(|v| (v.1 - mean_force).abs())
        .fold(0.0, f64::max);
    let least = 1e-9 * height;
    for pair in vertices.windows(2).chain(closing.windows(2)) {
        let ((u, f), (next_u, next_f)) = (pair[0], pair[1]);
        let (before, after) = (f - mean_force, next_f - mean_force);
        // Half-open, so that a sample on the level counts once; the closing segment may be a point.
        if (before < 0.0) != (after < 0.0) && (next_f - f).abs() > least {
            let at = u + (mean_force - f) / (next_f - f) * (next_u - u);
            if next_f > f {
                rising.push(at)
            } else {
                falling.push(at)
            }
        }
    }
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    (!falling.is_empty() && !rising.is_empty()).then(|| 0.5 * (mean(&falling) - mean(&rising)))
}

/// Lowest and highest value of a cycle, smoothed where the channel is round at its peaks.
///
/// The largest of many noisy samples lies above the true peak; a parabola through a thirty-second
/// of the cycle on either side does not. At a sharp (triangular) peak the parabola does not fit,
/// and the sample itself is taken.
fn peaks(part: &[f64]) -> (f64, f64) {
    let mid = part.iter().sum::<f64>() / part.len() as f64;
    let extreme = |sign: f64| {
        let at = (0..part.len())
            .max_by(|&a, &b| (sign * part[a]).total_cmp(&(sign * part[b])))
            .unwrap_or(0);
        let reach = (part.len() / 32).max(2);
        let periodic = |offset: isize| {
            let n = part.len() as isize;
            part[((at as isize + offset).rem_euclid(n)) as usize]
        };
        let sine_misfit = 2e-5 * (sign * part[at] - mid * sign).abs();
        vertex(reach, &periodic, 3.0 * sample_noise(part) + sine_misfit).unwrap_or(part[at])
    };
    (extreme(-1.0), extreme(1.0))
}

/// Standard deviation of a channel's noise from its third differences (20 σ²).
fn sample_noise(part: &[f64]) -> f64 {
    let squares = part
        .windows(4)
        .map(|w| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).powi(2));
    let count = part.len().saturating_sub(3).max(1) as f64;
    (squares.sum::<f64>() / count / 20.0).sqrt()
}

/// Extreme value of the least squares parabola through samples −reach … reach; `None` where it
/// misses the samples by more than `allowed` (rms).
fn vertex(reach: usize, sample: &dyn Fn(isize) -> f64, allowed: f64) -> Option<f64> {
    let reach = reach as isize;
    let (mut s2, mut s4) = (0.0, 0.0);
    let (mut y0, mut y1, mut y2) = (0.0, 0.0, 0.0);
    for i in -reach..=reach {
        let (x, y) = (i as f64, sample(i));
        s2 += x * x;
        s4 += x.powi(4);
        y0 += y;
        y1 += x * y;
        y2 += x * x * y;
    }
    let n = (2 * reach + 1) as f64;
    let curvature = (n * y2 - s2 * y0) / (n * s4 - s2 * s2);
    let level = (y0 - curvature * s2) / n;
    let tilt = y1 / s2;
    let misfit = (-reach..=reach)
        .map(|i| {
            let x = i as f64;
            (sample(i) - level - tilt * x - curvature * x * x).powi(2)
        })
        .sum::<f64>();
    let at = -tilt / (2.0 * curvature);
    let fits = (misfit / n).sqrt() <= allowed;
    (fits && at.abs() <= reach as f64).then(|| level - tilt * tilt / (4.0 * curvature))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    fn sine(samples_per_cycle: usize, phase: f64) -> Record {
        let count = 6 * samples_per_cycle;
        let angle = |i: usize| TAU * i as f64 / samples_per_cycle as f64;
        Record {
            time: Some((0..count).map(|i| 0.01 * i as f64).collect()),
            force: (0..count).map(|i| 10.0 * angle(i).sin()).collect(),
            displacement: (0..count).map(|i| 2.0 * (angle(i) - phase).sin()).collect(),
            ..Record::default()
        }
    }

    #[test]
    fn an_ellipse_gives_its_area_width_and_amplitudes() {
        let found = cycle_points(0, &sine(400, 0.1));
        assert!(found.len() >= 3);
        for point in found {
            // Polygon of 400 corners: 2π²/3/400² = 4e-5 below the ellipse.
            assert!((point.dissipation / (PI * 20.0 * 0.1_f64.sin()) - 1.0).abs() < 1e-4);
            assert!((point.force_amplitude - 10.0).abs() < 1e-4);
            assert!((point.displacement_amplitude - 2.0).abs() < 1e-4);
            assert!((point.residual_slip - 2.0 * 0.1_f64.sin()).abs() < 1e-4);
            assert!((point.frequency.expect("it has time") - 0.25).abs() < 1e-3);
        }
    }

    #[test]
    fn a_triangle_keeps_its_sharp_peak() {
        let mut record = sine(200, 0.0);
        for f in &mut record.force {
            *f = (*f / 10.0).clamp(-1.0, 1.0).asin() * 10.0 / (PI / 2.0);
        }
        for point in cycle_points(0, &record) {
            assert!((point.force_amplitude - 10.0).abs() < 1e-6);
        }
    }
}
