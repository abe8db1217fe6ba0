//! The seven places where an effect can act on the joint, so that solvers know places and never
//! particular effects, and any set of effects composes.
//!
//! ```text
//! F ─(force channel)─┬─[beside joint: across U]──────────────────────────┬─(displacement channel)─ U
//!                    └─[in series]─[spring: K_1]─┬─ Iwan network u ──────┤
//!                                                └─[beside slip: over u]─┘
//! ```
//! with the break-free forces of the network multiplied by the slip limit.

use super::course::Course;
use super::elementary::square;
use super::parameters::Parameter;

/// Where an effect acts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Place {
    /// Multiplies the break-free forces of the network.
    SlipLimit,
    /// A force in parallel with the network, over the slip displacement u and its rate.
    BesideSlip,
    /// A force in parallel with the whole joint, over U and its rate.
    BesideJoint,
    /// A further displacement of the series spring K_1, over the joint force.
    Spring,
    /// A further displacement in the load path, over the joint force and its history.
    InSeries,
    /// What the load cell adds to the true force.
    ForceChannel,
    /// What the displacement sensor and its amplifier add to the true displacement.
    DisplacementChannel,
}

impl Place {
    /// True for the two places of the measuring chain, which never enter an exported joint.
    pub fn is_measurement(self) -> bool {
        matches!(self, Place::ForceChannel | Place::DisplacementChannel)
    }
}

/// Where an effect acts, of a law with up to three forms.
pub type Places = [Option<Place>; 3];

/// State of the joint at one sample, as an effect may see it. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Situation {
    /// Time [s]; sample number where the record has no time.
    pub time: f64,
    /// Length of the step that ends here [s]; zero at the first sample.
    pub step: f64,
    /// Force through the load path (network, spring, series elements) [N].
    pub force: f64,
    /// Total displacement U [m].
    pub displacement: f64,
    /// Rate of U [m/s].
    pub velocity: f64,
    /// Displacement of the Iwan network u [m].
    pub slip: f64,
    /// Rate of u [m/s].
    pub slip_rate: f64,
    /// Energy dissipated by the network so far [J].
    pub dissipation: f64,
}

/// Multipliers of the break-free forces, one per direction of sliding; 1 leaves them as they are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlipLimit {
    /// For sliding towards positive u.
    pub positive: f64,
    /// For sliding towards negative u.
    pub negative: f64,
}

impl SlipLimit {
    /// The limit that changes nothing.
    pub const UNCHANGED: SlipLimit = SlipLimit::either_way(1.0);

    /// The same limit for sliding either way.
    pub const fn either_way(limit: f64) -> SlipLimit {
        SlipLimit {
            positive: limit,
            negative: limit,
        }
    }
}

/// Value of a law and its derivative with respect to the law's own argument.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Force [N] or displacement [m], by place.
    pub value: f64,
    /// d value / d argument (slip, displacement or force), ≥ 0 for a stable effect.
    pub slope: f64,
    /// d value / d rate, for places beside the joint and beside the slip only.
    pub damping: f64,
}

/// A whole record as a measuring chain sees it; channels of equal length.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory {
    /// Time [s]; sample numbers where the record has no time.
    pub time: Vec<f64>,
    /// Force [N].
    pub force: Vec<f64>,
    /// Displacement [m].
    pub displacement: Vec<f64>,
    /// Length [s] of all records before this one: what happens once has one time for all of them.
    pub begins: f64,
    /// Place of the record among all, from 0.
    pub test: usize,
    /// Samples at or just before which the rate of a displacement that drives jumps, in order: no difference may reach
    /// across. None where force drives.
    pub kinks: Vec<usize>,
}

impl Trajectory {
    /// The channel that a place of the measuring chain adds to.
    pub fn channel(&self, place: Place) -> &[f64] {
        match place {
            Place::ForceChannel => &self.force,
            _ => &self.displacement,
        }
    }

