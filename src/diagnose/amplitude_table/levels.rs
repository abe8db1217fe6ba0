//! The levels of an amplitude table as a diagnosis needs them: amplitude, loss, secant stiffness.

use crate::identify::seed::APART;
use crate::identify::table::{Known, at_resonance, own_force};
use crate::record::AmplitudeTable;
use std::f64::consts::TAU;

/// Over what the loss is laid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Displacement amplitude \[m\]: stop form, linear in the stiffnesses of the sliders.
    Displacement,
    /// Force amplitude \[N\]: play form, linear in the compliances; where no displacement is kept.
    Force,
}

/// One level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// U_0 \[m\] or F_0 \[N\].
    pub amplitude: f64,
    /// Loss per cycle \[J\].
    pub loss: f64,
    /// Secant stiffness F_0/U_0 \[N/m\]; per unit of modal mass where that is unknown \[1/s²\].
    pub stiffness: Option<f64>,
    /// Angular frequency \[rad/s\].
    pub rate: Option<f64>,
    /// Which table it is from.
    pub table: usize,
}

/// The levels of all tables of one joint, of rising amplitude.
#[derive(Debug, Clone, PartialEq)]
pub struct Levels {
    /// Over what the loss is laid.
    pub over: Over,
    /// The levels.
    pub rows: Vec<Level>,
    /// True where stiffness is that of the first harmonic (a resonance), false for peak over peak.
    pub harmonic: bool,
    /// True where stiffness is known up to the modal mass.
    pub mass_unknown: bool,
}

/// Why tables cannot be diagnosed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TableError {
    /// Too few levels.
    #[error(
        "the table has {levels} level(s) with a positive loss: a diagnosis takes at least {least}; give more amplitudes"
    )]
    TooFew {
        /// Usable ones.
        levels: usize,
        /// Fewest.
        least: usize,
    },
    /// Tables that hold different columns.
    #[error(
        "the tables hold different columns (`{name}` is unlike the first): diagnose them one by one"
    )]
    Unlike {
        /// The first one that differs.
        name: String,
    },
}

/// Fewest levels.
pub const FEWEST: usize = 5;

impl Levels {
    /// Takes tables apart; levels without a positive loss, amplitude or stiffness are left out.
    ///
    /// # Errors
    /// [`TableError`].
    pub fn of(tables: &[AmplitudeTable], known: &Known) -> Result<Levels, TableError> {
        let mut all: Option<Levels> = None;
        for (index, table) in tables.iter().enumerate() {
            let next = Levels::of_one(table, index, known);
            all = Some(match all {
                None => next,
                Some(mut all) if all.like(&next) => {
                    all.rows.extend(next.rows);
                    all
                }
                Some(_) => {
                    return Err(TableError::Unlike {
                        name: table.name.clone(),
                    });
                }
            });
        }
        let few = |levels: usize| TableError::TooFew {
            levels,
            least: FEWEST,
        };
        let mut all = all.ok_or_else(|| few(0))?;
        all.rows.sort_by(|a, b| a.amplitude.total_cmp(&b.amplitude));
        match all.apart().len() {
            levels if levels < FEWEST => Err(few(levels)),
            _ => Ok(all),
        }
    }

    /// The rows by level, those together that repeat one.
    pub fn apart(&self) -> Vec<&[Level]> {
        let mut first = self.rows.first().map_or(0.0, |row| row.amplitude);
        let repeats = |_: &Level, next: &Level| {
            let repeats = (next.amplitude / first).ln() <= APART;
            if !repeats {
                first = next.amplitude;
            }
            repeats
        };
        self.rows.chunk_by(repeats).collect()
    }

    fn like(&self, other: &Levels) -> bool {
        (self.over, self.harmonic, self.mass_unknown)
            == (other.over, other.harmonic, other.mass_unknown)
    }

    fn of_one(table: &AmplitudeTable, index: usize, known: &Known) -> Levels {
        let harmonic = at_resonance(table);
        let own = own_force(table, known);
        let mass_unknown = harmonic && own.is_none() && table.frequency.is_some();
        let force = own.as_ref().unwrap_or(table);
        let rows = (0..table.dissipation.len()).filter_map(|i| {
            let rate = table.frequency.as_ref().map(|hertz| TAU * hertz[i]);
            let displacement = table.displacement_amplitude.as_ref().map(|u| u[i]);
            let stiffness = match displacement {
                Some(_) if mass_unknown => rate.map(|rate| rate * rate),
                // without frequencies a resonance says nothing of how the stiffness changes
                Some(_) if harmonic && table.frequency.is_none() => None,
                Some(displacement) => Some(force.force_amplitude[i] / displacement),
                None => None,
            };
            let level = Level {
                amplitude: displacement.unwrap_or(table.force_amplitude[i]),
                loss: table.dissipation[i],
                stiffness,
                rate,
                table: index,
            };
            let sound = level.loss > 0.0
                && level.amplitude > 0.0
                && level.stiffness.is_none_or(|k| k > 0.0 && k.is_finite());
            sound.then_some(level)
        });
        Levels {
            over: match table.displacement_amplitude {
                Some(_) => Over::Displacement,
                None => Over::Force,
            },
            rows: rows.collect(),
            harmonic,
            mass_unknown,
        }
    }

    /// True where every level has a stiffness.
    pub fn has_stiffness(&self) -> bool {
        self.rows.iter().all(|row| row.stiffness.is_some())
    }

    /// True where every level has a frequency.
    pub fn has_rate(&self) -> bool {
        self.rows.iter().all(|row| row.rate.is_some())
    }

    /// Smallest and largest amplitude.
    pub fn range(&self) -> (f64, f64) {
        let first = self.rows.first().map_or(0.0, |row| row.amplitude);
        let last = self.rows.last().map_or(0.0, |row| row.amplitude);
        (first, last)
    }
}
