//! The identification held against records of an independent generator (tests/laboratory), whose
//! joints are made of thousands of discrete elements and know nothing of this crate.

use iwan::identify::family::{self, FamilyFit};
use iwan::identify::seed::{self, Seed};
use iwan::joint::{Density, Drive, FourParameter, Joint, Simulation};
use iwan::read;
use iwan::record::{AmplitudeTable, Measurement, Record};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

mod measured;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// A python with numpy and scipy: the repository's own, else the system's.
fn python() -> PathBuf {
    let own = Path::new(ROOT).join(".venv/bin/python");
    let chosen = if own.exists() {
        own
    } else {
        PathBuf::from("python3")
    };
    let ready = Command::new(&chosen)
        .args(["-c", "import numpy, scipy"])
        .output()
        .unwrap_or_else(|e| panic!("{}: {e}", chosen.display()));
    assert!(
        ready.status.success(),
        "{} has no numpy or scipy, which the laboratory needs: run scripts/setup.sh",
        chosen.display()
    );
    chosen
}

/// Runs the laboratory into a fresh folder and returns it.
fn laboratory(arguments: &[&str], folder: &str) -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join(folder);
    let _ = std::fs::remove_dir_all(&target);
    let run = Command::new(python())
        .current_dir(ROOT)
        .env("PYTHONPATH", Path::new(ROOT).join("tests"))
        .args(["-m", "laboratory"])
        .args(arguments)
        .arg("-o")
        .arg(&target)
        .output()
        .expect("python runs");
    assert!(
        run.status.success(),
        "laboratory {arguments:?}: {}",
        String::from_utf8_lossy(&run.stderr)
    );
    target
}

fn records(folder: &Path) -> Vec<Record> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder.join("records"))
        .expect("records")
        .map(|entry| entry.expect("entry").path())
        .collect();
    files.sort();
    files
        .iter()
        .map(|file| match read::file(file, &read::Options::default()) {
            Ok(read::Loaded {
                measurement: Measurement::History(record),
                ..
            }) => record,
            other => panic!("{}: {other:?}", file.display()),
        })
        .collect()
}

fn truth(folder: &Path) -> Value {
    let text = std::fs::read_to_string(folder.join("truth.json")).expect("truth.json");
    serde_json::from_str(&text).expect("JSON")
}

fn fresh_seed() -> u64 {
    let seconds = SystemTime::now()
        .duration_since(UNIX_EPOCH)
        .expect("after 1970");
    std::env::var("IWAN_SEED")
        .ok()
        .and_then(|s| s.parse().ok())
        .unwrap_or(seconds.as_nanos() as u64 % 1_000_000)
}

fn identified(records: &[Record]) -> (Seed, FamilyFit) {
    let all: Vec<&Record> = records.iter().collect();
    let seed = seed::of_records(&all).expect("a seed");
    let drive = family::drive_for(&seed);
    let fit = family::fit(&all, &seed, drive).expect("a fit");
    (seed, fit)
}

