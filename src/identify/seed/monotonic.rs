//! ρ from the curvature of a monotonic pull (Eq. 31), and K_T fixed twice ("Selecting Parameters").

use super::cycle_point::CyclePoint;
use crate::record::Record;
use crate::record::cycles::turning_points;

/// Where the curve is from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// A pull from the virgin state.
    Ramp,
    /// Half a branch of the largest settled loop, halved by Masing's rule.
    Loop,
}

/// A concave virgin curve over total displacement.
#[derive(Debug, Clone, PartialEq)]
pub struct Monotonic {
    /// Where it is from.
    pub source: Source,
    /// U_i \[m\], rising from zero.
    pub displacement: Vec<f64>,
    /// F_i \[N\].
    pub force: Vec<f64>,
}

/// ρ joined to the power law, with both values of K_T.
#[derive(Debug, Clone, PartialEq)]
pub struct Matching {
    /// φ̄ with k = 1 \[m\].
    pub limit: f64,
    /// R with k = 1.
    pub coefficient: f64,
    /// K_T \[N/m\] by Eq. 51 from ϑ and R.
    pub stiffness: f64,
    /// K_T \[N/m\] by `K_T = Λ_0(∞)`: the power law's share below φ̄ and the curve's slope there.
    pub stiffness_by_sum: f64,
    /// K_1 \[N/m\] assumed or found; infinite where the curve is too shallow to tell it.
    pub spring: f64,
    /// Slip displacements of the table above φ̄ \[m\].
    pub slip: Vec<f64>,
    /// ρ there \[N/m²\] (k = 1).
    pub density: Vec<f64>,
}

impl Matching {
    /// `Λ_0(∞)/K_T − 1` (p. 34 step 5: K_T is fixed twice).
    pub fn closure_residual(&self) -> f64 {
        self.stiffness_by_sum / self.stiffness - 1.0
    }
}

impl Monotonic {
    /// Slope of the last piece over that of the first: how far the pull goes into slip.
    pub fn softening(&self) -> f64 {
        let slopes = self.slopes();
        slopes[slopes.len() - 1] / slopes[0]
    }

    fn slopes(&self) -> Vec<f64> {
        (1..self.force.len())
            .map(|i| {
                (self.force[i] - self.force[i - 1])
                    / (self.displacement[i] - self.displacement[i - 1])
            })
            .collect()
    }

    /// Network slips of the pieces' middles and its tangent stiffness there, behind K_1.
    fn network(&self, spring: f64) -> Vec<(f64, f64)> {
        self.slopes()
            .iter()
            .enumerate()
            .map(|(i, slope)| {
                let force = 0.5 * (self.force[i] + self.force[i + 1]);
                let displacement = 0.5 * (self.displacement[i] + self.displacement[i + 1]);
                (
                    displacement - force / spring,
                    1.0 / (1.0 / slope - 1.0 / spring),
                )
            })
            .collect()
    }

    /// Joins the power law (ϑ, χ) to the curvature of the pull at the force `join` \[N\].
    ///
    /// R from the stiffness lost around φ̄ (`∫ρ`), K_T from ϑ and R by Eq. 51, once more as Λ_0(∞).
    /// A pull that loses more than half its stiffness also fixes K_1, as the value for which both
    /// agree best; a shallower one cannot and K_1 is taken as infinite.
    pub fn matching(&self, theta: f64, chi: f64, series: f64, join: f64) -> Option<Matching> {
        if self.softening() > 0.5 {
            return self.matching_behind(f64::INFINITY, theta, chi, join);
        }
        (1..=60)
            .map(|i| series * (1.0 + 0.02 * (1.12_f64).powi(i)))
            .chain([f64::INFINITY])
            .filter_map(|spring| self.matching_behind(spring, theta, chi, join))
            .min_by(|a, b| {
                a.closure_residual()
                    .abs()
                    .total_cmp(&b.closure_residual().abs())
            })
    }

    fn matching_behind(&self, spring: f64, theta: f64, chi: f64, join: f64) -> Option<Matching> {
        let network = self.network(spring);
        if network
            .iter()
            .any(|&(slip, stiffness)| slip <= 0.0 || stiffness < 0.0)
        {
            return None;
        }
        let limit = interpolate(&self.force, &self.displacement, join)? - join / spring;
        let slips: Vec<f64> = network.iter().map(|n| n.0).collect();
        let tangents: Vec<f64> = network.iter().map(|n| n.1).collect();
        let (from, to) = (limit / 1.5, limit * 1.5);
        let lost = interpolate(&slips, &tangents, from)? - interpolate(&slips, &tangents, to)?;
        let order = chi + 1.0;
        let coefficient = lost * order / (to.powf(order) - from.powf(order));
        if coefficient <= 0.0 {
            return None;
        }
        let stiffness =
            (4.0 * coefficient / (theta * (chi + 2.0) * (chi + 3.0))).powf(1.0 / (chi + 3.0));
        let at_limit = interpolate(&slips, &tangents, limit)?;
        let mut slip = vec![limit];
        let mut density = vec![coefficient * limit.powf(chi)];
        for pair in network.windows(2).filter(|pair| pair[0].0 > limit) {
            slip.push(0.5 * (pair[0].0 + pair[1].0));
            density.push((pair[0].1 - pair[1].1) / (pair[1].0 - pair[0].0));
        }
        Some(Matching {
            limit,
            coefficient,
            stiffness,
            stiffness_by_sum: coefficient * limit.powf(order) / order + at_limit,
            spring,
            slip,
            density,
        })
    }
}

