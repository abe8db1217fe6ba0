//! One `Findings` value as JSON, text and HTML: the contract field by field, the numbers as they
//! are, and nothing that breaks the page.

use iwan::diagnose::Findings;
use iwan::diagnose::experiment::dummy::Ruling;
use iwan::diagnose::experiment::{Correction, Dummy, Outlook, Separable};
use iwan::diagnose::findings::{
    Candidate, Errors, Estimate, NamedCause, NoiseFinding, RecordCurves, Unexplained, Verdict,
};
use iwan::diagnose::left_out::LeftOut;
use iwan::diagnose::levels::{Compared, Level};
use iwan::joint::{Density, Joint, Sliders};
use iwan::report::{CausePage, html, json, text};
use serde_json::{Value, json};

/// Sliders loaded by a displacement of slowly growing amplitude, judged in displacement: the
/// baseline lacks a pin that touches beyond a gap, the extended joint has it.
fn curves(name: &str, cycles: usize) -> RecordCurves {
    let per_cycle = 200;
    let sliders: Vec<(f64, f64)> = (1..=12).map(|j| (1.5e6, 1.1e-6 * f64::from(j))).collect();
    let mut stretched = vec![0.0; sliders.len()];
    let mut record = RecordCurves {
        name: name.to_owned(),
        ..RecordCurves::default()
    };
    let mut noise = 12345_u64;
    let mut last = 0.0;
    for sample in 0..cycles * per_cycle {
        let phase = sample as f64 / per_cycle as f64;
        let amplitude = 4e-6 + 8e-6 * phase / cycles as f64;
        let displacement = amplitude * (std::f64::consts::TAU * phase).sin();
        let mut force = 0.0;
        for (stretch, (stiffness, slip_at)) in stretched.iter_mut().zip(&sliders) {
            *stretch = (*stretch + displacement - last).clamp(-slip_at, *slip_at);
            force += stiffness * *stretch;
        }
        last = displacement;
        noise = noise
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        let scatter = 1.2e-7 * ((noise >> 33) as f64 / 2f64.powi(31) - 0.5);
        let pin = 0.06 * (displacement.abs() - 6e-6).max(0.0) * displacement.signum();
        record.time.push(sample as f64 * 1e-3);
        record.force.push(force);
        record.displacement.push(displacement - pin + scatter);
        record.baseline.push(displacement);
        record.extended.push(displacement - pin);
        record
            .held_out
            .push((0.4..0.6).contains(&(phase / cycles as f64)) || phase > 0.85 * cycles as f64);
    }
    record.cycles = (0..cycles)
        .map(|cycle| {
            let measured = 2e-4 * (1.0 + cycle as f64).powf(0.9);
            [
                cycle as f64 * 0.2,
                measured,
                1.09 * measured,
                1.01 * measured,
            ]
        })
        .collect();
    record
}

fn estimate(name: &str, value: f64, unit: &str, interval: Option<(f64, f64)>) -> Estimate {
    Estimate {
        name: name.to_owned(),
        value,
        unit: unit.to_owned(),
        interval,
    }
}

fn candidate(name: &str, kind: &str, evidence: f64, probability: f64) -> Candidate {
    Candidate {
        name: name.to_owned(),
        kind: kind.to_owned(),
        evidence,
        probability,
        lambda_sep: (evidence > 0.0).then_some(31.5),
        held_out_gain: (evidence > 0.0).then_some(0.61),
    }
}

fn level(record: &str, (amplitude, mean): (f64, f64), rate: Option<f64>, energy: f64) -> Level {
    Level {
        record: record.to_owned(),
        amplitude,
        mean,
        unit: "N".to_owned(),
        rate,
        cycles: if rate.is_some() { 4 } else { 1 },
        held_out: rate.is_none(),
        energy: Some(Compared {
            measured: energy,
            unit: "J".to_owned(),
            before: 0.09,
            before_interval: Some((0.08, 0.1)),
            after: 0.01,
            after_interval: None,
        }),
        stiffness: None,
    }
}

