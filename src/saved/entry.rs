//! A place in a joint.json, which refuses by its path.

use super::SavedError;
use serde_json::{Map, Value};

/// A place in the file.
pub struct Entry<'a> {
    /// File as named by the caller.
    pub file: &'a str,
    /// JSON path.
    pub place: String,
    /// What stands there.
    pub value: &'a Value,
}

impl<'a> Entry<'a> {
    /// The entry of that name, where there is one.
    pub fn find(&self, name: &str) -> Option<Entry<'a>> {
        let value = self.value.get(name)?;
        Some(Entry {
            file: self.file,
            place: format!("{}.{name}", self.place),
            value,
        })
    }

    /// The entry of that name; `needed` says what to put there.
    pub fn get(&self, name: &str, needed: &str) -> Result<Entry<'a>, SavedError> {
        self.object()?;
        self.find(name).ok_or_else(|| SavedError::Missing {
            file: self.file.into(),
            place: format!("{}.{name}", self.place),
            needed: needed.into(),
        })
    }

    /// An object.
    pub fn object(&self) -> Result<&'a Map<String, Value>, SavedError> {
        self.value
            .as_object()
            .ok_or_else(|| self.unusable("it must be an object { … }"))
    }

    /// Refuses names that nothing reads: a misspelt parameter must not pass for its default.
    pub fn only(&self, known: &[&str]) -> Result<(), SavedError> {
        match self
            .object()?
            .keys()
            .find(|name| !known.contains(&name.as_str()))
        {
            Some(stranger) => {
                let entry = self.get(stranger, "")?;
                Err(entry.unusable(&format!(
                    "no such name here; known are {}",
                    known.join(", ")
                )))
            }
            None => Ok(()),
        }
    }

    /// A list.
    pub fn items(&self) -> Result<Vec<Entry<'a>>, SavedError> {
        let list = self
            .value
            .as_array()
            .ok_or_else(|| self.unusable("it must be a list [ … ]"))?;
        let entries = list.iter().enumerate().map(|(i, value)| Entry {
            file: self.file,
            place: format!("{}[{i}]", self.place),
            value,
        });
        Ok(entries.collect())
    }

    /// A text.
    pub fn text(&self) -> Result<&'a str, SavedError> {
        self.value
            .as_str()
            .ok_or_else(|| self.unusable("it must be a text in quotes"))
    }

    /// A number.
    pub fn number(&self) -> Result<f64, SavedError> {
        self.value
            .as_f64()
            .ok_or_else(|| self.unusable("it must be a number"))
    }

    /// A list of numbers.
    pub fn numbers(&self) -> Result<Vec<f64>, SavedError> {
        self.items()?.iter().map(Entry::number).collect()
    }

    /// The refusal of this value.
    pub fn unusable(&self, needed: &str) -> SavedError {
        let mut value: String = self.value.to_string().chars().take(60).collect();
        if value.chars().count() == 60 {
            value.push('…');
        }
        let (file, place) = (self.file.into(), self.place.clone());
        SavedError::Unusable {
            file,
            place,
            value,
            needed: needed.into(),
        }
    }

    /// The refusal of values that make no joint.
    pub fn no_joint(&self, reason: crate::joint::JointError) -> SavedError {
        SavedError::NoJoint {
            file: self.file.into(),
            place: self.place.clone(),
            reason,
        }
    }
}