/// The deepest monotonic curve of the records: a pull from the virgin state that reaches at least
/// 0.8 of the largest settled loop, else that loop.
pub fn monotonic(records: &[&Record], points: &[CyclePoint]) -> Option<Monotonic> {
    let largest = points
        .iter()
        .max_by(|a, b| a.force_amplitude.total_cmp(&b.force_amplitude));
    let enough = largest.map_or(0.0, |p| 0.8 * p.force_amplitude);
    let ramp = records
        .iter()
        .filter_map(|r| ramp(r))
        .filter(|leg| leg.last().is_some_and(|p| p.1 >= enough))
        .max_by(|a, b| a[a.len() - 1].1.total_cmp(&b[b.len() - 1].1));
    match ramp {
        Some(leg) => concave(&leg, Source::Ramp),
        None => {
            let point = largest?;
            let record = records.get(point.record)?;
            concave(&half_branch(record, point), Source::Loop)
        }
    }
}

/// The virgin leg of a record that starts unloaded, as (|U|, |F|).
fn ramp(record: &Record) -> Option<Vec<(f64, f64)>> {
    let turns = turning_points(&record.force, 0.02);
    let end = *turns.get(1)?;
    let peak = record.force[end];
    let start = record.force[0];
    if end < 30 || start.abs() > 0.02 * peak.abs() {
        return None;
    }
    let sign = peak.signum();
    let origin = record.displacement[0];
    Some(
        (0..=end)
            .map(|i| {
                (
                    sign * (record.displacement[i] - origin),
                    sign * record.force[i],
                )
            })
            .collect(),
    )
}

/// The rising half of a loop from its lower tip, halved in both directions.
fn half_branch(record: &Record, point: &CyclePoint) -> Vec<(f64, f64)> {
    let force = &record.force[point.start..point.end];
    let count = force.len();
    let lowest = (0..count)
        .min_by(|&a, &b| force[a].total_cmp(&force[b]))
        .unwrap_or(0);
    let highest = (0..count)
        .max_by(|&a, &b| force[a].total_cmp(&force[b]))
        .unwrap_or(0);
    let length = (highest + count - lowest) % count;
    let at = |i: usize| point.start + (lowest + i) % count;
    let (f, u) = (record.force[at(0)], record.displacement[at(0)]);
    (0..=length)
        .map(|i| {
            (
                0.5 * (record.displacement[at(i)] - u),
                0.5 * (record.force[at(i)] - f),
            )
        })
        .collect()
}

/// Pieces of a curve.
const PIECES: usize = 24;

/// The curve averaged over about 24 stretches of displacement, denser near the origin, with its
/// slopes pooled until they fall (pool adjacent violators): the nearest concave curve.
fn concave(points: &[(f64, f64)], source: Source) -> Option<Monotonic> {
    let largest = points.iter().map(|p| p.0).fold(0.0, f64::max);
    if points.len() < 2 * PIECES || largest <= 0.0 {
        return None;
    }
    let mut means = vec![(0.0, 0.0)];
    let mut place = 0;
    for piece in 0..PIECES {
        let edge = largest * ((piece + 1) as f64 / PIECES as f64).powf(1.5);
        let end = points[place..]
            .iter()
            .position(|p| p.0 > edge)
            .map_or(points.len(), |n| place + n);
        let part = &points[place..end];
        if part.len() >= 2 {
            let n = part.len() as f64;
            let u = part.iter().map(|p| p.0).sum::<f64>() / n;
            let f = part.iter().map(|p| p.1).sum::<f64>() / n;
            if u > means[means.len() - 1].0 {
                means.push((u, f));
            }
            place = end;
        }
    }
    if means.len() < 6 {
        return None;
    }
    let (displacement, force) = pooled(&means);
    Some(Monotonic {
        source,
        displacement,
        force,
    })
}

/// Pool adjacent violators on the slopes, weighted by the width of their piece.
fn pooled(points: &[(f64, f64)]) -> (Vec<f64>, Vec<f64>) {
    let mut blocks: Vec<(f64, f64, usize)> = Vec::new();
    for pair in points.windows(2) {
        let mut block = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1, 1);
        while let Some(last) = blocks.last() {
            if last.1 / last.0 >= block.1 / block.0 {
                break;
            }
            block = (block.0 + last.0, block.1 + last.1, block.2 + last.2);
            blocks.pop();
        }
        blocks.push(block);
    }
    let (mut displacement, mut force) = (vec![0.0], vec![0.0]);
    for (width, rise, _) in blocks {
        displacement.push(displacement[displacement.len() - 1] + width);
        force.push(force[force.len() - 1] + rise);
    }
    (displacement, force)
}

/// Linear interpolation over rising `x`; `None` outside.
fn interpolate(x: &[f64], y: &[f64], at: f64) -> Option<f64> {
    let next = x.partition_point(|&v| v < at);
    if next == 0 {
        return (x.first() == Some(&at)).then(|| y[0]);
    }
    let upper = *x.get(next)?;
    let share = (at - x[next - 1]) / (upper - x[next - 1]);
    Some(y[next - 1] + share * (y[next] - y[next - 1]))
}
