//! Slip limits of a step that follow its own end, and what they add to the slopes of its answer.

use super::super::effect::SlipLimit;
use super::{Extended, Point};
use crate::joint::simulation::Drive;

/// Share of a step's way by which it is lengthened to see what its slip limits do then.
const FURTHER: f64 = 1e-4;

/// What a step's limits add to its answer per unit of the force that drives it, at held slip.
#[derive(Debug, Clone, Copy)]
pub(super) struct ByLimit {
    /// Of the network's force.
    force: f64,
    /// Of what the network loses, and of what it keeps.
    lost: f64,
    stored: f64,
}

/// Slopes over u along the way that a step takes if its input goes on: as its equation has them where limits stay.
#[derive(Debug, Clone, Copy)]
pub(super) struct Along {
    pub point: Point,
    /// What the limits add to the slopes of loss and stored energy of the network \[N\].
    pub lost: f64,
    pub stored: f64,
}

impl Extended {
    /// Slip limits of a step: under a prescribed force those of its foretold end; where no time passes, those of the last one.
    pub(super) fn limit_of(&self, step: f64, input: f64) -> SlipLimit {
        if step <= 0.0 {
            return self.limit;
        }
        let ahead = self.outlook.ahead(&self.now, self.drive, step, input);
        self.laws.slip_limit(&ahead)
    }

    /// What limits that follow the force add to a step to `slip` that took the present ones; none where they do not
    /// follow it.
    pub(super) fn by_limit(&self, step: f64, input: f64, slip: f64) -> Option<ByLimit> {
        if self.drive == Drive::Displacement {
            return None;
        }
        let further = FURTHER * (input - self.outlook.input());
        let other = self.limit_of(step, input + further);
        if other == self.limit {
            return None;
        }
        let [here, there] = [self.limit, other].map(|limit| self.network.under(limit, slip));
        let by = |part: usize| (there[part] - here[part]) / further;
        Some(ByLimit {
            force: by(0),
            lost: by(1),
            stored: by(2),
        })
    }

    /// The slopes of the step that ended here, at this point.
    ///
    /// At held slip the limits raise the network's force by `N'` per unit of the force, hence U by `c N'` with the
    /// compliance c of the load path, and F by `(1 + k c) N'` with the stiffness k beside the joint; so the slip goes by
    /// `du/dF = (1 − (1 + k c) N')/F'`.
    pub(super) fn along(&self, point: &Point, by: Option<ByLimit>) -> Along {
        let held = Along {
            point: *point,
            lost: 0.0,
            stored: 0.0,
        };
        let Some(by) = by else {
            return held;
        };
        let compliance = self.flexibility + self.laws.in_load_path(point.load, self.now.step).slope;
        let now = &self.now;
        let beside = self.laws.beside_joint(now.displacement, now.velocity);
        let stiffness = beside.slope + beside.damping / now.step;
        let (stretch, force) = (
            compliance * by.force,
            (1.0 + stiffness * compliance) * by.force,
        );
        let per_slip = point.stiffness / (1.0 - force);
        if !per_slip.is_finite() {
            return held;
        }
        Along {
            point: Point {
                load_slope: point.load_slope + by.force * per_slip,
                stretch: point.stretch + stretch * per_slip,
                stiffness: point.stiffness + force * per_slip,
                ..*point
            },
            lost: by.lost * per_slip,
            stored: by.stored * per_slip,
        }
    }
}
