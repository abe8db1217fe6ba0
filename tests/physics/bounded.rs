//! The bounded memory: equal to the unbounded one while it has room, and within its stated error
//! where it has none.

use super::families::every_family;
use super::histories::{Random, random_nested};
use iwan::joint::{Density, Drive, ExactResponse, FourParameter, Joint, Simulation, VirginCurve};

/// Room for a ring-down of 2000 cycles.
const ROOM: usize = 4096;

fn ring_down(cycles: u32) -> impl Iterator<Item = f64> {
    let swings = 2 * cycles;
    (0..swings).map(move |i| {
        let size = 1.0 - f64::from(i) / f64::from(swings);
        if i % 2 == 0 { size } else { -size }
    })
}

#[test]
fn with_room_the_two_are_one_to_the_last_bit() {
    for case in every_family() {
        let joint = Joint::new(case.density.clone(), 3e7, vec![]).unwrap();
        let force = case.density.force(case.range);
        let force = force.min(0.9 * case.density.full_slip_force());
        let (bounded, exact) = (
            |drive| Simulation::bounded(&joint, drive, ROOM).unwrap(),
            |drive| Simulation::new(&joint, drive).unwrap(),
        );
        for (drive, largest) in [(Drive::Force, force), (Drive::Displacement, case.range)] {
            let (mut bounded, mut exact) = (bounded(drive), exact(drive));
            let history = random_nested(5, 1000).into_iter().chain(ring_down(2000));
            for (i, share) in history.enumerate() {
                let (time, input) = (i as f64, 0.99 * largest * share);
                assert_eq!(
                    bounded.step(time, input).unwrap(),
                    exact.step(time, input).unwrap()
                );
            }
            assert_eq!(bounded.state(), exact.state());
        }
    }
}

/// A ring-down deeper than the memory, then anything within it, then out of it: off by no more than
/// the memory says itself, and afterwards as if nothing had been forgotten.
#[test]
fn without_room_the_error_keeps_its_bound_and_goes_with_the_loop() {
    const MOST: usize = 24;
    const SWINGS: usize = 90;
    let (mut seen, mut met) = (0, 0.0_f64);
    for case in every_family() {
        let curve = &case.density;
        let force = curve.force(case.range).min(0.9 * curve.full_slip_force());
        for (drive, largest) in [(Drive::Force, force), (Drive::Displacement, case.range)] {
            let mut bounded = ExactResponse::bounded(curve.clone(), MOST);
            let mut exact = ExactResponse::new(curve.clone());
            let mut random = Random(9);
            let swing = |i: usize| {
                let size = 1.0 - i as f64 / SWINGS as f64;
                if i.is_multiple_of(2) { size } else { -size }
            };
            let mut history: Vec<f64> = (0..SWINGS).map(swing).collect();
            // Growing excursions, and a ring-down within each of them.
            for i in 1..20 {
                let size = f64::from(i) / 20.0;
                history.extend((0..40).map(|j| {
                    let shrinks = size * (1.0 - f64::from(j) / 40.0);
                    shrinks * (1.0 - 0.3 * random.uniform()) * f64::from(1 - 2 * (j % 2))
                }));
            }
            let mut worst = 0.0_f64;
            let (mut peak, mut nearest) = (0.0_f64, 0.0_f64);
            for &share in &history {
                let apart = go(&mut bounded, &mut exact, drive, largest * share);
                worst = worst.max(apart);
                peak = peak.max(match drive {
                    Drive::Force => exact.slip().abs(),
                    Drive::Displacement => exact.force().abs(),
                });
                assert!(bounded.depth() <= MOST);
                let bound = match drive {
                    Drive::Force => bounded.error_bound().0,
                    Drive::Displacement => bounded.error_bound().1,
                };
                // Rounding of the answer, and of the sum.
                assert!(
                    apart <= bound + 1e-13 * peak,
                    "{}, {drive:?}: {apart} beyond {bound}",
                    case.label
                );
                nearest = nearest.max(apart / bound.max(1e-9 * peak));
            }
            println!(
                "{}, {drive:?}: {:.1e} of the peak, {nearest:.2} of the bound",
                case.label,
                worst / peak
            );
            met = met.max(nearest);
            // A handful of sliders gives way by jumps: a gap may there be a whole slider.
            let smooth = !matches!(case.density, Density::Sliders(_));
            assert!(worst <= if smooth { 0.05 } else { 0.2 } * peak);
            seen += usize::from(worst > 1e-6 * peak);
            // Out of every loop, to virgin: nothing is left of it but rounding.
            for share in [-1.001, 1.0] {
                go(&mut bounded, &mut exact, drive, share * largest);
            }
            let scale = exact.slip().abs();
            assert!((bounded.slip() - exact.slip()).abs() <= 1e-13 * scale);
            assert!((bounded.force() - exact.force()).abs() <= 1e-13 * exact.force().abs());
            assert_eq!(bounded.error_bound(), (0.0, 0.0));
            let (lost, expected) = (bounded.dissipation(), exact.dissipation());
            println!("dissipation off by {:.1e}", lost / expected - 1.0);
            assert!((lost - expected).abs() <= 0.01 * expected);
        }
    }
    assert!(seen > 10, "the error is one in {seen} cases only");
    assert!(met > 0.3, "the bound is far from any error: {met}");
}

