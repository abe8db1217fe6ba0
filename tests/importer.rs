//! An exported joint in the `fmi` crate's importer, through `iwan check`, and its XML through that
//! crate's reader.
#![cfg(feature = "importer")]

use fmi::fmi2::import::Fmi2Import;
use fmi::traits::FmiImport;
use iwan::pack::{FmiVersion, Platform};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const CAUSES: &str = r#"[
  {"name": "pinning", "parameters": {"stiffness": 2e6, "gap_positive": 1e-5, "gap_negative": 2e-5, "rounding": 0, "stiffness_ratio": 1}},
  {"name": "viscous_damping", "parameters": {"coefficient": 500.0}}
]"#;

fn joint(causes: &str) -> String {
    format!(
        r#"{{"format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
        "density": {{"family": "four_parameter", "slip_force": 1000.0, "stiffness": 1.5e7,
                     "exponent": -0.4, "ratio": 0.3}},
        "series_stiffness": 4e7, "causes": {causes}}}"#
    )
}

/// Runs `iwan` with the library that cargo built with this test.
fn iwan(folder: &Path, arguments: &[&str]) -> Output {
    let test = std::env::current_exe().expect("this test has a file");
    let library = test.with_file_name(format!("libiwan{}", std::env::consts::DLL_SUFFIX));
    Command::new(env!("CARGO_BIN_EXE_iwan"))
        .current_dir(folder)
        .env("IWAN_FMU_LIBRARY", library)
        .args(arguments)
        .output()
        .expect("the binary runs")
}

#[track_caller]
fn fine(folder: &Path, arguments: &[&str]) -> String {
    let output = iwan(folder, arguments);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// A folder with an archive of a joint.
fn exported(name: &str, causes: &str, drive: &str) -> PathBuf {
    exported_as("2", name, causes, drive)
}

/// The same for a version of FMI.
fn exported_as(version: &str, name: &str, causes: &str, drive: &str) -> PathBuf {
    let name = format!("importer ü {name} {drive} {version}");
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder); // of an earlier run, if any
    std::fs::create_dir_all(&folder).expect("a folder");
    std::fs::write(folder.join("joint.json"), joint(causes)).expect("a joint");
    let export = ["export", "joint.json", "-o", "joint.fmu"];
    let options = ["--drive", drive, "--fmi", version];
    fine(&folder, &[&export[..], &options].concat());
    folder
}

/// Either version in its importer: the same answers as `iwan simulate`, a saved state that continues,
/// and the same run after a reset.
#[test]
fn the_importer_gives_what_the_simulation_gives() {
    let joints = [("plain", "[]"), ("with causes", CAUSES)];
    let drives = ["force", "displacement"];
    let cases = joints.into_iter().flat_map(|joint| {
        let versions = drives.map(|drive| ["2", "3"].map(|version| (joint, drive, version)));
        versions.into_iter().flatten()
    });
    for ((name, causes), drive, version) in cases {
        let folder = exported_as(version, name, causes, drive);
        let told = fine(&folder, &["check", "joint.fmu", "--json"]);
        let found: Value = serde_json::from_str(&told).expect("JSON");
        assert_eq!(found["verdict"], "agrees", "{told}");
        assert_eq!(found["fmi"], format!("{version}.0"));
        assert_eq!(found["input"], drive);
        assert_eq!(found["faults"], serde_json::json!([]));
        assert_eq!(found["reset_repeats"], true);
        let text = fine(&folder, &["check", "joint.fmu"]);
        assert!(text.contains("agrees with its joint"), "{text}");
        assert_eq!(found["state_continues"], true);
        assert!(text.contains("A saved state continues"), "{text}");
        let differences = found["differences"].as_array().expect("a list");
        assert_eq!(differences.len(), 6);
        for difference in differences {
            let value = difference["largest_value"].as_f64().expect("a number");
            assert!(value > 0.0, "nothing is compared in {difference}");
            assert_eq!(difference["largest_difference"], 0.0, "{difference}");
        }
    }
}

