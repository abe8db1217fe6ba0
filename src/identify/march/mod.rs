//! One pass through a record: every operator, every effect at its place, one scalar equation per
//! sample. The judged channel it predicts is the simulation, so identification and simulation
//! cannot disagree.

mod ahead;
mod by_displacement;
mod by_force;
mod places;

use places::Earlier;
pub use places::added;

use super::inertia::{Carried, Inertia};
use super::lanes::Bank;
use super::operators::{Form, Operators, SHARED};
use crate::joint::effect::{Acting, Place, Situation};
use crate::joint::outlook::Outlook;

/// Effects sorted by place, with the history they keep.
pub struct March<'a> {
    operators: &'a Operators,
    elastic: f64,
    bank: Bank,
    /// Σ c of the bank where its operators are stops, each its input less a play: 0 for plays themselves.
    stopped: f64,
    cells: &'a [f64],
    effects: &'a [Acting],
    memories: Vec<Vec<f64>>,
    last: Situation,
    earlier: Option<Earlier>,
    /// Force of the network at the end of the last step \[N\].
    network: f64,
    /// Of the network at the end of the last step, from where the next one's root is looked for.
    tangent: f64,
    outlook: Outlook,
    limits: (f64, f64),
    /// Where force drives: where the displacement does, its acceleration is measured.
    inertia: Inertia,
    has: [bool; 7],
    /// True where a force beside the slip follows its rate.
    damps_slip: bool,
    counts_energy: bool,
    /// True where the joint is as a record before left it.
    goes_on: bool,
}

/// What one sample gave.
#[derive(Debug, Clone, Copy, Default)]
pub struct Step {
    /// True force [N].
    pub force: f64,
    /// True displacement [m].
    pub displacement: f64,
    /// d judged / d network output: what a column of the dictionary is worth at this sample.
    pub share: f64,
    /// d network input / d judged, and by the network's output.
    pub(super) input: [f64; 2],
    /// What the input takes the network's output to gain by each of the two earlier values of `carried`: of a dashpot on the
    /// slip behind a spring.
    pub(super) lagging: [f64; 2],
    /// d displacement / d its two earlier values, latest first: a force that follows the rate of the
    /// displacement carries a change of the model on to later samples.
    pub carried: [f64; 2],
    /// What a mass does in the step; its derivatives by the motion before are those of the displacement.
    pub(super) hauled: Carried,
}

/// What lasts of a joint's work when a record ends: none of it where every record is of a joint made new.
#[derive(Debug, Clone, Default)]
pub(super) struct Wear {
    /// Energy dissipated by the network \[J\].
    dissipation: f64,
    /// Of the history of every effect what [`lasts`](crate::joint::effect::Effect::lasting).
    memories: Vec<Vec<f64>>,
    /// Where the joint stood and was going, if its slip limits moved: what it remembers is more than where its load turned.
    stood: Option<Stood>,
}

/// Where a joint stands, under which slip limits, and where its next step would lead.
#[derive(Debug, Clone)]
struct Stood {
    bank: Bank,
    last: Situation,
    network: f64,
    outlook: Outlook,
    limits: (f64, f64),
}

/// Error of a step's equation, as a share of its input, that counts as none: a derivative by
/// differences of a ten-thousandth is good to a part in a million of it, even for small effects.
const PRECISE: f64 = 1e-13;

/// Parts of the way to a turn before the record where slip limits follow what the joint does: a step takes them from its
/// start.
const ON_THE_WAY: u32 = 40;

/// Trials after which a step takes what it has.
const MOST_TRIALS: usize = 60;

fn index(place: Place) -> usize {
    place as usize
}

/// Slope of a step's equation, of a unit of the network's input, below which the joint snaps through and no derivative
/// says where to.
const SOFTEST: f64 = 0.05;

/// d judged / d network output, of a step's equation with this slope.
fn share(slope: f64) -> f64 {
    if slope > SOFTEST { 1.0 / slope } else { 0.0 }
}

/// The cells that a march carries along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cells {
    /// All of them: asked for rows of the dictionary.
    All,
    /// Those with a coefficient, about half of them after a fit: enough for a prediction.
    Weighted,
}

