//! The laws of the catalogue, written once and run over every cause in it.

use iwan::causes::{CATALOGUE, Cause, Kind, Scale};
use iwan::joint::{
    Acting, Density, Drive, FourParameter, Joint, Output, Parameter, Place, Response, Simulation,
    Situation, Sliders, SlipLimit, Trajectory,
};
use proptest::prelude::*;
use std::collections::BTreeSet;

/// Contract names; more may come, none may go.
const NAMES: [&str; 23] = [
    "viscous_damping",
    "quadratic_damping",
    "pinning",
    "clearance",
    "slack_growth",
    "cubic_stiffness",
    "joint_opening",
    "asymmetric_friction",
    "normal_load_variation",
    "preload_loss",
    "running_in",
    "rate_dependent_friction",
    "velocity_weakening",
    "static_friction_drop",
    "creep",
    "fixture_inertia",
    "sensor_delay",
    "displacement_drift",
    "offset_step",
    "mains_hum",
    "ac_coupling",
    "sensor_saturation",
    "sensor_nonlinearity",
];

/// Units of the glossaries, as FMI writes them.
const UNITS: [&str; 19] = [
    "1", "m", "s", "Hz", "N", "J", "kg", "m/s", "N/m", "m/N", "1/N", "1/N2", "1/m", "1/m2", "m/N3",
    "N/m3", "N.s/m", "N.s2/m2", "1/s",
];

const DRIVES: [Drive; 2] = [Drive::Force, Drive::Displacement];
/// Largest force of the histories \[N\]; all sliders slip at 410 N.
const FORCE: f64 = 600.0;
/// Largest displacement of the histories \[m\].
const WAY: f64 = 5e-5;
/// Samples from one turning value to the next, and the time between them \[s\].
const LEG: usize = 40;
const STEP: f64 = 0.0025;

fn sliders() -> Density {
    let slip_at: Vec<f64> = (1..=12).map(|j| 2e-6 * f64::from(j)).collect();
    let weight: Vec<f64> = (1..=12).map(|j| 2e6 + 1e5 * f64::from(j * j % 7)).collect();
    Density::Sliders(Sliders::new(weight, slip_at, 1e7).unwrap())
}

fn joint(effects: Vec<Acting>) -> Joint {
    Joint::new(sliders(), 1e8, effects).unwrap()
}

/// A way from zero through all turning values, in units of the largest input.
fn path(turnings: &[f64]) -> Vec<f64> {
    let mut path = vec![0.0];
    let mut from = 0.0;
    for &to in turnings {
        path.extend((1..=LEG).map(|i| from + (to - from) * i as f64 / LEG as f64));
        from = to;
    }
    path
}

fn times(count: usize) -> Vec<f64> {
    (0..count).map(|i| STEP * i as f64).collect()
}

fn input(drive: Drive, path: &[f64]) -> Vec<f64> {
    let most = match drive {
        Drive::Force => FORCE,
        Drive::Displacement => WAY,
    };
    path.iter().map(|share| share * most).collect()
}

fn simulate(effects: Vec<Acting>, drive: Drive, path: &[f64]) -> Vec<Output> {
    joint(effects)
        .simulate(drive, &times(path.len()), &input(drive, path))
        .unwrap()
}

fn truth(outputs: &[Output]) -> Trajectory {
    Trajectory {
        begins: 0.0,
        test: 0,
        time: outputs.iter().map(|o| o.time).collect(),
        force: outputs.iter().map(|o| o.force).collect(),
        displacement: outputs.iter().map(|o| o.displacement).collect(),
        ..Trajectory::default()
    }
}

/// Loops that grow, shrink and stand on a bias: enough for every cause to show.
fn telling() -> Vec<f64> {
    path(&[
        0.3, -0.3, 0.6, -0.6, 1.0, -1.0, 1.0, -1.0, 0.5, 0.9, 0.4, -0.7, 0.2, -1.0, 1.0, 0.0,
    ])
}

