//! What a comparison found, as text and as JSON.

use super::measured::Measured;
use super::steps::{Steps, TOO_COARSE};
use super::validation::Validation;
use crate::pack::FmiVersion;
use serde_json::{Value, json};

/// Largest admissible difference, relative to the largest value of the same signal: the archive
/// holds the same code, and what differs is how a compiler orders a sum.
pub const TOLERANCE: f64 = 1e-12;

/// One signal of the archive against the same of the joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Name of the variable.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Largest absolute difference.
    pub largest: f64,
    /// Largest absolute value.
    pub scale: f64,
}

impl Difference {
    /// Largest difference over largest value; zero where both are zero.
    pub fn relative(&self) -> f64 {
        if self.largest == 0.0 {
            0.0
        } else {
            self.largest / self.scale
        }
    }
}

/// What a comparison found.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// Version of FMI.
    pub version: FmiVersion,
    /// Samples compared.
    pub samples: usize,
    /// Name of the input.
    pub input: &'static str,
    /// One line per signal.
    pub differences: Vec<Difference>,
    /// True where a state saved halfway, serialized and put back gave the same end to the bit.
    pub state_continues: bool,
    /// True where the whole run came out the same to the bit after a reset.
    pub reset_repeats: bool,
    /// The record's answer beside the joint's, where there is one.
    pub measured: Option<Measured>,
    /// What the record asks of the importer's step, where there is a record.
    pub steps: Option<Steps>,
    /// What the archive says of itself.
    pub validation: Validation,
}

impl Verdict {
    /// True where every difference is rounding, the saved state continued and the reset repeated.
    pub fn agrees(&self) -> bool {
        // `all` with `<=`: a NaN disagrees.
        let close = self.differences.iter().all(|d| d.relative() <= TOLERANCE);
        close && self.reset_repeats && self.state_continues
    }

    fn word(&self) -> &'static str {
        if self.agrees() { "agrees" } else { "disagrees" }
    }

    /// For reading.
    pub fn text(&self, archive: &str) -> String {
        let mut text = format!(
            "{archive}: FMI {}, driven in {}, {} samples; libraries for {}\n",
            self.version.number(),
            self.input,
            self.samples,
            self.validation.platforms.join(", ")
        );
        for fault in &self.validation.faults {
            text += &format!("FAULT: {fault}\n");
        }
        for note in &self.validation.notes {
            text += &format!("note: {note}\n");
        }
        text += &format!(
            "\n{:<24}{:>14}{:>14}{:>12}\n",
            "", "largest value", "difference", "relative"
        );
        for difference in &self.differences {
            let name = format!("{} [{}]", difference.name, difference.unit);
            text += &format!(
                "{name:<24}{:>14.6e}{:>14.3e}{:>12.1e}\n",
                difference.scale,
                difference.largest,
                difference.relative()
            );
        }
        let state = if self.state_continues {
            "A saved state continues to the last bit."
        } else {
            "A saved state does NOT continue."
        };
        let reset = if self.reset_repeats {
            "After a reset the run repeats to the last bit."
        } else {
            "After a reset the run does NOT repeat."
        };
        text += &format!(
            "\n{state}\n{reset}\nThe archive {} with its joint.\n",
            self.word()
        );
        text += &self
            .measured
            .as_ref()
            .map(measured_text)
            .unwrap_or_default();
        text + &self.steps.as_ref().map(steps_text).unwrap_or_default()
    }

    /// For programs.
    pub fn json(&self, archive: &str) -> String {
        let differences: Vec<_> = self
            .differences
            .iter()
            .map(|d| {
                json!({
                    "name": d.name, "unit": d.unit, "largest_value": d.scale,
                    "largest_difference": d.largest, "relative_difference": d.relative(),
                })
            })
            .collect();
        let validation = &self.validation;
        let whole = json!({
            "format": "iwan-check/1", "archive": archive, "fmi": self.version.number(),
            "input": self.input,
            "samples": self.samples, "differences": differences, "tolerance": TOLERANCE,
            "state_continues": self.state_continues, "reset_repeats": self.reset_repeats,
            "verdict": self.word(),
            "platforms": validation.platforms, "faults": validation.faults,
            "notes": validation.notes,
            "measured": self.measured.as_ref().map(measured_json),
            "steps": self.steps.as_ref().map(steps_json),
        });
        format!("{whole:#}\n")
    }
}

