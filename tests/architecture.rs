//! Holds the house to its plan: who may name whom (the table in ARCHITECTURE.md), how large a file
//! may be, how files may be called, where `unsafe` may stand, that every cause is catalogued, and that
//! the physics answers alike on every platform.

mod source;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use source::{SourceFile, root, rust_files, words};

/// Lines of the middle file of src/, its tests at the end not counted: small files are read whole.
const MEDIAN_LINES: usize = 120;
/// No file of src/ is longer: beyond this a file has more than one purpose.
const MOST_LINES: usize = 450;
/// A file this long is an exception …
const LONG_LINES: usize = 350;
/// … of which there may be a few: tables of the FMI calls and solvers whose parts share their state.
const LONG_FILES: usize = 4;

/// Names that say nothing about a purpose.
const EMPTY_NAMES: [&str; 8] = [
    "util",
    "utils",
    concat!("hel", "per"),
    concat!("hel", "pers"),
    "manager",
    "managers",
    "misc",
    "common",
];

/// Packages that the rooms of pure physics and values may name: `thiserror` is compile-time only.
const PURE_PACKAGES: [&str; 1] = ["thiserror"];
/// Those rooms.
const PURE_ROOMS: [&str; 4] = ["joint", "causes", "outside", "record"];
/// One file may name `libm`: the functions that the platform's C library would answer differently
/// from system to system come from there (src/joint/elementary.rs says more).
const ELEMENTARY: &str = "src/joint/elementary";
/// Rooms whose results an exported joint answers with.
const SAME_EVERYWHERE: [&str; 2] = ["joint", "causes"];
/// Methods of the standard library whose last bit is the platform's, or is not specified.
const OF_THE_PLATFORM: [&str; 28] = [
    "powf", "powi", "exp", "exp2", "exp_m1", "ln", "ln_1p", "log", "log2", "log10", "cbrt",
    "hypot", "sin", "cos", "tan", "sin_cos", "asin", "acos", "atan", "atan2", "sinh", "cosh",
    "tanh", "asinh", "acosh", "atanh", "gamma", "ln_gamma",
];

/// Files of src/causes that hold what several causes share, and no cause.
const SHARED_BY_CAUSES: [&str; 5] = ["mod", "chain", "free_play", "spring", "wear"];

/// Room → rooms it may name, from the table in ARCHITECTURE.md.
fn rooms() -> BTreeMap<String, BTreeSet<String>> {
    let page = fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap();
    let rows: Vec<(String, String)> = page
        .lines()
        .skip_while(|line| !line.starts_with("| room |"))
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
            let [room, _, names] = cells[..] else {
                panic!("three columns expected: {line}")
            };
            (
                room.trim_matches('`').trim_end_matches('/').to_string(),
                names.to_string(),
            )
        })
        .collect();
    let all: BTreeSet<String> = rows.iter().map(|(room, _)| room.clone()).collect();
    assert!(
        all.len() >= 10,
        "the table of rooms in ARCHITECTURE.md was not found"
    );
    rows.into_iter()
        .map(|(room, names)| {
            let listed = |text: &str| -> BTreeSet<String> {
                text.split(',')
                    .map(|name| name.trim().to_string())
                    .filter(|name| !name.is_empty() && name != "–")
                    .collect()
            };
            let may = match names.strip_prefix("all but") {
                Some(excepted) => &all - &listed(excepted),
                None => listed(&names),
            };
            for name in &may {
                assert!(
                    all.contains(name),
                    "`{room}` may name `{name}`, which is no room"
                );
            }
            (room, may)
        })
        .collect()
}

/// Files of src/ that belong to no room: the crate's two entry points.
fn is_entry(file: &SourceFile) -> bool {
    file.path == "src/lib.rs" || file.path == "src/main.rs"
}

#[test]
fn every_file_stands_in_a_room() {
    let rooms = rooms();
    for file in rust_files("src").iter().filter(|file| !is_entry(file)) {
        assert!(
            rooms.contains_key(file.room()),
            "{}: `{}` is no room of ARCHITECTURE.md",
            file.path,
            file.room()
        );
    }
}

#[test]
fn rooms_name_only_what_the_table_allows() {
    let rooms = rooms();
    let mut violations = Vec::new();
    let mut checked = 0;
    for file in rust_files("src").iter().filter(|file| !is_entry(file)) {
        let Some(may) = rooms.get(file.room()) else {
            continue;
        };
        for (line, name) in file.crate_paths() {
            checked += 1;
            if name != file.room() && !may.contains(&name) {
                violations.push(format!("{}:{line}: names `crate::{name}`", file.path));
            }
        }
        for line in file.escapes_by_super() {
            violations.push(format!("{}:{line}: leaves its room by `super`", file.path));
        }
    }
    assert!(
        violations.is_empty(),
        "not in the table of rooms:\n{}",
        violations.join("\n")
    );
    assert!(
        checked > 0,
        "no `crate::` path was found at all: the search is broken"
    );
}

