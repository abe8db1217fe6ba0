//! `iwan diagnose`: records → what is wrong, why, and the joint that has it.

use super::input::Records;
use super::provenance::provenance;
use super::{BadInput, output};
use crate::causes::{Cause, find};
use crate::diagnose::{Findings, diagnose};
use crate::joint::Drive;
use crate::pack::{Archive, Library};
use crate::read::Loaded;
use crate::record::{Measurement, Record};
use crate::report::{CausePage, html, json, text};
use crate::saved::{Judgement, Provenance, SavedJoint, write};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

/// Find what the baseline joint gets wrong, and why.
#[derive(Debug, clap::Args)]
pub struct Diagnose {
    #[command(flatten)]
    records: Records,
    /// Folder to write into; made where it is not there
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Print diagnosis.json instead of the summary
    #[arg(long)]
    json: bool,
}

/// Runs the subcommand: report.html, diagnosis.json, joint.json and joint.fmu, all or none.
///
/// # Errors
/// Bad input as in reading; [`BadInput`] for records that hold no time history.
pub fn run(arguments: &Diagnose) -> anyhow::Result<()> {
    output::admit_folder(&arguments.output)?;
    let loaded = arguments.records.load()?;
    let records = histories(&loaded)?;
    let start = Instant::now();
    let mut findings = diagnose(&records, |stage| {
        eprintln!("[{:6.2} s] {stage}", start.elapsed().as_secs_f64());
    })?;
    for (entry, loaded) in findings.records.iter_mut().zip(&loaded) {
        entry.2.clone_from(&loaded.sha256);
    }
    let page = html::render(&findings, &pages(&findings))?;
    let diagnosis = serde_json::to_string_pretty(&json::render(&findings))?;
    let joint = write(&saved(&findings, &loaded));
    let drive = match findings.judged.as_str() {
        "force" => Drive::Displacement,
        _ => Drive::Force,
    };
    let library = Library::of_this_machine()
        .map_err(|error| eprintln!("no joint.fmu is written: {error}"))
        .ok();
    let archive = library
        .map(|library| Archive::new(&joint, "joint.json", drive, &[library])?.bytes())
        .transpose()?;
    output::make_folder(&arguments.output)?;
    let mut files = vec![
        ("report.html", page.into_bytes()),
        ("diagnosis.json", diagnosis.clone().into_bytes()),
        ("joint.json", joint.into_bytes()),
    ];
    files.extend(archive.map(|bytes| ("joint.fmu", bytes)));
    for (name, bytes) in &files {
        let path = arguments.output.join(name);
        output::write(&path, |out| Ok(out.write_all(bytes)?))?;
        eprintln!(
            "[{:6.2} s] {}",
            start.elapsed().as_secs_f64(),
            path.display()
        );
    }
    match arguments.json {
        true => output::print(&format!("{diagnosis}\n")),
        false => output::print(&text::render(&findings)),
    }
}

/// Fewest samples that a diagnosis can be made of.
const FEWEST: usize = 64;

fn histories(loaded: &[Loaded]) -> Result<Vec<Record>, BadInput> {
    loaded
        .iter()
        .map(|loaded| match &loaded.measurement {
            Measurement::History(record) if record.len() < FEWEST => Err(BadInput(format!(
                "record {} has {} samples: a diagnosis takes at least {FEWEST}; give the whole test",
                record.name,
                record.len()
            ))),
            Measurement::History(record) if flat(&record.force) || flat(&record.displacement) => {
                Err(BadInput(format!(
                    "record {} holds a channel that never changes: a joint needs force and displacement that vary",
                    record.name
                )))
            }
            Measurement::History(record) => Ok(record.clone()),
            Measurement::Amplitudes(table) => Err(BadInput(format!(
                "{} is an amplitude table: it has no time history to diagnose; `iwan identify` reads it",
                table.name
            ))),
        })
        .collect()
}

fn flat(channel: &[f64]) -> bool {
    channel.windows(2).all(|pair| pair[0] == pair[1])
}

fn saved(findings: &Findings, loaded: &[Loaded]) -> SavedJoint {
    let open = (f64::NEG_INFINITY, f64::INFINITY);
    let mut intervals: BTreeMap<_, _> = findings
        .joint_parameters
        .iter()
        .map(|estimate| (estimate.name.clone(), estimate.interval.unwrap_or(open)))
        .collect();
    for cause in findings.causes.iter().filter(|c| c.kind == "joint") {
        for parameter in &cause.parameters {
            let name = format!("{}.{}", cause.name, parameter.name);
            intervals.insert(name, parameter.interval.unwrap_or(open));
        }
    }
    SavedJoint {
        joint: findings.joint.clone(),
        provenance: Provenance {
            remark: Some(findings.summary.clone()),
            verdict: Some(Judgement {
                word: findings.verdict.name().to_owned(),
                held_out_rms_ratio: Some(findings.gain.0).filter(|ratio| ratio.is_finite()),
                interval: findings.gain.1,
            }),
            ..provenance(loaded, "diagnose")
        },
        intervals,
    }
}

fn pages(findings: &Findings) -> Vec<CausePage> {
    let named = findings.causes.iter();
    let names = named.flat_map(|c| std::iter::once(&c.name).chain(&c.ambiguous_with));
    names.filter_map(|name| find(name)).map(page).collect()
}

fn page(cause: &'static dyn Cause) -> CausePage {
    let page = cause.page();
    CausePage {
        name: cause.name().to_string(),
        happens: page.happens.to_string(),
        sign: page.sign.to_string(),
        mistaken_for: page.mistaken_for.iter().map(|s| (*s).to_string()).collect(),
        separated_by: page.separated_by.to_string(),
        formula: page.formula.to_string(),
        source: page.source.to_string(),
    }
}