fn explained() -> Findings {
    let pinning = NamedCause {
        name: "pinning".to_owned(),
        kind: "joint".to_owned(),
        parameters: vec![
            estimate("stiffness", 1.234e6, "N/m", Some((1.18e6, 1.29e6))),
            estimate("gap", 6.02e-6, "m", Some((5.9e-6, 6.5e-6))),
            estimate("asymmetry", 0.04, "1", None),
            estimate("rounding", 0.0, "m", None),
        ],
        absent: vec!["rounding".to_owned()],
        ambiguous_with: vec!["cubic_stiffness".to_owned()],
        evidence: 812.4,
        matters: 0.0713,
    };
    let names = [
        "creep",
        "sensor_delay",
        "mains_hum",
        "preload_loss",
        "joint_opening",
    ];
    let mut candidates = vec![
        candidate("pinning", "joint", 402.7, 0.62),
        candidate("cubic_stiffness", "joint", 401.9, 0.37),
        candidate("clearance", "joint", 122.4, 1e-9),
        candidate("displacement_drift", "measurement", f64::NEG_INFINITY, 0.0),
    ];
    for (row, name) in names.iter().enumerate() {
        candidates.push(candidate(name, "joint", -3.5 - row as f64, 0.0));
    }
    Findings {
        verdict: Verdict::Explained,
        summary: "A pin touches beyond 6 µm on both sides; its force closes the loops' ends."
            .to_owned(),
        judged: "displacement".to_owned(),
        unit: "m".to_owned(),
        records: vec![
            ("bolt-1".to_owned(), 4000, "ab".repeat(32)),
            ("bolt-2".to_owned(), 2000, "cd".repeat(32)),
        ],
        held_out: vec![vec![(1.0, 1.5), (3.25, 4.0)], vec![]],
        causes: vec![pinning],
        candidates,
        noise: NoiseFinding {
            rms: 3.46e-8,
            unit: "m".to_owned(),
            autoregression: 0.12,
            method: "neighbouring steady cycles, differenced".to_owned(),
            effective_samples: 3120.0,
        },
        baseline: Errors {
            train_rms: 1.11e-7,
            held_out_rms: 1.22e-7,
            dissipation_error: Some(0.092),
            stiffness_error: Some(0.031),
            ..Errors::default()
        },
        extended: Errors {
            train_rms: 3.3e-8,
            held_out_rms: 3.5e-8,
            dissipation_error: Some(0.011),
            dissipation_interval: Some((0.009, 0.014)),
            ..Errors::default()
        },
        gain: (0.287, Some((0.25, 0.331))),
        levels: vec![
            level("bolt-1", (400.0, 0.0), Some(5.0), 2e-4),
            level("bolt-2", (800.0, 100.0), None, 9e-4),
        ],
        left_out: vec![LeftOut {
            record: "bolt-1".to_owned(),
            before: 2.1e-7,
            after: 5.2e-8,
            ratio: 0.248,
            interval: Some((0.21, 0.29)),
        }],
        unexplained: Unexplained {
            doubles: vec![],
            share: 0.02,
            places: vec!["record bolt-2, cycles 4–6, just after reversals".to_owned()],
        },
        not_identifiable: vec![
            "Rate effects: all cycles have one frequency.".to_owned(),
            "Full slip: the largest force stays below it.".to_owned(),
        ],
        next_experiment: Some(
            "Ten cycles at 14 µm: pinning and cubic stiffness then differ by 40 noise variances."
                .to_owned(),
        ),
        joint_parameters: vec![
            estimate("slip_force", 4123.0, "N", Some((3930.0, 4310.0))),
            estimate("tangential_stiffness", 1.8e7, "N/m", Some((1.76e7, 1.85e7))),
            estimate("series_stiffness", f64::INFINITY, "N/m", None),
        ],
        notes: vec!["Records share one joint; each has its own offset.".to_owned()],
        joint: Joint {
            density: Density::Sliders(Sliders::new(vec![1.5e6], vec![1e-6], 0.0).unwrap()),
            series_stiffness: f64::INFINITY,
            effects: Vec::new(),
        },
        curves: vec![curves("bolt-1", 20), curves("bolt-2", 10)],
        outlook: Default::default(),
    }
}

fn clean() -> Findings {
    let mut found = explained();
    for curves in &mut found.curves {
        curves.baseline.clone_from(&curves.extended);
    }
    Findings {
        verdict: Verdict::Clean,
        summary: "Nothing beyond the noise.".to_owned(),
        causes: Vec::new(),
        baseline: found.extended.clone(),
        gain: (1.0, None),
        left_out: Vec::new(),
        unexplained: Unexplained::default(),
        next_experiment: None,
        ..found
    }
}

