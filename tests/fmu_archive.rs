//! `iwan export`: the archive, and every way in which it is refused.

use iwan::joint::Drive;
use iwan::pack::{FmiVersion, Library, Platform};
use iwan::variables::guid;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const JOINT: &str = include_str!("../examples/table1_case1.json");

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("export ü {name}"));
    let _ = std::fs::remove_dir_all(&path); // of an earlier run, if any
    std::fs::create_dir_all(&path).expect("a folder for test files");
    std::fs::write(path.join("joint.json"), JOINT).expect("a joint");
    path
}

/// The shared library that cargo built with this test: the same sources, the same stamp.
fn library() -> PathBuf {
    let test = std::env::current_exe().expect("this test has a file");
    test.with_file_name(format!("libiwan{}", std::env::consts::DLL_SUFFIX))
}

fn this_machine(version: FmiVersion) -> &'static Platform {
    Platform::of_this_machine(version).expect("a platform of FMI")
}

/// Where the library of this machine lies in an archive.
fn library_entry(version: FmiVersion) -> String {
    let library = Library {
        platform: this_machine(version),
        path: PathBuf::new(),
        bytes: vec![],
    };
    library.entry(version)
}

fn export(folder: &Path, library: Option<&Path>, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_iwan"));
    command
        .current_dir(folder)
        .env_remove("IWAN_FMU_LIBRARY")
        .arg("export")
        .args(arguments);
    if let Some(library) = library {
        command.env("IWAN_FMU_LIBRARY", library);
    }
    command.output().expect("the binary runs")
}

#[track_caller]
fn fine(folder: &Path, arguments: &[&str]) -> Vec<u8> {
    let output = export(folder, Some(&library()), arguments);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    std::fs::read(folder.join("joint.fmu")).expect("the archive")
}

#[track_caller]
fn refused(folder: &Path, library: Option<&Path>, arguments: &[&str], expected: &str) {
    let before = listing(folder);
    let output = export(folder, library, arguments);
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains(expected), "{told}");
    assert_eq!(listing(folder), before, "a refusal leaves nothing behind");
}

fn listing(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("the folder");
    let mut files: Vec<_> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    files
}

fn entry(archive: &[u8], name: &str) -> Vec<u8> {
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(archive)).expect("a zip file");
    let mut bytes = Vec::new();
    let mut file = archive.by_name(name).expect(name);
    assert_eq!(file.compression(), zip::CompressionMethod::Deflated);
    file.read_to_end(&mut bytes).expect(name);
    bytes
}

#[test]
fn the_archive_holds_the_joint_as_it_is_and_its_guid() {
    let folder = folder("whole");
    for (drive, name) in [
        (Drive::Force, "force"),
        (Drive::Displacement, "displacement"),
    ] {
        let archive = fine(&folder, &["joint.json", "-o", "joint.fmu", "--drive", name]);
        assert_eq!(entry(&archive, "resources/joint.json"), JOINT.as_bytes());
        let xml = String::from_utf8(entry(&archive, "modelDescription.xml")).expect("UTF-8");
        assert!(xml.contains(&format!("guid=\"{}\"", guid(JOINT, drive))));
        assert!(xml.contains(&format!("driven in {name}")));
        let page = String::from_utf8(entry(&archive, "documentation/index.html")).expect("UTF-8");
        assert!(page.contains("break_free_limit"));
        let packed = entry(&archive, &library_entry(FmiVersion::Two));
        assert_eq!(packed, std::fs::read(library()).expect("the library"));
    }
    assert_eq!(
        listing(&folder).len(),
        2,
        "nothing but joint.json and joint.fmu"
    );
}

#[test]
fn equal_joints_give_equal_archives() {
    let folder = folder("equal");
    let arguments = ["joint.json", "-o", "joint.fmu"];
    assert_eq!(fine(&folder, &arguments), fine(&folder, &arguments));
}

