//! What the densities and the memory refuse, by name, leaving all as it was.

use super::families::every_family;
use super::histories::random_nested;
use iwan::joint::{
    Density, ExactResponse, FourParameter, JointError, PowerLaw, PowerLawTable, Sliders,
    VirginCurve,
};

fn refused(result: Result<impl std::fmt::Debug, JointError>) -> String {
    match result {
        Err(JointError::OutOfRange { name, .. }) => name,
        other => panic!("{other:?}"),
    }
}

#[test]
fn parameters_outside_their_glossary() {
    let power = |r, chi, k, limit, stiffness| refused(PowerLaw::new(r, chi, k, limit, stiffness));
    assert_eq!(power(-1.0, 0.0, 1.0, 1.0, 1.0), "coefficient");
    assert_eq!(power(1.0, -1.0, 1.0, 1.0, 1.0), "exponent");
    assert_eq!(power(1.0, 0.0, 0.0, 1.0, 1.0), "slider_stiffness");
    assert_eq!(power(1.0, 0.0, 1.0, f64::NAN, 1.0), "break_free_limit");
    assert_eq!(power(1.0, 0.0, 1.0, 1.0, f64::INFINITY), "stiffness");
    assert_eq!(
        refused(FourParameter::new(0.0, 1.0, 0.0, 1.0)),
        "slip_force"
    );
    assert_eq!(refused(FourParameter::new(1.0, 1.0, 0.0, -0.1)), "ratio");
    let table = |places: &[f64], density: &[f64], stiffness| {
        let (places, density) = (places.to_vec(), density.to_vec());
        refused(PowerLawTable::new(
            2.0, 0.0, 1.0, stiffness, places, density,
        ))
    };
    assert_eq!(table(&[1.0, 1.0], &[1.0, 1.0], 9.0), "break_free[1]");
    assert_eq!(table(&[1.0, 2.0], &[1.0], 9.0), "density count");
    assert_eq!(table(&[], &[], 9.0), "density count");
    assert_eq!(table(&[1.0, 2.0], &[1.0, -1.0], 9.0), "density[1]");
    assert_eq!(table(&[1.0, 3.0], &[2.0, 2.0], 5.9), "stiffness");
    assert_eq!(table(&[1.0, 3.0], &[2.0, 2.0], 1.0), "stiffness");
    let sliders =
        |w: &[f64], d: &[f64], elastic| refused(Sliders::new(w.into(), d.into(), elastic));
    assert_eq!(sliders(&[1.0, 0.0], &[1.0, 2.0], 0.0), "weight[1]");
    assert_eq!(sliders(&[1.0, 1.0], &[1.0, f64::NAN], 0.0), "slip_at[1]");
    assert_eq!(sliders(&[1.0], &[1.0], -1.0), "elastic");
    assert_eq!(sliders(&[1.0], &[1.0, 2.0], 0.0), "slip_at count");
}

#[test]
fn glossary_and_values_go_together() {
    for case in every_family() {
        let (density, label) = (&case.density, case.label);
        let (glossary, values) = (density.parameters(), density.values());
        assert_eq!(glossary.len(), values.len(), "{label}");
        for (parameter, value) in glossary.iter().zip(&values) {
            assert!(
                (parameter.lower..=parameter.upper).contains(value),
                "{label}"
            );
            let same_name = glossary.iter().filter(|other| other.name == parameter.name);
            assert_eq!(same_name.count(), 1, "{label}: {}", parameter.name);
        }
        match Density::from_values(density.family(), &values) {
            Ok(again) => assert_eq!(&again, density, "{label}"),
            Err(error) => {
                assert!(matches!(error, JointError::ForeignState { .. }), "{label}");
                assert!(
                    ["sliders", "power_law_table"].contains(&density.family()),
                    "{label}"
                );
            }
        }
    }
    assert!(Density::from_values("four_parameter", &[1.0]).is_err());
}

#[test]
fn force_at_full_slip_leaves_the_state() {
    for case in every_family() {
        let full = case.density.full_slip_force();
        let mut response = ExactResponse::new(case.density.clone());
        let top = case.density.force(case.range).min(0.99 * full);
        for value in [0.5, -0.3, 0.2] {
            response.drive_force(top * value).unwrap();
        }
        let before = response.clone();
        assert_eq!(refused(response.drive_force(f64::NAN)), "force");
        if full.is_finite() {
            for force in [full, -full, 2.0 * full] {
                let error = response.drive_force(force).unwrap_err();
                let expected = JointError::BeyondFullSlip {
                    force,
                    full_slip: full,
                };
                assert_eq!(error, expected, "{}", case.label);
            }
        } else {
            assert_eq!(refused(response.drive_force(f64::INFINITY)), "force");
        }
        response.drive_slip(f64::NAN);
        assert_eq!(response, before, "{}", case.label);
    }
}

#[test]
fn foreign_states_are_refused() {
    for case in every_family() {
        let top = case
            .density
            .force(case.range)
            .min(0.9 * case.density.full_slip_force());
        let mut response = ExactResponse::new(case.density.clone());
        for value in random_nested(70, 300) {
            response.drive_force(top * value).unwrap();
        }
        let before = response.clone();
        let good = response.state();
        let changed = |at: usize, value: f64| {
            let mut state = good.clone();
            state[at] = value;
            state
        };
        let wrong = [
            Vec::new(),
            good[..good.len() - 1].to_vec(),
            good[..6].to_vec(),
            changed(0, f64::NAN),
            changed(1, 2.0 * good[1] + 1e-5),
            changed(2, 0.5),
        ];
        for state in wrong {
            let error = response.restore(&state).unwrap_err();
            assert!(
                matches!(error, JointError::ForeignState { .. }),
                "{}",
                case.label
            );
            assert_eq!(response, before, "{}", case.label);
        }
        response.restore(&good).unwrap();
    }
}
