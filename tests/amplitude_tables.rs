//! Amplitude tables through the two commands: tables of closed forms that no code of the crate made,
//! and the bolted beam's where it is at hand.

use iwan::diagnose::amplitude_table::{TableFindings, diagnose_tables};
use iwan::diagnose::findings::{Estimate, Verdict};
use iwan::identify::table::Known;
use iwan::joint::{Drive, Joint};
use iwan::record::AmplitudeTable;
use serde_json::Value;
use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

mod measured;

/// A power-law joint with χ = −0.4 in micro-slip, closed form: `G = K u − B u^(χ+2)`, loss of a
/// settled loop `4 d(u)` with `d = B (χ+1) u^(χ+3)/(χ+3)`.
const CHI: f64 = -0.4;
const STIFFNESS: f64 = 4e6;
const LEVELS: [f64; 10] = [1.0, 1.4, 1.9, 2.6, 3.5, 4.7, 6.3, 8.4, 11.0, 14.0];

fn power_law(micrometres: f64) -> (f64, f64, f64) {
    let u = 1e-6 * micrometres;
    // a fifth of the stiffness is gone at 14 µm
    let bend = 0.2 * STIFFNESS / ((CHI + 2.0) * 14e-6_f64.powf(CHI + 1.0));
    let force = STIFFNESS * u - bend * u.powf(CHI + 2.0);
    let loss = 4.0 * bend * (CHI + 1.0) * u.powf(CHI + 3.0) / (CHI + 3.0);
    (u, force, loss)
}

/// Relative errors of a fixed pattern without trend, about one standard deviation each.
fn wobble(row: usize) -> f64 {
    [0.7, -1.2, 0.3, 1.4, -0.9, -0.4, 1.1, -1.3, 0.8, -0.5][row % 10]
}

fn table(extra_force: impl Fn(f64) -> f64, extra_loss: impl Fn(f64) -> f64) -> AmplitudeTable {
    let rows: Vec<(f64, f64, f64)> = LEVELS
        .iter()
        .enumerate()
        .map(|(row, &level)| {
            let (u, force, loss) = power_law(level);
            let force = (force + extra_force(u)) * (1.0 + 5e-4 * wobble(row));
            (
                u,
                force,
                (loss + extra_loss(u)) * (1.0 + 5e-3 * wobble(row + 3)),
            )
        })
        .collect();
    AmplitudeTable {
        name: "table".into(),
        force_amplitude: rows.iter().map(|row| row.1).collect(),
        dissipation: rows.iter().map(|row| row.2).collect(),
        displacement_amplitude: Some(rows.iter().map(|row| row.0).collect()),
        frequency: Some(vec![20.0; rows.len()]),
    }
}

fn diagnosed(table: &AmplitudeTable) -> TableFindings {
    diagnose_tables(std::slice::from_ref(table), &Known::default(), |_| {}).expect("ten levels")
}

/// Loss and force amplitude of the third cycle of a sine of that displacement.
fn loop_of(joint: &Joint, amplitude: f64, hertz: f64) -> (f64, f64) {
    let count = 2000;
    let time: Vec<f64> = (0..=3 * count)
        .map(|i| f64::from(i) / (f64::from(count) * hertz))
        .collect();
    let sine: Vec<f64> = time
        .iter()
        .map(|t| amplitude * (2.0 * PI * hertz * t).sin())
        .collect();
    let answer = joint
        .simulate(Drive::Displacement, &time, &sine)
        .expect("a sine");
    let last = &answer[2 * count as usize..];
    let force = last.iter().map(|a| a.force).fold(0.0, f64::max);
    (
        last[last.len() - 1].dissipation - last[0].dissipation,
        force,
    )
}

#[test]
fn a_table_of_slip_alone_is_clean_and_its_joint_has_its_loops() {
    let table = table(|_| 0.0, |_| 0.0);
    let found = diagnosed(&table);
    assert_eq!(
        found.findings.verdict,
        Verdict::Clean,
        "{}",
        found.findings.summary
    );
    assert_eq!(found.missing, None);
    for level in [2.2, 7.3] {
        let (u, force, loss) = power_law(level);
        let (lost, reached) = loop_of(&found.findings.joint, u, 20.0);
        assert!((lost / loss - 1.0).abs() < 0.03, "{level}: {}", lost / loss);
        assert!(
            (reached / force - 1.0).abs() < 0.003,
            "{level}: {}",
            reached / force
        );
    }
}

