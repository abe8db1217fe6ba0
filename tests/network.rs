//! The slider network in stop form and in play form: one network, two ways to drive it.

use iwan::joint::{JointError, Network, PlayNetwork, Plays, Sliders, SlipLimit};
use proptest::prelude::*;

/// A network of a few sliders, with or without an elastic remainder.
fn networks() -> impl Strategy<Value = Sliders> {
    let slider = (0.01_f64..10.0, 0.05_f64..3.0);
    let elastic = prop_oneof![Just(0.0), 0.01_f64..5.0];
    (prop::collection::vec(slider, 1..12), elastic).prop_filter_map(
        "slip displacements apart",
        |(mut sliders, elastic)| {
            sliders.sort_by(|a, b| a.1.total_cmp(&b.1));
            sliders.dedup_by(|a, b| (a.1 - b.1).abs() < 1e-6);
            let (weight, slip_at) = sliders.into_iter().unzip();
            Sliders::new(weight, slip_at, elastic).ok()
        },
    )
}

fn slips() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-4.0_f64..4.0, 1..200)
}

fn close(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= 1e-12 * scale
}

proptest! {
    #[test]
    fn both_forms_give_the_same_slip_and_energies(sliders in networks(), history in slips()) {
        let plays = Plays::from(&sliders);
        let infinite_at = match plays.weight.last() {
            Some(last) if last.is_infinite() => plays.threshold[plays.threshold.len() - 1],
            _ => f64::INFINITY,
        };
        // Slip as a function of force is compared, so errors grow with the largest compliance.
        let compliance: f64 =
            plays.compliance + plays.weight.iter().filter(|c| c.is_finite()).sum::<f64>();
        let stiffness = sliders.elastic + sliders.weight.iter().sum::<f64>();
        let mut stop = Network::new(&sliders);
        let mut play = PlayNetwork::new(plays);
        let (mut lost, mut largest) = (0.0, 0.0_f64);
        for slip in history {
            stop.begin(SlipLimit::UNCHANGED);
            let force = stop.trial(slip, slip > stop.slip()).force;
            // From full slip on, force does not determine slip.
            if force.abs() > 0.999 * infinite_at {
                continue;
            }
            lost += stop.accept(slip);
            largest = largest.max(force.abs());
            let answer = play.drive_force(force);
            let scale = 1.0 + compliance * stiffness;
            prop_assert!(close(answer, slip, 10.0 * scale), "{answer} {slip}");
            let energy = 4.0 * largest * scale * 200.0;
            prop_assert!(close(play.dissipation(), lost, energy));
            prop_assert!(close(play.stored_energy(), stop.stored_energy(), energy));
        }
    }

    #[test]
    fn conversion_there_and_back(sliders in networks()) {
        let back = Plays::from(&sliders).sliders().unwrap();
        prop_assert_eq!(back.weight.len(), sliders.weight.len());
        // 1/S_j of the plays keeps S_j to rounding of the total.
        let total = sliders.elastic + sliders.weight.iter().sum::<f64>();
        let tail = sliders.elastic + sliders.weight[sliders.weight.len() - 1];
        let scale = total * total / tail;
        for (a, b) in back.weight.iter().zip(&sliders.weight) {
            prop_assert!(close(*a, *b, scale), "{} {}", a, b);
        }
        for (a, b) in back.slip_at.iter().zip(&sliders.slip_at) {
            prop_assert!(close(*a, *b, 10.0 * total / tail), "{} {}", a, b);
        }
        prop_assert!(close(back.elastic, sliders.elastic, scale));
    }

    #[test]
    fn work_is_stored_or_dissipated(sliders in networks(), history in slips()) {
        let mut network = Network::new(&sliders);
        let (mut work, mut lost, mut gross) = (0.0, 0.0, 1.0_f64);
        for target in history {
            // Straight pieces between the kinks make the trapezoidal rule exact.
            let mut kinks: Vec<f64> = (0..=400).map(|i| f64::from(i) / 400.0).collect();
            let start = network.slip();
            kinks.retain(|share| *share > 0.0);
            let before = network.clone();
            let leg = {
                network.begin(SlipLimit::UNCHANGED);
                network.accept(target)
            };
            lost += leg;
            prop_assert!(leg >= 0.0);
            let mut walker = before;
            let mut in_pieces = 0.0;
            for share in kinks {
                let slip = start + share * (target - start);
                let from = walker.force();
                let step = slip - walker.slip();
                walker.begin(SlipLimit::UNCHANGED);
                in_pieces += walker.accept(slip);
                work += 0.5 * (from + walker.force()) * step;
                gross += (from * step).abs();
            }
            // One leg or many pieces: the same loss.
            prop_assert!(close(in_pieces, leg, 100.0 * gross), "{in_pieces} {leg}");
        }
        // The trapezoidal rule misses a part of second order at each kink.
        let balance = work - lost - network.stored_energy();
        prop_assert!(balance.abs() < 1e-3 * gross, "{balance} of {gross}");
    }
}

