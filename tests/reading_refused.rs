//! Files that are refused: where they are wrong, what stands there, and the way out.

use iwan::read::{self, Options, ReadError};
use iwan::record::Measurement;
use proptest::prelude::{ProptestConfig, TestCaseError, prop_assert, proptest};
use std::path::{Path, PathBuf};

/// A file of that content, in a folder of this test run.
fn written(name: &str, content: &[u8]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reading refused");
    std::fs::create_dir_all(&folder).expect("a folder for test files");
    let path = folder.join(name);
    std::fs::write(&path, content).expect("a test file");
    path
}

fn refused(name: &str, content: impl AsRef<[u8]>) -> ReadError {
    let path = written(name, content.as_ref());
    read::file(&path, &Options::default()).expect_err("a bad file is refused")
}

fn options(columns: &str, units: &str) -> Options {
    Options::from_arguments(Some(columns), Some(units)).expect("good options")
}

#[test]
fn options_that_make_no_sense_are_refused() {
    for (columns, units) in [
        (Some("force"), None),
        (Some("weight=2"), None),
        (Some("force=0"), None),
        (Some(""), None),
        (None, Some(",")),
        (Some("force=1,load=2"), None),
        (None, Some("force=mm")),
        (None, Some("force=furlong")),
    ] {
        let refusal = Options::from_arguments(columns, units);
        assert!(
            matches!(refusal, Err(ReadError::Option { .. })),
            "{columns:?} {units:?}"
        );
    }
    let beyond = read::file(
        &written("narrow.csv", b"F [N],u [m]\n1,2\n"),
        &options("force=1,displacement=3", "force=N,displacement=m"),
    );
    let Err(error @ ReadError::NoSuchColumn { .. }) = beyond else {
        panic!("{beyond:?}")
    };
    assert!(
        error.to_string().contains("1 `F [N]`, 2 `u [m]`"),
        "{error}"
    );
}

#[test]
fn a_column_past_the_last_or_without_numbers_is_named() {
    let by = |name: &str, content: &str, columns: &str| {
        let options = Options::from_arguments(Some(columns), None).expect("good options");
        let loaded = read::file(&written(name, content.as_bytes()), &options);
        loaded.expect_err("a bad choice is refused").to_string()
    };
    let labelled = "# rig\nlabel,F [N],u [m]\na,1,2\nb,3,4\n";
    let past = by(
        "past.csv",
        "# rig\nt [s],F [N],u [m]\n0,1,2\n1,2,3\n",
        "force=9",
    );
    assert!(
        past.contains("line 2: --columns asks for force in column 9, and there are 1 `t [s]`"),
        "{past}"
    );
    let text = by("labelled.csv", labelled, "force=1");
    assert!(
        text.contains("no row has a number where --columns looks for one (force in column 1)"),
        "{text}"
    );
    // What is chosen for one quantity is not found for another by its header.
    let called = "Load [kN],Load [%],Disp [mm]\n1,2,3\n";
    let text = by("called.csv", called, "force=Load");
    assert!(
        text.contains("column 2 `Load [%]`: column 1 `Load [kN]`"),
        "{text}"
    );
    let taken = by("taken.csv", "t [s],F [N],u [m]\n0,1,2\n", "displacement=2");
    assert!(taken.contains("no column force among"), "{taken}");
}

