//! What joint.json says of a joint's origin: records, verdict, intervals.

use super::entry::Entry;
use super::{Judgement, Provenance, RecordUsed, SavedError, Span};
use std::collections::BTreeMap;

/// What may be said of a record.
const OF_RECORD: [&str; 6] = [
    "name",
    "samples",
    "sha256",
    "duration",
    "sample_interval",
    "largest_force",
];

/// Records, date, tool and verdict.
pub fn provenance(entry: &Entry) -> Result<Provenance, SavedError> {
    entry.only(&["records", "date", "tool", "remark", "verdict"])?;
    let words = |name: &str| {
        entry
            .find(name)
            .map(|e| e.text().map(String::from))
            .transpose()
    };
    let mut provenance = Provenance {
        records: Vec::new(),
        date: words("date")?,
        tool: words("tool")?,
        remark: words("remark")?,
        verdict: entry.find("verdict").map(|e| judgement(&e)).transpose()?,
    };
    if let Some(records) = entry.find("records") {
        for record in records.items()? {
            record.only(&OF_RECORD)?;
            let samples = record.get("samples", "the count of samples")?;
            let count = samples
                .value
                .as_u64()
                .and_then(|count| usize::try_from(count).ok());
            provenance.records.push(RecordUsed {
                name: record.get("name", "the record's name")?.text()?.into(),
                samples: count.ok_or_else(|| samples.unusable("a whole number"))?,
                sha256: record.get("sha256", "the file's hash")?.text()?.into(),
                span: span(&record)?,
                largest_force: record
                    .find("largest_force")
                    .map(|found| positive(&found, "newtons"))
                    .transpose()?,
            });
        }
    }
    Ok(provenance)
}

/// Both or none: a duration without a distance of samples says nothing of the rate.
fn span(record: &Entry) -> Result<Option<Span>, SavedError> {
    const BOTH: &str = "give `duration` and `sample_interval`, or neither";
    if record.find("duration").is_none() && record.find("sample_interval").is_none() {
        return Ok(None);
    }
    Ok(Some(Span {
        duration: positive(&record.get("duration", BOTH)?, "seconds")?,
        sample_interval: positive(&record.get("sample_interval", BOTH)?, "seconds")?,
    }))
}

fn positive(entry: &Entry, of: &str) -> Result<f64, SavedError> {
    match entry.number()? {
        value if value > 0.0 => Ok(value),
        _ => Err(entry.unusable(&format!("a positive number of {of}"))),
    }
}

fn judgement(entry: &Entry) -> Result<Judgement, SavedError> {
    entry.only(&["word", "held_out_rms_ratio", "interval"])?;
    let given = |name| entry.find(name).filter(|found| !found.value.is_null());
    let word = entry.get("word", "the verdict's word")?.text()?.into();
    Ok(Judgement {
        word,
        held_out_rms_ratio: given("held_out_rms_ratio")
            .map(|found| found.number())
            .transpose()?,
        interval: given("interval").map(|e| bounds(&e)).transpose()?,
    })
}

/// 95 % intervals by parameter name.
pub fn intervals(entry: &Entry) -> Result<BTreeMap<String, (f64, f64)>, SavedError> {
    let mut intervals = BTreeMap::new();
    for name in entry.object()?.keys() {
        let interval = bounds(&entry.get(name, "two bounds")?)?;
        intervals.insert(name.clone(), interval);
    }
    Ok(intervals)
}

/// Two numbers, the lower first; null is infinity.
fn bounds(entry: &Entry) -> Result<(f64, f64), SavedError> {
    let [low, high] = entry
        .items()?
        .try_into()
        .map_err(|_| entry.unusable("two bounds [lower, upper], null where open"))?;
    let low = if low.value.is_null() {
        f64::NEG_INFINITY
    } else {
        low.number()?
    };
    let high = if high.value.is_null() {
        f64::INFINITY
    } else {
        high.number()?
    };
    if low > high {
        return Err(entry.unusable("the lower bound comes first"));
    }
    Ok((low, high))
}
