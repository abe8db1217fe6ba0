//! joint.json: round trips to the last bit, and refusals that say where and what to do.

use std::collections::BTreeMap;
use std::path::Path;

use iwan::causes::{CATALOGUE, Kind};
use iwan::joint::{Acting, Density, Drive, FourParameter, Joint, PowerLaw, PowerLawTable, Sliders};
use iwan::saved::{Judgement, Provenance, RecordUsed, SavedError, SavedJoint, Span, read, write};
use proptest::prelude::*;

fn saved(density: Density, series_stiffness: f64, effects: Vec<Acting>) -> SavedJoint {
    let joint = Joint::new(density, series_stiffness, effects).unwrap();
    let provenance = Provenance {
        records: vec![RecordUsed {
            name: "bolt \"1\"".into(),
            samples: 4000,
            sha256: "ab12".into(),
            span: Span::of(&[0.1, 0.2, 0.4]),
            largest_force: Some(0.1 + 0.7),
        }],
        date: Some("2024-05-01".into()),
        tool: Some("iwan 0.1.0".into()),
        remark: None,
        verdict: Some(Judgement {
            word: "explained".into(),
            held_out_rms_ratio: Some(0.1 + 0.2),
            interval: Some((0.25, f64::INFINITY)),
        }),
    };
    let mut intervals = BTreeMap::new();
    intervals.insert("series_stiffness".to_string(), (1.0 / 3.0, f64::INFINITY));
    intervals.insert("slip_force".to_string(), (f64::NEG_INFINITY, 0.1 + 0.2));
    SavedJoint {
        joint,
        provenance,
        intervals,
    }
}

fn bits(density: &Density) -> Vec<u64> {
    let mut all = density.values();
    match density {
        Density::Sliders(s) => all.extend(s.weight.iter().chain(&s.slip_at)),
        Density::PowerLawTable(t) => all.extend(t.break_free.iter().chain(&t.density)),
        Density::PowerLaw(_) | Density::FourParameter(_) => {}
    }
    all.iter().map(|value| value.to_bits()).collect()
}

fn densities() -> impl Strategy<Value = Density> {
    let positive = || (-12.0_f64..12.0).prop_map(|power| 10_f64.powf(power));
    let four = (positive(), positive(), -0.9_f64..1.0, 0.0_f64..5.0).prop_filter_map(
        "in range",
        |(force, stiffness, exponent, ratio)| {
            FourParameter::new(force, stiffness, exponent, ratio)
                .ok()
                .map(Density::FourParameter)
        },
    );
    let limit = prop_oneof![Just(f64::INFINITY), 1e-6_f64..1e3];
    let power = (positive(), -0.9_f64..1.0, positive(), limit, positive()).prop_filter_map(
        "in range",
        |(coefficient, exponent, k, limit, stiffness)| {
            PowerLaw::new(coefficient, exponent, k, limit, stiffness)
                .ok()
                .map(Density::PowerLaw)
        },
    );
    let sliders = (
        prop::collection::vec((positive(), positive()), 1..30),
        0.0_f64..10.0,
    )
        .prop_filter_map("in range", |(pairs, elastic)| {
            let (weight, slip_at) = pairs.into_iter().unzip();
            Sliders::new(weight, slip_at, elastic)
                .ok()
                .map(Density::Sliders)
        });
    let table = (prop::collection::vec(0.0_f64..3.0, 2..10), -0.9_f64..1.0).prop_filter_map(
        "in range",
        |(density, exponent)| {
            let break_free = (1..=density.len()).map(|i| 0.1 * i as f64).collect();
            PowerLawTable::new(3.0, exponent, 0.7, 1e3, break_free, density)
                .ok()
                .map(Density::PowerLawTable)
        },
    );
    prop_oneof![four, power, sliders, table]
}

