//! What the communication step does to a joint with causes: nothing, or an error that falls in
//! proportion to it.

use iwan::causes;
use iwan::joint::{Acting, Density, Drive, Joint, Simulation, Sliders};

/// Turning values of the input, in units of its largest; half a cosine of one second leads to each.
const TURNINGS: [f64; 7] = [0.6, -0.6, 1.0, -1.0, 0.3, -0.8, 1.0];
const FORCE: f64 = 200.0;

fn joint(effects: Vec<Acting>) -> Joint {
    let slip_at: Vec<f64> = (1..=40).map(|j| 6e-7 * f64::from(j)).collect();
    let weight = vec![6e5; 40];
    Joint::new(
        Density::Sliders(Sliders::new(weight, slip_at, 2e6).unwrap()),
        1e8,
        effects,
    )
    .unwrap()
}

fn acting(name: &str, values: &[f64]) -> Acting {
    let cause = causes::find(name).unwrap();
    Acting {
        effect: cause.effect(),
        values: values.to_vec(),
    }
}

/// Dissipated over the legs by so many equal steps of each \[J\].
fn dissipation(joint: &Joint, steps: usize) -> f64 {
    let mut simulation = Simulation::new(joint, Drive::Force).unwrap();
    let (mut from, mut dissipated) = (0.0, 0.0);
    for (leg, to) in TURNINGS.into_iter().enumerate() {
        for step in 1..=steps {
            let share = step as f64 / steps as f64;
            let way = 0.5 - 0.5 * (std::f64::consts::PI * share).cos();
            let input = FORCE * (from + (to - from) * way);
            let time = leg as f64 + share;
            dissipated = simulation.step(time, input).unwrap().dissipation;
        }
        from = to;
    }
    dissipated
}

/// Errors of the dissipation at 16, 64 and 256 steps to a leg, over what vanishing steps give.
fn errors(effects: Vec<Acting>) -> [f64; 3] {
    let joint = joint(effects);
    let exact = 2.0 * dissipation(&joint, 4096) - dissipation(&joint, 2048);
    [16, 64, 256].map(|steps| (dissipation(&joint, steps) / exact - 1.0).abs())
}

#[test]
fn causes_without_a_history_of_their_own_answer_alike_at_any_step() {
    let cases = [
        acting("pinning", &[1e7, 3e-6, 4e-6, 1e-6, 0.8]),
        acting("clearance", &[2e-6, 20.0, 0.0]),
        acting("slack_growth", &[1e-8, 100.0, 20.0, 0.0]),
        acting("cubic_stiffness", &[1e-14, 1e-5, 0.0, 0.0, 0.0, 0.0]),
        acting("cubic_stiffness", &[0.0, 0.0, 1e19, 1e9, 0.0, 0.0]),
        acting("cubic_stiffness", &[0.0, 0.0, 0.0, 0.0, 1e19, 1e9]),
        acting(
            "joint_opening",
            &[2e-9, 50.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        ),
        acting(
            "joint_opening",
            &[0.0, 0.0, 0.0, 1e6, 1e-6, 0.0, 0.0, 0.0, 0.0],
        ),
        acting(
            "joint_opening",
            &[0.0, 0.0, 0.0, 0.0, 0.0, 1e6, 1e-6, 0.0, 2e-6],
        ),
        acting("asymmetric_friction", &[0.2]),
    ];
    for case in cases {
        let name = case.effect.name();
        let glossary = case.effect.parameters();
        assert_eq!(case.values.len(), glossary.len(), "{name}");
        let errors = errors(vec![case]);
        assert!(errors[0] < 1e-9, "{name}: {errors:?}");
    }
}

/// Displacement where the legs end, by so many equal steps of each \[m\].
fn turning_displacements(joint: &Joint, steps: usize) -> Vec<f64> {
    let mut simulation = Simulation::new(joint, Drive::Force).unwrap();
    let mut from = 0.0;
    let leg = |(leg, to): (usize, f64)| {
        let mut displacement = 0.0;
        for step in 1..=steps {
            let share = step as f64 / steps as f64;
            let way = 0.5 - 0.5 * (std::f64::consts::PI * share).cos();
            let input = FORCE * (from + (to - from) * way);
            let answer = simulation.step(leg as f64 + share, input).unwrap();
            displacement = answer.displacement;
        }
        from = to;
        displacement
    };
    TURNINGS.into_iter().enumerate().map(leg).collect()
}

/// Limits that follow force and displacement are those of a step's end, as its beginning foretells it: limits of its
/// beginning leave 1.5e-4 of the displacement at 64 steps.
#[test]
fn a_limit_that_follows_the_load_is_taken_where_the_step_ends() {
    let joint = joint(vec![acting(
        "normal_load_variation",
        &[0.0, 1e4, 0.0, 0.0, 0.0, 0.0],
    )]);
    let exact = turning_displacements(&joint, 4096);
    let errors = [16, 64, 256].map(|steps| {
        let found = turning_displacements(&joint, steps);
        let apart = found.iter().zip(&exact).map(|(a, b)| (a / b - 1.0).abs());
        apart.fold(0.0, f64::max)
    });
    assert!(errors[1] < 3e-5, "{errors:?}");
}

/// The printed table is the one of docs/importing.md.
#[test]
fn errors_of_causes_that_follow_the_joint_fall_with_the_step() {
    let cases = [
        acting("viscous_damping", &[2e4, 0.0]),
        acting("viscous_damping", &[0.0, 2e4]),
        acting("quadratic_damping", &[1e8, 0.0]),
        acting("quadratic_damping", &[0.0, 1e8]),
        acting("normal_load_variation", &[1e-3, 0.0, 0.0, 0.0, 0.0, 0.0]),
        acting("preload_loss", &[0.3, 5e-3, 0.0, 0.0]),
        acting("running_in", &[0.3, 1e-3, 0.0, 0.0, 0.0]),
        acting("running_in", &[0.3, 1e12, 0.0, 1e5, 0.0]),
        acting("running_in", &[0.0, 1e-3, 0.0, 0.0, 2e-9]),
        acting("rate_dependent_friction", &[0.05, 1e-6, 0.02]),
        acting("velocity_weakening", &[0.1, 1e-5, 0.02, 1.0]),
        acting("static_friction_drop", &[0.3, 0.0, 2.0]),
        acting("static_friction_drop", &[0.3, 1e-5, 2.0]),
        acting("static_friction_drop", &[0.3, 1e-5, 1.0]),
        acting("creep", &[2e-8, 0.3, 0.0, 0.0]),
    ];
    println!("| cause | 16 steps to a leg | 64 | 256 |\n|---|---|---|---|");
    for case in cases {
        let name = case.effect.name();
        let glossary = case.effect.parameters();
        assert_eq!(case.values.len(), glossary.len(), "{name}");
        let [coarse, middle, fine] = errors(vec![case.clone()]);
        println!("| `{name}` | {coarse:.1e} | {middle:.1e} | {fine:.1e} |");
        assert!(coarse > 1e-9, "{name}: {coarse} is no dependence");
        // First order is a factor of four from one to the next; contacts that let go one by one make it
        // uneven.
        assert!(fine < 0.5 * middle, "{name}: {middle}, {fine}");
        assert!(middle < 0.05, "{name}: {middle} at 64 steps");
    }
}
