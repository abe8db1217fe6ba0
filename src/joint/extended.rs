//! The joint with effects in any of its places: one rising scalar equation per step.

mod ahead;
mod cells;
mod laws;
mod ledger;
mod nearest;
mod quadrature;
mod root;
mod saved;
mod search;
mod slopes;

use super::density::Sliders;
use super::effect::{Acting, Response, Situation, SlipLimit};
use super::network::Network;
use super::outlook::Outlook;
use super::sensitivity::Sensitivity;
use super::simulation::{Drive, JointError};
pub(super) use cells::fine_cells;
use laws::Laws;
use ledger::{Ledger, Leg};
pub use root::MOST_TRIALS;
use search::Found;
use slopes::End;

/// Rounding errors of a sum, in units of the last place of its largest part.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// The extended joint in motion. The unknown of a step is the slip u:
///
/// ```text
/// F_j = N(u) + Σ p(u, (u − u_old)/step)  network with its slip limits, and what acts beside slip
/// U   = u + F_j/K_1 + Σ δ(F_j) + Σ s(F_j, step)            spring (Eq. 52) and load path
/// F   = F_j + Σ f(U, (U − U_old)/step)                     beside the joint
/// ```
/// Both F(u) and U(u) rise, so either drive is one bracketed Newton search; where a law softens the joint so far
/// that one falls, `search` refuses what has no answer. Slip limits are those
/// of the history, and of force and displacement: as they were, or under a prescribed force as the step is
/// [foretold](Outlook) to end. Where no time passes, rates and slip limits stay as they were: a dashpot then neither lets
/// go nor blocks the joint, and the answer to a small jump is a small one.
///
/// Checked in tests/extended: equal to the exact response where nothing acts, work balance,
/// closed forms of single effects, saved and restored state.
#[derive(Debug, Clone)]
pub(super) struct Extended {
    drive: Drive,
    flexibility: f64,
    reach: f64,
    network: Network,
    /// Slip limit of the last step.
    limit: SlipLimit,
    laws: Laws,
    now: Situation,
    outlook: Outlook,
    ledger: Ledger,
    /// dF/dU with rates held, and all slopes over u as the last step's equation has them.
    tangent: f64,
    slopes: Sensitivity,
    /// Direction of the last step that moved.
    rising: bool,
    /// Trials of the slip that the last step took.
    trials: usize,
    /// A memory to try things on, and the state to go back to: places that are made once.
    scratch: Vec<f64>,
    kept: Vec<f64>,
}

/// What the joint answers to a step. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Answer {
    pub force: f64,
    pub displacement: f64,
    pub slip: f64,
    pub dissipation: f64,
    pub stored_energy: f64,
    pub tangent_stiffness: f64,
}

/// Everything that follows from one trial slip.
#[derive(Debug, Clone, Copy)]
struct Point {
    /// F_j \[N\].
    load: f64,
    /// U \[m\].
    displacement: f64,
    /// F \[N\].
    force: f64,
    /// dF_j/du \[N/m\], dU/du and dF/du \[N/m\] with the rates.
    load_slope: f64,
    stretch: f64,
    stiffness: f64,
    /// The same at fixed rates.
    held: Held,
    /// Scales of rounding in F \[N\] and U \[m\].
    force_noise: f64,
    displacement_noise: f64,
}

/// Slopes over the slip at fixed rates.
#[derive(Debug, Clone, Copy)]
struct Held {
    load_slope: f64,
    stretch: f64,
    stiffness: f64,
}

impl Point {
    /// dF/dU at fixed rates \[N/m\].
    fn tangent(&self) -> f64 {
        self.held.stiffness / self.held.stretch
    }

    /// dU/dF_j at fixed rates \[m/N\].
    fn compliance(&self) -> f64 {
        self.held.stretch / self.held.load_slope
    }
}

impl Extended {
    /// A virgin joint of these sliders behind K_1 \[N/m\].
    pub fn new(
        sliders: &Sliders,
        series_stiffness: f64,
        effects: &[Acting],
        drive: Drive,
    ) -> Extended {
        let laws = Laws::new(effects);
        let mut extended = Extended {
            drive,
            flexibility: 1.0 / series_stiffness,
            reach: sliders.slip_at.last().copied().unwrap_or(1e-6),
            network: Network::new(sliders).sticking(laws.sticking()),
            limit: SlipLimit::UNCHANGED,
            ledger: Ledger::new(&laws),
            laws,
            now: Situation::default(),
            outlook: Outlook::of(0.0),
            tangent: 0.0,
            slopes: Sensitivity {
                force: 0.0,
                displacement: 1.0,
                slip_displacement: 1.0,
                dissipation: 0.0,
                stored_energy: 0.0,
            },
            rising: true,
            trials: 0,
            scratch: Vec::new(),
            kept: Vec::new(),
        };
        extended.now.displacement = extended.laws.in_load_path(0.0, 0.0).value;
        extended.limit = extended.laws.slip_limit(&extended.now);
        extended.network.begin(extended.limit);
        let start = extended.point(0.0, 0.0, true);
        extended.tangent = start.tangent();
        extended.outlook = Outlook::of(start.compliance());
        extended.slopes.force = start.stiffness;
        extended.slopes.displacement = start.stretch;
        extended.scratch = extended.laws.memory().to_vec();
        extended.kept = Vec::with_capacity(extended.state_length());
        extended
    }