/// Importers that draw or optimise parameters ask for both bounds of each.
#[test]
fn every_parameter_has_a_least_and_a_largest_value() {
    let folder = folder("bounds");
    for version in ["2", "3"] {
        let arguments = ["joint.json", "-o", "joint.fmu", "--fmi", version];
        let archive = fine(&folder, &arguments);
        let xml = String::from_utf8(entry(&archive, "modelDescription.xml")).expect("UTF-8");
        let variables = xml.split("name=\"").skip(1);
        let parameters = variables.filter(|text| {
            let own = text.split("/>").next().unwrap_or_default();
            own.contains("causality=\"parameter\"")
        });
        let mut count = 0;
        for parameter in parameters {
            count += 1;
            let own = parameter.split("/>").next().unwrap_or_default();
            assert!(own.contains(" min=\"") && own.contains(" max=\""), "{own}");
        }
        assert!(count >= 4, "{xml}");
    }
}

/// One library serves both versions of FMI; the token is the GUID.
#[test]
fn the_archive_of_fmi_3_has_its_own_xml_and_platform_names() {
    let folder = folder("three");
    let arguments = ["joint.json", "-o", "joint.fmu", "--fmi", "3"];
    let archive = fine(&folder, &arguments);
    let xml = String::from_utf8(entry(&archive, "modelDescription.xml")).expect("UTF-8");
    let token = guid(JOINT, Drive::Force);
    assert!(xml.contains("fmiVersion=\"3.0\""), "{xml}");
    assert!(
        xml.contains(&format!("instantiationToken=\"{token}\"")),
        "{xml}"
    );
    assert!(xml.contains("hasEventMode=\"false\""), "{xml}");
    assert_eq!(entry(&archive, "resources/joint.json"), JOINT.as_bytes());
    let packed = entry(&archive, &library_entry(FmiVersion::Three));
    assert_eq!(packed, std::fs::read(library()).expect("the library"));
    let terminals = entry(&archive, iwan::pack::terminals::ENTRY);
    assert_eq!(terminals, iwan::pack::terminals::xml().expect("XML"));
    assert_eq!(
        entry(&archive, iwan::pack::terminals::ICON_ENTRY),
        iwan::pack::ICON
    );
    let page = String::from_utf8(entry(&archive, "documentation/index.html")).expect("UTF-8");
    assert!(
        page.contains("FMI 3.0") && page.contains("fmi3DoStep"),
        "{page}"
    );
}

#[test]
fn several_platforms_in_one_archive() {
    let folder = folder("platforms");
    let built = library().display().to_string();
    // Libraries of other platforms, as far as their heads and their stamps go.
    let stamp = iwan::variables::STAMP.as_bytes();
    let mut pe = vec![0; 64];
    pe[..2].copy_from_slice(b"MZ");
    pe[60] = 64;
    pe.extend(b"PE\0\0\x64\x86");
    pe.extend(stamp);
    let mut arm = vec![0; 64];
    arm[..5].copy_from_slice(b"\x7fELF\x02");
    arm[18] = 183;
    arm.extend(stamp);
    std::fs::write(folder.join("arm.so"), &arm).expect("a file");
    std::fs::write(folder.join("IwanJoint.dll"), &pe).expect("a file");
    let here = this_machine(FmiVersion::Two).name;
    let (own, windows) = (format!("{here}={built}"), "win64=IwanJoint.dll");
    let arguments = [
        "joint.json",
        "-o",
        "joint.fmu",
        "--binary",
        &own,
        "--binary",
        windows,
        "--binary",
        "aarch64-linux=arm.so",
    ];
    let archive = fine(&folder, &arguments);
    assert_eq!(entry(&archive, "binaries/win64/IwanJoint.dll"), pe);
    assert_eq!(entry(&archive, "binaries/aarch64-linux/IwanJoint.so"), arm);
    assert!(!entry(&archive, &library_entry(FmiVersion::Two)).is_empty());
    let twice = [
        "joint.json",
        "-o",
        "no.fmu",
        "--binary",
        &own,
        "--binary",
        &own,
    ];
    refused(
        &folder,
        None,
        &twice,
        &format!("platform `{here}` has two libraries"),
    );
}

