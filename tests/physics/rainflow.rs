//! Total dissipation by another road: counting the loops of the load, knowing nothing of a memory.

use super::families::every_family;
use super::histories::random_nested;
use iwan::joint::{Density, ExactResponse, PowerLaw, VirginCurve};

/// What a history of forces consists of; every entry is a force amplitude \[N\].
#[derive(Default)]
struct Count {
    /// Closed loops.
    loops: Vec<f64>,
    /// Branches that no later branch has answered.
    halves: Vec<f64>,
    /// The leg from rest to the largest force.
    virgin: f64,
}

/// Rainflow counting of turning values that start from rest at zero: four-point rule inside, and the
/// start of a virgin curve taken for the middle of the branch from −F to F, which it is.
fn rainflow(forces: &[f64]) -> Count {
    let mut count = Count::default();
    let mut open: Vec<f64> = Vec::new();
    for &force in forces {
        open.push(force);
        loop {
            match *open.as_slice() {
                // On one line: the middle point is no turning point.
                [.., a, b, c] if (b - a) * (c - b) >= 0.0 => {
                    let last = open.len() - 2;
                    open.remove(last);
                }
                // A loop (b, c) inside the range from a to beyond b.
                [.., a, b, c, d] if (b - c).abs() <= (b - a).abs().min((d - c).abs()) => {
                    count.loops.push((b - c).abs() / 2.0);
                    let at = open.len() - 3;
                    open.drain(at..at + 2);
                }
                // The same where the range is the virgin curve's, whose a is −b.
                [b, c, d] if (b - c).abs() <= (2.0 * b.abs()).min((d - c).abs()) => {
                    count.loops.push((b - c).abs() / 2.0);
                    open.drain(..2);
                }
                // Past −b the branch from b is complete, and the virgin curve goes on.
                [b, c] if c.abs() >= b.abs() => {
                    if b * c < 0.0 {
                        count.halves.push(b.abs());
                    }
                    open.remove(0);
                }
                _ => break,
            }
        }
    }
    count.virgin = open.first().map_or(0.0, |first| first.abs());
    let rest = open.windows(2).map(|pair| (pair[0] - pair[1]).abs() / 2.0);
    count.halves.extend(rest);
    count
}

impl Count {
    /// Σ loops + ½ Σ half loops + ¼ virgin leg, of a loss per cycle D(force amplitude).
    fn total(&self, loss: impl Fn(f64) -> f64) -> f64 {
        let loops: f64 = self.loops.iter().map(|&f| loss(f)).sum();
        let halves: f64 = self.halves.iter().map(|&f| loss(f)).sum();
        loops + halves / 2.0 + loss(self.virgin) / 4.0
    }
}

#[test]
fn counting_by_hand() {
    let count = rainflow(&[1.0, 0.4, 0.8, -0.2, 3.0, -1.0, 2.0]);
    assert_eq!(count.loops.len(), 2, "(0.4, 0.8), then (1, -0.2)");
    assert!((count.loops[0] - 0.2).abs() < 1e-15 && (count.loops[1] - 0.6).abs() < 1e-15);
    assert_eq!(
        (count.halves.as_slice(), count.virgin),
        ([2.0, 1.5].as_slice(), 3.0)
    );
    let crossed = rainflow(&[1.0, -2.0]);
    assert_eq!(
        (crossed.halves.as_slice(), crossed.virgin),
        ([1.0].as_slice(), 2.0)
    );
}

/// Exactly, at any force: D(F_0) = 4 d(H(F_0)).
#[test]
fn dissipation_is_the_sum_over_loops() {
    for case in every_family() {
        let top = case
            .density
            .force(case.range)
            .min(0.9 * case.density.full_slip_force());
        for seed in 50..53 {
            let forces: Vec<f64> = random_nested(seed, 2500).iter().map(|v| top * v).collect();
            let mut response = ExactResponse::new(case.density.clone());
            for &force in &forces {
                response.drive_force(force).unwrap();
            }
            let count = rainflow(&forces);
            let total = count.total(|force| {
                4.0 * case
                    .density
                    .leg_dissipation(case.density.displacement(force))
            });
            let error = (response.dissipation() / total - 1.0).abs();
            assert!(error < 1e-12, "{}, seed {seed}: {error:e}", case.label);
            assert!(count.loops.len() > 500, "{} loops", count.loops.len());
        }
    }
}

/// At small force: Σ ϑ (ΔF/2)^(χ+3), Eq. 47.
#[test]
fn small_loads_lose_by_the_power_law() {
    for chi in [-0.6, -0.3, 0.0, 0.5] {
        let law = PowerLaw::new(1.0, chi, 1.0, f64::INFINITY, 1.0).unwrap();
        let (small, density) = (law.small_force(), Density::PowerLaw(law));
        // Slipped share of the stiffness at the largest force: the relative size of what Eq. 47
        // leaves out, up to a factor of order χ + 3.
        let share: f64 = 1e-6;
        let top = (share * (chi + 1.0)).powf(1.0 / (chi + 1.0));
        let forces: Vec<f64> = random_nested(60, 2500).iter().map(|v| top * v).collect();
        let mut response = ExactResponse::new(density.clone());
        for &force in &forces {
            response.drive_force(force).unwrap();
        }
        let total = rainflow(&forces).total(|force| small.dissipation(force));
        let error = response.dissipation() / total - 1.0;
        println!("chi {chi}: {error:.2e} beyond the power law");
        assert!(error.abs() < 5.0 * share, "chi {chi}: {error:e}");
        assert!(slipped_share(&density, top) < 1.1 * share);
    }
}

fn slipped_share(density: &Density, force: f64) -> f64 {
    density.slipped_stiffness(density.displacement(force)) / density.initial_stiffness()
}