fn worse() -> Findings {
    let found = explained();
    Findings {
        verdict: Verdict::PartlyExplained,
        extended: Errors {
            held_out_rms: 1.43e-7,
            ..found.extended.clone()
        },
        gain: (1.17, Some((1.02, 1.33))),
        ..found
    }
}

fn unexplained() -> Findings {
    let found = clean();
    Findings {
        curves: explained().curves,
        outlook: Default::default(),
        verdict: Verdict::Unexplained,
        summary: "What is left repeats from cycle to cycle.".to_owned(),
        baseline: explained().baseline,
        extended: explained().baseline,
        unexplained: Unexplained {
            doubles: vec![],
            share: 1.0,
            places: vec!["record bolt-1, all cycles, at the largest force".to_owned()],
        },
        ..found
    }
}

fn page() -> CausePage {
    CausePage {
        name: "pinning".to_owned(),
        happens: "The shank of the bolt meets the wall of its hole after a gap.".to_owned(),
        sign: "Loops end in stiff tips beyond a displacement that does not change with load."
            .to_owned(),
        mistaken_for: vec!["cubic_stiffness".to_owned(), "joint_opening".to_owned()],
        separated_by: "A knee at the gap: cubic stiffness has none.".to_owned(),
        formula: "F = k·max(|u| − g, 0)·sign(u)  if |u| > g, k < ∞".to_owned(),
        source: "Segalman & Starr, SAND2001-0811".to_owned(),
    }
}

fn drawn(findings: &Findings) -> String {
    html::render(findings, &[page()]).expect("a page")
}

/// The page in a file beside the test's other products, to be looked at.
fn kept(name: &str, page: &str) {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(path, page).expect("writable target directory");
}

#[test]
fn json_follows_the_schema_field_by_field() {
    let written = json::render(&explained());
    let expected = json!({
        "schema": "iwan-diagnosis/1",
        "verdict": "explained",
        "summary": "A pin touches beyond 6 µm on both sides; its force closes the loops' ends.",
        "judged": "displacement",
        "unit": "m",
        "causes": [{
            "name": "pinning",
            "kind": "joint",
            "parameters": [
                {"name": "stiffness", "value": 1.234e6, "unit": "N/m", "interval": [1.18e6, 1.29e6]},
                {"name": "gap", "value": 6.02e-6, "unit": "m", "interval": [5.9e-6, 6.5e-6]},
                {"name": "asymmetry", "value": 0.04, "unit": "1", "interval": null},
                {"name": "rounding", "value": 0.0, "unit": "m", "interval": null},
            ],
            "absent": ["rounding"],
            "ambiguous_with": ["cubic_stiffness"],
            "evidence": 812.4,
            "matters": 0.0713,
        }],
        "noise": {
            "rms": 3.46e-8, "unit": "m", "autoregression": 0.12,
            "method": "neighbouring steady cycles, differenced", "effective_samples": 3120.0,
        },
        "baseline": {
            "train_rms": 1.11e-7, "held_out_rms": 1.22e-7, "held_out_interval": null,
            "dissipation_error": 0.092, "dissipation_interval": null,
            "stiffness_error": 0.031, "stiffness_interval": null,
        },
        "extended": {
            "train_rms": 3.3e-8, "held_out_rms": 3.5e-8, "held_out_interval": null,
            "dissipation_error": 0.011, "dissipation_interval": [0.009, 0.014],
            "stiffness_error": null, "stiffness_interval": null,
        },
        "gain": {
            "held_out_rms_ratio": 0.287, "interval": [0.25, 0.331],
            "left_out_records": [{
                "record": "bolt-1", "before": 2.1e-7, "after": 5.2e-8, "ratio": 0.248,
                "interval": [0.21, 0.29],
            }],
        },
        "levels": [{
            "record": "bolt-1", "amplitude": 400.0, "mean": 0.0, "unit": "N", "rate": 5.0,
            "cycles": 4, "held_out": false,
            "energy": {
                "measured": 2e-4, "unit": "J", "baseline_error": 0.09,
                "baseline_interval": [0.08, 0.1], "extended_error": 0.01,
                "extended_interval": null,
            },
            "stiffness": null,
        }, {
            "record": "bolt-2", "amplitude": 800.0, "mean": 100.0, "unit": "N", "rate": null,
            "cycles": 1, "held_out": true,
            "energy": {
                "measured": 9e-4, "unit": "J", "baseline_error": 0.09,
                "baseline_interval": [0.08, 0.1], "extended_error": 0.01,
                "extended_interval": null,
            },
            "stiffness": null,
        }],
        "unexplained": {
            "share": 0.02, "where": ["record bolt-2, cycles 4–6, just after reversals"],
            "perhaps_instead": [], "correction": null,
        },
        "not_identifiable": [
            "Rate effects: all cycles have one frequency.",
            "Full slip: the largest force stays below it.",
        ],
        "next_experiment": {"description":
            "Ten cycles at 14 µm: pinning and cubic stiffness then differ by 40 noise variances."},
        "separability": [],
        "dummy": [],
        "records": [
            {"name": "bolt-1", "samples": 4000, "sha256": "ab".repeat(32), "held_out": [[1.0, 1.5], [3.25, 4.0]]},
            {"name": "bolt-2", "samples": 2000, "sha256": "cd".repeat(32), "held_out": []},
        ],
        "joint_parameters": [
            {"name": "slip_force", "value": 4123.0, "unit": "N", "interval": [3930.0, 4310.0]},
            {"name": "tangential_stiffness", "value": 1.8e7, "unit": "N/m",
             "interval": [1.76e7, 1.85e7]},
            {"name": "series_stiffness", "value": null, "unit": "N/m", "interval": null},
        ],
        "notes": ["Records share one joint; each has its own offset."],
    });
    let mut rest = written.clone();
    let candidates = rest
        .as_object_mut()
        .and_then(|fields| fields.remove("candidates"));
    assert_eq!(rest, expected);
    let candidates = candidates.expect("candidates");
    assert_eq!(candidates.as_array().map(Vec::len), Some(9));
    assert_eq!(
        candidates[0],
        json!({"name": "pinning", "kind": "joint", "evidence": 402.7, "probability": 0.62,
               "lambda_sep": 31.5, "held_out_gain": 0.61})
    );
    // Minus infinity and what was not computed are both null.
    assert_eq!(
        candidates[3],
        json!({"name": "displacement_drift", "kind": "measurement", "evidence": null,
               "probability": 0.0, "lambda_sep": null, "held_out_gain": null})
    );
}