impl<'a> March<'a> {
    /// A virgin joint with the given coefficients (elastic first, then one per cell); a mass wants steps in `parts`.
    pub fn new(
        operators: &'a Operators,
        coefficients: &'a [f64],
        effects: &'a [Acting],
        (cells, parts): (Cells, u32),
    ) -> Self {
        let mut has = [false; 7];
        for acting in effects {
            for place in acting.places() {
                has[index(place)] = true;
            }
        }
        // Without such effects an operator beyond the input's range is an elastic one: the
        // dictionary has that already.
        let input_channel = operators.form.input_place();
        // A spring across the joint that softens leaves the network more than the whole force, and so does a dashpot
        // that turns late.
        let damps_slip = effects.iter().any(places::damps_slip);
        let beside = has[index(Place::BesideJoint)] || damps_slip;
        let across = operators.form == Form::Play && beside;
        let beyond = has[index(Place::SlipLimit)] || has[index(input_channel)] || across;
        let cells_reached = match beyond {
            true => coefficients.len() - 1,
            false => operators.edges.len(),
        };
        let (reached, resting) = coefficients[1..].split_at(cells_reached);
        let elastic = coefficients[0]
            + match operators.form {
                Form::Play => 0.0,
                // Of a fit whose effects reached them some of its stiffness may be there.
                Form::Stop => resting.iter().sum(),
            };
        let sticking = effects.iter().map(|a| a.effect.sticking(&a.values)).sum();
        let bank = Bank::new(operators.spread(reached, |c| cells == Cells::All || c != 0.0));
        let still = !has[index(Place::SlipLimit)];
        let stopped = match operators.form {
            Form::Play => 0.0,
            Form::Stop => bank.weight(),
        };
        let bank = match still && sticking == 0.0 {
            true => bank.still(),
            false => bank.sticking(sticking),
        };
        let mut march = March {
            operators,
            elastic,
            bank,
            stopped,
            cells: reached,
            effects,
            memories: effects
                .iter()
                .map(|a| vec![0.0; a.effect.memory()])
                .collect(),
            last: Situation::default(),
            earlier: None,
            network: 0.0,
            tangent: elastic,
            outlook: Outlook::of(elastic),
            limits: (1.0, 1.0),
            inertia: match operators.form {
                Form::Play => Inertia::of(effects, parts),
                Form::Stop => Inertia::default(),
            },
            has,
            damps_slip,
            // Only slip limits see the energy; without effects it is what the march is asked for.
            counts_energy: effects.is_empty()
                || effects
                    .iter()
                    .any(|a| a.acts_at(Place::SlipLimit) && a.effect.sees_energy()),
            goes_on: false,
        };
        let feeds_back = march.feeds_back();
        march.bank = march.bank.explicit(!feeds_back);
        march.outlook = march.at_rest();
        march
    }

    /// The elastic coefficient, that of stops which nothing reaches included.
    pub(super) fn elastic(&self) -> f64 {
        self.elastic
    }

    /// True where a change of the model is carried on from sample to sample.
    pub(super) fn carries(&self) -> bool {
        self.follows_rates() || self.inertia.acts()
    }

    /// True where a force follows the rate.
    pub(super) fn follows_rates(&self) -> bool {
        self.has[index(Place::BesideJoint)] || self.damps_slip
    }

    /// Output of the network per unit of each coefficient, the elastic one first; of a march with all cells.
    pub(super) fn outputs(&self, outputs: &mut [f64]) {
        outputs[0] = match self.operators.form {
            Form::Play => self.network,
            Form::Stop => self.last.slip,
        };
        let cells = self.bank.positions().chunks_exact(SHARED);
        for (output, cell) in outputs[1..].iter_mut().zip(cells) {
            let play = cell.iter().sum::<f64>() / SHARED as f64;
            *output = match self.operators.form {
                Form::Play => play,
                Form::Stop => self.last.slip - play,
            };
        }
    }

    /// Positions of the operators, as plays, at the end of the last step, in the order of the thresholds.
    pub(super) fn positions(&self) -> &[f64] {
        self.bank.positions()
    }

    /// Coefficients of the cells.
    pub(super) fn cells(&self) -> &[f64] {
        self.cells
    }

    /// Which operators they are.
    pub(super) fn form(&self) -> Form {
        self.operators.form
    }

    /// True where what the network gives moves its own input.
    pub(super) fn feeds_back(&self) -> bool {
        match self.operators.form {
            Form::Play => self.has[index(Place::BesideSlip)] || self.carries(),
            Form::Stop => self.in_path_acts(),
        }
    }

    /// Energy dissipated by the network so far [J]; counted without effects and where a slip limit
    /// follows it.
    pub fn dissipation(&self) -> f64 {
        self.last.dissipation
    }