#[test]
fn a_load_of_a_file_is_run() {
    let folder = exported("load", "[]", "force");
    std::fs::write(
        folder.join("load.csv"),
        "time [ms],force [kN]\n0,0\n1,0.5\n2,-0.5\n3,0.2\n",
    )
    .expect("a load");
    let told = fine(&folder, &["check", "joint.fmu", "load.csv", "--json"]);
    let found: Value = serde_json::from_str(&told).expect("JSON");
    assert_eq!(
        (&found["samples"], &found["verdict"]),
        (&4.into(), &"agrees".into())
    );
    std::fs::write(folder.join("strong.csv"), "time [s],force [kN]\n0,0\n1,5\n").expect("a load");
    let output = iwan(&folder, &["check", "joint.fmu", "strong.csv"]);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    let place = "strong.csv, line 3, column 2 `force [kN]`: force 5000 N reaches full slip";
    assert!(told.contains(place), "{told}");
}

/// Four cycles of a sine, twenty samples each, the first after this share of a distance; as a
/// measurement has it, to three decimals.
fn sine(amplitude: f64, share: f64) -> String {
    let rows = (0..=80).map(|row| {
        let turn = (f64::from(row) + share) / 20.0;
        let force = amplitude * (std::f64::consts::TAU * turn).sin();
        format!("{},{force:.3}\n", f64::from(row) / 20.0)
    });
    format!("time [s],force [N]\n{}", rows.collect::<String>())
}

/// A top half-way between two samples makes them equal: there, too, it is put back, and the loss told.
#[test]
fn a_top_between_two_equal_samples_is_put_back() {
    let folder = exported("equal", "[]", "force");
    let reference = |share: f64| -> f64 {
        std::fs::write(folder.join("sine.csv"), sine(900.0, share)).expect("a record");
        let told = fine(&folder, &["check", "joint.fmu", "sine.csv", "--json"]);
        let found: Value = serde_json::from_str(&told).expect("JSON");
        found["steps"]["reference_dissipation"]
            .as_f64()
            .expect("a dissipation")
    };
    let (aside, half_way) = (reference(0.4), reference(0.5));
    assert!(
        (half_way / aside - 1.0).abs() < 0.005,
        "{half_way} J, {aside} J"
    );
}

/// A ramp that ends in a rest has no top above the rest, whether this lasts for a sample or for ten.
#[test]
fn a_load_that_rests_has_no_top() {
    let folder = exported("rest", "[]", "force");
    for rest in [1, 10] {
        let mut csv = String::from("time [s],force [N]\n0,0\n");
        let mut time = 0;
        for force in [500, -500, 500, -500, 300] {
            time += 1;
            csv += &format!("{time},{force}\n");
            time += rest;
            csv += &format!("{time},{force}\n");
        }
        std::fs::write(folder.join("rest.csv"), csv).expect("a load");
        let told = fine(&folder, &["check", "joint.fmu", "rest.csv", "--json"]);
        let found: Value = serde_json::from_str(&told).expect("JSON");
        let all = found["steps"]["effects"].as_array().expect("a list");
        let own = all
            .iter()
            .find(|effect| effect["origin"] == "the samples themselves");
        assert_eq!(own.expect("a step")["lost"], 0.0, "{told}");
    }
}

/// A turning value between the samples that the joint cannot answer is no fault of the archive, and
/// is not called a sample.
#[test]
fn a_top_beyond_full_slip_is_told_apart_from_a_sample() {
    let folder = exported("top", "[]", "force");
    std::fs::write(folder.join("sine.csv"), sine(1003.0, 0.3)).expect("a record");
    let output = iwan(&folder, &["check", "joint.fmu", "sine.csv"]);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("agrees with its joint"), "{text}");
    let told = String::from_utf8_lossy(&output.stderr);
    let place = "sine.csv: between its samples: force 100";
    assert!(told.contains(place), "{told}");
}