    /// The displacement between the samples.
    pub fn course(&self) -> Course<'_> {
        Course {
            time: &self.time,
            values: &self.displacement,
            corners: &[],
        }
    }

    /// Frequency of the sine that moves as far and as fast as the displacement does, `rms(U̇)/rms(U)` about its
    /// mean \[rad/s\]; no number of a displacement that rests.
    pub fn frequency(&self) -> f64 {
        let count = self.displacement.len() as f64;
        let mean = self.displacement.iter().sum::<f64>() / count;
        let (mut size, mut rate) = (0.0, 0.0);
        for (time, u) in self.time.windows(2).zip(self.displacement.windows(2)) {
            let length = time[1] - time[0];
            size += square(u[0] - mean) * length;
            rate += square(u[1] - u[0]) / length;
        }
        (rate / size).sqrt()
    }
}

/// One effect: a law at one place, or of several forms at several. Values of its parameters come as a slice in the order of
/// [`Effect::parameters`]; its history lives in a slice of [`Effect::memory`] numbers that the
/// simulation owns, so that saving and restoring a simulation needs nothing from the effect.
pub trait Effect: Send + Sync {
    /// Contract name, e.g. `pinning`.
    fn name(&self) -> &'static str;
    /// Where it acts.
    fn place(&self) -> Place;
    /// Where it acts with these values, of a law that has other forms at other places.
    fn places(&self, _values: &[f64]) -> Places {
        [Some(self.place()), None, None]
    }
    /// Glossary of its parameters.
    fn parameters(&self) -> &'static [Parameter];
    /// True where the sign of a value tells a side: what is on the other side of zero is another
    /// model, and no small step leads there.
    fn keeps_side(&self, _parameter: usize) -> bool {
        false
    }
    /// True where the answer follows a value in many small jumps, as of contacts that let go one by
    /// one: its slope is told by wide differences, and a search goes on in strides.
    fn jumps_with(&self, _parameter: usize) -> bool {
        false
    }
    /// Count of numbers of history it keeps.
    fn memory(&self) -> usize {
        0
    }
    /// Count of the first numbers of its history that last where the joint is at rest and a new record begins: wear.
    fn lasting(&self) -> usize {
        0
    }
    /// True of an effect whose history lasts: it wears the joint.
    fn wears(&self) -> bool {
        self.lasting() > 0
    }
    /// Takes an accepted sample into the history.
    fn remember(&self, _values: &[f64], _now: &Situation, _memory: &mut [f64]) {}
    /// [`Place::SlipLimit`]: multipliers from the history and the last accepted situation; under a prescribed force its
    /// force and displacement are those [foretold](super::outlook) for the end of the step.
    fn slip_limit(&self, _values: &[f64], _last: &Situation, _memory: &[f64]) -> SlipLimit {
        SlipLimit::UNCHANGED
    }
    /// [`Place::SlipLimit`]: true where the limit follows what the network has dissipated, which a march then counts.
    fn sees_energy(&self) -> bool {
        true
    }
    /// [`Place::SlipLimit`]: share by which each contact of the network that rests holds more than
    /// once it slides, see [`sticking`](super::sticking).
    fn sticking(&self, _values: &[f64]) -> f64 {
        0.0
    }
    /// [`Place::BesideSlip`]: force [N] over slip u [m] and its rate [m/s].
    fn beside_slip(&self, _values: &[f64], _slip: (f64, f64), _memory: &[f64]) -> Response {
        Response::default()
    }
    /// [`Place::BesideJoint`]: force [N] over displacement U [m] and velocity [m/s].
    fn beside_joint(&self, _values: &[f64], _displacement: f64, _velocity: f64) -> Response {
        Response::default()
    }
    /// [`Place::Spring`]: displacement [m] beyond F/K_1, over force [N].
    fn spring(&self, _values: &[f64], _force: f64) -> Response {
        Response::default()
    }
    /// [`Place::InSeries`]: further displacement [m] over force [N] at the end of a step [s].
    fn in_series(&self, _values: &[f64], _force: f64, _step: f64, _memory: &[f64]) -> Response {
        Response::default()
    }
    /// Energy the law can give back in an accepted situation, after [`Effect::remember`] \[J\].
    /// `None` for a law whose value depends on its argument alone: the simulation integrates it.
    /// A law with creep or other loss of its own says here what it keeps; the rest is dissipated.
    fn stored_energy(&self, _values: &[f64], _now: &Situation, _memory: &[f64]) -> Option<f64> {
        None
    }
    /// [`Place::DisplacementChannel`]: time by which the channel comes late, of an effect that does nothing
    /// else to it \[s\]. Where force drives the joint is marched as late.
    fn lateness(&self, _values: &[f64]) -> Option<f64> {
        None
    }
    /// [`Place::ForceChannel`]: mass whose acceleration the cell reads beside the joint's force, of an effect that
    /// does nothing else to it \[kg\]. Where force drives it moves with the joint.
    fn inertia(&self, _values: &[f64]) -> Option<f64> {
        None
    }
    /// [`Place::ForceChannel`]: what it adds to the force on a joint whose motion a march gave, free of noise.
    fn in_turns(&self, values: &[f64], truth: &Trajectory) -> Vec<f64> {
        self.channel(values, Place::ForceChannel, truth)
    }
    /// [`Place::ForceChannel`]: such a mass that follows the joint's motion and rings with nothing \[kg\].
    fn driven(&self, _values: &[f64]) -> Option<f64> {
        None
    }
    /// [`Place::ForceChannel`]: true where what it adds follows the motion, which a march has to give first, and not
    /// the force alone.
    fn follows_motion(&self) -> bool {
        false
    }
    /// Either channel: true where what it adds follows the reading alone, whenever that was.
    fn follows_reading(&self) -> bool {
        false
    }
    /// [`Place::ForceChannel`], [`Place::DisplacementChannel`]: what the chain *adds* to the true
    /// channel at this place, one number per sample (measured = true + added).
    fn channel(&self, _values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
        vec![0.0; truth.time.len()]
    }
}