proptest! {
    #[test]
    fn a_round_trip_keeps_every_bit(
        density in densities(), spring in prop_oneof![Just(f64::INFINITY), 1e-3_f64..1e12],
    ) {
        let before = saved(density, spring, vec![]);
        let text = write(&before);
        let after = read(&text, "joint.json").unwrap();
        prop_assert_eq!(&after, &before);
        prop_assert_eq!(bits(&after.joint.density), bits(&before.joint.density));
        prop_assert_eq!(after.joint.series_stiffness.to_bits(), spring.to_bits());
        prop_assert_eq!(write(&after), text);
    }

    #[test]
    fn a_file_cut_short_anywhere_is_refused_with_its_place(share in 0.0_f64..1.0) {
        let text = write(&saved(sliders(), 3.0, vec![]));
        let cut = ((text.trim_end().len() - 1) as f64 * share) as usize;
        prop_assume!(text.is_char_boundary(cut));
        match read(&text[..cut], "cut.json") {
            Err(SavedError::Syntax { file, line, column, .. }) => {
                prop_assert_eq!(file, "cut.json");
                let lines = text[..cut].matches('\n').count() + 1;
                prop_assert!(line <= lines && column <= text.len());
            }
            other => prop_assert!(false, "{other:?}"),
        }
    }
}

fn sliders() -> Density {
    Density::Sliders(Sliders::new(vec![1.0 / 3.0, 2.0], vec![0.1, 0.7], 0.5).unwrap())
}

#[test]
fn every_joint_cause_survives_and_no_measurement_cause_enters() {
    for cause in CATALOGUE {
        let glossary = cause.parameters();
        // A third keeps off round numbers; ranges are those of the glossary.
        let values: Vec<f64> = glossary
            .iter()
            .map(|p| (p.vanishes_at.unwrap_or(0.0) + 1.0 / 3.0).clamp(p.lower, p.upper))
            .collect();
        let effects = vec![Acting {
            effect: cause.effect(),
            values,
        }];
        let before = saved(sliders(), 3.0, effects);
        let after = read(&write(&before), "joint.json");
        match cause.kind() {
            Kind::Joint => assert_eq!(after, Ok(before), "{}", cause.name()),
            Kind::Measurement => assert!(
                matches!(&after, Err(SavedError::Unusable { place, .. })
                    if place == "$.causes[0].name"),
                "{after:?}"
            ),
        }
    }
}

#[test]
fn a_refinement_that_is_left_out_is_neutral() {
    let cause = iwan::causes::find("pinning").unwrap();
    let acting = |values: Vec<f64>| Acting {
        effect: cause.effect(),
        values,
    };
    let whole = saved(
        sliders(),
        3.0,
        vec![acting(vec![2e6, 1e-5, 2e-5, 0.0, 1.0])],
    );
    let mut text: serde_json::Value = serde_json::from_str(&write(&whole)).unwrap();
    let given = text["causes"][0]["parameters"].as_object_mut().unwrap();
    assert!(given.remove("rounding").is_some() && given.remove("stiffness_ratio").is_some());
    assert_eq!(read(&text.to_string(), "joint.json"), Ok(whole));
    let given = text["causes"][0]["parameters"].as_object_mut().unwrap();
    given.remove("gap_negative");
    assert!(read(&text.to_string(), "joint.json").is_err());
}

/// The text of a good file with one part replaced.
fn changed(from: &str, to: &str) -> String {
    let density = Density::FourParameter(FourParameter::new(1e3, 1e6, -0.5, 0.3).unwrap());
    let text = write(&saved(density, 3.5, vec![]));
    assert!(text.contains(from), "{from} is not in {text}");
    text.replace(from, to)
}

