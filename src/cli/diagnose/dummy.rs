//! The dummy beside the records.

use super::{Diagnose, FEWEST, histories};
use crate::cli::{BadInput, input, signs};
use crate::read::{self, Loaded};
use crate::record::{Measurement, Record};

/// The dummy's record, where one is given.
///
/// # Errors
/// As in reading the records; [`BadInput`] for a dummy beside amplitude tables, which show nothing of what it could,
/// and for one that is a record of the joint: it would prove that the joint's own loop is the measuring chain's.
pub fn load(arguments: &Diagnose, records: &[Loaded]) -> anyhow::Result<Option<Record>> {
    let Some(file) = &arguments.dummy else {
        return Ok(None);
    };
    let is_table = |loaded: &Loaded| matches!(loaded.measurement, Measurement::Amplitudes(_));
    if records.iter().any(is_table) {
        let message = "--dummy: nothing here has a use for it: it is compared sample by sample, \
                       and an amplitude table has none; leave it out";
        return Err(BadInput(message.to_string()).into());
    }
    let loaded = read::file(file, &arguments.records.foreign.options()?)?;
    if let Some(same) = records.iter().position(|r| r.sha256 == loaded.sha256) {
        let (file, same) = (file.display(), arguments.records.files[same].display());
        let message = format!(
            "{file}: same content as {same}; the dummy is a solid specimen in the joint's place, measured by itself"
        );
        return Err(BadInput(message).into());
    }
    input::tell_notes(file, &loaded.notes);
    if let Measurement::History(record) = &loaded.measurement {
        let named = [(file.as_path(), record)];
        FEWEST.admit(&named)?;
        signs::admit(named)?;
    }
    Ok(histories(std::slice::from_ref(file), std::slice::from_ref(&loaded))?.pop())
}
