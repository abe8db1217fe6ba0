//! A joint a thousand million times as soft is the same joint: nothing in a diagnosis has a size of its own.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Findings;
use iwan::read;
use iwan::record::{Measurement, Record};
use std::path::Path;

/// The bundled test at 2 Hz with a share of its force.
fn with_force(share: f64) -> Findings {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/bolt-1.csv");
    let loaded = read::file(&file, &read::Options::default()).expect("the bundled record");
    let Measurement::History(mut record) = loaded.measurement else {
        panic!("the bundled record has time");
    };
    record.force.iter_mut().for_each(|force| *force *= share);
    let records: [Record; 1] = [record];
    diagnose(&records, |_| ()).expect("a joint")
}

#[test]
fn a_joint_is_diagnosed_alike_in_newtons_and_in_nanonewtons() {
    // A power of two: no digit of the record is another.
    let share = 2.0_f64.powi(-30);
    let (stiff, soft) = (with_force(1.0), with_force(share));
    assert_eq!(stiff.verdict, soft.verdict);
    assert!(stiff.causes.iter().any(|c| c.name == "pinning"));
    assert_eq!(stiff.causes.len(), soft.causes.len());
    for (one, other) in stiff.causes.iter().zip(&soft.causes) {
        assert_eq!(one.name, other.name);
        for (own, scaled) in one.parameters.iter().zip(&other.parameters) {
            let expected = match own.unit.as_str() {
                "N/m" => share * own.value,
                _ => own.value,
            };
            // Powers of the force round otherwise, and no more than that.
            assert!(
                (scaled.value - expected).abs() <= 1e-6 * expected.abs(),
                "{} of {}: {} instead of {expected}",
                own.name,
                one.name,
                scaled.value
            );
        }
    }
    let (one, other) = (stiff.gain.0, soft.gain.0);
    assert!((one - other).abs() < 1e-6 * one);
}
