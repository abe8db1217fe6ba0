//! Records whose stiffness differs so much that one of them is in another unit.

use crate::read::Loaded;
use crate::record::Record;
use crate::record::cycles::span;
use crate::record::written::quantity;

/// Factor beyond which two tests of one joint do not differ: deep slip takes a joint to a tenth or so of its
/// stiffness, and a unit is off by a thousand, or by 25.4 or 4.45.
const MOST: f64 = 30.0;

/// What is said of the softest and the stiffest record, where they are that far apart.
pub fn notes(loaded: &[Loaded]) -> Option<String> {
    let records = loaded.iter().filter_map(|l| l.measurement.history());
    let by_size = records.filter_map(|record| Some((record.name.as_str(), secant(record)?)));
    let by_size: Vec<(&str, f64)> = by_size.collect();
    let softest = by_size.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    let stiffest = by_size.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let factor = stiffest.1 / softest.1;
    (factor > MOST).then(|| {
        format!(
            "The stiffness of the records (span of force over span of displacement) differs by a factor of about \
             {}: {} in {} and {} in {}. Is a unit wrong?",
            one_digit(factor),
            quantity(softest.1, "N/m"),
            softest.0,
            quantity(stiffest.1, "N/m"),
            stiffest.0
        )
    })
}

fn secant(record: &Record) -> Option<f64> {
    let stiffness = span(&record.force) / span(&record.displacement);
    (stiffness > 0.0 && stiffness.is_finite()).then_some(stiffness)
}

fn one_digit(value: f64) -> f64 {
    let decade = 10_f64.powf(value.log10().floor());
    (value / decade).round() * decade
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Measurement;

    fn record(name: &str, stiffness: f64) -> Loaded {
        let displacement: Vec<f64> = (0..50).map(|i| 1e-6 * f64::from(i).sin()).collect();
        let force = displacement.iter().map(|u| stiffness * u).collect();
        Loaded {
            measurement: Measurement::History(Record {
                name: name.to_string(),
                force,
                displacement,
                ..Record::default()
            }),
            sha256: String::new(),
            notes: Vec::new(),
        }
    }

    #[test]
    fn a_thousand_is_a_unit_and_ten_is_slip() {
        let one = record("one", 1.34e8);
        assert_eq!(notes(&[one.clone(), record("deep", 1.2e7)]), None);
        assert_eq!(notes(&[one.clone(), record("still", 0.0)]), None);
        assert_eq!(notes(std::slice::from_ref(&one)), None);
        let said = notes(&[one, record("metres", 1.37e5)]).unwrap_or_default();
        assert!(
            said.contains(
                "factor of about 1000: 137 kN/m in metres and 134 MN/m in one. Is a unit wrong?"
            ),
            "{said}"
        );
    }
}
