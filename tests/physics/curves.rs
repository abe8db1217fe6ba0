//! Virgin curves: derivative, inverse, energy lost, moments and limits of every family.

use super::families::{every_family, parametric};
use iwan::joint::virgin::BehindSpring;
use iwan::joint::{Density, FourParameter, PowerLaw, PowerLawTable, Sliders, VirginCurve};

/// Slips from far below to beyond the interesting range, on no corner in particular.
fn slips(range: f64) -> impl Iterator<Item = f64> {
    (0..200).map(move |i| range * 1.5 * 10f64.powf(-(i as f64) / 25.0))
}

/// ∫_0^u f by composite Gauss–Legendre (5 points) on panels that shrink towards zero, where the
/// integrand has a power-law start.
fn integral(f: impl Fn(f64) -> f64, to: f64, panels: usize) -> f64 {
    const POINTS: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_888_9),
        (0.538_469_310_105_683, 0.478_628_670_499_366_47),
        (-0.538_469_310_105_683, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_08),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
    ];
    let edge = |i: usize| to * (i as f64 / panels as f64).powi(4);
    (0..panels)
        .map(|i| {
            let (a, b) = (edge(i), edge(i + 1));
            let panel = POINTS
                .iter()
                .map(|(x, w)| w * f(0.5 * (a + b) + 0.5 * (b - a) * x));
            0.5 * (b - a) * panel.sum::<f64>()
        })
        .sum()
}

#[test]
fn inverse_undoes_the_curve_to_the_last_bits() {
    for case in every_family() {
        let curve = &case.density;
        for slip in slips(case.range) {
            let force = curve.force(slip);
            if force >= curve.full_slip_force() * (1.0 - 1e-15) {
                assert!(curve.displacement(curve.full_slip_force()).is_infinite());
                continue;
            }
            let back = curve.displacement(force);
            // Rounding of the force by a few units, carried through the compliance.
            let rounding = 8.0 * f64::EPSILON * (slip + force / curve.stiffness(slip));
            // Near a smooth full slip the compliance itself changes within the rounding.
            let near_full = force > 0.999 * curve.full_slip_force();
            let allowed = if near_full { 1e-7 * slip } else { rounding };
            let error = (back - slip).abs();
            assert!(
                error <= allowed,
                "{}: {slip:e} came back as {back:e}",
                case.label
            );
            let again = (curve.force(back) - force).abs();
            assert!(
                again <= 8.0 * f64::EPSILON * force,
                "{}: G(H(F)) at {force}",
                case.label
            );
        }
    }
}

#[test]
fn stiffness_is_the_derivative_of_force() {
    for case in parametric() {
        let curve = &case.density;
        for slip in slips(case.range) {
            let rise = integral(|u| curve.stiffness(u), slip, 4000);
            let error = (rise / curve.force(slip) - 1.0).abs();
            // A jump of G' inside one panel costs up to its share of the panel.
            assert!(error < 1e-3, "{} at {slip:e}: {error:e}", case.label);
        }
        // Where no corner is in the way the two agree to the accuracy of the quadrature.
        let smooth = 0.09 * case.range;
        let rise = integral(|u| curve.stiffness(u), smooth, 400);
        assert!(
            (rise / curve.force(smooth) - 1.0).abs() < 1e-10,
            "{}",
            case.label
        );
        let tangent = curve.compliance(curve.force(smooth)) * curve.stiffness(smooth);
        assert!((tangent - 1.0).abs() < 1e-12, "{}: H' is 1/G'", case.label);
        assert!((curve.stiffness(0.0) / curve.initial_stiffness() - 1.0).abs() < 1e-15);
    }
}