    /// Goes to `input` \[N or m\] at `time` \[s\] within `step` \[s\]; the state is as before on an
    /// error.
    pub fn advance(&mut self, time: f64, step: f64, input: f64) -> Result<Answer, JointError> {
        let limit = self.limit_of(step, input);
        self.network.begin(limit);
        let found = self.find(time, step, input)?;
        (self.limit, self.trials) = (limit, found.trials);
        self.accept(time, step, input, found);
        Ok(self.answer(input))
    }

    /// Newton's last step, smaller than a digit of u, taken by F_j and U instead: where a play
    /// hangs free, one digit of u is many of U.
    fn last_digit(&self, mut point: Point, slip: f64, input: f64) -> Point {
        let (excess, slope) = match self.drive {
            Drive::Force => (point.force - input, point.stiffness),
            Drive::Displacement => (point.displacement - input, point.stretch),
        };
        let rest = excess / slope;
        if rest.abs() <= ROUNDING * (slip.abs() + self.network.slip().abs()) {
            point.load -= point.load_slope * rest;
            point.displacement -= point.stretch * rest;
        }
        if self.drive == Drive::Displacement {
            point.displacement = input;
        }
        point
    }

    fn point(&self, slip: f64, step: f64, rising: bool) -> Point {
        let network = self.network.trial(slip, rising);
        let per_rate = if step > 0.0 { 1.0 / step } else { 0.0 };
        let beside = self.laws.beside_slip((slip, self.slip_rate(slip, step)));
        let load = network.force + beside.value;
        let held_slope = network.stiffness + beside.slope;
        let load_slope = held_slope + beside.damping * per_rate;
        let path = self.laws.in_load_path(load, step);
        let spring = load * self.flexibility;
        let displacement = slip + spring + path.value;
        let stretch = |load_slope: f64| 1.0 + (self.flexibility + path.slope) * load_slope;
        let (stretch, held_stretch) = (stretch(load_slope), stretch(held_slope));
        let velocity = self.velocity(displacement, step);
        let parallel = self.laws.beside_joint(displacement, velocity);
        let stiffness = load_slope + parallel.slope * stretch;
        Point {
            load,
            load_slope,
            displacement,
            force: load + parallel.value,
            stretch,
            stiffness: stiffness + parallel.damping * per_rate * stretch,
            held: Held {
                load_slope: held_slope,
                stretch: held_stretch,
                stiffness: held_slope + parallel.slope * held_stretch,
            },
            force_noise: network.gross + beside.value.abs() + parallel.value.abs(),
            displacement_noise: slip.abs() + spring.abs() + path.value.abs(),
        }
    }

    fn velocity(&self, displacement: f64, step: f64) -> f64 {
        if step > 0.0 {
            (displacement - self.now.displacement) / step
        } else {
            self.now.velocity
        }
    }

    fn slip_rate(&self, slip: f64, step: f64) -> f64 {
        if step > 0.0 {
            (slip - self.now.slip) / step
        } else {
            self.now.slip_rate
        }
    }

    fn accept(&mut self, time: f64, step: f64, input: f64, found: Found) {
        let from = self.now;
        let Found { slip, rising, .. } = found;
        self.rising = rising;
        let point = self.last_digit(found.point, slip, input);
        let by_limit = self.by_limit(step, input, slip);
        let loss = self.network.accept(slip);
        self.now = Situation {
            time,
            step,
            force: point.load,
            displacement: point.displacement,
            velocity: self.velocity(point.displacement, step),
            slip,
            slip_rate: self.slip_rate(slip, step),
            dissipation: from.dissipation + loss,
        };
        self.outlook.take(step, input, point.compliance());
        self.ledger.work(&self.laws, &Leg { from, to: self.now });
        self.tangent = point.tangent();
        let along = self.along(&point, by_limit);
        let end = End {
            along: &along,
            now: &self.now,
            laws: &self.laws,
            way: point.displacement - from.displacement,
            slipped: slip - from.slip,
            sliding: self.network.sliding_force(rising),
            flexibility: self.flexibility,
            reach: self.reach,
        };
        self.slopes = end.slopes(&mut self.scratch);
        self.laws.remember(&self.now);
        self.ledger.close(&self.laws, &self.now, loss);
        if self.ledger.owes() {
            // What is lost now only pays the debt: it is told as stored energy until then.
            self.slopes.stored_energy += self.slopes.dissipation;
            self.slopes.dissipation = 0.0;
        }
    }

    /// The accepted state; the driven quantity is the input itself.
    fn answer(&self, input: f64) -> Answer {
        let now = &self.now;
        let Response { value: beside, .. } = self.laws.beside_joint(now.displacement, now.velocity);
        let (force, displacement) = match self.drive {
            Drive::Force => (input, now.displacement),
            Drive::Displacement => (now.force + beside, input),
        };
        let spring = 0.5 * self.flexibility * now.force * now.force;
        Answer {
            force,
            displacement,
            slip: now.slip,
            dissipation: self.ledger.dissipation(),
            stored_energy: self.network.stored_energy() + spring + self.ledger.stored(),
            tangent_stiffness: self.tangent,
        }
    }

    /// Trials of the slip that the last step took.
    pub fn trials(&self) -> usize {
        self.trials
    }

    /// Tangent stiffness dF/dU \[N/m\] along the last direction, rates held.
    pub fn tangent_stiffness(&self) -> f64 {
        self.tangent
    }

    /// Slopes of the last answer over its input, see [`Sensitivity`].
    pub fn sensitivity(&self) -> Sensitivity {
        let slopes = self.slopes;
        match self.drive {
            Drive::Force => slopes.over(slopes.force),
            Drive::Displacement => slopes.over(slopes.displacement),
        }
    }
}
