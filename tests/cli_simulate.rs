//! `iwan simulate` from files to a file.

use iwan::read::{self, Options};
use iwan::record::Measurement;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("simulate é {name}"));
    let _ = std::fs::remove_dir_all(&path); // of an earlier run, if any
    std::fs::create_dir_all(&path).expect("a folder for test files");
    path
}

fn simulate(folder: &Path, arguments: &[&str]) -> Output {
    let output = Command::new(env!("CARGO_BIN_EXE_iwan"))
        .current_dir(folder)
        .arg("simulate")
        .args(arguments)
        .output()
        .expect("the binary runs");
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {message}");
    output
}

/// Sliders of 10 N and 90 N, 1e6 N/m each, no further spring.
const JOINT: &str = r#"{
  "format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
  "density": {"family": "sliders", "elastic": 0.0,
              "weight": [1e6, 1e6], "slip_at": [1e-5, 9e-5]},
  "series_stiffness": null,
  "causes": []
}"#;

/// One row of the result: time, force, displacement, dissipation, stored energy.
fn rows(csv: &str) -> Vec<[f64; 5]> {
    let mut lines = csv.lines();
    let header = "time [s],force [N],displacement [m],dissipation [J],stored energy [J]";
    assert_eq!(lines.next(), Some(header));
    let number = |cell: &str| cell.parse::<f64>().expect("a number");
    let row = |line: &str| line.split(',').map(number).collect::<Vec<_>>();
    lines
        .map(|line| row(line).try_into().expect("five columns"))
        .collect()
}

fn assert_close(found: f64, expected: f64) {
    assert!(
        (found - expected).abs() <= 1e-12 * expected.abs(),
        "{found} for {expected}"
    );
}

#[test]
fn two_sliders_under_a_ramp_answer_as_by_hand() {
    let folder = folder("by hand");
    std::fs::write(folder.join("joint.json"), JOINT).expect("a file");
    // 10 N: both stick, u = F/2e6; 50 N: the first slips at 10 N, the second holds 40 N
    std::fs::write(folder.join("load.csv"), "t [s],F [N]\n0,0\n1,10\n2,50\n").expect("a file");
    simulate(&folder, &["joint.json", "load.csv", "-o", "out.csv"]);
    let written = std::fs::read_to_string(folder.join("out.csv")).expect("the result");
    let rows = rows(&written);
    assert_eq!(rows.len(), 3);
    assert_eq!(rows[0], [0.0; 5]);
    assert_eq!(rows[1][..2], [1.0, 10.0]);
    assert_close(rows[1][2], 5e-6);
    assert_eq!(rows[1][3], 0.0);
    assert_close(rows[1][4], 0.5 * 10.0 * 5e-6);
    assert_close(rows[2][2], 4e-5);
    assert_close(rows[2][3], 10.0 * (4e-5 - 1e-5)); // friction times slip
    assert_close(rows[2][4], 0.5 * 10.0 * 1e-5 + 0.5 * 40.0 * 4e-5);
}

#[test]
fn a_load_beyond_what_was_measured_of_the_joint_is_told() {
    let folder = folder("beyond");
    let measured = r#""causes": [], "provenance": {"records": [
        {"name": "a", "samples": 9, "sha256": "ab", "largest_force": 40.0},
        {"name": "b", "samples": 9, "sha256": "cd", "largest_force": 25.0}]}"#;
    let joint = JOINT.replace(r#""causes": []"#, measured);
    std::fs::write(folder.join("joint.json"), joint).expect("a file");
    std::fs::write(folder.join("nowhere.json"), JOINT).expect("a file");
    let told = |joint: &str, largest: f64| {
        let load = format!("t [s],F [N]\n0,0\n1,{largest}\n2,0\n");
        std::fs::write(folder.join("load.csv"), load).expect("a file");
        let output = simulate(&folder, &[joint, "load.csv", "-o", "out.csv"]);
        String::from_utf8(output.stderr).expect("text")
    };
    let beyond = told("joint.json", -50.0);
    assert!(
        beyond.contains("up to 50.0 N") && beyond.contains("measured up to 40.0 N"),
        "{beyond}"
    );
    assert_eq!(told("joint.json", 41.0), "");
    assert_eq!(told("nowhere.json", 50.0), "");
}

#[test]
fn the_answer_driven_back_in_displacement_gives_the_force() {
    let folder = folder("round trip");
    std::fs::write(folder.join("joint.json"), JOINT).expect("a file");
    let mut load = String::from("force [kN];time [ms]\n");
    for row in 0..200 {
        let force = 0.09 * (f64::from(row) * 0.11).sin();
        load.push_str(&format!("{force};{row}\n").replace('.', ","));
    }
    std::fs::write(folder.join("load.csv"), load).expect("a file");
    simulate(&folder, &["joint.json", "load.csv", "-o", "there.csv"]);
    // the result is itself a record, and a load for either drive
    simulate(&folder, &["joint.json", "there.csv", "-o", "again.csv"]);
    let displaced = [
        "joint.json",
        "there.csv",
        "-o",
        "back.csv",
        "--drive",
        "displacement",
    ];
    simulate(&folder, &displaced);
    let text = |name: &str| std::fs::read_to_string(folder.join(name)).expect("the result");
    let (there, back) = (rows(&text("there.csv")), rows(&text("back.csv")));
    assert_eq!(
        text("there.csv"),
        text("again.csv"),
        "numbers survive writing and reading"
    );
    assert_eq!(there.len(), 200);
    assert!(
        there[199][3] > 1e-3,
        "the load is to slip: {}",
        there[199][3]
    );
    for (there, back) in there.iter().zip(&back) {
        assert!((there[1] - back[1]).abs() < 1e-9, "{there:?} {back:?}");
        assert!(
            (there[3] - back[3]).abs() < 1e-12 * there[3].max(1.0),
            "{there:?} {back:?}"
        );
    }
    let loaded = read::file(&folder.join("there.csv"), &Options::default()).expect("a record");
    let Measurement::History(record) = loaded.measurement else {
        panic!("no history")
    };
    assert!(there.iter().map(|row| row[2]).eq(record.displacement));
}

#[test]
fn the_result_goes_to_the_screen_or_replaces_a_file() {
    let folder = folder("places");
    std::fs::write(folder.join("joint.json"), JOINT).expect("a file");
    std::fs::write(folder.join("load.csv"), "F [N]\t\n0\t\n50\t\n").expect("a file");
    std::fs::write(folder.join("out.csv"), "old").expect("a file");
    let printed = simulate(&folder, &["joint.json", "load.csv", "-o", "-"]);
    simulate(&folder, &["joint.json", "load.csv", "--output", "out.csv"]);
    let written = std::fs::read_to_string(folder.join("out.csv")).expect("the result");
    assert_eq!(String::from_utf8_lossy(&printed.stdout), written);
    assert_eq!(rows(&written).len(), 2);
    let said = String::from_utf8_lossy(&printed.stderr).into_owned();
    assert!(said.contains("no time column"), "{said}");
    let names = std::fs::read_dir(&folder).expect("the folder").flatten();
    let mut names: Vec<_> = names.map(|entry| entry.file_name()).collect();
    names.sort();
    assert_eq!(
        names,
        ["joint.json", "load.csv", "out.csv"],
        "nothing else is left"
    );
}