/// Drives both; returns how far the answers are apart.
fn go(
    bounded: &mut ExactResponse<Density>,
    exact: &mut ExactResponse<Density>,
    drive: Drive,
    input: f64,
) -> f64 {
    match drive {
        Drive::Force => {
            bounded.drive_force(input).unwrap();
            exact.drive_force(input).unwrap();
            (bounded.slip() - exact.slip()).abs()
        }
        Drive::Displacement => {
            bounded.drive_slip(input);
            exact.drive_slip(input);
            (bounded.force() - exact.force()).abs()
        }
    }
}

/// Twice the ring-down that finds room: the figures of the README.
#[test]
fn a_ring_down_of_4000_cycles_is_off_by_little() {
    let density = FourParameter::new(1000.0, 1.5e7, -0.4, 0.3).unwrap();
    let mut bounded = ExactResponse::bounded(Density::FourParameter(density), ROOM);
    let mut exact = ExactResponse::new(bounded.curve().clone());
    let (mut worst, mut peak) = (0.0_f64, 0.0_f64);
    for share in ring_down(4000) {
        worst = worst.max(go(&mut bounded, &mut exact, Drive::Force, 800.0 * share));
        peak = peak.max(exact.slip().abs());
    }
    assert!(exact.depth() > ROOM && bounded.depth() <= ROOM);
    println!(
        "within: displacement off by {:.1e} of its peak",
        worst / peak
    );
    let energy = bounded.dissipation() / exact.dissipation() - 1.0;
    println!("dissipation off by {energy:.1e}");
    // Out again, on the way past all that was forgotten.
    for share in ring_down(40).collect::<Vec<_>>().into_iter().rev() {
        worst = worst.max(go(&mut bounded, &mut exact, Drive::Force, 800.0 * share));
    }
    let bound = bounded.error_bound().0;
    println!(
        "displacement off by {:.1e} of its peak, of the bound by {:.1e}",
        worst / peak,
        worst / bound
    );
    println!("bound {:.1e} of the peak", bound / peak);
    assert!(worst > 0.0 && worst <= bound);
    assert!(worst < 1e-7 * peak && bound < 6e-5 * peak);
    assert!(energy.abs() < 1e-9);
}

#[test]
fn a_state_too_deep_for_the_memory_is_refused() {
    let density = Density::FourParameter(FourParameter::new(1000.0, 1.5e7, -0.4, 0.3).unwrap());
    let mut exact = ExactResponse::new(density.clone());
    for share in ring_down(20) {
        exact.drive_force(500.0 * share).unwrap();
    }
    let mut small = ExactResponse::bounded(density.clone(), 30);
    let before = small.clone();
    assert!(small.restore(&exact.state()).is_err());
    assert_eq!(small, before);
    let mut large = ExactResponse::bounded(density, 50);
    large.restore(&exact.state()).unwrap();
    assert_eq!(large.state(), exact.state());
}