#[test]
fn json_names_every_verdict_and_reads_back() {
    for (findings, verdict) in [
        (clean(), "clean"),
        (explained(), "explained"),
        (worse(), "partly_explained"),
        (unexplained(), "unexplained"),
    ] {
        let value = json::render(&findings);
        assert_eq!(value["verdict"], verdict);
        let text = serde_json::to_string_pretty(&value).expect("text");
        assert_eq!(serde_json::from_str::<Value>(&text).expect("value"), value);
    }
    assert_eq!(json::render(&clean())["next_experiment"], Value::Null);
    assert_eq!(
        json::render(&clean())["gain"],
        json!({"held_out_rms_ratio": 1.0, "interval": null, "left_out_records": []})
    );
}

/// Every number of the findings that is no number.
fn broken() -> Findings {
    let nan = f64::NAN;
    let mut found = explained();
    found.gain = (nan, Some((nan, f64::INFINITY)));
    found.left_out.clear();
    found.levels[0].amplitude = nan;
    found.noise.rms = nan;
    found.noise.effective_samples = nan;
    found.baseline.held_out_rms = nan;
    found.extended.held_out_rms = nan;
    found.extended.dissipation_error = Some(nan);
    found.unexplained.share = nan;
    found.causes[0].matters = nan;
    found.causes[0].parameters[0].value = nan;
    found.causes[0].parameters[1].interval = Some((5e-6, f64::INFINITY));
    found.curves[0].baseline[7] = nan;
    found.curves[0].time[9] = f64::INFINITY;
    found.curves[0].cycles[2] = [nan; 4];
    found.curves[1] = RecordCurves {
        name: "empty".to_owned(),
        ..RecordCurves::default()
    };
    found
}

