//! What `iwan identify` writes of a joint's origin.

use iwan::saved::{SavedJoint, read};
use std::f64::consts::{PI, TAU};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("provenance {name}"));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// joint.json of a bundled record, at a given or at no given date.
fn identified(name: &str, date: Option<&str>) -> (String, SavedJoint) {
    identified_from(&folder(name), &["examples/bolt-1.csv"], date)
}

/// joint.json in the folder, of `iwan identify` with these arguments.
fn identified_from(folder: &Path, arguments: &[&str], date: Option<&str>) -> (String, SavedJoint) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_iwan"));
    command
        .arg("identify")
        .args(arguments)
        .arg("-o")
        .arg(folder.join("joint.json"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .env_remove("SOURCE_DATE_EPOCH");
    if let Some(date) = date {
        command.env("SOURCE_DATE_EPOCH", date);
    }
    let output = command.output().unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{told}");
    let text = std::fs::read_to_string(folder.join("joint.json")).unwrap();
    let saved = read(&text, "joint.json").unwrap();
    (text, saved)
}

#[test]
fn equal_records_at_an_equal_date_give_equal_files() {
    let (first, saved) = identified("first", Some("1714564800"));
    let (second, _) = identified("second", Some("1714564800"));
    assert_eq!(first, second);
    assert_eq!(
        saved.provenance.date.as_deref(),
        Some("2024-05-01T12:00:00Z")
    );
    let [record] = &saved.provenance.records[..] else {
        panic!("one record expected: {:?}", saved.provenance.records)
    };
    let bytes = std::fs::read("examples/bolt-1.csv").unwrap();
    let text = String::from_utf8(bytes).unwrap();
    // `time` is the first column of the bundled record.
    let times: Vec<f64> = text
        .lines()
        .filter_map(|line| line.split(',').next()?.parse().ok())
        .collect();
    let span = record.span.expect("the record has times");
    assert_eq!(record.samples, times.len());
    assert_eq!(record.sha256.len(), 64);
    assert_eq!(span.duration, times[times.len() - 1] - times[0]);
    assert!((span.sample_interval - (times[1] - times[0])).abs() < 1e-6 * span.sample_interval);
}

#[test]
fn the_date_is_now() {
    let (_, saved) = identified("now", None);
    let date = saved.provenance.date.expect("a date");
    let system = Command::new("date")
        .args(["-u", "+%Y-%m-%dT%H:%M:%SZ"])
        .output()
        .unwrap();
    let now = String::from_utf8(system.stdout).unwrap();
    // The same minute, or the one before it: the identification takes a second.
    let minute = |text: &str| -> i64 {
        let number = |from: usize, to: usize| text[from..to].parse::<i64>().unwrap();
        (number(8, 10) * 24 + number(11, 13)) * 60 + number(14, 16)
    };
    let apart = minute(now.trim()) - minute(&date);
    assert!(
        (0..=5).contains(&apart) || apart < -40_000,
        "{date} against {now}"
    );
    assert_eq!(date.len(), now.trim().len());
}

/// The same of a file of that content in the test's folder.
fn identified_of(name: &str, content: &str, options: &[&str]) -> SavedJoint {
    let folder = folder(name);
    let file = folder.join("record.csv");
    std::fs::write(&file, content).unwrap();
    let mut arguments = vec![file.to_str().unwrap()];
    arguments.extend_from_slice(options);
    identified_from(&folder, &arguments, None).1
}

/// What `identify` strikes out is no force that was measured of the joint.
#[test]
fn a_reading_that_was_lost_is_not_the_largest_force() {
    let whole = std::fs::read_to_string("examples/bolt-1.csv").unwrap();
    let lost = "6.23333,673.634,8.5275e-06\n";
    assert!(whole.contains(lost));
    let content = whole.replace(lost, "6.23333,-9999,8.5275e-06\n");
    let saved = identified_of("lost", &content, &[]);
    let forces = whole.lines().filter_map(|line| line.split(',').nth(1));
    let largest = forces
        .filter_map(|force| force.parse::<f64>().ok())
        .fold(0.0_f64, |most, force| most.max(force.abs()));
    assert_eq!(saved.provenance.largest_force(), Some(largest));
}

/// The exciter at phase resonance balances the loss alone: the joint bears `m ω² X`.
#[test]
fn the_largest_force_at_resonance_is_the_joints_own() {
    let (mass, stiffness) = (250.0_f64, 4e6_f64);
    let mut content = String::from(
        "force amplitude [N],dissipation [J],displacement amplitude [m],frequency [Hz]\n",
    );
    let mut largest = 0.0;
    for micrometres in [1.0, 1.4, 1.9, 2.6, 3.5, 4.7, 6.3, 8.4, 11.0, 14.0] {
        let amplitude: f64 = 1e-6 * micrometres;
        // micro-slip of χ = −0.4, an eighth softer at 14 µm
        let slip = (amplitude / 14e-6).powf(0.6) / 8.0;
        let force = stiffness * amplitude * (1.0 - slip);
        let loss = stiffness * slip * amplitude * amplitude * 4.0 * 0.6 / 2.6;
        let hertz = (force / amplitude / mass).sqrt() / TAU;
        content += &format!(
            "{:e},{loss:e},{amplitude:e},{hertz:?}\n",
            loss / (PI * amplitude)
        );
        largest = force;
    }
    let saved = identified_of("resonance", &content, &["--modal-mass", "250"]);
    let said = saved.provenance.largest_force().unwrap();
    assert!((said / largest - 1.0).abs() < 1e-9, "{said} for {largest}");
}
