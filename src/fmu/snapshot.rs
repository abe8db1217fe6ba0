//! The complete state of an instance, as values and as bytes.
//!
//! ```text
//! offset  bytes            little-endian
//!      0  8                "IWANFMU\0"
//!      8  4                version of this layout
//!     12  8                length of the whole
//!     20  36               GUID of joint and drive
//!     56  1                mode
//!     57  1                bit 0: stop time given; bit 1: the joint moves
//!     58  8 × 14           time, stop time, input, its derivatives 1 to 3, dissipation rate,
//!                          length of the last step, rates of force, displacement, slip,
//!                          dissipation, dissipation rate and stored energy
//!    170  8 + 8 n          parameters, with their count
//!      …  8 + 8 m          state of the simulation, with its count
//! ```

use super::calls::Mode;
use super::derivatives::Rates;

const MAGIC: [u8; 8] = *b"IWANFMU\0";
const VERSION: u32 = 2;
/// Numbers before the parameters.
const NUMBERS: usize = 14;
const GUID_LENGTH: usize = 36;

/// Why bytes are no state of this joint.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SnapshotError {
    /// Not our bytes at all.
    #[error("serializedState: expected a state of IwanJoint, came other bytes")]
    Foreign,
    /// Bytes of another version.
    #[error("serializedState: expected layout version {VERSION}, came {came}")]
    Version {
        /// Version in the bytes.
        came: u32,
    },
    /// Cut short or too long.
    #[error("serializedState: expected {expected} bytes, came {came}")]
    Length {
        /// Length that the bytes announce.
        expected: u64,
        /// Length that came.
        came: u64,
    },
    /// A field that cannot be.
    #[error("serializedState: {field} is damaged")]
    Damaged {
        /// Which field.
        field: &'static str,
    },
    /// A state of another joint or drive.
    #[error("state: expected one of joint {expected}, came one of joint {came}")]
    OtherJoint {
        /// GUID of the instance.
        expected: String,
        /// GUID in the state.
        came: String,
    },
    /// Another count of parameters, though the joint is the same.
    #[error("state: expected {expected} parameters, came {came}")]
    Parameters {
        /// Parameters of the instance.
        expected: usize,
        /// Parameters in the state.
        came: usize,
    },
}

/// The complete state of an instance.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// GUID of joint and drive.
    pub guid: String,
    /// Place in the call order.
    pub mode: Mode,
    /// Communication point \[s\].
    pub time: f64,
    /// End of the experiment \[s\].
    pub stop: Option<f64>,
    /// Input as last set.
    pub input: f64,
    /// Its derivatives.
    pub derivatives: [f64; 3],
    /// Mean power over the last step \[W\].
    pub dissipation_rate: f64,
    /// Length of the last step \[s\].
    pub step: f64,
    /// Time derivatives at its end.
    pub rates: Rates,
    /// Parameters in the order of the variables.
    pub parameters: Vec<f64>,
    /// State of the simulation, where the joint moves.
    pub simulation: Option<Vec<f64>>,
}

impl Snapshot {
    /// Count of bytes of [`Snapshot::to_bytes`]; it grows with the turning points in memory.
    pub fn length(&self) -> usize {
        let numbers = self.parameters.len() + self.simulation.as_ref().map_or(0, Vec::len);
        MAGIC.len() + 4 + 8 + GUID_LENGTH + 2 + 8 * NUMBERS + 8 + 8 + 8 * numbers
    }