#[test]
fn numbers_that_are_none_break_nothing() {
    let found = broken();
    let value = json::render(&found);
    assert_eq!(
        value["gain"],
        json!({"held_out_rms_ratio": null, "interval": [null, null], "left_out_records": []})
    );
    assert_eq!(value["noise"]["rms"], Value::Null);
    assert_eq!(value["causes"][0]["parameters"][0]["value"], Value::Null);
    assert_eq!(
        value["causes"][0]["parameters"][1]["interval"],
        json!([5e-6, null])
    );
    assert_eq!(value["extended"]["dissipation_error"], Value::Null);
    let page = drawn(&found);
    for text in [text::render(&found), page.clone()] {
        assert!(text.contains("not determined"));
        assert!(
            !text.contains("NaN") && !text.contains(">inf"),
            "a raw NaN or inf is shown"
        );
    }
    assert!(page.contains("No curves to draw."));
    assert!(
        !page.contains("WORSE"),
        "no number is not a worse prediction"
    );
}

/// The text without its line breaks.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn what_slow_noise_was_granted_is_told() {
    let told = |times: f64| {
        let mut found = clean();
        found.baseline.train_rms = times * found.noise.rms;
        words(&text::render(&found))
    };
    let slow = told(3.1);
    assert!(
        slow.contains("what is left is 3.1 times the noise"),
        "{slow}"
    );
    let plain = told(1.3);
    assert!(
        plain.contains("What remains Nothing beyond the noise."),
        "{plain}"
    );
}

#[test]
fn text_has_the_verdict_first_and_fits_a_screen() {
    for (findings, first) in [
        (clean(), "CLEAN. Nothing beyond the noise."),
        (
            explained(),
            "EXPLAINED. A pin touches beyond 6 µm on both sides;",
        ),
        (
            unexplained(),
            "UNEXPLAINED. What is left repeats from cycle to cycle.",
        ),
    ] {
        let text = text::render(&findings);
        assert!(text.starts_with(first), "{text}");
        assert!(text.lines().count() <= 40, "{text}");
        assert!(
            text.lines().all(|line| line.chars().count() <= 96),
            "{text}"
        );
    }
    let text = text::render(&explained());
    assert!(!text.contains("rounding"), "no refinement that is absent");
    for shown in [
        "by 122 nm rms on unseen data, 3.5 × the noise of 34.6 nm",
        "1.234 MN/m  ± 0.055 MN/m (4.5 %)",
        "6.02 µm  +0.48 / -0.12 µm (5.0 %)",
        "0.0400  not bounded by the data",
        "not to be told from: cubic stiffness",
        "Changes 7.1 % of the dissipated energy; without it the misfit rises by 812 noise variances",
        "The error on unseen data falls by 71 %.",
        "122 nm → 35.0 nm, ratio 0.287 (95 %: 0.250 … 0.331)",
        "Energy per cycle off by 9.2 % before, 1.1 % after.",
        "2.0 % of the explainable misfit is left beyond what noise may leave.",
        "4.12 kN  ± 0.19 kN (4.6 %)",
        "Rate effects: all cycles have one frequency.",
        "Ten cycles at 14 µm",
    ] {
        // Sentences are wrapped; columns are not.
        let found = text.contains(shown) || words(&text).contains(shown);
        assert!(found, "`{shown}` is missing in\n{text}");
    }
}

#[test]
fn a_long_text_is_shortened_and_says_so() {
    let mut found = explained();
    found.joint_parameters = (0..30)
        .map(|row| estimate(&format!("weight_{row}"), 1e6, "N/m", None))
        .collect();
    found.notes = (0..20).map(|row| format!("Note {row}.")).collect();
    let text = text::render(&found);
    assert!(text.lines().count() <= 40, "{text}");
    assert!(text.contains("more in diagnosis.json"));
    // Every item dropped is counted.
    let dropped: usize = text
        .lines()
        .filter_map(|line| {
            line.trim()
                .strip_prefix("… ")?
                .split(' ')
                .next()?
                .parse::<usize>()
                .ok()
        })
        .sum();
    let shown = text
        .lines()
        .filter(|line| line.contains("weight_") || line.contains("Note "))
        .count();
    assert_eq!(shown + dropped, 50);
}

#[test]
fn no_sentence_and_no_named_cause_is_cut() {
    let mut found = explained();
    let long = "the same force through the same joint ".repeat(6);
    found.not_identifiable = (0..6)
        .map(|row| format!("Sentence {row}: {long}ends."))
        .collect();
    found.causes[0].parameters = (0..28)
        .map(|row| estimate(&format!("height_{row}"), 1e6, "N/m", None))
        .collect();
    let text = text::render(&found);
    for row in 0..28 {
        assert!(text.contains(&format!("height_{row} ")), "{row} in\n{text}");
    }
    assert!(text.contains("Changes 7.1 %"), "{text}");
    let text = words(&text);
    assert!(text.contains("more in diagnosis.json"), "{text}");
    assert_eq!(
        text.matches("Sentence ").count(),
        text.matches("joint ends.").count()
    );
}

