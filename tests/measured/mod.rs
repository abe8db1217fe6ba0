//! Measured records of others, no part of the repository: docs/real-*.md say whose they are.

use std::path::{Path, PathBuf};

/// The folder that `IWAN_REAL_DATA` names, else `shared/data` beside the repository. `None` where it is
/// missing: scripts/test.sh tells that these records were not run.
pub fn records() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let named = std::env::var_os("IWAN_REAL_DATA").filter(|named| !named.is_empty());
    let folder = named.map_or_else(beside, PathBuf::from);
    folder.is_dir().then_some(folder)
}
