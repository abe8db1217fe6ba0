//! Is the importer's step fine enough for a load? What the dissipation loses by it.

use super::load::Load;
use crate::joint::{Drive, Joint, JointError, Simulation};

/// Dissipation lost beyond which a step is called too coarse: a hundredth is what a careful test
/// repeats to.
pub const TOO_COARSE: f64 = 0.01;
/// A turning counts as one of a cycle when the input came this share of its range to it.
const GATE: f64 = 0.05;
/// Multiples of the record's own sampling that are tried.
const MULTIPLES: [f64; 4] = [2.0, 5.0, 10.0, 20.0];
/// Where in the first step the communication points may begin: whether they meet the turning values
/// is chance, and the worst is told.
const PHASES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
/// A slope is so many times that of the step nearer to a round top, at least: twice for a parabola, 1.4
/// times for a sine of eight samples per cycle.
const ROUND: f64 = 1.25;
/// Fewer samples per cycle than this, and the turning values between them are anyone's guess.
const FEWEST_PER_CYCLE: f64 = 8.0;

/// Parts that a step of the record is cut into at most where effects act, and steps that makes at most.
const FINEST: usize = 16;
const MOST_STEPS: usize = 2_000_000;
/// Steps that the judged one may make of the record: half an hour at 10 kHz, some seconds of work
/// without effects and minutes with them.
pub const MOST_JUDGED: f64 = 2e7;

/// Origin of the record's own step.
const SAMPLES: &str = "the samples themselves";

/// One communication step and what it does.
#[derive(Debug, Clone, PartialEq)]
pub struct StepEffect {
    /// Where it comes from.
    pub origin: String,
    /// Communication step \[s\].
    pub step: f64,
    /// Communication points in the record's shortest cycle.
    pub per_cycle: f64,
    /// Dissipated over the whole load \[J\], at the worst of four beginnings.
    pub dissipation: f64,
    /// Share of the dissipation that is then lost; negative where some is gained.
    pub lost: f64,
}

/// What the load asks of the importer's step.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    /// Shortest cycle of the load \[s\]; `None` where it never turns twice.
    pub shortest_cycle: Option<f64>,
    /// Dissipation with the turning values between the samples put back, and at vanishing steps \[J\].
    pub reference: f64,
    /// By step, from the finest.
    pub effects: Vec<StepEffect>,
    /// The step that is judged: the one asked for, or the archive's own.
    pub judged: StepEffect,
    /// The coarsest step tried that loses less than [`TOO_COARSE`] \[s\].
    pub advised: Option<f64>,
}

impl Steps {
    /// Simulates the load with the turning values between its samples, as sampled, at the judged
    /// step and at multiples of the sampling. The input between samples is the straight line, as
    /// importers interpolate.
    ///
    /// # Errors
    /// What the joint says to the load.
    pub fn of(
        joint: &Joint,
        drive: Drive,
        load: &Load,
        (judged, origin): (f64, &str),
    ) -> Result<Steps, JointError> {
        let (first, last) = (load.time[0], load.time[load.time.len() - 1]);
        let sampling = (last - first) / (load.time.len() - 1).max(1) as f64;
        let shortest_cycle = shortest_cycle(load);
        let reference = reference(joint, drive, &with_turning_values(load))?;
        let effect = |origin: &str, step: f64, dissipation: f64| StepEffect {
            origin: origin.to_owned(),
            step,
            per_cycle: shortest_cycle.unwrap_or(last - first) / step,
            dissipation,
            lost: if reference > 0.0 {
                1.0 - dissipation / reference
            } else {
                0.0
            },
        };
        let own = effect(SAMPLES, sampling, dissipation(joint, drive, load)?);
        let worst = |step: f64| -> Result<f64, JointError> {
            let mut worst = reference;
            for phase in PHASES {
                let came = dissipation(joint, drive, &resampled(load, step, phase))?;
                if (came - reference).abs() >= (worst - reference).abs() {
                    worst = came;
                }
            }
            Ok(worst)
        };
        let judged = effect(origin, judged, worst(judged)?);
        let mut effects = vec![own, judged.clone()];
        for multiple in MULTIPLES {
            let step = multiple * sampling;
            effects.push(effect(
                &format!("every {multiple} samples"),
                step,
                worst(step)?,
            ));
        }
        effects.sort_by(|a, b| a.step.total_cmp(&b.step));
        // Nothing coarser than the first step that loses too much is advised, even where chance
        // put its points on the turning values.
        let fine = effects.iter().take_while(|e| e.lost.abs() <= TOO_COARSE);
        let advised = fine.last().map(|e| e.step);
        Ok(Steps {
            shortest_cycle,
            reference,
            effects,
            judged,
            advised,
        })
    }

    /// True where the judged step loses (or invents) more than [`TOO_COARSE`] of the dissipation.
    pub fn too_coarse(&self) -> bool {
        self.judged.lost.is_nan() || self.judged.lost.abs() > TOO_COARSE
    }

