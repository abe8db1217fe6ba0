//! What records say of themselves, a gap in time or a stiffness off by a unit: both commands tell it, on standard
//! error and in the result.

mod bundled;

use std::path::{Path, PathBuf};
use std::process::Command;

/// The bundled record twice: as it is, and later in time from its middle on, with `scale` times the displacement.
fn records(name: &str, (later, scale): (f64, f64)) -> PathBuf {
    let (folder, text, header, rows) = bundled::bolt(&format!("noticed {name}"));
    let changed = rows.iter().enumerate().map(|(i, row)| {
        let cells: Vec<f64> = row
            .split(',')
            .filter_map(|c| c.trim().parse().ok())
            .collect();
        let later = if 2 * i > rows.len() { later } else { 0.0 };
        format!("{},{},{}\n", cells[0] + later, cells[1], scale * cells[2])
    });
    let changed = format!("{header}\n{}", changed.collect::<String>());
    std::fs::write(folder.join("whole.csv"), text).expect("written");
    std::fs::write(folder.join("other.csv"), changed).expect("written");
    folder
}

/// Standard output and standard error, each in one line.
fn told(arguments: &[&str], folder: &Path) -> [String; 2] {
    let output = Command::new(env!("CARGO_BIN_EXE_iwan"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program runs");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    [output.stdout, output.stderr].map(|stream| {
        let told = String::from_utf8_lossy(&stream).into_owned();
        told.split_whitespace().collect::<Vec<_>>().join(" ")
    })
}

#[test]
fn a_gap_and_a_unit_are_told() {
    let gap = "Record other: no sample for 3.00 s after t = 6.50000 s";
    let unit = "differs by a factor of about 1000: 105 kN/m in other and 105 MN/m in whole. Is a unit wrong?";
    let both = records("both", (3.0, 1000.0));
    for stream in told(
        &["identify", "whole.csv", "other.csv", "-o", "joint.json"],
        &both,
    ) {
        assert!(stream.contains(unit), "{stream}");
        assert!(stream.contains(gap), "{stream}");
    }
    for stream in told(&["identify", "whole.csv", "-o", "joint.json"], &both) {
        assert!(!stream.contains("no sample for"), "{stream}");
        assert!(!stream.contains("unit wrong"), "{stream}");
    }
    let late = records("late", (3.0, 1.0));
    for stream in told(&["diagnose", "other.csv", "-o", "result"], &late) {
        assert!(stream.contains(gap), "{stream}");
    }
}
