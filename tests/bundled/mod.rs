//! The bundled record, for tests that write it anew with a change.

use std::path::{Path, PathBuf};

/// A folder for a test's records, and the bundled record: its text, its header, and its rows.
pub fn bolt(test: &str) -> (PathBuf, String, String, Vec<String>) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).expect("a folder for the test");
    let bolt = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/bolt-1.csv");
    let text = std::fs::read_to_string(bolt).expect("the bundled record");
    let mut rows = text.lines().filter(|line| !line.starts_with('#'));
    let header = rows.next().expect("a header").to_string();
    let rows = rows.map(str::to_string).collect();
    (folder, text, header, rows)
}
