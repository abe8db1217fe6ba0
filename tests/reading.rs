//! Files as laboratories write them, and what is read from them.

use iwan::read::{self, Options, Quantity, ReadError};
use iwan::record::{AmplitudeTable, Measurement, Record};
use std::path::{Path, PathBuf};

mod measured;

/// A file of that content, in a folder of this test run.
fn written(name: &str, content: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reading");
    std::fs::create_dir_all(&folder).expect("a folder for test files");
    let path = folder.join(name);
    std::fs::write(&path, content).expect("a test file");
    path
}

fn history_by(name: &str, content: impl AsRef<[u8]>, options: &Options) -> Record {
    let loaded = read::file(&written(name, content.as_ref()), options);
    match loaded
        .unwrap_or_else(|error| panic!("{name}: {error}"))
        .measurement
    {
        Measurement::History(record) => record,
        other => panic!("{name}: {other:?}"),
    }
}

fn history(name: &str, content: impl AsRef<[u8]>) -> Record {
    history_by(name, content, &Options::default())
}

fn options(columns: &str, units: &str) -> Options {
    let given = |text| Some(text).filter(|text: &&str| !text.is_empty());
    Options::from_arguments(given(columns), given(units)).expect("good options")
}

/// Time 0, 0.5, 1 s; force 1000, −2500, 0 N; displacement 0.0015, −0.002, 0 m.
fn assert_is_the_same_test(record: &Record) {
    assert_eq!(
        record.time.as_deref(),
        Some(&[0.0, 0.5, 1.0][..]),
        "{}",
        record.name
    );
    assert_eq!(record.force, [1000.0, -2500.0, 0.0], "{}", record.name);
    assert_eq!(
        record.displacement,
        [0.0015, -0.002, 0.0],
        "{}",
        record.name
    );
}

#[test]
fn one_test_written_in_many_ways_is_one_record() {
    let files: &[(&str, &str)] = &[
        (
            "contract.csv",
            "time [s], force [N], displacement [m]\n0,1000,0.0015\n0.5,-2500,-0.002\n1,0,0\n",
        ),
        (
            "order.csv",
            "Displacement (mm),TIME (ms),Force (kN)\n1.5,0,1\n-2,500,-2.5\n0,1000,0\n",
        ),
        (
            "decimal_comma.csv",
            "Zeit t;t [s];F [kN];u [mm]\n1;0;1;1,5\n1;0,5;-2,5;-2\n1;1,0;0,0;0,0\n",
        ),
        (
            "tabs.csv",
            "t [s]\tload [N]\tstroke [mm]\n0\t1e3\t1.5\n0.5\t-2500\t-2\n1\t0\t-0\n",
        ),
        (
            "comments.csv",
            "# rig 7, \"fine\n\n#\ntime [s],force [N],displacement [m]\n# first\n0,1000,0.0015\n\n0.5,-2500,-0.002\n  # second\n1,0,0\n# end",
        ),
        (
            "bom_crlf.csv",
            "\u{feff}time [s],force [N],displacement [mm]\r\n0,1000,1.5\r\n0.5,-2500,-2\r\n1,0,0\r\n",
        ),
        (
            "old_mac.csv",
            "time [s],force [N],displacement [mm]\r0,1000,1.5\r0.5,-2500,-2\r1,0,0\r",
        ),
        (
            "quoted.csv",
            "\"time [s]\",\"force [N]\",\"displacement [mm]\"\n\"0\",\"1000\",\"1,5\"\n\"0,5\",\"-2500\",\"-2\"\n\"1\",\"0\",\"0\"\n",
        ),
        (
            "spaced_quotes.csv",
            "\"time [s]\", \"force [N]\", \"displacement [mm]\"\n0, \"1000\", 1.5\n0.5, \"-2500\", -2\n1, \"0\", 0\n",
        ),
        (
            "unit_row.csv",
            "Time,Axial Force,Extension\ns,(kN),[mm]\n0,1,1.5\n.5,-2.5,-2\n1,0,0\n",
        ),
        (
            "trailing.csv",
            "time [s],force [N],displacement [mm],\n0,1000,1.5,\n0.5,-2500,-2,,\n1,0,0,\n,,,\n,,,\n",
        ),
        (
            "commented_header.csv",
            "# lab\n# t [s], F [N], x [mm]\n0,1000,1.5\n0.5,-2500,-2\n1,0,0\n",
        ),
        (
            "micro.csv",
            "time [µs],force [mN],displacement [μm]\n0,1e6,1500\n500000,-2.5e6,-2000\n1e6,0,0\n",
        ),
        (
            "mega.csv",
            "time [MS],force [MN],displacement [M]\n0,0.001,0.0015\n500,-0.0025,-0.002\n1000,0,0\n",
        ),
        (
            "Prüfstand 7 – große Last.csv",
            "t [s],F [N],u [mm]\n0,1000,1.5\n0.5,-2500,-2\n1,0,0\n",
        ),
    ];
    for (name, content) in files {
        let record = history(name, content);
        assert_is_the_same_test(&record);
        assert_eq!(format!("{}.csv", record.name), *name);
    }
}