/// An archive whose joint was exchanged is told by its GUID; one that is none by its form.
#[test]
fn a_foreign_archive_is_refused() {
    let folder = exported("foreign", "[]", "force");
    std::fs::write(folder.join("text.fmu"), "no archive").expect("a file");
    let output = iwan(&folder, &["check", "text.fmu"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(
        String::from_utf8_lossy(&output.stderr)
            .contains("text.fmu: is no archive of FMI 2.0 or 3.0")
    );
    let output = iwan(&folder, &["check", "none.fmu"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn the_xml_reads_back_as_it_was_meant() {
    let folder = exported("xml", CAUSES, "force");
    let import: Fmi2Import =
        fmi::import::from_path(folder.join("joint.fmu")).expect("an FMI 2.0 archive");
    let description = import.model_description();
    assert_eq!(description.fmi_version, "2.0");
    assert!(description.model_exchange.is_none());
    let unit = description.co_simulation.as_ref().expect("co-simulation");
    assert_eq!(unit.model_identifier, "IwanJoint");
    let text = joint(CAUSES);
    let joint = iwan::saved::read(&text, "joint.json")
        .expect("a joint")
        .joint;
    let drive = iwan::joint::Drive::Force;
    let variables = iwan::variables::Variables::of(&joint, drive).expect("variables");
    let read = &description.model_variables.variables;
    let names: Vec<_> = read
        .iter()
        .map(|v| (v.name.clone(), v.value_reference))
        .collect();
    let meant: Vec<_> = variables
        .iter()
        .map(|v| (v.name.clone(), v.reference))
        .collect();
    assert_eq!(names, meant);
    assert_eq!(description.guid, iwan::variables::guid(&text, drive));
}

/// A record is shown beside the joint's answer, and a step that steps over its cycles is called
/// too coarse, with what it loses.
#[test]
fn a_record_is_compared_and_its_step_is_judged() {
    let folder = exported("record", "[]", "force");
    // Twenty cycles per second and a displacement that is 2 % of a linear joint's off.
    let mut csv = String::from("time [s],force [N],displacement [m]\n");
    for row in 0..=2000 {
        let time = f64::from(row) / 2000.0;
        let force = 600.0 * (std::f64::consts::TAU * 20.0 * time).sin();
        csv += &format!("{time},{force},{}\n", force / 1.1e7);
    }
    std::fs::write(folder.join("record.csv"), csv).expect("a record");
    let check = |arguments: &[&str]| -> Value {
        let command = [&["check", "joint.fmu", "record.csv", "--json"], arguments].concat();
        serde_json::from_str(&fine(&folder, &command)).expect("JSON")
    };
    let fine_step = check(&["--step", "0.0005"]);
    assert_eq!(fine_step["verdict"], "agrees");
    assert_eq!(fine_step["faults"], serde_json::json!([]));
    let here = Platform::of_this_machine(FmiVersion::Two).expect("a platform of FMI");
    assert_eq!(fine_step["platforms"], serde_json::json!([here.name]));
    assert_eq!(fine_step["steps"]["too_coarse"], false);
    let cycle = fine_step["steps"]["shortest_cycle"]
        .as_f64()
        .expect("a cycle");
    assert!((cycle - 0.05).abs() < 0.001, "{cycle}");
    // A straight line dissipates nothing; the joint does.
    let work = |key: &str| fine_step["measured"][key].as_f64().expect("work");
    assert!(work("work_measured").abs() < 0.01 * work("work_simulated"));
    let rms = fine_step["measured"]["rms"].as_f64().expect("rms");
    let swing = fine_step["measured"]["swing"].as_f64().expect("swing");
    assert!((0.001..0.5).contains(&(rms / swing)), "{rms} of {swing}");
    let coarse = check(&["--step", "0.006"]);
    assert_eq!(coarse["steps"]["too_coarse"], true);
    let lost = coarse["steps"]["lost"].as_f64().expect("a share");
    assert!((0.02..0.9).contains(&lost), "{lost}");
    let advised = coarse["steps"]["advised_step"].as_f64().expect("a step");
    let advised = check(&["--step", &advised.to_string()]);
    assert_eq!(advised["steps"]["too_coarse"], false);
    let text = fine(
        &folder,
        &["check", "joint.fmu", "record.csv", "--step", "0.006"],
    );
    assert!(text.contains("TOO COARSE"), "{text}");
    let output = iwan(
        &folder,
        &["check", "joint.fmu", "record.csv", "--step", "-1"],
    );
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(told.contains("--step -1: expected seconds"), "{told}");
    // Steps that would take days are not begun.
    let tiny = ["check", "joint.fmu", "record.csv", "--step", "1e-9"];
    let output = iwan(&folder, &tiny);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("--step 1e-9: expected"), "{told}");
}

/// Between turning values that all fall on samples nothing is lost without causes; a slip limit that
/// follows the load loses some at every step, and is held against vanishing steps.
#[test]
fn a_step_is_judged_by_what_causes_lose_at_it_too() {
    let causes = r#"[{"name": "normal_load_variation",
        "parameters": {"force_sensitivity": 5e-4}}]"#;
    // A triangle of two seconds: its turning values are samples, and parabolas through them add none.
    let input = |time: f64| {
        let way = (time + 0.5).rem_euclid(2.0);
        1200.0 * if way < 1.0 { way - 0.5 } else { 1.5 - way }
    };
    let mut csv = String::from("time [s],force [N],displacement [m]\n");
    for row in 0..=20 {
        let time = f64::from(row) / 4.0;
        csv += &format!("{time},{},{}\n", input(time), input(time) / 1.1e7);
    }
    let lost = |name: &str, causes: &str| -> f64 {
        let folder = exported(name, causes, "force");
        std::fs::write(folder.join("record.csv"), &csv).expect("a record");
        let said = fine(
            &folder,
            &[
                "check",
                "joint.fmu",
                "record.csv",
                "--step",
                "0.25",
                "--json",
            ],
        );
        let said: Value = serde_json::from_str(&said).expect("JSON");
        said["steps"]["effects"]
            .as_array()
            .expect("steps")
            .iter()
            .find(|e| e["origin"] == "the samples themselves")
            .and_then(|e| e["lost"].as_f64())
            .expect("a share")
    };
    assert!(lost("no cause at its step", "[]").abs() < 1e-9);

    let dissipated = |parts: u32| -> f64 {
        let saved = iwan::saved::read(&joint(causes), "joint.json").expect("a joint");
        let drive = iwan::joint::Drive::Force;
        let mut simulation = iwan::joint::Simulation::new(&saved.joint, drive).expect("a joint");
        let mut dissipated = 0.0;
        for row in 1..=20 * parts {
            let time = f64::from(row) / f64::from(4 * parts);
            dissipated = simulation
                .step(time, input(time))
                .expect("a step")
                .dissipation;
        }
        dissipated
    };
    let expected = 1.0 - dissipated(1) / dissipated(1000);
    assert!(expected.abs() > 0.01, "{expected} would not show");
    let said = lost("a cause at its step", causes);
    assert!(
        (said - expected).abs() < 0.1 * expected.abs(),
        "{said}, {expected}"
    );
}

/// The archive with changed entries, or without those that begin so.
fn changed(folder: &Path, name: &str, dropped: &str, change: impl Fn(&str, &mut Vec<u8>)) {
    let file = std::fs::File::open(folder.join("joint.fmu")).expect("the archive");
    let mut old = zip::ZipArchive::new(file).expect("a zip file");
    let file = std::fs::File::create(folder.join(name)).expect("a file");
    let mut new = zip::ZipWriter::new(file);
    let names: Vec<String> = old.file_names().map(str::to_owned).collect();
    for kept in names.iter().filter(|kept| !kept.starts_with(dropped)) {
        let mut bytes = Vec::new();
        std::io::copy(&mut old.by_name(kept).expect("an entry"), &mut bytes).expect("bytes");
        change(kept, &mut bytes);
        new.start_file(kept, zip::write::SimpleFileOptions::default())
            .expect("an entry");
        std::io::Write::write_all(&mut new, &bytes).expect("bytes");
    }
    new.finish().expect("an archive");
}

/// The archive with one text replaced in one entry, or without the entries that begin so.
fn spoilt(folder: &Path, name: &str, (entry, from, to): (&str, &str, &str), dropped: &str) {
    changed(folder, name, dropped, |kept, bytes| {
        if kept == entry {
            let text = String::from_utf8(std::mem::take(bytes)).expect("UTF-8");
            assert!(text.contains(from), "{text}");
            *bytes = text.replace(from, to).into_bytes();
        }
    });
}

/// What `iwan check` says to such an archive, which it must refuse.
fn refused(folder: &Path, name: &str, change: (&str, &str, &str), dropped: &str) -> String {
    spoilt(folder, name, change, dropped);
    refused_as_it_is(folder, name)
}

fn refused_as_it_is(folder: &Path, name: &str) -> String {
    let output = iwan(folder, &["check", name]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    told
}

const DESCRIPTION: &str = "modelDescription.xml";
const NO_CHANGE: (&str, &str, &str) = ("", "", "");
const NO_ENTRY: &str = "no entry begins with this";

/// XML that no longer says what the joint is: another start value, another unit, no library; of
/// either version.
#[test]
fn an_archive_whose_parts_disagree_is_refused() {
    for version in ["2", "3"] {
        let folder = exported_as(version, "disagree", "[]", "force");
        let start = (DESCRIPTION, "start=\"1000.0\"", "start=\"999.0\"");
        let told = refused(&folder, "start.fmu", start, NO_ENTRY);
        let expected = "variable slip_force: start expected";
        assert!(told.contains(expected), "{told}");
        let unit = (DESCRIPTION, "unit=\"J\"", "unit=\"W\"");
        let told = refused(&folder, "unit.fmu", unit, NO_ENTRY);
        assert!(told.contains("unit expected J, came W"), "{told}");
        let name = (DESCRIPTION, "name=\"dissipation\"", "name=\"loss\"");
        let told = refused(&folder, "name.fmu", name, NO_ENTRY);
        assert!(told.contains("variable loss: the joint has none"), "{told}");
        let date = (
            DESCRIPTION,
            "variableNamingConvention",
            "generationDateAndTime=\"yesterday\" variableNamingConvention",
        );
        let told = refused(&folder, "date.fmu", date, NO_ENTRY);
        assert!(told.contains("came yesterday"), "{told}");
        // What `iwan` itself does not look at.
        let role = (
            DESCRIPTION,
            "variability=\"fixed\"",
            "variability=\"continuous\"",
        );
        let told = refused(&folder, "role.fmu", role, NO_ENTRY);
        assert!(told.contains("Illegal combination of causality"), "{told}");
        // What importers stop at: libcosim at a display unit that is not defined.
        let shown = (DESCRIPTION, "displayUnit=\"kN\"", "displayUnit=\"MN\"");
        let told = refused(&folder, "shown.fmu", shown, NO_ENTRY);
        let expected = "variable force: display unit MN is not defined";
        assert!(told.contains(expected), "{told}");
        let size = (DESCRIPTION, "nominal=\"", "nominal=\"-");
        let told = refused(&folder, "size.fmu", size, NO_ENTRY);
        assert!(told.contains(": nominal expected above 0"), "{told}");
        let on = (DESCRIPTION, "dependencies=\"", "dependencies=\"77 ");
        let told = refused(&folder, "on.fmu", on, NO_ENTRY);
        assert!(told.contains("77"), "{told}");
        let page = "documentation/index.html";
        let told = refused(&folder, "page.fmu", NO_CHANGE, page);
        assert!(told.contains(&format!("{page} is missing")), "{told}");
        let told = refused(&folder, "library.fmu", NO_CHANGE, "binaries/");
        let expected = "library.fmu: no library for this machine";
        assert!(told.contains(expected), "{told}");
        // A joint that was exchanged is told by the GUID that the XML still has.
        let joint = ("resources/joint.json", "1000.0", "1001.0");
        let told = refused(&folder, "joint-2.fmu", joint, NO_ENTRY);
        assert!(told.contains("the GUID in modelDescription.xml"), "{told}");
    }
}

/// Half a library has the head of a whole one, and the stamp: loaded it would end this program.
#[test]
fn a_library_that_is_cut_short_is_not_loaded() {
    for version in ["2", "3"] {
        let folder = exported_as(version, "cut", "[]", "force");
        let half = |name: &str, bytes: &mut Vec<u8>| {
            if name.starts_with("binaries/") {
                bytes.truncate(bytes.len() / 2);
            }
        };
        changed(&folder, "half.fmu", NO_ENTRY, half);
        let told = refused_as_it_is(&folder, "half.fmu");
        assert!(told.contains("half.fmu: library binaries/"), "{told}");
        assert!(told.contains("is cut short"), "{told}");
    }
}

/// What only FMI 3.0 has: a terminal, and a library under another folder.
#[test]
fn an_archive_of_fmi_3_whose_terminal_leads_nowhere_is_refused() {
    let folder = exported_as("3", "terminal", "[]", "force");
    let entry = "terminalsAndIcons/terminalsAndIcons.xml";
    let member = (entry, "variableName=\"force\"", "variableName=\"load\"");
    let told = refused(&folder, "member.fmu", member, NO_ENTRY);
    assert!(told.contains("there is no variable \"load\""), "{told}");
    let told = refused(&folder, "none.fmu", NO_CHANGE, entry);
    assert!(told.contains(&format!("{entry} is missing")), "{told}");
    let version = (DESCRIPTION, "fmiVersion=\"3.0\"", "fmiVersion=\"1.0\"");
    let told = refused(&folder, "one.fmu", version, NO_ENTRY);
    assert!(told.contains("is no archive of FMI 2.0 or 3.0"), "{told}");
}
