//! Where the nonlinear fit starts: a grid over the numbers that are not linear.

use super::shape::{Shape, Size};
use super::target::Target;
use crate::joint::{Drive, FourParameter};

/// Shapes to start from, best first.
pub fn starts(target: &Target, initial_stiffness: Option<f64>) -> Vec<Shape> {
    let mut found = match target.drive() {
        Drive::Force => small_force(target),
        Drive::Displacement => Vec::new(),
    };
    found.extend(deep(target, initial_stiffness, &found));
    let mut scored: Vec<(f64, Shape)> = found
        .into_iter()
        .filter_map(|shape| {
            let misfit = target.residuals(&shape)?.iter().map(|r| r * r).sum::<f64>();
            Some((misfit, shape))
        })
        .collect();
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    scored.into_iter().map(|(_, shape)| shape).collect()
}

/// Small force: for a given χ the response `U = F/K_0 + B [F^(χ+2) on its branches]` is linear in
/// 1/K_0 and `B = ϑ (χ+3)/(4(χ+1))`.
fn small_force(target: &Target) -> Vec<Shape> {
    let reference = target.largest_way();
    // In units of the largest force, so that both columns are of order one.
    let zero = target.against(&target.respond(&|_| 0.0));
    let column = |law: &dyn Fn(f64) -> f64| -> Vec<f64> {
        // Measured less the measured-less-column: the column itself, offsets taken out.
        let left = target.against(&target.respond(law));
        zero.iter().zip(left).map(|(m, r)| m - r).collect()
    };
    let linear = column(&|f| f / reference);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut found = Vec::new();
    for step in 0..12 {
        let chi = -0.9 + 0.15 * f64::from(step);
        let bent = column(&|f| (f / reference).powf(chi + 2.0));
        let (ll, lb, bb) = (
            dot(&linear, &linear),
            dot(&linear, &bent),
            dot(&bent, &bent),
        );
        let (ly, by) = (dot(&linear, &zero), dot(&bent, &zero));
        let determinant = ll * bb - lb * lb;
        let compliance = (ly * bb - by * lb) / determinant;
        let bend = (by * ll - ly * lb) / determinant;
        if !(compliance > 0.0 && bend > 0.0 && determinant > 0.0) {
            continue;
        }
        // B F_r^(χ+2) = bend, so the loss at F_r is 4(χ+1)/(χ+3) bend F_r.
        let loss = 4.0 * (chi + 1.0) / (chi + 3.0) * bend * reference;
        for (share, last) in [(0.3, 0.0), (0.6, 0.0), (1.0, 0.0), (0.6, 0.3)] {
            found.push(Shape {
                series_stiffness: reference / compliance,
                size: Size::Loss {
                    log: loss.ln(),
                    reference_force: reference,
                },
                exponent: chi,
                network_share: share,
                last_share: last,
            });
        }
    }
    found
}

/// Deep slip: slip forces a little above the largest force, initial stiffnesses about the given
/// one, shapes on a coarse grid.
fn deep(target: &Target, initial_stiffness: Option<f64>, small: &[Shape]) -> Vec<Shape> {
    let measured = target.against(&target.respond(&|_| 0.0));
    let largest_judged = target.scale() * measured.iter().fold(0.0, |m: f64, r| m.max(r.abs()));
    let (force, displacement) = match target.drive() {
        Drive::Force => (target.largest_way(), largest_judged),
        Drive::Displacement => (largest_judged, target.largest_way()),
    };
    let stiffness = initial_stiffness
        .or(small.first().map(|s| s.series_stiffness))
        .unwrap_or(3.0 * force / displacement);
    let mut found = Vec::new();
    for slip_force in [0.85, 0.95, 1.0, 1.1, 1.4] {
        for stiffer in [1.0, 3.0, 10.0] {
            for exponent in [-0.7, -0.4, 0.0, 0.5] {
                for last_share in [0.02, 0.3, 0.7] {
                    for network_share in [0.4, 1.0] {
                        let joint = stiffness * stiffer;
                        let network = FourParameter::new(
                            slip_force * force,
                            joint / network_share,
                            exponent,
                            last_share / (1.0 - last_share),
                        );
                        let spring = joint / (1.0_f64 - network_share).max(0.0);
                        let shape = network.map(|n| Shape::of(&n, spring));
                        found.extend(shape.map(|s| match target.drive() {
                            Drive::Force => s.by_loss(force),
                            Drive::Displacement => s,
                        }));
                    }
                }
            }
        }
    }
    found
}
