//! Single effects against what can be written down.

use iwan::causes::find;
use iwan::joint::{Density, Drive, JointError, Sliders};

use super::effects::{Dashpot, Kelvin, Play, SEAT, Sided, Stop, Wear};
use super::{acting, joint, sliders, times, whisper_in_series};

#[test]
fn a_dashpot_adds_its_rate_and_its_loss() {
    let elastic = Density::Sliders(Sliders::new(vec![], vec![], 4.0).unwrap());
    let joint = joint(elastic, f64::INFINITY, vec![acting(&Dashpot, &[0.5])]);
    let time = [0.0, 0.1, 0.3, 0.3, 0.4];
    let path = [0.2, 0.4, 0.1, -0.1, -0.1];
    let answers = joint.simulate(Drive::Displacement, &time, &path).unwrap();
    // Where no time passes the rate stays, and its force does work on the way.
    let rates = [0.0, 2.0, -1.5, -1.5, 0.0];
    let mut lost = 0.0;
    for i in 0..time.len() {
        assert!((answers[i].force - (4.0 * path[i] + 0.5 * rates[i])).abs() < 1e-14);
        lost += if i > 0 {
            0.5 * rates[i] * (path[i] - path[i - 1])
        } else {
            0.0
        };
        assert!(
            (answers[i].dissipation - lost).abs() < 1e-14,
            "{:?} {lost}",
            answers[i]
        );
        assert!((answers[i].stored_energy - 2.0 * path[i] * path[i]).abs() < 1e-14);
    }
    assert!((answers[1].dissipation_rate - 0.5 * 4.0).abs() < 1e-13);
    assert_eq!(answers[3].dissipation_rate, 0.0);
}

/// Behind K_1 a film between the surfaces answers the rate of the slip alone, in either drive.
#[test]
fn a_film_adds_the_rate_of_the_slip_and_its_loss() {
    let elastic = Density::Sliders(Sliders::new(vec![], vec![], 4.0).unwrap());
    let film = find("viscous_damping").unwrap().effect();
    let joint = joint(elastic, 2.0, vec![acting(film, &[0.0, 0.5])]);
    let time = [0.0, 0.1, 0.3, 0.3, 0.4];
    let slip = [0.0, 0.4, 0.1, -0.1, -0.1];
    let rates = [0.0, 4.0, -1.5, -1.5, 0.0];
    let force: Vec<f64> = (0..5).map(|i| 4.0 * slip[i] + 0.5 * rates[i]).collect();
    let way: Vec<f64> = (0..5).map(|i| slip[i] + force[i] / 2.0).collect();
    for (drive, input) in [(Drive::Force, &force), (Drive::Displacement, &way)] {
        let answers = joint.simulate(drive, &time, input).unwrap();
        let mut lost = 0.0;
        for i in 0..5 {
            let answer = &answers[i];
            let off = [
                answer.force - force[i],
                answer.displacement - way[i],
                answer.slip_displacement - slip[i],
            ];
            assert!(off.iter().all(|d| d.abs() < 1e-14), "{drive:?} {answer:?}");
            lost += match i {
                0 => 0.0,
                _ => 0.5 * rates[i] * (slip[i] - slip[i - 1]),
            };
            let kept = 2.0 * slip[i] * slip[i] + 0.25 * force[i] * force[i];
            let both = [answer.dissipation - lost, answer.stored_energy - kept];
            assert!(
                both.iter().all(|d| d.abs() < 1e-14),
                "{drive:?} {answer:?} {lost} {kept}"
            );
        }
    }
}

#[test]
fn clearance_adds_half_its_gap_on_either_side() {
    let gap = 0.3;
    let with = joint(sliders(0.0), 3.0, vec![acting(&Play, &[gap])]);
    let without = joint(sliders(0.0), 3.0, vec![]);
    let force: Vec<f64> = (1..400).map(|i| 1.6 * (0.1 * f64::from(i)).sin()).collect();
    let time = times(force.len());
    let a = with.simulate(Drive::Force, &time, &force).unwrap();
    let b = without.simulate(Drive::Force, &time, &force).unwrap();
    for (a, b) in a.iter().zip(&b) {
        let shift = (0.5 * gap).copysign(b.force);
        assert!(
            (a.displacement - b.displacement - shift).abs() < 1e-12,
            "{a:?} {b:?}"
        );
        assert!((a.dissipation - b.dissipation).abs() < 1e-12);
        // What the seat takes up is at most its force over half the gap.
        assert!((a.stored_energy - b.stored_energy).abs() <= SEAT * gap);
    }
}

