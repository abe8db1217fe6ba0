//! A measurement as values. SI units.

mod blended;
pub mod calm;
pub mod colour;
pub mod cut;
pub mod cycles;
pub mod evened;
pub mod jolts;
pub mod jumps;
pub mod mains;
pub mod noise;
pub mod outliers;
pub mod peaks;
pub mod ramps;
pub mod repeats;
pub mod resolution;
pub mod ringing;
mod rounded;
mod spectrum;
pub mod split;
pub mod thinned;
pub mod wandering;
mod white_and_slow;
pub mod written;

/// Force and displacement of one test.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Record {
    /// Name to show: the file's stem.
    pub name: String,
    /// Time \[s\], strictly increasing; `None` where the file has none.
    pub time: Option<Vec<f64>>,
    /// Force \[N\].
    pub force: Vec<f64>,
    /// Displacement \[m\].
    pub displacement: Vec<f64>,
    /// Preload \[N\], where measured.
    pub preload: Option<Vec<f64>>,
    /// Temperature \[K or °C as given\], where measured.
    pub temperature: Option<Vec<f64>>,
    /// Acceleration \[m/s²\], where measured.
    pub acceleration: Option<Vec<f64>>,
    /// True where the driving channel goes straight from sample to sample and turns at samples alone, as one does that
    /// a program made; false of a measured one, whose tips fall between them.
    pub straight: bool,
    /// True where the driving channel was drawn by its ramps: it turns where they meet.
    pub drawn: bool,
    /// True where noise of the driving channel shows in what a model leaves.
    pub noisy_drive: bool,
    /// True where the driving channel was read anew without noise that its joint did not feel, as far as that could be told.
    pub calmed: bool,
    /// Samples, in order, that stood alone in a channel and were replaced by what their neighbours say: no witnesses.
    pub alone: Vec<usize>,
}

impl Record {
    /// Count of samples.
    pub fn len(&self) -> usize {
        self.force.len()
    }
    /// True where there is no sample.
    pub fn is_empty(&self) -> bool {
        self.force.is_empty()
    }
    /// Time \[s\], or the sample number where the record has none.
    pub fn clock(&self) -> Vec<f64> {
        match &self.time {
            Some(time) => time.clone(),
            None => (0..self.len()).map(|i| i as f64).collect(),
        }
    }
}

/// What many laboratories keep: one row per load level, no time histories.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct AmplitudeTable {
    /// Name to show: the file's stem.
    pub name: String,
    /// F_0 \[N\].
    pub force_amplitude: Vec<f64>,
    /// Dissipation per cycle \[J\].
    pub dissipation: Vec<f64>,
    /// U_0 \[m\], where measured.
    pub displacement_amplitude: Option<Vec<f64>>,
    /// Frequency \[Hz\], where measured.
    pub frequency: Option<Vec<f64>>,
}

/// What a file can hold.
#[derive(Debug, Clone, PartialEq)]
pub enum Measurement {
    /// A time history.
    History(Record),
    /// An amplitude table.
    Amplitudes(AmplitudeTable),
}

impl Measurement {
    /// The time history, where it is one.
    pub fn history(&self) -> Option<&Record> {
        match self {
            Measurement::History(record) => Some(record),
            Measurement::Amplitudes(_) => None,
        }
    }

    /// The amplitude table, where it is one.
    pub fn table(&self) -> Option<&AmplitudeTable> {
        match self {
            Measurement::Amplitudes(table) => Some(table),
            Measurement::History(_) => None,
        }
    }
}
