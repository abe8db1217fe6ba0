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
        ..Record::default()
    }
}

fn joint_record(delay: f64) -> Record {
    let force = load();
    measured("joint", &force, &answer(&force), delay, 1)
}

/// What the joint answers, at rest before.
fn answer(force: &[f64]) -> Vec<f64> {
    let count = 60;
    let weights = vec![2e7 / f64::from(count); count as usize];
    let thresholds = (0..count).map(|j| 1e-6 + 4e-6 * f64::from(j)).collect();
    let sliders = Sliders::new(weights, thresholds, 2e6).expect("sliders");
    let joint = Joint::new(Density::Sliders(sliders), 5e7, Vec::new()).expect("joint");
    let mut simulation = Simulation::new(&joint, Drive::Force).expect("simulation");
    let each = force.iter().enumerate().map(|(i, f)| {
        let step = simulation.step(i as f64 * STEP, *f).expect("step");
        step.displacement
    });
    each.collect()
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
    // What was found is not to be shown: something else may hide behind it.
    let said = &experiment.description;
    assert!(!said.contains("show sensor_delay"), "{said}");
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

/// Runs a diagnosis of a file and gives its status and messages.
fn run_with(record: &std::path::Path, more: &[&str]) -> (Option<i32>, String) {
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_iwan"))
        .arg("diagnose")
        .arg(record)
        .args(["-o", "never", "--json"])
        .args(more)
        .current_dir(env!("CARGO_TARGET_TMPDIR"))
        .output()
        .expect("the binary runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), said)
}

#[test]
fn options_that_nothing_has_a_use_for_are_refused() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let table = folder.join("experiment-table.csv");
    let rows = "force amplitude [N],dissipation [J]\n100,1e-6\n200,6e-6\n300,2e-5\n400,5e-5\n";
    std::fs::write(&table, rows).expect("a test file");
    let without_time = folder.join("experiment-without-time.csv");
    let record = joint_record(0.0);
    let rows = record.force.iter().zip(&record.displacement);
    let rows: Vec<String> = rows.map(|(f, u)| format!("{f:?},{u:?}")).collect();
    let text = format!("force [N],displacement [m]\n{}\n", rows.join("\n"));
    std::fs::write(&without_time, text).expect("a test file");
    let dummy = without_time.to_str().expect("a path of this repository");
    for (record, options, words) in [
        (&table, ["--limit-force", "5"], "amplitude table"),
        (&table, ["--limit-duration", "5"], "amplitude table"),
        (&table, ["--dummy", dummy], "amplitude table"),
        (&without_time, ["--limit-rate", "5"], "without time"),
        (&without_time, ["--dummy", dummy], "same content as"),
    ] {
        let (status, said) = run_with(record, &options);
        assert_eq!(status, Some(2), "{options:?}: {said}");
        let named = said.contains(options[0]) || said.contains(options[1]);
        assert!(named && said.contains(words), "{options:?}: {said}");
    }
    assert!(!folder.join("never").exists());
}

/// The joint's record under a load that never pushes.
fn pulled() -> Record {
    let force: Vec<f64> = load().iter().map(|f| 900.0 + f).collect();
    let mut ramp: Vec<f64> = (0..200).map(|i| 4.5 * f64::from(i)).collect();
    ramp.extend(force);
    measured("pulled", &ramp, &answer(&ramp), 0.0, 3)
}

#[test]
fn a_rig_that_only_pulled_is_not_made_to_push() {
    let run = |limits: Limits| {
        let options = Options {
            limits,
            dummy: None,
        };
        let findings = diagnose_with(&[pulled()], &options, |_| {}).expect("findings");
        let experiment = findings.outlook.experiment.clone();
        let experiment = experiment.expect("something is open");
        let values = &experiment.values;
        let lower = values.iter().copied().fold(f64::INFINITY, f64::min);
        let upper = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        (lower, upper, findings, experiment)
    };
    let faster = Limits {
        rate: Some(10.0),
        duration: Some(9.0),
        ..Limits::default()
    };
    let (lower, upper, findings, experiment) = run(faster);
    assert!(!experiment.blocks.is_empty(), "{}", experiment.description);
    assert!(lower >= 0.0 && upper <= 1800.0, "{lower} {upper}");
    assert!(upper > 900.0 && experiment.values[0] == 0.0);
    assert!(experiment.values.last().expect("samples").abs() < 1e-6);
    // One number for one χ²: the least that the map gives for what is asked.
    let lines = findings.outlook.separability.iter();
    let mut hidden = lines.filter(|l| !l.fitted && l.lambda < 25.0);
    assert!(
        hidden.any(|l| l.lambda == experiment.lambda_before),
        "{}",
        experiment.lambda_before
    );
    // A limit of the channel that answers holds as well: half of what was seen.
    let seen = pulled().displacement;
    let most = 0.5 * seen.iter().copied().fold(0.0, f64::max);
    let (_, narrowed, ..) = run(Limits {
        displacement: Some(most),
        ..faster
    });
    assert!(
        narrowed > 0.4 * upper && narrowed < 0.65 * 1800.0,
        "{narrowed}"
    );
}

#[test]
fn where_only_time_is_short_the_findings_say_so() {
    let options = Options {
        limits: Limits {
            force: Some(800.0),
            rate: Some(10.0),
            duration: Some(0.4),
            ..Limits::default()
        },
        dummy: None,
    };
    let findings = diagnose_with(&[joint_record(0.0)], &options, |_| {}).expect("findings");
    let experiment = findings.outlook.experiment.expect("something is open");
    assert!(experiment.blocks.is_empty() && !experiment.settles);
    let said = &experiment.description;
    assert!(said.contains("no program fits into 400 ms"), "{said}");
    assert!(said.contains("a longer test (--limit-duration "), "{said}");
}

#[test]
fn a_program_that_gains_nothing_is_not_written() {
    // Hardly any load: nothing that a rig so weak does would show anything.
    let options = Options {
        limits: Limits {
            force: Some(3.0),
            duration: Some(6.0),
            ..Limits::default()
        },
        dummy: None,
    };
    let findings = diagnose_with(&[joint_record(0.0)], &options, |_| {}).expect("findings");
    let experiment = findings.outlook.experiment.expect("something is open");
    assert!(experiment.blocks.is_empty() && experiment.values.is_empty());
    assert!(!experiment.settles && experiment.instead.is_some());
    let said = &experiment.description;
    assert!(said.contains("not with this rig"), "{said}");
    assert!(!said.contains("next_experiment.csv"), "{said}");
}

#[test]
fn a_dummy_that_shows_nothing_is_said_to() {
    let findings = diagnose(0.0, Some(dummy(0.0)));
    let said = &findings.outlook.dummy;
    assert!(said.iter().any(|d| d.name == "sensor_delay"), "{said:?}");
    assert!(said.iter().all(|d| d.ruling == Ruling::Absent), "{said:?}");
}

#[test]
fn a_dummy_with_a_delay_that_nobody_asked_about_is_said_to_have_it() {
    let findings = diagnose(0.0, Some(dummy(DELAY)));
    let said = &findings.outlook.dummy;
    let names: Vec<&str> = said.iter().map(|d| d.name.as_str()).collect();
    assert_eq!(names, ["sensor_delay"], "{said:?}");
    assert_eq!(said[0].ruling, Ruling::Shown);
}

#[test]
fn a_joint_is_no_dummy() {
    let findings = diagnose(DELAY, Some(joint_record(0.0)));
    let said = &findings.outlook.dummy;
    assert_eq!(said[0].ruling, Ruling::Slips, "{said:?}");
    assert!(said.iter().all(|d| d.ruling != Ruling::Shown), "{said:?}");
}
