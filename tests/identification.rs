//! The identification held against records of an independent generator (tests/laboratory), whose
//! joints are made of thousands of discrete elements and know nothing of this crate.

use iwan::identify::family::{self, FamilyFit};
use iwan::identify::seed::{self, Seed};
use iwan::joint::Drive;
use iwan::read;
use iwan::record::{Measurement, Record};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

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
