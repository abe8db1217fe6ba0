//! Files that are whole or not there: written under another name, renamed at the end.

use super::BadInput;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// The name that stands for the standard output.
const SCREEN: &str = "-";

/// Refuses, before any work is done, an output that could not be written or that is one of the
/// inputs.
///
/// # Errors
/// [`BadInput`] naming the path and the way out.
pub fn admit(path: &Path, inputs: &[&Path]) -> Result<(), BadInput> {
    if path == Path::new(SCREEN) {
        return Ok(());
    }
    if path.is_dir() {
        let shown = path.display();
        return Err(BadInput(format!(
            "{shown}: this is a folder; name a file to write"
        )));
    }
    let folder = folder_of(path);
    if !folder.is_dir() {
        let (path, folder) = (path.display(), folder.display());
        return Err(BadInput(format!(
            "{path}: there is no folder `{folder}` to write into; make it first"
        )));
    }
    let same = |input: &&&Path| match (path.canonicalize(), input.canonicalize()) {
        (Ok(output), Ok(input)) => output == input,
        _ => false,
    };
    match inputs.iter().find(same) {
        Some(_) => Err(BadInput(format!(
            "{}: this is an input; write the result to another file",
            path.display()
        ))),
        None => Ok(()),
    }
}

/// Refuses, before any work is done, a folder that could not be made or written into.
///
/// # Errors
/// [`BadInput`] naming the path and the way out.
pub fn admit_folder(path: &Path) -> Result<(), BadInput> {
    let shown = path.display();
    if path.exists() && !path.is_dir() {
        return Err(BadInput(format!(
            "{shown}: this is a file; name a folder to write into"
        )));
    }
    let file_above = path.ancestors().skip(1).find(|above| above.is_file());
    if let Some(above) = file_above {
        return Err(BadInput(format!(
            "{shown}: `{}` is a file; name a folder to write into",
            above.display()
        )));
    }
    Ok(())
}

/// The folder, made where it is not there: to be called when the results are ready.
///
/// # Errors
/// [`BadInput`] as [`admit_folder`] or in the system's words.
pub fn make_folder(path: &Path) -> Result<(), BadInput> {
    admit_folder(path)?;
    if path.is_dir() {
        return Ok(());
    }
    fs::create_dir_all(path).map_err(|error| {
        BadInput(format!(
            "{}: cannot make this folder: {error}",
            path.display()
        ))
    })
}

/// Writes a file by `fill`. Until all of it is on the disk a file of that name stays as it was;
/// on an error nothing is left. `-` is the standard output; a device or pipe is written to as it
/// is.
///
/// # Errors
/// [`BadInput`] as [`admit`] or in the system's words; whatever `fill` returns.
pub fn write<F>(path: &Path, fill: F) -> anyhow::Result<()>
where
    F: FnOnce(&mut dyn Write) -> anyhow::Result<()>,
{
    if path == Path::new(SCREEN) {
        let mut out = BufWriter::new(io::stdout().lock());
        return unless_closed(fill(&mut out).and_then(|()| Ok(out.flush()?)));
    }
    admit(path, &[])?;
    let refused = |error: io::Error| BadInput(format!("{}: cannot write: {error}", path.display()));
    // a link stays a link: what it points to is replaced
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    if fs::metadata(&target).is_ok_and(|found| !found.is_file()) {
        let mut out = File::options().write(true).open(&target).map_err(refused)?;
        return fill(&mut out);
    }
    let draft = Draft::new(&target);
    let mut out = BufWriter::new(File::create(&draft.path).map_err(refused)?);
    fill(&mut out)?;
    let file = out
        .into_inner()
        .map_err(|error| refused(error.into_error()))?;
    if let Ok(before) = fs::metadata(&target) {
        file.set_permissions(before.permissions())
            .map_err(refused)?;
    }
    file.sync_all().map_err(refused)?;
    drop(file);
    fs::rename(&draft.path, &target).map_err(refused)?;
    Ok(())
}

/// Prints a result. A reader that has had enough (`iwan causes | head`) is no error.
pub fn print(text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    unless_closed(
        out.write_all(text.as_bytes())
            .and_then(|()| out.flush())
            .map_err(Into::into),
    )
}

/// Says what happened. The work is done whether anyone listens or not (`2>&1 | head`), so that a
/// closed standard error is no error.
pub fn tell(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}

fn unless_closed(result: anyhow::Result<()>) -> anyhow::Result<()> {
    match result {
        Err(error)
            if error
                .downcast_ref::<io::Error>()
                .is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe) =>
        {
            Ok(())
        }
        other => other,
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// The file under its passing name, in the same folder; removed unless it was renamed.
struct Draft {
    path: PathBuf,
}

impl Draft {
    fn new(target: &Path) -> Draft {
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let passing = format!(".{name}.{}.part", std::process::id());
        Draft {
            path: folder_of(target).join(passing),
        }
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // after the rename there is nothing to remove
        let _ = fs::remove_file(&self.path);
    }
}