/// Sizes of the telling record.
fn scale() -> Scale {
    let answers = simulate(vec![], Drive::Force, &telling());
    let largest = |of: fn(&Output) -> f64| answers.iter().fold(0.0_f64, |a, o| a.max(of(o).abs()));
    let rate = |two: &[Output]| (two[1].displacement - two[0].displacement).abs() / STEP;
    Scale {
        force: largest(|o| o.force),
        displacement: largest(|o| o.displacement),
        velocity: answers.windows(2).map(rate).fold(0.0, f64::max),
        stiffness: joint(vec![]).initial_stiffness(),
        dissipation: largest(|o| o.dissipation),
        lengths: vec![largest(|o| o.time)],
        jumps: vec![],
        path: answers.windows(2).map(|two| rate(two) * STEP).sum(),
        period: 2.0 * LEG as f64 * STEP,
        first_turns: (0.0, 0.0),
        slowest: 2.0 * LEG as f64 * STEP,
        step: STEP,
        finest: STEP,
        judges_force: true,
        ringing: vec![],
        mains: vec![],
    }
}

/// Values with every amplitude at `factor` times its distance from the vanishing value, in bounds.
fn scaled(cause: &dyn Cause, values: &[f64], factor: f64) -> Acting {
    let glossary = cause.parameters().iter().zip(values);
    Acting {
        effect: cause.effect(),
        values: glossary
            .map(|(parameter, value)| match parameter.vanishes_at {
                Some(zero) => {
                    (zero + factor * (value - zero)).clamp(parameter.lower, parameter.upper)
                }
                None => *value,
            })
            .collect(),
    }
}

/// Every start of every cause, and what refinements of its law make of it.
fn starts() -> impl Iterator<Item = (&'static dyn Cause, Vec<f64>)> {
    let scale = scale();
    CATALOGUE.iter().flat_map(move |&cause| {
        let mut all = cause.starts(&scale);
        for start in all.clone() {
            let refined = cause.refined(&start, &scale);
            if refined != start {
                all.push(refined);
            }
        }
        all.into_iter().map(move |values| (cause, values))
    })
}

fn is_joint(cause: &dyn Cause) -> bool {
    cause.kind() == Kind::Joint
}

/// Turning values in units of the largest input; the last is where the next cycle begins.
fn cycles() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0_f64..1.0, 2..7)
}

#[test]
fn the_catalogue_holds_contract_names_once_each_and_the_table_holds_them_all() {
    let names: Vec<&str> = CATALOGUE.iter().map(|cause| cause.name()).collect();
    let once: BTreeSet<&str> = names.iter().copied().collect();
    assert_eq!(once.len(), names.len(), "{names:?}");
    let order: Vec<&str> = NAMES.iter().copied().filter(|n| once.contains(n)).collect();
    assert_eq!(order, names, "contract names in the order of the contract");
    let table = include_str!("../modelDescription/causes.csv");
    let listed: BTreeSet<&str> = table
        .lines()
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| Some(line.split_once(',')?.1.trim()))
        .collect();
    assert_eq!(listed, NAMES.into_iter().collect());
}

#[test]
fn every_page_is_complete() {
    for cause in CATALOGUE {
        let (name, page) = (cause.name(), cause.page());
        for text in [
            page.happens,
            page.sign,
            page.separated_by,
            page.formula,
            page.source,
        ] {
            assert!(text.len() > 10, "{name}: `{text}` says too little");
        }
        assert!(!page.mistaken_for.is_empty(), "{name}");
        for other in page.mistaken_for {
            assert!(NAMES.contains(other) && *other != name, "{name}: {other}");
        }
        assert_eq!(
            cause.kind() == Kind::Measurement,
            matches!(
                cause.place(),
                Place::ForceChannel | Place::DisplacementChannel
            ),
            "{name}"
        );
        assert_eq!(cause.effect().name(), name);
    }
}

