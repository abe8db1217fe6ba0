//! What the records say of themselves that a reader of any result should know.

use super::{gaps, preload, stiffness};
use crate::read::Loaded;

/// In sentences, for standard error and for the result.
pub fn notes(loaded: &[Loaded]) -> Vec<String> {
    let mut notes = preload::notes(loaded);
    notes.extend(stiffness::notes(loaded));
    notes.extend(gaps::notes(loaded));
    notes
}
