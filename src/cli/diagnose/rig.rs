//! The limits of the rig, as options.

use crate::cli::BadInput;
use crate::diagnose::experiment::Limits;
use crate::read::Loaded;
use crate::record::Measurement;

/// What the rig can do; by default what the records show it doing.
#[derive(Debug, Clone, Copy, clap::Args)]
pub struct RigLimits {
    /// Largest force of the next experiment to either side of zero, newton; where the records are driven by displacement, as the joint found here would answer
    #[arg(long, value_name = "N", value_parser = positive, allow_negative_numbers = true)]
    limit_force: Option<f64>,
    /// Largest displacement of the next experiment to either side of zero, metre; where the records are driven by force, as the joint found here would answer
    #[arg(long, value_name = "M", value_parser = positive, allow_negative_numbers = true)]
    limit_displacement: Option<f64>,
    /// Highest rate of its cycles, hertz
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    limit_rate: Option<f64>,
    /// Its longest duration, seconds
    #[arg(long, value_name = "S", value_parser = positive, allow_negative_numbers = true)]
    limit_duration: Option<f64>,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() && value > 0.0 => Ok(value),
        _ => Err("a limit is a number above zero".to_string()),
    }
}

impl RigLimits {
    /// The same for the look ahead.
    pub fn limits(self) -> Limits {
        Limits {
            force: self.limit_force,
            displacement: self.limit_displacement,
            rate: self.limit_rate,
            duration: self.limit_duration,
        }
    }

    /// Refuses a limit where no load program can come of the files: it would be taken for kept.
    ///
    /// # Errors
    /// [`BadInput`] naming the option, and why.
    pub fn of_use(self, loaded: &[Loaded]) -> Result<(), BadInput> {
        let given = [
            ("--limit-force", self.limit_force),
            ("--limit-displacement", self.limit_displacement),
            ("--limit-rate", self.limit_rate),
            ("--limit-duration", self.limit_duration),
        ];
        let Some((option, _)) = given.iter().find(|(_, value)| value.is_some()) else {
            return Ok(());
        };
        let why = loaded.iter().find_map(|loaded| match &loaded.measurement {
            Measurement::Amplitudes(_) => {
                Some("no load program is designed from an amplitude table")
            }
            Measurement::History(record) if record.time.is_none() => {
                Some("without time in every record no load program is designed")
            }
            Measurement::History(_) => None,
        });
        match why {
            None => Ok(()),
            Some(why) => Err(BadInput(format!(
                "{option}: nothing here has a use for it: {why}; leave it out"
            ))),
        }
    }
}