#[test]
fn every_glossary_is_sound() {
    let word = |text: &str| {
        text.starts_with(|c: char| c.is_ascii_lowercase())
            && text.chars().all(|c| c.is_ascii_lowercase() || c == '_')
    };
    for cause in CATALOGUE {
        let name = cause.name();
        let glossary = cause.parameters();
        let once: BTreeSet<&str> = glossary.iter().map(|p| p.name).collect();
        assert_eq!(once.len(), glossary.len(), "{name}");
        assert!(
            glossary.len() <= 16,
            "{name}: no value references for so many"
        );
        assert!(
            glossary.iter().any(|p| p.vanishes_at.is_some()),
            "{name} never vanishes"
        );
        assert!(word(name), "{name}");
        for p in glossary {
            assert!(word(p.name), "{name}.{}", p.name);
            assert!(
                UNITS.contains(&p.unit),
                "{name}.{}: unit {}",
                p.name,
                p.unit
            );
            assert!(p.lower < p.upper && p.lower.is_finite() && p.upper.is_finite());
            assert!(
                p.vanishes_at
                    .is_none_or(|zero| (p.lower..=p.upper).contains(&zero))
            );
            assert!(
                p.neutral
                    .is_none_or(|value| (p.lower..=p.upper).contains(&value)),
                "{name}.{}",
                p.name
            );
            assert!(
                p.meaning.len() > 10 && !p.symbol.is_empty(),
                "{name}.{}",
                p.name
            );
        }
    }
}

#[test]
fn starts_are_few_lie_in_bounds_and_are_seen() {
    let baseline = simulate(vec![], Drive::Force, &telling());
    for cause in CATALOGUE {
        let name = cause.name();
        let starts = cause.starts(&scale());
        // Each start is a pass through the record: seven along each of at most two nuisances.
        assert!(
            (1..=49).contains(&starts.len()),
            "{name}: {} starts",
            starts.len()
        );
        let mut seen = 0;
        for values in &starts {
            let whole = scaled(*cause, values, 1.0);
            assert_eq!(&whole.values, values, "{name} starts out of bounds");
            let sized = || {
                cause
                    .parameters()
                    .iter()
                    .zip(values)
                    .filter(|(p, _)| p.vanishes_at.is_some())
            };
            let nothing = |(p, value): &(&Parameter, &f64)| p.vanishes_at == Some(**value);
            assert!(
                !sized().all(|size| nothing(&size)),
                "{name} starts at nothing"
            );
            // Of two forms of a law one has no size, and is not fitted.
            for (p, value) in sized().filter(nothing) {
                assert_eq!(
                    p.neutral,
                    Some(*value),
                    "{name}.{} starts at nothing",
                    p.name
                );
            }
            let change = change(*cause, &whole, &baseline);
            assert!(change < 0.3, "{whole:?} changes the response by {change}");
            seen += usize::from(change > VISIBLE);
        }
        // A gap or a level may lie where this joint does not reach.
        assert!(
            3 * seen >= 2 * starts.len(),
            "{name}: {seen} of {} seen",
            starts.len()
        );
    }
}

#[test]
fn refinements_are_neutral_at_the_start_and_acting_once_refined() {
    // As many tests as a law may tell apart, none as long as another.
    let one = scale();
    let scale = Scale {
        lengths: (1..=6).map(|k| one.duration() / f64::from(k)).collect(),
        ..one
    };
    for cause in CATALOGUE {
        let name = cause.name();
        let starts = cause.starts(&scale);
        let lacks = |i: usize, values: &[f64]| cause.parameters()[i].neutral == Some(values[i]);
        let neutrals: Vec<usize> = (0..cause.parameters().len())
            .filter(|&i| cause.parameters()[i].neutral.is_some())
            .collect();
        // Of alternatives every shape has one from its start, and need not take on the others.
        let alternative = |start: &Vec<f64>, i: usize| {
            let instead = |other: &Vec<f64>| {
                let own = |&&j: &&usize| !lacks(j, start) && lacks(j, other);
                !lacks(i, other) && neutrals.iter().any(|j| own(&j))
            };
            lacks(i, start) && starts.iter().any(instead)
        };
        // A law of several forms, one to each shape, may have refinements of one of them alone.
        let forms = starts
            .iter()
            .any(|start| neutrals.iter().any(|&i| alternative(start, i)));
        let of_one_form = |i: usize| {
            let refines =
                |start: &Vec<f64>| lacks(i, start) && !lacks(i, &cause.refined(start, &scale));
            forms && starts.iter().any(refines)
        };
        for start in &starts {
            let refined = cause.refined(start, &scale);
            assert_eq!(refined.len(), start.len(), "{name}");
            let anew = cause.begun_anew(start, &scale);
            let begun = |i: usize| anew.as_ref().is_some_and(|begun| !lacks(i, begun));
            let both = cause.parameters().iter().zip(start).enumerate();
            for ((i, (p, from)), to) in both.zip(&refined) {
                match p.neutral {
                    Some(neutral) if neutral == *from => assert!(
                        (*to != neutral || of_one_form(i) || alternative(start, i) || begun(i))
                            && (p.lower..=p.upper).contains(to),
                        "{name}.{}: {from}, refined {to}",
                        p.name
                    ),
                    // No refinement, or one that this shape has from its start.
                    _ => assert_eq!(from, to, "{name}.{}", p.name),
                }
            }
        }
        let glossary = cause.parameters().iter();
        let refinements = glossary.enumerate().filter(|(_, p)| p.neutral.is_some());
        for (i, p) in refinements {
            let mut shapes = cause.starts(&scale).into_iter();
            assert!(
                shapes.any(|start| p.neutral == Some(start[i])),
                "{name}.{} is in every shape: no refinement",
                p.name
            );
        }
    }
}

