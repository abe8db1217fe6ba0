//! A joint driven sample by sample, in force or in displacement.

mod follow;
mod saved;
mod slopes;

pub use super::error::JointError;

use super::Joint;
use super::density::{Density, Sliders};
use super::effect::Acting;
use super::extended::{Extended, fine_cells};
use super::memory::ExactResponse;
use super::virgin::{BehindSpring, VirginCurve};

/// Which quantity is prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// Force in, displacement out.
    Force,
    /// Displacement in, force out.
    Displacement,
}

/// What the joint answers at one sample. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Output {
    /// Time [s].
    pub time: f64,
    /// Applied force F [N].
    pub force: f64,
    /// Total displacement U [m].
    pub displacement: f64,
    /// Displacement of the Iwan network u [m].
    pub slip_displacement: f64,
    /// Energy dissipated since the start [J], never falling.
    pub dissipation: f64,
    /// Power dissipated over the last step [W].
    pub dissipation_rate: f64,
    /// Energy stored and recoverable [J].
    pub stored_energy: f64,
    /// dF/dU along the direction of the last step [N/m].
    pub tangent_stiffness: f64,
}

/// A joint in motion. Owns all its state; starts virgin at zero force and displacement.
///
/// Where no effect acts the answer is exact (Masing with memory, no discretisation). Effects turn
/// the density into at most [`CELLS`] sliders (a slider set stays as it is) and each step into one
/// rising scalar equation. Effects whose parameters stand at their vanishing values are left out
/// beforehand, so that they give the baseline to the last bit.
#[derive(Debug, Clone)]
pub struct Simulation {
    response: Response,
    drive: Drive,
    series_stiffness: f64,
    fingerprint: f64,
    started: bool,
    output: Output,
}

/// Sliders that stand for a continuous density where effects act. The loss of a steady cycle is
/// then within 1e-4 of the exact one near full slip, 5e-4 at a tenth of the slip range and 3e-3 at
/// 1e-4 of it (tests/extended/cells.rs).
pub const CELLS: usize = 256;

/// Rounding of a point in time, relative to it (absolute below one second): two sums of the same
/// steps lie some units in the last place apart.
const TIME_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Time that passes from one point to another \[s\]; none where the two differ by rounding alone. A
/// step left over by rounding has a length by chance, and a rate over it would be anything.
pub fn time_passing(from: f64, to: f64) -> f64 {
    let passing = to - from;
    if passing.abs() <= TIME_ROUNDING * to.abs().max(1.0) {
        return 0.0;
    }
    passing
}

#[derive(Debug, Clone)]
enum Response {
    /// The network alone, driven by force or by its own slip.
    Network(Box<ExactResponse<Density>>),
    /// Network and spring as one curve, driven by total displacement.
    BehindSpring(Box<ExactResponse<BehindSpring<Density>>>),
    /// With effects.
    Extended(Box<Extended>),
}

impl Simulation {
    /// A virgin joint, checked against its glossary.
    ///
    /// # Errors
    /// [`JointError::OutOfRange`] and [`JointError::WrongCount`] as [`Joint::check`].
    pub fn new(joint: &Joint, drive: Drive) -> Result<Simulation, JointError> {
        Simulation::remembering(joint, drive, None)
    }

    /// A virgin joint that remembers at most `most` turning points, for hosts with a clock: its
    /// steps allocate nothing. Equal to [`Simulation::new`] to the last bit until a history asks
    /// for more; what happens then says [`ExactResponse::bounded`]. With effects the memory is the
    /// sliders' and has one size anyway.
    ///
    /// # Errors
    /// As [`Simulation::new`].
    pub fn bounded(joint: &Joint, drive: Drive, most: usize) -> Result<Simulation, JointError> {
        Simulation::remembering(joint, drive, Some(most))
    }

    fn remembering(
        joint: &Joint,
        drive: Drive,
        most: Option<usize>,
    ) -> Result<Simulation, JointError> {
        joint.check()?;
        let acting: Vec<Acting> = joint.effects.iter().filter(|a| acts(a)).cloned().collect();
        let stiffness = joint.series_stiffness;
        let response = if !acting.is_empty() {
            let sliders = sliders_of(&joint.density)?;
            let extended = Extended::new(&sliders, stiffness, &acting, drive);
            Response::Extended(Box::new(extended))
        } else if drive == Drive::Force || stiffness.is_infinite() {
            Response::Network(Box::new(exact(joint.density.clone(), most)))
        } else {
            let curve = BehindSpring {
                network: joint.density.clone(),
                series_stiffness: stiffness,
            };
            Response::BehindSpring(Box::new(exact(curve, most)))
        };
        let mut simulation = Simulation {
            response,
            drive,
            series_stiffness: stiffness,
            fingerprint: fingerprint(joint, drive),
            started: false,
            output: Output::default(),
        };
        simulation.output.tangent_stiffness = simulation.tangent_stiffness();
        Ok(simulation)
    }

