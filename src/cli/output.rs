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
    if inputs.iter().any(|input| same(&input)) {
        return Err(BadInput(format!(
            "{}: this is an input; write the result to another file",
            path.display()
        )));
    }
    // a device or a pipe is written to as it is; a link stays a link, and what it points to is replaced
    match path.metadata() {
        Ok(found) if !found.is_file() => Ok(()),
        _ => takes(&path.canonicalize().unwrap_or_else(|_| path.to_path_buf())),
    }
}

/// Refuses a file that cannot be made, or made anew: by making its draft.
fn takes(target: &Path) -> Result<(), BadInput> {
    let draft = Draft::new(target, target.to_path_buf());
    File::create(&draft.passing).map(drop).map_err(|error| {
        BadInput(format!(
            "{}: cannot write: {error}; name another place",
            target.display()
        ))
    })
}

/// Refuses, before any work is done, a folder that could not be made or written into, or in which one
/// of the files to write is an input.
///
/// # Errors
/// [`BadInput`] naming the path and the way out.
pub fn admit_folder(path: &Path, files: &[&str], inputs: &[&Path]) -> Result<(), BadInput> {
    is_no_file(path)?;
    // Made and taken away again: only the system knows whether it can be.
    let made = Made::new(path)?;
    takes(&path.join(files.first().unwrap_or(&"iwan")))?;
    drop(made);
    for file in files.iter().map(|name| path.join(name)) {
        let Ok(there) = file.canonicalize() else {
            continue;
        };
        let shown = file.display();
        if there.is_dir() {
            return Err(BadInput(format!(
                "{shown}: this is a folder where a file is to be written; move it or write into another \
                 folder"
            )));
        }
        let same = |input: &&&Path| input.canonicalize().is_ok_and(|input| input == there);
        if inputs.iter().any(|input| same(&input)) {
            return Err(BadInput(format!(
                "{shown}: this is an input, and a result of that name would replace it; write into \
                 another folder or move the file"
            )));
        }
    }
    Ok(())
}

fn is_no_file(path: &Path) -> Result<(), BadInput> {
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
pub fn make_folder(path: &Path) -> Result<Made, BadInput> {
    is_no_file(path)?;
    Made::new(path)
}

/// Folders that were made, the innermost first; taken away again unless they are kept.
#[derive(Debug)]
pub struct Made(Vec<PathBuf>);

impl Made {
    fn new(path: &Path) -> Result<Made, BadInput> {
        let missing = path
            .ancestors()
            .take_while(|above| *above != Path::new("") && !above.is_dir());
        // before it is tried: what is made of a path that cannot be made goes away, too
        let made = Made(missing.map(Path::to_path_buf).collect());
        if made.0.is_empty() {
            return Ok(made);
        }
        match fs::create_dir_all(path) {
            Ok(()) => Ok(made),
            Err(error) => Err(BadInput(format!(
                "{}: cannot make this folder: {error}; name another one",
                path.display()
            ))),
        }
    }

    /// Lets them stay.
    pub fn keep(mut self) {
        self.0.clear();
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        for folder in &self.0 {
            // only an empty folder can be removed so: nothing of others is lost
            let _ = fs::remove_dir(folder);
        }
    }
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
    match draft(path, fill)? {
        Some(draft) => Ok(draft.commit()?),
        None => Ok(()),
    }
}

/// Writes all of a file by `fill`, beside the one of that name, which stays as it is until
/// [`Draft::commit`]: several files can so be written all or none. `None` for a device or pipe, which
/// has been written to as it is.
///
/// # Errors
/// As [`write`].
pub fn draft<F>(path: &Path, fill: F) -> anyhow::Result<Option<Draft>>
where
    F: FnOnce(&mut dyn Write) -> anyhow::Result<()>,
{
    admit(path, &[])?;
    let refused = |error: io::Error| BadInput(format!("{}: cannot write: {error}", path.display()));
    let sorted = |error: anyhow::Error| match error.downcast::<io::Error>() {
        Ok(error) => refused(error).into(),
        Err(other) => other,
    };
    // a link stays a link: what it points to is replaced
    let target = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    if fs::metadata(&target).is_ok_and(|found| !found.is_file()) {
        let mut out = File::options().write(true).open(&target).map_err(refused)?;
        fill(&mut out).map_err(sorted)?;
        return Ok(None);
    }
    let draft = Draft::new(path, target);
    let mut out = BufWriter::new(File::create(&draft.passing).map_err(refused)?);
    fill(&mut out).map_err(sorted)?;
    let file = out
        .into_inner()
        .map_err(|error| refused(error.into_error()))?;
    if let Ok(before) = fs::metadata(&draft.target) {
        file.set_permissions(before.permissions())
            .map_err(refused)?;
    }
    file.sync_all().map_err(refused)?;
    Ok(Some(draft))
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

/// A closed standard output is no error; one that takes no more is one that the user can mend.
fn unless_closed(result: anyhow::Result<()>) -> anyhow::Result<()> {
    let Err(error) = result else {
        return Ok(());
    };
    match error.downcast::<io::Error>() {
        Ok(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Ok(error) => Err(BadInput(format!(
            "standard output: cannot write: {error}; make room or send it elsewhere"
        ))
        .into()),
        Err(other) => Err(other),
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// A file under its passing name, in the folder of the one that it will be; removed unless it is
/// committed.
#[derive(Debug)]
pub struct Draft {
    named: PathBuf,
    target: PathBuf,
    passing: PathBuf,
}

impl Draft {
    /// Of the file that is `named` so and stands at `target`.
    fn new(named: &Path, target: PathBuf) -> Draft {
        // of the name that was given: links of several names may lead to one file
        let name = named.file_name().unwrap_or_default().to_string_lossy();
        let passing = format!(".{name}.{}.part", std::process::id());
        Draft {
            named: named.to_path_buf(),
            passing: folder_of(&target).join(passing),
            target,
        }
    }

    /// Gives the file its own name, in the place of what had it.
    ///
    /// # Errors
    /// [`BadInput`] in the system's words.
    pub fn commit(self) -> Result<(), BadInput> {
        fs::rename(&self.passing, &self.target).map_err(|error| {
            let shown = self.named.display();
            BadInput(format!("{shown}: cannot write: {error}"))
        })
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // after the rename there is nothing to remove
        let _ = fs::remove_file(&self.passing);
    }
}
