//! A file's bytes as text, with the hash that tells one content from another.

use super::error::ReadError;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// The content of a file.
pub struct Source {
    /// The file as it was named.
    pub file: PathBuf,
    /// Its text; lines end with `\n` (`\r` before it is kept).
    pub text: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// What was assumed on the way.
    pub notes: Vec<String>,
}

impl Source {
    /// Reads the whole file. UTF-8 with or without mark, UTF-16 with mark, or Latin-1.
    pub fn open(file: &Path) -> Result<Source, ReadError> {
        if file.is_dir() {
            return Err(ReadError::Directory {
                file: file.to_path_buf(),
            });
        }
        let bytes = std::fs::read(file).map_err(|error| ReadError::from_system(file, &error))?;
        let sha256 = Sha256::digest(&bytes)
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        let mut notes = Vec::new();
        let mut text = decode(bytes, &mut notes).ok_or_else(|| ReadError::Binary {
            file: file.to_path_buf(),
        })?;
        if text.contains('\r') && !text.contains('\n') {
            text = text.replace('\r', "\n");
        }
        Ok(Source {
            file: file.to_path_buf(),
            text,
            sha256,
            notes,
        })
    }

    /// The file's stem, to show.
    pub fn name(&self) -> String {
        self.file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned()
    }
}

/// The text, or `None` where the bytes are none.
fn decode(mut bytes: Vec<u8>, notes: &mut Vec<String>) -> Option<String> {
    if bytes.starts_with(&[0xef, 0xbb, 0xbf]) {
        bytes.drain(..3);
    }
    let from_pair: Option<fn([u8; 2]) -> u16> = match bytes.get(..2) {
        Some([0xff, 0xfe]) => Some(u16::from_le_bytes),
        Some([0xfe, 0xff]) => Some(u16::from_be_bytes),
        _ => None,
    };
    if let Some(from_pair) = from_pair {
        let pairs: Vec<u16> = bytes[2..]
            .chunks_exact(2)
            .map(|p| from_pair([p[0], p[1]]))
            .collect();
        return String::from_utf16(&pairs)
            .ok()
            .filter(|text| !text.contains('\0'));
    }
    let is_control = |byte: &u8| *byte < 0x20 && !b"\t\n\r\x0c\x1a".contains(byte);
    if bytes.contains(&0) || bytes.iter().take(4096).any(is_control) {
        return None;
    }
    Some(String::from_utf8(bytes).unwrap_or_else(|error| {
        notes.push("the text is no UTF-8 and was read as Latin-1".to_string());
        error.into_bytes().into_iter().map(char::from).collect()
    }))
}