    /// Takes the input [N or m] at `time` [s]; on an error the state is as before.
    ///
    /// The first call sets the clock and goes from virgin zero to the input in one monotone leg in
    /// which no time passes. Repeating time and input changes nothing; at an equal time another
    /// input is a jump: its loss has no power, and laws that ask for a rate keep their last one.
    /// Times are equal where no [`time_passing`] is.
    ///
    /// # Errors
    /// [`JointError::NotFinite`], [`JointError::TimeRunsBack`], [`JointError::BeyondFullSlip`],
    /// [`JointError::OutOfReach`].
    pub fn step(&mut self, time: f64, input: f64) -> Result<Output, JointError> {
        self.admit(time, input)?;
        let from = if self.started { self.output.time } else { time };
        if time < from {
            return Err(JointError::TimeRunsBack { from, to: time });
        }
        let step = time_passing(from, time);
        if self.started && step == 0.0 && input == self.input() {
            self.output.time = time;
            return Ok(self.output);
        }
        let before = self.output.dissipation;
        let mut output = match &mut self.response {
            Response::Network(exact) => {
                network_step(exact, self.drive, self.series_stiffness, input)?
            }
            Response::BehindSpring(exact) => {
                exact.drive_slip(input);
                Output {
                    force: exact.force(),
                    displacement: input,
                    slip_displacement: input - exact.force() / self.series_stiffness,
                    dissipation: exact.dissipation(),
                    stored_energy: exact.stored_energy(),
                    ..Output::default()
                }
            }
            Response::Extended(extended) => {
                let answer = extended.advance(time, step, input)?;
                Output {
                    force: answer.force,
                    displacement: answer.displacement,
                    slip_displacement: answer.slip,
                    dissipation: answer.dissipation,
                    stored_energy: answer.stored_energy,
                    ..Output::default()
                }
            }
        };
        output.time = time;
        output.tangent_stiffness = self.tangent_stiffness();
        // A jump takes no time: its loss has no rate.
        let rate = (output.dissipation - before) / step;
        output.dissipation_rate = if step > 0.0 && rate.is_finite() {
            rate
        } else {
            0.0
        };
        self.started = true;
        self.output = output;
        Ok(output)
    }

    /// How often the last step asked all sliders for their force, the greater part of its work with
    /// effects: [`MOST_TRIALS`](crate::joint::MOST_TRIALS) at most. None without effects, where the
    /// answer is a closed form.
    pub fn trials(&self) -> usize {
        match &self.response {
            Response::Extended(extended) => extended.trials(),
            Response::Network(_) | Response::BehindSpring(_) => 0,
        }
    }

    /// True where time matters beside the turning values: with effects.
    pub fn has_effects(&self) -> bool {
        matches!(self.response, Response::Extended(_))
    }

    /// The last answer.
    pub fn output(&self) -> Output {
        self.output
    }

    /// The last input [N or m].
    pub fn input(&self) -> f64 {
        match self.drive {
            Drive::Force => self.output.force,
            Drive::Displacement => self.output.displacement,
        }
    }

    fn tangent_stiffness(&self) -> f64 {
        match &self.response {
            Response::Network(exact) => behind(exact.tangent_stiffness(), self.series_stiffness),
            Response::BehindSpring(exact) => exact.tangent_stiffness(),
            Response::Extended(extended) => extended.tangent_stiffness(),
        }
    }
}

/// A virgin exact response, of bounded memory or not.
fn exact<C: VirginCurve>(curve: C, most: Option<usize>) -> ExactResponse<C> {
    match most {
        Some(most) => ExactResponse::bounded(curve, most),
        None => ExactResponse::new(curve),
    }
}

fn network_step(
    exact: &mut ExactResponse<Density>,
    drive: Drive,
    series_stiffness: f64,
    input: f64,
) -> Result<Output, JointError> {
    match drive {
        Drive::Force => exact.drive_force(input)?,
        Drive::Displacement => exact.drive_slip(input),
    }
    let (force, slip) = (exact.force(), exact.slip());
    let spring = force / series_stiffness;
    Ok(Output {
        force,
        displacement: slip + spring,
        slip_displacement: slip,
        dissipation: exact.dissipation(),
        stored_energy: exact.stored_energy() + 0.5 * force * spring,
        ..Output::default()
    })
}

/// Two stiffnesses in series [N/m]; the second may be infinite.
pub(super) fn behind(network: f64, series: f64) -> f64 {
    network / (1.0 + network / series)
}

/// False where every parameter that has a vanishing value stands at it.
fn acts(acting: &Acting) -> bool {
    let glossary = acting.effect.parameters();
    let mut vanishing = glossary
        .iter()
        .zip(&acting.values)
        .filter_map(|(parameter, value)| parameter.vanishes_at.map(|at| *value == at));
    // A law without a vanishing value always acts.
    vanishing
        .next()
        .is_none_or(|first| !(first && vanishing.all(|gone| gone)))
}

fn sliders_of(density: &Density) -> Result<Sliders, JointError> {
    match density {
        Density::Sliders(sliders) => Ok(sliders.clone()),
        continuous => fine_cells(continuous, CELLS),
    }
}

/// A number that changes with the joint or the drive (FNV-1a over their text, 52 bits).
fn fingerprint(joint: &Joint, drive: Drive) -> f64 {
    let text = format!("{joint:?} {drive:?}");
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    (hash >> 12) as f64
}
