//! Diagnosis of amplitude tables: all that many laboratories keep of a joint.
//!
//! Any Masing joint has, at a level of amplitude X, the loss `Σ 4 w d (X − d)₊` and the secant
//! stiffness `w_0 + Σ w min(1, d/X)`: both are linear in its sliders, so that one non-negative least
//! squares problem asks whether any joint at all has the columns of the table.

mod compared;
mod effects;
mod evidence;
mod exported;
mod held_out;
mod levels;
mod model;
mod scatter;
mod words;

pub use levels::TableError;

use super::experiment::Outlook;
use super::findings::{
    Candidate, Errors, Estimate, Findings, NamedCause, NoiseFinding, RecordCurves, Unexplained,
    Verdict,
};
use crate::identify::table::Known;
use crate::joint::{Joint, JointError};
use crate::record::AmplitudeTable;
use compared::compared;
use effects::Shown;
use evidence::{Thresholds, simulate, thresholds, trials};
use held_out::{Unseen, against, errors, ratio, unseen};
use levels::Levels;
use model::{Model, fit};
use rayon::prelude::*;
use scatter::{Scatter, scatter};

/// What the diagnosis of tables found.
#[derive(Debug, Clone, PartialEq)]
pub struct TableFindings {
    /// The findings, by the schema of every diagnosis; its joint is the slipping part alone where
    /// the table determines no more.
    pub findings: Findings,
    /// What is missing for a joint that can be exported.
    pub missing: Option<String>,
}

/// Why tables have no diagnosis.
#[derive(Debug, thiserror::Error)]
pub enum TableDiagnosisError {
    /// The tables.
    #[error(transparent)]
    Table(#[from] TableError),
    /// No joint comes of them.
    #[error(transparent)]
    Joint(#[from] JointError),
}

/// Effects named at most: more unknowns than that no table carries.
const MOST_NAMED: usize = 2;
/// A rival that leaves less than so many times what the best leaves is not told apart from it: the
/// 95 % quantile of a ratio of variances with eight degrees of freedom each.
const CLOSE: f64 = 3.4;
/// Error on levels left out, in units of the noise, up to which a model may claim to leave noise only.
const NOISE_ONLY: f64 = 3.0;
/// Refits of simulated tables for the intervals.
const REFITS: u64 = 100;

/// Diagnoses the amplitude tables of one joint.
///
/// # Errors
/// [`TableDiagnosisError`]. Checked in tests/amplitude_tables.rs on tables of closed forms and, where
/// it is at hand, on the bolted beam's.
pub fn diagnose_tables(
    tables: &[AmplitudeTable],
    known: &Known,
    mut progress: impl FnMut(&str),
) -> Result<TableFindings, TableDiagnosisError> {
    let levels = Levels::of(tables, known)?;
    let noise = scatter(&levels);
    let kept = vec![true; levels.rows.len()];
    progress("the best joint of any density");
    let baseline = fit(&levels, &noise, &[], &kept);
    progress("what chance alone would do to such a table");
    let limits = thresholds(&levels, &noise, &baseline);
    progress("effects beside it, and levels left out");
    let search = Search::run(&levels, &noise, &limits, &baseline);
    let joint = exported::joint(&levels, &search.model, known)?;
    let missing = exported::missing(&levels, known);
    let findings = search.findings(tables, &limits, &baseline, joint, missing.as_ref());
    Ok(TableFindings { findings, missing })
}

/// What the search found.
struct Search<'a> {
    levels: &'a Levels,
    noise: &'a Scatter,
    named: Vec<(Shown, Vec<String>, f64)>,
    model: Model,
    candidates: Vec<Candidate>,
    before: Vec<Unseen>,
    after: Vec<Unseen>,
    /// True where an effect is seen, even if it is not named.
    something: bool,
}

impl<'a> Search<'a> {
    /// Forward selection: an effect is named where its fall of the misfit is beyond what chance gives
    /// and where it predicts the levels left out better.
    fn run(
        levels: &'a Levels,
        noise: &'a Scatter,
        limits: &Thresholds,
        baseline: &Model,
    ) -> Search<'a> {
        let before = unseen(levels, noise, &[]);
        let mut search = Search {
            levels,
            noise,
            named: Vec::new(),
            model: baseline.clone(),
            candidates: Vec::new(),
            after: before.clone(),
            before,
            something: false,
        };
        while search.named.len() < MOST_NAMED {
            let effects: Vec<Shown> = search.named.iter().map(|(shown, ..)| *shown).collect();
            let tried = trials(levels, noise, &effects, &search.model);
            if effects.is_empty() {
                search.candidates = search.scored(&tried);
            }
            let seen = |best: &&evidence::Trial| best.share() > limits.share;
            let Some(best) = tried.first().filter(seen) else {
                break;
            };
            search.something = true;
            let together: Vec<Shown> = effects.iter().copied().chain([best.shown]).collect();
            let after = unseen(levels, noise, &together);
            if ratio(&search.after, &after)
                .1
                .is_none_or(|(_, upper)| upper >= 1.0)
            {
                break;
            }
            let rivals = tried[1..]
                .iter()
                .filter(|other| other.model.misfit < CLOSE * (best.model.misfit + 1.0));
            let rivals = rivals.map(|other| other.shown.name().to_string()).collect();
            search.named.push((best.shown, rivals, best.fall));
            search.model = best.model.clone();
            search.after = after;
        }
        search
    }

