//! The noise of the channel that drives, of which the joint felt nothing.

use super::judged_channel::compliance_ratio;
use crate::identify::Form;
use crate::record::Record;
use crate::record::calm::{calmed, fastest};
use crate::record::cycles::span;
use crate::record::mains::beneath_mains;
use crate::record::resolution::resolution;

/// What a drive's noise may add to the misfit of a record, in variances of the judged channel's noise, before it counts:
/// by what the joint makes of it where that is most. A mass that answers to it was seen to take a fifth of that, and to
/// pass for a cause at a few alarms; to smooth costs something as well, where a drive turns sharply.
const COUNTS: f64 = 300.0;

/// The records with a smooth driving channel where its noise counts: sliders that stick answer noise with their whole
/// stiffness, and sliding ones are pushed back by it; taken for the joint's, both look like causes. A hum of the mains
/// is no noise: it is a cause's to explain.
pub fn without_drive_noise(form: Form, records: &[Record]) -> Vec<Record> {
    let calm = |record: &Record| {
        let (drive, judged, steepest) = match form {
            Form::Play => (&record.force, &record.displacement, 1.0),
            Form::Stop => (
                &record.displacement,
                &record.force,
                compliance_ratio(record),
            ),
        };
        let noise = match &record.time {
            Some(time) => fastest(drive).min(beneath_mains(time, drive).deviation),
            None => fastest(drive),
        };
        let answered = noise * steepest * span(judged) / span(drive);
        let share = answered / fastest(judged).max(resolution(judged));
        if share * share * judged.len() as f64 <= COUNTS {
            return record.clone();
        }
        let calm = calmed(drive, noise);
        let mut record = record.clone();
        match form {
            Form::Play => record.force = calm,
            Form::Stop => record.displacement = calm,
        }
        record
    };
    records.iter().map(calm).collect()
}
