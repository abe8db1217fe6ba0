//! Exact memory against brute-force sliders on long random histories.

use super::brute_force::BruteSliders;
use super::families::slider_set;
use super::histories::{Random, random_nested};
use iwan::joint::{ExactResponse, Sliders, VirginCurve};

const STEPS: usize = 4000;

/// Largest difference seen of each quantity, over the largest value of that quantity.
#[derive(Default)]
struct Gap {
    difference: [f64; 4],
    largest: [f64; 4],
    depth: usize,
}

impl Gap {
    fn see(&mut self, exact: &ExactResponse<Sliders>, brute: &BruteSliders) {
        let pairs = [
            (exact.slip(), brute.slip),
            (exact.force(), brute.force()),
            (exact.dissipation(), brute.dissipation),
            (exact.stored_energy(), brute.stored_energy()),
        ];
        for (i, (a, b)) in pairs.into_iter().enumerate() {
            self.difference[i] = self.difference[i].max((a - b).abs());
            self.largest[i] = self.largest[i].max(b.abs());
        }
        self.depth = self.depth.max(exact.depth());
    }

    fn assert_small(&self, label: &str) {
        let names = ["slip", "force", "dissipation", "stored energy"];
        for (i, name) in names.iter().enumerate() {
            let relative = self.difference[i] / self.largest[i];
            println!("{label}: {name} {relative:.1e}, depth {}", self.depth);
            assert!(
                relative < 1e-13,
                "{label}: {name} differs by {relative:.2e}"
            );
        }
        // Two turning points make a loop.
        assert!(
            self.depth >= 100,
            "{label}: only {} turning points deep",
            self.depth
        );
    }
}

#[test]
fn force_driven_memory_equals_sliders() {
    let (weight, slip_at) = slider_set();
    // With full slip the force may come near F_S; the compliance there magnifies rounding.
    for (seed, elastic, share) in [(11, 1e5, 1.3), (12, 0.0, 0.9), (13, 3e6, 1.0)] {
        let full: f64 = weight.iter().zip(&slip_at).map(|(w, d)| w * d).sum();
        let sliders = Sliders::new(weight.clone(), slip_at.clone(), elastic).unwrap();
        let mut exact = ExactResponse::new(sliders);
        let mut brute = BruteSliders::new(&weight, &slip_at, elastic);
        let mut gap = Gap::default();
        for value in random_nested(seed, STEPS) {
            exact.drive_force(share * full * value).unwrap();
            brute.drive_force(share * full * value);
            gap.see(&exact, &brute);
        }
        gap.assert_small(&format!("force, seed {seed}"));
    }
}

#[test]
fn slip_driven_memory_equals_sliders() {
    let (weight, slip_at) = slider_set();
    let last = slip_at[slip_at.len() - 1];
    // Within the slip range, and far beyond it: full slip in both directions.
    for (seed, elastic, share) in [
        (21, 1e5, 0.9),
        (22, 0.0, 0.8),
        (23, 0.0, 4.0),
        (24, 3e6, 2.0),
    ] {
        let sliders = Sliders::new(weight.clone(), slip_at.clone(), elastic).unwrap();
        let mut exact = ExactResponse::new(sliders);
        let mut brute = BruteSliders::new(&weight, &slip_at, elastic);
        let mut gap = Gap::default();
        for value in random_nested(seed, STEPS) {
            exact.drive_slip(share * last * value);
            brute.drive_slip(share * last * value);
            gap.see(&exact, &brute);
        }
        gap.assert_small(&format!("slip, seed {seed}"));
    }
}

#[test]
fn dissipation_never_falls_along_the_way() {
    let (weight, slip_at) = slider_set();
    let full = Sliders::new(weight, slip_at, 0.0).unwrap();
    let load = 0.95 * full.full_slip_force();
    let mut exact = ExactResponse::new(full);
    let mut before = 0.0;
    for value in random_nested(31, STEPS) {
        exact.drive_force(load * value).unwrap();
        assert!(exact.dissipation() >= before);
        before = exact.dissipation();
    }
    assert!(before > 0.0);
}

/// The same law holds for what a family's cells say: memory on a density and brute force on its
/// cells approach each other as the cells are refined.
#[test]
fn densities_are_the_limit_of_sliders() {
    for case in super::families::parametric() {
        let error = |count| {
            let cells = case.density.cells(count, case.range);
            let mut brute = BruteSliders::new(&cells.weight, &cells.slip_at, cells.elastic);
            let mut exact = ExactResponse::new(&case.density);
            let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
            // Few turning points at a time: what each of many would add is no matter of order.
            let mut random = Random(41);
            for value in (0..400).map(|_| random.symmetric()) {
                exact.drive_slip(0.95 * case.range * value);
                brute.drive_slip(0.95 * case.range * value);
                worst = worst.max((exact.force() - brute.force()).abs());
                largest = largest.max(exact.force().abs());
            }
            let loss = (exact.dissipation() - brute.dissipation).abs() / exact.dissipation();
            (worst / largest, loss)
        };
        let (coarse, fine) = (error(50), error(400));
        println!("{}: {coarse:?} -> {fine:?}", case.label);
        // Second order: eight times the cells, 1/64 of the error; half of that is asked.
        assert!(
            fine.0 < coarse.0 / 32.0,
            "{}: force {coarse:?} {fine:?}",
            case.label
        );
        assert!(fine.1 < 1e-3, "{}: loss {coarse:?} {fine:?}", case.label);
    }
}
