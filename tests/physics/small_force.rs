//! Small-force laws: loss per cycle, residual slip, and the errata of the formulas concerned.

use iwan::joint::{Density, ExactResponse, FourParameter, PowerLaw, SmallForce, VirginCurve};

/// K_T = k = R = 1: slipped share of the stiffness at force F is F^(χ+1)/(χ+1), to leading order.
fn unit_law(chi: f64) -> PowerLaw {
    PowerLaw::new(1.0, chi, 1.0, f64::INFINITY, 1.0).unwrap()
}

fn force_of_share(chi: f64, share: f64) -> f64 {
    (share * (chi + 1.0)).powf(1.0 / (chi + 1.0))
}

#[test]
fn loss_per_cycle_tends_to_the_power_law() {
    for chi in [-0.6, -0.3, 0.0, 0.5] {
        let small = unit_law(chi).small_force();
        let error = |share: f64| {
            let force = force_of_share(chi, share);
            let mut response = ExactResponse::new(Density::PowerLaw(unit_law(chi)));
            response.drive_force(force).unwrap();
            let before = response.dissipation();
            response.drive_force(-force).unwrap();
            response.drive_force(force).unwrap();
            (response.dissipation() - before) / small.dissipation(force) - 1.0
        };
        // The remainder is of first order in the slipped share.
        let (coarse, fine) = (error(1e-3), error(1e-5));
        assert!(coarse > 0.0 && coarse < 5e-3, "chi {chi}: {coarse:e}");
        assert!(
            (coarse / fine / 100.0 - 1.0).abs() < 0.02,
            "chi {chi}: {coarse:e} {fine:e}"
        );
    }
}

/// Eq. 51 gives the same ϑ in the four-parameter family's own terms.
#[test]
fn four_parameter_family_has_the_same_law() {
    let four = FourParameter::new(400.0, 1e7, -0.6, 2.0).unwrap();
    let small = four.small_force();
    let density = Density::FourParameter(four);
    let force = 1e-10;
    let exact = 4.0 * density.leg_dissipation(density.displacement(force));
    assert!((small.dissipation(force) / exact - 1.0).abs() < 1e-4);
    assert_eq!(small.exponent, -0.6);
}

/// u_R, the slip left after the first loading: exact by memory, general formula, and (3/8) ϑ F² for
/// χ = 0 (Eq. 49 = A7 mended).
#[test]
fn residual_slip_follows_from_loss() {
    for chi in [-0.6, -0.3, 0.0, 0.5] {
        let law = unit_law(chi);
        let small = law.small_force();
        let density = Density::PowerLaw(law);
        for (share, tolerance) in [(1e-3, 1e-2), (1e-5, 1e-4)] {
            let force = force_of_share(chi, share);
            let mut response = ExactResponse::new(density.clone());
            response.drive_force(force).unwrap();
            let top = response.slip();
            response.drive_force(0.0).unwrap();
            let left = response.slip();
            assert!((left - density.residual_slip(force)).abs() < 1e-15 * top);
            let ratio = small.residual_slip(force) / left;
            assert!((ratio - 1.0).abs() < tolerance, "chi {chi}: {ratio}");
            if chi == 0.0 {
                let eighths = 0.375 * small.coefficient * force * force;
                assert!((eighths / left - 1.0).abs() < tolerance);
            }
        }
    }
}

/// A4, mended: for χ = 0 the residual slip gives back the largest slip,
/// `u_1 = −u_R + √(4 ρ_0 K_T u_R + 2 (ρ_0 k u_R)²) / (ρ_0 k)`, at any force.
#[test]
fn largest_slip_from_residual_slip() {
    let (rho, k, stiffness) = (4.0_f64, 0.5, 1000.0);
    let law = PowerLaw::new(rho, 0.0, k, f64::INFINITY, stiffness).unwrap();
    let density = Density::PowerLaw(law);
    let full = density.full_slip_force();
    for share in [0.01, 0.3, 0.9] {
        let mut response = ExactResponse::new(density.clone());
        response.drive_force(share * full).unwrap();
        let largest = response.slip();
        response.drive_force(0.0).unwrap();
        let left = response.slip();
        let root = (4.0 * rho * stiffness * left + 2.0 * (rho * k * left).powi(2)).sqrt();
        let found = -left + root / (rho * k);
        assert!((found / largest - 1.0).abs() < 1e-10, "{found} {largest}");
    }
}

/// Eq. 8 mended: a rod held by a friction of f = 2Nν per length slips over F/f of it, so its end
/// moves by `u = F²/(2 EA f)`; a loop loses `(2/3) F_0³/(EA f)`: no square, and the exponent 3 of
/// χ = 0.
#[test]
fn slipping_rod_is_the_case_of_exponent_zero() {
    let (modulus_area, friction) = (2.0e7, 5.0e4);
    let force = 300.0;
    // Slip beyond the elastic part, u = F²/(2 EA f): the compliance grows linearly in F, as
    // H(F) = F/K_T + ρ_0 k² F²/(2 K_T³) does for χ = 0 at small force.
    let compliance_slope = 1.0 / (modulus_area * friction);
    let stiffness = 1e9;
    let rho = compliance_slope * f64::powi(stiffness, 3);
    let small = SmallForce::of_density(rho, 0.0, 1.0, stiffness);
    let rod = 2.0 / 3.0 * force * force * force / (modulus_area * friction);
    assert!((small.dissipation(force) / rod - 1.0).abs() < 1e-12);
}