/// ϑ within 0.5 %, χ within 0.01, series stiffness within 0.1 %: three fresh joints.
#[test]
fn noise_free_records_give_back_the_small_force_law() {
    let first = fresh_seed();
    for seed in first..first + 3 {
        println!("noise_free --seed {seed}");
        let folder = laboratory(
            &["noise_free", "--seed", &seed.to_string()],
            &format!("noise_free_{seed}"),
        );
        let truth = truth(&folder);
        let number = |name: &str| truth[name].as_f64().expect(name);
        let (procedure, fit) = identified(&records(&folder));
        assert_eq!(fit.drive, Drive::Force);
        let coefficient = fit.shape.log_coefficient().exp() / number("theta") - 1.0;
        let exponent = fit.shape.exponent - number("chi");
        let stiffness = fit.shape.series_stiffness / number("series_stiffness_N_per_m") - 1.0;
        println!(
            "  family: theta {coefficient:+.2e} chi {exponent:+.2e} stiffness {stiffness:+.2e}"
        );
        println!(
            "  rms {:.2e} of the displacement, {:?}",
            fit.relative_rms, fit.shape
        );
        let law = procedure.dissipation.expect("six levels");
        let own = procedure.stiffness.expect("six levels");
        println!(
            "  procedure: theta {:+.2e} chi {:+.2e} stiffness {:+.2e}",
            law.coefficient.value / number("theta") - 1.0,
            law.exponent.value - number("chi"),
            own.series.value / number("series_stiffness_N_per_m") - 1.0
        );
        assert!(
            coefficient.abs() < 0.005,
            "seed {seed}: theta off by {coefficient:.2e}"
        );
        assert!(
            exponent.abs() < 0.01,
            "seed {seed}: chi off by {exponent:.2e}"
        );
        assert!(
            stiffness.abs() < 0.001,
            "seed {seed}: stiffness off by {stiffness:.2e}"
        );
        // These loads soften the tangent by 1.5 % at most: full slip must not be claimed.
        assert!(fit.not_identifiable.iter().any(|s| s.starts_with("F_S")));
    }
}

/// `iwan identify` writes a joint that `iwan simulate` runs back onto the record.
#[test]
fn the_command_line_leaves_a_joint_that_follows_the_record() {
    let seed = fresh_seed();
    println!("noise_free --seed {seed}");
    let folder = laboratory(&["noise_free", "--seed", &seed.to_string()], "command_line");
    let joint = folder.join("joint.json");
    let record = folder.join("records/test-1.csv");
    let iwan = |arguments: &[&Path]| {
        let run = Command::new(env!("CARGO_BIN_EXE_iwan"))
            .args(arguments)
            .output()
            .expect("runs");
        assert!(
            run.status.success(),
            "{}",
            String::from_utf8_lossy(&run.stderr)
        );
        String::from_utf8(run.stdout).expect("UTF-8")
    };
    let report = iwan(&["identify".as_ref(), &record, "-o".as_ref(), &joint]);
    for section in [
        "[[Records]]",
        "[[Procedure of SAND2001-0811]]",
        "[[Fit]]",
        "[[Joint: ",
    ] {
        assert!(report.contains(section), "{section} is not in\n{report}");
    }
    let answer = folder.join("answer.csv");
    iwan(&["simulate".as_ref(), &joint, &record, "-o".as_ref(), &answer]);
    let read = |path: &Path| match read::file(path, &read::Options::default()) {
        Ok(read::Loaded {
            measurement: Measurement::History(record),
            ..
        }) => record,
        other => panic!("{other:?}"),
    };
    let (measured, simulated) = (read(&record), read(&answer));
    let largest = measured
        .displacement
        .iter()
        .fold(0.0, |m: f64, u| m.max(u.abs()));
    for (m, s) in measured.displacement.iter().zip(&simulated.displacement) {
        // 3000 discrete elements and thirteen digits stand behind the record.
        assert!((m - s).abs() < 1e-7 * largest);
    }
    let report = iwan(&[
        "identify".as_ref(),
        &record,
        "-o".as_ref(),
        &joint,
        "--json".as_ref(),
    ]);
    let report: Value = serde_json::from_str(&report).expect("JSON");
    assert_eq!(report["schema"], "iwan-identification/1");
    assert_eq!(report["fit"]["judged"], "displacement");
}

