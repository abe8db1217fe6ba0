//! Runs the commands of README.md, in order and in one folder as a reader would, and compares what
//! they print with what the page says they print.
//!
//! A block ```` ```sh ```` is run; a block ```` ```text ```` that follows it is its output. After a wanted
//! change `UPDATE_README=1 cargo test --features importer --test documentation` writes the outputs
//! anew; read the difference before committing it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A block that begins with one of these sets up a machine or is a step of scripts/test.sh itself.
const NOT_RUN_HERE: [&str; 4] = ["git ", "cargo ", "bash scripts/", "scripts/"];

/// Numbers of a fit differ in their last printed digit between processors (order of summation,
/// the system's `pow`); words may not differ at all.
const NUMBER_TOLERANCE: f64 = 0.01;

/// A fenced block of the page.
#[derive(Debug)]
struct Block {
    language: String,
    /// Line of the opening fence, from 1.
    line: usize,
    text: String,
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn blocks(page: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    let mut open = false;
    for (index, line) in page.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(language) => {
                open = true;
                let language = language.trim().to_string();
                blocks.push(Block {
                    language,
                    line: index + 1,
                    text: String::new(),
                });
            }
            None if open => {
                let block = blocks.last_mut().unwrap();
                block.text.push_str(line);
                block.text.push('\n');
            }
            None => {}
        }
    }
    assert!(!open, "a fenced block of README.md is not closed");
    blocks
}

/// An empty folder of this test's own, with the examples in it.
fn folder() -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("README commands");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("examples")).unwrap();
    for entry in fs::read_dir(root().join("examples")).unwrap() {
        let entry = entry.unwrap();
        if entry.path().is_file() {
            let copy = folder.join("examples").join(entry.file_name());
            fs::copy(entry.path(), copy).unwrap();
        }
    }
    folder
}

fn run(commands: &str, folder: &Path) -> Output {
    let program = Path::new(env!("CARGO_BIN_EXE_iwan")).parent().unwrap();
    let path = std::env::var("PATH").unwrap();
    Command::new("bash")
        .args(["-euo", "pipefail", "-c", commands])
        .current_dir(folder)
        .env("PATH", format!("{}:{path}", program.display()))
        .output()
        .unwrap()
}

/// The number that a word is, without the punctuation around it.
fn number(word: &str) -> Option<f64> {
    word.trim_matches(|c: char| !(c.is_ascii_digit() || c == '-' || c == '+'))
        .parse()
        .ok()
}

/// First place where two outputs differ, or `None`.
fn difference(expected: &str, printed: &str) -> Option<String> {
    let (mut expected_words, mut printed_words) =
        (expected.split_whitespace(), printed.split_whitespace());
    loop {
        let (a, b) = (expected_words.next(), printed_words.next());
        let same = match (a, b) {
            (None, None) => return None,
            (Some(a), Some(b)) => {
                a == b
                    || matches!((number(a), number(b)), (Some(x), Some(y))
                        if (x - y).abs() <= NUMBER_TOLERANCE * x.abs().max(y.abs()))
            }
            _ => false,
        };
        if !same {
            return Some(format!(
                "the page says `{}`, printed was `{}`",
                a.unwrap_or("end"),
                b.unwrap_or("end")
            ));
        }
    }
}

#[test]
fn commands_of_the_readme_do_what_it_says() {
    let path = root().join("README.md");
    let mut page = fs::read_to_string(&path).unwrap();
    let folder = folder();
    let blocks = blocks(&page);
    let mut count = 0;
    let mut faults = Vec::new();
    for (index, block) in blocks.iter().enumerate() {
        let is_set_up = NOT_RUN_HERE
            .iter()
            .any(|start| block.text.starts_with(start));
        if block.language != "sh" || is_set_up {
            continue;
        }
        if block.text.contains("iwan check") && !cfg!(feature = "importer") {
            eprintln!(
                "README.md:{}: not run, `iwan check` needs --features importer",
                block.line
            );
            continue;
        }
        count += 1;
        let output = run(&block.text, &folder);
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        if !output.status.success() {
            let errors = String::from_utf8_lossy(&output.stderr);
            faults.push(format!(
                "README.md:{}: {}\n{errors}",
                block.line, output.status
            ));
            continue;
        }
        let Some(expected) = blocks.get(index + 1).filter(|next| next.language == "text") else {
            continue;
        };
        if std::env::var_os("UPDATE_README").is_some() {
            let old = format!("{}```\n\n```text\n{}```", block.text, expected.text);
            let new = format!("{}```\n\n```text\n{}\n```", block.text, printed.trim_end());
            assert!(
                page.contains(&old),
                "README.md:{}: not found again",
                expected.line
            );
            page = page.replacen(&old, &new, 1);
        } else if let Some(fault) = difference(&expected.text, &printed) {
            faults.push(format!("README.md:{}: {fault}\n{printed}", expected.line));
        }
    }
    if std::env::var_os("UPDATE_README").is_some() {
        fs::write(&path, page).unwrap();
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(count >= 4, "README.md has only {count} blocks of commands");
}

#[test]
fn outputs_are_compared_by_words_and_numbers() {
    assert_eq!(difference("chi -0.50 (2 %)", "chi  -0.501 (2 %)"), None);
    assert!(difference("chi -0.50", "chi -0.52").is_some());
    assert!(difference("clean", "explained").is_some());
    assert!(difference("clean", "clean and more").is_some());
}