/// `d(u) = ∫ [G − v G'] dv = 2 ∫ G dv − u G(u)`.
#[test]
fn leg_dissipation_is_work_less_stored_energy() {
    for case in every_family() {
        let curve = &case.density;
        for share in [0.02, 0.3, 0.95, 1.4] {
            let slip = share * case.range;
            let lost = curve.leg_dissipation(slip);
            let sliding = integral(|u| curve.slipped_force(u), slip, 20_000);
            let work = integral(|u| curve.force(u), slip, 20_000);
            let difference = 2.0 * work - slip * curve.force(slip);
            // Corners inside a panel; the difference of two large numbers on top in the second.
            let scale = 2e-4 * lost;
            assert!(
                (sliding - lost).abs() < scale,
                "{} {sliding:e} {lost:e}",
                case.label
            );
            assert!(
                (difference - lost).abs() < scale + 1e-7 * work,
                "{} {difference:e} {lost:e}",
                case.label
            );
        }
    }
}

#[test]
fn seed_formula_of_the_leg() {
    let (r, chi, k, stiffness) = (3.0, -0.4, 2.5, 1000.0);
    let density = PowerLaw::new(r, chi, k, f64::INFINITY, stiffness).unwrap();
    let density = Density::PowerLaw(density);
    for slip in [1e-6_f64, 1e-3, 0.1] {
        let formula = r * k.powf(chi + 2.0) * slip.powf(chi + 3.0) / ((chi + 2.0) * (chi + 3.0));
        assert!((density.leg_dissipation(slip) / formula - 1.0).abs() < 1e-14);
        let work = integral(|u| density.slipped_force(u), slip, 400);
        assert!((work / formula - 1.0).abs() < 1e-11, "{work:e} {formula:e}");
        let curve = stiffness * slip - r * (k * slip).powf(chi + 2.0) / ((chi + 1.0) * (chi + 2.0));
        assert!((density.force(slip) / curve - 1.0).abs() < 1e-14);
    }
}

/// Eq. 31 with its minus sign: `−G''(u) = k² ρ(ku)`.
#[test]
fn curvature_is_the_density_with_a_minus_sign() {
    let (r, chi, k) = (3.0, -0.4, 2.5_f64);
    let density = Density::PowerLaw(PowerLaw::new(r, chi, k, f64::INFINITY, 1000.0).unwrap());
    for slip in [0.01_f64, 0.1, 1.0] {
        let step = 1e-3 * slip;
        let curvature =
            (density.stiffness(slip + step) - density.stiffness(slip - step)) / (2.0 * step);
        let expected = -k * k * r * (k * slip).powf(chi);
        assert!(
            (curvature / expected - 1.0).abs() < 1e-5,
            "{curvature} {expected}"
        );
    }
}

/// Segalman 2005: the parameters mean what their names say, by moments of the density itself.
#[test]
fn four_parameters_from_their_density() {
    let (slip_force, stiffness, chi, ratio) = (400.0, 1e7, -0.6, 2.0);
    let four = FourParameter::new(slip_force, stiffness, chi, ratio).unwrap();
    let (r, last) = (four.coefficient(), four.largest_slip());
    let population_stiffness = r * last.powf(chi + 1.0) / (chi + 1.0);
    let population_force = r * last.powf(chi + 2.0) / (chi + 2.0);
    let delta = ratio * population_stiffness;
    assert!(((population_stiffness + delta) / stiffness - 1.0).abs() < 1e-14);
    assert!(((population_force + delta * last) / slip_force - 1.0).abs() < 1e-14);
    let curve = Density::FourParameter(four);
    assert_eq!(curve.full_slip_force(), slip_force);
    assert_eq!(curve.stiffness(last), 0.0);
    let before = curve.stiffness(last * (1.0 - 1e-12));
    assert!(
        (before / delta - 1.0).abs() < 1e-9,
        "G' falls by the delta's stiffness"
    );
    assert!((curve.force(last * (1.0 - 1e-12)) / slip_force - 1.0).abs() < 1e-11);
    let sliding = curve.leg_dissipation(3.0 * last) - curve.leg_dissipation(2.0 * last);
    assert!(
        (sliding / (slip_force * last) - 1.0).abs() < 1e-13,
        "full slip loses F_S per metre"
    );
}