#[test]
fn what_may_be_something_else_is_not_asserted() {
    let mut found = explained();
    found.verdict = Verdict::PartlyExplained;
    found.unexplained.doubles = vec!["pinning: a specimen that settles".to_owned()];
    let perhaps =
        "Perhaps something that is not in the catalogue instead: a specimen that settles.";
    let text = words(&text::render(&found));
    assert!(text.contains(perhaps), "{text}");
    let page = drawn(&found);
    assert!(page.contains(perhaps) && page.contains("The cause, perhaps"));
    assert!(!drawn(&explained()).contains("perhaps"));
}

#[test]
fn prose_has_words_where_programs_have_names() {
    let mut found = explained();
    found.not_identifiable = vec!["preload_loss is not told from running_in.".to_owned()];
    found.next_experiment = Some("To show preload_loss: run next_experiment.csv.".to_owned());
    let page = drawn(&found);
    let text = words(&text::render(&found));
    for shown in [&page, &text] {
        assert!(shown.contains("preload loss is not told from running-in."));
        assert!(shown.contains("To show preload loss: run next_experiment.csv."));
    }
    assert!(page.contains("<code>pinning</code>") && text.contains("pinning (joint)"));
}

#[test]
fn levels_are_what_the_load_dwells_on() {
    let mut found = explained();
    let mut held = level("bolt-1", (400.0, 0.0), Some(5.0), 2e-4);
    held.cycles = 6;
    let mut passing = level("bolt-1", (700.0, -300.0), Some(5.0), 5e-4);
    passing.cycles = 1;
    found.levels = vec![
        held,
        passing,
        level("bolt-1", (800.0, 0.0), Some(5.0), 9e-4),
    ];
    let page = drawn(&found);
    assert!(page.contains("All 2 levels in numbers"));
    assert!(page.contains("1 cycle on the way from one level to the next is no level"));
    assert!(page.contains(">Loss per cycle</th>") && page.contains(">Stiffness</th>"));
    // Without dwelling every cycle is a level, as in a ring-down.
    for level in &mut found.levels {
        level.cycles = 1;
    }
    assert!(drawn(&found).contains("All 3 levels in numbers"));
}

#[test]
fn of_a_table_only_what_was_tried_is_shown() {
    let mut found = clean();
    found.judged = "loss and stiffness per level (in units of the noise)".to_owned();
    found.noise.effective_samples = 12.0;
    found.candidates = vec![
        candidate("pinning", "joint", -1.7, 0.11),
        candidate("creep", "joint", 0.0, 0.0),
    ];
    let page = drawn(&found);
    assert!(page.contains("The candidate in numbers"));
    assert!(page.contains("cannot show them: creep."));
    assert!(page.contains("12 values of levels") && page.contains(">levels</th>"));
    assert!(text::render(&found).contains("bolt-1 (4000 levels)"));
}

#[test]
fn a_place_is_said_once() {
    let mut found = worse();
    found.unexplained.places = ["7", "6"]
        .map(|share| format!("record b, 0.6 to 0.7 s: {share} % of the structure"))
        .to_vec();
    let text = text::render(&found);
    assert!(
        text.contains("- record b, 0.6 to 0.7 s: 13 % of the structure"),
        "{text}"
    );
}

#[test]
fn the_share_within_the_noise_is_said() {
    let page = drawn(&clean());
    assert!(page.contains("of the samples; of noise alone about 95 %."));
}

#[test]
fn a_worse_prediction_comes_before_everything() {
    let text = text::render(&worse());
    let first = text.lines().next().expect("a line");
    assert!(first.starts_with("WORSE. With the extension the prediction of unseen data got worse"));
    assert!(text.contains("ratio 1.17 (95 %: 1.02 … 1.33)"));
    let page = drawn(&worse());
    let alarm = page.find("class=\"alarm\"").expect("an alarm");
    assert!(alarm < page.find("class=\"verdict\"").expect("a verdict"));
    assert!(page.contains("class=\"banner worse\""));
    for fine in [clean(), explained(), unexplained()] {
        assert!(!text::render(&fine).contains("WORSE"));
        assert!(!drawn(&fine).contains("class=\"alarm\""));
    }
    // Without a ratio the two errors decide.
    let mut unmeasured = worse();
    unmeasured.gain = (f64::NAN, None);
    assert!(text::render(&unmeasured).starts_with("WORSE"));
}