#[test]
fn a_dashpot_beside_slip_is_named_with_its_coefficient() {
    // As much loss again at 5 µm as slip has.
    let coefficient = power_law(5.0).2 / (PI * 2.0 * PI * 20.0 * 5e-6_f64.powi(2));
    let viscous = |u: f64| PI * coefficient * 2.0 * PI * 20.0 * u * u;
    let found = diagnosed(&table(|_| 0.0, viscous)).findings;
    assert_eq!(found.verdict, Verdict::Explained, "{}", found.summary);
    assert_eq!(found.causes[0].name, "viscous_damping");
    let value = found.causes[0].parameters[0].value;
    assert!(
        (value / coefficient - 1.0).abs() < 0.2,
        "{value} for {coefficient}"
    );
    assert!(found.gain.0 < 0.7, "{:?}", found.gain);
}

#[test]
fn a_bolt_that_meets_its_hole_is_named_with_its_gap() {
    let (gap, stiffness) = (5e-6, 0.3 * STIFFNESS);
    let found = diagnosed(&table(|u| stiffness * (u - gap).max(0.0), |_| 0.0)).findings;
    assert_eq!(found.causes[0].name, "pinning", "{}", found.summary);
    let values: Vec<f64> = found.causes[0].parameters.iter().map(|p| p.value).collect();
    assert!((values[0] / stiffness - 1.0).abs() < 0.3, "{values:?}");
    assert!((values[1] / gap - 1.0).abs() < 0.2, "{values:?}");
    // Gaps are those of a grid, and unlike sides do not show: of the stiffness alone there is scatter.
    let bounded = |p: &&Estimate| p.interval.is_some();
    let bounded: Vec<_> = found.causes[0].parameters.iter().filter(bounded).collect();
    assert!(
        bounded.len() == 1 && bounded[0].name == "stiffness",
        "{bounded:?}"
    );
    let (_, force) = loop_of(&found.joint, 12e-6, 20.0);
    let expected = power_law(12.0).1 + stiffness * (12e-6 - gap);
    assert!(
        (force / expected - 1.0).abs() < 0.01,
        "{force} for {expected}"
    );
}

#[test]
fn without_displacement_the_loss_alone_is_judged_and_the_missing_stiffness_asked_for() {
    let whole = table(|_| 0.0, |_| 0.0);
    let bare = AmplitudeTable {
        displacement_amplitude: None,
        frequency: None,
        ..whole
    };
    let found = diagnosed(&bare);
    assert_eq!(found.findings.verdict, Verdict::Clean);
    assert!(found.missing.is_some_and(|why| why.contains("--stiffness")));
    let known = Known {
        stiffness: Some(STIFFNESS),
        ..Known::default()
    };
    let given = diagnose_tables(&[bare], &known, |_| {}).expect("ten levels");
    assert_eq!(given.missing, None);
    let (u, force, loss) = power_law(7.3);
    let joint = &given.findings.joint;
    let (lost, reached) = loop_of(joint, u, 20.0);
    assert!((reached / force - 1.0).abs() < 0.02, "{}", reached / force);
    assert!((lost / loss - 1.0).abs() < 0.1, "{}", lost / loss);
}