/// A table that samples a power law of χ = 1 (linear, so exactly) is that power law.
#[test]
fn table_of_a_linear_density_is_the_power_law() {
    let (r, k, stiffness) = (2.0, 0.5, 1000.0);
    let places: Vec<f64> = [0.3, 0.7, 1.1, 2.0, 4.0].to_vec();
    let density = places.iter().map(|phi| r * phi).collect();
    let table = PowerLawTable::new(r, 1.0, k, stiffness, places, density).unwrap();
    let law = Density::PowerLaw(PowerLaw::new(r, 1.0, k, 4.0, stiffness).unwrap());
    let remaining = stiffness - k * r * 4.0_f64.powi(2) / 2.0;
    assert!((table.remaining_stiffness() / remaining - 1.0).abs() < 1e-14);
    for i in 1..300 {
        let slip = 0.04 * i as f64;
        let pairs = [
            (table.force(slip), law.force(slip)),
            (table.stiffness(slip), law.stiffness(slip)),
            (table.leg_dissipation(slip), law.leg_dissipation(slip)),
            (table.slipped_force(slip), law.slipped_force(slip)),
            (table.displacement(law.force(slip)), slip),
        ];
        for (found, expected) in pairs {
            assert!(
                (found / expected - 1.0).abs() < 1e-12,
                "{slip}: {found} {expected}"
            );
        }
    }
}

/// Step 5 of the report: a K_T equal to the table's own sum leaves full slip and no remainder.
#[test]
fn table_that_uses_up_the_stiffness_slips_as_a_whole() {
    let places = vec![1.0, 3.0];
    // k = 1: Λ_0 = R φ̄ + trapezium = 2 + 4, Λ_1 = 1 + 8.
    let table = PowerLawTable::new(2.0, 0.0, 1.0, 6.0, places, vec![2.0, 2.0]).unwrap();
    assert_eq!(table.remaining_stiffness(), 0.0);
    assert!((table.full_slip_force() - 9.0).abs() < 1e-14);
    assert_eq!(table.force(7.0), table.full_slip_force());
    assert!(table.displacement(9.0).is_infinite());
}

/// A corner belongs to the side beyond it; sliders are taken in any order.
#[test]
fn sliders_by_hand() {
    let sliders = Sliders::new(vec![1.0, 2.0, 4.0], vec![3.0, 1.0, 2.0], 0.5).unwrap();
    assert_eq!(sliders.slip_at, [1.0, 2.0, 3.0]);
    assert_eq!(sliders.weight, [2.0, 4.0, 1.0]);
    assert_eq!(
        sliders.force(2.5),
        2.0 * 1.0 + 4.0 * 2.0 + 1.0 * 2.5 + 0.5 * 2.5
    );
    assert_eq!(sliders.stiffness(2.0), 1.5);
    assert_eq!(sliders.leg_dissipation(2.5), 2.0 * 1.5 + 4.0 * 2.0 * 0.5);
    assert_eq!(sliders.displacement(sliders.force(2.5)), 2.5);
    assert_eq!(sliders.full_slip_force(), f64::INFINITY);
}

/// `U = u + F/K_1` (Eq. 52) in both directions.
#[test]
fn curve_behind_a_spring() {
    for case in every_family() {
        let series_stiffness = 0.3 * case.density.initial_stiffness();
        let joint = BehindSpring {
            network: case.density,
            series_stiffness,
        };
        for slip in slips(case.range) {
            let force = joint.network.force(slip);
            let total = slip + force / series_stiffness;
            let (found, label) = (joint.slip(total), case.label);
            assert!(
                (found / slip - 1.0).abs() < 1e-13,
                "{label}: {found:e} for {slip:e}"
            );
            assert!((joint.force(total) / force - 1.0).abs() < 1e-13, "{label}");
            let lost = joint.leg_dissipation(total);
            let of_network = joint.network.leg_dissipation(slip);
            assert!((lost - of_network).abs() <= 1e-12 * of_network, "{label}");
        }
    }
}
