//! What a diagnosis found: one value from which text, HTML, JSON and plots are made.

use super::experiment::Outlook;
use super::left_out::LeftOut;
use super::levels::Level;
use crate::joint::Joint;

/// The verdict, by what is left after the best set of causes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// The baseline explains the record to the noise.
    Clean,
    /// With the named causes only noise is left.
    Explained,
    /// The named causes help, and structure beyond the noise remains.
    PartlyExplained,
    /// Structure beyond noise that nothing in the catalogue predicts out of sample.
    Unexplained,
}

impl Verdict {
    /// Identifier of the schema.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Clean => "clean",
            Verdict::Explained => "explained",
            Verdict::PartlyExplained => "partly_explained",
            Verdict::Unexplained => "unexplained",
        }
    }
}

/// An estimated number with its interval (95 %).
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Glossary name.
    pub name: String,
    /// Best value, SI.
    pub value: f64,
    /// SI unit.
    pub unit: String,
    /// Lower and upper bound; `None` where the data do not bound it.
    pub interval: Option<(f64, f64)>,
}

/// A cause that is named.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedCause {
    /// Catalogue name.
    pub name: String,
    /// `joint` or `measurement`.
    pub kind: String,
    /// Its parameters.
    pub parameters: Vec<Estimate>,
    /// Those of its parameters that are refinements which the data do not ask for: they have the value at
    /// which they are absent.
    pub absent: Vec<String>,
    /// Names the data cannot tell from it.
    pub ambiguous_with: Vec<String>,
    /// Fall of the misfit, in noise variances, when this cause joins the others.
    pub evidence: f64,
    /// Share of the energy dissipated in all cycles that the cause changes.
    pub matters: f64,
}

impl NamedCause {
    /// Its parameters without refinements that the data do not ask for.
    pub fn present(&self) -> Vec<Estimate> {
        let present = |p: &&Estimate| !self.absent.contains(&p.name);
        self.parameters.iter().filter(present).cloned().collect()
    }
}

/// One line of the catalogue's scores.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Catalogue name.
    pub name: String,
    /// `joint` or `measurement`.
    pub kind: String,
    /// Log evidence against the baseline (penalised, whitened).
    pub evidence: f64,
    /// Posterior probability among the catalogue and none.
    pub probability: f64,
    /// Least χ² any rival leaves on this cause's own prediction; `None` where not computed.
    pub lambda_sep: Option<f64>,
    /// held-out rms with this cause over held-out rms of the baseline; `None` where not computed.
    pub held_out_gain: Option<f64>,
}

/// Errors of one model, in the judged channel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Errors {
    /// On the data that were fitted.
    pub train_rms: f64,
    /// On data that no fit has seen.
    pub held_out_rms: f64,
    /// Its 95 % interval, by a bootstrap over whole held-out cycles, like the others below.
    pub held_out_interval: Option<(f64, f64)>,
    /// Mean relative error of the energy per cycle, held out.
    pub dissipation_error: Option<f64>,
    /// Its interval.
    pub dissipation_interval: Option<(f64, f64)>,
    /// Mean relative error of the stiffness (slope of the loop), held out.
    pub stiffness_error: Option<f64>,
    /// Its interval.
    pub stiffness_interval: Option<(f64, f64)>,
}

/// The noise of the judged channel, estimated without a model where cycles repeat.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NoiseFinding {
    /// Standard deviation.
    pub rms: f64,
    /// Unit, `m` or `N`.
    pub unit: String,
    /// Correlation of neighbouring samples.
    pub autoregression: f64,
    /// How it was estimated, in words.
    pub method: String,
    /// Effective count of independent samples.
    pub effective_samples: f64,
}

/// Curves of one record, for plots: everything in SI, one number per sample.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecordCurves {
    /// Name of the record.
    pub name: String,
    /// Time [s] or sample number.
    pub time: Vec<f64>,
    /// Measured force [N].
    pub force: Vec<f64>,
    /// Measured displacement [m].
    pub displacement: Vec<f64>,
    /// Judged channel as the baseline predicts it.
    pub baseline: Vec<f64>,
    /// Judged channel as the extended joint predicts it.
    pub extended: Vec<f64>,
    /// True where the sample was held out of every fit.
    pub held_out: Vec<bool>,
    /// Per cycle: (time, energy measured, energy baseline, energy extended) [s, J, J, J].
    pub cycles: Vec<[f64; 4]>,
}

/// What remains and where.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Unexplained {
    /// Share of the explainable misfit that is left, 0 … 1; of an explained record, beyond what noise may leave.
    pub share: f64,
    /// Places in words, e.g. `record bolt-2, cycles 14–20, just after reversals`.
    pub places: Vec<String>,
    /// What is not in the catalogue and may be there in place of a named cause, or where none is named, one clause
    /// each.
    pub doubles: Vec<String>,
}

/// Everything a diagnosis found.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// Verdict.
    pub verdict: Verdict,
    /// The verdict in a sentence or two.
    pub summary: String,
    /// Judged channel: `displacement` (force-driven form) or `force` (displacement-driven form).
    pub judged: String,
    /// Unit of the judged channel, `m` or `N`.
    pub unit: String,
    /// Records in order, with their sample counts and content hashes (SHA-256 hex).
    pub records: Vec<(String, usize, String)>,
    /// For each record the stretches that were held out, first and last time \[s\] (sample number
    /// where a record has no time).
    pub held_out: Vec<Vec<(f64, f64)>>,
    /// Named causes, in order of gain.
    pub causes: Vec<NamedCause>,
    /// Whole catalogue.
    pub candidates: Vec<Candidate>,
    /// Noise of the judged channel.
    pub noise: NoiseFinding,
    /// Baseline errors.
    pub baseline: Errors,
    /// Extended errors (equal to the baseline's where nothing is named).
    pub extended: Errors,
    /// held-out rms after over before, with its 95 % interval by block bootstrap.
    pub gain: (f64, Option<(f64, f64)>),
    /// Loss and stiffness per level of the load.
    pub levels: Vec<Level>,
    /// Records held out whole; empty for a single record.
    pub left_out: Vec<LeftOut>,
    /// What is left.
    pub unexplained: Unexplained,
    /// What this record cannot show, in sentences.
    pub not_identifiable: Vec<String>,
    /// What experiment would settle an ambiguity, in words; `None` where nothing is ambiguous.
    pub next_experiment: Option<String>,
    /// Parameters of the joint (seed and family), with intervals.
    pub joint_parameters: Vec<Estimate>,
    /// Notes on the way: assumptions, warnings.
    pub notes: Vec<String>,
    /// The extended joint, ready for export.
    pub joint: Joint,
    /// Curves for plots.
    pub curves: Vec<RecordCurves>,
    /// What lies beyond the verdict: separability, the next experiment, a correction.
    pub outlook: Outlook,
}