#[test]
fn a_gain_that_may_be_none_is_not_claimed() {
    let mut found = explained();
    found.gain = (0.93, Some((0.81, 1.06)));
    // What explains a record is borne out by its samples at least.
    let said = words(&text::render(&found));
    let but = "does not exclude that it is none, but the samples are over forty times as likely";
    assert!(said.contains(but), "{said}");
    found.verdict = Verdict::PartlyExplained;
    assert!(text::render(&found).contains("falls by 7.0 %; the data do not prove a gain."));
    assert!(drawn(&found).contains("the data do not prove a gain."));
}

#[test]
fn the_page_needs_nothing_else() {
    let page = drawn(&explained());
    kept("report_explained.html", &page);
    kept("report_worse.html", &drawn(&worse()));
    kept("report_clean.html", &drawn(&clean()));
    kept("report_unexplained.html", &drawn(&unexplained()));
    let without_namespace = page.replace("xmlns=\"http://www.w3.org/2000/svg\"", "");
    // Links within the page to its glossary.
    let without_namespace = without_namespace.replace(" href=\"#word-", "");
    for loaded in [
        "http:", "https:", " src=", " href=", "url(", "@import", "<script", "<link",
    ] {
        assert!(
            !without_namespace.contains(loaded),
            "`{loaded}` in the page"
        );
    }
    assert!(page.trim_start().starts_with("<!DOCTYPE html>"));
    // Two records with four plots each, two of them also for a narrow page, the loss over amplitude and
    // how far off it is.
    assert_eq!(page.matches("<svg").count(), 14);
    assert_eq!(page.matches("</svg>").count(), 14);
    assert!(page.contains("force [kN]") || page.contains("force [N]"));
    assert!(page.contains("displacement [µm]"));
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
}

#[test]
fn the_page_shows_the_numbers_of_the_findings() {
    // The template's escaping includes the slash.
    let page = drawn(&explained()).replace("&#x2f;", "/");
    for shown in [
        "1.234 MN/m",
        "± 0.055 MN/m (4.5 %)",
        "1.180 … 1.290 MN/m",
        "122 nm",
        "35.0 nm",
        "0.287 (95 %: 0.250 … 0.331)",
        "4.12 kN",
        "Segalman &amp; Starr, SAND2001-0811",
        "if |u| &gt; g, k &lt; ∞",
        "record bolt-2, cycles 4–6, just after reversals",
        "All 9 candidates in numbers",
        "id=\"word-noise-variance\"",
    ] {
        assert!(page.contains(shown), "`{shown}` is missing");
    }
    assert!(page.contains(&"cd".repeat(32)));
}

#[test]
fn foreign_text_is_escaped() {
    let mut found = explained();
    let hostile = "a<b>&\"c\"'<script>alert(1)</script>";
    found.records[0].0 = hostile.to_owned();
    found.curves[0].name = hostile.to_owned();
    found.summary = hostile.to_owned();
    found.notes = vec![hostile.to_owned()];
    found.candidates[0].name = hostile.to_owned();
    found.unexplained.places = vec![hostile.to_owned()];
    let page = drawn(&found);
    assert!(!page.contains("<script") && !page.contains("a<b>"));
    assert!(page.contains("a&lt;b&gt;&amp;&quot;c&quot;"));
    assert_eq!(json::render(&found)["records"][0]["name"], hostile);
}

#[test]
fn records_judged_in_force_are_drawn_in_force() {
    let mut found = explained();
    found.judged = "force".to_owned();
    found.unit = "N".to_owned();
    found.noise.unit = "N".to_owned();
    found.noise.rms = 2.0;
    for curves in &mut found.curves {
        curves.baseline = curves.force.iter().map(|force| 0.98 * force).collect();
        curves.extended.clone_from(&curves.force);
    }
    let page = drawn(&found);
    kept("report_force.html", &page);
    assert!(page.contains("residual force [N]"));
    assert!(!page.contains("residual displacement"));
}

