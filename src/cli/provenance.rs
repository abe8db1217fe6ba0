//! What a joint.json says of its origin: the records, when, and by what.

use crate::read::Loaded;
use crate::record::Measurement;
use crate::saved::{Provenance, RecordUsed, Span};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Environment variable by which a build or a run is given its date, in seconds since 1970: with it
/// equal input gives equal output.
const EPOCH: &str = "SOURCE_DATE_EPOCH";

/// Origin of a joint that `iwan SUBCOMMAND` made of these records, now.
pub fn provenance(loaded: &[Loaded], subcommand: &str) -> Provenance {
    Provenance {
        records: loaded.iter().map(record).collect(),
        date: date(),
        tool: Some(format!("iwan {subcommand} {}", env!("CARGO_PKG_VERSION"))),
        remark: None,
        verdict: None,
    }
}

fn record(loaded: &Loaded) -> RecordUsed {
    let (name, force, span) = match &loaded.measurement {
        Measurement::History(record) => {
            let span = record.time.as_deref().and_then(Span::of);
            (&record.name, &record.force, span)
        }
        Measurement::Amplitudes(table) => (&table.name, &table.force_amplitude, None),
    };
    let largest = force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
    RecordUsed {
        name: name.clone(),
        samples: force.len(),
        sha256: loaded.sha256.clone(),
        span,
        largest_force: (largest > 0.0).then_some(largest),
    }
}

/// `SOURCE_DATE_EPOCH`, else now. A clock before 1970 gives no date.
fn date() -> Option<String> {
    let given = std::env::var(EPOCH).ok().and_then(|text| text.parse().ok());
    let since = match given {
        Some(seconds) => Duration::from_secs(seconds),
        None => SystemTime::now().duration_since(UNIX_EPOCH).ok()?,
    };
    Some(iso_8601(since.as_secs()))
}

/// `1970-01-01T00:00:00Z` for 0; UTC, without leap seconds.
fn iso_8601(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let (hour, minute, second) = (rest / 3600, rest / 60 % 60, rest % 60);
    // Eras of 400 years from 1 March of the year 0, so that the leap day ends a year
    // (H. Hinnant, "chrono-compatible low-level date algorithms").
    let shifted = days + 719_468;
    let (era, of_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (of_era - of_era / 1460 + of_era / 36_524 - of_era / 146_096) / 365;
    let of_year = of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * of_year + 2) / 153;
    let day = of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 {
        from_march + 3
    } else {
        from_march - 9
    };
    let year = era * 400 + year_of_era + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}Z")
}

#[cfg(test)]
mod tests {
    use super::iso_8601;

    /// `date -u -d @SECONDS +%FT%TZ`.
    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, expected) in [
            (0, "1970-01-01T00:00:00Z"),
            (951_782_399, "2000-02-28T23:59:59Z"),
            (951_782_400, "2000-02-29T00:00:00Z"),
            (951_868_800, "2000-03-01T00:00:00Z"),
            (1_735_689_599, "2024-12-31T23:59:59Z"),
            (4_107_542_400, "2100-03-01T00:00:00Z"),
        ] {
            assert_eq!(iso_8601(seconds), expected);
        }
    }
}
