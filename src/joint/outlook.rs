//! Where a step will end, as far as its input and the last tangent tell: slip limits that follow force or displacement
//! are taken there.

use super::effect::Situation;
use super::simulation::Drive;

/// What the steps so far tell of the next one.
///
/// Limits of the beginning of a step come late by a step: an error of the first order in its length, and where a record
/// has two rates late by two different times, which no joint explains. Those of the end that is foretold,
///
/// ```text
/// F_j + ΔF, U + c ΔF
/// ```
/// are off by the second order under a prescribed force; c is dU/dF_j along the last step, or while all sticks where the
/// input turns. Under a prescribed displacement the limits stay those of the beginning: beside a soft spring that is held
/// to be a part of the network those of the end leave more, and a spring that is fitted apart for their sake makes a
/// second cause of them.
///
/// Checked in tests/step_size.rs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlook {
    /// c while all sticks, and along the last step that moved \[m/N\].
    sticking: f64,
    along: f64,
    /// Way of the input in it, and the input at the end of the last step \[N or m\].
    way: f64,
    input: f64,
}

impl Outlook {
    /// Of a joint at rest with this dU/dF_j \[m/N\].
    pub fn of(sticking: f64) -> Outlook {
        Outlook {
            sticking,
            along: sticking,
            way: 0.0,
            input: 0.0,
        }
    }

    /// Takes a step that ended at `input` with this dU/dF_j; of one in no time the input alone.
    pub fn take(&mut self, step: f64, input: f64, along: f64) {
        let way = input - self.input;
        if step > 0.0 && way != 0.0 {
            (self.along, self.way) = (along, way);
        }
        self.input = input;
    }

    /// The input at the end of the last step \[N or m\].
    pub fn input(&self) -> f64 {
        self.input
    }

    /// The situation with force and displacement as they will be at the end of a step to `input`; as it is where no time
    /// passes, or where nothing tells.
    pub fn ahead(&self, last: &Situation, drive: Drive, step: f64, input: f64) -> Situation {
        let way = input - self.input;
        let compliance = match way * self.way < 0.0 {
            true => self.sticking,
            false => self.along,
        };
        let displacement = way * compliance;
        if drive == Drive::Displacement || step <= 0.0 || !displacement.is_finite() {
            return *last;
        }
        Situation {
            force: last.force + way,
            displacement: last.displacement + displacement,
            ..*last
        }
    }

    /// What of it changes, for a saved state.
    pub(super) fn saved(&self) -> [f64; 3] {
        [self.along, self.way, self.input]
    }

    /// Puts back what [`Outlook::saved`] gave.
    pub(super) fn restore(&mut self, [along, way, input]: [f64; 3]) {
        (self.along, self.way, self.input) = (along, way, input);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_goes_on_along_the_tangent_and_turns_while_all_sticks() {
        let last = Situation {
            force: 10.0,
            displacement: 7.0,
            ..Situation::default()
        };
        let mut outlook = Outlook::of(0.5);
        outlook.take(0.1, 10.0, 2.0);
        let ends = |drive, step, input| {
            let ahead = outlook.ahead(&last, drive, step, input);
            [ahead.force, ahead.displacement]
        };
        assert_eq!(ends(Drive::Force, 0.1, 13.0), [13.0, 13.0]);
        assert_eq!(ends(Drive::Force, 0.1, 6.0), [6.0, 5.0]);
        assert_eq!(ends(Drive::Displacement, 0.1, 14.0), [10.0, 7.0]);
        assert_eq!(ends(Drive::Force, 0.0, 13.0), [10.0, 7.0]);
        // A jump says where the input is and not how the joint gives way; nor does a joint that nothing holds.
        let mut jumped = outlook;
        jumped.take(0.0, 4.0, 9.0);
        let ahead = jumped.ahead(&last, Drive::Force, 0.1, 5.0);
        assert_eq!([ahead.force, ahead.displacement], [11.0, 9.0]);
        jumped.take(0.1, 5.0, f64::INFINITY);
        assert_eq!(jumped.ahead(&last, Drive::Force, 0.1, 6.0), last);
    }
}
