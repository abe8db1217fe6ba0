//! What acts across the contact alone, behind a soft spring in series: it is named, and its size told, in either drive.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Seed of the noise; printed with every failure.
const SEED: u64 = 20261128;
/// Stiffness of the series spring \[N/m\]: the contact's is 1.2e8 before it slips.
const SERIES: f64 = 7e7;

/// Force of what bears beside the sliders \[N\] at a slip \[m\].
type Beside<'a> = &'a dyn Fn(f64) -> f64;

/// Level of the steps of a sine, of four cycles each.
fn level(sample: u32) -> f64 {
    [0.3, 0.5, 0.8, 1.0, 0.6][sample as usize / 800]
}

/// Sixty sliders with `beside` across them under steps of a sine of the slip, read behind the spring, in noise of a
/// share of the channel that answers.
fn record(beside: Beside, by_force: bool) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = move || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let mut reached = [0.0_f64; 60];
    let mut before = 0.0;
    let mut record = Record {
        name: "soft".to_owned(),
        time: Some(Vec::new()),
        ..Record::default()
    };
    for i in 0..4000 {
        let turn = TAU * f64::from(i) / 200.0;
        let slip = 2e-5 * level(i) * turn.sin();
        for (j, d) in reached.iter_mut().enumerate() {
            let most = 4e-7 * f64::from(j as u8 + 1);
            *d = (*d + slip - before).clamp(-most, most);
        }
        before = slip;
        let force = 2e6 * reached.iter().sum::<f64>() + beside(slip);
        let displacement = slip + force / SERIES;
        let (of_force, of_displacement) = if by_force { (0.0, 5e-8) } else { (4.0, 0.0) };
        record
            .time
            .get_or_insert_default()
            .push(5e-3 * f64::from(i));
        record.force.push(force + of_force * noise());
        record
            .displacement
            .push(displacement + of_displacement * noise());
    }
    record
}

/// A contact that bears on one side had been called `normal_load_variation`, or itself with a sensor that bends, and one
/// that hardens `pinning`.
#[test]
fn what_bears_behind_a_soft_spring_is_told_from_the_spring() {
    let one_sided = |slip: f64| 3e7 * slip.max(0.0);
    let hardening = |slip: f64| 1e17 * slip.powi(3);
    let laws: [(Beside, &str, &str, f64); 2] = [
        (&one_sided, "joint_opening", "contact_stiffness", 3e7),
        (&hardening, "cubic_stiffness", "across_contact", 1e17),
    ];
    for (law, name, parameter, size) in laws {
        for by_force in [false, true] {
            let place = format!("seed {SEED}, {name}, by force {by_force}");
            let findings = diagnose(&[record(law, by_force)], |_| ()).unwrap();
            let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
            assert_eq!(names, [name], "{place}");
            let told = &findings.causes[0].parameters;
            let told = told.iter().find(|p| p.name == parameter).unwrap();
            let error = told.value / size - 1.0;
            println!("{place}: {error:.4} {:?}", told.interval);
            assert!(error.abs() < 0.1, "{place}: {}", told.value);
        }
    }
}

/// Force of a film \[N\] at a rate of the slip \[m/s\].
type Film<'a> = &'a dyn Fn(f64) -> f64;

/// Sixty sliders and a film between their surfaces, whose force follows the rate of the slip so many times, behind the
/// spring, in two tests of steps of a sine of the slip at another rate each.
fn with_film(law: Film, by_force: bool) -> [Record; 2] {
    [1.0, 6.0].map(|cycles: f64| {
        let step = 1.0 / (200.0 * cycles);
        let rate = |i: u32| 2e-5 * level(i) * TAU * cycles * (TAU * f64::from(i) / 200.0).cos();
        let mut record = record(&|_| 0.0, by_force);
        for i in 0..4000 {
            let film = law(rate(i));
            record.force[i as usize] += film;
            record.displacement[i as usize] += film / SERIES;
        }
        record.name = format!("at {cycles} Hz");
        record.time = Some((0..4000).map(|i| step * f64::from(i)).collect());
        record
    })
}

