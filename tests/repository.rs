//! What may stand in the repository's files: nothing that belongs to one machine, and nothing but
//! the project.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Folders of one machine. Written in halves, so that this file passes its own test.
const MACHINE_PATHS: [&str; 7] = [
    concat!("/", "root/"),
    concat!("/", "home/"),
    concat!("/", "Users/"),
    concat!("/", "work/"),
    concat!("/", "tmp/"),
    concat!("/opt/", "wheels"),
    concat!("C:\\", "Users"),
];

/// Hosts and settings that point a build at one particular registry.
const REGISTRIES: [&str; 8] = [
    concat!("index.", "crates.io"),
    concat!("static.", "crates.io"),
    concat!("files.", "pythonhosted"),
    concat!("pypi", ".org/simple"),
    concat!("arti", "factory"),
    concat!("--index", "-url"),
    concat!("--find", "-links"),
    concat!("[source.", "crates-io]"),
];

/// Words about how the work is organised, not about the project.
const FOREIGN_WORDS: [&str; 8] = [
    concat!("hel", "per"),
    concat!("hel", "pers"),
    concat!("work", "tree"),
    concat!("work", "trees"),
    concat!("co", "pilot"),
    concat!("chat", "bot"),
    concat!("sub", "agent"),
    concat!("language", " model"),
];

/// Measurements of others stay out of the repository; so does whatever a command generates.
const FOREIGN_FOLDERS: [&str; 4] = ["shared/", "target/", ".venv/", "result/"];

/// Larger files belong elsewhere: the bundled records are the largest thing an engineer clones.
const LARGEST_BYTES: u64 = 3_000_000;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Files that git keeps or would keep.
fn tracked() -> Vec<String> {
    let listing = Command::new("git")
        .args(["ls-files", "--cached", "--others", "--exclude-standard"])
        .current_dir(root())
        .output()
        .expect("git lists the files of the repository");
    assert!(
        listing.status.success(),
        "{}",
        String::from_utf8_lossy(&listing.stderr)
    );
    let files: Vec<String> = String::from_utf8(listing.stdout)
        .unwrap()
        .lines()
        .filter(|path| root().join(path).is_file())
        .map(str::to_string)
        .collect();
    assert!(
        files.iter().any(|path| path == "Cargo.toml"),
        "git lists no Cargo.toml"
    );
    files
}

/// Lines of the text files among the tracked ones: path, line number, text.
fn lines() -> Vec<(String, usize, String)> {
    let mut all = Vec::new();
    for path in tracked() {
        // A file that is no UTF-8 is no text: an archive or a picture.
        let Ok(text) = fs::read_to_string(root().join(&path)) else {
            continue;
        };
        for (index, line) in text.lines().enumerate() {
            all.push((path.clone(), index + 1, line.to_string()));
        }
    }
    all
}

fn assert_absent(what: &str, found: impl Fn(&str, &str) -> Option<&'static str>) {
    let hits: Vec<String> = lines()
        .iter()
        .filter_map(|(path, number, line)| {
            found(path, line).map(|text| format!("{path}:{number}: {text}"))
        })
        .collect();
    assert!(hits.is_empty(), "{what}:\n{}", hits.join("\n"));
}

/// True where `line` has `path` at the start of a path, not in the middle of another one.
fn has_path(line: &str, path: &str) -> bool {
    line.match_indices(path).any(|(position, _)| {
        let before = line[..position].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || "._-}".contains(c))
    })
}

/// True where `line` has `word` as a whole word, whatever its case.
fn has_word(line: &str, word: &str) -> bool {
    let line = line.to_lowercase();
    let letter = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    line.match_indices(word).any(|(position, _)| {
        !letter(line[..position].chars().next_back())
            && !letter(line[position + word.len()..].chars().next())
    })
}

#[test]
fn no_file_names_a_folder_of_one_machine() {
    assert_absent("folders of one machine", |_, line| {
        MACHINE_PATHS.into_iter().find(|path| has_path(line, path))
    });
}

#[test]
fn no_file_names_a_registry() {
    assert_absent("hosts of a registry", |_, line| {
        REGISTRIES.into_iter().find(|host| line.contains(host))
    });
}

#[test]
fn every_package_comes_from_the_public_registry() {
    let lock = fs::read_to_string(root().join("Cargo.lock")).unwrap();
    let sources: Vec<&str> = lock
        .lines()
        .filter(|line| line.starts_with("source = "))
        .collect();
    assert!(!sources.is_empty());
    for source in sources {
        let public = "source = \"registry+https://github.com/rust-lang/crates.io-index\"";
        assert_eq!(source, public);
    }
}

#[test]
fn files_speak_of_the_project_alone() {
    assert_absent("words that are not about the project", |path, line| {
        let generated = path == "Cargo.lock";
        FOREIGN_WORDS
            .into_iter()
            .find(|word| !generated && has_word(line, word))
    });
}

#[test]
fn foreign_and_generated_files_stay_out() {
    for path in tracked() {
        let foreign = FOREIGN_FOLDERS
            .iter()
            .find(|folder| path.starts_with(*folder));
        assert!(
            foreign.is_none(),
            "{path} does not belong into the repository"
        );
        let bytes = fs::metadata(root().join(&path)).unwrap().len();
        assert!(bytes <= LARGEST_BYTES, "{path} has {bytes} bytes");
    }
}

#[test]
fn continuous_integration_runs_what_the_readme_says() {
    let run = fs::read_to_string(root().join(".ci/run")).unwrap();
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let commands: Vec<&str> = run
        .lines()
        .map(str::trim)
        .filter(|line| {
            !(line.is_empty()
                || line.starts_with('#')
                || line.starts_with("set ")
                || line.starts_with("cd "))
        })
        .collect();
    assert!(!commands.is_empty(), ".ci/run runs nothing");
    for command in commands {
        assert!(
            readme.lines().any(|line| line.trim() == command),
            ".ci/run runs `{command}`, which README.md does not have on a line of its own"
        );
    }
}