#[test]
fn every_bad_library_is_told_apart() {
    let folder = folder("libraries");
    let arguments = ["joint.json", "-o", "joint.fmu"];
    let nowhere = folder.join("nowhere.so");
    refused(
        &folder,
        Some(&nowhere),
        &arguments,
        "nowhere.so: No such file",
    );
    refused(
        &folder,
        Some(&folder.join("joint.json")),
        &arguments,
        "expected a 64-bit ELF",
    );
    let stale = folder.join("stale.so");
    let mut head = b"\x7fELF\x02 of other sources".to_vec();
    head[18..20].copy_from_slice(&62_u16.to_le_bytes());
    std::fs::write(&stale, head).expect("a file");
    refused(
        &folder,
        Some(&stale),
        &arguments,
        "was built from other sources",
    );
    refused(&folder, Some(&stale), &arguments, iwan::pack::BUILD_COMMAND);
    // Half a library has the right head, and may have the stamp.
    let half = folder.join("half.so");
    let whole = std::fs::read(library()).expect("the library");
    for share in [0.4, 0.7, 0.999] {
        let kept = (whole.len() as f64 * share) as usize;
        std::fs::write(&half, &whole[..kept]).expect("a file");
        refused(&folder, Some(&half), &arguments, "half.so is cut short");
    }
    let with = |binary: &'static str| ["joint.json", "-o", "joint.fmu", "--binary", binary];
    refused(&folder, None, &with("linux64"), "expected PLATFORM=FILE");
    let swapped = format!("aarch64-linux={}", library().display());
    let arguments = ["joint.json", "-o", "joint.fmu", "--binary", &swapped];
    refused(
        &folder,
        None,
        &arguments,
        "expected a 64-bit ELF library for ARM",
    );
    refused(
        &folder,
        None,
        &with("amiga=a.so"),
        "platform `amiga`: expected one of linux64",
    );
}

/// A program that lies alone, as an installed one does: it says how the library is built.
#[test]
fn without_a_library_the_way_to_one_is_told() {
    let folder = folder("alone");
    let program = folder.join("iwan");
    std::fs::copy(env!("CARGO_BIN_EXE_iwan"), &program).expect("a copy");
    let output = Command::new(&program)
        .current_dir(&folder)
        .env_remove("IWAN_FMU_LIBRARY")
        .args(["export", "joint.json", "-o", "joint.fmu"])
        .output()
        .expect("the copy runs");
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains(iwan::pack::BUILD_COMMAND), "{told}");
    assert!(told.contains("--binary PLATFORM=FILE"), "{told}");
    // A diagnosis goes on without, and its findings say what is not there.
    let bolt = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/bolt-1.csv");
    let output = Command::new(&program)
        .current_dir(&folder)
        .env_remove("IWAN_FMU_LIBRARY")
        .arg("diagnose")
        .arg(bolt)
        .args(["-o", "result"])
        .output()
        .expect("the copy runs");
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let printed = String::from_utf8_lossy(&output.stdout);
    assert!(printed.contains("joint.fmu was not written"), "{printed}");
    assert!(printed.contains("--binary PLATFORM=FILE"), "{printed}");
    assert!(folder.join("result/joint.json").exists());
    assert!(!folder.join("result/joint.fmu").exists());
    // Beside the program, under the name it has in the archive, it is found.
    std::fs::copy(library(), folder.join("IwanJoint.so")).expect("a copy");
    let output = Command::new(&program)
        .current_dir(&folder)
        .env_remove("IWAN_FMU_LIBRARY")
        .args(["export", "joint.json", "-o", "joint.fmu"])
        .output()
        .expect("the copy runs");
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn every_bad_input_is_told_apart() {
    let folder = folder("inputs");
    let library = library();
    let check = |arguments: &[&str], expected: &str| {
        refused(&folder, Some(&library), arguments, expected);
    };
    check(
        &["none.json", "-o", "joint.fmu"],
        "none.json: there is no such file",
    );
    check(&["joint.json", "-o", "joint.json"], "this is an input");
    check(
        &["joint.json", "-o", "no/folder/joint.fmu"],
        "there is no folder",
    );
    check(
        &["joint.json", "-o", "joint.fmu", "--drive", "both"],
        "invalid value 'both'",
    );
    check(
        &["joint.json", "-o", "joint.fmu", "--fmi", "4"],
        "invalid value '4'",
    );
    check(&["joint.json"], "--output");
    std::fs::write(folder.join("cut.json"), &JOINT[..100]).expect("a file");
    check(&["cut.json", "-o", "joint.fmu"], "cut.json:");
}

