//! Whatever is wrong with what the user gives: exit status 2, a message that names file, line,
//! column and value, and not one file written, changed or left behind.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const HEADER: &str = "time [s],force [N],displacement [mm]\n";

/// A folder of its own for one test, empty, with a space and no ASCII in its name.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("bad input ß {name}"));
        let _ = std::fs::remove_dir_all(&path); // of an earlier run, if any
        std::fs::create_dir_all(&path).expect("a folder for test files");
        Folder(path)
    }

    fn put(&self, name: &str, content: &[u8]) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, content).expect("a test file");
        path
    }

    /// Every file in the folder with its content; folders with none.
    fn content(&self) -> BTreeMap<OsString, Option<Vec<u8>>> {
        let entries = std::fs::read_dir(&self.0).expect("the folder").flatten();
        entries
            .map(|entry| (entry.file_name(), std::fs::read(entry.path()).ok()))
            .collect()
    }

    fn run(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_iwan"))
            .current_dir(&self.0)
            .args(arguments)
            .output()
            .expect("the binary runs")
    }

    /// Runs, and holds the refusal against the promises.
    fn assert_refuses(&self, arguments: &[&str], words: &[&str]) {
        let before = self.content();
        let output = self.run(arguments);
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(
            output.stdout.is_empty(),
            "{arguments:?} prints a result all the same"
        );
        for word in words {
            assert!(
                message.contains(word),
                "{arguments:?}: no `{word}` in: {message}"
            );
        }
        assert!(
            !message.contains("iwan: defect"),
            "{arguments:?}: {message}"
        );
        assert_eq!(
            self.content(),
            before,
            "{arguments:?} leaves or changes files"
        );
    }
}

/// A joint that slips fully at 100 N: two sliders of 50 N.
const JOINT: &str = r#"{
  "format": "iwan-joint/1", "version": "0.1.0", "units": "SI",
  "density": {"family": "sliders", "elastic": 0.0,
              "weight": [1e6, 1e6], "slip_at": [1e-5, 9e-5]},
  "series_stiffness": 1e7,
  "causes": []
}"#;

#[test]
fn bad_records_are_refused_by_every_command_that_reads_them() {
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "0,1,2\n1,NaN,2\n",
            "nan",
            &["line 3", "column 2 `force [N]`", "`NaN`"],
        ),
        (
            "0,1,2\n1,2,abc\n",
            "text",
            &["line 3", "column 3 `displacement [mm]`", "`abc`"],
        ),
        ("0,1,2\n1,,2\n", "gap", &["line 3", "column 2", "empty"]),
        (
            "0,1,2\n2,1,2\n1,1,2\n",
            "back",
            &["line 4", "column 1 `time [s]`", "2 s to 1 s"],
        ),
        (
            "0,1,2\n0,1,2\n",
            "repeated",
            &["line 3", "column 1", "time 0 s"],
        ),
        ("0,1,2\n1,2\n", "ragged", &["line 3", "`1,2`"]),
        ("", "header only", &["line 1", "no row"]),
    ];
    let folder = Folder::new("records");
    folder.put("joint.json", JOINT.as_bytes());
    folder.put("kept.json", b"precious");
    folder.put("kept.csv", b"precious");
    let mut files: Vec<(String, Vec<u8>, Vec<&str>)> = cases
        .iter()
        .map(|(rows, name, words)| {
            (
                format!("{name} ü.csv"),
                format!("{HEADER}{rows}").into_bytes(),
                words.to_vec(),
            )
        })
        .collect();
    let whole: [(&str, &[u8], &[&str]); 6] = [
        ("empty.csv", b"", &["empty"]),
        ("comments.csv", b"# nothing\n\n", &["nothing but comments"]),
        (
            "one column.csv",
            b"force [N]\n1\n2\n",
            &["line 1", "one column", "`force [N]`"],
        ),
        (
            "unit.csv",
            b"time [s],force [stone],u [m]\n0,1,2\n",
            &["line 1", "column 2", "`stone`"],
        ),
        ("no header.csv", b"0,1,2\n1,2,3\n", &["line 1", "--columns"]),
        ("binary.csv", b"PK\x03\x04\0\0\0\0", &["binary"]),
    ];
    for (name, content, words) in whole {
        files.push((name.to_string(), content.to_vec(), words.to_vec()));
    }
    for (name, content, words) in &files {
        let path = folder.put(name, content);
        let words: Vec<&str> = words.iter().copied().chain([name.as_str()]).collect();
        let name = name.as_str();
        folder.assert_refuses(&["simulate", "joint.json", name, "-o", "kept.csv"], &words);
        folder.assert_refuses(&["simulate", "joint.json", name, "-o", "new.csv"], &words);
        folder.assert_refuses(&["identify", name, "-o", "kept.json"], &words);
        folder.assert_refuses(&["identify", name, "-o", "new.json"], &words);
        folder.assert_refuses(&["diagnose", name, "-o", "result"], &words);
        std::fs::remove_file(path).expect("the test file");
    }
}