#[test]
fn slip_limits_set_the_two_plateaus() {
    let effects = vec![acting(&Sided, &[1.5, 0.5])];
    let joint = joint(sliders(0.0), f64::INFINITY, effects);
    let full = joint.full_slip_force();
    let path = [3.0, -3.0, 3.0];
    let answers = joint
        .simulate(Drive::Displacement, &times(3), &path)
        .unwrap();
    for (answer, factor) in answers.iter().zip([1.5, -0.5, 1.5]) {
        assert!((answer.force - factor * full).abs() < 1e-12, "{answer:?}");
        assert_eq!(answer.tangent_stiffness, 0.0);
    }
}

#[test]
fn wear_lowers_the_plateau_by_what_was_dissipated() {
    let rate = 0.05;
    let joint = joint(sliders(0.0), f64::INFINITY, vec![acting(&Wear, &[rate])]);
    let path: Vec<f64> = (0..40)
        .map(|i| if i % 2 == 0 { 3.0 } else { -3.0 })
        .collect();
    let answers = joint
        .simulate(Drive::Displacement, &times(40), &path)
        .unwrap();
    for i in 1..answers.len() {
        let left = 0.5 + 0.5 * (-rate * answers[i - 1].dissipation).exp();
        let expected = (left * joint.full_slip_force()).copysign(path[i]);
        assert!(
            (answers[i].force - expected).abs() < 1e-12,
            "{i} {:?} {expected}",
            answers[i]
        );
    }
}

#[test]
fn creep_under_constant_force_loses_what_it_keeps() {
    let elastic = Density::Sliders(Sliders::new(vec![], vec![], 4.0).unwrap());
    let joint = joint(elastic, f64::INFINITY, vec![acting(&Kelvin, &[0.2])]);
    let time: Vec<f64> = (0..400).map(|i| 0.1 * f64::from(i)).collect();
    let answers = joint.simulate(Drive::Force, &time, &[2.0; 400]).unwrap();
    let last = answers[399];
    // u = F/K, s = C F; C F²/2 is stored and as much is lost, besides F²/(2K) in the spring.
    assert!((last.displacement - (0.5 + 0.4)).abs() < 1e-12, "{last:?}");
    assert!((last.dissipation - 0.4).abs() < 1e-12, "{last:?}");
    assert!((last.stored_energy - (0.4 + 0.5)).abs() < 1e-12, "{last:?}");
}

#[test]
fn a_stop_carries_what_the_network_cannot() {
    let bare = joint(sliders(0.0), 3.0, vec![whisper_in_series()]);
    let full = bare.full_slip_force();
    let error = bare.simulate(Drive::Force, &[0.5, 1.0], &[0.1, 1.1 * full]);
    let beyond = JointError::BeyondFullSlip {
        force: 1.1 * full,
        full_slip: full,
    };
    assert!(
        matches!(&error, Err(JointError::AtSample { time, sample: 1, reason })
            if *time == 1.0 && matches!((&**reason, &beyond),
                (JointError::BeyondFullSlip { force: a, full_slip: b },
                 JointError::BeyondFullSlip { force: c, full_slip: d })
                 if a == c && (b - d).abs() < 1e-12)),
        "{error:?}"
    );
    let stopped = joint(sliders(0.0), 3.0, vec![acting(&Stop, &[50.0, 2.0])]);
    let answer = stopped
        .simulate(Drive::Force, &[0.0], &[1.1 * full])
        .unwrap()[0];
    let depth = answer.slip_displacement - 2.0;
    assert!(
        (50.0 * depth * (1.0 + depth * depth) - 0.1 * full).abs() < 1e-12,
        "{answer:?}"
    );
}