/// A joint that another program writes, and messages that nobody reads.
#[cfg(unix)]
#[test]
fn pipes_are_read_once_and_may_be_closed() {
    use std::process::Stdio;
    let folder = folder("pipes");
    let mut command = Command::new(env!("CARGO_BIN_EXE_iwan"));
    command
        .current_dir(&folder)
        .env("IWAN_FMU_LIBRARY", library())
        .args(["export", "/dev/stdin", "-o", "joint.fmu"])
        .stdin(Stdio::piped())
        .stderr(Stdio::piped());
    let mut running = command.spawn().expect("the binary runs");
    let mut joint = running.stdin.take().expect("a pipe");
    std::io::Write::write_all(&mut joint, JOINT.as_bytes()).expect("a joint");
    drop((joint, running.stderr.take()));
    assert_eq!(running.wait().expect("an end").code(), Some(0));
    let archive = std::fs::read(folder.join("joint.fmu")).expect("the archive");
    assert_eq!(entry(&archive, "resources/joint.json"), JOINT.as_bytes());
}

/// An archive that is there stays whole when the next export fails.
#[test]
fn a_refusal_leaves_the_old_archive() {
    let folder = folder("old");
    let arguments = ["joint.json", "-o", "joint.fmu"];
    let old = fine(&folder, &arguments);
    refused(
        &folder,
        Some(&folder.join("nowhere.so")),
        &arguments,
        "nowhere.so",
    );
    assert_eq!(
        std::fs::read(folder.join("joint.fmu")).expect("the archive"),
        old
    );
}

/// Functions of fmi3FunctionTypes.h, for all three kinds of units.
#[cfg(all(target_os = "linux", not(feature = "importer")))]
const FUNCTIONS_OF_FMI_3: usize = 75;

/// Exactly the FMI functions leave the library. With the feature `importer` another crate adds a
/// symbol, so that the packed library is looked at by tests/fmu/run_fmpy.py, and this one without.
#[cfg(all(target_os = "linux", not(feature = "importer")))]
#[test]
fn the_library_exports_the_fmi_functions_and_nothing_else() {
    let listing = Command::new("nm")
        .args(["-D", "--defined-only"])
        .arg(library())
        .output();
    let listing = String::from_utf8(listing.expect("nm runs").stdout).expect("UTF-8");
    let symbols: Vec<_> = listing
        .lines()
        .filter_map(|line| line.split_whitespace().last())
        .collect();
    let of = |version: &str| {
        let named = symbols.iter().filter(|symbol| symbol.starts_with(version));
        named.count()
    };
    // All functions of fmi2FunctionTypes.h and, for all three kinds of units, fmi3FunctionTypes.h.
    assert_eq!(
        (of("fmi2"), of("fmi3")),
        (34, FUNCTIONS_OF_FMI_3),
        "{symbols:?}"
    );
    assert_eq!(symbols.len(), 34 + FUNCTIONS_OF_FMI_3, "{symbols:?}");
}