#[test]
fn paths_that_do_not_serve_are_refused() {
    let folder = Folder::new("paths");
    folder.put("joint.json", JOINT.as_bytes());
    folder.put("load.csv", b"t [s],F [N],u [mm]\n0,0,0\n1,50,0.01\n");
    folder.put("copy.csv", b"t [s],F [N],u [mm]\n0,0,0\n1,50,0.01\n");
    std::fs::create_dir(folder.0.join("folder")).expect("a folder");
    let cases: &[(&[&str], &[&str])] = &[
        (
            &["simulate", "none.json", "load.csv", "-o", "o.csv"],
            &["none.json", "no such file"],
        ),
        (
            &["simulate", "joint.json", "none.csv", "-o", "o.csv"],
            &["none.csv", "no such file"],
        ),
        (
            &["simulate", "folder", "load.csv", "-o", "o.csv"],
            &["folder", "joint.json in it"],
        ),
        (
            &["simulate", "joint.json", "folder", "-o", "o.csv"],
            &["this is a folder"],
        ),
        (
            &["simulate", "joint.json", "load.csv", "-o", "folder"],
            &["this is a folder"],
        ),
        (
            &["simulate", "joint.json", "load.csv", "-o", "no/o.csv"],
            &["no folder `no`"],
        ),
        (
            &["simulate", "joint.json", "load.csv", "-o", "load.csv"],
            &["load.csv", "an input"],
        ),
        (
            &["simulate", "joint.json", "load.csv", "-o", "./joint.json"],
            &["an input"],
        ),
        (
            &["identify", "none.csv", "-o", "o.json"],
            &["none.csv", "no such file"],
        ),
        (
            &["identify", "folder", "-o", "o.json"],
            &["this is a folder"],
        ),
        (
            &["identify", "load.csv", "-o", "no/o.json"],
            &["no folder `no`"],
        ),
        (&["identify", "load.csv", "-o", "load.csv"], &["an input"]),
        (
            &["identify", "load.csv", "copy.csv", "-o", "o.json"],
            &["copy.csv", "same content"],
        ),
        (
            &["diagnose", "none.csv", "-o", "result"],
            &["none.csv", "no such file"],
        ),
        (
            &["diagnose", "load.csv", "-o", "load.csv/result"],
            &["`load.csv` is a file"],
        ),
        (
            &["diagnose", "load.csv", "-o", "load.csv"],
            &["this is a file"],
        ),
        (&["causes", "loose_bolt"], &["`loose_bolt`", "pinning"]),
    ];
    for (arguments, words) in cases {
        folder.assert_refuses(arguments, words);
    }
}

