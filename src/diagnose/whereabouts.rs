//! Where in the records something is, in words.

use super::prepare::Bench;
use super::structure::{Place, Structure};
use crate::identify::Form;
use crate::joint::effect::Acting;
use crate::record::Record;
use crate::record::written::quantity;

/// Share of the structure below which a bin is not worth a line.
const WORTH_A_LINE: f64 = 0.01;

/// Where structure is left, the strongest bins first: the time, or the samples of a record without time, and which part
/// of its cycles, by what the drive does there.
pub fn of_structure(records: &[Record], bench: &Bench, structure: &Structure) -> Vec<String> {
    let worth_a_line = structure.places.iter().filter(|p| p.share > WORTH_A_LINE);
    worth_a_line
        .map(|place| {
            let record = &records[place.record];
            let part = place.part.map_or(String::new(), |part| {
                let (drive, _) = bench.whole.channels(place.record);
                let form = bench.whole.operators.form;
                format!(", {}", in_the_cycle(form, drive, part))
            });
            format!(
                "record {}, {}{part}: {:.0} % of the structure",
                record.name,
                stretch(record, place),
                100.0 * place.share
            )
        })
        .collect()
}

fn stretch(record: &Record, place: &Place) -> String {
    let last = place.to.min(record.len().max(1) - 1);
    match &record.time {
        Some(time) => format!("{:.4} to {:.4} s", time[place.from], time[last]),
        None => format!("samples {} to {last}", place.from),
    }
}

/// What the drive does in a part of each cycle.
fn in_the_cycle(form: Form, drive: &[f64], (from, to): (usize, usize)) -> String {
    let (name, unit) = form.input();
    let (first, last) = (drive[from], drive[to.min(drive.len() - 1)]);
    let goes = if last > first { "rises" } else { "falls" };
    let [first, last] = [first, last].map(|value| quantity(value, unit));
    format!("where the {name} {goes} from {first} to {last}")
}

/// When a jump was, on the clock of the record that has it: its law counts time through the records, one after another.
pub fn of_jumps(records: &[Record], effects: &[Acting]) -> Vec<String> {
    let jumps = effects.iter().filter(|a| a.effect.name() == "offset_step");
    let times = jumps.filter_map(|a| {
        let mut named = a.effect.parameters().iter().zip(&a.values);
        named.find(|(p, _)| p.name == "time").map(|(_, time)| *time)
    });
    let on_its_clock = |time: f64| {
        let mut before = 0.0;
        for record in records {
            let clock = record.time.as_ref()?;
            let (first, last) = (clock.first()?, clock.last()?);
            if time <= before + last - first {
                let own = first + time - before;
                return Some(format!(
                    "The jump of offset_step is at {own:.4} s on the clock of record {}.",
                    record.name
                ));
            }
            before += last - first;
        }
        None
    };
    times.filter_map(on_its_clock).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;

    #[test]
    fn a_jump_is_told_on_the_clock_of_its_record() {
        let record = |name: &str, first: f64| Record {
            name: name.to_string(),
            time: Some((0..=100).map(|i| first + 0.1 * f64::from(i)).collect()),
            force: vec![0.0; 101],
            displacement: vec![0.0; 101],
            ..Record::default()
        };
        let records = [record("one", -20.0), record("two", 300.0)];
        let effect = find("offset_step").unwrap().effect();
        let at = |time: f64| {
            let named = effect.parameters().iter();
            let values = named.map(|p| if p.name == "time" { time } else { 1e-6 });
            [Acting {
                effect,
                values: values.collect(),
            }]
        };
        for (time, said) in [
            (2.5, "-17.5000 s on the clock of record one"),
            (12.5, "302.5000 s on the clock of record two"),
        ] {
            let notes = of_jumps(&records, &at(time));
            assert!(notes[0].contains(said), "{notes:?}");
        }
        assert!(of_jumps(&records, &at(25.0)).is_empty());
    }
}
