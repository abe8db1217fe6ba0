//! Records too short for what is asked of them, told before anything else is said of them.

use super::BadInput;
use crate::record::Record;
use std::path::Path;

/// Fewest samples of time histories.
#[derive(Debug, Clone, Copy)]
pub enum Fewest {
    /// Of every record.
    Each(usize),
    /// Of all records together.
    Together(usize),
}

impl Fewest {
    /// Refuses fewer. Amplitude tables have levels and no samples: their count is told by who takes them.
    ///
    /// # Errors
    /// [`BadInput`] naming the file, or all of them, with the count.
    pub fn admit(self, records: &[(&Path, &Record)]) -> Result<(), BadInput> {
        let short = match self {
            Fewest::Each(least) => records
                .iter()
                .find(|(_, record)| record.len() < least)
                .map(|(file, record)| (file.display().to_string(), record.len(), least)),
            Fewest::Together(least) => {
                let count: usize = records.iter().map(|(_, record)| record.len()).sum();
                let files = records.iter().map(|(file, _)| file.display().to_string());
                (!records.is_empty() && count < least)
                    .then(|| (files.collect::<Vec<_>>().join(", "), count, least))
            }
        };
        match short {
            None => Ok(()),
            Some((files, count, least)) => {
                let samples = match count {
                    1 => "1 sample is".to_string(),
                    count => format!("{count} samples are"),
                };
                Err(BadInput(format!(
                    "{files}: {samples} too few: at least {least} are needed; give the whole test"
                )))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn too_few_samples_are_counted_by_file_or_together() {
        let record = |count: usize| Record {
            force: vec![0.0; count],
            ..Record::default()
        };
        let (one, ten) = (record(1), record(10));
        let both = [(Path::new("ten.csv"), &ten), (Path::new("one.csv"), &one)];
        let said = |fewest: Fewest, records: &[(&Path, &Record)]| {
            fewest.admit(records).err().map(|BadInput(text)| text)
        };
        assert_eq!(
            said(Fewest::Each(10), &both).as_deref(),
            Some("one.csv: 1 sample is too few: at least 10 are needed; give the whole test")
        );
        assert_eq!(
            said(Fewest::Together(12), &both).as_deref(),
            Some(
                "ten.csv, one.csv: 11 samples are too few: at least 12 are needed; give the whole test"
            )
        );
        assert_eq!(said(Fewest::Together(11), &both), None);
        assert_eq!(said(Fewest::Together(11), &[]), None);
    }
}
