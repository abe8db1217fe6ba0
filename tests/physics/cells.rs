//! Cells of a density: exact mass, exact force, and second-order convergence for every χ.

use super::families::every_family;
use iwan::joint::{Density, ExactResponse, FourParameter, PowerLaw, Sliders, VirginCurve};

/// Loss of a steady cycle between ±force.
fn steady_loss(curve: impl VirginCurve, force: f64) -> f64 {
    let mut response = ExactResponse::new(curve);
    for value in [force, -force, force] {
        response.drive_force(value).unwrap();
    }
    let before = response.dissipation();
    for value in [-force, force] {
        response.drive_force(value).unwrap();
    }
    response.dissipation() - before
}

/// Largest relative error of the steady loss over loads that fall anywhere between the cells.
fn worst_error(density: &Density, sliders: &Sliders, loads: &[f64]) -> f64 {
    let error = |&load: &f64| (steady_loss(sliders, load) / steady_loss(density, load) - 1.0).abs();
    loads.iter().map(error).fold(0.0, f64::max)
}

/// Slope of log error over log N between the first and the last.
fn order(errors: &[(usize, f64)]) -> f64 {
    let (first, last) = (errors[0], errors[errors.len() - 1]);
    (last.1 / first.1).ln() / (last.0 as f64 / first.0 as f64).ln()
}

/// Loads whose slips lie between `low` and 1 of the range, evenly.
fn loads(density: &Density, range: f64, low: f64) -> Vec<f64> {
    let share = |i: usize| low + (1.0 - low) * i as f64 / 24.0;
    (0..=24).map(|i| density.force(range * share(i))).collect()
}

#[test]
fn cells_converge_with_the_square_of_their_number() {
    for chi in [0.0, -0.3, -0.6] {
        let law = PowerLaw::new(1e12, chi, 1.0, f64::INFINITY, 1e8).unwrap();
        let density = Density::PowerLaw(law);
        // A third of K_T has slipped at the end of the range.
        let range = ((chi + 1.0) * 1e8 / 3.0 / 1e12).powf(1.0 / (chi + 1.0));
        let loads = loads(&density, range, 0.3);
        let errors: Vec<(usize, f64)> = [25, 50, 100, 200, 400, 800]
            .into_iter()
            .map(|count| {
                (
                    count,
                    worst_error(&density, &density.cells(count, range), &loads),
                )
            })
            .collect();
        println!("chi {chi}: order {:.2}, {errors:?}", order(&errors));
        assert!(order(&errors) < -1.9, "chi {chi}: {errors:?}");
        let at_hundred = errors[2].1;
        assert!(
            at_hundred < 1e-3,
            "chi {chi}: {at_hundred:e} with 100 cells"
        );
    }
}

/// Graded edges keep the order for loads of one per cent of the range.
#[test]
fn graded_cells_reach_small_loads() {
    for chi in [0.0, -0.3, -0.6] {
        let density = Density::FourParameter(FourParameter::new(400.0, 1e7, chi, 1.0).unwrap());
        let range = f64::INFINITY;
        let last = 1e-2 * density.cells(1, range).slip_at[1];
        let loads = loads(&density, last, 0.5);
        let errors: Vec<(usize, f64)> = [50, 100, 200, 400, 800]
            .into_iter()
            .map(|count| {
                (
                    count,
                    worst_error(&density, &density.cells(count, range), &loads),
                )
            })
            .collect();
        println!("chi {chi} at 1 %: order {:.2}, {errors:?}", order(&errors));
        assert!(order(&errors) < -1.9, "chi {chi}: {errors:?}");
    }
}

/// What the cells are not: the report's midpoint rule (Eq. 54), second order for χ = 0 only.
#[test]
fn midpoint_rule_loses_its_order() {
    for (chi, expected) in [(0.0, -2.0), (-0.3, -0.7), (-0.6, -0.4)] {
        let law = PowerLaw::new(1e12, chi, 1.0, f64::INFINITY, 1e8).unwrap();
        let density = Density::PowerLaw(law);
        let range = ((chi + 1.0) * 1e8 / 3.0 / 1e12).powf(1.0 / (chi + 1.0));
        let midpoint = |count: usize| {
            let width = range / count as f64;
            let places: Vec<f64> = (0..count).map(|i| (i as f64 + 0.5) * width).collect();
            let weight: Vec<f64> = places.iter().map(|d| 1e12 * d.powf(chi) * width).collect();
            let elastic = 1e8 - weight.iter().sum::<f64>();
            Sliders::new(weight, places, elastic).unwrap()
        };
        let load = [density.force(range)];
        let errors: Vec<(usize, f64)> = [25, 100, 400, 1600]
            .into_iter()
            .map(|count| (count, worst_error(&density, &midpoint(count), &load)))
            .collect();
        println!(
            "midpoint, chi {chi}: order {:.2}, {errors:?}",
            order(&errors)
        );
        assert!(
            (order(&errors) - expected).abs() < 0.05,
            "chi {chi}: {errors:?}"
        );
    }
}

/// Mass and force are kept whatever the count, and the elastic remainder is what slips later.
#[test]
fn cells_keep_stiffness_and_force() {
    for case in every_family() {
        let curve = &case.density;
        for (count, share) in [(1, 1.0), (7, 0.5), (100, 1.0), (100, f64::INFINITY)] {
            let cells = curve.cells(count, share * case.range);
            let label = case.label;
            assert!(cells.weight.len() <= count + 1, "{label}");
            assert!(cells.slip_at.is_sorted(), "{label}");
            let stiffness = cells.initial_stiffness() / curve.initial_stiffness();
            assert!((stiffness - 1.0).abs() < 1e-12, "{label}: {stiffness}");
            if share.is_finite() {
                // At the end of the range every cell slides: force and stiffness are the density's.
                let end = share * case.range;
                assert!(
                    (cells.force(end) / curve.force(end) - 1.0).abs() < 1e-12,
                    "{label}"
                );
                let remaining = (cells.elastic - curve.stiffness(end)).abs();
                assert!(
                    remaining < 1e-12 * curve.initial_stiffness(),
                    "{label}: {remaining}"
                );
            }
        }
    }
}

#[test]
fn last_sliders_of_four_parameters_are_their_own_cell() {
    let four = FourParameter::new(400.0, 1e7, -0.4, 3.0).unwrap();
    let cells = four.cells(50, f64::INFINITY);
    assert_eq!(cells.weight.len(), 51);
    assert_eq!(cells.slip_at[50], four.largest_slip());
    assert!((cells.weight[50] / 7.5e6 - 1.0).abs() < 1e-14);
    assert_eq!(cells.elastic, 0.0);
    assert!((cells.full_slip_force() / 400.0 - 1.0).abs() < 1e-12);
    let short = four.cells(50, 0.5 * four.largest_slip());
    assert_eq!(short.weight.len(), 50);
    assert!(short.elastic > 7.5e6);
}
