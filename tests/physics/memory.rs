//! Laws of the memory, over every family: Masing, return point, closure, repeated samples, no
//! ratcheting, work balance, saved state.

use super::families::every_family;
use super::histories::random_nested;
use iwan::joint::virgin::BehindSpring;
use iwan::joint::{Density, ExactResponse, VirginCurve};

/// A force that is well into slip for the case, and below full slip.
fn strong(density: &Density, range: f64) -> f64 {
    density.force(range).min(0.9 * density.full_slip_force())
}

/// From rest through the given forces.
fn driven(density: &Density, forces: &[f64]) -> ExactResponse<Density> {
    let mut response = ExactResponse::new(density.clone());
    for &force in forces {
        response.drive_force(force).unwrap();
    }
    response
}

/// Unloading and reloading are the virgin curve at twice its size; the loop closes on itself.
#[test]
fn branches_obey_masing() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let peak = case.density.displacement(top);
        for share in [0.9, 0.5, -0.2, -0.99] {
            let falling = driven(&case.density, &[top, share * top]);
            let rising = driven(&case.density, &[top, -top, -share * top]);
            let way = case.density.displacement(top * (1.0 - share) / 2.0);
            let expected = peak - 2.0 * way;
            assert!(
                (falling.slip() - expected).abs() < 1e-14 * peak,
                "{}",
                case.label
            );
            assert!(
                (rising.slip() + expected).abs() < 1e-14 * peak,
                "{}",
                case.label
            );
        }
        let round = driven(&case.density, &[top, -top, top]);
        assert!((round.slip() - peak).abs() < 1e-14 * peak);
        let loss = 4.0 * case.density.leg_dissipation(peak);
        let virgin = case.density.leg_dissipation(peak);
        assert!((round.dissipation() - virgin - loss).abs() < 1e-13 * (loss + virgin));
    }
}

/// The area of a loop, integrated along it, is what the formula says it has lost.
#[test]
fn loop_area_is_the_loss() {
    for case in every_family() {
        let amplitude = 0.7 * case.range;
        let mut response = ExactResponse::new(case.density.clone());
        response.drive_slip(amplitude);
        let before = response.dissipation();
        let steps = 20_000;
        let (mut area, mut last) = (0.0, (response.slip(), response.force()));
        for i in 1..=2 * steps {
            let turn = (i as f64 / steps as f64 - 1.0).abs();
            response.drive_slip(amplitude * (2.0 * turn - 1.0));
            area += 0.5 * (response.force() + last.1) * (response.slip() - last.0);
            last = (response.slip(), response.force());
        }
        let lost = response.dissipation() - before;
        // The trapezium's error on a curved branch, second order in the step.
        assert!(
            (area / lost - 1.0).abs() < 1e-5,
            "{}: {area:e} {lost:e}",
            case.label
        );
        let formula = 4.0 * case.density.leg_dissipation(amplitude);
        assert!((lost / formula - 1.0).abs() < 1e-12, "{}", case.label);
    }
}

/// A minor loop comes back to the point it left, and what follows does not know of it.
#[test]
fn minor_loops_return_and_are_forgotten() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let excursion = [top, -0.6 * top, 0.3 * top, -0.1 * top, 0.2 * top];
        let plain = driven(&case.density, &excursion[..3]);
        // The inner loops close when the force comes back to 0.3 and goes on.
        let mut looped = driven(&case.density, &excursion);
        let lost_before = looped.dissipation();
        looped.drive_force(0.3 * top).unwrap();
        assert_eq!(looped.slip(), plain.slip(), "{}: return point", case.label);
        assert!(looped.dissipation() > lost_before);
        let mut straight = driven(&case.density, &excursion[..3]);
        let extra = looped.dissipation() - straight.dissipation();
        for share in [0.5, 0.7, -0.3, -0.9] {
            looped.drive_force(share * top).unwrap();
            straight.drive_force(share * top).unwrap();
            assert_eq!(looped.slip(), straight.slip(), "{}: wiped out", case.label);
            assert_eq!(looped.tangent_stiffness(), straight.tangent_stiffness());
            assert_eq!(looped.depth(), straight.depth());
            let gap = looped.dissipation() - straight.dissipation();
            assert!((gap - extra).abs() < 1e-13 * looped.dissipation());
        }
        let big = case.density.leg_dissipation(
            (plain.slip() - driven(&case.density, &excursion[..4]).slip()).abs() / 2.0,
        );
        assert!(
            (extra - 4.0 * big).abs() < 1e-13 * looped.dissipation(),
            "{}",
            case.label
        );
    }
}