#[test]
fn bad_usage_is_refused() {
    let folder = Folder::new("usage");
    folder.put("joint.json", JOINT.as_bytes());
    folder.put("load.csv", b"t [s],F [N],u [mm]\n0,0,0\n1,50,0.01\n");
    let simulate = |further: &[&str], words: &[&str]| {
        let command = ["simulate", "joint.json", "load.csv", "-o", "o.csv"];
        folder.assert_refuses(&[&command[..], further].concat(), words);
    };
    folder.assert_refuses(&[], &["Usage"]);
    folder.assert_refuses(&["tighten"], &["tighten"]);
    folder.assert_refuses(&["simulate", "joint.json", "load.csv"], &["--output"]);
    folder.assert_refuses(&["identify"], &["RECORD"]);
    simulate(&["--drive", "torque"], &["torque", "displacement"]);
    simulate(&["--columns", "force"], &["--columns `force`", "force=2"]);
    simulate(&["--columns", ""], &["--columns", "nothing is named"]);
    simulate(&["--units", " , "], &["--units", "nothing is named"]);
    simulate(
        &["--columns", "force=9"],
        &["load.csv, line 1", "force in column 9", "3 `u [mm]`"],
    );
    simulate(&["--columns", "force=0"], &["counted from 1"]);
    let twice = ["--columns", "force=2,displacement=2"];
    simulate(
        &twice,
        &["column 2 `F [N]`", "for force and for displacement"],
    );
    simulate(
        &["--columns", "time=1,force=9"],
        &["load.csv", "column 9", "2 `F [N]`"],
    );
    simulate(&["--units", "force=stone"], &["`stone`", "kN"]);
    folder.put("alone.csv", b"force [N]\n0\n50\n");
    folder.assert_refuses(
        &["simulate", "joint.json", "alone.csv", "-o", "o.csv"],
        &[
            "alone.csv, line 1",
            "a load needs time, and force or displacement",
        ],
    );
    let no_displacement = ["--columns", "time=1,force=2", "--drive", "displacement"];
    simulate(&no_displacement, &["load.csv", "no column displacement"]);
}

#[test]
fn a_force_beyond_full_slip_is_refused_at_its_line() {
    let folder = Folder::new("full slip");
    folder.put("joint.json", JOINT.as_bytes());
    folder.put("load.csv", b"# ramp\nF [kN],t [s]\n0,0\n0.05,1\n0.15,2\n");
    folder.put("kept.csv", b"precious");
    let words = [
        "load.csv, line 5, column 1 `F [kN]`",
        "150 N",
        "full slip at 100 N",
    ];
    folder.assert_refuses(
        &["simulate", "joint.json", "load.csv", "-o", "kept.csv"],
        &words,
    );
    folder.assert_refuses(
        &["simulate", "joint.json", "load.csv", "-o", "new.csv"],
        &words,
    );
}

/// A slider of 500 N beside a spring, and a cube across the joint that softens it.
#[test]
fn a_force_that_a_softening_joint_does_not_carry_is_refused_at_its_line() {
    let folder = Folder::new("softening");
    let softening = r#"[{"name": "cubic_stiffness",
        "parameters": {"cubic_compliance": 0, "across": -1e15}}]"#;
    let joint = JOINT
        .replace("\"elastic\": 0.0", "\"elastic\": 5e7")
        .replace("[1e6, 1e6]", "[5e7]")
        .replace("[1e-5, 9e-5]", "[1e-5]")
        .replace("1e7", "2e8")
        .replace("[]", softening);
    folder.put("joint.json", joint.as_bytes());
    folder.put("load.csv", b"t [s],F [N]\n0,0\n1,2970\n2,4950\n3,9900\n");
    let words = [
        "load.csv, line 4, column 2 `F [N]`",
        "no displacement answers 4950 N at t = 2 s",
        "`cubic_stiffness` lets the joint carry about 3479.2 N",
    ];
    folder.assert_refuses(
        &["simulate", "joint.json", "load.csv", "-o", "new.csv"],
        &words,
    );
}

