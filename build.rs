//! Makes Rust constants from the tables in modelDescription/, so that the shared library and the
//! archive's modelDescription.xml are written from one source and cannot disagree.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// Value references per cause; a cause's glossary may not be longer.
const REFERENCES_PER_CAUSE: u32 = 16;
/// Value reference of time; below it stand the signals, above it the parameters.
const TIME_REFERENCE: &str = "99";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let mut code = String::new();
    let mut taken = BTreeMap::new();
    signals(&mut code, &mut taken);
    let time = take(&mut taken, "build.rs", TIME_REFERENCE, "time", 1);
    let _ = writeln!(
        code,
        "/// Value reference of time, which is a variable in FMI 3.0 alone.\n\
         pub const TIME_REFERENCE: u32 = {time};"
    );
    references(
        &mut code,
        "parameters.csv",
        "PARAMETER_REFERENCES",
        1,
        &mut taken,
    );
    references(
        &mut code,
        "causes.csv",
        "CAUSE_REFERENCES",
        REFERENCES_PER_CAUSE,
        &mut taken,
    );
    let _ = writeln!(
        code,
        "/// Value references that each cause holds.\n\
         pub const REFERENCES_PER_CAUSE: u32 = {REFERENCES_PER_CAUSE};"
    );
    let _ = writeln!(
        code,
        "/// Stands for the sources of the shared library: a library with another stamp is of\n\
         /// other physics or other tables than this program.\n\
         pub const STAMP: &str = \"iwan-sources-{:016x}\";",
        stamp()
    );
    let out = env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    fs::write(Path::new(&out).join("references.rs"), code).expect("OUT_DIR is writable");
}

/// Rows of a table: cells trimmed, comment lines left out; the last cell may hold commas.
fn rows(file: &str, columns: usize) -> Vec<(usize, Vec<String>)> {
    let path = Path::new("modelDescription").join(file);
    let text = fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    text.lines()
        .enumerate()
        .filter(|(_, line)| !line.starts_with('#') && !line.trim().is_empty())
        .map(|(index, line)| {
            let cells: Vec<_> = line
                .splitn(columns, ',')
                .map(|c| c.trim().to_owned())
                .collect();
            assert_eq!(
                cells.len(),
                columns,
                "{file}:{}: expected {columns} cells",
                index + 1
            );
            (index + 1, cells)
        })
        .collect()
}

/// Takes `count` references from `first` on, each once in the whole product.
fn take(
    taken: &mut BTreeMap<u32, String>,
    place: &str,
    first: &str,
    name: &str,
    count: u32,
) -> u32 {
    let first: u32 = first
        .parse()
        .unwrap_or_else(|e| panic!("{place}: `{first}`: {e}"));
    for reference in first..first + count {
        if let Some(other) = taken.insert(reference, name.to_owned()) {
            panic!("{place}: reference {reference} of `{name}` already belongs to `{other}`");
        }
    }
    first
}

fn signals(code: &mut String, taken: &mut BTreeMap<u32, String>) {
    let mut variants = String::new();
    let mut table = String::new();
    for (line, cells) in rows("signals.csv", 7) {
        let [
            reference,
            name,
            unit,
            least,
            force_driven,
            displacement_driven,
            description,
        ] = &cells[..]
        else {
            unreachable!("rows() counted the cells")
        };
        let reference = take(taken, &format!("signals.csv:{line}"), reference, name, 1);
        let variant = camel(name);
        let lower = match least.parse::<f64>() {
            Ok(least) => format!("{least:?}"),
            Err(_) if least == "-" => "f64::NEG_INFINITY".to_owned(),
            Err(error) => panic!("signals.csv:{line}: `{least}`: {error}"),
        };
        let _ = writeln!(
            variants,
            "    /// {description} [{unit}].\n    {variant} = {reference},"
        );
        let _ = writeln!(
            table,
            "    SignalRow {{ signal: Signal::{variant}, reference: {reference}, name: {name:?}, \
             unit: {unit:?}, lower: {lower}, force_driven: Causality::{}, displacement_driven: Causality::{}, \
             description: {description:?} }},",
            camel(force_driven),
            camel(displacement_driven)
        );
    }
    let _ = writeln!(
        code,
        "/// What every joint shows; the number is the value reference.\n\
         #[derive(Debug, Clone, Copy, PartialEq, Eq)]\npub enum Signal {{\n{variants}}}\n\
         /// modelDescription/signals.csv.\npub static SIGNALS: &[SignalRow] = &[\n{table}];"
    );
}

fn references(
    code: &mut String,
    file: &str,
    constant: &str,
    count: u32,
    taken: &mut BTreeMap<u32, String>,
) {
    let mut names = BTreeMap::new();
    let _ = writeln!(
        code,
        "/// modelDescription/{file}.\npub static {constant}: &[(&str, u32)] = &["
    );
    for (line, cells) in rows(file, 2) {
        let first = take(
            taken,
            &format!("{file}:{line}"),
            &cells[0],
            &cells[1],
            count,
        );
        if names.insert(cells[1].clone(), first).is_some() {
            panic!("{file}:{line}: `{}` stands twice", cells[1]);
        }
        let _ = writeln!(code, "    ({:?}, {first}),", cells[1]);
    }
    let _ = writeln!(code, "];");
}

/// `dissipation_rate` → `DissipationRate`.
fn camel(name: &str) -> String {
    name.split('_')
        .flat_map(|word| {
            let mut letters = word.chars();
            letters
                .next()
                .map(|c| c.to_ascii_uppercase())
                .into_iter()
                .chain(letters)
        })
        .collect()
}

/// FNV-1a (64 bits) over all that the shared library is made of, whatever its line ends.
fn stamp() -> u64 {
    let mut files = Vec::new();
    for part in [
        "modelDescription",
        "src/joint",
        "src/causes",
        "src/saved",
        "src/fmu",
        "src/variables",
    ] {
        println!("cargo::rerun-if-changed={part}");
        collect(Path::new(part), &mut files);
    }
    println!("cargo::rerun-if-changed=src/saved.rs");
    files.push("src/saved.rs".into());
    files.sort();
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for file in files {
        let bytes = fs::read(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()));
        for byte in bytes.into_iter().filter(|&byte| byte != b'\r') {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
    hash
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    for entry in entries {
        let path = entry.expect("folder entry is readable").path();
        if path.is_dir() {
            collect(&path, files);
        } else {
            files.push(path);
        }
    }
}
