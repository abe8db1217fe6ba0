//! What a joint.json says of its origin: the records, when, and by what.

use crate::identify::table::{Known, at_resonance, own_force};
use crate::read::Loaded;
use crate::record::outliers::struck_out;
use crate::record::{AmplitudeTable, Measurement, Record};
use crate::saved::{Provenance, RecordUsed, Span};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Environment variable by which a build or a run is given its date, in seconds since 1970: with it
/// equal input gives equal output.
const EPOCH: &str = "SOURCE_DATE_EPOCH";

/// Origin of a joint that `iwan SUBCOMMAND` made of these records and of what is known beside them, now.
pub fn provenance(loaded: &[Loaded], known: &Known, subcommand: &str) -> Provenance {
    Provenance {
        records: loaded.iter().map(|one| record(one, known)).collect(),
        date: date(),
        tool: Some(format!("iwan {subcommand} {}", env!("CARGO_PKG_VERSION"))),
        remark: None,
        verdict: None,
    }
}

fn record(loaded: &Loaded, known: &Known) -> RecordUsed {
    let sha256 = loaded.sha256.clone();
    match &loaded.measurement {
        Measurement::History(record) => RecordUsed {
            name: record.name.clone(),
            samples: record.len(),
            sha256,
            span: record.time.as_deref().and_then(Span::of),
            largest_force: of_history(record),
        },
        Measurement::Amplitudes(table) => RecordUsed {
            name: table.name.clone(),
            samples: table.force_amplitude.len(),
            sha256,
            span: None,
            largest_force: of_table(table, known),
        },
    }
}

/// Largest force of a time history \[N\], as it was identified from: a reading that was lost on the way loaded no joint.
fn of_history(record: &Record) -> Option<f64> {
    largest(&struck_out(record).force)
}

/// Largest force of the joint in an amplitude table \[N\]; `None` for one at phase resonance of which nothing tells it:
/// the exciter's, that stands there, balances the loss alone.
fn of_table(table: &AmplitudeTable, known: &Known) -> Option<f64> {
    match own_force(table, known) {
        Some(own) => largest(&own.force_amplitude),
        None if at_resonance(table) => None,
        None => largest(&table.force_amplitude),
    }
}

fn largest(force: &[f64]) -> Option<f64> {
    let largest = force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
    (largest > 0.0).then_some(largest)
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
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// The joint's own force is `m ω² X`, whatever the exciter's.
    #[test]
    fn the_exciters_force_at_resonance_is_not_the_joints() {
        let (force, displacement) = (vec![1.0_f64, 2.0], vec![1e-5, 2e-5]);
        let losses = force.iter().zip(&displacement);
        let mut table = AmplitudeTable {
            name: "mode".into(),
            dissipation: losses.map(|(f, x)| PI * f * x).collect(),
            force_amplitude: force,
            displacement_amplitude: Some(displacement),
            frequency: Some(vec![50.0, 50.0]),
        };
        assert_eq!(of_table(&table, &Known::default()), None);
        let known = Known {
            modal_mass: Some(2.0),
            ..Known::default()
        };
        let expected = 2.0 * (TAU * 50.0_f64).powi(2) * 2e-5;
        let own = of_table(&table, &known);
        assert!(
            own.is_some_and(|own| (own / expected - 1.0).abs() < 1e-12),
            "{own:?}"
        );
        // with half the loss the force is the joint's own already
        table.dissipation.iter_mut().for_each(|loss| *loss *= 0.5);
        assert_eq!(of_table(&table, &known), Some(2.0));
    }

    #[test]
    fn a_reading_that_was_lost_is_no_force() {
        let sine = |i: i32| (0.06 * f64::from(i)).sin();
        let mut record = Record {
            force: (0..4000).map(|i| 50.0 * sine(i)).collect(),
            displacement: (0..4000).map(|i| 1e-5 * sine(i)).collect(),
            ..Record::default()
        };
        let whole = of_history(&record);
        record.force[1234] = -9999.0;
        assert_eq!(of_history(&record), whole);
        assert!(whole.is_some_and(|whole| whole < 50.1), "{whole:?}");
    }

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
