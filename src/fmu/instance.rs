//! One instance: a joint with its parameters, its place in the call order, its motion.

use super::bundle::Bundle;
use super::calls::Mode;
use super::derivatives::Rates;
use super::logger::{Category, Host, Messenger, Standard};
use super::refusal::Refusal;
use super::stepping::InputDerivatives;
use crate::joint::{Drive, Joint, Simulation};
use crate::variables::Variables;

/// Turning points that an instance remembers: a ring-down of 2000 cycles finds room, in 128 KiB.
/// What happens beyond is said at [`ExactResponse::bounded`](crate::joint::ExactResponse::bounded).
pub const TURNING_POINTS: usize = 4096;

/// One instance of the exported joint. Owns all it uses; nothing is shared between instances.
#[derive(Debug)]
pub struct Instance {
    pub(super) mode: Mode,
    pub(super) messenger: Messenger,
    /// The joint as exported.
    pub(super) exported: Joint,
    pub(super) drive: Drive,
    pub(super) guid: String,
    pub(super) variables: Variables,
    /// Values of the parameters as the host has set them, in the order of the variables. They
    /// become a joint together, so that no order of setting them is wrong.
    pub(super) parameters: Vec<f64>,
    pub(super) motion: Motion,
}

/// What changes with time.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Communication point \[s\].
    pub time: f64,
    /// End of the experiment \[s\], where the host has told it.
    pub stop: Option<f64>,
    /// The input as last set [N or m].
    pub input: f64,
    /// Its time derivatives for the next step.
    pub derivatives: InputDerivatives,
    /// The joint in motion; `None` before initialization, and during it after a change.
    pub simulation: Option<Simulation>,
    /// Mean power dissipated over the last communication step \[W\].
    pub dissipation_rate: f64,
    /// Length of the last communication step \[s\].
    pub step: f64,
    /// Time derivatives of the answers at its end.
    pub rates: Rates,
}

impl Motion {
    fn at_rest() -> Motion {
        Motion {
            time: 0.0,
            stop: None,
            input: 0.0,
            derivatives: InputDerivatives::NONE,
            simulation: None,
            dissipation_rate: 0.0,
            step: 0.0,
            rates: Rates::default(),
        }
    }
}

impl Instance {
    /// A fresh instance of the archive's joint.
    pub fn new(bundle: Bundle, name: &str, host: Host, debug: bool) -> Result<Instance, Refusal> {
        let variables = Variables::of(&bundle.joint, bundle.drive)?;
        Ok(Instance {
            mode: Mode::Instantiated,
            messenger: Messenger::new(host, name, debug),
            parameters: variables.values(&bundle.joint),
            variables,
            exported: bundle.joint,
            drive: bundle.drive,
            guid: bundle.guid,
            motion: Motion::at_rest(),
        })
    }

    /// Where the instance stands in the call order.
    pub fn mode(&self) -> Mode {
        self.mode
    }

    /// The way to the host's log.
    pub fn messenger(&self) -> &Messenger {
        &self.messenger
    }

    /// What the host speaks.
    pub(super) fn standard(&self) -> Standard {
        self.messenger.standard()
    }

    /// Tells an event, where the host wants to know.
    pub(super) fn tell(&self, text: &str) {
        self.messenger
            .tell(super::Status::Ok, Category::Event, text);
    }

    /// After a defect: nothing of the motion is trusted any more.
    pub fn break_down(&mut self) {
        self.mode = Mode::Broken;
        self.motion = Motion::at_rest();
    }

    /// Switches debug logging; the categories named must exist, and none means all.
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Result<(), Refusal> {
        let mut events = categories.is_empty();
        for &name in categories {
            let category = Category::find(name).ok_or_else(|| Refusal::Category {
                came: name.to_owned(),
            })?;
            events |= category == Category::Event;
        }
        self.messenger.debug = on && events;
        Ok(())
    }

    /// Takes start and stop time \[s\] of the experiment.
    pub fn setup_experiment(&mut self, start: f64, stop: Option<f64>) -> Result<(), Refusal> {
        let stop_is_fine = stop.is_none_or(|stop| stop.is_finite() && stop >= start);
        if !start.is_finite() || !stop_is_fine {
            return Err(Refusal::Times { start, stop });
        }
        self.motion.time = start;
        self.motion.stop = stop;
        Ok(())
    }

    /// Begins initialization.
    pub fn enter_initialization(&mut self) -> Result<(), Refusal> {
        self.mode = Mode::Initialization;
        Ok(())
    }

    /// Ends initialization: from here on parameters are fixed and the joint moves.
    pub fn exit_initialization(&mut self) -> Result<(), Refusal> {
        self.initial()?;
        self.mode = Mode::Stepping;
        self.tell("initialized: the joint moves from virgin under the input at the start time");
        Ok(())
    }

    /// The joint at the start time: virgin, then under the input. Made anew after every change of
    /// a parameter, of the input or of the start time.
    pub fn initial(&mut self) -> Result<&Simulation, Refusal> {
        let simulation = match self.motion.simulation.take() {
            Some(simulation) => simulation,
            None => {
                let mut simulation = self.virgin(&self.parameters)?;
                simulation.step(self.motion.time, self.motion.input)?;
                simulation
            }
        };
        Ok(self.motion.simulation.insert(simulation))
    }

    /// A joint with these parameters that has not moved yet.
    pub(super) fn virgin(&self, parameters: &[f64]) -> Result<Simulation, Refusal> {
        let joint = self.variables.apply(&self.exported, parameters)?;
        Ok(Simulation::bounded(&joint, self.drive, TURNING_POINTS)?)
    }

    /// Ends the experiment; the last values stay readable.
    pub fn terminate(&mut self) -> Result<(), Refusal> {
        self.mode = Mode::Terminated;
        self.tell("terminated");
        Ok(())
    }

    /// Back to what fmi2Instantiate gave: exported parameters, virgin joint.
    pub fn reset(&mut self) -> Result<(), Refusal> {
        self.parameters = self.variables.values(&self.exported);
        self.motion = Motion::at_rest();
        self.mode = Mode::Instantiated;
        self.tell("reset");
        Ok(())
    }
}
