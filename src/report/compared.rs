//! What was measured and predicted level by level and record by record, as values for the page.

use minijinja::context;
use minijinja::value::Value;

use super::quantity::share;
use crate::diagnose::Findings;
use crate::diagnose::findings::Errors;
use crate::diagnose::levels::{Compared, Level};
use crate::record::written::{number, quantity};

/// Levels in the table at most; diagnosis.json has all.
const MOST_LEVELS: usize = 60;

/// `12 %` with its interval in brackets, where there is one.
fn bounded(value: f64, interval: Option<(f64, f64)>) -> String {
    match interval {
        Some((lower, upper)) => format!(
            "{} ({} … {})",
            share(value),
            number(100.0 * lower, 2),
            number(100.0 * upper, 2)
        ),
        None => share(value),
    }
}

/// Errors of one model, each with its interval.
pub(super) fn errors(label: &str, errors: &Errors, unit: &str) -> Value {
    let held_out = errors.held_out_interval.map_or_else(String::new, |bounds| {
        format!(
            "{} … {}",
            quantity(bounds.0, unit),
            quantity(bounds.1, unit)
        )
    });
    context! {
        label,
        train => quantity(errors.train_rms, unit),
        held_out => quantity(errors.held_out_rms, unit),
        held_out_interval => held_out,
        energy => errors.dissipation_error.map(|e| bounded(e, errors.dissipation_interval)),
        stiffness => errors.stiffness_error.map(|e| bounded(e, errors.stiffness_interval)),
    }
}

/// Bounds of a relative error in percent, `0.63 … 1.2`, where there are any.
fn within(interval: Option<(f64, f64)>) -> Option<String> {
    let (lower, upper) = interval?;
    let bounds = [lower, upper].map(|bound| match 100.0 * bound {
        bound if bound.abs() < 1e-3 => "0".to_owned(),
        bound => number(bound, 2),
    });
    Some(bounds.join(" … "))
}

/// Mean over amplitude beyond which a cycle alone is on the way from one level to the next.
const ON_THE_WAY: f64 = 0.02;

/// The levels of the load, without single cycles on the way from one to the next: those are of records that
/// dwell on their levels.
pub(super) fn dwelt_on(findings: &Findings) -> Vec<&Level> {
    let passing =
        |level: &Level| level.cycles == 1 && level.mean.abs() > ON_THE_WAY * level.amplitude.abs();
    let dwells = |record: &str| {
        let own = || findings.levels.iter().filter(|l| l.record == record);
        let long: usize = own().filter(|l| l.cycles > 1).map(|l| l.cycles).sum();
        long > own().filter(|l| passing(l)).count()
    };
    let levels = findings.levels.iter();
    levels
        .filter(|level| !(passing(level) && dwells(&level.record)))
        .collect()
}

/// Count of cycles on the way between levels.
pub(super) fn passed(findings: &Findings) -> usize {
    findings.levels.len() - dwelt_on(findings).len()
}

/// Loss and stiffness per level.
pub(super) fn levels(findings: &Findings) -> Vec<Value> {
    let quantity_of = |compared: &Option<Compared>| {
        compared.as_ref().map(|c| {
            context! {
                measured => quantity(c.measured, &c.unit),
                before => share(c.before),
                before_interval => within(c.before_interval),
                after => share(c.after),
                after_interval => within(c.after_interval),
            }
        })
    };
    let rows = dwelt_on(findings).into_iter().take(MOST_LEVELS);
    rows.map(|level| {
        let about = match level.mean.abs() > ON_THE_WAY * level.amplitude {
            true => format!(" about {}", quantity(level.mean, &level.unit)),
            false => String::new(),
        };
        context! {
            record => level.record,
            amplitude => quantity(level.amplitude, &level.unit) + &about,
            rate => level.rate.map_or("–".to_owned(), |rate| quantity(rate, "Hz")),
            cycles => level.cycles,
            held_out => level.held_out,
            energy => quantity_of(&level.energy),
            stiffness => quantity_of(&level.stiffness),
        }
    })
    .collect()
}

/// Count of levels that the table leaves out.
pub(super) fn levels_left(findings: &Findings) -> usize {
    dwelt_on(findings).len().saturating_sub(MOST_LEVELS)
}

/// Records held out whole.
pub(super) fn left_out(findings: &Findings) -> Vec<Value> {
    let rows = findings.left_out.iter();
    rows.map(|record| {
        let interval = record.interval.map_or_else(String::new, |(lower, upper)| {
            format!("{} … {}", number(lower, 3), number(upper, 3))
        });
        context! {
            record => record.record,
            before => quantity(record.before, &findings.unit),
            after => quantity(record.after, &findings.unit),
            ratio => number(record.ratio, 3),
            interval,
        }
    })
    .collect()
}