/// Beyond the largest force ever, on either side, the network is on its virgin curve.
#[test]
fn larger_loads_find_the_virgin_curve() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let virgin = case.density.displacement(0.8 * top);
        for side in [1.0, -1.0] {
            let path = [
                0.5 * top,
                0.1 * top,
                0.3 * top,
                -0.2 * top,
                side * 0.8 * top,
            ];
            let response = driven(&case.density, &path);
            assert_eq!(response.slip(), side * virgin, "{}", case.label);
            assert_eq!(response.depth(), 0);
        }
    }
}

/// Masters repeat samples: at a reversal that must not cost the memory (elsewhere it does: 0.92 F_S).
#[test]
fn repeated_samples_change_nothing() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let mut once = ExactResponse::new(case.density.clone());
        let mut thrice = ExactResponse::new(case.density.clone());
        let mut by_slip = [once.clone(), once.clone()];
        thrice.drive_force(0.0).unwrap();
        for value in random_nested(3, 600) {
            once.drive_force(top * value).unwrap();
            by_slip[0].drive_slip(case.range * value);
            for _ in 0..3 {
                thrice.drive_force(top * value).unwrap();
                by_slip[1].drive_slip(case.range * value);
            }
            assert_eq!(once, thrice, "{}", case.label);
            assert_eq!(by_slip[0], by_slip[1], "{}", case.label);
        }
    }
}

/// Small cycles on a bias: after the first the network stands still (Bouc–Wen walks away).
#[test]
fn small_biased_cycles_do_not_ratchet() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let (bias, small) = (0.4 * top, 0.01 * top);
        let mut response = driven(&case.density, &[bias + small]);
        let mut places = Vec::new();
        for _ in 0..1000 {
            response.drive_force(bias - small).unwrap();
            response.drive_force(bias + small).unwrap();
            places.push(response.slip());
        }
        assert!(
            places.iter().all(|&slip| slip == places[0]),
            "{}",
            case.label
        );
        let virgin = case.density.displacement(bias + small);
        assert_eq!(places[0], virgin, "{}", case.label);
    }
}

/// `∫ F du = dissipation + stored energy` at every moment of a random history.
#[test]
fn work_is_dissipated_or_stored() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let mut response = ExactResponse::new(case.density.clone());
        let (mut work, mut most_work, mut from) = (0.0_f64, 0.0_f64, 0.0);
        let (mut least_stored, mut worst) = (0.0_f64, 0.0_f64);
        for value in random_nested(4, 300) {
            let pieces = 400;
            for i in 1..=pieces {
                let (slip, force) = (response.slip(), response.force());
                let share = i as f64 / pieces as f64;
                response
                    .drive_force(top * (from + (value - from) * share))
                    .unwrap();
                let mean = 0.5 * (response.force() + force);
                work += mean * (response.slip() - slip);
                most_work = most_work.max(work);
                least_stored = least_stored.min(response.stored_energy());
                let balance = response.dissipation() + response.stored_energy();
                worst = worst.max((work - balance).abs());
            }
            from = value;
        }
        println!("{}: {:.1e}", case.label, worst / most_work);
        // Second-order error of the trapezium with 400 steps per branch.
        assert!(
            worst < 2e-5 * most_work,
            "{}: {worst:e} of {most_work:e}",
            case.label
        );
        // Stored energy is a sum of squares.
        assert!(
            least_stored > -1e-15 * most_work,
            "{}: {least_stored:e}",
            case.label
        );
    }
}

