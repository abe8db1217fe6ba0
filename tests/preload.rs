//! Measured preloads: tests of different preloads are no tests of one joint, and both commands say so.

mod bundled;

use std::path::PathBuf;
use std::process::Command;

/// Two parts of a bundled record, at the preloads of `preload`.
fn records(name: &str, preload: [f64; 2]) -> PathBuf {
    let (folder, _, header, rows) = bundled::bolt(&format!("preload {name}"));
    for (number, preload) in preload.iter().enumerate() {
        let part = &rows[..rows.len() - number];
        let part = part.iter().map(|row| format!("{row},{preload}\n"));
        let text = format!("{header},preload [kN]\n{}", part.collect::<String>());
        std::fs::write(folder.join(format!("test-{number}.csv")), text).expect("written");
    }
    folder
}

#[test]
fn tests_at_different_preloads_are_said_to_be_of_different_joints() {
    for (name, preload, is_said) in [
        ("alike", [10.0, 10.2], false),
        ("unlike", [10.0, 12.0], true),
    ] {
        let folder = records(name, preload);
        for command in ["identify", "diagnose"] {
            let output = Command::new(env!("CARGO_BIN_EXE_iwan"))
                .current_dir(&folder)
                .args([command, "test-0.csv", "test-1.csv", "-o", command])
                .output()
                .expect("the program runs");
            assert_eq!(output.status.code(), Some(0), "{output:?}");
            for stream in [&output.stdout, &output.stderr] {
                let told = String::from_utf8_lossy(stream);
                let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
                let said =
                    "diagnose them apart. The preload is 10.0 kN in test-0 and 12.0 kN in test-1";
                assert_eq!(told.contains(said), is_said, "{command}: {told}");
            }
        }
    }
}
