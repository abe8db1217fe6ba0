//! What operators at rest remember of a change of the model: one that moves their input stays where they last slipped.

use super::march::{March, Step};
use super::operators::{Form, SHARED};

/// Derivatives, by every coefficient, of what the operators at rest hold on to.
///
/// Where something acts beside the joint or in its load path, a change of the dictionary moves the network's input x.
/// A play that slips follows at once, which the tangent of a step's equation counts; one at rest keeps dx of the step
/// in which it slipped last. A stop that follows the input counts from where it slipped last, so it lacks that dx.
/// Operators that came to rest in one step remember the same: a step costs as many columns as such groups change.
#[derive(Debug, Clone, Default)]
pub(super) struct Remembered {
    /// Positions, as plays, after the last step.
    positions: Vec<f64>,
    /// The operators that have a weight.
    held: Vec<Held>,
    groups: Vec<Group>,
    /// Σ c_i dx_i over those at rest, by coefficient.
    sum: Vec<f64>,
    /// dx after the last step, by coefficient.
    input: Vec<f64>,
}

/// An operator that has a weight.
#[derive(Debug, Clone, Copy)]
struct Held {
    place: usize,
    weight: f64,
    state: State,
}

/// State of an operator.
#[derive(Debug, Clone, Copy, PartialEq)]
enum State {
    /// At rest since the record began: remembers nothing.
    Virgin,
    /// It slipped in the last step.
    Slips,
    /// At rest, with the others of a group.
    Rests(usize),
}

/// Operators that came to rest in one step.
#[derive(Debug, Clone, Default)]
struct Group {
    input: Vec<f64>,
    members: usize,
    /// What Σ c_i of its members changes by in the step at hand.
    change: f64,
}

/// The operators with a weight, of so many that share the coefficients of the cells.
fn held(cells: &[f64], operators: usize) -> Vec<Held> {
    let weight = |place: usize| cells.get(place / SHARED).map_or(0.0, |c| c / SHARED as f64);
    let all = (0..operators).map(|place| Held {
        place,
        weight: weight(place),
        state: State::Virgin,
    });
    all.filter(|one| one.weight != 0.0).collect()
}

impl Remembered {
    /// Takes the operators to the end of a step: adds to their outputs per coefficient what those at rest remember.
    pub fn add(&mut self, march: &March, outputs: &mut [f64]) {
        let positions = march.positions();
        if self.positions.is_empty() {
            self.held = held(march.cells(), positions.len());
            self.sum = vec![0.0; outputs.len()];
            self.input = vec![0.0; outputs.len()];
        } else {
            self.follow(march);
        }
        self.positions.clear();
        self.positions.extend_from_slice(positions);
        let sign = match march.form() {
            Form::Play => 1.0,
            Form::Stop => -1.0,
        };
        let both = outputs.iter_mut().zip(&self.sum);
        both.for_each(|(output, sum)| *output += sign * sum);
    }

    /// Ends the step: from what the outputs and the judged channel gain, what the network's input does.
    pub fn end(&mut self, step: Step, outputs: &[f64], judged: &[f64]) {
        let [by_judged, by_output] = step.input;
        let both = outputs.iter().zip(judged);
        for (input, (output, judged)) in self.input.iter_mut().zip(both) {
            *input = by_judged * judged + by_output * output;
        }
    }

    fn follow(&mut self, march: &March) {
        let positions = march.positions();
        let mut rested = None;
        for k in 0..self.held.len() {
            let Held {
                place,
                weight,
                state,
            } = self.held[k];
            let (now, before) = (positions[place], self.positions[place]);
            let next = match (now != before, state) {
                (true, State::Rests(group)) => {
                    self.groups[group].members -= 1;
                    self.groups[group].change -= weight;
                    State::Slips
                }
                (true, State::Virgin) => State::Slips,
                (false, State::Slips) => {
                    let group = *rested.get_or_insert_with(|| self.begin());
                    self.groups[group].members += 1;
                    self.groups[group].change += weight;
                    State::Rests(group)
                }
                (true, State::Slips) | (false, _) => continue,
            };
            self.held[k].state = next;
        }
        for group in self.groups.iter_mut().filter(|g| g.change != 0.0) {
            let both = self.sum.iter_mut().zip(&group.input);
            both.for_each(|(sum, input)| *sum += group.change * input);
            group.change = 0.0;
        }
    }

    /// A group of operators that came to rest in this step, in the place of one that is empty.
    fn begin(&mut self) -> usize {
        let empty = |g: &Group| g.members == 0 && g.change == 0.0;
        let place = self.groups.iter().position(empty);
        let place = place.unwrap_or_else(|| {
            self.groups.push(Group::default());
            self.groups.len() - 1
        });
        self.groups[place].input.clone_from(&self.input);
        place
    }
}
