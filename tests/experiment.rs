//! Looking ahead on simulated records: what one rate cannot tell apart, the program that would, and
//! what a dummy settles.

use std::f64::consts::TAU;

use iwan::diagnose::experiment::dummy::Ruling;
use iwan::diagnose::experiment::{Limits, Options};
use iwan::diagnose::{Findings, diagnose_with};
use iwan::joint::{Density, Drive, Joint, Simulation, Sliders};
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Steps of amplitude at one rate.
const RATE: f64 = 2.0;
const STEP: f64 = 1.0 / (RATE * 100.0);
const NOISE: f64 = 4e-9;

fn load() -> Vec<f64> {
    let mut phase = 0.0;
    let mut force = vec![0.0];
    for level in [300.0, 600.0, 900.0] {
        for _ in 0..500 {
            phase += TAU / 100.0;
            force.push(level * f64::sin(phase));
        }
    }
    force
}

/// Displacement read `delay` seconds late, with noise.
fn measured(name: &str, force: &[f64], displacement: &[f64], delay: f64, seed: u64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let late = delay / STEP;
    let displacement = (0..force.len()).map(|i| {
        let before = if i > 0 { displacement[i - 1] } else { 0.0 };
        let read = displacement[i] + late * (before - displacement[i]);
        // The sum of twelve even numbers is as good as normal here.
        let noise: f64 = (0..12).map(|_| random.random_range(0.0..1.0)).sum::<f64>() - 6.0;
        read + NOISE * noise
    });
    Record {
        name: name.to_string(),
        time: Some((0..force.len()).map(|i| i as f64 * STEP).collect()),
        displacement: displacement.collect(),
        force: force.to_vec(),
        preload: None,
        temperature: None,
        acceleration: None,
    }
}

fn joint_record(delay: f64) -> Record {
    let count = 60;
    let weights = vec![2e7 / f64::from(count); count as usize];
    let thresholds = (0..count).map(|j| 1e-6 + 4e-6 * f64::from(j)).collect();
    let sliders = Sliders::new(weights, thresholds, 2e6).expect("sliders");
    let joint = Joint::new(Density::Sliders(sliders), 5e7, Vec::new()).expect("joint");
    let mut simulation = Simulation::new(&joint, Drive::Force).expect("simulation");
    let force = load();
    let displacement: Vec<f64> = force
        .iter()
        .enumerate()
        .map(|(i, f)| {
            simulation
                .step(i as f64 * STEP, *f)
                .expect("step")
                .displacement
        })
        .collect();
    measured("joint", &force, &displacement, delay, 1)
}

/// A solid specimen under the same load.
fn dummy(delay: f64) -> Record {
    let force = load();
    let displacement: Vec<f64> = force.iter().map(|f| f / 1.5e7).collect();
    measured("dummy", &force, &displacement, delay, 2)
}

fn diagnose(delay: f64, dummy: Option<Record>) -> Findings {
    let options = Options {
        limits: Limits {
            force: Some(800.0),
            rate: Some(10.0),
            duration: Some(9.0),
            ..Limits::default()
        },
        dummy,
    };
    diagnose_with(&[joint_record(delay)], &options, |_| {}).expect("findings")
}

const DELAY: f64 = 6e-4;

#[test]
fn one_rate_leaves_questions_and_a_program_within_the_rig() {
    let findings = diagnose(DELAY, None);
    let lines = &findings.outlook.separability;
    assert_eq!(lines.len(), 23);
    for line in lines {
        // A rival beside the baseline leaves no more than the baseline alone.
        assert!(line.lambda <= line.baseline * (1.0 + 1e-9), "{line:?}");
        assert!(line.lambda >= 0.0 && !line.rivals.is_empty(), "{line:?}");
        // A row of the map holds the plain joint and everything else of the catalogue.
        assert_eq!(line.row.len(), 23);
        let least = line.row.iter().map(|r| r.1).fold(f64::INFINITY, f64::min);
        assert!(least <= line.lambda * (1.0 + 1e-9), "{line:?}");
    }
    for candidate in &findings.candidates {
        let line = lines.iter().find(|l| l.name == candidate.name);
        assert_eq!(candidate.lambda_sep, line.map(|l| l.lambda));
    }
    // To first order a dashpot and a delay are the same thing: nearest to each other by far.
    let lag = lines.iter().find(|l| l.name == "viscous_damping");
    let lag = lag.expect("in the catalogue");
    assert_eq!(lag.rivals[0].0, "sensor_delay");
    assert!(lag.lambda < 0.03 * lag.baseline, "{lag:?}");
    let experiment = findings.outlook.experiment.expect("something is open");
    let peak = experiment
        .values
        .iter()
        .fold(0.0_f64, |a, b| a.max(b.abs()));
    assert!(peak > 0.0 && peak <= 800.0 * (1.0 + 1e-9), "{peak}");
    assert!(*experiment.time.last().expect("samples") <= 9.1);
    assert!(experiment.lambda_after > experiment.lambda_before);
}

#[test]
fn a_dummy_with_the_same_delay_names_the_chain() {
    let findings = diagnose(DELAY, Some(dummy(DELAY)));
    let said = &findings.outlook.dummy;
    let ruling = said.iter().find(|d| d.name == "sensor_delay");
    assert_eq!(ruling.map(|d| d.ruling), Some(Ruling::Shown), "{said:?}");
    assert_eq!(findings.causes[0].name, "sensor_delay");
    let rivals = &findings.causes[0].ambiguous_with;
    assert!(
        !rivals.contains(&"viscous_damping".to_string()),
        "{rivals:?}"
    );
}

#[test]
fn a_dummy_without_delay_excludes_it() {
    let findings = diagnose(DELAY, Some(dummy(0.0)));
    let said = &findings.outlook.dummy;
    let ruling = said.iter().find(|d| d.name == "sensor_delay");
    assert_eq!(ruling.map(|d| d.ruling), Some(Ruling::Excluded), "{said:?}");
    // A dashpot does nearly as well in the records: it takes the place, and no other advice is a dummy.
    let names: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, ["viscous_damping"]);
    let rivals = &findings.causes[0].ambiguous_with;
    assert!(rivals.iter().all(|r| r != "sensor_delay"), "{rivals:?}");
    let next = findings.next_experiment.unwrap_or_default();
    assert!(!next.contains("--dummy"), "{next}");
}
