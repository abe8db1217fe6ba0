//! What `iwan identify` writes of a joint's origin.

use iwan::saved::{SavedJoint, read};
use std::path::Path;
use std::process::Command;

/// joint.json of a bundled record, at a given or at no given date.
fn identified(name: &str, date: Option<&str>) -> (String, SavedJoint) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("provenance {name}"));
    std::fs::create_dir_all(&folder).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_iwan"));
    command
        .args(["identify", "examples/bolt-1.csv", "-o"])
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