/// Share of the response from which a change is no rounding.
const VISIBLE: f64 = 1e-6;

/// Root mean square change of the channel that shows the effect, over that of the channel.
fn change(cause: &dyn Cause, acting: &Acting, baseline: &[Output]) -> f64 {
    let root = |sum: f64| sum.sqrt();
    let truth = truth(baseline);
    let chain = acting.places().find(|place| place.is_measurement());
    let (seen, from): (Vec<f64>, &[f64]) = match chain {
        Some(place) => (
            cause.channel(&acting.values, place, &truth),
            truth.channel(place),
        ),
        None => {
            let changed = simulate(vec![acting.clone()], Drive::Force, &telling());
            let moved = changed.iter().zip(baseline);
            let moved = moved.map(|(a, b)| a.displacement - b.displacement);
            (moved.collect(), &truth.displacement)
        }
    };
    assert_eq!(seen.len(), from.len(), "{}", cause.name());
    root(seen.iter().map(|x| x * x).sum()) / root(from.iter().map(|x| x * x).sum())
}

#[test]
fn an_effect_grows_in_proportion_where_it_is_small() {
    // Near its vanishing value an effect is linear in its amplitude: the score test relies on it.
    let baseline = simulate(vec![], Drive::Force, &telling());
    for (cause, values) in starts() {
        if change(cause, &scaled(cause, &values, 1.0), &baseline) < VISIBLE {
            continue;
        }
        let one = change(cause, &scaled(cause, &values, 2e-2), &baseline);
        let half = change(cause, &scaled(cause, &values, 1e-2), &baseline);
        let ratio = one / half;
        assert!(
            (ratio - 2.0).abs() < 0.1,
            "{}{values:?}: ratio {ratio}",
            cause.name()
        );
    }
}

#[test]
fn a_vanished_law_answers_nothing_to_the_last_bit() {
    let answers = simulate(vec![], Drive::Force, &telling());
    let truth = truth(&answers);
    for (cause, values) in starts() {
        let Acting { values, .. } = scaled(cause, &values, 0.0);
        let mut memory = vec![0.0; cause.memory()];
        let mut energy = 0.0;
        for now in situations(&answers) {
            cause.remember(&values, &now, &mut memory);
            let limit = cause.slip_limit(&values, &now, &memory);
            assert_eq!(limit, SlipLimit::UNCHANGED, "{}", cause.name());
            assert_eq!(cause.sticking(&values), 0.0, "{}", cause.name());
            for response in responses(cause, &values, &memory, &now) {
                assert_eq!(response.value, 0.0, "{}", cause.name());
                assert_eq!(
                    (response.slope, response.damping),
                    (0.0, 0.0),
                    "{}",
                    cause.name()
                );
            }
            energy += cause
                .stored_energy(&values, &now, &memory)
                .unwrap_or(0.0)
                .abs();
        }
        assert_eq!(energy, 0.0, "{}", cause.name());
        for place in [Place::ForceChannel, Place::DisplacementChannel] {
            let mut added = cause.channel(&values, place, &truth).into_iter();
            assert!(added.all(|added| added == 0.0), "{}", cause.name());
        }
    }
}

fn situations(answers: &[Output]) -> impl Iterator<Item = Situation> {
    answers.windows(2).map(|two| Situation {
        time: two[1].time,
        step: STEP,
        force: two[1].force,
        displacement: two[1].displacement,
        velocity: (two[1].displacement - two[0].displacement) / STEP,
        slip: two[1].slip_displacement,
        slip_rate: (two[1].slip_displacement - two[0].slip_displacement) / STEP,
        dissipation: two[1].dissipation,
    })
}

