//! The folder of a diagnosis: what may stand in it before, and what of an earlier one is taken away.

use crate::cli::BadInput;
use crate::cli::output::{self, Draft};
use crate::diagnose::experiment::Experiment;
use std::path::Path;

/// The load program among the results.
pub const PROGRAM: &str = "next_experiment.csv";
/// All results of a diagnosis.
const NAMES: [&str; 5] = [
    "report.html",
    "diagnosis.json",
    "joint.json",
    "joint.fmu",
    PROGRAM,
];

/// Refuses, before any work is done, a folder that takes no results or in which they would replace
/// what no diagnosis wrote: an input, or a measurement under the name of the load program that it ran.
///
/// # Errors
/// [`BadInput`] naming the path and the way out.
pub fn admit(folder: &Path, inputs: &[&Path]) -> Result<(), BadInput> {
    output::admit_folder(folder, &NAMES, inputs)?;
    let program = folder.join(PROGRAM);
    match std::fs::read_to_string(&program) {
        Ok(text) if is_program(&text) => Ok(()),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(()),
        _ => Err(BadInput(format!(
            "{}: this is no load program that a diagnosis wrote, and would be replaced or removed; \
             write into another folder or give the file another name",
            program.display()
        ))),
    }
}

/// What the header of a program begins with; the drive follows.
const TIME: &str = "time [s],";
/// In the words of every block ([`crate::diagnose::experiment::program::Block::words`]).
const CYCLES: &str = " cycles of ";

/// The program as a load for `iwan simulate`.
pub fn program(experiment: &Experiment) -> String {
    let mut text = String::new();
    for block in &experiment.blocks {
        text += &format!("# {block}\n");
    }
    text += &format!("{TIME}{} [{}]\n", experiment.drive, experiment.unit);
    for (time, value) in experiment.time.iter().zip(&experiment.values) {
        text += &format!("{time:?},{value:?}\n");
    }
    text
}

/// True for a text as [`program`] makes it: its blocks in comments, its header, and numbers written
/// as only a program writes them. What was measured has a column more.
fn is_program(text: &str) -> bool {
    let mut lines = text.lines();
    let mut blocks = 0;
    let header = lines.by_ref().find(|line| {
        let block = line.starts_with("# ") && line.contains(CYCLES);
        blocks += usize::from(block);
        !block
    });
    let is_header = matches!(
        header.and_then(|line| line.strip_prefix(TIME)),
        Some("force [N]" | "displacement [m]")
    );
    let is_written = |cell: &str| {
        let number = cell.parse::<f64>();
        number.is_ok_and(|number| format!("{number:?}") == cell)
    };
    let is_row = |line: &str| {
        let cells = line.split_once(',');
        cells.is_some_and(|(time, value)| is_written(time) && is_written(value))
    };
    blocks > 0 && is_header && lines.all(is_row)
}

/// Writes the results, named, into the folder, which is made where it is not there; tells each. Only when
/// all of them are on the disk do they take the place of an earlier diagnosis's, of which nothing is
/// left: one that finds no room leaves everything as it was.
///
/// # Errors
/// [`BadInput`] naming the path, in the system's words.
pub fn write(folder: &Path, files: &[(&str, Vec<u8>)], tell: impl Fn(&str)) -> anyhow::Result<()> {
    let earlier = is_of_one(folder);
    let made = output::make_folder(folder)?;
    let drafts: Vec<Option<Draft>> = files
        .iter()
        .map(|(name, bytes)| output::draft(&folder.join(name), |out| Ok(out.write_all(bytes)?)))
        .collect::<anyhow::Result<_>>()?;
    for (draft, (name, _)) in drafts.into_iter().zip(files) {
        if let Some(draft) = draft {
            draft.commit()?;
        }
        tell(&folder.join(name).display().to_string());
    }
    made.keep();
    let written: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    clear(folder, &written, earlier)?;
    Ok(())
}