#[test]
fn a_refusal_names_line_column_and_value() {
    let header = "# rig\ntime [s],force [N],displacement [mm]\n";
    let cases: &[(&str, &str, &[&str])] = &[
        (
            "0,1,2\n1,abc,2\n",
            "text",
            &[
                "line 4",
                "column 2 `force [N]`",
                "`abc`",
                "correct the cell",
            ],
        ),
        (
            "0,1,2\n1,1.5D-3,2\n",
            "power",
            &["line 4", "column 2", "`1.5D-3`", "with `e`"],
        ),
        (
            "0,1,2\n1,1e308,2\n",
            "beyond",
            &[
                "line 4",
                "column 2 `force [N]`",
                "`1e308`",
                "check the unit",
            ],
        ),
        (
            "0,1,2e-90\n1,2,-3e-90\n2,2,0\n",
            "vanishing",
            &["line 4", "column 3 `displacement [mm]`", "`-3e-90`", "unit"],
        ),
        (
            "1,1,2\n1e-200,2,3\n",
            "tiny time",
            &["line 4", "from 1 s to 1e-200 s"],
        ),
        (
            "0,1,2\n1,1,NaN\n",
            "nan",
            &["line 4", "column 3 `displacement [mm]`", "`NaN`"],
        ),
        (
            "0,1,2\n1,-inf,2\n",
            "inf",
            &["line 4", "column 2", "`-inf`"],
        ),
        (
            "0,1,2\n1,1e999,2\n",
            "overflow",
            &["line 4", "column 2", "`1e999`"],
        ),
        (
            "0,1,2\n# gap\n\n1,,2\n",
            "gap",
            &["line 6", "column 2", "empty"],
        ),
        ("0,1,2\n,,\n1,2,3\n", "blank", &["line 4", "empty"]),
        (
            "0,1,2\n1,2\n",
            "short",
            &[
                "line 4",
                "2 columns",
                "3",
                "`1,2`",
                "column 3 `displacement [mm]` is missing",
                "complete the row",
            ],
        ),
        (
            "0,1,2\n1,2,3,4\n",
            "long",
            &[
                "line 4",
                "4 columns",
                "3",
                "column 4 is beyond the header",
                "decimal commas need semicolons or tabs",
            ],
        ),
        (
            "0,1,2\n2,1,2\n1,1,2\n",
            "back",
            &["line 5", "column 1", "from 2 s to 1 s"],
        ),
        (
            "0,1,2\n0,1,2\n",
            "twice",
            &["line 4", "column 1", "time 0 s"],
        ),
        (
            "0,1,2\n1,2,\"\n2,3,\"\n",
            "torn",
            &["line 5", "column 3", "close the quote"],
        ),
        ("", "none", &["line 2", "no row", "add the rows"]),
    ];
    for (rows, name, words) in cases {
        let error = refused(&format!("refused {name}.csv"), format!("{header}{rows}")).to_string();
        assert!(error.contains(&format!("refused {name}.csv")), "{error}");
        for word in *words {
            assert!(
                error.contains(word),
                "{name}: `{word}` is missing in: {error}"
            );
        }
    }
}

#[test]
fn a_refused_header_says_what_would_do() {
    let cases: &[(&str, &str, &[&str])] = &[
        ("", "empty", &["empty"]),
        (
            "# only\n\n# comments\n",
            "comments",
            &["nothing but comments", "needs a header"],
        ),
        (
            "# rig\ntime [s],force [N],displacement [m]\n0;1;2\n1;2;3\n",
            "two separators",
            &["line 2", "the header has `,` and the rows have `;`"],
        ),
        (
            "time [s];force [N];displacement [m]\n0\t1\t2\n1\t2\t3\n",
            "two others",
            &["line 1", "the header has `;` and the rows have a tab"],
        ),
        (
            "time [s],force [N],displacement [m]\n0\n1\n",
            "one cell",
            &["line 2", "1 column where the table has 3"],
        ),
        ("force [N]\n1\n2\n", "one", &["line 1", "one column"]),
        ("1,2\n3,4\n", "bare", &["line 1", "header", "--columns"]),
        (
            "time [s],force [furlong],displacement [m]\n0,1,2\n",
            "unknown",
            &["column 2", "furlong", "kN"],
        ),
        (
            "time [s],force [mm],displacement [m]\n0,1,2\n",
            "other",
            &["column 2", "`mm`", "length"],
        ),
        (
            "time [s],force [mn],displacement [m]\n0,1,2\n",
            "mn",
            &["column 2", "unknown unit `mn`"],
        ),
        (
            "time,force [N],displacement [m]\n0,1,2\n",
            "no unit",
            &["column 1", "--units time=s"],
        ),
        (
            "time [s],force [N],strain\n0,1,2\n",
            "no u",
            &["no column displacement", "3 `strain`"],
        ),
        (
            "force [N],u [m],disp [m]\n0,1,2\n",
            "two",
            &["column 3 `disp [m]`", "column 2 `u [m]`"],
        ),
        (
            "force amplitude [N],frequency [Hz]\n0,1\n",
            "no D",
            &["no column dissipation"],
        ),
        (
            "force amplitude [N],dissipation [J]\n1,-1\n",
            "sign",
            &["line 2", "-1", "negative"],
        ),
        (
            "t [s];F [N];u [m]\n0;1,5;2.5\n",
            "mixed",
            &["line 2", "column 3", "mixes"],
        ),
        (
            "t [s];F [N];u [m]\n0;1.000,5;2\n",
            "thousands",
            &["line 2", "column 2", "thousands"],
        ),
    ];
    for (content, name, words) in cases {
        let error = refused(&format!("header {name}.csv"), content).to_string();
        for word in *words {
            assert!(
                error.contains(word),
                "{name}: `{word}` is missing in: {error}"
            );
        }
    }
}