    /// Network output for a trial input, the operators' trial positions, and the tangent where the network feeds back.
    fn network(&mut self, input: f64) -> (f64, f64) {
        let (plays, moved) = self.bank.plays(input, self.limits);
        match self.operators.form {
            Form::Play => (self.elastic * input + plays, self.elastic + moved),
            Form::Stop => {
                let resting = self.elastic + self.stopped;
                (resting * input - plays, resting - moved)
            }
        }
    }

    /// Takes one sample: the true input channel of the form, force [N] or displacement [m].
    pub fn step(&mut self, time: f64, step: f64, input: f64) -> Step {
        self.update_limits(step, input);
        match self.operators.form {
            Form::Play => self.step_force(time, step, input),
            Form::Stop => self.step_displacement(time, step, input),
        }
    }

    /// Forgets the rate so far: the input has a kink here, and the next difference starts behind it.
    pub fn kink(&mut self) {
        self.earlier = None;
    }

    /// Takes the joint through loads before the first sample: it remembers where they turned, and nothing else
    /// that effects keep; no work is counted.
    pub(super) fn precede(&mut self, time: f64, turned: &[f64]) {
        if self.goes_on {
            return;
        }
        let (memories, dissipation) = (self.memories.clone(), self.last.dissipation);
        let parts = match self.has[index(Place::SlipLimit)] {
            true => ON_THE_WAY,
            false => 1,
        };
        let mut from = 0.0;
        for &input in turned {
            for part in 1..=parts {
                let way = f64::from(part) / f64::from(parts);
                self.step(time, 0.0, from + way * (input - from));
            }
            from = input;
        }
        self.memories = memories;
        self.earlier = None;
        self.last.dissipation = dissipation;
    }

    /// Wear at the end of the last step.
    pub(super) fn wear(&self) -> Wear {
        let both = self.effects.iter().zip(&self.memories);
        Wear {
            dissipation: self.last.dissipation,
            memories: both
                .map(|(a, memory)| memory[..a.effect.lasting()].to_vec())
                .collect(),
            stood: self.has[index(Place::SlipLimit)].then(|| Stood {
                bank: self.bank.clone(),
                last: self.last,
                network: self.network,
                outlook: self.outlook,
                limits: self.limits,
            }),
        }
    }

    /// A joint that is worn so far, at rest or, where it `goes_on`, as it stood.
    pub(super) fn worn(mut self, wear: &Wear, goes_on: bool) -> Self {
        if let Some(stood) = wear.stood.as_ref().filter(|_| goes_on) {
            (self.bank, self.last, self.network) = (stood.bank.clone(), stood.last, stood.network);
            (self.outlook, self.limits) = (stood.outlook, stood.limits);
            self.goes_on = true;
        }
        self.last.dissipation = wear.dissipation;
        for (memory, lasted) in self.memories.iter_mut().zip(&wear.memories) {
            memory[..lasted.len()].copy_from_slice(lasted);
        }
        self
    }

    /// True where a mass moves with the joint.
    pub(super) fn hauls(&self) -> bool {
        self.inertia.acts()
    }

    /// Parts that a mass wants the steps of samples in.
    pub(super) fn hauling(&self) -> u32 {
        self.inertia.parts
    }

    /// Largest input that the grid was made for.
    fn range(&self) -> f64 {
        self.operators.edges.last().copied().unwrap_or(0.0)
    }

    fn accept(&mut self, time: f64, step: f64, answer: (f64, f64, f64, f64)) {
        let (slip, force, displacement, velocity) = answer;
        let counted = self.counts_energy;
        let dissipated = counted.then(|| self.bank.slid_plays(self.limits).max(0.0));
        self.bank.accept();
        let slip_rate = if step > 0.0 {
            (slip - self.last.slip) / step
        } else {
            0.0
        };
        let rate = if velocity != 0.0 || step <= 0.0 {
            velocity
        } else {
            (displacement - self.last.displacement) / step
        };
        self.earlier = (step > 0.0).then_some(Earlier {
            displacement: self.last.displacement,
            slip: self.last.slip,
            step,
        });
        self.last = Situation {
            time,
            step,
            force,
            displacement,
            velocity: rate,
            slip,
            slip_rate,
            dissipation: self.last.dissipation + dissipated.unwrap_or_default(),
        };
        for (acting, memory) in self.effects.iter().zip(&mut self.memories) {
            acting.effect.remember(&acting.values, &self.last, memory);
        }
    }
}
