//! Gaps in the time of a record: what the joint went through there nobody knows.

use crate::read::Loaded;
use crate::record::Record;
use crate::record::written::{number, quantity};

/// Times the usual step of a record's time from which on a step is a gap.
const MANY_STEPS: f64 = 20.0;

/// What is said of the records' gaps, a sentence for each record that has any: its longest, and how many more.
pub fn notes(loaded: &[Loaded]) -> Vec<String> {
    let records = loaded.iter().filter_map(|l| l.measurement.history());
    records.filter_map(note).collect()
}

fn note(record: &Record) -> Option<String> {
    let time = record.time.as_deref()?;
    let steps: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut sorted = steps.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = *sorted.get(sorted.len() / 2)?;
    let gaps = || (0..steps.len()).filter(|&i| steps[i] > MANY_STEPS * usual);
    let longest = gaps().max_by(|&a, &b| steps[a].total_cmp(&steps[b]))?;
    let further = match gaps().count() - 1 {
        0 => String::new(),
        1 => "; there is another gap".to_string(),
        count => format!("; there are {count} more gaps"),
    };
    Some(format!(
        "Record {}: no sample for {} after t = {} (usually {} from sample to sample){further}. What drives the \
         joint was taken to go straight across.",
        record.name,
        quantity(steps[longest], "s"),
        // As it stands in the file.
        format_args!("{} s", number(time[longest], 6)),
        quantity(usual, "s"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Measurement;

    fn told(time: Vec<f64>) -> Vec<String> {
        let record = Record {
            name: "test".to_string(),
            force: vec![0.0; time.len()],
            time: Some(time),
            ..Record::default()
        };
        notes(&[Loaded {
            measurement: Measurement::History(record),
            sha256: String::new(),
            notes: Vec::new(),
        }])
    }

    #[test]
    fn a_gap_is_told_with_its_place_and_unequal_steps_are_not() {
        let even = || (0..100).map(|i| 0.01 * f64::from(i));
        assert!(told(even().collect()).is_empty());
        assert!(told(even().map(|t| t * t).collect()).is_empty());
        assert!(told(Vec::new()).is_empty() && told(vec![0.0]).is_empty());
        let late = |t: f64| if t > 0.495 { t + 2.49 } else { t };
        assert_eq!(
            told(even().map(late).collect()),
            [
                "Record test: no sample for 2.50 s after t = 0.490000 s (usually 10.0 ms from sample to sample). \
                 What drives the joint was taken to go straight across."
            ]
        );
        let twice = |t: f64| if t > 0.795 { late(t) + 1.0 } else { late(t) };
        let said = told(even().map(twice).collect());
        assert!(said[0].contains("2.50 s after t = 0.49"), "{said:?}");
        assert!(said[0].contains("; there is another gap."), "{said:?}");
    }
}
