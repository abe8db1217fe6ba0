//! What a comparison found, as text and as JSON.

use serde_json::json;

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
    /// Samples compared.
    pub samples: usize,
    /// Name of the input.
    pub input: &'static str,
    /// One line per signal.
    pub differences: Vec<Difference>,
    /// True where a state saved halfway, serialized and put back gave the same end to the bit.
    pub state_continues: bool,
}

impl Verdict {
    /// True where every difference is rounding and the saved state continued.
    pub fn agrees(&self) -> bool {
        // `all` with `<=`: a NaN disagrees.
        self.state_continues && self.differences.iter().all(|d| d.relative() <= TOLERANCE)
    }

    fn word(&self) -> &'static str {
        if self.agrees() { "agrees" } else { "disagrees" }
    }

    /// For reading.
    pub fn text(&self, archive: &str) -> String {
        let mut text = format!(
            "{archive}: driven in {}, {} samples\n\n{:<24}{:>14}{:>14}{:>12}\n",
            self.input, self.samples, "", "largest value", "difference", "relative"
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
            "continues to the last bit"
        } else {
            "does NOT continue"
        };
        text + &format!(
            "\nA saved state {state}.\nThe archive {} with its joint.\n",
            self.word()
        )
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
        let whole = json!({
            "format": "iwan-check/1", "archive": archive, "input": self.input,
            "samples": self.samples, "differences": differences, "tolerance": TOLERANCE,
            "state_continues": self.state_continues, "verdict": self.word(),
        });
        format!("{whole:#}\n")
    }
}
