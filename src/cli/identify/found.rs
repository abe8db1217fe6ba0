//! Everything one identification found, for the report in text and in JSON.

use crate::identify::family::{self, FamilyFit, driven};
use crate::identify::interval::Estimated;
use crate::identify::problem::Problem;
use crate::identify::seed::{self, Seed};
use crate::identify::table::{self, Known};
use crate::identify::{Form, baseline};
use crate::joint::{Drive, FourParameter, Joint};
use crate::read::Loaded;
use crate::record::outliers::{stand_alone, struck_out};
use crate::record::{AmplitudeTable, Measurement, Record};

/// Result of the procedure and the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Found {
    /// Name and count of samples or levels of every file.
    pub files: Vec<(String, usize)>,
    /// Procedure over all time histories, or over the first table.
    pub seed: Seed,
    /// Procedure of the (further) amplitude tables, by name.
    pub tables: Vec<(String, Seed)>,
    /// The family fitted to the histories.
    pub fit: Option<FamilyFit>,
    /// rms that the best joint of any density leaves in the same channel.
    pub any_joint_rms: Option<f64>,
    /// The joint to write, or why there is none.
    pub joint: Result<Joint, String>,
    /// What is noticed.
    pub noticed: Vec<String>,
    /// What is not reached.
    pub not_identifiable: Vec<String>,
}

/// Why nothing was found.
#[derive(Debug, thiserror::Error)]
pub enum NothingFound {
    /// Too little of anything.
    #[error("{0}; give the whole test")]
    TooShort(family::FamilyError),
    /// The procedure refused.
    #[error(transparent)]
    Seed(#[from] seed::SeedError),
    /// The fit refused.
    #[error(transparent)]
    Family(family::FamilyError),
}

impl From<family::FamilyError> for NothingFound {
    fn from(error: family::FamilyError) -> NothingFound {
        match error {
            family::FamilyError::TooShort { .. } => NothingFound::TooShort(error),
            _ => NothingFound::Family(error),
        }
    }
}

/// Misfit of the family over that of any joint beyond which the family is said not to fit.
const WORSE: f64 = 1.1;
/// Misfit relative to the judged channel from which on the joint is no description.
const POOR: f64 = 0.3;
/// Misfit relative to the judged channel below which such a ratio means nothing: the dictionary's
/// own grid.
const GRID: f64 = 1e-5;

impl Found {
    /// Runs the procedure and the fit.
    pub fn from(loaded: &[Loaded], known: &Known) -> Result<Found, NothingFound> {
        let files = loaded.iter().map(|one| (name(one), samples(one))).collect();
        let histories: Vec<&Record> = loaded
            .iter()
            .filter_map(|one| one.measurement.history())
            .collect();
        let tables: Vec<&AmplitudeTable> = loaded
            .iter()
            .filter_map(|one| one.measurement.table())
            .collect();
        let mut tables: Vec<(String, Seed)> = tables
            .iter()
            .map(|one| Ok((one.name.clone(), table::seed(one, known)?)))
            .collect::<Result<_, seed::SeedError>>()?;
        let mut found = if histories.is_empty() && !tables.is_empty() {
            let (_, seed) = tables.remove(0);
            Found::of_seed(files, seed)
        } else {
            Found::of_histories(files, &histories)?
        };
        for (name, seed) in &tables {
            let of_table = |s: &String| format!("{name}: {s}");
            found.noticed.extend(seed.findings.iter().map(of_table));
            found
                .not_identifiable
                .extend(seed.not_identifiable.iter().map(of_table));
        }
        found.tables = tables;
        Ok(found)
    }

    fn of_seed(files: Vec<(String, usize)>, seed: Seed) -> Found {
        Found {
            files,
            joint: family::joint_of_law(&seed).map_err(|e| e.to_string()),
            noticed: seed.findings.clone(),
            not_identifiable: seed.not_identifiable.clone(),
            seed,
            tables: Vec::new(),
            fit: None,
            any_joint_rms: None,
        }
    }