#[test]
fn a_damaged_joint_is_refused() {
    let folder = Folder::new("joint");
    folder.put("load.csv", b"t [s],F [N]\n0,0\n1,50\n");
    let refuse = |content: &[u8], words: &[&str]| {
        folder.put("joint ä.json", content);
        let words: Vec<&str> = words.iter().copied().chain(["joint ä.json"]).collect();
        folder.assert_refuses(
            &["simulate", "joint ä.json", "load.csv", "-o", "o.csv"],
            &words,
        );
    };
    for kept in [0, 1, JOINT.len() / 4, JOINT.len() / 2, JOINT.len() - 1] {
        refuse(&JOINT.as_bytes()[..kept], &["cut short"]);
    }
    refuse(b"\xff\xfe\x00", &["UTF-8"]);
    refuse(b"[1, 2]", &["object"]);
    refuse(
        JOINT.replace("sliders", "springs").as_bytes(),
        &["$.density.family", "springs"],
    );
    refuse(
        JOINT.replace("1e7", "-1e7").as_bytes(),
        &["series_stiffness", "-1e7", "above 0"],
    );
    refuse(
        JOINT.replace("\"SI\"", "\"US\"").as_bytes(),
        &["$.units", "US"],
    );
    let unknown = JOINT.replace("[]", r#"[{"name": "loose_bolt", "parameters": {}}]"#);
    refuse(unknown.as_bytes(), &["$.causes", "loose_bolt"]);
    let twice = JOINT.replace("\"causes\"", "\"series_stiffness\": 1e8, \"causes\"");
    refuse(
        twice.as_bytes(),
        &["json:6:3: $.series_stiffness is there twice"],
    );
}

/// The results of a diagnosis have fixed names, under which something else may stand.
#[test]
fn a_diagnosis_replaces_no_input_and_no_measurement() {
    let folder = Folder::new("results");
    let rows = format!("{HEADER}0,0,0\n1,50,0.01\n2,-50,-0.01\n");
    for name in ["next_experiment.csv", "report.html", "joint.json"] {
        let path = folder.put(name, rows.as_bytes());
        folder.put("other.csv", b"t [s],F [N],u [mm]\n0,0,0\n1,50,0.01\n");
        let here = format!("./{name}");
        let words = [name, "this is an input", "another folder"];
        folder.assert_refuses(&["diagnose", name, "-o", "."], &words);
        folder.assert_refuses(&["diagnose", "other.csv", &here, "-o", "."], &words);
        let dummy = ["diagnose", "other.csv", "--dummy", name, "-o", "."];
        folder.assert_refuses(&dummy, &words);
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(name, folder.0.join("link.csv")).expect("a link");
            folder.assert_refuses(&["diagnose", "link.csv", "-o", "."], &words);
            std::fs::remove_file(folder.0.join("link.csv")).expect("the link");
        }
        std::fs::remove_file(path).expect("the test file");
    }
    // What was measured under the program of an earlier diagnosis stays, whether it is given or not.
    folder.put("next_experiment.csv", rows.as_bytes());
    let words = ["next_experiment.csv", "no load program", "another folder"];
    folder.assert_refuses(&["diagnose", "other.csv", "-o", "."], &words);
}

/// Before anything is read, so that no hour of computing is lost.
#[test]
fn a_place_that_takes_no_results_is_told_first() {
    let folder = Folder::new("no place");
    let long = "x".repeat(300);
    let inside = format!("new/{long}");
    let words = [long.as_str(), "cannot make this folder"];
    folder.assert_refuses(&["diagnose", "none.csv", "-o", &long], &words);
    folder.assert_refuses(&["diagnose", "none.csv", "-o", &inside], &words);
    let words = [long.as_str(), "cannot write"];
    folder.assert_refuses(&["identify", "none.csv", "-o", &long], &words);
    std::fs::create_dir_all(folder.0.join("result/report.html")).expect("a folder");
    let words = ["report.html", "this is a folder"];
    folder.assert_refuses(&["diagnose", "none.csv", "-o", "result"], &words);
}