#[test]
fn pure_rooms_name_no_package() {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    let packages: Vec<String> = manifest
        .lines()
        .skip_while(|line| *line != "[dependencies]")
        .skip(1)
        .take_while(|line| !line.starts_with('['))
        .filter_map(|line| line.split_once('='))
        .map(|(name, _)| name.trim().replace('-', "_"))
        .collect();
    assert!(
        packages.iter().any(|name| name == "thiserror"),
        "dependencies were not found"
    );
    for file in rust_files("src") {
        if !PURE_ROOMS.contains(&file.room()) {
            continue;
        }
        for (line, path) in file.first_segments() {
            assert!(
                !packages.contains(&path)
                    || PURE_PACKAGES.contains(&path.as_str())
                    || (path == "libm" && file.path.starts_with(ELEMENTARY)),
                "{}:{line}: `{}` names the package `{path}`",
                file.path,
                file.room()
            );
        }
    }
}

#[test]
fn physics_takes_no_function_from_the_platforms_c_library() {
    let mut found = Vec::new();
    let mut checked = 0;
    for file in rust_files("src") {
        if !SAME_EVERYWHERE.contains(&file.room()) {
            continue;
        }
        let product = file.lines_before_tests();
        for (number, line) in file.code_lines().take(product) {
            checked += 1;
            for name in OF_THE_PLATFORM {
                let called = [format!(".{name}("), format!("f64::{name}")];
                let is_called = |call: &String| {
                    line.match_indices(call.as_str()).any(|(at, _)| {
                        let after = line[at + call.len()..].chars().next();
                        call.ends_with('(')
                            || !after.is_some_and(|c| c.is_alphanumeric() || c == '_')
                    })
                };
                if called.iter().any(is_called) {
                    found.push(format!("{}:{number}: `{name}`", file.path));
                }
            }
        }
    }
    assert!(checked > 1000, "the physics was not found");
    assert!(
        found.is_empty(),
        "take these from src/joint/elementary.rs:\n{}",
        found.join("\n")
    );
}

#[test]
fn files_are_small() {
    let mut sizes: Vec<(usize, String)> = rust_files("src")
        .iter()
        .map(|file| (file.lines_before_tests(), file.path.clone()))
        .collect();
    sizes.sort();
    let (middle, _) = sizes[sizes.len() / 2];
    assert!(
        middle <= MEDIAN_LINES,
        "the middle file of src/ has {middle} lines"
    );
    let too_long: Vec<_> = sizes
        .iter()
        .filter(|(lines, _)| *lines > MOST_LINES)
        .collect();
    assert!(
        too_long.is_empty(),
        "longer than {MOST_LINES} lines: {too_long:?}"
    );
    let long: Vec<_> = sizes
        .iter()
        .filter(|(lines, _)| *lines > LONG_LINES)
        .collect();
    assert!(
        long.len() <= LONG_FILES,
        "more than {LONG_FILES} above {LONG_LINES} lines: {long:?}"
    );
}

#[test]
fn names_say_a_purpose() {
    for folder in ["src", "tests", "benches"] {
        for file in rust_files(folder) {
            for part in file.path.trim_end_matches(".rs").split(['/', '_']) {
                assert!(
                    !EMPTY_NAMES.contains(&part),
                    "{}: `{part}` says no purpose",
                    file.path
                );
            }
        }
    }
}

#[test]
fn unsafe_stands_at_the_c_boundary_only() {
    for file in rust_files("src").iter().filter(|file| file.room() != "fmu") {
        for (number, line) in file.code_lines() {
            assert!(
                !words(line).any(|word| word == "unsafe"),
                "{}:{number}: `unsafe` outside src/fmu",
                file.path
            );
        }
    }
}

#[test]
fn every_cause_has_one_line_in_the_catalogue() {
    let files = rust_files("src/causes");
    let catalogue = files
        .iter()
        .find(|file| file.path == "src/causes/mod.rs")
        .unwrap();
    let (_, list) = catalogue
        .code
        .split_once("CATALOGUE: &[&dyn Cause] = &[")
        .unwrap();
    let (list, _) = list.split_once("];").unwrap();
    for file in &files {
        let name = file.stem();
        if SHARED_BY_CAUSES.contains(&name) {
            continue;
        }
        let count = words(list).filter(|word| *word == name).count();
        assert_eq!(
            count, 1,
            "`{name}` stands {count} times in the CATALOGUE of src/causes/mod.rs"
        );
    }
}
