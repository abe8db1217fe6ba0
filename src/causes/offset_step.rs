//! `offset_step`: a reading jumps once.

use super::{Cause, Page, Scale, chain};
use crate::joint::effect::{Effect, Place, Places, Trajectory};
use crate::joint::elementary::{exp, hypot, log, tanh};
use crate::joint::parameters::Parameter;

/// The sensor's zero moves by a height at a time, `U_meas = U + (h/2)[1 + tanh(2 (t − t_0)/w)]`,
/// over a length `w = T exp(−p)` of a record of length T, and no less than a sample; or the load cell's,
/// by a height `H`.
///
/// A refit that begins with a slow jump finds its time from afar; the logarithm keeps it from
/// sharpening faster than it comes near.
pub struct OffsetStep;

/// A jump over a twelfth of the record; a longer one is a drift.
const SLOWEST: f64 = 2.5;

static PARAMETERS: [Parameter; 4] = [
    Parameter {
        name: "height",
        symbol: "h",
        unit: "m",
        lower: -1e12,
        upper: 1e12,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "displacement by which the reading jumps",
    },
    Parameter {
        name: "time",
        symbol: "t_0",
        unit: "s",
        lower: 0.0,
        upper: 1e9,
        vanishes_at: None,
        neutral: None,
        meaning: "time of the jump, counted through the records one after another",
    },
    Parameter {
        name: "sharpness",
        symbol: "p",
        unit: "1",
        lower: SLOWEST,
        upper: SHARPEST,
        vanishes_at: None,
        neutral: None,
        meaning: "natural logarithm of the record's length over that of the jump",
    },
    Parameter {
        name: "cell_height",
        symbol: "H",
        unit: "N",
        lower: -1e9,
        upper: 1e9,
        vanishes_at: Some(0.0),
        neutral: Some(0.0),
        meaning: "force by which the reading of the load cell jumps",
    },
];

impl Effect for OffsetStep {
    fn name(&self) -> &'static str {
        "offset_step"
    }
    fn place(&self) -> Place {
        Place::DisplacementChannel
    }
    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }
    fn places(&self, values: &[f64]) -> Places {
        chain::places(values[0] != 0.0, values[3] != 0.0)
    }
    fn channel(&self, values: &[f64], place: Place, truth: &Trajectory) -> Vec<f64> {
        let Some((middle, width)) = jump(values, truth) else {
            return Vec::new();
        };
        let share = |t: &f64| 0.5 + 0.5 * tanh(2.0 * (t - middle) / width);
        // A reading is set to zero before each record: it does not begin with the jump of one before it.
        let before = truth.time.first().map_or(0.0, share);
        let height = values[chain::first(place, 3)];
        let times = truth.time.iter();
        times.map(|t| height * (share(t) - before)).collect()
    }
}

/// A jump that is over before the next sample.
const SHARPEST: f64 = 16.0;

/// Samples over which a jump goes that is looked for at a step that stands out: sharper, its time could
/// not be moved.
const BEGUN: f64 = 4.0;

/// Starts of a search over all records together, beside those at steps that stand out.
const MOST_STARTS: usize = 24;

/// Time of the middle of the jump on the record's own clock and its length \[s\]; `None` in a record
/// without samples. A jump in another record is before this one's start or behind its end.
fn jump(values: &[f64], truth: &Trajectory) -> Option<(f64, f64)> {
    let (start, end) = (truth.time.first()?, truth.time.last()?);
    let sample = (end - start) / truth.time.len() as f64;
    let length = (end - start) * exp(-values[2]);
    let width = hypot(length, sample).max(f64::MIN_POSITIVE);
    Some((start + values[1] - truth.begins, width))
}

/// Share of the record's length by which the time of a jump may be wrong.
const ABOUT: f64 = 0.005;

/// Rise of the highest force yet, as a share of the highest of all, that a specimen may settle under.
const HIGHER: f64 = 0.03;