#[test]
fn a_refused_header_is_looked_for_where_it_stands() {
    let cases: &[(&str, &str, &str)] = &[
        (
            "# rig\n# t [s],F,u [m]\n\n0,1,2\n",
            "comment no unit",
            "line 2, column 2 `F`: no unit",
        ),
        (
            "# t [s],F [N],v\n0,1,2\n",
            "comment missing",
            "line 1: no column displacement",
        ),
        (
            "# F [N],u [m],disp [m]\n0,1,2\n",
            "comment twice",
            "line 1, column 3 `disp [m]`: column 2 `u [m]`",
        ),
        (
            "# t [s],F [furlong],u [m]\n0,1,2\n",
            "comment unknown",
            "line 1, column 2 `F [furlong]`: unknown unit",
        ),
        (
            "time,force,disp\ns,mm,mm\n0,1,2\n",
            "unit below",
            "line 2, column 2 `force`: unit `mm` measures length",
        ),
        (
            "time,force [mm],disp\n# rig\ns,,mm\n0,1,2\n",
            "unit in the header",
            "line 1, column 2 `force [mm]`: unit `mm` measures length",
        ),
        (
            "time,force,disp\ns,,mm\n0,1,2\n",
            "unit nowhere",
            "line 1, column 2 `force`: no unit",
        ),
        // The way out is one word of a shell.
        (
            "force amplitude,dissipation [J]\n1,2\n",
            "two words",
            "--units force_amplitude=N",
        ),
        (
            "F [N],u [Nm]\n1,2\n",
            "energy",
            "line 1, column 2 `u [Nm]`: unit `Nm` measures energy",
        ),
    ];
    for (content, name, words) in cases {
        let error = refused(&format!("stands {name}.csv"), content).to_string();
        assert!(error.contains(words), "{name}: `{words}` in: {error}");
    }
    // A comment stands between header and units, and --columns leads to them.
    let content = "rig 7\ntime,force,disp\n# rig\ns,mm,mm\n0,1,2\n";
    let by = Options::from_arguments(Some("force=2"), None).expect("good options");
    let error = read::file(&written("stands chosen.csv", content.as_bytes()), &by)
        .expect_err("a bad unit is refused")
        .to_string();
    assert!(error.contains("line 4, column 2 `force`"), "{error}");
}

#[test]
fn what_is_no_text_file_is_refused() {
    assert!(matches!(
        refused("zip.csv", b"PK\x03\x04\0\0\x08\0"),
        ReadError::Binary { .. }
    ));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let of_folder = read::file(folder, &Options::default());
    assert!(
        matches!(of_folder, Err(ReadError::Directory { .. })),
        "{of_folder:?}"
    );
    let of_nothing = read::file(&folder.join("there is none.csv"), &Options::default());
    assert!(
        matches!(of_nothing, Err(ReadError::Missing { .. })),
        "{of_nothing:?}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever the rows, reading ends with values that are finite and of one length, or with an
    /// error that names the file.
    #[test]
    fn any_text_is_read_or_refused(rows in "[0-9,;\t\n\r.#\"a-eE µ\\[\\]-]{0,80}", headed in 0..3usize) {
        let header = ["", "time [s],force [N],displacement [m]\n", "t [s];F [N];u [mm]\r\n"][headed];
        let path = written("any.csv", format!("{header}{rows}").as_bytes());
        for options in [Options::default(), options("force=1,displacement=2", "force=N,displacement=m")] {
            match read::file(&path, &options) {
                Err(error) => prop_assert!(error.to_string().contains("any.csv"), "{error}"),
                Ok(loaded) => {
                    let Measurement::History(record) = loaded.measurement else {
                        return Err(TestCaseError::fail("no history"));
                    };
                    prop_assert!(!record.is_empty());
                    prop_assert!(record.displacement.len() == record.len());
                    prop_assert!(record.clock().len() == record.len());
                    prop_assert!(record.clock().windows(2).all(|pair| pair[0] < pair[1]));
                    let mut values = record.force.iter().chain(&record.displacement);
                    prop_assert!(values.all(|value| value.is_finite()));
                }
            }
        }
    }
}
