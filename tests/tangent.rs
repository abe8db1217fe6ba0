//! The algorithmic tangent against differences: every family, every cause, both drives, inside
//! loops, at virgin and on both sides of a reversal.

#[path = "physics/families.rs"]
mod families;
#[path = "physics/histories.rs"]
#[allow(dead_code)] // its ring-downs are another test's
mod histories;

use families::every_family;
use histories::Random;
use iwan::causes::{CATALOGUE, Cause, Kind, Scale};
use iwan::joint::{Acting, Density, Drive, FourParameter, Joint, Output, Simulation, VirginCurve};

/// Width of the differences, in units of the largest input: their error is then of the order of
/// 1e-6 of the slope by curvature, and 1e-9 by rounding.
const WIDTH: f64 = 1e-6;
/// Accepted difference, in units of the largest slope of the history.
const TOLERANCE: f64 = 2e-5;
const STEP: f64 = 1e-3;

/// The five signals that have a slope.
fn values(output: &Output) -> [f64; 5] {
    [
        output.force,
        output.displacement,
        output.slip_displacement,
        output.dissipation,
        output.stored_energy,
    ]
}

fn slopes(simulation: &Simulation) -> [f64; 5] {
    let slopes = simulation.sensitivity();
    [
        slopes.force,
        slopes.displacement,
        slopes.slip_displacement,
        slopes.dissipation,
        slopes.stored_energy,
    ]
}

/// One-sided difference quotients of the step's answer over its input, to the left and the right.
fn differences(before: &Simulation, time: f64, input: f64, width: f64) -> [[f64; 5]; 2] {
    let at = |input: f64| values(&before.clone().step(time, input).unwrap());
    let here = at(input);
    [-width, width].map(|width| {
        let there = at(input + width);
        std::array::from_fn(|i| (there[i] - here[i]) / width)
    })
}

/// Every slope of every step is one of the two difference quotients: at a corner of a slider set
/// they differ, and elsewhere both are the slope.
fn check(label: &str, joint: &Joint, drive: Drive, inputs: &[f64]) {
    let largest = inputs.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    let mut simulation = Simulation::new(joint, drive).unwrap();
    simulation.step(0.0, 0.0).unwrap();
    let (mut rows, mut scales) = (Vec::new(), [0.0_f64; 5]);
    let mut last = 0.0;
    for (i, &input) in inputs.iter().enumerate() {
        let time = STEP * (i + 1) as f64;
        let before = simulation.clone();
        simulation.step(time, input).unwrap();
        // A step shorter than the difference has its reversal within it.
        if (input - last).abs() > 2.0 * WIDTH * largest {
            let found = slopes(&simulation);
            for (scale, slope) in scales.iter_mut().zip(found) {
                *scale = scale.max(slope.abs());
            }
            rows.push((i, found, differences(&before, time, input, WIDTH * largest)));
        }
        last = input;
    }
    assert!(rows.len() > inputs.len() / 2);
    for (i, found, [left, right]) in rows {
        for signal in 0..5 {
            let apart = (found[signal] - left[signal])
                .abs()
                .min((found[signal] - right[signal]).abs());
            assert!(
                apart <= TOLERANCE * scales[signal],
                "{label}, {drive:?}, signal {signal}, step {i}: {} for {} and {}, scale {}",
                found[signal],
                left[signal],
                right[signal],
                scales[signal]
            );
        }
    }
}

/// Random targets reached in pieces: loops in loops.
fn history(seed: u64, steps: usize, largest: f64) -> Vec<f64> {
    let mut random = Random(seed);
    let (mut history, mut now) = (Vec::new(), 0.0);
    while history.len() < steps {
        let target = largest * random.symmetric();
        history.extend((1..=5).map(|i| now + (target - now) * f64::from(i) / 5.0));
        now = target;
    }
    history
}

#[test]
fn of_every_family() {
    for case in every_family() {
        let force = case.density.force(case.range);
        let force = force.min(0.9 * case.density.full_slip_force());
        for series in [f64::INFINITY, 3e7] {
            let joint = Joint::new(case.density.clone(), series, vec![]).unwrap();
            check(case.label, &joint, Drive::Force, &history(1, 100, force));
            let way = case.range + force / series;
            check(
                case.label,
                &joint,
                Drive::Displacement,
                &history(2, 100, way),
            );
        }
    }
}

fn bolt(effects: Vec<Acting>) -> Joint {
    let density = FourParameter::new(1000.0, 1.5e7, -0.4, 0.3).unwrap();
    Joint::new(Density::FourParameter(density), 4e7, effects).unwrap()
}