fn responses(cause: &dyn Cause, values: &[f64], memory: &[f64], now: &Situation) -> [Response; 4] {
    [
        cause.beside_slip(values, (now.slip, now.slip_rate), memory),
        cause.beside_joint(values, now.displacement, now.velocity),
        cause.spring(values, now.force),
        cause.in_series(values, now.force, now.step, memory),
    ]
}

#[test]
fn slopes_are_those_of_the_laws() {
    let answers = simulate(vec![], Drive::Force, &telling());
    let scale = scale();
    for (cause, values) in starts() {
        let mut memory = vec![0.0; cause.memory()];
        for now in situations(&answers) {
            let at = |by: f64| {
                let mut moved = now;
                moved.slip += by * 1e-6 * scale.displacement;
                moved.displacement += by * 1e-6 * scale.displacement;
                moved.force += by * 1e-6 * scale.force;
                responses(cause, &values, &memory, &moved)
            };
            let (left, here, right) = (at(-1.0), at(0.0), at(1.0));
            for place in 0..4 {
                let (along, across) = match place {
                    0 | 1 => (scale.displacement, scale.force),
                    _ => (scale.force, scale.displacement),
                };
                let unit = 1e-6 * along;
                let before = (here[place].value - left[place].value) / unit;
                let after = (right[place].value - here[place].value) / unit;
                // At a kink the slope of either side will do. A difference has the curvature of
                // its millionth in it, and the rounding of the value over that.
                let rounding = 1e-9 * (here[place].value.abs() / unit + across / along);
                let slack = 1e-4 * (before.abs() + after.abs()) + rounding;
                let (low, high) = (before.min(after) - slack, before.max(after) + slack);
                let slope = here[place].slope;
                assert!(
                    (low..=high).contains(&slope),
                    "{}{values:?}: {slope} in {low}..{high}",
                    cause.name()
                );
            }
            let rate = 1e-6 * scale.velocity;
            let joint =
                |by| cause.beside_joint(&values, now.displacement, now.velocity + by * rate);
            let damping = (joint(1.0).value - joint(-1.0).value) / (2.0 * rate);
            let told = joint(0.0).damping;
            assert!(
                (damping - told).abs() <= 1e-4 * told.abs(),
                "{}: {told}",
                cause.name()
            );
            cause.remember(&values, &now, &mut memory);
        }
    }
}

/// A march counts the energy for those laws alone that look at it.
#[test]
fn a_slip_limit_follows_the_energy_where_it_says_so() {
    let answers = simulate(vec![], Drive::Force, &telling());
    let limits = |acting: &Acting, share: f64| -> Vec<SlipLimit> {
        let mut memory = vec![0.0; acting.effect.memory()];
        let seen = situations(&answers).map(|mut now| {
            now.dissipation *= share;
            let limit = acting.effect.slip_limit(&acting.values, &now, &memory);
            acting.effect.remember(&acting.values, &now, &mut memory);
            limit
        });
        seen.collect()
    };
    let mut asked = 0;
    for cause in CATALOGUE
        .iter()
        .filter(|c| c.effect().place() == Place::SlipLimit)
    {
        let own = starts().filter(|(other, _)| other.name() == cause.name());
        let follows = own.fold(false, |any, (cause, values)| {
            let acting = scaled(cause, &values, 1.0);
            any || limits(&acting, 1.0) != limits(&acting, 0.0)
        });
        assert_eq!(follows, cause.effect().sees_energy(), "{}", cause.name());
        asked += 1;
    }
    assert!(asked >= 7, "{asked} laws of slip limits");
}

