//! The joint with effects: against the exact response, closed forms and the balance of work.

use iwan::joint::{
    Acting, Density, Drive, Effect, FourParameter, Joint, JointError, Output, Parameter, Place,
    PowerLaw, Response, Simulation, Situation, Sliders, SlipLimit,
};
use proptest::prelude::*;

const fn parameter(name: &'static str, vanishes_at: f64) -> Parameter {
    Parameter {
        name,
        symbol: name,
        unit: "1",
        lower: 0.0,
        upper: f64::INFINITY,
        vanishes_at: Some(vanishes_at),
        meaning: "For tests.",
    }
}

/// f = c U̇.
struct Dashpot;
impl Effect for Dashpot {
    fn name(&self) -> &'static str {
        "dashpot"
    }
    fn place(&self) -> Place {
        Place::BesideJoint
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("damping", 0.0)] }
    }
    fn beside_joint(&self, values: &[f64], _displacement: f64, velocity: f64) -> Response {
        Response {
            value: values[0] * velocity,
            slope: 0.0,
            damping: values[0],
        }
    }
}

/// p = k (|u| − gap)₊, on both sides, with a cubic part.
struct Stop;
impl Effect for Stop {
    fn name(&self) -> &'static str {
        "stop"
    }
    fn place(&self) -> Place {
        Place::BesideSlip
    }
    fn parameters(&self) -> &'static [Parameter] {
        const {
            &[
                parameter("stiffness", 0.0),
                Parameter {
                    vanishes_at: None,
                    ..parameter("gap", 0.0)
                },
            ]
        }
    }
    fn beside_slip(&self, values: &[f64], slip: f64, _memory: &[f64]) -> Response {
        let depth = (slip.abs() - values[1]).max(0.0);
        Response {
            value: (values[0] * depth * (1.0 + depth * depth)).copysign(slip),
            slope: if depth > 0.0 {
                values[0] * (1.0 + 3.0 * depth * depth)
            } else {
                0.0
            },
            damping: 0.0,
        }
    }
}

/// s = ± gap/2, reached at a tiny seating force.
struct Play;
const SEAT: f64 = 1e-6;
impl Effect for Play {
    fn name(&self) -> &'static str {
        "play"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("gap", 0.0)] }
    }
    fn in_series(&self, values: &[f64], force: f64, _step: f64, _memory: &[f64]) -> Response {
        let seated = (force / SEAT).clamp(-1.0, 1.0);
        let slope = if force.abs() < SEAT {
            0.5 * values[0] / SEAT
        } else {
            0.0
        };
        Response {
            value: 0.5 * values[0] * seated,
            slope,
            damping: 0.0,
        }
    }
}

/// Compliance δ = c F in tension only.
struct Opening;
impl Effect for Opening {
    fn name(&self) -> &'static str {
        "opening"
    }
    fn place(&self) -> Place {
        Place::Spring
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("compliance", 0.0)] }
    }
    fn spring(&self, values: &[f64], force: f64) -> Response {
        let slope = if force > 0.0 { values[0] } else { 0.0 };
        Response {
            value: slope * force,
            slope,
            damping: 0.0,
        }
    }
}

/// Slip limits n± per direction, vanishing at 1.
struct Sided;
impl Effect for Sided {
    fn name(&self) -> &'static str {
        "sided"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("positive", 1.0), parameter("negative", 1.0)] }
    }
    fn slip_limit(&self, values: &[f64], _last: &Situation, _memory: &[f64]) -> SlipLimit {
        SlipLimit {
            positive: values[0],
            negative: values[1],
        }
    }
}

/// Limits that fall with the dissipated energy; counts samples to have a history.
struct Wear;
impl Effect for Wear {
    fn name(&self) -> &'static str {
        "wear"
    }
    fn place(&self) -> Place {
        Place::SlipLimit
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("rate", 0.0)] }
    }
    fn memory(&self) -> usize {
        1
    }
    fn remember(&self, _values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = now.dissipation;
    }
    fn slip_limit(&self, values: &[f64], _last: &Situation, memory: &[f64]) -> SlipLimit {
        let left = 0.5 + 0.5 * (-values[0] * memory[0]).exp();
        SlipLimit {
            positive: left,
            negative: left,
        }
    }
}

/// One Kelvin element: s → C F with time constant 1 s.
struct Kelvin;
impl Effect for Kelvin {
    fn name(&self) -> &'static str {
        "kelvin"
    }
    fn place(&self) -> Place {
        Place::InSeries
    }
    fn parameters(&self) -> &'static [Parameter] {
        const { &[parameter("compliance", 0.0)] }
    }
    fn memory(&self) -> usize {
        1
    }
    fn remember(&self, values: &[f64], now: &Situation, memory: &mut [f64]) {
        memory[0] = self.in_series(values, now.force, now.step, memory).value;
    }
    fn in_series(&self, values: &[f64], force: f64, step: f64, memory: &[f64]) -> Response {
        let share = -(-step).exp_m1();
        Response {
            value: memory[0] + share * (values[0] * force - memory[0]),
            slope: share * values[0],
            damping: 0.0,
        }
    }
    fn stored_energy(&self, values: &[f64], _now: &Situation, memory: &[f64]) -> Option<f64> {
        Some(0.5 * memory[0] * memory[0] / values[0])
    }
}