/// What the licence file names is what cargo links: a package that comes or goes must change it.
#[test]
fn every_linked_package_is_named_in_the_licence() {
    let tree = Command::new(env!("CARGO"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["tree", "--locked", "--offline", "--no-default-features"])
        .args(["--edges", "normal,no-proc-macro", "--prefix", "none"])
        .args(["--format", "{p} {l}"])
        .output()
        .expect("cargo runs");
    assert!(
        tree.status.success(),
        "{}",
        String::from_utf8_lossy(&tree.stderr)
    );
    let listing = String::from_utf8(tree.stdout).expect("UTF-8");
    // `name version licence`; the first line is this package.
    let mut linked: Vec<_> = listing
        .lines()
        .skip(1)
        .map(|line| line.trim_end_matches(" (*)"))
        .filter_map(|line| {
            let mut words = line.splitn(3, ' ');
            Some((words.next()?, words.nth(1)?))
        })
        .collect();
    linked.sort_unstable();
    linked.dedup();
    assert_eq!(linked, iwan::pack::LINKED);
}

/// What is known of the joint stands in the archive: records, verdict, intervals, rate and date.
#[test]
fn the_archive_tells_where_its_numbers_come_from() {
    let folder = folder("origin");
    let mut joint: serde_json::Value = serde_json::from_str(JOINT).expect("JSON");
    joint["provenance"] = serde_json::json!({
        "records": [{"name": "bolt & nut", "samples": 401, "sha256": "ab12",
                     "duration": 8.0, "sample_interval": 0.02}],
        "date": "2024-05-01T12:00:00Z",
        "tool": "a <test>",
        "verdict": {"word": "explained", "held_out_rms_ratio": 0.25, "interval": [0.2, 0.3]},
    });
    joint["intervals"] = serde_json::json!({
        "coefficient": [3.5, 4.5], "exponent": [null, 0.5], "joint_stiffness": [null, null],
    });
    let joint = joint.to_string();
    std::fs::write(folder.join("joint.json"), &joint).expect("a joint");
    let archive = fine(&folder, &["joint.json", "-o", "joint.fmu"]);
    let page = String::from_utf8(entry(&archive, "documentation/index.html")).expect("UTF-8");
    for told in [
        "bolt &amp; nut",
        "<code>ab12</code>",
        "Verdict: <strong>explained</strong>",
        "0.250 (95 %: 0.200 … 0.300)",
        "a &lt;test&gt;, 2024-05-01T12:00:00Z",
        "--stop-time 8 --output-interval 0.02",
        "3.500000e0 … 4.500000e0",
        "below 5.000000e-1",
        "<code>joint_stiffness</code>: not bounded by the data",
        "The response is exact",
    ] {
        assert!(page.contains(told), "{told}\n{page}");
    }
    let xml = String::from_utf8(entry(&archive, "modelDescription.xml")).expect("UTF-8");
    assert!(
        xml.contains("startTime=\"0\" stopTime=\"8.0\" stepSize=\"0.02\""),
        "{xml}"
    );
    assert!(
        xml.contains("generationDateAndTime=\"2024-05-01T12:00:00Z\""),
        "{xml}"
    );
}

/// Folders of both versions; ARM has one name in either.
#[test]
fn platforms_have_the_names_of_each_version() {
    use iwan::pack::PLATFORMS;
    let platforms = [
        ("linux64", "x86_64-linux", "IwanJoint.so"),
        ("win64", "x86_64-windows", "IwanJoint.dll"),
        ("darwin64", "x86_64-darwin", "IwanJoint.dylib"),
        ("linux32", "x86-linux", "IwanJoint.so"),
        ("win32", "x86-windows", "IwanJoint.dll"),
        ("darwin32", "x86-darwin", "IwanJoint.dylib"),
        ("aarch64-linux", "aarch64-linux", "IwanJoint.so"),
        ("aarch64-darwin", "aarch64-darwin", "IwanJoint.dylib"),
    ];
    assert_eq!(platforms.len(), PLATFORMS.len());
    for (platform, folder, file) in platforms {
        let library = Library {
            platform: Platform::named(platform).expect("a platform"),
            path: PathBuf::new(),
            bytes: vec![],
        };
        let entries = [FmiVersion::Two, FmiVersion::Three].map(|version| library.entry(version));
        let expected = [platform, folder].map(|folder| format!("binaries/{folder}/{file}"));
        assert_eq!(entries, expected);
        for (version, folder) in [(FmiVersion::Two, platform), (FmiVersion::Three, folder)] {
            let found = Platform::of_folder(version, folder).expect("a folder of that version");
            assert_eq!(found.name, platform);
        }
    }
    assert!(Platform::of_folder(FmiVersion::Three, "linux64").is_none());
    assert!(Platform::named("x86_64-linux").is_err());
}

/// The terminal of FMI 3.0 names variables that every joint has.
#[test]
fn the_terminal_names_variables_of_the_joint() {
    let xml = iwan::pack::terminals::xml().expect("XML");
    std::fs::write(folder("terminals").join("terminalsAndIcons.xml"), &xml).expect("a file");
    let xml = String::from_utf8(xml).expect("UTF-8");
    let joint = iwan::saved::read(JOINT, "joint.json")
        .expect("a joint")
        .joint;
    let variables = iwan::variables::Variables::of(&joint, Drive::Force).expect("variables");
    let named: Vec<_> = xml
        .split("variableName=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    assert_eq!(named, ["displacement", "force"]);
    for name in named {
        assert!(
            variables.iter().any(|variable| variable.name == name),
            "{name}"
        );
    }
}