    fn scored(&self, tried: &[evidence::Trial]) -> Vec<Candidate> {
        let count = self.levels.rows.len() as f64;
        let penalised = |t: &evidence::Trial| 0.5 * (t.fall - t.shown.unknowns() * count.ln());
        let highest = tried.iter().map(penalised).fold(0.0, f64::max);
        let total: f64 = (-highest).exp()
            + tried
                .iter()
                .map(|t| (penalised(t) - highest).exp())
                .sum::<f64>();
        let trial_of = |name: &str| tried.iter().find(|t| t.shown.name() == name);
        crate::causes::CATALOGUE
            .iter()
            .map(|cause| {
                let trial = trial_of(cause.name());
                let evidence = trial.map_or(0.0, penalised);
                Candidate {
                    name: cause.name().to_string(),
                    kind: super::catalogue::kind(cause.name()),
                    evidence,
                    probability: trial.map_or(0.0, |_| (evidence - highest).exp() / total),
                    lambda_sep: None,
                    held_out_gain: trial.filter(|_| evidence > 0.0).map(|t| {
                        ratio(&self.before, &unseen(self.levels, self.noise, &[t.shown])).0
                    }),
                }
            })
            .collect()
    }

    fn seen(&self, model: &Model) -> Vec<Unseen> {
        (0..self.levels.rows.len())
            .map(|row| {
                let predicted = model.predict(&self.levels.rows[row], self.levels);
                against(self.levels, row, &predicted, self.noise)
            })
            .collect()
    }

    fn stiffness(&self) -> f64 {
        self.model.elastic + self.model.weight.iter().sum::<f64>()
    }

    fn causes(&self) -> Vec<NamedCause> {
        let effects: Vec<Shown> = self.named.iter().map(|(shown, ..)| *shown).collect();
        let kept = vec![true; self.levels.rows.len()];
        let refits: Vec<Model> = (0..REFITS)
            .into_par_iter()
            .filter(|_| !effects.is_empty())
            .map(|seed| {
                let table = simulate(self.levels, self.noise, &self.model, seed);
                fit(&table, self.noise, &effects, &kept)
            })
            .collect();
        let loss = |model: &Model| {
            let rows = self.levels.rows.iter();
            rows.map(|row| model.predict(row, self.levels).loss)
                .sum::<f64>()
        };
        let whole = loss(&self.model);
        let each = self.named.iter().zip(&self.model.effects).enumerate();
        each.map(|(index, ((shown, rivals, fall), (_, size)))| {
            let mut without = self.model.clone();
            without.effects.remove(index);
            let total = |m: &Model| m.elastic + m.weight.iter().sum::<f64>();
            let values = exported::parameters(*shown, *size, self.stiffness());
            let spread: Vec<Vec<f64>> = refits
                .iter()
                .map(|m| exported::parameters(*shown, m.effects[index].1, total(m)))
                .collect();
            NamedCause {
                name: shown.name().to_string(),
                kind: super::catalogue::kind(shown.name()),
                parameters: exported::estimates(*shown, &values, &spread),
                absent: super::catalogue::absent(exported::glossary(*shown), &values),
                ambiguous_with: rivals.clone(),
                evidence: *fall,
                matters: (1.0 - loss(&without) / whole).abs(),
            }
        })
        .collect()
    }

