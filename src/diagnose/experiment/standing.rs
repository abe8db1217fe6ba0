//! How far a question to the joint is settled, and what makes a program worth running for it.

use super::separability::TOLD;
use crate::diagnose::places::NEARLY;
use crate::diagnose::verdict::NEGLIGIBLE;

/// Rise of χ² that is worth running a program which does not settle its question, and multiple of what it was: less is
/// within what the look ahead may be wrong by.
const LEAST_RISE: f64 = 5.0;
const LEAST_MULTIPLE: f64 = 2.0;

/// How far one question is settled.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// χ² that the rival leaves.
    pub lambda: f64,
    /// χ² that the baseline alone leaves: what the cause brings.
    pub alone: f64,
    /// χ² that is needed.
    pub needed: f64,
}

impl Standing {
    /// Judges a χ² on so many samples: beyond [`TOLD`], what a law that is only nearly true may leave does not count.
    /// It is granted more than in a search, [`NEARLY`] of what the cause brings: a program is to settle its question.
    pub fn new(lambda: f64, alone: f64, rows: f64) -> Standing {
        let alone = alone.max(lambda);
        Standing {
            lambda,
            alone,
            needed: TOLD + (NEARLY * alone).min(NEGLIGIBLE * rows),
        }
    }

    /// χ² over what is needed.
    pub fn ratio(&self) -> f64 {
        self.lambda / self.needed
    }

    /// True where a program is worth running that brings a question from where it stood to here.
    pub fn is_worth_more_than(&self, before: &Standing) -> bool {
        let rises = self.lambda - before.lambda >= LEAST_RISE;
        self.ratio() >= 1.0 || rises && self.lambda >= LEAST_MULTIPLE * before.lambda
    }
}

/// The one that is settled least.
pub fn least(standings: &[Standing]) -> Option<Standing> {
    let each = standings.iter().copied();
    each.min_by(|a, b| a.ratio().total_cmp(&b.ratio()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_worth_running_where_it_gains() {
        let at = |lambda: f64| Standing::new(lambda, lambda, 1000.0);
        let worth = |before, after| at(after).is_worth_more_than(&at(before));
        assert!(worth(0.2, 53.0) && worth(20.0, 40.0) && worth(3.0, 9.0));
        assert!(!worth(0.2, 0.3) && !worth(0.0, 0.0) && !worth(0.1, 4.0));
        assert!(!worth(12.0, 18.0));
    }
}