#[test]
fn refusals_name_place_value_and_way_out() {
    let cases = [
        (
            "\"iwan-joint/1\"",
            "\"iwan-joint/9\"",
            "$.format is \"iwan-joint/9\"",
        ),
        ("\"SI\"", "\"imperial\"", "$.units is \"imperial\""),
        (
            "\"four_parameter\"",
            "\"five\"",
            "$.density.family is \"five\": one of \"power_law\"",
        ),
        (
            "\"slip_force\": 1000.0",
            "\"slip_force\": \"much\"",
            "$.density.slip_force is \"much\"",
        ),
        (
            "\"slip_force\": 1000.0",
            "\"slip_force\": -2",
            "$.density.slip_force is -2: a number in N",
        ),
        (
            "\"slip_force\": 1000.0",
            "\"slip\": 1",
            "$.density.slip is 1: no such name here",
        ),
        ("    \"ratio\": 0.3,\n", "", "$.density.ratio is missing"),
        (
            "\"series_stiffness\": 3.5",
            "\"series_stiffness\": \"stiff\"",
            "$.series_stiffness",
        ),
        (
            "\"series_stiffness\": 3.5",
            "\"series_stiffness\": -1",
            "`series_stiffness` is -1",
        ),
        (
            "\"causes\": []",
            "\"causes\": {}",
            "$.causes is {}: it must be a list",
        ),
        (
            "\"causes\": []",
            "\"causes\": [{\"name\": \"gremlin\"}]",
            "$.causes[0].name is \"gremlin\"",
        ),
        (
            "\"samples\": 4000",
            "\"samples\": 0.5",
            "$.provenance.records[0].samples is 0.5",
        ),
        (
            "\"date\": \"2024-05-01\"",
            "\"date\": 5",
            "$.provenance.date is 5",
        ),
        (
            "\"slip_force\": [null,",
            "\"slip_force\": [1, null,",
            "$.intervals.slip_force is [1,null,",
        ),
        (
            "\"causes\": []",
            "\"causes\": [], \"cause\": []",
            "$.cause is []: no such name here; known are format, version",
        ),
        (
            "\"series_stiffness\": 3.5",
            "\"serie_stiffness\": 3.5",
            "$.serie_stiffness is 3.5: no such name here",
        ),
        (
            "\"causes\": []",
            "\"causes\": [{\"name\": \"viscous_damping\", \"parameters\": {\"coefficient\": 1}, \"enabled\": false}]",
            "$.causes[0].enabled is false: no such name here; known are name, parameters",
        ),
        (
            "\"series_stiffness\": 3.5,\n",
            "\"series_stiffness\": 3.5,\n  \"series_stiffness\": 4,\n",
            ":13:3: $.series_stiffness is there twice",
        ),
        (
            "\"slip_force\": 1000.0",
            "\"slip_force\": 1000.0, \"slip_force\": 1000.0",
            "$.density.slip_force is there twice: keep one",
        ),
        (
            "\"date\"",
            "\"dated\"",
            "$.provenance.dated is \"2024-05-01\": no such name here",
        ),
        (
            "\"largest_force\"",
            "\"force\"",
            "$.provenance.records[0].force is 0.",
        ),
        (
            "\"held_out_rms_ratio\"",
            "\"ratio_held_out\"",
            "$.provenance.verdict.ratio_held_out is 0.3",
        ),
        (
            "\"interval\": [0.25, null]",
            "\"interval\": [0.25, 0.2]",
            "$.provenance.verdict.interval is [0.25,0.2]: the lower bound comes first",
        ),
        (
            "\"slip_force\": [null,",
            "\"slip_force\": [0.5,",
            "$.intervals.slip_force is [0.5,0.3",
        ),
    ];
    for (from, to, expected) in cases {
        match read(&changed(from, to), "some/joint.json") {
            Ok(joint) => panic!("{to} was read: {joint:?}"),
            Err(error) => {
                let message = error.to_string();
                assert!(message.starts_with("some/joint.json"), "{message}");
                assert!(message.contains(expected), "{message} lacks {expected}");
            }
        }
    }
    let below = read(
        &changed("\"slip_force\": 1000.0", "\"slip_force\": -2"),
        "x",
    );
    let message = below.expect_err("a negative slip force").to_string();
    assert!(
        message.contains("a number in N, ") && message.len() < 100,
        "{message}"
    );
    for text in ["[]", "3", "null", "\"joint\""] {
        assert!(
            matches!(read(text, "x"), Err(SavedError::Unusable { .. })),
            "{text}"
        );
    }
    assert!(matches!(
        read("", "x"),
        Err(SavedError::Syntax { line: 1, .. })
    ));
}