    /// True where the record itself is sampled so coarsely that the reference is a guess.
    pub fn record_too_coarse(&self) -> bool {
        let own = self.effects.iter().find(|e| e.origin == SAMPLES);
        own.is_some_and(|own| own.per_cycle < FEWEST_PER_CYCLE)
    }
}

/// Dissipated over a load at vanishing steps \[J\].
///
/// A joint without effects answers exactly at any step. Effects follow what the joint did up to the
/// last communication point, an error of first order in the step: `D ≈ 2 D(h/2) − D(h)`.
fn reference(joint: &Joint, drive: Drive, load: &Load) -> Result<f64, JointError> {
    if joint.effects.is_empty() {
        return dissipation(joint, drive, load);
    }
    let parts = (MOST_STEPS / load.time.len().max(1)).clamp(2, FINEST);
    let coarse = dissipation(joint, drive, &subdivided(load, parts / 2))?;
    let fine = dissipation(joint, drive, &subdivided(load, parts))?;
    Ok(2.0 * fine - coarse)
}

/// The load with every step cut into equal parts, the input going straight.
fn subdivided(load: &Load, parts: usize) -> Load {
    let points = |values: &[f64]| -> Vec<f64> {
        let steps = values.windows(2);
        let inside = steps.flat_map(|two| {
            let (from, way) = (two[0], two[1] - two[0]);
            (0..parts).map(move |part| from + way * part as f64 / parts as f64)
        });
        inside.chain(values.last().copied()).collect()
    };
    Load {
        time: points(&load.time),
        input: points(&load.input),
        answer: None,
    }
}

/// Dissipated over a load \[J\].
fn dissipation(joint: &Joint, drive: Drive, load: &Load) -> Result<f64, JointError> {
    let mut simulation = Simulation::new(joint, drive)?;
    let mut dissipated = 0.0;
    for (time, input) in load.time.iter().zip(&load.input) {
        dissipated = simulation.step(*time, *input)?.dissipation;
    }
    Ok(dissipated)
}

/// The load at equal steps after a first one of this share, on straight lines between its samples,
/// with its end.
fn resampled(load: &Load, step: f64, phase: f64) -> Load {
    let (first, last) = (load.time[0], load.time[load.time.len() - 1]);
    let begin = first + phase * step;
    let count = ((last - begin) / step * (1.0 + 1e-12)).floor();
    let mut time = vec![first];
    if count >= 0.0 {
        time.extend((0..=count as usize).map(|k| begin + k as f64 * step));
    }
    // A rest shorter than rounding is no step.
    if time.last().is_some_and(|end| last - end > 1e-9 * step) {
        time.push(last);
    }
    let mut row = 1;
    let input = time.iter().map(|&at| {
        while row + 1 < load.time.len() && load.time[row] < at {
            row += 1;
        }
        let (t0, t1) = (load.time[row - 1], load.time[row]);
        let (x0, x1) = (load.input[row - 1], load.input[row]);
        x0 + (x1 - x0) * ((at - t0) / (t1 - t0)).clamp(0.0, 1.0)
    });
    Load {
        input: input.collect(),
        time,
        answer: None,
    }
}

/// The load with the top of the parabola through three samples wherever the middle one is the
/// largest or the smallest: the turning values that fell between samples. Of two equal samples the
/// first is the middle one, where the load is round there.
fn with_turning_values(load: &Load) -> Load {
    let mut fine = Load {
        time: vec![load.time[0]],
        input: vec![load.input[0]],
        answer: None,
    };
    for row in 1..load.time.len() {
        let sample = |row: usize| Some((*load.time.get(row)?, *load.input.get(row)?));
        let before = (load.time[row - 1], load.input[row - 1]);
        let middle = (load.time[row], load.input[row]);
        let turns = |next: &(f64, f64)| {
            let (rise, fall) = (middle.1 - before.1, next.1 - middle.1);
            rise * fall < 0.0 || fall == 0.0 && round_at_pair(load, row)
        };
        let next = sample(row + 1).filter(turns);
        let top = next.and_then(|next| top(before, middle, next));
        let before = top.filter(|top| top.0 < middle.0);
        let after = top.filter(|top| top.0 > middle.0);
        for (time, input) in before.into_iter().chain([middle]).chain(after) {
            // The top after one sample may be the top before the next.
            if fine.time.last().is_none_or(|last| time > *last) {
                fine.time.push(time);
                fine.input.push(input);
            }
        }
    }
    fine
}