#[test]
fn repeats_and_too_few_levels_are_admitted_or_refused() {
    let whole = table(|_| 0.0, |_| 0.0);
    let twice = |values: &[f64]| {
        values
            .iter()
            .flat_map(|v| [*v, *v * 1.001])
            .collect::<Vec<_>>()
    };
    let doubled = AmplitudeTable {
        force_amplitude: twice(&whole.force_amplitude),
        displacement_amplitude: whole.displacement_amplitude.as_deref().map(twice),
        dissipation: twice(&whole.dissipation),
        frequency: None,
        ..whole.clone()
    };
    let found = diagnosed(&doubled).findings;
    assert!(found.causes.is_empty(), "{}", found.summary);
    // Nor is there a slope between repeats.
    let slopes = |table: &AmplitudeTable| {
        let notes = diagnosed(table).findings.notes;
        let said = notes
            .iter()
            .find(|note| note.starts_with("Slope of log loss"));
        let numbers = said.expect("slopes").split([' ', ':', ',']);
        let found: Vec<f64> = numbers.filter_map(|n| n.parse().ok()).collect();
        (found[0], found[1])
    };
    let noisy = AmplitudeTable {
        dissipation: doubled
            .dissipation
            .iter()
            .enumerate()
            .map(|(i, loss)| loss * [1.0, 1.02][i % 2])
            .collect(),
        ..doubled.clone()
    };
    let (one, other) = (slopes(&whole), slopes(&noisy));
    assert!((one.0 - other.0).abs() < 0.2, "{one:?} {other:?}");
    assert!((one.1 - other.1).abs() < 0.2, "{one:?} {other:?}");
    // One level read six times is one level; without a loss it is none.
    let refusal = |table: AmplitudeTable| {
        let refused = diagnose_tables(&[table], &Known::default(), |_| {});
        refused.expect_err("too few levels").to_string()
    };
    let level = |i: usize| 1.0 + 2e-4 * i as f64;
    let one_level = AmplitudeTable {
        force_amplitude: (0..6).map(|i| 100.0 * level(i)).collect(),
        displacement_amplitude: Some((0..6).map(|i| 1e-5 * level(i)).collect()),
        dissipation: (0..6).map(|i| 1e-5 * level(i)).collect(),
        ..AmplitudeTable::default()
    };
    assert!(refusal(one_level).contains("the table has 1 level(s)"));
    let mut idle = whole.clone();
    idle.dissipation[4..].fill(0.0);
    assert!(refusal(idle).contains("the table has 4 level(s)"));
    let short = AmplitudeTable {
        name: "short".into(),
        force_amplitude: vec![1.0, 2.0],
        dissipation: vec![1e-6, 8e-6],
        ..AmplitudeTable::default()
    };
    let refused = diagnose_tables(&[short], &Known::default(), |_| {});
    assert!(refused.is_err_and(|error| error.to_string().contains("at least 5")));
}