fn measured_text(measured: &Measured) -> String {
    let Measured {
        name,
        unit,
        offset,
        rms,
        largest,
        swing,
        work,
    } = measured;
    format!(
        "\nBeside the record, {name} measured minus simulated: {rms:.3e} {unit} rms, {:.2} % of \
         the measured;\nlargest {largest:.3e} {unit}; the sensor's zero of {offset:.3e} {unit} \
         taken out.\nWork over the record: measured {:.6e} J, simulated {:.6e} J ({:+.2} %).\n",
        100.0 * rms / swing,
        work.0,
        work.1,
        100.0 * (work.1 / work.0 - 1.0)
    )
}

fn measured_json(measured: &Measured) -> Value {
    json!({
        "name": measured.name, "unit": measured.unit, "offset": measured.offset,
        "rms": measured.rms, "largest": measured.largest, "swing": measured.swing,
        "work_measured": measured.work.0, "work_simulated": measured.work.1,
    })
}

fn steps_text(steps: &Steps) -> String {
    let mut text = match steps.shortest_cycle {
        Some(cycle) => format!("\nThe record's shortest cycle lasts {cycle:.6} s.\n"),
        None => "\nThe record holds no whole cycle.\n".to_owned(),
    };
    text += &format!(
        "{:>14}{:>14}{:>18}{:>12}\n",
        "step [s]", "per cycle", "dissipation [J]", "lost"
    );
    for effect in &steps.effects {
        text += &format!(
            "{:>14.6e}{:>14.1}{:>18.6e}{:>10.3} %  {}\n",
            effect.step,
            effect.per_cycle,
            effect.dissipation,
            100.0 * effect.lost,
            effect.origin
        );
    }
    let judged = &steps.judged;
    let limit = 100.0 * TOO_COARSE;
    let (step, origin, suffers) = (judged.step, &judged.origin, suffers(judged.lost));
    if steps.too_coarse() {
        text += &format!(
            "A step of {step:.6e} s ({origin}) is TOO COARSE for this record: {suffers}.\n"
        );
        text += &match steps.advised {
            Some(step) => format!("Take {step:.6e} s or less: it is off by at most {limit} %.\n"),
            None => format!("No step tried is within {limit} %: sample the load finer.\n"),
        };
    } else {
        text += &format!(
            "A step of {step:.6e} s ({origin}) is fine enough: {suffers}, at most {limit} % is let \
             pass.\n"
        );
    }
    if steps.record_too_coarse() {
        text += "The record itself has so few samples per cycle that its turning values, and with \
                 them these shares, are a guess.\n";
    }
    text
}

/// What a share that is lost, or gained where it is negative, means for the dissipation.
fn suffers(lost: f64) -> String {
    let share = 100.0 * lost.abs();
    if lost < 0.0 {
        format!("{share:.2} % too much is dissipated")
    } else {
        format!("{share:.2} % of the dissipation is lost")
    }
}

fn steps_json(steps: &Steps) -> Value {
    let effects: Vec<_> = steps
        .effects
        .iter()
        .map(|effect| {
            json!({
                "step": effect.step, "origin": effect.origin, "per_cycle": effect.per_cycle,
                "dissipation": effect.dissipation, "lost": effect.lost,
            })
        })
        .collect();
    json!({
        "shortest_cycle": steps.shortest_cycle, "reference_dissipation": steps.reference,
        "judged_step": steps.judged.step, "lost": steps.judged.lost,
        "too_coarse": steps.too_coarse(), "advised_step": steps.advised,
        "record_too_coarse": steps.record_too_coarse(), "effects": effects,
    })
}

#[cfg(test)]
mod tests {
    use super::suffers;

    /// Damping that follows the last step may gain as well as lose.
    #[test]
    fn what_is_gained_is_not_called_lost() {
        assert_eq!(suffers(0.0123), "1.23 % of the dissipation is lost");
        assert_eq!(suffers(-0.0123), "1.23 % too much is dissipated");
    }
}
