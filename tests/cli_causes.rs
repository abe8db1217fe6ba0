//! `iwan causes`: the catalogue as an engineer and as a program sees it.

use iwan::causes::CATALOGUE;
use std::process::Command;

fn causes(arguments: &[&str]) -> String {
    let binary = env!("CARGO_BIN_EXE_iwan");
    let output = Command::new(binary)
        .arg("causes")
        .args(arguments)
        .output()
        .expect("it runs");
    assert_eq!(output.status.code(), Some(0), "{arguments:?}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[test]
fn every_cause_has_a_line_and_a_page() {
    assert!(!CATALOGUE.is_empty());
    let list = causes(&[]);
    assert_eq!(list.lines().count(), CATALOGUE.len());
    for (cause, line) in CATALOGUE.iter().zip(list.lines()) {
        let kind = if cause.place().is_measurement() {
            "measurement"
        } else {
            "joint"
        };
        let mut words = line.split_whitespace();
        assert_eq!(
            (words.next(), words.next()),
            (Some(cause.name()), Some(kind))
        );
        let page = causes(&[cause.name()]);
        let unwrapped = page.split_whitespace().collect::<Vec<_>>().join(" ");
        let text = cause.page();
        for part in [
            text.happens,
            text.sign,
            text.separated_by,
            text.formula,
            text.source,
        ] {
            let part = part.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(unwrapped.contains(&part), "{}: {part}", cause.name());
        }
        for parameter in cause.parameters() {
            assert!(
                page.contains(parameter.name) && page.contains(parameter.unit),
                "{page}"
            );
        }
        assert!(
            page.lines().all(|line| line.chars().count() <= 100),
            "{page}"
        );
    }
}

#[test]
fn programs_read_the_same() {
    let all: serde_json::Value = serde_json::from_str(&causes(&["--json"])).expect("JSON");
    let all = all.as_array().expect("a list");
    assert_eq!(all.len(), CATALOGUE.len());
    for (cause, entry) in CATALOGUE.iter().zip(all) {
        assert_eq!(entry["name"], cause.name());
        assert_eq!(entry["happens"], cause.page().happens);
        let parameters = entry["parameters"].as_array().expect("a list");
        assert_eq!(parameters.len(), cause.parameters().len());
        let one = causes(&[cause.name(), "--json"]);
        let one: serde_json::Value = serde_json::from_str(&one).expect("JSON");
        assert_eq!(&one, entry);
    }
}
