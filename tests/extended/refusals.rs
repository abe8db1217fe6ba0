//! What is refused, and that a refusal changes nothing.

use iwan::joint::{Density, Drive, Joint, JointError, Simulation, Sliders};

use super::effects::Dashpot;
use super::{acting, all_effects, joint, sliders, whisper_in_series};

#[test]
fn refused_input_leaves_the_state_as_it_was() {
    for effects in [vec![], all_effects(), vec![whisper_in_series()]] {
        let joint = joint(sliders(0.0), 3.0, effects);
        let mut simulation = Simulation::new(&joint, Drive::Force).unwrap();
        simulation.step(1.0, 0.5).unwrap();
        let before = simulation.state();
        assert!(matches!(
            simulation.step(2.0, f64::NAN),
            Err(JointError::NotFinite { .. })
        ));
        assert!(matches!(
            simulation.step(f64::NAN, 0.0),
            Err(JointError::NotFinite { .. })
        ));
        let back = simulation.step(0.5, 0.1);
        assert_eq!(back, Err(JointError::TimeRunsBack { from: 1.0, to: 0.5 }));
        if !joint.effects.iter().any(|a| a.effect.name() == "stop") {
            let beyond = simulation.step(2.0, 1e3);
            assert!(
                matches!(beyond, Err(JointError::BeyondFullSlip { .. })),
                "{beyond:?}"
            );
        }
        assert_eq!(simulation.state(), before);
        // Repeating time and input is no step.
        let output = simulation.output();
        assert_eq!(simulation.step(1.0, 0.5), Ok(output));
        assert_eq!(simulation.state(), before);
    }
}

#[test]
fn a_state_of_another_joint_is_refused() {
    let effects = all_effects();
    let one = joint(sliders(0.4), 3.0, effects.clone());
    let other = joint(sliders(0.5), 3.0, effects);
    let state = Simulation::new(&one, Drive::Force).unwrap().state();
    for (joint, drive) in [(&other, Drive::Force), (&one, Drive::Displacement)] {
        let restored = Simulation::new(joint, drive).unwrap().restore(&state);
        assert!(
            matches!(restored, Err(JointError::ForeignState { .. })),
            "{restored:?}"
        );
    }
    let mut same = Simulation::new(&one, Drive::Force).unwrap();
    let short = same.restore(&state[..state.len() - 1]);
    assert!(
        matches!(short, Err(JointError::ForeignState { .. })),
        "{short:?}"
    );
    let empty = same.restore(&[]);
    assert!(
        matches!(empty, Err(JointError::ForeignState { .. })),
        "{empty:?}"
    );
    assert_eq!(same.restore(&state), Ok(()));
}

#[test]
fn parameters_outside_the_glossary_are_refused() {
    let count = Joint::new(sliders(0.0), 3.0, vec![acting(&Dashpot, &[1.0, 2.0])]);
    assert!(
        matches!(
            count,
            Err(JointError::WrongCount {
                found: 2,
                expected: 1,
                ..
            })
        ),
        "{count:?}"
    );
    let range = Joint::new(sliders(0.0), 3.0, vec![acting(&Dashpot, &[-1.0])]);
    assert!(
        matches!(&range, Err(JointError::OutOfRange { name, .. }) if name == "dashpot.damping"),
        "{range:?}"
    );
    for stiffness in [0.0, -1.0, f64::NAN] {
        let spring = Joint::new(sliders(0.0), stiffness, vec![]);
        assert!(
            matches!(spring, Err(JointError::OutOfRange { .. })),
            "{spring:?}"
        );
    }
    let limp = Joint::new(Density::Sliders(Sliders::default()), 3.0, vec![]);
    assert!(
        matches!(limp, Err(JointError::OutOfRange { .. })),
        "{limp:?}"
    );
}