    fn verdict(&self, limits: &Thresholds, baseline: &Model) -> Verdict {
        let named = !self.named.is_empty();
        let predicts = errors(&[], &self.after).held_out_rms <= NOISE_ONLY;
        if named && self.model.misfit <= limits.misfit && predicts {
            Verdict::Explained
        } else if named {
            Verdict::PartlyExplained
        } else if baseline.misfit <= limits.misfit && !self.something {
            Verdict::Clean
        } else {
            Verdict::Unexplained
        }
    }

    fn findings(
        &self,
        tables: &[AmplitudeTable],
        limits: &Thresholds,
        baseline: &Model,
        joint: Joint,
        missing: Option<&String>,
    ) -> Findings {
        let verdict = self.verdict(limits, baseline);
        let causes = self.causes();
        let gain = match causes.is_empty() {
            true => (1.0, None),
            false => ratio(&self.before, &self.after),
        };
        let residuals: f64 = self.before.iter().map(|u| u.count).sum();
        let rows = residuals / self.before.len().max(1) as f64 * self.levels.rows.len() as f64;
        let (before, after) = (
            errors(&self.seen(baseline), &self.before),
            errors(&self.seen(&self.model), &self.after),
        );
        // What noise alone gives is no misfit: 1 in units of the noise.
        let beyond = |errors: &Errors| (errors.held_out_rms.powi(2) - 1.0).max(0.0);
        let stiffness = Estimate {
            name: "initial_stiffness".to_string(),
            value: joint.initial_stiffness(),
            unit: "N/m".to_string(),
            interval: None,
        };
        Findings {
            verdict,
            summary: words::summary(verdict, &causes, gain.0, self.levels),
            judged: words::judged(self.levels),
            unit: "1".to_string(),
            records: tables
                .iter()
                .map(|table| (table.name.clone(), table.dissipation.len(), String::new()))
                .collect(),
            // Levels of a table have no time.
            held_out: vec![Vec::new(); tables.len()],
            candidates: self.candidates.clone(),
            noise: NoiseFinding {
                rms: 1.0,
                unit: "1".to_string(),
                autoregression: 0.0,
                method: words::method(self.levels, self.noise),
                effective_samples: rows,
            },
            baseline: before.clone(),
            extended: after.clone(),
            gain,
            levels: compared(self.levels, tables, baseline, &self.model),
            left_out: Vec::new(),
            unexplained: Unexplained {
                doubles: Vec::new(),
                share: match verdict {
                    Verdict::Clean => 0.0,
                    _ if beyond(&before) > 0.0 => (beyond(&after) / beyond(&before)).min(1.0),
                    _ => 0.0,
                },
                places: match verdict {
                    Verdict::Clean | Verdict::Explained => Vec::new(),
                    _ => words::places(self.levels, &self.after),
                },
            },
            not_identifiable: words::not_identifiable(self.levels, missing),
            next_experiment: words::next_experiment(verdict, &causes, self.levels),
            joint_parameters: if missing.is_none() {
                vec![stiffness]
            } else {
                Vec::new()
            },
            notes: words::notes(self.levels, baseline, &self.before, limits),
            joint,
            curves: self.curves(tables, baseline),
            causes,
            outlook: Outlook::default(),
        }
    }

    /// Loss per level in the place of energy per cycle; a table has no other curves.
    fn curves(&self, tables: &[AmplitudeTable], baseline: &Model) -> Vec<RecordCurves> {
        let of_table = |index: usize, table: &AmplitudeTable| RecordCurves {
            name: table.name.clone(),
            cycles: self
                .levels
                .rows
                .iter()
                .filter(|row| row.table == index)
                .map(|row| {
                    let loss = |model: &Model| model.predict(row, self.levels).loss;
                    [row.amplitude, row.loss, loss(baseline), loss(&self.model)]
                })
                .collect(),
            ..RecordCurves::default()
        };
        tables
            .iter()
            .enumerate()
            .map(|(index, table)| of_table(index, table))
            .collect()
    }
}
