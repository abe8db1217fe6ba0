//! `iwan diagnose`: records → what is wrong, why, and the joint that has it.

mod dummy;
mod results;
mod rig;

use super::fewest::Fewest;
use super::input::{BesideTable, Records};
use super::progress::Progress;
use super::provenance::provenance;
use super::{BadInput, output};
use crate::causes::{Cause, find};
use crate::diagnose::amplitude_table::diagnose_tables;
use crate::diagnose::experiment::Options;
use crate::diagnose::{Findings, diagnose_with};
use crate::identify::table::Known;
use crate::joint::Drive;
use crate::pack::{Archive, BUILD_COMMAND, FmiVersion, Library};
use crate::read::Loaded;
use crate::record::{AmplitudeTable, Measurement, Record};
use crate::report::{CausePage, html, json, text};
use crate::saved::{Judgement, Provenance, SavedJoint, write};
use anyhow::Context;
use rig::RigLimits;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

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
    /// What the rig can do, for next_experiment.csv.
    #[command(flatten)]
    rig: RigLimits,
    /// A monolithic specimen measured through the same chain: tells the joint from the chain
    #[arg(long, value_name = "FILE")]
    dummy: Option<PathBuf>,
    /// Print diagnosis.json instead of the summary
    #[arg(long)]
    json: bool,
}

/// Where the physics refuses the best joint, the records are none of a joint.
const NO_JOINT: &str = "no joint follows these records: check the sign and the order of the force and \
                        displacement columns";

/// Runs the subcommand: report.html, diagnosis.json, joint.json, joint.fmu and, where something is
/// open, next_experiment.csv; all or none.
///
/// # Errors
/// Bad input as in reading; [`BadInput`] for records that hold no time history.
pub fn run(arguments: &Diagnose) -> anyhow::Result<()> {
    let mut inputs = arguments.records.paths();
    inputs.extend(arguments.dummy.as_deref());
    results::admit(&arguments.output, &inputs)?;
    let known = arguments.beside.known()?;
    let loaded = arguments.records.load(FEWEST)?;
    arguments.beside.of_use(&loaded)?;
    arguments.rig.of_use(&loaded)?;
    let dummy = dummy::load(arguments, &loaded)?;
    let noticed = super::noticed::notes(&loaded);
    noticed.iter().for_each(|note| output::tell(note));
    let library = library();
    let progress = Progress::new();
    let stage = |words: &str| progress.stage(words);
    let (mut findings, missing) = match tables(&loaded)? {
        Some(tables) => {
            let found = diagnose_tables(&tables, &known, stage)
                .map_err(|error| BadInput(format!("{}: {error}", arguments.records.named())))?;
            (found.findings, found.missing)
        }
        None => {
            let options = Options {
                limits: arguments.rig.limits(),
                dummy,
            };
            let records = histories(&arguments.records.files, &loaded)?;
            let found = diagnose_with(&records, &options, stage)
                .with_context(|| format!("{}: {NO_JOINT}", arguments.records.named()))?;
            (found, None)
        }
    };
    findings.notes.extend(noticed);
    for (entry, loaded) in findings.records.iter_mut().zip(&loaded) {
        entry.2.clone_from(&loaded.sha256);
    }
    if missing.is_none() && library.is_none() {
        findings.notes.push(without_library(drive(&findings)));
    }
    let page = html::render(&findings, &pages(&findings))?;
    let diagnosis = serde_json::to_string_pretty(&json::render(&findings))?;
    let joint = match &missing {
        None => Some(write(&saved(&findings, &loaded, &known))),
        Some(why) => {
            output::tell(&format!(
                "neither joint.json nor joint.fmu is written: {why}"
            ));
            None
        }
    };
    let archive = match (&joint, library) {
        (Some(joint), Some(library)) => {
            let drive = drive(&findings);
            Some(Archive::new(joint, "joint.json", drive, &[library])?.bytes()?)
        }
        _ => None,
    };
    match arguments.json {
        true => output::print(&format!("{diagnosis}\n"))?,
        false => output::print(&text::render(&findings))?,
    }
    let mut files = vec![
        ("report.html", page.into_bytes()),
        ("diagnosis.json", diagnosis.into_bytes()),
    ];
    files.extend(joint.map(|text| ("joint.json", text.into_bytes())));
    let experiment = findings.outlook.experiment.as_ref();
    let experiment = experiment.filter(|experiment| !experiment.blocks.is_empty());
    files.extend(experiment.map(|e| (results::PROGRAM, results::program(e).into_bytes())));
    files.extend(archive.map(|bytes| ("joint.fmu", bytes)));
    results::write(&arguments.output, &files, stage)
}

/// What the exported joint is driven by: the channel that was prescribed here.
fn drive(findings: &Findings) -> Drive {
    match findings.judged.as_str() {
        "force" => Drive::Displacement,
        _ => Drive::Force,
    }
}

/// The library for this machine; told and done without where there is none.
fn library() -> Option<Library> {
    Library::of_this_machine(FmiVersion::Two)
        .map_err(|error| output::tell(&format!("joint.fmu will not be written: {error}")))
        .ok()
}

/// What the findings say of a joint.fmu that is not there.
fn without_library(drive: Drive) -> String {
    let drive = match drive {
        Drive::Force => "",
        Drive::Displacement => " --drive displacement",
    };
    format!(
        "joint.fmu was not written, for want of a shared library of this program. With the one that `{BUILD_COMMAND}` \
         leaves in the source folder, `iwan export joint.json -o joint.fmu{drive} --binary PLATFORM=FILE` makes it."
    )
}

/// The amplitude tables, where the files are all tables; `None` where none is.
fn tables(loaded: &[Loaded]) -> Result<Option<Vec<AmplitudeTable>>, BadInput> {
    let tables: Vec<AmplitudeTable> = loaded
        .iter()
        .filter_map(|loaded| loaded.measurement.table().cloned())
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
const FEWEST: Fewest = Fewest::Each(64);

fn histories(files: &[PathBuf], loaded: &[Loaded]) -> Result<Vec<Record>, BadInput> {
    let refuse = |file: &Path, why: &str| Err(BadInput(format!("{}: {why}", file.display())));
    files
        .iter()
        .zip(loaded)
        .map(|(file, loaded)| match &loaded.measurement {
            Measurement::History(record) if flat(&record.force) => {
                refuse(file, "the force never changes: a joint needs one that does")
            }
            Measurement::History(record) if flat(&record.displacement) => refuse(
                file,
                "the displacement never changes: a joint needs one that does",
            ),
            Measurement::History(record) => Ok(record.clone()),
            Measurement::Amplitudes(_) => {
                refuse(file, "this is an amplitude table, no time history")
            }
        })
        .collect()
}

fn flat(channel: &[f64]) -> bool {
    channel.windows(2).all(|pair| pair[0] == pair[1])
}

fn saved(findings: &Findings, loaded: &[Loaded], known: &Known) -> SavedJoint {
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
            ..provenance(loaded, known, "diagnose")
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