/// Every joint cause at the largest of its starting values, on a record of this size, at each of the places it may act at.
fn effects() -> Vec<Vec<Acting>> {
    let scale = Scale {
        force: 600.0,
        displacement: 8e-5,
        velocity: 8e-3,
        stiffness: 1.1e7,
        dissipation: 0.1,
        lengths: vec![0.1],
        jumps: vec![],
        path: 1e-3,
        period: 0.02,
        first_turns: (0.0, 0.0),
        slowest: 0.02,
        step: STEP,
        finest: STEP,
        judges_force: true,
        ringing: vec![],
        mains: vec![],
    };
    let joint_causes = CATALOGUE.iter().filter(|cause| cause.kind() == Kind::Joint);
    let forms = |cause: &&dyn Cause| {
        let effect = cause.effect();
        let mut forms: Vec<Acting> = Vec::new();
        for values in cause.starts(&scale).into_iter().rev() {
            let places = effect.places(&values);
            if !forms
                .iter()
                .any(|form| effect.places(&form.values) == places)
            {
                forms.push(Acting { effect, values });
            }
        }
        forms
    };
    joint_causes.map(forms).collect()
}

/// Every joint cause at the last of its starting values.
fn together() -> Vec<Acting> {
    effects()
        .into_iter()
        .map(|mut forms| forms.swap_remove(0))
        .collect()
}

#[test]
fn of_every_cause_and_of_all_together() {
    let all = effects();
    assert!(all.len() >= 15);
    let mut joints: Vec<_> = all
        .iter()
        .flatten()
        .map(|acting| (acting.effect.name(), bolt(vec![acting.clone()])))
        .collect();
    joints.push(("all together", bolt(together())));
    for (name, joint) in joints {
        check(name, &joint, Drive::Force, &history(3, 60, 500.0));
        check(name, &joint, Drive::Displacement, &history(4, 60, 8e-5));
    }
}

/// From one point of reversal both ways: onwards the branch's slope, backwards the first slope.
#[test]
fn on_both_sides_of_a_reversal() {
    for (drive, largest) in [(Drive::Force, 700.0), (Drive::Displacement, 1e-4)] {
        let joint = bolt(vec![]);
        let mut simulation = Simulation::new(&joint, drive).unwrap();
        for (i, share) in [0.5, 1.0, -0.4, 0.6].into_iter().enumerate() {
            simulation.step(i as f64, share * largest).unwrap();
        }
        let here = values(&simulation.output());
        let width = 1e-7 * largest;
        let mut taken = [[0.0; 5]; 2];
        for (side, width) in [width, -width].into_iter().enumerate() {
            let mut gone = simulation.clone();
            let there = values(&gone.step(5.0, 0.6 * largest + width).unwrap());
            taken[side] = slopes(&gone);
            for signal in 0..5 {
                let quotient = (there[signal] - here[signal]) / width;
                let scale = taken[side][signal]
                    .abs()
                    .max(1e-3 * here[signal].abs() / largest);
                assert!(
                    (quotient - taken[side][signal]).abs() <= 1e-4 * scale,
                    "{drive:?}, side {side}, signal {signal}: {quotient} {taken:?}"
                );
            }
        }
        // Onwards it gives way more easily than backwards, and only onwards it dissipates.
        let [onwards, backwards] = taken;
        match drive {
            Drive::Force => assert!(onwards[1] > 1.05 * backwards[1], "{taken:?}"),
            Drive::Displacement => assert!(onwards[0] < 0.95 * backwards[0], "{taken:?}"),
        }
        assert!(onwards[3] > 100.0 * backwards[3].abs(), "{taken:?}");
        let initial = joint.initial_stiffness();
        let first = match drive {
            Drive::Force => 1.0 / backwards[1],
            Drive::Displacement => backwards[0],
        };
        assert!((first / initial - 1.0).abs() < 2e-3, "{first} {initial}");
    }
}

#[test]
fn of_the_virgin_joint_before_it_moves() {
    for effects in [vec![], together()] {
        let joint = bolt(effects);
        for drive in [Drive::Force, Drive::Displacement] {
            let simulation = Simulation::new(&joint, drive).unwrap();
            let found = simulation.sensitivity();
            let tangent = match drive {
                Drive::Force => 1.0 / found.displacement,
                Drive::Displacement => found.force,
            };
            let expected = simulation.output().tangent_stiffness;
            assert!((tangent / expected - 1.0).abs() < 1e-12);
            assert_eq!((found.dissipation, found.stored_energy), (0.0, 0.0));
        }
    }
}

/// A step without motion changes neither side nor slope.
#[test]
fn rest_keeps_the_direction() {
    for effects in [vec![], together().split_off(2)[..1].to_vec()] {
        let joint = bolt(effects);
        let mut simulation = Simulation::new(&joint, Drive::Force).unwrap();
        for (i, force) in [400.0, 200.0, -300.0].into_iter().enumerate() {
            simulation.step(i as f64, force).unwrap();
        }
        let moving = slopes(&simulation);
        simulation.step(3.0, -300.0).unwrap();
        for (rest, moving) in slopes(&simulation).iter().zip(moving) {
            assert!(
                (rest - moving).abs() <= 1e-9 * moving.abs(),
                "{rest} {moving}"
            );
        }
    }
}