/// Taken for that of the whole displacement its rate had a delay of the load cell beside it, or friction that follows the
/// rate.
#[test]
fn a_film_behind_a_soft_spring_is_named_alone() {
    let oil = |rate: f64| 8e4 * rate;
    let drag = |rate: f64| 1.2e8 * rate * rate.abs();
    let laws: [(Film, &str, f64); 2] = [
        (&oil, "viscous_damping", 8e4),
        (&drag, "quadratic_damping", 1.2e8),
    ];
    for (law, name, size) in laws {
        for by_force in [false, true] {
            let place = format!("seed {SEED}, {name}, by force {by_force}");
            let findings = diagnose(&with_film(law, by_force), |_| ()).unwrap();
            let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
            assert_eq!(names, [name], "{place}");
            assert_eq!(findings.verdict, Verdict::Explained, "{place}");
            let told = &findings.causes[0].parameters;
            let told = told
                .iter()
                .find(|p| p.name == "contact_coefficient")
                .unwrap();
            println!(
                "{place}: {:.4} {:?}",
                told.value / size - 1.0,
                told.interval
            );
            assert!(
                (told.value / size - 1.0).abs() < 0.1,
                "{place}: {}",
                told.value
            );
        }
    }
}

/// Samples of a cycle, and the steps in which the sliders are followed from one to the next.
const SAMPLES: u32 = 60;
const FINE: u32 = 32;
/// Force of full slip of its sliders \[N\]: sixty of 2e6 N/m up to 0.4 µm, 0.8 µm, … 24 µm.
const FULL_SLIP: f64 = 2e6 * 4e-7 * 1830.0;

/// Sixty sliders behind the spring, driven well into full slip, whose break-free forces fall as the force rises, by this
/// share of the force of full slip.
fn follows_force(fall: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(SEED);
    let mut noise = move || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let most: Vec<f64> = (1..=60).map(|j| 4e-7 * f64::from(j)).collect();
    let mut reached = [0.0_f64; 60];
    let (mut slip, mut force) = (0.0, 0.0);
    let mut record = Record {
        name: "soft".to_owned(),
        time: Some(Vec::new()),
        ..Record::default()
    };
    for i in 0..20 * SAMPLES * FINE {
        let turn = TAU * f64::from(i) / f64::from(SAMPLES * FINE);
        let level = [0.4, 0.7, 1.0, 0.6, 0.3][(i / (4 * SAMPLES * FINE)) as usize];
        let next = 6e-5 * level * turn.sin();
        let share = 1.0 - fall * force / FULL_SLIP;
        for (d, most) in reached.iter_mut().zip(&most) {
            *d = (*d + next - slip).clamp(-most * share, most * share);
        }
        slip = next;
        force = 2e6 * reached.iter().sum::<f64>() + 2e6 * slip;
        if i % FINE == 0 {
            let passed = f64::from(i / FINE) / f64::from(SAMPLES);
            record.time.get_or_insert_default().push(passed);
            record.force.push(force + 4.0 * noise());
            record.displacement.push(slip + force / SERIES);
        }
    }
    record
}

/// Limits of the step's end had a second cause here, beside a spring that is held to be a part of the network.
#[test]
fn friction_that_follows_the_force_behind_a_soft_spring_is_named_alone() {
    let findings = diagnose(&[follows_force(0.1)], |_| ()).unwrap();
    let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["normal_load_variation"]);
    assert_eq!(findings.verdict, Verdict::Explained);
    let told = &findings.causes[0].parameters;
    let told = told.iter().find(|p| p.name == "force_sensitivity").unwrap();
    let size = -0.1 / FULL_SLIP;
    let (low, high) = told.interval.unwrap();
    assert!(low < size && size < high, "{:?} for {size}", told.interval);
    assert!((told.value / size - 1.0).abs() < 0.05, "{}", told.value);
}