/// The values of one attribute in the markup of a page.
fn attributes<'a>(page: &'a str, name: &str) -> Vec<&'a str> {
    let opening = format!(" {name}=\"");
    let values = page.split(opening.as_str()).skip(1);
    values.filter_map(|rest| rest.split('"').next()).collect()
}

#[test]
fn drawings_are_well_formed_and_small_for_long_records() {
    let mut found = explained();
    found.candidates[1].name = "a<b>&\"c".to_owned();
    found.curves = vec![curves("long", 1000)];
    let samples = found.curves[0].time.len();
    let page = drawn(&found);
    kept("report_long.html", &page);
    let drawings: Vec<&str> = page.split("<svg").skip(1).collect();
    assert_eq!(drawings.len(), 8);
    for drawing in drawings {
        let end = drawing.find("</svg>").expect("an end") + "</svg>".len();
        let markup = format!("<svg{}", &drawing[..end]);
        let mut reader = quick_xml::Reader::from_str(&markup);
        loop {
            match reader.read_event() {
                Ok(quick_xml::events::Event::Eof) => break,
                Ok(_) => {}
                Err(error) => panic!("{error} in {markup:.200}"),
            }
        }
    }
    let longest = attributes(&page, "points").into_iter();
    let longest = longest
        .map(|points| points.split_whitespace().count())
        .max();
    assert!(
        longest.is_some_and(|points| (500..=1500).contains(&points)),
        "{longest:?}"
    );
    assert!(
        page.len() < 1_000_000,
        "{} bytes for {samples} samples",
        page.len()
    );
}

#[test]
fn only_what_was_found_is_drawn() {
    let blue = " stroke=\"#0072B2\"";
    assert!(drawn(&explained()).contains(blue));
    assert!(
        !drawn(&clean()).contains(blue),
        "a clean record has no extended joint"
    );
    let yellow = " fill=\"#F0E442\"";
    let shaded = |findings: &Findings| drawn(findings).matches(yellow).count();
    // Two blocks were held out of each of the two records, drawn twice; the loss of one level, and its two
    // errors.
    assert_eq!(shaded(&explained()), 11);
    let mut fitted = explained();
    for level in &mut fitted.levels {
        level.held_out = false;
    }
    for curves in &mut fitted.curves {
        curves.held_out.fill(false);
    }
    assert_eq!(shaded(&fitted), 0);
    let mut bare = explained();
    bare.curves.clear();
    bare.candidates.clear();
    bare.levels.clear();
    assert!(!drawn(&bare).contains("<svg"));
}

#[test]
fn what_lies_beyond_the_verdict_is_shown() {
    let mut findings = unexplained();
    findings.outlook = Outlook {
        separability: vec![Separable {
            name: "viscous_damping".to_owned(),
            fitted: false,
            values: vec![("coefficient".to_owned(), 120.0, "N.s/m".to_owned())],
            lambda: 4.25,
            baseline: 310.0,
            rivals: vec![("sensor_delay".to_owned(), 4.25)],
            row: vec![
                ("none".to_owned(), 310.0),
                ("sensor_delay".to_owned(), 4.25),
            ],
        }],
        experiment: None,
        dummy: vec![Dummy {
            name: "sensor_delay".to_owned(),
            fall: 512.0,
            power: 498.0,
            ruling: Ruling::Shown,
        }],
        correction: Some(Correction {
            terms: vec![("cube of the input".to_owned(), 2.5e-7)],
            unit: "m".to_owned(),
            ratio: 0.62,
            interval: (0.55, 0.71),
        }),
    };
    let value = json::render(&findings);
    assert_eq!(
        value["unexplained"]["correction"],
        json!({"is_a_cause": false, "held_out_rms_ratio": 0.62, "interval": [0.55, 0.71],
               "terms": [{"feature": "cube of the input", "largest": 2.5e-7, "unit": "m"}]})
    );
    assert_eq!(
        value["separability"][0]["rivals"][0]["name"],
        "sensor_delay"
    );
    assert_eq!(value["dummy"][0]["ruling"], "shown");
    let page = html::render(&findings, &[]).expect("page");
    for words in [
        "which is no cause",
        "cube of the input",
        "What this loading can tell apart",
        "sensor delay (4.25)",
        "What is mistaken for what",
        "it belongs to the measuring chain",
    ] {
        assert!(page.contains(words), "{words}");
    }
}
