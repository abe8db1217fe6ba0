//! `iwan diagnose`: records → what is wrong, why, and the joint that has it.

use super::input::{BesideTable, Records};
use super::provenance::provenance;
use super::{BadInput, output};
use crate::causes::{Cause, find};
use crate::diagnose::amplitude_table::diagnose_tables;
use crate::diagnose::{Findings, diagnose};
use crate::joint::Drive;
use crate::pack::{Archive, Library};
use crate::read::Loaded;
use crate::record::{AmplitudeTable, Measurement, Record};
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
    #[command(flatten)]
    beside: BesideTable,
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
    let known = arguments.beside.known()?;
    let loaded = arguments.records.load()?;
    let start = Instant::now();
    let progress = |stage: &str| eprintln!("[{:6.2} s] {stage}", start.elapsed().as_secs_f64());
    let (mut findings, missing) = match tables(&loaded)? {
        Some(tables) => {
            let found = diagnose_tables(&tables, &known, progress)
                .map_err(|error| BadInput(error.to_string()))?;
            (found.findings, found.missing)
        }
        None => (diagnose(&histories(&loaded)?, progress)?, None),
    };
    for (entry, loaded) in findings.records.iter_mut().zip(&loaded) {
        entry.2.clone_from(&loaded.sha256);
    }
    let page = html::render(&findings, &pages(&findings))?;
    let diagnosis = serde_json::to_string_pretty(&json::render(&findings))?;
    let joint = match &missing {
        None => Some(write(&saved(&findings, &loaded))),
        Some(why) => {
            eprintln!("neither joint.json nor joint.fmu is written: {why}");
            None
        }
    };
    let drive = match findings.judged.as_str() {
        "force" => Drive::Displacement,
        _ => Drive::Force,
    };
    let archive = match &joint {
        Some(joint) => archive(joint, drive)?,
        None => None,
    };
    output::make_folder(&arguments.output)?;
    let mut files = vec![
        ("report.html", page.into_bytes()),
        ("diagnosis.json", diagnosis.clone().into_bytes()),
    ];
    files.extend(joint.map(|text| ("joint.json", text.into_bytes())));
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

/// The unit for this machine; said and left out where there is no library for it.
fn archive(joint: &str, drive: Drive) -> anyhow::Result<Option<Vec<u8>>> {
    let library = Library::of_this_machine()
        .map_err(|error| eprintln!("no joint.fmu is written: {error}"))
        .ok();
    let bytes =
        library.map(|library| Archive::new(joint, "joint.json", drive, &[library])?.bytes());
    Ok(bytes.transpose()?)
}

/// The amplitude tables, where the files are all tables; `None` where none is.
fn tables(loaded: &[Loaded]) -> Result<Option<Vec<AmplitudeTable>>, BadInput> {
    let tables: Vec<AmplitudeTable> = loaded
        .iter()
        .filter_map(|loaded| match &loaded.measurement {
            Measurement::Amplitudes(table) => Some(table.clone()),
            Measurement::History(_) => None,
        })
        .collect();
    match tables.len() {
        0 => Ok(None),
        count if count == loaded.len() => Ok(Some(tables)),
        _ => Err(BadInput(format!(
            "{} is an amplitude table beside time histories: diagnose the two apart",
            tables[0].name
        ))),
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
                "{} is an amplitude table, no time history",
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