    /// The state as bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.length());
        bytes.extend(MAGIC);
        bytes.extend(VERSION.to_le_bytes());
        bytes.extend((self.length() as u64).to_le_bytes());
        bytes.extend(self.guid.as_bytes());
        bytes.push(self.mode as u8);
        bytes.push(u8::from(self.stop.is_some()) | u8::from(self.simulation.is_some()) << 1);
        let [first, second, third] = self.derivatives;
        let stop = self.stop.unwrap_or_default();
        let rates = &self.rates;
        let numbers: [f64; NUMBERS] = [
            self.time,
            stop,
            self.input,
            first,
            second,
            third,
            self.dissipation_rate,
            self.step,
            rates.force,
            rates.displacement,
            rates.slip_displacement,
            rates.dissipation,
            rates.dissipation_rate,
            rates.stored_energy,
        ];
        for number in numbers {
            bytes.extend(number.to_le_bytes());
        }
        for numbers in [
            &self.parameters[..],
            self.simulation.as_deref().unwrap_or_default(),
        ] {
            bytes.extend((numbers.len() as u64).to_le_bytes());
            bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        }
        bytes
    }

    /// The state of these bytes.
    ///
    /// # Errors
    /// Other bytes, another version, another length than announced, damaged fields.
    pub fn from_bytes(bytes: &[u8]) -> Result<Snapshot, SnapshotError> {
        let mut reader = Reader(bytes);
        if reader
            .take("magic")
            .is_ok_and(|magic: [u8; 8]| magic != MAGIC)
            || bytes.len() < 8
        {
            return Err(SnapshotError::Foreign);
        }
        let version = u32::from_le_bytes(reader.take("version")?);
        if version != VERSION {
            return Err(SnapshotError::Version { came: version });
        }
        let expected = u64::from_le_bytes(reader.take("length")?);
        if expected != bytes.len() as u64 {
            return Err(SnapshotError::Length {
                expected,
                came: bytes.len() as u64,
            });
        }
        let guid: [u8; GUID_LENGTH] = reader.take("GUID")?;
        let guid = String::from_utf8(guid.to_vec())
            .map_err(|_| SnapshotError::Damaged { field: "GUID" })?;
        let [mode, flags] = reader.take("mode")?;
        let mode = Mode::from_number(mode).ok_or(SnapshotError::Damaged { field: "mode" })?;
        if flags > 0b11 {
            return Err(SnapshotError::Damaged { field: "flags" });
        }
        let time = reader.finite("time")?;
        let stop = reader.finite("stop time")?;
        let input = reader.finite("input")?;
        let derivatives = [
            reader.finite("derivatives")?,
            reader.finite("derivatives")?,
            reader.finite("derivatives")?,
        ];
        let dissipation_rate = reader.number("dissipation rate")?;
        let step = reader.finite("step")?;
        let rates = Rates {
            force: reader.number("rates")?,
            displacement: reader.number("rates")?,
            slip_displacement: reader.number("rates")?,
            dissipation: reader.number("rates")?,
            dissipation_rate: reader.number("rates")?,
            stored_energy: reader.number("rates")?,
        };
        let parameters = reader.numbers("parameters")?;
        let simulation = reader.numbers("simulation")?;
        if !reader.0.is_empty() {
            return Err(SnapshotError::Damaged { field: "end" });
        }
        let moves = flags & 2 != 0;
        let must_move = matches!(mode, Mode::Stepping | Mode::Terminated);
        if !moves && (must_move || !simulation.is_empty()) {
            return Err(SnapshotError::Damaged { field: "flags" });
        }
        Ok(Snapshot {
            guid,
            mode,
            time,
            stop: (flags & 1 != 0).then_some(stop),
            input,
            derivatives,
            dissipation_rate,
            step,
            rates,
            parameters,
            simulation: moves.then_some(simulation),
        })
    }
}

/// Bytes not read yet.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self, field: &'static str) -> Result<[u8; N], SnapshotError> {
        let (first, rest) = self
            .0
            .split_first_chunk()
            .ok_or(SnapshotError::Damaged { field })?;
        self.0 = rest;
        Ok(*first)
    }

    fn number(&mut self, field: &'static str) -> Result<f64, SnapshotError> {
        self.take(field).map(f64::from_le_bytes)
    }

    /// A number that no host could have made infinite or none.
    fn finite(&mut self, field: &'static str) -> Result<f64, SnapshotError> {
        let number = self.number(field)?;
        number
            .is_finite()
            .then_some(number)
            .ok_or(SnapshotError::Damaged { field })
    }

    /// A list; its count is believed only as far as there are bytes.
    fn numbers(&mut self, field: &'static str) -> Result<Vec<f64>, SnapshotError> {
        let count = u64::from_le_bytes(self.take(field)?);
        if count > (self.0.len() / 8) as u64 {
            return Err(SnapshotError::Damaged { field });
        }
        (0..count)
            .map(|_| {
                let number = self.number(field)?;
                // Some are infinite, as what a rigid joint has or a limit that is never reached; none is no number.
                match number.is_nan() {
                    true => Err(SnapshotError::Damaged { field }),
                    false => Ok(number),
                }
            })
            .collect()
    }
}