#[test]
fn a_span_has_both_its_numbers_or_none() {
    let whole = write(&saved(sliders(), 3.5, vec![]));
    for (lacks, keeps) in [
        ("duration", "sample_interval"),
        ("sample_interval", "duration"),
    ] {
        let mut text: serde_json::Value = serde_json::from_str(&whole).unwrap();
        let record = text["provenance"]["records"][0].as_object_mut().unwrap();
        assert!(record.remove(lacks).is_some());
        let message = read(&text.to_string(), "x").unwrap_err().to_string();
        let expected = format!("$.provenance.records[0].{lacks} is missing: give `duration`");
        assert!(message.contains(&expected), "{message}");
        let record = text["provenance"]["records"][0].as_object_mut().unwrap();
        assert!(record.remove(keeps).is_some());
        let read = read(&text.to_string(), "x").unwrap();
        assert_eq!(read.provenance.records[0].span, None);
    }
}

#[test]
fn a_verdict_without_an_interval_may_say_null() {
    let text = changed("\"interval\": [0.25, null]", "\"interval\": null");
    let verdict = read(&text, "x").unwrap().provenance.verdict.unwrap();
    assert_eq!(verdict.interval, None);
}

#[test]
fn a_byte_order_mark_is_read_over() {
    let whole = saved(sliders(), 3.5, vec![]);
    assert_eq!(read(&format!("\u{feff}{}", write(&whole)), "x"), Ok(whole));
}

#[test]
fn a_bad_value_of_a_list_is_named_with_its_place() {
    let density = Density::Sliders(Sliders::new(vec![2.0, 3.0], vec![0.25, 0.5], 0.0).unwrap());
    let text = write(&saved(density, 3.5, vec![]));
    for (from, to, expected) in [
        (
            "[2.0, 3.0]",
            "[2.0, -3.0]",
            "$.density: parameter `weight[1]` is -3",
        ),
        (
            "[0.25, 0.5]",
            "[0, 0.5]",
            "$.density: parameter `slip_at[0]` is 0",
        ),
    ] {
        assert!(text.contains(from), "{text}");
        let refused = read(&text.replace(from, to), "x");
        let message = refused.expect_err("no slider").to_string();
        assert!(
            message.contains(expected) && message.len() < 120,
            "{message}"
        );
    }
}

#[test]
fn table_1_comes_out_of_the_examples() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let load = std::fs::read_to_string(folder.join("table1_load.csv")).unwrap();
    let rows = load.lines().filter(|line| !line.starts_with('#')).skip(1);
    let (time, force): (Vec<f64>, Vec<f64>) = rows
        .map(|row| {
            let (time, force) = row.split_once(',').unwrap();
            (
                time.trim().parse::<f64>().unwrap(),
                force.trim().parse::<f64>().unwrap(),
            )
        })
        .unzip();
    let cases = [
        ("table1_case1.json", 2.290084423596e-10, 2.784083274606e-10),
        ("table1_case2.json", 2.290086727746e-10, 2.784086213165e-10),
    ];
    for (name, from_virgin, steady) in cases {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        let joint = read(&text, name).unwrap().joint;
        let answers = joint.simulate(Drive::Force, &time, &force).unwrap();
        let at = |periods: f64| {
            let end = periods * std::f64::consts::TAU;
            let near = answers
                .iter()
                .rev()
                .find(|output| output.time <= end + 1e-9);
            near.map_or(f64::NAN, |output| output.dissipation)
        };
        assert!(
            (at(1.0) / from_virgin - 1.0).abs() < 1e-9,
            "{name} {:e}",
            at(1.0)
        );
        let last = at(5.0) - at(4.0);
        assert!((last / steady - 1.0).abs() < 1e-9, "{name} {last:e}");
    }
}
