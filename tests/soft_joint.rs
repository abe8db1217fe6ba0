//! A joint a thousand million times as soft, or measured in nanometres or over weeks, is the same joint: nothing in a
//! diagnosis has a size of its own but the frequencies of the mains.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Findings;
use iwan::read;
use iwan::record::{Measurement, Record};
use std::path::Path;

/// Shares of force, displacement and time.
#[derive(Clone, Copy)]
struct Scaled {
    force: f64,
    displacement: f64,
    time: f64,
}

const AS_MEASURED: Scaled = Scaled {
    force: 1.0,
    displacement: 1.0,
    time: 1.0,
};

impl Scaled {
    /// What a value of that unit becomes; no digit of a power of two is another.
    fn of(self, unit: &str) -> f64 {
        match unit {
            "1" => 1.0,
            "m" => self.displacement,
            "N/m" => self.force / self.displacement,
            other => panic!("a unit that pinning has not: {other}"),
        }
    }

    /// The bundled test at 2 Hz in these shares.
    fn diagnosed(self) -> Findings {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/bolt-1.csv");
        let loaded = read::file(&file, &read::Options::default()).expect("the bundled record");
        let Measurement::History(mut record) = loaded.measurement else {
            panic!("the bundled record has time");
        };
        let times = |channel: &mut Vec<f64>, share: f64| {
            channel.iter_mut().for_each(|value| *value *= share);
        };
        times(&mut record.force, self.force);
        times(&mut record.displacement, self.displacement);
        times(record.time.as_mut().expect("time"), self.time);
        let records: [Record; 1] = [record];
        diagnose(&records, |_| ()).expect("a joint")
    }
}

/// The bundled joint is found in other shares as in those that it was measured in.
fn is_found_alike(shares: Scaled) {
    let (measured, scaled) = (AS_MEASURED.diagnosed(), shares.diagnosed());
    assert_eq!(measured.verdict, scaled.verdict);
    let names = |f: &Findings| -> Vec<String> { f.causes.iter().map(|c| c.name.clone()).collect() };
    assert_eq!(names(&measured), ["pinning"]);
    assert_eq!(names(&scaled), ["pinning"]);
    for (own, other) in measured.causes[0]
        .parameters
        .iter()
        .zip(&scaled.causes[0].parameters)
    {
        let expected = shares.of(&own.unit) * own.value;
        // Powers round otherwise, and no more than that.
        assert!(
            (other.value - expected).abs() <= 1e-6 * expected.abs(),
            "{}: {} instead of {expected}",
            own.name,
            other.value
        );
    }
    let (one, other) = (measured.gain.0, scaled.gain.0);
    assert!((one - other).abs() < 1e-6 * one);
    for own in &measured.outlook.separability {
        let mut others = scaled.outlook.separability.iter();
        let other = others.find(|other| other.name == own.name).expect("a line");
        let near = (own.lambda - other.lambda).abs() <= 1e-3 * own.lambda.max(1.0);
        // The mains keep their frequencies, and no fixture has more than a million tonnes.
        let has_a_size = ["mains_hum", "fixture_inertia"].contains(&own.name.as_str());
        assert!(near || has_a_size, "{own:?} {other:?}");
    }
}

#[test]
fn a_joint_is_diagnosed_alike_in_newtons_and_in_nanonewtons() {
    is_found_alike(Scaled {
        force: 2.0_f64.powi(-30),
        ..AS_MEASURED
    });
}

#[test]
fn a_joint_is_diagnosed_alike_in_micrometres_and_in_picometres() {
    is_found_alike(Scaled {
        displacement: 2.0_f64.powi(-20),
        ..AS_MEASURED
    });
}

#[test]
fn a_joint_is_diagnosed_alike_in_seconds_and_over_weeks() {
    is_found_alike(Scaled {
        time: 2.0_f64.powi(20),
        ..AS_MEASURED
    });
}
