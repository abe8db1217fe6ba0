//! Joints that soften or stiffen so far that an input has no answer: told, and nothing changed by it.

use iwan::causes;
use iwan::joint::{Acting, Density, Drive, FourParameter, Joint, JointError, Simulation, Sliders};

fn acting(name: &str, values: &[f64]) -> Acting {
    let effect = causes::find(name).unwrap().effect();
    let values = values.to_vec();
    assert_eq!(effect.parameters().len(), values.len(), "{name}");
    Acting { effect, values }
}

/// A slider of 500 N beside a spring of 5e7 N/m, behind one of 2e8 N/m.
fn one_slider(effects: Vec<Acting>) -> Joint {
    let sliders = Sliders::new(vec![5e7], vec![1e-5], 5e7).unwrap();
    Joint::new(Density::Sliders(sliders), 2e8, effects).unwrap()
}

/// Full slip at 1000 N.
fn four_parameter(effects: Vec<Acting>) -> Joint {
    let density = FourParameter::new(1000.0, 1e8, -0.4, 0.5).unwrap();
    Joint::new(Density::FourParameter(density), 2e8, effects).unwrap()
}

fn across(stiffness: f64) -> Vec<Acting> {
    vec![acting(
        "cubic_stiffness",
        &[0.0, 0.0, stiffness, 0.0, 0.0, 0.0],
    )]
}

/// Largest force of `one_slider(across(-1e15))`, where the slider slips: (500 + 5e7 u) − 1e15 U³ with
/// U = u + (500 + 5e7 u)/2e8 has its peak at 5e7 = 3e15·1.25 U².
fn peak() -> f64 {
    let displacement = (5e7_f64 / 3.75e15).sqrt();
    let slip = (displacement - 500.0 / 2e8) / 1.25;
    500.0 + 5e7 * slip - 1e15 * displacement.powi(3)
}

/// Largest force of the same cube across the contact, which K_1 then only passes on: (500 + 5e7 u) − 1e15 u³ has its
/// peak at 5e7 = 3e15 u².
fn peak_of_contact() -> f64 {
    let slip = (5e7_f64 / 3e15).sqrt();
    500.0 + 5e7 * slip - 1e15 * slip.powi(3)
}

#[test]
fn a_force_beyond_the_peak_is_refused_and_changes_nothing() {
    assert!((peak() - 3479.2).abs() < 0.1, "{}", peak());
    refuses_beyond(peak(), &[0.0, 0.0, -1e15, 0.0, 0.0, 0.0]);
    assert!(
        (peak_of_contact() - 4803.3).abs() < 0.1,
        "{}",
        peak_of_contact()
    );
    refuses_beyond(peak_of_contact(), &[0.0, 0.0, 0.0, 0.0, -1e15, 0.0]);
}

fn refuses_beyond(peak: f64, cube: &[f64]) {
    let joint = one_slider(vec![acting("cubic_stiffness", cube)]);
    for side in [1.0, -1.0] {
        let mut simulation = Simulation::new(&joint, Drive::Force).unwrap();
        for share in [0.3, 0.6, 0.9, 0.999] {
            simulation.step(share, side * share * peak).unwrap();
        }
        let before = simulation.state();
        for force in [1.001, 1.14, 1.42, 2.85, 300.0].map(|share| share * peak) {
            let refused = simulation.step(2.0, side * force);
            assert!(
                matches!(refused, Err(JointError::NoEquilibrium { force: asked, most, cause: Some("cubic_stiffness"), .. })
                    if asked == side * force && (most - side * peak).abs() < 1e-9 * peak),
                "{refused:?}"
            );
            assert_eq!(simulation.state(), before);
        }
        assert!(simulation.step(2.0, 0.5 * side * peak).is_ok());
    }
}

/// Of laws that fall at once and for ever: 1e57 m and no number at all had been answered.
#[test]
fn a_force_that_runs_away_has_no_answer() {
    let runs_away = [1.78e-15, -1e-8, -9e17, -2e8, 0.0, 0.0];
    let joint = four_parameter(vec![acting("cubic_stiffness", &runs_away)]);
    let mut simulation = Simulation::new(&joint, Drive::Force).unwrap();
    for (second, force) in [100.0, 200.0, 300.0, 400.0, 10.0, 0.0]
        .into_iter()
        .enumerate()
    {
        match simulation.step(second as f64, force) {
            Ok(output) => {
                assert!(output.displacement.abs() < 1e-4, "{output:?}");
                assert!(output.tangent_stiffness > 0.0, "{output:?}");
            }
            Err(reason) => assert!(
                matches!(reason, JointError::NoEquilibrium { most, .. } if most < force),
                "{reason:?}"
            ),
        }
    }
    assert_eq!(simulation.output().time, 5.0);
}