/// A stepped sine of a joint that slips; `sign` of its displacement.
fn loops(sign: f64, scale: f64) -> String {
    let rows = (0..300).map(|i| {
        let phase = 0.1 * f64::from(i);
        let displacement = sign * (0.01 * phase.sin() - 0.002 * phase.cos());
        let (force, displacement) = (scale * 50.0 * phase.sin(), scale * displacement);
        format!("{:?},{force:?},{displacement:?}\n", 0.01 * f64::from(i))
    });
    HEADER.to_string() + &rows.collect::<String>()
}

#[test]
fn records_that_no_joint_makes_are_refused_before_any_fit() {
    let folder = Folder::new("no joint");
    folder.put("good.csv", loops(1.0, 1.0).as_bytes());
    folder.put("one.csv", loops(-1.0, 1.0).as_bytes());
    folder.put("two.csv", loops(-1.0, 2.0).as_bytes());
    let words = ["one.csv, two.csv", "falls where the force rises", "sign"];
    let records = ["good.csv", "one.csv", "two.csv", "-o", "new"];
    folder.assert_refuses(&[&["identify"], &records[..]].concat(), &words);
    folder.assert_refuses(&[&["diagnose"], &records[..]].concat(), &words);
    let dummy = ["diagnose", "good.csv", "--dummy", "two.csv", "-o", "new"];
    folder.assert_refuses(&dummy, &["two.csv", "falls where the force rises"]);
    folder.put("huge.csv", loops(1.0, 1e200).as_bytes());
    let words = [
        "huge.csv, line 2, column 3 `displacement [mm]`",
        "beyond all",
        "unit",
    ];
    folder.assert_refuses(&["identify", "huge.csv", "-o", "new"], &words);
    folder.put("tiny.csv", loops(1.0, 1e-200).as_bytes());
    let words = [
        "tiny.csv, line",
        "column 2 `force [N]`",
        "too small",
        "unit",
    ];
    folder.assert_refuses(&["diagnose", "tiny.csv", "-o", "new"], &words);
    folder.put(
        "short.csv",
        format!("{HEADER}0,0,0\n1,50,0.01\n").as_bytes(),
    );
    let words = ["short.csv", "2 samples are too few", "whole test"];
    folder.assert_refuses(&["identify", "short.csv", "-o", "new"], &words);
}

/// Of a few samples neither signs nor rest are known.
#[test]
fn the_count_of_samples_is_looked_at_before_what_they_say() {
    let folder = Folder::new("few samples");
    folder.put("good.csv", loops(1.0, 1.0).as_bytes());
    for (count, said) in [(1, "1 sample is"), (4, "4 samples are")] {
        let backwards = loops(-1.0, 1.0);
        let rows: Vec<&str> = backwards.lines().take(1 + count).collect();
        folder.put("few.csv", rows.join("\n").as_bytes());
        let identify = ["few.csv", said, "at least 20"];
        folder.assert_refuses(&["identify", "few.csv", "-o", "new"], &identify);
        let diagnose = ["few.csv", said, "at least 64"];
        folder.assert_refuses(&["diagnose", "good.csv", "few.csv", "-o", "new"], &diagnose);
        let dummy = ["diagnose", "good.csv", "--dummy", "few.csv", "-o", "new"];
        folder.assert_refuses(&dummy, &diagnose);
    }
}

#[test]
fn a_loss_beyond_the_rectangle_of_its_amplitudes_is_refused() {
    let folder = Folder::new("rectangle");
    let table = |unit: &str| {
        let header = format!("# rig\nforce amplitude [N],dissipation [{unit}]");
        let levels = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|f: f64| {
            let loss = 1e-3 * f.powf(2.6);
            format!("{f},{loss:e},{:e}\n", 1e-3 * f)
        });
        format!("{header},displacement amplitude [mm]\n{}", levels.concat())
    };
    folder.put("table.csv", table("J").as_bytes());
    let words = [
        "table.csv, line 3, column 2 `dissipation [J]`",
        "0.001 J a cycle is more than 4.000e-6 J",
        "check the unit of dissipation and of displacement amplitude",
    ];
    folder.assert_refuses(&["identify", "table.csv", "-o", "new"], &words);
    folder.assert_refuses(&["diagnose", "table.csv", "-o", "new"], &words);
    folder.put("table.csv", table("uJ").as_bytes());
    let right = folder.run(&["identify", "table.csv", "-o", "joint.json"]);
    assert_eq!(right.status.code(), Some(0), "{right:?}");
}

