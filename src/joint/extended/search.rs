//! The slip that answers to an input, and why there is none.

use super::nearest::nearest_root;
use super::root::{Excess, MOST_TRIALS, NoRoot, Scales, rising_root};
use super::{Drive, Extended, JointError, Point, ROUNDING};
use crate::joint::effect::Place;

/// How far a search goes, in units of the network's own slip range.
const FARTHEST: f64 = 1e15;
/// Forces and displacements beyond which nothing is accepted, as for an exact response: their work may be no
/// finite number, and a dissipation that is infinite stays so.
const LARGEST: f64 = 1e100;
/// Share of the force of full slip that rounding may take.
const FULL: f64 = 1.0 - 1e-12;

/// An answer, not accepted yet.
#[derive(Debug)]
pub(super) struct Found {
    pub slip: f64,
    pub point: Point,
    /// Direction of the step.
    pub rising: bool,
    /// How many slips were tried.
    pub trials: usize,
}

impl Extended {
    /// The slip that answers to the input, where one does that is stable: displacement rises with the slip, and
    /// so does a prescribed force.
    pub(super) fn find(&self, time: f64, step: f64, input: f64) -> Result<Found, JointError> {
        let mut trials = 0;
        let first = rising_root(self.network.slip(), self.scales(), |slip| {
            trials += 1;
            self.excess(slip, step, input)
        });
        let root = match first {
            Ok(slip) => {
                let found = self.found(slip, step, input, trials);
                let held = slip == self.now.slip && input == self.outlook.input();
                if held || self.rises(&found.point) {
                    return self.stable(found, time, input);
                }
                Err(NoRoot::NotRising)
            }
            Err(reason) => Err(reason),
        };
        // Newton's steps may have been misled, or have gone past a peak: the nearest root decides.
        let nearest = match root {
            Err(reason @ (NoRoot::OutOfReach | NoRoot::NotRising))
                if reason == NoRoot::NotRising || !self.beyond_full_slip(input) =>
            {
                let left = MOST_TRIALS - trials;
                nearest_root(self.network.slip(), self.scales(), left, |slip| {
                    trials += 1;
                    self.excess(slip, step, input)
                })
            }
            other => other,
        };
        let slip = nearest.map_err(|reason| self.refusal(reason, time, step, input))?;
        self.stable(self.found(slip, step, input, trials), time, input)
    }

    fn scales(&self) -> Scales {
        Scales {
            reach: 1e-3 * self.reach,
            farthest: FARTHEST * self.reach,
            digit: 0.5 * f64::EPSILON * self.network.slip().abs(),
        }
    }

    fn excess(&self, slip: f64, step: f64, input: f64) -> Excess {
        let start = self.network.slip();
        let onwards = input >= self.outlook.input();
        let rising = if slip == start { onwards } else { slip > start };
        let point = self.point(slip, step, rising);
        let (value, slope, gross) = match self.drive {
            Drive::Force => (point.force, point.stiffness, point.force_noise),
            Drive::Displacement => (point.displacement, point.stretch, point.displacement_noise),
        };
        Excess {
            value: value - input,
            slope,
            noise: ROUNDING * (gross + input.abs()),
            blur: ROUNDING * (point.displacement_noise + self.reach),
        }
    }

    fn found(&self, slip: f64, step: f64, input: f64, trials: usize) -> Found {
        let rising = if slip != self.now.slip {
            slip > self.now.slip
        } else if input != self.outlook.input() {
            input > self.outlook.input()
        } else {
            self.rising
        };
        Found {
            slip,
            point: self.point(slip, step, rising),
            rising,
            trials,
        }
    }

    /// False where more slip would take the displacement back, or a prescribed force, from which the joint would
    /// run away.
    fn rises(&self, point: &Point) -> bool {
        point.stretch > 0.0 && (self.drive == Drive::Displacement || point.stiffness >= 0.0)
    }

    /// The answer, if its displacement rises, or nothing moves, and all of it is a number.
    fn stable(&self, found: Found, time: f64, input: f64) -> Result<Found, JointError> {
        let point = &found.point;
        let held = found.slip == self.now.slip && input == self.outlook.input();
        if point.stretch <= 0.0 && !held {
            return Err(self.turns_back(point, time, input));
        }
        let sizes = [point.force_noise, point.displacement_noise, input.abs()];
        let in_numbers = sizes.iter().all(|size| *size <= LARGEST);
        if !in_numbers || !point.tangent().is_finite() {
            return Err(JointError::OutOfReach { time, value: input });
        }
        Ok(found)
    }

    fn beyond_full_slip(&self, input: f64) -> bool {
        let full_slip = self.network.full_slip_force(input > 0.0);
        self.drive == Drive::Force && input.abs() >= FULL * full_slip
    }

    fn refusal(&self, reason: NoRoot, time: f64, step: f64, input: f64) -> JointError {
        let at = |slip| self.point(slip, step, input > self.outlook.input());
        match (reason, self.drive) {
            (NoRoot::Falls { beyond, .. }, Drive::Displacement) => {
                self.turns_back(&at(beyond), time, input)
            }
            (NoRoot::Falls { at: peak, beyond }, Drive::Force) => {
                let falling = at(beyond);
                let softening = self.softening(&falling, beyond);
                JointError::NoEquilibrium {
                    time,
                    force: input,
                    most: at(peak).force,
                    cause: softening.or_else(|| self.stiffening(&falling)),
                }
            }
            (NoRoot::OutOfReach, Drive::Force) if self.beyond_full_slip(input) => {
                JointError::BeyondFullSlip {
                    force: input,
                    full_slip: self.network.full_slip_force(input > 0.0),
                }
            }
            _ => JointError::OutOfReach { time, value: input },
        }
    }

    /// The effect parallel to the network or the joint that softens it most.
    fn softening(&self, point: &Point, slip: f64) -> Option<&'static str> {
        let parallel = [Place::BesideSlip, Place::BesideJoint];
        let laws = &self.laws;
        laws.falling(parallel, |law, place, memory| match place {
            Place::BesideSlip => law.beside_slip((slip, 0.0), memory).slope,
            _ => law.beside_joint(point.displacement, 0.0).slope * point.stretch,
        })
    }

    fn turns_back(&self, point: &Point, time: f64, value: f64) -> JointError {
        let cause = self.stiffening(point);
        JointError::TurnsBack { time, value, cause }
    }

    /// The effect in the load path that takes away the most compliance.
    fn stiffening(&self, point: &Point) -> Option<&'static str> {
        let path = [Place::Spring, Place::InSeries];
        self.laws.falling(path, |law, place, memory| match place {
            Place::Spring => law.spring(point.load).slope,
            _ => law.in_series(point.load, self.now.step, memory).slope,
        })
    }
}