/// True where the load slows towards the equal samples `row` and `row + 1` and comes away from them
/// faster and faster, as at a round top; a ramp that ends in a rest has none.
fn round_at_pair(load: &Load, row: usize) -> bool {
    let slope = |from: usize| {
        let way = load.input.get(from + 1)? - load.input.get(from)?;
        Some(way / (load.time.get(from + 1)? - load.time.get(from)?))
    };
    let to = row
        .checked_sub(2)
        .and_then(|first| Some((slope(first)?, slope(first + 1)?)));
    let away = slope(row + 2).zip(slope(row + 1));
    to.zip(away).is_some_and(|((far, near), (gone, going))| {
        near * going < 0.0 && far / near >= ROUND && gone / going >= ROUND
    })
}

/// Extremum of the parabola through three points of which none is beyond the middle one.
fn top(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> Option<(f64, f64)> {
    let (rise, fall) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
    let curvature = (fall - rise) / (c.0 - a.0);
    let slope = (rise * (c.0 - b.0) + fall * (b.0 - a.0)) / (c.0 - a.0);
    let shift = -slope / (2.0 * curvature);
    let found = (b.0 + shift, b.1 + slope * shift / 2.0);
    (found.0 > a.0 && found.0 < c.0 && found.0 != b.0).then_some(found)
}

/// Least time from a turning to the next but one, turnings by less than [`GATE`] of the range not
/// counted.
fn shortest_cycle(load: &Load) -> Option<f64> {
    let low = load.input.iter().copied().fold(f64::INFINITY, f64::min);
    let high = load.input.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let gate = GATE * (high - low);
    let mut turnings = Vec::new();
    let mut extreme = (load.time[0], load.input[0]);
    let mut direction = 0.0;
    for (&time, &input) in load.time.iter().zip(&load.input) {
        let beyond = (input - extreme.1) * direction;
        if direction == 0.0 && (input - extreme.1).abs() > gate {
            direction = (input - extreme.1).signum();
            extreme = (time, input);
        } else if beyond >= 0.0 && direction != 0.0 {
            extreme = (time, input);
        } else if beyond < -gate {
            turnings.push(extreme.0);
            direction = -direction;
            extreme = (time, input);
        }
    }
    let cycles = turnings.windows(3).map(|three| three[2] - three[0]);
    cycles.reduce(f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint::{Density, PowerLaw};

    fn joint() -> Joint {
        let density = PowerLaw::new(4.0, 0.0, 0.5, 10.0, 1000.0).unwrap();
        Joint::new(Density::PowerLaw(density), f64::INFINITY, Vec::new()).unwrap()
    }

    /// Six periods of a sine whose tops lie where the phase puts them between samples.
    fn sine(per_cycle: usize, phase: f64) -> Load {
        let time: Vec<f64> = (0..=per_cycle * 6)
            .map(|i| i as f64 / per_cycle as f64)
            .collect();
        let input = time
            .iter()
            .map(|t| (std::f64::consts::TAU * t + phase).sin() * 0.7);
        Load {
            input: input.collect(),
            time,
            answer: None,
        }
    }

    /// A held sine loses 1.3 % at 20 samples per cycle, 0.21 % at 50 and 0.05 % at 100, in the mean
    /// over the places of its tops between samples; the tops put back, next to nothing.
    #[test]
    fn the_loss_is_that_of_the_theory() {
        const PLACES: usize = 16;
        for (per_cycle, mean) in [(20, 0.013), (50, 0.0021), (100, 0.0005)] {
            let (mut lost, mut left) = (0.0, 0.0);
            for place in 0..PLACES {
                let shift = place as f64 / (PLACES * per_cycle) as f64;
                let phase = 0.7 + std::f64::consts::TAU * shift;
                let run = |load: &Load| dissipation(&joint(), Drive::Force, load).unwrap();
                let exact = run(&sine(5000, phase));
                let held = sine(per_cycle, phase);
                lost += (1.0 - run(&held) / exact) / PLACES as f64;
                left += (1.0 - run(&with_turning_values(&held)) / exact).abs() / PLACES as f64;
            }
            // the printed means have two digits
            assert!((lost / mean - 1.0).abs() < 0.15, "{per_cycle}: {lost}");
            assert!(left < 0.05 * lost, "{per_cycle}: {left} of {lost}");
        }
    }

    #[test]
    fn a_coarse_step_is_told_from_a_fine_one() {
        let load = sine(200, 0.7);
        let judge = |step| Steps::of(&joint(), Drive::Force, &load, (step, "asked for")).unwrap();
        let fine = judge(0.005);
        assert!(!fine.too_coarse(), "{fine:?}");
        let coarse = judge(0.11);
        assert!(coarse.too_coarse(), "{coarse:?}");
        let advised = coarse.advised.expect("a step that will do");
        assert!(!judge(advised).too_coarse());
        assert!((coarse.shortest_cycle.unwrap() - 1.0).abs() < 0.02);
        assert!(!fine.record_too_coarse());
        let rough = Steps::of(&joint(), Drive::Force, &sine(5, 0.7), (0.2, "asked for")).unwrap();
        assert!(rough.record_too_coarse());
    }
}