/// Stepped sines of displacement into full slip, by this crate's own exact response: the five
/// numbers of the family come back, and nothing is said to be out of reach.
#[test]
fn full_slip_tells_all_five_numbers() {
    let network = FourParameter::new(800.0, 3e7, -0.45, 0.6).expect("in range");
    let joint = Joint {
        density: Density::FourParameter(network),
        series_stiffness: 5e7,
        effects: Vec::new(),
    };
    let full = network.largest_slip() + 800.0 / 5e7;
    let record = driven(
        &joint,
        Drive::Displacement,
        &[0.05, 0.2, 0.5, 1.0, 1.5].map(|a| a * full),
    );
    let (seed, fit) = identified(std::slice::from_ref(&record));
    assert_eq!(fit.drive, Drive::Displacement, "fullness {}", seed.fullness);
    let value = |name: &str| {
        let found = fit.estimates.iter().find(|e| e.name == name).expect(name);
        assert!(found.interval.is_some(), "{name} has no interval");
        found.value
    };
    // 1e-9 is reached; the last digits are those of the difference quotients.
    assert!((value("slip_force") / 800.0 - 1.0).abs() < 1e-7);
    assert!((value("stiffness") / 3e7 - 1.0).abs() < 1e-6);
    assert!((value("series_stiffness") / 5e7 - 1.0).abs() < 1e-6);
    assert!((value("exponent") + 0.45).abs() < 1e-6);
    assert!((value("ratio") / 0.6 - 1.0).abs() < 1e-6);
    assert!(
        fit.not_identifiable.is_empty(),
        "{:?}",
        fit.not_identifiable
    );
}

/// White noise on the displacement: the 95 % intervals of χ and the joint stiffness hold the truth
/// nearly as often as they say: 94 % and 90 % of 200 fits. The stiffness follows χ along a curved
/// valley, which the intervals follow at the ends of χ's interval only.
#[test]
fn intervals_hold_the_truth_nearly_as_often_as_they_say() {
    let network = FourParameter::new(2000.0, 4e7, -0.4, 0.3).expect("in range");
    let joint = Joint {
        density: Density::FourParameter(network),
        series_stiffness: 6e7,
        effects: Vec::new(),
    };
    let clean = driven(&joint, Drive::Force, &[60.0, 150.0, 300.0, 600.0]);
    let seed = fresh_seed();
    println!("noise from seed {seed}");
    let mut noise = Noise(seed);
    let (mut held, mut asked) = (0, 0);
    for _ in 0..40 {
        let mut record = clean.clone();
        // Half a percent of the largest displacement.
        record
            .displacement
            .iter_mut()
            .for_each(|u| *u += 1.3e-7 * noise.normal());
        let (_, fit) = identified(&[record]);
        let initial = 1.0 / (1.0 / 4e7 + 1.0 / 6e7);
        for (name, truth) in [("joint_stiffness", initial), ("exponent", -0.4)] {
            let estimate = fit.estimates.iter().find(|e| e.name == name).expect(name);
            asked += 1;
            held += usize::from(estimate.admits(truth));
        }
    }
    println!("{held} of {asked} intervals hold the truth");
    // 40 pairs at 0.92, the two of a pair taken as one: 0.92 ± 0.043; 62 of 80 is 3.4 deviations
    // below. Holding the unknown split of the compliance at one value gives half of that.
    assert!(held >= 62, "{held} of {asked}");
}

/// The loss of a linear dashpot grows as F², at the edge of the family: said, not fitted.
#[test]
fn a_square_law_is_not_taken_for_slip() {
    let force: Vec<f64> = vec![1.0, 2.0, 4.0, 8.0];
    let table = AmplitudeTable {
        name: "dashpot".into(),
        dissipation: force.iter().map(|f| 1e-6 * f * f).collect(),
        displacement_amplitude: Some(force.iter().map(|f| 1e-5 * f).collect()),
        force_amplitude: force,
        ..AmplitudeTable::default()
    };
    let seed = seed::of_table(&table).expect("four rows");
    assert!(
        seed.findings
            .iter()
            .any(|s| s.contains("square of the load")),
        "{:?}",
        seed.findings
    );
}