#[test]
fn last_play_decides_between_remainder_and_full_slip() -> Result<(), JointError> {
    let plays = Plays {
        compliance: 0.5,
        weight: vec![0.5, 1.0],
        threshold: vec![1.0, 2.0],
    };
    let sliders = plays.sliders()?;
    // Compliances 0.5, 1, 2: stiffnesses 2, 1, 1/2.
    assert_eq!(sliders.weight, [1.0, 0.5]);
    assert_eq!(sliders.slip_at, [0.5, 1.5]);
    assert_eq!(sliders.elastic, 0.5);
    let slipping = Plays {
        weight: vec![0.5, f64::INFINITY],
        ..plays
    };
    let sliders = slipping.sliders()?;
    assert_eq!(sliders.weight, [1.0, 1.0]);
    assert_eq!(sliders.elastic, 0.0);
    assert_eq!(Plays::from(&sliders), slipping);
    let mut network = PlayNetwork::new(slipping);
    assert_eq!(network.drive_force(1.5), 1.0);
    assert_eq!(network.drive_force(2.5), f64::INFINITY);
    Ok(())
}

#[test]
fn plays_without_effect_vanish() -> Result<(), JointError> {
    let plays = Plays {
        compliance: 0.5,
        weight: vec![0.25, 0.0, 0.25, 0.25, 1.0],
        threshold: vec![3.0, 2.0, 1.0, 1.0, 0.0],
    };
    let sliders = plays.sliders()?;
    // c_0 = 1.5 with the zero threshold; the two at 1 N are one of 0.5; zero weight is gone.
    assert_eq!(sliders.slip_at, [1.5, 1.5 + 2.0 * 2.0]);
    let expected = Plays {
        compliance: 1.5,
        weight: vec![0.5, 0.25],
        threshold: vec![1.0, 3.0],
    };
    let back = Plays::from(&sliders);
    for (a, b) in back.weight.iter().zip(&expected.weight) {
        assert!((a - b).abs() < 1e-15, "{back:?}");
    }
    Ok(())
}

#[test]
fn plays_that_make_no_network_are_refused() {
    let good = Plays {
        compliance: 1.0,
        weight: vec![1.0],
        threshold: vec![1.0],
    };
    for bad in [
        Plays {
            compliance: 0.0,
            ..good.clone()
        },
        Plays {
            compliance: f64::NAN,
            ..good.clone()
        },
        Plays {
            weight: vec![-1.0],
            ..good.clone()
        },
        Plays {
            threshold: vec![f64::NAN],
            ..good.clone()
        },
    ] {
        assert!(
            matches!(bad.sliders(), Err(JointError::OutOfRange { .. })),
            "{bad:?}"
        );
    }
    let short = Plays {
        weight: vec![1.0, 2.0],
        ..good
    };
    assert!(matches!(
        short.sliders(),
        Err(JointError::WrongCount { .. })
    ));
}

#[test]
fn a_falling_limit_lets_go_at_held_slip_and_loses_what_was_stored() -> Result<(), JointError> {
    let sliders = Sliders::new(vec![2.0], vec![1.0], 0.0)?;
    let mut network = Network::new(&sliders);
    network.begin(SlipLimit::UNCHANGED);
    assert_eq!(network.accept(1.0), 0.0);
    assert_eq!((network.force(), network.stored_energy()), (2.0, 1.0));
    network.begin(SlipLimit {
        positive: 0.5,
        negative: 1.0,
    });
    // From 2 N to 1 N at held slip: 1 J − 1/4 J of stored energy goes.
    assert_eq!(network.accept(1.0), 0.75);
    assert_eq!((network.force(), network.stored_energy()), (1.0, 0.25));
    // Unloading is elastic from there, down to the full limit on the other side.
    network.begin(SlipLimit {
        positive: 0.5,
        negative: 1.0,
    });
    assert_eq!(network.accept(-0.5), 0.0);
    assert_eq!(network.force(), -2.0);
    Ok(())
}

#[test]
fn a_slider_at_rest_holds_more_falls_as_it_slides_and_sticks_anew() -> Result<(), JointError> {
    let sliders = Sliders::new(vec![2.0], vec![1.0], 0.0)?;
    let mut network = Network::new(&sliders).sticking(0.5);
    let mut go = |slip: f64| {
        network.begin(SlipLimit::UNCHANGED);
        let lost = network.accept(slip);
        (network.force(), lost)
    };
    assert_eq!(go(1.4), (2.8, 0.0), "above the 2 N at which it slides");
    let (force, lost) = go(1.6);
    assert!((force - 3.0).abs() < 1e-15 && (lost - 0.3).abs() < 1e-12);
    // From 3 N to 2 N at held slip: 9/4 J − 1 J of stored energy goes.
    assert_eq!(go(1.6), (2.0, 1.25));
    assert_eq!(go(1.7).0, 2.0, "it slides on at 2 N");
    assert!((go(1.6).0 - 1.8).abs() < 1e-12);
    assert_eq!(go(1.75).0, 2.0, "a wiggle is no rest");
    assert!((go(1.05).0 - 0.6).abs() < 1e-12);
    assert!(
        (go(2.2).0 - 2.9).abs() < 1e-12,
        "after a rest it holds 3 N again"
    );

    let mut state = Vec::new();
    network.save(&mut state);
    assert_eq!(state.len(), network.state_length());
    let mut other = Network::new(&sliders).sticking(0.5);
    other.restore(&state);
    for slip in [2.4, 2.5, 0.0, 3.0] {
        network.begin(SlipLimit::UNCHANGED);
        other.begin(SlipLimit::UNCHANGED);
        assert_eq!(network.accept(slip), other.accept(slip));
        assert_eq!(network.force(), other.force());
    }
    Ok(())
}
