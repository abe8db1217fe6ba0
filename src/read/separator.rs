//! The sign between the columns.

use csv::StringRecord;

const CANDIDATES: [u8; 3] = *b"\t;,";

/// A separator that the header has and the rows do not use.
pub fn of_header(header: &StringRecord, of_rows: u8) -> Option<u8> {
    let bytes = header.as_slice().as_bytes();
    CANDIDATES
        .into_iter()
        .find(|candidate| *candidate != of_rows && bytes.contains(candidate))
}

/// A separator as it stands in a message.
pub fn sign(separator: u8) -> &'static str {
    match separator {
        b'\t' => "a tab",
        b';' => "`;`",
        _ => "`,`",
    }
}

/// The separator that most of the first rows show, tab before semicolon before comma within one
/// row: a comma beside the others is a decimal comma.
pub fn of_table(text: &str) -> u8 {
    let mut votes = [0; 3];
    let rows = text
        .lines()
        .map(str::trim_start)
        .filter(|l| !l.is_empty() && !l.starts_with('#'));
    for row in rows.take(64) {
        if let Some(found) = CANDIDATES
            .iter()
            .position(|sign| row.as_bytes().contains(sign))
        {
            votes[found] += 1;
        }
    }
    let most = (0..3)
        .rev()
        .max_by_key(|candidate| votes[*candidate])
        .unwrap_or(2);
    CANDIDATES[most]
}
