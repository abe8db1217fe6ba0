//! One pass through a record: every operator, every effect at its place, one scalar equation per
//! sample. The judged channel it predicts is the simulation, so identification and simulation
//! cannot disagree.

use super::bracket::Bracket;
use super::inertia::{Carried, Inertia};
use super::lanes::Bank;
use super::operators::{Form, Operators, SHARED};
use crate::joint::effect::{Acting, Place, Situation, Trajectory};

/// Effects sorted by place, with the history they keep.
pub struct March<'a> {
    operators: &'a Operators,
    elastic: f64,
    bank: Bank,
    effects: &'a [Acting],
    memories: Vec<Vec<f64>>,
    last: Situation,
    earlier: Option<(f64, f64)>,
    /// Share of the last step: where the next one's root is looked for first.
    share: f64,
    /// Force at the last step's end, all that is beside the joint included.
    applied: f64,
    limits: (f64, f64),
    /// Where force drives: where the displacement does, its acceleration is measured.
    inertia: Inertia,
    has: [bool; 7],
    counts_energy: bool,
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
    /// d displacement / d its two earlier values, latest first: a force that follows the rate of the
    /// displacement carries a change of the model on to later samples.
    pub carried: [f64; 2],
    /// What a mass does in the step; its derivatives by the motion before are those of the displacement.
    pub(super) hauled: Carried,
}

/// Error of a step's equation, as a share of its input, that counts as none: a derivative by
/// differences of a ten-thousandth is good to a part in a million of it, even for small effects.
const PRECISE: f64 = 1e-13;

/// Rounding of a difference of displacements, as a share of one.
const ROUNDED: f64 = 1e-15;

/// Trials after which a step takes what it has.
const MOST_TRIALS: usize = 60;