impl Cause for OffsetStep {
    fn page(&self) -> Page {
        Page {
            happens: "A target, clip or cable is knocked, a counter misses pulses or a range is switched: the zero of the displacement, or of the load cell, moves at once and stays.",
            sign: "Loops before and after are the same in shape and apart by a constant; the jump takes no more than a moment and needs no force.",
            mistaken_for: &["displacement_drift", "running_in", "creep", "preload_loss"],
            separated_by: "Repeated equal blocks: a drift goes on at a steady rate, this is done at once; stiffness and area stay as they were. A specimen that settles at a force peak is told by its time at the peak.",
            formula: "U_measured = U + (h/2) [1 + tanh(2 (t - t_0)/w)], w = T exp(-p); or so of the load cell, with H",
            source: "Step change of a sensor's zero.",
        }
    }
    fn effect(&self) -> &'static dyn Effect {
        &OffsetStep
    }
    fn needs_time(&self) -> bool {
        true
    }
    fn happens_once(&self) -> bool {
        true
    }
    /// What moves for as long as a jump may take at most may have drifted; a specimen that settles does so while the force
    /// is higher than it ever was, and a spring that gave way by so much reads as a load cell that jumped.
    fn double(&self, values: &[f64], truth: &Trajectory) -> Option<&'static str> {
        if values[2] <= SLOWEST {
            return Some(
                "the reading moved as slowly as a jump may, so it may have drifted for a while",
            );
        }
        let (middle, width) = jump(values, truth)?;
        let (start, end) = (truth.time.first()?, truth.time.last()?);
        if middle < *start || middle > *end {
            return None;
        }
        let peak_until = |end: f64| {
            let until = truth.time.iter().zip(&truth.force);
            until
                .take_while(|(t, _)| **t <= end)
                .fold(0.0_f64, |peak, (_, f)| peak.max(f.abs()))
        };
        let about = width + ABOUT * (end - start);
        let (before, after) = (peak_until(middle - about), peak_until(middle + about));
        (after - before > HIGHER * peak_until(f64::INFINITY))
            .then_some("the force was higher than ever before when the reading jumped, so the specimen may have settled")
    }
    /// What a record begins or ends with is no jump in it: a joint that was loaded before begins like that.
    fn plausible(&self, values: &[f64], scale: &Scale) -> bool {
        let mut begins = 0.0;
        for length in &scale.lengths {
            let within = values[1] - begins;
            if within <= *length {
                let away = (length * exp(-values[2])).max(BEGUN * scale.step);
                return within > away && length - within > away;
            }
            begins += length;
        }
        false
    }
    fn starts(&self, scale: &Scale) -> Vec<Vec<f64>> {
        let [height, force] = [scale.displacement, scale.force].map(|size| 0.005 * size);
        let each = (MOST_STARTS / scale.lengths.len().max(1)).clamp(2, 8);
        let mut begins = 0.0;
        let mut starts = Vec::new();
        for length in &scale.lengths {
            for k in 0..each {
                let time = begins + (k as f64 + 0.5) / each as f64 * length;
                starts.push([time, SLOWEST]);
            }
            begins += length;
        }
        let samples = scale.duration() / scale.step;
        let sharpness = log(samples / BEGUN).clamp(SLOWEST, SHARPEST);
        starts.extend(scale.jumps.iter().map(|&time| [time, sharpness]));
        let of_sensor = starts.iter().map(|[time, p]| vec![height, *time, *p, 0.0]);
        let of_cell = starts.iter().map(|[time, p]| vec![0.0, *time, *p, force]);
        let of_cell = of_cell.filter(|_| scale.judges_force);
        of_sensor.chain(of_cell).collect()
    }
    fn begun_anew(&self, values: &[f64], scale: &Scale) -> Option<Vec<f64>> {
        chain::on_the_cell(values, (1, 3), scale)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rises_from_nothing_to_its_height_within_a_few_samples() {
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            time: (0..101).map(|i| 5.0 + 0.1 * f64::from(i)).collect(),
            force: vec![],
            displacement: vec![0.0; 101],
            ..Trajectory::default()
        };
        let added = OffsetStep.channel(&[2.0, 4.0, 16.0, 0.0], Place::DisplacementChannel, &truth);
        assert!((added[40] - 1.0).abs() < 1e-12);
        assert!(added[35].abs() < 1e-6 && (added[45] - 2.0).abs() < 1e-6);
        let slow = OffsetStep.channel(
            &[2.0, 4.0, SLOWEST, 0.0],
            Place::DisplacementChannel,
            &truth,
        );
        let width = (10.0 * (-SLOWEST).exp()).hypot(10.0 / 101.0);
        let expected = (2.0_f64 * 0.5 / width).tanh() - (2.0_f64 * -4.0 / width).tanh();
        assert!((slow[45] - expected).abs() < 1e-12);
        // Of a jump in the record before this one nothing is read.
        let later = Trajectory {
            begins: 10.0,
            test: 0,
            ..truth
        };
        assert_eq!(
            OffsetStep.channel(&[2.0, 4.0, 16.0, 0.0], Place::DisplacementChannel, &later),
            vec![0.0; 101]
        );
        assert!(
            OffsetStep
                .channel(
                    &[2.0, 4.0, 16.0, 0.0],
                    Place::DisplacementChannel,
                    &Trajectory::default()
                )
                .is_empty()
        );
    }

    #[test]
    fn a_jump_as_a_record_begins_or_ends_is_none() {
        let scale = Scale {
            lengths: vec![10.0, 20.0],
            step: 0.01,
            ..Scale::default()
        };
        let plausible =
            |time: f64, sharpness: f64| OffsetStep.plausible(&[1e-6, time, sharpness, 0.0], &scale);
        // A hundredth of the first record, a fifth of a second of the second.
        let sharpness = 100.0_f64.ln();
        for (time, is) in [
            (0.05, false),
            (0.2, true),
            (9.95, false),
            (10.15, false),
            (10.25, true),
            (29.9, false),
            (31.0, false),
        ] {
            assert_eq!(plausible(time, sharpness), is, "{time}");
        }
        assert!(plausible(0.05, SHARPEST) && !plausible(0.03, SHARPEST));
    }

    /// A jump while the force passes its highest value yet has a double, one at a lower peak later has none.
    #[test]
    fn a_jump_under_a_new_highest_force_may_be_a_specimen_that_settles() {
        let time: Vec<f64> = (0..801).map(|i| 0.01 * f64::from(i)).collect();
        let force = time.iter().map(|t| (std::f64::consts::TAU * t).sin());
        let truth = Trajectory {
            begins: 0.0,
            test: 0,
            force: force.collect(),
            displacement: vec![0.0; 801],
            time,
            ..Trajectory::default()
        };
        assert!(OffsetStep.double(&[1e-6, 0.2, 6.0, 0.0], &truth).is_some());
        assert!(OffsetStep.double(&[0.0, 0.2, 6.0, 1.0], &truth).is_some());
        assert_eq!(OffsetStep.double(&[1e-6, 5.2, 6.0, 0.0], &truth), None);
        // A drift for a while.
        assert!(
            OffsetStep
                .double(&[1e-6, 5.2, SLOWEST, 0.0], &truth)
                .is_some()
        );
    }
}