#[test]
fn measurement_causes_change_no_simulation() {
    for (cause, values) in starts().filter(|(cause, _)| !is_joint(*cause)) {
        for drive in DRIVES {
            let without = simulate(vec![], drive, &telling());
            let with = simulate(vec![scaled(cause, &values, 1.0)], drive, &telling());
            for (with, without) in with.iter().zip(&without) {
                // An effect takes the joint through the solver for effects: equal to rounding.
                let pairs = [
                    (with.force, without.force, FORCE),
                    (with.displacement, without.displacement, WAY),
                    (with.dissipation, without.dissipation, FORCE * WAY),
                    (with.stored_energy, without.stored_energy, FORCE * WAY),
                ];
                for (a, b, size) in pairs {
                    assert!(
                        (a - b).abs() < 1e-12 * size,
                        "{}: {a} for {b}",
                        cause.name()
                    );
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn vanishing_values_give_the_baseline_to_the_last_bit(turnings in cycles()) {
        let density = Density::FourParameter(FourParameter::new(900.0, 3e7, -0.4, 0.5).unwrap());
        let path = path(&turnings);
        for drive in DRIVES {
            let (time, input) = (times(path.len()), input(drive, &path));
            let baseline = Joint::new(density.clone(), 1e8, vec![]).unwrap();
            let baseline = baseline.simulate(drive, &time, &input).unwrap();
            for (cause, values) in starts() {
                let gone = Joint::new(density.clone(), 1e8, vec![scaled(cause, &values, 0.0)]).unwrap();
                prop_assert_eq!(&gone.simulate(drive, &time, &input).unwrap(), &baseline);
            }
        }
    }

    #[test]
    fn a_closed_cycle_never_returns_energy(turnings in cycles(), strength in 0.5_f64..8.0) {
        let cycle: Vec<f64> = turnings.repeat(4);
        let path = path(&cycle);
        let period = turnings.len() * LEG;
        for (cause, values) in starts().filter(|(cause, _)| is_joint(*cause)) {
            let acting = scaled(cause, &values, strength);
            for drive in DRIVES {
                let answers = simulate(vec![acting.clone()], drive, &path);
                let (mut work, mut gross) = (vec![0.0], vec![0.0]);
                for two in answers.windows(2) {
                    let moved = two[1].displacement - two[0].displacement;
                    let done = 0.5 * (two[0].force + two[1].force) * moved;
                    work.push(work[work.len() - 1] + done);
                    gross.push(gross[gross.len() - 1] + done.abs());
                    prop_assert!(two[1].dissipation >= two[0].dissipation, "{:?}", acting);
                }
                for last in [2 * period, 3 * period, 4 * period] {
                    let first = last - period;
                    let (done, passed) = (work[last] - work[first], gross[last] - gross[first]);
                    // A joint that creeps under a mean strain has not come back to its state: what
                    // it has let go since was put in before.
                    let kept = answers[last].stored_energy - answers[first].stored_energy;
                    let lost = answers[last].dissipation - answers[first].dissipation;
                    // The trapezoid along samples errs by its step squared: a leg has LEG of them.
                    let tiny = passed / (LEG * LEG) as f64;
                    prop_assert!(done - kept >= -tiny, "{:?} {:?}: {} of {}", acting, drive, done - kept, passed);
                    prop_assert!(answers[last].stored_energy >= -tiny, "{:?} {:?}", acting, drive);
                    // Rates are those of whole steps: their work errs by a step of the leg.
                    let off = (done - kept - lost).abs();
                    prop_assert!(off <= 2.0 * passed / LEG as f64, "{:?} {:?}: {} of {}", acting, drive, off, passed);
                }
            }
        }
    }

    #[test]
    fn a_restored_state_continues_to_the_last_bit(turnings in cycles(), cut in 0.1_f64..0.9) {
        let path = path(&turnings);
        let half = (cut * path.len() as f64) as usize;
        for (cause, values) in starts().filter(|(cause, _)| is_joint(*cause)) {
            let joint = joint(vec![scaled(cause, &values, 3.0)]);
            for drive in DRIVES {
                let samples: Vec<(f64, f64)> =
                    times(path.len()).into_iter().zip(input(drive, &path)).collect();
                let mut straight = Simulation::new(&joint, drive).unwrap();
                for &(time, input) in &samples[..half] {
                    straight.step(time, input).unwrap();
                }
                let mut restored = Simulation::new(&joint, drive).unwrap();
                restored.restore(&straight.state()).unwrap();
                for &(time, input) in &samples[half..] {
                    let (a, b) = (straight.step(time, input).unwrap(), restored.step(time, input).unwrap());
                    prop_assert_eq!(a, b, "{}", cause.name());
                }
                prop_assert_eq!(straight.state(), restored.state(), "{}", cause.name());
            }
        }
    }
}