/// At resonance without frequencies the stiffness given is no measurement of how it changes.
#[test]
fn a_resonance_without_frequencies_takes_the_stiffness_as_given() {
    let whole = table(|_| 0.0, |_| 0.0);
    let moved = whole.displacement_amplitude.clone().expect("displacements");
    let exciter = whole
        .dissipation
        .iter()
        .zip(&moved)
        .map(|(d, x)| d / (PI * x));
    let bare = AmplitudeTable {
        force_amplitude: exciter.collect(),
        frequency: None,
        ..whole
    };
    assert!(
        diagnosed(&bare)
            .missing
            .is_some_and(|why| why.contains("--stiffness"))
    );
    let known = Known {
        stiffness: Some(STIFFNESS),
        ..Known::default()
    };
    let given = diagnose_tables(&[bare], &known, |_| {}).expect("ten levels");
    assert_eq!(given.missing, None);
    assert!(
        given.findings.causes.is_empty(),
        "{}",
        given.findings.summary
    );
    let (u, _, loss) = power_law(7.3);
    let (lost, _) = loop_of(&given.findings.joint, u, 20.0);
    assert!((lost / loss - 1.0).abs() < 0.03, "{}", lost / loss);
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("amplitude tables {name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

fn iwan(arguments: &[&str], folder: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_iwan"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program runs")
}

#[test]
fn the_commands_read_a_table_and_say_what_is_missing() {
    let folder = folder("commands");
    let rows: Vec<String> = LEVELS
        .iter()
        .map(|&level| power_law(level))
        .map(|(_, force, loss)| format!("{force:e},{loss:e}"))
        .collect();
    let text = format!("force amplitude [N],dissipation [J]\n{}\n", rows.join("\n"));
    fs::write(folder.join("table.csv"), text).expect("written");
    let bare = iwan(&["identify", "table.csv"], &folder);
    assert_eq!(bare.status.code(), Some(0), "{bare:?}");
    assert!(String::from_utf8_lossy(&bare.stderr).contains("--stiffness"));
    let asked = iwan(&["identify", "table.csv", "-o", "joint.json"], &folder);
    assert_eq!(asked.status.code(), Some(2), "{asked:?}");
    let told = String::from_utf8_lossy(&asked.stderr).into_owned();
    assert!(told.contains("joint.json: there is no joint"), "{told}");
    assert!(told.contains("--stiffness"), "{told}");
    assert!(asked.stdout.is_empty());
    assert!(!folder.join("joint.json").exists());
    let given = iwan(
        &[
            "identify",
            "table.csv",
            "--stiffness",
            "4e6",
            "-o",
            "joint.json",
        ],
        &folder,
    );
    assert_eq!(given.status.code(), Some(0), "{given:?}");
    assert!(folder.join("joint.json").exists());
    let printed = String::from_utf8_lossy(&given.stdout);
    assert!(!printed.contains("NaN"), "{printed}");
    let refused = iwan(
        &["identify", "table.csv", "--stiffness=-1", "-o", "x.json"],
        &folder,
    );
    assert_eq!(refused.status.code(), Some(2));
    let diagnosed = iwan(
        &[
            "diagnose",
            "table.csv",
            "--stiffness",
            "4e6",
            "-o",
            "result",
        ],
        &folder,
    );
    assert_eq!(diagnosed.status.code(), Some(0), "{diagnosed:?}");
    for file in ["report.html", "diagnosis.json", "joint.json"] {
        assert!(folder.join("result").join(file).exists(), "{file}");
    }
    let text = fs::read_to_string(folder.join("result/diagnosis.json")).expect("diagnosis.json");
    let diagnosis: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(diagnosis["schema"], "iwan-diagnosis/1");
    assert_eq!(diagnosis["verdict"], "clean");
}

/// A table without displacement makes no joint: what stands in the folder beside its findings was of
/// an earlier diagnosis, or of somebody else.
#[test]
fn a_diagnosis_takes_away_only_what_one_wrote() {
    let folder = folder("earlier");
    let table = |name: &str, scale: f64| {
        let rows = LEVELS
            .map(power_law)
            .map(|(_, force, loss)| (scale * force, loss));
        let rows = rows.map(|(force, loss)| format!("{force:e},{loss:e}\n"));
        let text = "force amplitude [N],dissipation [J]\n".to_string() + &rows.concat();
        fs::write(folder.join(name), text).expect("written");
    };
    table("table.csv", 1.0);
    let result = folder.join("result");
    fs::create_dir(&result).expect("a folder");
    let program = "# 2 cycles of sine, amplitude 180 N, 5.03 Hz\ntime [s],force [N]\n0.0,0.0\n";
    let put = |name: &str, text: &str| fs::write(result.join(name), text).expect("written");
    put("joint.json", "of somebody else");
    put("next_experiment.csv", program);
    let diagnosed = iwan(&["diagnose", "table.csv", "-o", "result"], &folder);
    assert_eq!(diagnosed.status.code(), Some(0), "{diagnosed:?}");
    assert!(result.join("joint.json").exists());
    assert!(!result.join("next_experiment.csv").exists());
    assert!(String::from_utf8_lossy(&diagnosed.stderr).contains("joint.json is of no diagnosis"));
    let again = iwan(&["diagnose", "table.csv", "-o", "result"], &folder);
    assert_eq!(again.status.code(), Some(0), "{again:?}");
    assert!(!result.join("joint.json").exists());
    assert!(String::from_utf8_lossy(&again.stderr).contains("earlier diagnosis is removed"));
}

/// The resonance of the bolted beam falls and rises again. With the modal mass its own joint is
/// formed; no Iwan network alone has these levels.
#[test]
fn the_bolted_beam_stiffens_where_no_network_does() {
    let Some(data) = measured::records() else {
        return;
    };
    let file = data.join("brake_reuss_beam/mode1_amplitude_table.csv");
    let file = file.to_str().expect("a path in UTF-8");
    let folder = folder("beam");
    let bare = iwan(&["diagnose", file, "-o", "bare"], &folder);
    assert_eq!(bare.status.code(), Some(0), "{bare:?}");
    assert!(!folder.join("bare/joint.json").exists());
    assert!(String::from_utf8_lossy(&bare.stderr).contains("--modal-mass"));
    let given = iwan(
        &["diagnose", file, "--modal-mass", "1", "-o", "given"],
        &folder,
    );
    assert_eq!(given.status.code(), Some(0), "{given:?}");
    assert!(folder.join("given/joint.json").exists());
    let text = fs::read_to_string(folder.join("given/diagnosis.json")).expect("diagnosis.json");
    let diagnosis: Value = serde_json::from_str(&text).expect("JSON");
    assert_ne!(diagnosis["verdict"], "clean");
}
