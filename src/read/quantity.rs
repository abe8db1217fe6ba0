//! What a column can hold, and the names under which rigs write it.

use super::number;
use super::unit::{self, Dimension};

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Time \[s\].
    Time,
    /// Force \[N\].
    Force,
    /// Displacement \[m\].
    Displacement,
    /// Bolt preload \[N\].
    Preload,
    /// Temperature \[K or °C\].
    Temperature,
    /// Acceleration \[m/s²\].
    Acceleration,
    /// F_0 of an amplitude table \[N\].
    ForceAmplitude,
    /// U_0 of an amplitude table \[m\].
    DisplacementAmplitude,
    /// Dissipation per cycle \[J\].
    Dissipation,
    /// Frequency \[Hz\].
    Frequency,
}

use Quantity::{
    Acceleration, Displacement, DisplacementAmplitude, Dissipation, Force, ForceAmplitude,
    Frequency, Preload, Temperature, Time,
};

impl Quantity {
    /// Every quantity; where one letter names several, the first that the unit fits is meant.
    pub const ALL: [Quantity; 10] = [
        Time,
        Force,
        Displacement,
        Preload,
        Temperature,
        Acceleration,
        ForceAmplitude,
        DisplacementAmplitude,
        Dissipation,
        Frequency,
    ];

    /// The name of the contract, then every other name that is understood.
    pub fn names(self) -> &'static [&'static str] {
        match self {
            Time => &[
                "time",
                "t",
                "elapsed time",
                "total time",
                "running time",
                "test time",
            ],
            Force => &[
                "force",
                "f",
                "load",
                "axial force",
                "axial load",
                "load cell",
            ],
            Displacement => &[
                "displacement",
                "disp",
                "displ",
                "u",
                "x",
                "d",
                "relative displacement",
                "axial displacement",
                "deflection",
                "deformation",
                "extension",
                "position",
                "stroke",
            ],
            Preload => &[
                "preload",
                "bolt force",
                "bolt load",
                "bolt tension",
                "clamp force",
            ],
            Temperature => &["temperature", "temp", "t"],
            Acceleration => &["acceleration", "acc", "accel", "a"],
            ForceAmplitude => &["force amplitude", "load amplitude", "force amp", "f0"],
            DisplacementAmplitude => &[
                "displacement amplitude",
                "disp amplitude",
                "displacement amp",
                "disp amp",
                "u0",
                "x0",
            ],
            Dissipation => &[
                "dissipation",
                "dissipation per cycle",
                "dissipated energy",
                "energy dissipation",
                "energy per cycle",
                "d",
            ],
            Frequency => &["frequency", "freq", "f"],
        }
    }

    /// The name of the contract.
    pub fn name(self) -> &'static str {
        self.names()[0]
    }

    /// True for what is read and not used: a record is as good without.
    pub fn is_spare(self) -> bool {
        matches!(self, Temperature | Acceleration)
    }

    /// Its name as an option of the command line takes it, without spaces.
    pub fn option(self) -> String {
        self.name().replace(' ', "_")
    }

    /// What its units measure.
    pub fn dimension(self) -> Dimension {
        match self {
            Time => Dimension::Time,
            Force | Preload | ForceAmplitude => Dimension::Force,
            Displacement | DisplacementAmplitude => Dimension::Length,
            Temperature => Dimension::Temperature,
            Acceleration => Dimension::Acceleration,
            Dissipation => Dimension::Energy,
            Frequency => Dimension::Frequency,
        }
    }

    /// A unit to show in messages.
    pub fn example_unit(self) -> &'static str {
        match self.dimension() {
            Dimension::Time => "s",
            Dimension::Force => "N",
            Dimension::Length => "mm",
            Dimension::Frequency => "Hz",
            Dimension::Energy => "J",
            Dimension::Acceleration => "m/s^2",
            Dimension::Temperature => "degC",
        }
    }

    /// True where no value can be below zero.
    pub fn never_negative(self) -> bool {
        matches!(
            self,
            ForceAmplitude | DisplacementAmplitude | Dissipation | Frequency
        )
    }

    /// The quantity a name means; of several, the first whose dimension the unit fits.
    pub fn named(name: &str, written_unit: Option<&str>) -> Option<Quantity> {
        let plain = plain(name);
        let mut meant = Quantity::ALL
            .into_iter()
            .filter(|q| q.names().contains(&plain.as_str()));
        let first = meant.next()?;
        let fits =
            |q: &Quantity| written_unit.is_some_and(|u| unit::find(u, q.dimension()).is_some());
        if fits(&first) {
            Some(first)
        } else {
            Some(meant.find(fits).unwrap_or(first))
        }
    }
}

impl std::fmt::Display for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

/// Lower case, underscores and runs of space as one space.
pub fn plain(name: &str) -> String {
    let spaced = name.to_lowercase().replace(['_', '-', '\u{a0}'], " ");
    spaced.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A header cell taken apart: `Force (kN)` is `Force` and `kN`.
pub fn name_and_unit(cell: &str) -> (&str, Option<&str>) {
    let cell = number::bare(cell);
    for (open, close) in [('[', ']'), ('(', ')'), ('{', '}')] {
        if let (Some(start), true) = (cell.find(open), cell.ends_with(close)) {
            let unit = cell[start + 1..cell.len() - 1].trim();
            return (cell[..start].trim(), (!unit.is_empty()).then_some(unit));
        }
    }
    (cell, None)
}