fn acting(effect: &'static dyn Effect, values: &[f64]) -> Acting {
    Acting {
        effect,
        values: values.to_vec(),
    }
}

/// Too weak to be seen, and still an effect: takes the joint through the extended solver.
fn whisper() -> Acting {
    acting(&Dashpot, &[1e-300])
}

fn sliders(elastic: f64) -> Density {
    let slip_at: Vec<f64> = (1..=20).map(|i| 0.05 * f64::from(i)).collect();
    let weight: Vec<f64> = (1..=20)
        .map(|i| 0.2 + 0.01 * f64::from(i * i % 7))
        .collect();
    Density::Sliders(Sliders::new(weight, slip_at, elastic).unwrap())
}

fn joint(density: Density, series_stiffness: f64, effects: Vec<Acting>) -> Joint {
    Joint::new(density, series_stiffness, effects).unwrap()
}

fn times(count: usize) -> Vec<f64> {
    (0..count).map(|i| 0.1 * i as f64).collect()
}

fn assert_close(a: &[Output], b: &[Output], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        let pairs = [
            (a.force, b.force),
            (a.displacement, b.displacement),
            (a.slip_displacement, b.slip_displacement),
            (a.dissipation, b.dissipation),
            (a.stored_energy, b.stored_energy),
        ];
        for (x, y) in pairs {
            assert!((x - y).abs() <= tolerance, "{a:?}\n{b:?}");
        }
    }
}

fn histories() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.5_f64..1.5, 2..120)
}

fn all_effects() -> Vec<Acting> {
    vec![
        acting(&Dashpot, &[0.05]),
        acting(&Stop, &[2.0, 0.6]),
        acting(&Play, &[0.3]),
        acting(&Opening, &[0.1]),
        acting(&Sided, &[1.2, 0.8]),
        acting(&Wear, &[0.3]),
        acting(&Kelvin, &[0.05]),
    ]
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
            let allowed = 1e-12 * 15.0 + 100.0 * digit * stiffness;
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

#[test]
fn a_dashpot_adds_its_rate_and_its_loss() {
    let elastic = Density::Sliders(Sliders::new(vec![], vec![], 4.0).unwrap());
    let joint = joint(elastic, f64::INFINITY, vec![acting(&Dashpot, &[0.5])]);
    let time = [0.0, 0.1, 0.3, 0.3, 0.4];
    let path = [0.2, 0.4, 0.1, -0.1, -0.1];
    let answers = joint.simulate(Drive::Displacement, &time, &path).unwrap();
    let rates = [0.0, 2.0, -1.5, 0.0, 0.0];
    let mut lost = 0.0;
    for i in 0..time.len() {
        assert!((answers[i].force - (4.0 * path[i] + 0.5 * rates[i])).abs() < 1e-14);
        lost += if i > 0 {
            0.5 * rates[i] * rates[i] * (time[i] - time[i - 1])
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

/// An effect in series too small to be seen.
fn whisper_in_series() -> Acting {
    acting(&Play, &[1e-300])
}

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

/// Relative error of the loss in the second cycle at some share of the range.
fn loss_error(density: Density, amplitude: f64) -> f64 {
    let cycle = |effects: Vec<Acting>| {
        let joint = joint(density.clone(), f64::INFINITY, effects);
        let path = [amplitude, -amplitude, amplitude];
        let answers = joint
            .simulate(Drive::Displacement, &times(3), &path)
            .unwrap();
        answers[2].dissipation - answers[0].dissipation
    };
    let exact = cycle(vec![]);
    (cycle(vec![whisper()]) - exact) / exact
}

#[test]
fn cells_of_a_continuous_density_come_close_at_any_amplitude() {
    for exponent in [-0.7, -0.3, 0.0, 0.5] {
        let four = FourParameter::new(100.0, 1e6, exponent, 0.4).unwrap();
        let range = four.largest_slip();
        let power = PowerLaw::new(4.0, exponent, 0.5, f64::INFINITY, 1000.0).unwrap();
        for share in [1.3, 0.77, 0.1, 0.0123, 1e-3, 1e-4] {
            let error = loss_error(Density::FourParameter(four), share * range);
            let allowed = if share > 0.05 { 1e-3 } else { 4e-3 };
            assert!(error.abs() < allowed, "{exponent} {share} {error}");
        }
        // No limit: the range is a million times what a test uses.
        let error = loss_error(Density::PowerLaw(power), 1e-3);
        assert!(error.abs() < 3e-2, "{exponent} {error}");
    }
}