/// An effect with the values of its parameters.
#[derive(Clone)]
pub struct Acting {
    /// The law.
    pub effect: &'static dyn Effect,
    /// Values in the order of its glossary.
    pub values: Vec<f64>,
}

impl Acting {
    /// Where it acts with its values.
    pub fn places(&self) -> impl Iterator<Item = Place> + use<> {
        self.effect.places(&self.values).into_iter().flatten()
    }

    /// Count of its values that are not neutral; of a law with forms elsewhere one more for that beside the slip, for whose
    /// sake the spring behind it is told apart.
    pub fn free(&self) -> usize {
        let both = self.effect.parameters().iter().zip(&self.values);
        let values = both.filter(|(p, value)| p.neutral != Some(**value)).count();
        values + usize::from(self.splits_spring())
    }

    /// True of a law with forms elsewhere that acts beside the slip.
    pub fn splits_spring(&self) -> bool {
        self.acts_at(Place::BesideSlip) && self.effect.place() != Place::BesideSlip
    }

    /// True where it acts at this place.
    pub fn acts_at(&self, place: Place) -> bool {
        self.places().any(|own| own == place)
    }
}

impl std::fmt::Debug for Acting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}{:?}", self.effect.name(), self.values)
    }
}

impl PartialEq for Acting {
    fn eq(&self, other: &Self) -> bool {
        self.effect.name() == other.effect.name() && self.values == other.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frequency_of_a_motion_is_that_of_its_sine_wherever_it_is_about() {
        let expected = 4.8;
        let time: Vec<f64> = (0..=3000)
            .map(|i| 0.01 * std::f64::consts::TAU / expected * f64::from(i))
            .collect();
        let motion = Trajectory {
            displacement: time
                .iter()
                .map(|t| 3.0 + 2.0 * (expected * t).sin())
                .collect(),
            time,
            ..Trajectory::default()
        };
        let found = motion.frequency();
        // A chord is shorter than its arc by x²/24, 1.6e-4.
        assert!((found / expected - 1.0).abs() < 2e-4, "{found}");
    }
}