fn index(place: Place) -> usize {
    place as usize
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
            has[index(acting.effect.place())] = true;
        }
        // Without such effects an operator beyond the input's range is an elastic one: the
        // dictionary has that already.
        let input_channel = match operators.form {
            Form::Play => Place::ForceChannel,
            Form::Stop => Place::DisplacementChannel,
        };
        let beyond = has[index(Place::SlipLimit)] || has[index(input_channel)];
        let reached = match beyond {
            true => &coefficients[1..],
            false => &coefficients[1..=operators.edges.len()],
        };
        let bank = Bank::new(operators.spread(reached, |c| cells == Cells::All || c != 0.0));
        let sticking = effects.iter().map(|a| a.effect.sticking(&a.values)).sum();
        let bank = bank.sticking(sticking);
        March {
            operators,
            elastic: coefficients[0],
            bank,
            effects,
            memories: effects
                .iter()
                .map(|a| vec![0.0; a.effect.memory()])
                .collect(),
            last: Situation::default(),
            earlier: None,
            share: 1.0,
            applied: 0.0,
            limits: (1.0, 1.0),
            inertia: match operators.form {
                Form::Play => Inertia::of(effects, parts),
                Form::Stop => Inertia::default(),
            },
            has,
            // Only slip limits see the energy; without effects it is what the march is asked for.
            counts_energy: effects.is_empty() || has[index(Place::SlipLimit)],
        }
    }

    /// True where a change of the model is carried on from sample to sample.
    pub(super) fn carries(&self) -> bool {
        self.follows_rates() || self.inertia.acts()
    }

    /// True where a force follows the rate.
    pub(super) fn follows_rates(&self) -> bool {
        self.has[index(Place::BesideJoint)]
    }

    /// What the judged channel gains at once per unit of each coefficient, the elastic one first; of a
    /// march with all cells.
    pub(super) fn row(&self, step: Step, row: &mut [f64]) {
        row[0] = step.share
            * match self.operators.form {
                Form::Play => self.network_force(),
                Form::Stop => self.last.slip,
            };
        let share = step.share / SHARED as f64;
        for (value, cell) in row[1..]
            .iter_mut()
            .zip(self.bank.positions().chunks_exact(SHARED))
        {
            *value = cell.iter().sum::<f64>() * share;
        }
    }

    /// Energy dissipated by the network so far [J]; counted without effects and where a slip limit
    /// acts.
    pub fn dissipation(&self) -> f64 {
        self.last.dissipation
    }

    fn network_force(&self) -> f64 {
        self.last.force - self.beside_slip(self.last.slip).0
    }

    fn beside_slip(&self, slip: f64) -> (f64, f64) {
        if !self.has[index(Place::BesideSlip)] {
            return (0.0, 0.0);
        }
        let mut sum = (0.0, 0.0);
        for (acting, memory) in self.effects.iter().zip(&self.memories) {
            if acting.effect.place() == Place::BesideSlip {
                let response = acting.effect.beside_slip(&acting.values, slip, memory);
                sum = (sum.0 + response.value, sum.1 + response.slope);
            }
        }
        sum
    }

    fn in_path(&self, force: f64, step: f64) -> (f64, f64) {
        if !self.has[index(Place::Spring)] && !self.has[index(Place::InSeries)] {
            return (0.0, 0.0);
        }
        let mut sum = (0.0, 0.0);
        for (acting, memory) in self.effects.iter().zip(&self.memories) {
            let response = match acting.effect.place() {
                Place::Spring => acting.effect.spring(&acting.values, force),
                Place::InSeries => acting.effect.in_series(&acting.values, force, step, memory),
                _ => continue,
            };
            sum = (sum.0 + response.value, sum.1 + response.slope);
        }
        sum
    }

    /// Force beside the joint and its slope d/dU at the end of a step.
    fn beside_joint(&self, displacement: f64, step: f64) -> (f64, f64, f64) {
        if !self.has[index(Place::BesideJoint)] {
            return (0.0, 0.0, 0.0);
        }
        let (velocity, [per_displacement, ..]) = self.velocity(displacement, step);
        let mut sum = (0.0, 0.0);
        for acting in self.effects {
            if acting.effect.place() == Place::BesideJoint {
                let response = acting
                    .effect
                    .beside_joint(&acting.values, displacement, velocity);
                sum = (
                    sum.0 + response.value,
                    sum.1 + response.slope + response.damping * per_displacement,
                );
            }
        }
        (sum.0, sum.1, velocity)
    }

    /// Backward difference of second order where two earlier samples are known; also d rate / dU,
    /// for this sample and the two before it.
    fn velocity(&self, displacement: f64, step: f64) -> (f64, [f64; 3]) {
        if step <= 0.0 {
            return (self.last.velocity, [0.0; 3]);
        }
        let first = (displacement - self.last.displacement) / step;
        match self.earlier {
            Some((before, length)) if length > 0.0 => {
                let previous = (self.last.displacement - before) / length;
                let weight = step / (step + length);
                let (own, oldest) = ((1.0 + weight) / step, weight / length);
                let rate = first + weight * (first - previous);
                (rate, [own, -own - oldest, oldest])
            }
            _ => (first, [1.0 / step, -1.0 / step, 0.0]),
        }
    }

    /// −d force beside the joint / d earlier displacements, from its slope at this sample.
    fn carried(&self, displacement: f64, step: f64, across_slope: f64) -> [f64; 2] {
        if across_slope == 0.0 {
            return [0.0; 2];
        }
        let (_, [own, before, oldest]) = self.velocity(displacement, step);
        match own > 0.0 {
            true => [-across_slope * before / own, -across_slope * oldest / own],
            false => [0.0; 2],
        }
    }

    /// Network output for a trial input, its tangent, the operators' trial positions.
    fn network(&mut self, input: f64) -> (f64, f64) {
        let (output, tangent) = match self.operators.form {
            Form::Play => self.bank.plays(input, self.limits),
            Form::Stop => self.bank.stops(input - self.last.slip, self.limits),
        };
        (self.elastic * input + output, self.elastic + tangent)
    }

    /// Takes one sample: the true input channel of the form, force [N] or displacement [m].
    pub fn step(&mut self, time: f64, step: f64, input: f64) -> Step {
        self.update_limits();
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
        for &input in turned {
            self.step(time, 0.0, input);
        }
        self.memories.iter_mut().for_each(|m| m.fill(0.0));
        self.earlier = None;
        self.last.dissipation = 0.0;
    }

    /// True where a mass moves with the joint.
    pub(super) fn hauls(&self) -> bool {
        self.inertia.acts()
    }

    /// Parts that a mass wants the steps of samples in.
    pub(super) fn hauling(&self) -> u32 {
        self.inertia.parts
    }

    fn update_limits(&mut self) {
        if !self.has[index(Place::SlipLimit)] {
            return;
        }
        let mut limits = (1.0, 1.0);
        for (acting, memory) in self.effects.iter().zip(&self.memories) {
            if acting.effect.place() == Place::SlipLimit {
                let limit = acting.effect.slip_limit(&acting.values, &self.last, memory);
                limits = (limits.0 * limit.positive, limits.1 * limit.negative);
            }
        }
        self.limits = limits;
    }

    fn step_force(&mut self, time: f64, step: f64, force: f64) -> Step {
        let parallel = self.has[index(Place::BesideSlip)] || self.carries();
        let mut trial = if parallel {
            self.network_force() + self.share * (force - self.applied)
        } else {
            force
        };
        let precise = PRECISE * force.abs().max(0.1 * self.range());
        let mut bracket = Bracket::new();
        let mut answer;
        let mut round = 0;
        loop {
            let (slip, tangent) = self.network(trial);
            let (beside, beside_slope) = self.beside_slip(slip);
            let joint_force = trial + beside;
            let joint_slope = 1.0 + beside_slope * tangent;
            let (path, path_slope) = self.in_path(joint_force, step);
            let displacement = slip + path;
            let displacement_slope = tangent + path_slope * joint_slope;
            let (across, across_slope, velocity) = self.beside_joint(displacement, step);
            let hauled = self.inertia.at(step, displacement);
            let error = joint_force + across + hauled.force - force;
            let slope = joint_slope + (across_slope + hauled.slope) * displacement_slope;
            answer = (slip, joint_force, displacement, velocity);
            let share = (1.0 / slope).clamp(0.0, 1.0);
            let carried = self.carried(displacement, step, across_slope);
            let next = bracket.next(trial, error, slope, 2.0 * error);
            let precise = precise.max(ROUNDED * hauled.slope * displacement.abs());
            if !parallel || error.abs() <= precise || next == trial || round >= MOST_TRIALS {
                self.share = share;
                self.applied = force;
                let taken = self.inertia.take(step, displacement);
                self.accept(time, step, answer);
                return Step {
                    force: force - hauled.force,
                    displacement,
                    share,
                    carried: carried.map(|c| c * displacement_slope * share),
                    hauled: Carried {
                        by_motion: taken.by_motion.map(|c| -c * displacement_slope * share),
                        ..taken
                    },
                };
            }
            trial = next;
            round += 1;
        }
    }

    fn step_displacement(&mut self, time: f64, step: f64, displacement: f64) -> Step {
        let path_acts = self.has[index(Place::Spring)] || self.has[index(Place::InSeries)];
        let mut trial = if path_acts {
            self.last.slip + self.share * (displacement - self.last.displacement)
        } else {
            displacement
        };
        let precise = PRECISE * displacement.abs().max(0.1 * self.range());
        let mut bracket = Bracket::new();
        let mut round = 0;
        loop {
            let (network, tangent) = self.network(trial);
            let (beside, beside_slope) = self.beside_slip(trial);
            let joint_force = network + beside;
            let joint_slope = tangent + beside_slope;
            let (path, path_slope) = self.in_path(joint_force, step);
            let error = trial + path - displacement;
            let slope = 1.0 + path_slope * joint_slope;
            let next = bracket.next(trial, error, slope, error);
            if !path_acts || error.abs() <= precise || next == trial || round >= MOST_TRIALS {
                let (across, _, velocity) = self.beside_joint(displacement, step);
                self.accept(time, step, (trial, joint_force, displacement, velocity));
                let share = (1.0 / slope).clamp(0.0, 1.0);
                self.share = share;
                return Step {
                    force: joint_force + across,
                    displacement,
                    share,
                    ..Step::default()
                };
            }
            trial = next;
            round += 1;
        }
    }

    /// Largest input that the grid was made for.
    fn range(&self) -> f64 {
        self.operators.edges.last().copied().unwrap_or(0.0)
    }

    fn accept(&mut self, time: f64, step: f64, answer: (f64, f64, f64, f64)) {
        let (slip, force, displacement, velocity) = answer;
        let dissipated = match self.operators.form {
            Form::Play if self.counts_energy => self.bank.slid_plays(self.limits),
            Form::Stop if self.counts_energy => self.bank.slid_stops(slip - self.last.slip),
            _ => 0.0,
        };
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
        self.earlier = (step > 0.0).then_some((self.last.displacement, step));
        self.last = Situation {
            time,
            step,
            force,
            displacement,
            velocity: rate,
            slip,
            slip_rate,
            dissipation: self.last.dissipation + dissipated.max(0.0),
        };
        for (acting, memory) in self.effects.iter().zip(&mut self.memories) {
            acting.effect.remember(&acting.values, &self.last, memory);
        }
    }
}

/// What the effects at one channel add to the truth, summed.
pub fn added(effects: &[Acting], place: Place, truth: &Trajectory) -> Option<Vec<f64>> {
    let mut sum: Option<Vec<f64>> = None;
    for acting in effects.iter().filter(|a| a.effect.place() == place) {
        let one = acting.effect.channel(&acting.values, truth);
        sum = Some(match sum {
            None => one,
            Some(mut all) => {
                all.iter_mut().zip(&one).for_each(|(a, b)| *a += b);
                all
            }
        });
    }
    sum
}