    fn of_histories(
        files: Vec<(String, usize)>,
        records: &[&Record],
    ) -> Result<Found, NothingFound> {
        let struck: Vec<Record> = records.iter().map(|record| struck_out(record)).collect();
        let records: &[&Record] = &struck.iter().collect::<Vec<_>>();
        let seed = seed::of_records(records)?;
        let drive = family::drive_for(&seed);
        crate::cli::output::tell("fitting the family with the exact response …");
        let fit = family::fit(records, &seed, drive)?;
        crate::cli::output::tell("fitting a joint of any density …");
        let any_joint_rms = any_joint(records, drive);
        let mut noticed = seed.findings.clone();
        let alone = struck.iter().filter(|record| !record.alone.is_empty());
        noticed.extend(alone.map(|record| {
            let Record { name, alone, .. } = record;
            stand_alone(name, alone.len(), record.len())
        }));
        if fit.relative_rms > POOR {
            noticed.push(format!(
                "The fitted joint leaves {:.0} % of the judged channel: it does not describe these \
                 records.",
                100.0 * fit.relative_rms
            ));
        }
        if let Some(any) = any_joint_rms
            && fit.rms > WORSE * any
            && fit.relative_rms > GRID
        {
            noticed.push(format!(
                "The family leaves {:.2} times the misfit of the best joint of any density: its \
                 shape is not that of this joint; simulations near the loads of these records are \
                 better with `iwan diagnose`, whose joint is not bound to a family.",
                fit.rms / any
            ));
        }
        // The fit knows more of the joint than the procedure: of what both speak, it is heard.
        let mut not_identifiable: Vec<String> = fit.not_identifiable.clone();
        not_identifiable.extend(
            seed.not_identifiable
                .iter()
                .filter(|s| !s.contains("K_1 and K_T") && !s.starts_with("Full slip"))
                .cloned(),
        );
        Ok(Found {
            files,
            joint: Ok(fit.joint.clone()),
            noticed,
            not_identifiable,
            seed,
            tables: Vec::new(),
            fit: Some(fit),
            any_joint_rms,
        })
    }

    /// The numbers of the joint: the fit's, or without one the procedure's; no interval reaches beyond the glossary.
    pub fn estimates(&self) -> Vec<Estimated> {
        let estimates: Vec<Estimated> = match &self.fit {
            Some(fit) => fit.estimates.clone(),
            None => self
                .seed
                .stiffness
                .iter()
                .map(|s| s.series.clone())
                .chain(
                    self.seed
                        .dissipation
                        .iter()
                        .flat_map(|law| [law.coefficient.clone(), law.exponent.clone()]),
                )
                .collect(),
        };
        let admitted = |e: Estimated| e.within(FourParameter::PARAMETERS);
        estimates.into_iter().map(admitted).collect()
    }
}

/// rms of the convex dictionary fit, in the judged channel.
fn any_joint(records: &[&Record], drive: Drive) -> Option<f64> {
    let form = match drive {
        Drive::Force => Form::Play,
        Drive::Displacement => Form::Stop,
    };
    let mut owned: Vec<Record> = records.iter().map(|&r| r.clone()).collect();
    if drive == Drive::Displacement {
        for record in &mut owned {
            record.displacement = driven(record, drive).into_owned();
        }
    }
    let count: usize = owned.iter().map(Record::len).sum();
    let fit = baseline(&Problem::new(form, &owned));
    (count > 0).then(|| (fit.misfit / count as f64).sqrt())
}

/// The file's stem.
pub fn name(loaded: &Loaded) -> String {
    match &loaded.measurement {
        Measurement::History(record) => record.name.clone(),
        Measurement::Amplitudes(table) => table.name.clone(),
    }
}

/// Count of samples, or of levels of a table.
pub fn samples(loaded: &Loaded) -> usize {
    match &loaded.measurement {
        Measurement::History(record) => record.len(),
        Measurement::Amplitudes(table) => table.force_amplitude.len(),
    }
}