#[test]
fn latin_1_and_utf_16_are_text() {
    let latin_1 = b"time [s],force [N],displacement [\xb5m]\n0,1000,1500\n0.5,-2500,-2000\n1,0,0\n";
    assert_is_the_same_test(&history("latin_1.csv", latin_1));
    let text = "time [s]\tforce [N]\tdisplacement [µm]\n0\t1000\t1500\n.5\t-2500\t-2000\n1\t0\t0\n";
    let little: Vec<u8> = [0xfeff]
        .into_iter()
        .chain(text.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    assert_is_the_same_test(&history("utf_16.csv", little));
}

#[test]
fn units_have_their_defined_values() {
    // NIST SP 811 (2008), appendix B: definitions, exact.
    let force = [
        ("N", 1.0),
        ("kN", 1e3),
        ("mN", 1e-3),
        ("MN", 1e6),
        ("KN", 1e3),
        ("lbf", 4.4482216152605),
        ("kip", 4448.2216152605),
        ("dyn", 1e-5),
        ("kgf", 9.80665),
        ("tonf", 9806.65),
    ];
    let length = [
        ("m", 1.0),
        ("mm", 1e-3),
        ("um", 1e-6),
        ("µm", 1e-6),
        ("nm", 1e-9),
        ("cm", 1e-2),
        ("in", 0.0254),
        ("inch", 0.0254),
        ("mil", 2.54e-5),
    ];
    for (unit, newtons) in force {
        let record = history("force.csv", format!("F [{unit}],u [m]\n1,2\n3,4\n"));
        assert!(
            (record.force[0] / newtons - 1.0).abs() < 1e-15,
            "{unit}: {}",
            record.force[0]
        );
        assert_eq!(record.time, None);
    }
    for (unit, metres) in length {
        let record = history("length.csv", format!("F [N],u [{unit}]\n1,1\n3,4\n"));
        let read = record.displacement[0];
        assert!((read / metres - 1.0).abs() < 1e-15, "{unit}: {read}");
    }
    let energy = [
        ("J", 1.0),
        ("kJ", 1e3),
        ("mJ", 1e-3),
        ("uJ", 1e-6),
        ("N.m", 1.0),
        ("N*mm", 1e-3),
    ];
    let british = [("lbf.in", 4.4482216152605 * 0.0254), ("mJ/cycle", 1e-3)];
    for (unit, joules) in energy.into_iter().chain(british) {
        let table = format!("force amplitude [N],dissipation [{unit}]\n1,1\n");
        let read = read::file(
            &written("energy.csv", table.as_bytes()),
            &Options::default(),
        );
        let Ok(Measurement::Amplitudes(table)) = read.map(|loaded| loaded.measurement) else {
            panic!("{unit}: no amplitude table");
        };
        assert!(
            (table.dissipation[0] / joules - 1.0).abs() < 1e-15,
            "{unit}"
        );
    }
    let seconds = [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("min", 60.0)];
    for (unit, duration) in seconds {
        let record = history(
            "time.csv",
            format!("t [{unit}],F [N],u [m]\n1,1,1\n3,4,4\n"),
        );
        let first = record.time.expect("time")[0];
        assert!((first / duration - 1.0).abs() < 1e-15, "{unit}");
    }
}

#[test]
fn further_channels_are_kept_and_unknown_ones_named() {
    let content = "t [s],F [N],u [mm],T [degC],preload [kN],a [g],strain [1e-6],F2 [N]\n\
                   0,1,2,20,5,1,7,8\n1,1,2,21,5,0,7,8\n";
    let loaded = read::file(
        &written("channels.csv", content.as_bytes()),
        &Options::default(),
    )
    .expect("a good file");
    let Measurement::History(record) = loaded.measurement else {
        panic!("no history")
    };
    assert_eq!(record.temperature, Some(vec![20.0, 21.0]));
    assert_eq!(record.preload, Some(vec![5000.0, 5000.0]));
    assert_eq!(record.acceleration, Some(vec![9.80665, 0.0]));
    let unused = "columns not used: `strain [1e-6]`, `F2 [N]`";
    assert!(
        loaded.notes.iter().any(|note| note == unused),
        "{:?}",
        loaded.notes
    );
    // an optional channel that cannot be used is left out, and said so
    let volts = "t [s],F [N],u [mm],temperature [V]\n0,1,2,20\n1,1,2,21\n";
    let loaded = read::file(&written("volts.csv", volts.as_bytes()), &Options::default());
    let notes = loaded.expect("a good file").notes;
    assert!(
        notes.iter().any(|note| note.contains("unknown unit `V`")),
        "{notes:?}"
    );
}

#[test]
fn foreign_files_are_read_by_their_columns() {
    let units = "force=kN, displacement=mm, time=s";
    let by_number = options("force=3,displacement=2,time=1", units);
    assert_is_the_same_test(&history_by(
        "bare.csv",
        "0,1.5,1\n.5,-2,-2.5\n1,0,0\n",
        &by_number,
    ));
    let preamble =
        "Operator;NN\nGauge;long\nSec;Ext;Load;Count\n0;1,5;1;1\n0,5;-2;-2,5;2\n1;0;0;3\n";
    assert_is_the_same_test(&history_by("preamble.csv", preamble, &by_number));
    let by_name = options("force=LOAD,displacement=Ext,time=sec", units);
    assert_is_the_same_test(&history_by("preamble.csv", preamble, &by_name));
    // Numbers in a preamble are none of the chosen ones, by number or by name.
    let rated = format!("Test,7\nSample rate;1000\n{preamble}").replace("Test,7", "Test;7");
    for by in [&by_number, &by_name] {
        assert_is_the_same_test(&history_by("rated.csv", &rated, by));
    }
    // A fault in the first row is one, and no preamble.
    let faulty = written("faulty.csv", b"Load,Ext\nx,1\n2,3\n");
    let error = read::file(
        &faulty,
        &options("force=1,displacement=2", "force=N,displacement=m"),
    );
    let error = error.expect_err("a bad first row").to_string();
    assert!(error.contains("line 2, column 1 `Load`: `x`"), "{error}");
    // units of the header serve where the options give none
    let headed = "clock [ms],c1 [mm],c2 [kN]\n0,1.5,1\n500,-2,-2.5\n1000,0,0\n";
    let no_units = options("force=3,displacement=2,time=1", "");
    assert_is_the_same_test(&history_by("headed.csv", headed, &no_units));
    // units alone, for a header without them
    let unitless = "t,F,u\n0,1,1.5\n.5,-2.5,-2\n1,0,0\n";
    assert_is_the_same_test(&history_by("unitless.csv", unitless, &options("", units)));
}

/// Temperature and acceleration are read and not used: a record is as good without them.
#[test]
fn a_column_that_nothing_uses_refuses_no_record() {
    let content = "time [s],force [N],displacement [mm],temperature [degC],load [%]\n0,1000,1.5,20,1\n0.5,-2500,-2,,2\n1,0,0,21,3\n";
    let path = written("warm.csv", content.as_bytes());
    let loaded = read::file(&path, &Options::default()).expect("a good record");
    let said = loaded.notes.join("; ");
    assert!(
        said.contains("left out: ") && said.contains("line 3"),
        "{said}"
    );
    assert_is_the_same_test(&history("warm.csv", content));
    assert_eq!(history("warm.csv", content).temperature, None);
    // What is known and has no place here is not used either.
    let table = "force amplitude [N],dissipation [J],displacement [m]\n1,1e-6,1\n2,8e-6,2\n";
    let loaded = read::file(&written("stray.csv", table.as_bytes()), &Options::default());
    let notes = loaded.expect("a good table").notes.join("; ");
    assert!(
        notes.contains("columns not used: `displacement [m]`"),
        "{notes}"
    );
}

#[test]
fn columns_that_are_not_chosen_are_found_by_their_header() {
    let content = "t [s],F1 [kN],F [kN],u [mm]\n0,1,9,1.5\n.5,-2.5,9,-2\n1,0,9,0\n";
    assert_is_the_same_test(&history_by("chosen.csv", content, &options("force=2", "")));
    // Time in no unit that is known is left out where others are chosen, and needed where none are.
    let bare = "time,F [kN],u [mm]\n0,1,1.5\n.5,-2.5,-2\n1,0,0\n";
    let record = history_by("bare.csv", bare, &options("force=2,displacement=3", ""));
    assert_eq!(record.time, None);
    assert!(read::file(&written("bare.csv", bare.as_bytes()), &Options::default()).is_err());
    // A load is driven by what is chosen alone.
    let path = written("chosen load.csv", content.as_bytes());
    let load = read::load_table(&path, &options("displacement=4", "")).expect("a good load");
    assert_eq!(load.force, None);
    assert_eq!(load.time, [0.0, 0.5, 1.0]);
    // So does a choice of a table's columns make it one.
    let both = "F0 [N],F [N],u [m],energy [J]\n1,1,2,1e-3\n2,2,4,2e-3\n";
    let path = written("chosen table.csv", both.as_bytes());
    let loaded = read::file(&path, &options("dissipation=4", "")).expect("a good table");
    assert!(
        matches!(loaded.measurement, Measurement::Amplitudes(_)),
        "{loaded:?}"
    );
}

#[test]
fn a_row_of_units_serves_chosen_columns_too() {
    let table = "Time,Load,Extension\ns,(kN),[mm]\n0,1,1.5\n.5,-2.5,-2\n1,0,0\n";
    let said = "units were taken from the row below the header";
    for preamble in ["", "rig 7\n", "Operator,NN,\n# gauge\n\nGauge,long,\n"] {
        let content = format!("{preamble}{table}");
        for columns in [
            "force=2,displacement=3",
            "force=load,displacement=Extension",
            "time=1",
        ] {
            let by = options(columns, "");
            assert_is_the_same_test(&history_by("units below.csv", &content, &by));
        }
        let path = written("units below.csv", content.as_bytes());
        let notes = read::file(&path, &options("force=2", ""))
            .expect("a good file")
            .notes;
        assert_eq!(notes[0], said, "{notes:?}");
        assert_eq!(notes.len() > 1, !preamble.is_empty(), "{notes:?}");
    }
    // --units prevails over that row, and takes none of its other units away
    let other = table.replace("(kN)", "N");
    let by = options("force=2,displacement=3", "force=kN");
    assert_is_the_same_test(&history_by("units over.csv", other, &by));
}

#[test]
fn units_with_no_names_above_them_stay_the_header() {
    let rows = "0,1,1.5\n.5,-2.5,-2\n1,0,0\n";
    let by = options(
        "time=s,force=kN,displacement=mm",
        "time=s,force=kN,displacement=mm",
    );
    for (name, preamble) in [("units alone.csv", ""), ("units narrow.csv", "rig,7b\n")] {
        let content = format!("{preamble}s,kN,mm\n{rows}");
        assert_is_the_same_test(&history_by(name, content, &by));
    }
}

#[test]
fn amplitude_tables_are_read() {
    let content = "# resonance test\nFrequency (Hz);Dissipation (mJ);Force Amplitude (kN);u0 (um)\n\
                   80,5;2;0,1;5\n80;7;0,2;10\n";
    let loaded = read::file(
        &written("table.csv", content.as_bytes()),
        &Options::default(),
    )
    .expect("a good file");
    let expected = AmplitudeTable {
        name: "table".to_string(),
        force_amplitude: vec![100.0, 200.0],
        dissipation: vec![0.002, 0.007],
        displacement_amplitude: Some(vec![5e-6, 1e-5]),
        frequency: Some(vec![80.5, 80.0]),
    };
    assert_eq!(loaded.measurement, Measurement::Amplitudes(expected));
}

#[test]
fn the_hash_is_that_of_the_bytes() {
    // by `printf 'F [N],u [m]\n1,2\n' | sha256sum`
    let path = written("hash.csv", b"F [N],u [m]\n1,2\n");
    let loaded = read::file(&path, &Options::default()).expect("a good file");
    let by_sha256sum = "38ff7dc00790d3d63349c7600427f270172017a8cf89c0ad9b95bb95d69ed18c";
    assert_eq!(loaded.sha256, by_sha256sum);
}

#[test]
fn a_load_has_one_drive_or_both() {
    let load = |name: &str, content: &str| {
        read::load_table(&written(name, content.as_bytes()), &Options::default())
    };
    let one = load("load.csv", "t [s],F [kN]\n0,1\n1,2\n").expect("a good load");
    assert_eq!(one.time, [0.0, 1.0]);
    assert_eq!(one.force, Some(vec![1000.0, 2000.0]));
    assert_eq!(one.displacement, None);
    let missing = one.missing(Quantity::Displacement).to_string();
    assert!(
        missing.contains("no column displacement among 1 `t [s]`, 2 `F [kN]`"),
        "{missing}"
    );
    let both = load("both.csv", "u [mm],F [kN]\n#\n0,1\n1,2\n").expect("a good load");
    assert!(both.force.is_some() && both.displacement.is_some());
    assert_eq!(both.time, [0.0, 1.0]);
    assert!(
        both.notes
            .iter()
            .any(|note| note.contains("no time column")),
        "{:?}",
        both.notes
    );
    let spot = both.spot(Quantity::Force, 1).expect("a place").to_string();
    assert!(
        spot.ends_with("both.csv, line 4, column 2 `F [kN]`"),
        "{spot}"
    );
    let neither = load("neither.csv", "t [s],v\n0,1\n");
    assert!(
        matches!(neither, Err(ReadError::MissingColumn { .. })),
        "{neither:?}"
    );
}

#[test]
fn every_real_record_at_hand_is_read_as_it_is() {
    let Some(data) = measured::records() else {
        return;
    };
    let mut read = 0;
    for folder in std::fs::read_dir(&data).expect("a folder").flatten() {
        let Ok(files) = std::fs::read_dir(folder.path()) else {
            continue;
        };
        for path in files.flatten().map(|entry| entry.path()) {
            let loaded =
                read::file(&path, &Options::default()).unwrap_or_else(|error| panic!("{error}"));
            let text = std::fs::read_to_string(&path).expect("text");
            let rows = text.lines().filter(|line| !line.starts_with('#')).count() - 1;
            match loaded.measurement {
                Measurement::History(record) => {
                    assert_eq!(record.len(), rows, "{}", path.display());
                    assert_eq!(record.displacement.len(), rows);
                    assert_eq!(record.time.is_none(), record.name.starts_with("bearing"));
                    // joints and dampers of this size: below 1 MN and 1 m, above nothing
                    let largest = |v: &[f64]| v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
                    let (force, moved) = (largest(&record.force), largest(&record.displacement));
                    assert!(
                        (10.0..1e6).contains(&force),
                        "{}: {force} N",
                        path.display()
                    );
                    assert!(
                        (1e-5..1.0).contains(&moved),
                        "{}: {moved} m",
                        path.display()
                    );
                }
                Measurement::Amplitudes(table) => {
                    assert_eq!(table.name, "mode1_amplitude_table");
                    assert_eq!(table.dissipation.len(), rows);
                    let row = 3; // D = π F X, says the file
                    let moved = table.displacement_amplitude.expect("displacement")[row];
                    let expected = std::f64::consts::PI * table.force_amplitude[row] * moved;
                    assert!((table.dissipation[row] / expected - 1.0).abs() < 1e-6);
                }
            }
            read += 1;
        }
    }
    assert!(read > 0, "{} holds no record", data.display());
}

#[test]
fn a_million_rows_are_read_in_seconds() {
    let mut content = String::from("time [s],force [N],displacement [m]\n");
    for row in 0..1_000_000u32 {
        let load = f64::from(row % 1999) - 999.5;
        content.push_str(&format!(
            "{},{load},{}\n",
            f64::from(row) / 4096.0,
            load * 1.2345e-8
        ));
    }
    let path = written("million.csv", content.as_bytes());
    let start = std::time::Instant::now();
    let loaded = read::file(&path, &Options::default()).expect("a good file");
    let taken = start.elapsed();
    let Measurement::History(record) = loaded.measurement else {
        panic!("no history")
    };
    assert_eq!(record.len(), 1_000_000);
    println!(
        "1e6 rows, {} MB, in {:.2} s",
        content.len() / 1_000_000,
        taken.as_secs_f64()
    );
    // around 1 s where nothing else runs; the bound leaves room for a loaded machine
    assert!(taken.as_secs_f64() < 10.0, "{taken:?}");
    std::fs::remove_file(path).expect("the test file");
}

#[test]
fn what_was_assumed_is_said() {
    let notes = |name: &str, content: &str, options: &Options| {
        read::file(&written(name, content.as_bytes()), options)
            .expect("a good file")
            .notes
    };
    let said = |notes: &[String], words: &str| notes.iter().any(|note| note.contains(words));
    let comma = notes(
        "said 1.csv",
        "F [tonf];u [mm]\n1,5;2\n3;4\n",
        &Options::default(),
    );
    assert!(said(&comma, "decimal comma"), "{comma:?}");
    assert!(said(&comma, "metric ton-force, 9806.65 N"), "{comma:?}");
    assert!(said(&comma, "no time column"), "{comma:?}");
    let prevailing = options("", "force=kN,displacement=mm");
    let content = "t [s],F [N],u [mm]\n0,1,2\n1,3,4\n";
    let units = notes("said 2.csv", content, &prevailing);
    assert_eq!(units, ["F [N]: read in kN as --units says, not in N"]);
    let plain = notes("said 3.csv", content, &Options::default());
    assert!(plain.is_empty(), "{plain:?}");
}