#[test]
fn dissipation_never_falls() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let mut response = ExactResponse::new(case.density.clone());
        let mut before = 0.0;
        for value in random_nested(6, 3000) {
            response.drive_force(top * value).unwrap();
            assert!(response.dissipation() >= before, "{}", case.label);
            before = response.dissipation();
        }
        assert!(before > 0.0);
    }
}

/// Driving the slip that a force caused gives that force, and the other way round.
#[test]
fn force_and_slip_drive_agree() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let largest = case.density.displacement(top);
        let mut by_force = ExactResponse::new(case.density.clone());
        let mut by_slip = ExactResponse::new(case.density.clone());
        for value in random_nested(7, 2000) {
            by_force.drive_force(top * value).unwrap();
            by_slip.drive_slip(by_force.slip());
            let gap = (by_slip.force() - by_force.force()).abs();
            // Slips that agree to rounding may close a loop in one drive and leave a loop of
            // rounding size open in the other: the forces agree to rounding all the same.
            assert!(gap < 1e-12 * top, "{}: {gap:e}", case.label);
            let lost = (by_slip.dissipation() - by_force.dissipation()).abs();
            assert!(
                lost < 1e-11 * (by_force.dissipation() + top * largest),
                "{}",
                case.label
            );
        }
    }
}

/// The augmented joint under prescribed U: memory on the curve behind the spring.
#[test]
fn memory_behind_a_spring() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let series_stiffness = 0.4 * case.density.initial_stiffness();
        let mut network = ExactResponse::new(case.density.clone());
        let mut joint = ExactResponse::new(BehindSpring {
            network: case.density,
            series_stiffness,
        });
        for value in random_nested(8, 1500) {
            network.drive_force(top * value).unwrap();
            joint.drive_slip(network.slip() + network.force() / series_stiffness);
            let gap = (joint.force() - network.force()).abs();
            assert!(gap < 1e-12 * top, "{}: {gap:e}", case.label);
            let spring = network.force().powi(2) / (2.0 * series_stiffness);
            let energy = joint.stored_energy() - network.stored_energy() - spring;
            let scale = top * top / series_stiffness + network.dissipation();
            assert!(energy.abs() < 1e-11 * scale, "{}: {energy:e}", case.label);
            let lost = joint.dissipation() - network.dissipation();
            assert!(lost.abs() < 1e-11 * scale, "{}: {lost:e}", case.label);
        }
    }
}

#[test]
fn saved_state_continues_to_the_last_bit() {
    for case in every_family() {
        let top = strong(&case.density, case.range);
        let history = random_nested(9, 800);
        let mut whole = ExactResponse::new(case.density.clone());
        let mut resumed = ExactResponse::new(case.density.clone());
        for (i, value) in history.iter().enumerate() {
            if i % 37 == 0 {
                let state = whole.state();
                resumed = ExactResponse::new(case.density.clone());
                resumed.restore(&state).unwrap();
                assert_eq!(resumed.state(), state);
            }
            whole.drive_force(top * value).unwrap();
            resumed.drive_force(top * value).unwrap();
            assert_eq!(whole, resumed, "{}", case.label);
        }
    }
}

/// Long ring-down: every turning point is remembered, and all go at once when the load returns.
#[test]
fn ring_down_is_remembered_whole() {
    let case = &every_family()[3];
    let top = strong(&case.density, case.range);
    let mut response = ExactResponse::new(case.density.clone());
    for i in 0..4000 {
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        response
            .drive_force(sign * top * (1.0 - i as f64 / 4000.0))
            .unwrap();
    }
    assert_eq!(response.depth(), 3999);
    response.drive_force(top).unwrap();
    assert_eq!(
        (response.depth(), response.slip()),
        (0, case.density.displacement(top))
    );
}
