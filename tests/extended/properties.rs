//! What must hold for any history and any set of effects.

use iwan::joint::{Acting, Density, Drive, FourParameter, Output, Simulation};
use proptest::prelude::*;

use super::effects::{Dashpot, Opening, Play, SEAT, Sided, Stop, Wear};
use super::{acting, all_effects, assert_close, joint, sliders, times, whisper};

fn histories() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.5_f64..1.5, 2..120)
}

/// Some of the effects, by the bits of a number.
fn effects() -> impl Strategy<Value = Vec<Acting>> {
    (1_usize..128).prop_map(|bits| {
        let all = all_effects().into_iter().enumerate();
        all.filter(|(i, _)| bits >> i & 1 == 1)
            .map(|(_, acting)| acting)
            .collect()
    })
}

proptest! {
    #[test]
    fn equals_the_exact_response_where_nothing_acts(
        history in histories(), rigid in any::<bool>(), remainder in prop_oneof![Just(0.0), Just(0.4)],
    ) {
        let spring = if rigid { f64::INFINITY } else { 3.0 };
        let exact = joint(sliders(remainder), spring, vec![]);
        let through_solver = joint(sliders(remainder), spring, vec![whisper()]);
        let time = times(history.len());
        for drive in [Drive::Force, Drive::Displacement] {
            let a = exact.simulate(drive, &time, &history).unwrap();
            let b = through_solver.simulate(drive, &time, &history).unwrap();
            assert_close(&a, &b, 1e-11);
        }
    }

    #[test]
    fn vanishing_values_give_the_baseline_to_the_last_bit(history in histories()) {
        let gone = vec![
            acting(&Dashpot, &[0.0]),
            acting(&Stop, &[0.0, 0.3]),
            acting(&Play, &[0.0]),
            acting(&Opening, &[0.0]),
            acting(&Sided, &[1.0, 1.0]),
            acting(&Wear, &[0.0]),
        ];
        let density = Density::FourParameter(FourParameter::new(5.0, 4.0, -0.3, 0.5).unwrap());
        let time = times(history.len());
        for drive in [Drive::Force, Drive::Displacement] {
            let baseline = joint(density.clone(), 3.0, vec![]);
            let extended = joint(density.clone(), 3.0, gone.clone());
            prop_assert_eq!(
                baseline.simulate(drive, &time, &history).unwrap(),
                extended.simulate(drive, &time, &history).unwrap()
            );
        }
    }

    #[test]
    fn displacement_drive_inverts_force_drive(history in histories(), effects in effects()) {
        let joint = joint(sliders(0.4), 3.0, effects);
        let time = times(history.len());
        let there = joint.simulate(Drive::Force, &time, &history).unwrap();
        let displacement: Vec<f64> = there.iter().map(|o| o.displacement).collect();
        let back = joint.simulate(Drive::Displacement, &time, &displacement).unwrap();
        // Rounding of the displacement over a step of 0.1 s is 1e-15 × 0.05/0.1 in the dashpot, and
        // 1e-15 × 2 SEAT/gap in the play: both below; errors of the history add up.
        assert_close(&there, &back, 1e-10);
    }

    #[test]
    fn stiff_and_soft_laws_are_solved_to_rounding(
        history in histories(), pin in -3.0_f64..7.0, spring in -2.0_f64..7.0, gap in -6.0_f64..0.0,
        opening in -6.0_f64..1.0, damping in -6.0_f64..4.0,
    ) {
        let effects = vec![
            acting(&Stop, &[10_f64.powf(pin), 0.3]),
            acting(&Play, &[10_f64.powf(gap)]),
            acting(&Opening, &[10_f64.powf(opening)]),
            acting(&Dashpot, &[10_f64.powf(damping)]),
        ];
        let joint = joint(sliders(0.0), 10_f64.powf(spring), effects);
        let time = times(history.len());
        let mut forced = Simulation::new(&joint, Drive::Force).unwrap();
        let mut driven = Simulation::new(&joint, Drive::Displacement).unwrap();
        for (time, force) in time.iter().zip(&history) {
            let force = 10.0 * force;
            let there = forced.step(*time, force).unwrap();
            let back = driven.step(*time, there.displacement).unwrap();
            // A displacement is known to rounding, which the dashpot and the tangent amplify.
            let digit = 1e-15 * (1.0 + there.displacement.abs() + there.slip_displacement.abs());
            let stiffness = there.tangent_stiffness + 10_f64.powf(damping) / 0.1 + 10.0;
            // Between its seats the play turns rounding of the force of the sliders, 2.5 at most, into displacement.
            let softness = 0.5 * 10_f64.powf(gap) / SEAT;
            let between = there.tangent_stiffness * softness < 1.001;
            let played = if between { 2.5 * f64::EPSILON * softness } else { 0.0 };
            let allowed = 1e-12 * 15.0 + (100.0 * digit + played) * stiffness;
            prop_assert!((back.force - force).abs() <= allowed, "{there:?}\n{back:?}");
        }
    }

    #[test]
    fn energy_is_never_returned(
        history in histories(), effects in effects(), forced in any::<bool>(),
    ) {
        let joint = joint(sliders(0.4), 3.0, effects);
        let drive = if forced { Drive::Force } else { Drive::Displacement };
        let mut simulation = Simulation::new(&joint, drive).unwrap();
        let (mut work, mut previous, mut time) = (0.0, Output::default(), 0.0);
        let (mut last, mut missed) = (0.0, 0.0);
        let gap = joint.effects.iter().find(|a| a.effect.name() == "play").map_or(0.0, |a| a.values[0]);
        for target in history {
            // Small steps, so that the trapezoidal work is near the true one.
            for share in 1..=50 {
                time += 0.02;
                let input = last + f64::from(share) / 50.0 * (target - last);
                let output = simulation.step(time, input).unwrap();
                work += 0.5 * (output.force + previous.force)
                    * (output.displacement - previous.displacement);
                prop_assert!(output.dissipation >= previous.dissipation);
                if output.force * previous.force <= 0.0 {
                    // The play goes from side to side at zero force, the trapezoid at the mean one.
                    missed += 0.5 * gap * (output.force + previous.force).abs();
                }
                previous = output;
            }
            last = target;
        }
        let balance = work - previous.dissipation - previous.stored_energy;
        prop_assert!(
            balance.abs() <= 0.02 * (previous.dissipation + previous.stored_energy) + missed + 1e-3,
            "work {work}, {previous:?}"
        );
    }

    #[test]
    fn restored_state_continues_to_the_last_bit(
        history in histories(), effects in effects(), forced in any::<bool>(), plain in any::<bool>(),
    ) {
        let joint = joint(sliders(0.4), 3.0, if plain { vec![] } else { effects });
        let drive = if forced { Drive::Force } else { Drive::Displacement };
        let mut straight = Simulation::new(&joint, drive).unwrap();
        let half = history.len() / 2;
        let time = times(history.len());
        for i in 0..half {
            straight.step(time[i], history[i]).unwrap();
        }
        let saved = straight.state();
        let mut restored = Simulation::new(&joint, drive).unwrap();
        restored.restore(&saved).unwrap();
        prop_assert_eq!(restored.output(), straight.output());
        for i in half..history.len() {
            let a = straight.step(time[i], history[i]).unwrap();
            let b = restored.step(time[i], history[i]).unwrap();
            prop_assert_eq!(a, b);
        }
        prop_assert_eq!(straight.state(), restored.state());
    }
}