#[test]
fn every_row_that_is_answered_is_in_equilibrium() {
    for stiffness in [-1e15, -3e15, -1e17] {
        for steps in [1, 7, 60] {
            let joint = one_slider(across(stiffness));
            let mut simulation = Simulation::new(&joint, Drive::Force).unwrap();
            for step in 1..=steps {
                let force = 5000.0 * f64::from(step) / f64::from(steps);
                let Ok(output) = simulation.step(f64::from(step), force) else {
                    break;
                };
                let inner = output.force - stiffness * output.displacement.powi(3);
                let carried = 2e8 * (output.displacement - output.slip_displacement);
                assert!((inner - carried).abs() < 1e-9 * force, "{output:?}");
                let slider = 5e7 * output.slip_displacement.min(1e-5);
                let network = slider + 5e7 * output.slip_displacement;
                assert!((network - carried).abs() < 1e-9 * force, "{output:?}");
            }
        }
    }
}

/// Full slip is blamed where it is reached, and not for what softens the joint below it.
#[test]
fn a_refusal_names_its_own_reason() {
    let mut simulation = Simulation::new(&four_parameter(across(-1e17)), Drive::Force).unwrap();
    simulation.step(0.0, 300.0).unwrap();
    let message = simulation.step(1.0, 500.0).unwrap_err().to_string();
    assert!(
        message.contains("`cubic_stiffness` lets the joint carry about 46"),
        "{message}"
    );
    assert!(message.contains("drive it in displacement"), "{message}");
    assert!(
        message.len() < 200 && !message.contains("slip"),
        "{message}"
    );

    let dashpot = vec![acting("asymmetric_friction", &[0.2])];
    let mut simulation = Simulation::new(&four_parameter(dashpot), Drive::Force).unwrap();
    let beyond = simulation.step(0.0, 1300.0);
    assert!(
        matches!(beyond, Err(JointError::BeyondFullSlip { .. })),
        "{beyond:?}"
    );
}

#[test]
fn driven_in_displacement_a_softening_joint_goes_past_its_peak() {
    let joint = one_slider(across(-1e15));
    let mut simulation = Simulation::new(&joint, Drive::Displacement).unwrap();
    let mut last = f64::INFINITY;
    for step in 1..=20 {
        let output = simulation
            .step(f64::from(step), 1e-5 * f64::from(step))
            .unwrap();
        last = output.tangent_stiffness;
    }
    assert!(last < 0.0, "{last}");
}

/// A cube that hardens uses up the compliance of joint and spring: beyond, U falls as F rises.
#[test]
fn a_spring_law_past_its_fold_is_refused_in_either_drive() {
    let joint = one_slider(vec![acting(
        "cubic_stiffness",
        &[-1e-16, 0.0, 0.0, 0.0, 0.0, 0.0],
    )]);
    // 3e-16 F² is then 1/5e7 + 1/2e8.
    let fold = (2.5e-8_f64 / 3e-16).sqrt();
    let mut by_force = Simulation::new(&joint, Drive::Force).unwrap();
    let mut by_displacement = Simulation::new(&joint, Drive::Displacement).unwrap();
    let mut reached = 0.0;
    for share in [0.3, 0.6, 0.9, 0.99] {
        let output = by_force.step(share, share * fold).unwrap();
        assert!(output.tangent_stiffness > 0.0, "{output:?}");
        reached = output.displacement;
        let output = by_displacement.step(share, reached).unwrap();
        assert!(
            (output.force - share * fold).abs() < 1e-6 * fold,
            "{output:?}"
        );
    }
    for (simulation, beyond) in [
        (&mut by_force, 1.01 * fold),
        (&mut by_displacement, 1.01 * reached),
    ] {
        let before = simulation.state();
        let refused = simulation.step(2.0, beyond);
        assert!(
            matches!(
                refused,
                Err(JointError::TurnsBack {
                    cause: Some("cubic_stiffness"),
                    ..
                })
            ),
            "{refused:?}"
        );
        assert_eq!(simulation.state(), before);
    }
}

/// Parts that open at rest and lose more compliance than there is.
#[test]
fn a_negative_opening_compliance_is_refused_where_it_outweighs_the_joint() {
    let joint = one_slider(vec![acting(
        "joint_opening",
        &[-3e-8, 1000.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    )]);
    for (drive, good, beyond) in [
        (Drive::Force, 900.0, 1500.0),
        (Drive::Displacement, 1e-5, 4e-5),
    ] {
        let mut simulation = Simulation::new(&joint, drive).unwrap();
        simulation.step(0.0, good).unwrap();
        let refused = simulation.step(1.0, beyond);
        assert!(
            matches!(
                refused,
                Err(JointError::TurnsBack {
                    cause: Some("joint_opening"),
                    ..
                })
            ),
            "{refused:?}"
        );
    }
}

#[test]
fn an_input_beyond_all_numbers_is_refused_with_causes_too() {
    for (drive, inputs) in [
        (Drive::Force, [1e101, -1e300]),
        (Drive::Displacement, [1e101, -1e300]),
    ] {
        for effects in [across(1e15), vec![acting("asymmetric_friction", &[0.2])]] {
            let mut simulation = Simulation::new(&one_slider(effects), drive).unwrap();
            let before = simulation.state();
            for input in inputs {
                let refused = simulation.step(1.0, input);
                assert!(
                    matches!(refused, Err(JointError::OutOfReach { .. })),
                    "{refused:?}"
                );
                assert_eq!(simulation.state(), before);
            }
        }
    }
}