/// Takes away what an earlier diagnosis left in the folder and this one has not written anew: a joint
/// or a programme beside findings that are not its own would mislead. `earlier` as [`is_of_one`] was
/// before this one wrote: where no diagnosis has been, a joint is somebody else's and is kept.
fn clear(folder: &Path, written: &[&str], earlier: bool) -> Result<(), BadInput> {
    for name in NAMES {
        let path = folder.join(name);
        if written.contains(&name) || !path.is_file() {
            continue;
        }
        let shown = path.display();
        if !earlier && name != PROGRAM {
            output::tell(&format!("{shown} is of no diagnosis, and is kept"));
            continue;
        }
        std::fs::remove_file(&path)
            .map_err(|error| BadInput(format!("{shown}: cannot remove: {error}")))?;
        output::tell(&format!("{shown} of an earlier diagnosis is removed"));
    }
    Ok(())
}

/// True where a diagnosis has written into the folder.
fn is_of_one(folder: &Path) -> bool {
    let text = std::fs::read_to_string(folder.join("diagnosis.json"));
    text.is_ok_and(|text| text.contains("iwan-diagnosis/"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Names in the folder with what the files hold; `None` for folders.
    fn content(folder: &Path) -> Vec<(String, Option<String>)> {
        let entries = fs::read_dir(folder).expect("the folder").flatten();
        let mut all: Vec<_> = entries
            .map(|entry| {
                let name = entry.file_name().to_string_lossy().into_owned();
                (name, fs::read_to_string(entry.path()).ok())
            })
            .collect();
        all.sort();
        all
    }

    /// Two results and one of that name.
    fn results(last: &str) -> [(&str, Vec<u8>); 3] {
        ["report.html", "diagnosis.json", last].map(|name| (name, b"of this one".to_vec()))
    }

    #[test]
    fn results_of_which_one_finds_no_place_leave_everything_as_it_was() {
        let place = std::env::temp_dir().join(format!("iwan results {}", std::process::id()));
        let _ = fs::remove_dir_all(&place); // of an earlier run, if any
        fs::create_dir_all(place.join("joint.fmu")).expect("a folder where a file is to be");
        let earlier = [
            ("report.html", "of an earlier one"),
            ("diagnosis.json", "{\"schema\": \"iwan-diagnosis/1\"}"),
            ("joint.json", "of an earlier one"),
        ];
        for (name, text) in earlier {
            fs::write(place.join(name), text).expect("written");
        }
        let before = content(&place);
        assert!(write(&place, &results("joint.fmu"), |_| ()).is_err());
        assert_eq!(content(&place), before);
        // nor does a folder stay that was made for them: no file has a name that long
        let inner = place.join("made/for it");
        assert!(write(&inner, &results(&"x".repeat(300)), |_| ()).is_err());
        assert_eq!(content(&place), before);
        fs::remove_dir(place.join("joint.fmu")).expect("the folder");
        assert!(write(&place, &results("joint.fmu"), |_| ()).is_ok());
        let written = ["diagnosis.json", "joint.fmu", "report.html"];
        let expected = written.map(|name| (name.to_owned(), Some("of this one".to_owned())));
        assert_eq!(content(&place), expected);
        fs::remove_dir_all(&place).expect("the test's own folder");
    }

    #[test]
    fn a_program_is_told_from_what_was_measured_under_its_name() {
        let blocks = "# 2 cycles of sine, amplitude 180 N, 5.03 Hz\n";
        let rows = "0.0,0.0\n0.001,0.5\n0.002,-1e-17\n";
        let written = format!("{blocks}time [s],force [N]\n{rows}");
        assert!(is_program(&written));
        assert!(is_program(
            &written.replace("force [N]", "displacement [m]")
        ));
        assert!(is_program(&written.replace('\n', "\r\n")));
        for (what, text) in [
            ("nothing", String::new()),
            ("no blocks", format!("time [s],force [N]\n{rows}")),
            (
                "a column more",
                format!("{blocks}time [s],force [N],displacement [m]\n0.0,0.0,1e-7\n"),
            ),
            (
                "a column more below",
                format!("{blocks}time [s],force [N]\n0.0,0.0,1e-7\n"),
            ),
            (
                "another unit",
                format!("{blocks}time [s],force [kN]\n{rows}"),
            ),
            (
                "other numbers",
                format!("{blocks}time [s],force [N]\n0,0\n0.001,0.50\n"),
            ),
            ("a remark", format!("{written}# as run on the rig\n")),
        ] {
            assert!(!is_program(&text), "{what}");
        }
    }
}