#[test]
fn values_that_no_file_has_a_use_for_are_refused() {
    let folder = Folder::new("no use");
    folder.put("loops.csv", loops(1.0, 1.0).as_bytes());
    let levels = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].map(|f: f64| {
        let loss = 1e-9 * f.powf(2.6);
        format!("{f},{loss:e},{:e}\n", 1e-6 * f)
    });
    let header = "force amplitude [N],dissipation [J],displacement amplitude [m]\n";
    folder.put(
        "table.csv",
        (header.to_string() + &levels.concat()).as_bytes(),
    );
    for command in ["identify", "diagnose"] {
        let refuse = |file: &str, option: &str, value: &str, words: &[&str]| {
            folder.assert_refuses(&[command, file, option, value, "-o", "new"], words);
        };
        for option in ["--stiffness", "--modal-mass"] {
            refuse("loops.csv", option, "1e6", &[option, "time history"]);
            refuse("loops.csv", option, "-5", &["-5", "above zero"]);
        }
        refuse(
            "table.csv",
            "--stiffness",
            "1e6",
            &["--stiffness", "displacement"],
        );
        refuse(
            "table.csv",
            "--modal-mass",
            "1",
            &["--modal-mass", "resonance"],
        );
    }
    let limit = ["diagnose", "loops.csv", "--limit-force", "-5", "-o", "new"];
    folder.assert_refuses(&limit, &["'-5'", "above zero"]);
}

/// `iwan causes > /dev/full`: no defect of the program.
#[cfg(target_os = "linux")]
#[test]
fn a_full_standard_output_is_told() {
    let folder = Folder::new("full");
    let joint = folder.put("joint.json", JOINT.as_bytes());
    let load = folder.put("load.csv", b"t [s],F [N]\n0,0\n1,50\n");
    let (joint, load) = (joint.to_string_lossy(), load.to_string_lossy());
    for arguments in [
        &["causes"][..],
        &["--help"],
        &["simulate", &joint, &load, "-o", "-"],
    ] {
        let full = std::fs::File::options().write(true).open("/dev/full");
        let output = Command::new(env!("CARGO_BIN_EXE_iwan"))
            .args(arguments)
            .stdout(full.expect("a device of Linux"))
            .output()
            .expect("the binary runs");
        let message = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(
            message.contains("standard output"),
            "{arguments:?}: {message}"
        );
    }
    let words = ["/dev/full: cannot write"];
    folder.assert_refuses(&["simulate", &joint, &load, "-o", "/dev/full"], &words);
}

/// `2>&1 | head` closes standard error before the last message: work is done and status told all the same.
#[cfg(unix)]
#[test]
fn messages_may_go_unread() {
    use std::process::Stdio;
    let folder = Folder::new("unread");
    let bolt = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/bolt-1.csv");
    let bolt = bolt.to_str().expect("a path of this repository");
    for (arguments, status) in [
        (vec!["identify", bolt, "-o", "joint.json"], 0),
        (vec!["diagnose", bolt, "-o", "result"], 0),
        (vec!["diagnose", "nowhere.csv", "-o", "result"], 2),
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_iwan"));
        command.current_dir(&folder.0).args(&arguments);
        let pipes = command.stdout(Stdio::null()).stderr(Stdio::piped());
        let mut running = pipes.spawn().expect("the binary runs");
        drop(running.stderr.take());
        let ended = running.wait().expect("an end").code();
        assert_eq!(ended, Some(status), "{arguments:?}");
    }
    assert!(folder.0.join("joint.json").exists());
    assert!(folder.0.join("result/diagnosis.json").exists());
}