/// A dashpot's table has no joint, and one whose stiffness and loss no slip lets go together neither.
#[test]
fn no_joint_is_made_that_slips_below_the_measured_loads() {
    let force: Vec<f64> = vec![100.0, 200.0, 400.0, 800.0];
    let table = |loss: f64, power: f64| AmplitudeTable {
        name: "levels".into(),
        dissipation: force.iter().map(|f| loss * f.powf(power)).collect(),
        displacement_amplitude: Some(force.iter().map(|f| 1e-7 * f).collect()),
        force_amplitude: force.clone(),
        ..AmplitudeTable::default()
    };
    let joint = |loss, power| {
        let seed = seed::of_table(&table(loss, power)).expect("four rows");
        family::joint_of_law(&seed)
    };
    for (loss, power) in [(1e-8, 2.0), (8e-9, 2.1)] {
        let refused = joint(loss, power).expect_err("no slip does this");
        assert!(refused.to_string().contains("time history"), "{refused}");
    }
    let slipping = joint(1e-13, 2.7).expect("friction loses little");
    assert!(slipping.full_slip_force() > 800.0);
}

/// A displacement that drives an identification is counted from where its record begins.
#[test]
fn a_displacement_that_drives_has_no_zero_of_its_own() {
    let record = |zero: f64| Record {
        name: "zero".into(),
        displacement: (0..400)
            .map(|i| 3e-4 * (0.05 * f64::from(i)).sin() + zero)
            .collect(),
        force: vec![0.0; 400],
        ..Record::default()
    };
    let (plain, off) = (record(0.0), record(5e-3));
    let driven = |r| family::driven(r, Drive::Displacement).into_owned();
    let both = driven(&plain).into_iter().zip(driven(&off));
    for (plain, off) in both {
        assert!((plain - off).abs() < 1e-15, "{plain} {off}");
    }
}

/// The bolted beam's table, where the measured records are at hand.
#[test]
fn the_bolted_beam_has_no_single_power_law() {
    let Some(data) = measured::records() else {
        return;
    };
    let file = data.join("brake_reuss_beam/mode1_amplitude_table.csv");
    let table = match read::file(&file, &read::Options::default()) {
        Ok(read::Loaded {
            measurement: Measurement::Amplitudes(table),
            ..
        }) => table,
        other => panic!("{other:?}"),
    };
    let seed = seed::of_table(&table).expect("rows");
    let law = seed.dissipation.expect("levels");
    let slopes: Vec<f64> = law.local_slopes.iter().map(|s| s.slope).collect();
    assert!((slopes[0] - 2.2).abs() < 0.05, "{slopes:?}");
    assert!(
        slopes[slopes.len() - 2..]
            .iter()
            .all(|s| (3.1..3.25).contains(s)),
        "{slopes:?}"
    );
    assert!(!law.single);
    assert!(
        seed.findings
            .iter()
            .any(|s| s.starts_with("No single power law"))
    );
    assert!(
        seed.findings
            .iter()
            .any(|s| s.contains("falls") && s.contains("rises again"))
    );
}

/// Three cycles at each amplitude, turning values sampled exactly.
fn driven(joint: &Joint, drive: Drive, levels: &[f64]) -> Record {
    let per_cycle = 160;
    let mut simulation = Simulation::new(joint, drive).expect("in range");
    let mut record = Record {
        name: "driven".into(),
        time: Some(Vec::new()),
        ..Record::default()
    };
    let mut time = Vec::new();
    for level in levels {
        for i in 0..3 * per_cycle {
            let angle = std::f64::consts::TAU * f64::from(i) / f64::from(per_cycle);
            let at = 0.01 * time.len() as f64;
            let answer = simulation
                .step(at, level * angle.sin())
                .expect("within full slip");
            time.push(at);
            record.force.push(answer.force);
            record.displacement.push(answer.displacement);
        }
    }
    record.time = Some(time);
    record
}

/// Normal numbers from a seed: splitmix64 and twelve uniforms.
struct Noise(u64);

impl Noise {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}
