//! The shape that all tips of a triangle share, read from the samples of every one of them.
//!
//! A servo rounds each tip alike. The samples of one tip do not show how, those of many do, as each has its samples at
//! other times from its corner.

use super::flanks::Tip;
use super::nonnegative::Normal;
use crate::record::cycles::turning_points;
use crate::record::evened::median;
use crate::record::peaks::{BAND, Between, Peak, is_between};

/// Steps about a corner within which a tip may be rounded, as tried.
const REACHES: [f64; 3] = [2.0, 3.0, 4.0];

/// Steps of a flank beyond that from which its line is drawn, as tried: another slope may be near, where a level ends.
const FLANKS: [f64; 3] = [6.5, 3.5, 1.5];

/// Steps from a corner beyond which the samples of a tip, its rounding taken off, draw its flanks anew.
const BESIDE: f64 = 1.0;

/// Times that flanks are drawn by the shape, and the shape by the flanks.
const ROUNDS: usize = 3;

/// Delays between a corner and the end of its reach, at most.
const GRAINS: f64 = 8.0;

/// Steps about a corner within which samples show what is between them.
const NEAR: f64 = 1.5;

/// Tips that make a shape, at least.
const TIPS: usize = 6;

/// Share of the tips of another reach that a shape has, at least.
const MOST: f64 = 0.5;

/// Times the usual error of the shape by which a tip is another one.
const OTHER: f64 = 3.0;

/// Error of a shape, as a share of what the slope loses in a step, below which no tip is another one.
const FINE: f64 = 3e-3;

/// Times the error of the shape by which it has to differ from what single tips show.
const BEYOND: f64 = 2.0;

/// What an input does between its samples, with the tips that a shape of all of them shows better than their own samples:
/// not of ramps that were drawn, which have corners. A servo that was seen before reaches as far.
pub(super) fn between(found: &Between, time: &[f64], input: &[f64]) -> Between {
    let reaches = found.shaped.map_or(REACHES.to_vec(), |reach| vec![reach]);
    let found = found.anew(time, input);
    if found.straight || found.drawn || found.thinned {
        return found;
    }
    let step = median(time.windows(2).map(|w| w[1] - w[0]).collect());
    let samples: Vec<[f64; 2]> = time
        .iter()
        .zip(input)
        .map(|(t, x)| [t / step, *x])
        .collect();
    let turns = turning_points(input, BAND);
    let shared = |reach: f64| Shape::shared(&samples, &turns, reach);
    let shapes: Vec<Shape> = reaches.into_iter().filter_map(shared).collect();
    let count = |shape: &Shape| shape.tips.len() as f64;
    let most = shapes.iter().map(count).fold(0.0, f64::max);
    let shape = shapes
        .into_iter()
        .filter(|shape| count(shape) >= MOST * most)
        .min_by(|a, b| a.error.total_cmp(&b.error));
    match shape {
        Some(shape) => shape.put(found, (time, step), input),
        None => found,
    }
}

/// What a servo makes of a corner: the slope falls at many delays `d`, by `w` about each of them, and a tip stays behind
/// the mean of its lines by `Σ w ½|t − d|`, each corner spread over the delays beside it.
pub(super) struct Shape {
    tips: Vec<Tip>,
    /// Steps from a corner beyond which its flanks are straight.
    pub(super) reach: f64,
    grain: f64,
    /// Delay in steps, and weight.
    delays: Vec<[f64; 2]>,
    /// Root mean square of what it leaves of the tips' samples, those of their flanks among them.
    error: f64,
}

impl Shape {
    /// The shape of most tips about the turns of an input, its samples as time in steps and value; none where there is
    /// no such.
    fn shared(samples: &[[f64; 2]], turns: &[usize], reach: f64) -> Option<Shape> {
        let about = || turns.windows(3).map(|w| [w[0], w[1], w[2]]);
        let tips = |near: f64, flank: f64| {
            about().map(move |about| Tip::about(samples, about, [near, near + flank]))
        };
        let all = Shape::of(tips(reach, FLANKS[0]).flatten().collect(), reach)?;
        let bound = OTHER * median(all.errors().collect()).max(FINE);
        let mut found: Vec<Option<Tip>> = vec![None; turns.len()];
        for flank in FLANKS {
            for (place, tip) in found.iter_mut().zip(tips(reach, flank)) {
                if place.is_none() {
                    *place = tip.filter(|tip| all.error_at(tip) <= bound);
                }
            }
        }
        let mut shape = Shape::of(found.iter().flatten().cloned().collect(), reach)?;
        if !shape.is_no_corner() {
            return None;
        }
        for _ in 0..ROUNDS {
            let drawn = |tip: Tip| tip.anew(samples, &shape, BESIDE);
            found = found.into_iter().map(|tip| tip.and_then(drawn)).collect();
            shape = Shape::of(found.iter().flatten().cloned().collect(), reach)?;
        }
        // Beside a kink the samples that draw a flank are few, and by the shape there are more.
        let bound =
            OTHER * median(shape.tips.iter().map(|tip| shape.error_near(tip)).collect()).max(FINE);
        let is_one = |tip: &Tip| shape.error_near(tip) <= bound;
        found = found.into_iter().map(|tip| tip.filter(is_one)).collect();
        for flank in FLANKS {
            for (place, tip) in found.iter_mut().zip(tips(REACHES[0], flank)) {
                if place.is_none() {
                    let drawn = |tip: Tip| tip.anew(samples, &shape, BESIDE);
                    let drawn = (0..ROUNDS).fold(tip, |tip, _| tip.and_then(drawn));
                    *place = drawn.filter(is_one);
                }
            }
        }
        shape.tips = found.into_iter().flatten().collect();
        Some(shape)
    }

    fn of(tips: Vec<Tip>, reach: f64) -> Option<Shape> {
        if tips.len() < TIPS {
            return None;
        }
        // Where every tip is sampled alike they show no more between their samples than one of them.
        let mut seen: Vec<f64> = tips.iter().flat_map(|t| &t.samples).map(|s| s[0]).collect();
        seen.retain(|at| at.abs() <= NEAR);
        seen.sort_by(f64::total_cmp);
        let gap = seen.windows(2).map(|w| w[1] - w[0]).fold(0.0, f64::max);
        let grains = (reach / gap).clamp(1.0, GRAINS).floor();
        let grain = reach / grains;
        let count = 2 * grains as usize + 1;
        let delays: Vec<f64> = (0..count).map(|i| grain * i as f64 - reach).collect();
        let mut equations = Normal::new(count);
        for &[at, behind] in tips.iter().flat_map(|tip| &tip.samples) {
            let row: Vec<f64> = delays.iter().map(|d| spread(at - d, grain)).collect();
            equations.add(&row, behind);
        }
        equations.mirror();
        let weights = equations.solve(&vec![false; count]);
        let delays = delays.into_iter().zip(weights).map(|(d, w)| [d, w]);
        let mut shape = Shape {
            tips,
            reach,
            grain,
            delays: delays.collect(),
            error: 0.0,
        };
        shape.error = root_mean_square(shape.errors());
        Some(shape)
    }

    /// How far a tip stays behind the mean of its lines, `t` steps from its corner, over the jump of the slope.
    pub(super) fn at(&self, t: f64) -> f64 {
        let delays = self.delays.iter();
        delays.map(|[d, w]| w * spread(t - d, self.grain)).sum()
    }

    fn errors(&self) -> impl Iterator<Item = f64> {
        self.tips.iter().map(|tip| self.error_at(tip))
    }

    fn error_at(&self, tip: &Tip) -> f64 {
        root_mean_square(tip.samples.iter().map(|s| s[1] - self.at(s[0])))
    }

    fn error_near(&self, tip: &Tip) -> f64 {
        let near = tip.samples.iter().filter(|s| s[0].abs() <= NEAR);
        root_mean_square(near.map(|s| s[1] - self.at(s[0])))
    }

    /// True where the tips are likelier by this shape than by corners that nothing rounds, its delays paid for.
    ///
    /// Each tip has an error of its own: of noise small tips have the larger one over their jump, and the end of a level is as
    /// unlikely by the one as by the other.
    fn is_no_corner(&self) -> bool {
        let likelier = |tip: &Tip| {
            let sharp = tip.samples.iter().map(|s| s[1] - 0.5 * s[0].abs());
            let nearer = root_mean_square(sharp) / self.error_at(tip);
            2.0 * tip.samples.len() as f64 * nearer.ln()
        };
        let count: usize = self.tips.iter().map(|tip| tip.samples.len()).sum();
        let paid = self.delays.len() as f64 * (count as f64).ln();
        self.tips.iter().map(likelier).sum::<f64>() > paid
    }

    /// The tips as the shape has them, where they differ from what was found by more than the shape errs.
    fn put(&self, found: Between, (time, step): (&[f64], f64), input: &[f64]) -> Between {
        let mut differs = Vec::new();
        let mut put = found.clone();
        for tip in &self.tips {
            let (at, value) = tip.top(self);
            let (turn, sense) = (tip.about[1], tip.sense());
            let at = time[turn] + step * at;
            let own = |peak: &Peak| peak.before == turn || peak.before == turn + 1;
            let read = found.peaks.iter().filter(|peak| own(peak));
            let single = read.fold(input[turn], |a, peak| {
                sense * (sense * a).max(sense * peak.value)
            });
            differs.push((value - single) / tip.jump());
            put.peaks.retain(|peak| !own(peak));
            let before = if at < time[turn] { turn } else { turn + 1 };
            let within = (at - time[before - 1]) / (time[before] - time[before - 1]);
            if is_between(within) && sense * (value - input[turn]) > 0.0 {
                put.peaks.push(Peak {
                    before,
                    ahead: time[before] - at,
                    value,
                });
            }
        }
        let differs = root_mean_square(differs.into_iter()) > BEYOND * self.error;
        put.shaped = differs.then_some(self.reach);
        match differs {
            true => put.in_order(),
            false => found,
        }
    }
}

/// Half the distance from a corner that is spread over a triangle as wide as a grain on both sides: the mean of ½|t − v|.
fn spread(t: f64, grain: f64) -> f64 {
    let t = t.abs() / grain;
    0.5 * grain
        * match t < 1.0 {
            true => 1.0 / 3.0 + t * t * (1.0 - t / 3.0),
            false => t,
        }
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), v| (sum + v * v, count + 1.0));
    f64::sqrt(sum / count)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Parts of a step in which the drives below are made.
    const PARTS: usize = 200;

    /// A triangle that grows from level to level, 23.7 samples a cycle, behind a servo with the given lag in steps (none: as
    /// it is), and the turns of it as they are.
    pub fn drive(lag: Option<f64>) -> (Vec<f64>, Vec<f64>) {
        let (mut fine, mut was) = (Vec::new(), 0.0);
        for i in 0..400 * PARTS {
            let cycle = i as f64 / PARTS as f64 / 23.7;
            let level = (1.0 + (cycle / 4.0).floor()) / 5.0;
            let now = level * (4.0 * ((cycle + 0.75).fract() - 0.5).abs() - 1.0);
            was += lag.map_or(1.0, |lag| 1.0 - (-1.0 / (PARTS as f64 * lag)).exp()) * (now - was);
            fine.push(was);
        }
        let tops = fine
            .windows(3)
            .filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0);
        let tops = tops.map(|w| w[1]).collect();
        (fine.into_iter().step_by(PARTS).collect(), tops)
    }

    pub fn time() -> Vec<f64> {
        (0..400).map(|i| 0.01 * f64::from(i)).collect()
    }

    /// How far the worst of the inner peaks is off that turn, over the largest.
    fn worst(peaks: &[Peak], tops: &[f64]) -> f64 {
        let nearest = |peak: &Peak| {
            let off = tops.iter().map(|top| (top - peak.value).abs());
            off.fold(f64::INFINITY, f64::min)
        };
        peaks.iter().map(nearest).fold(0.0, f64::max)
    }

    /// Corners, hyperbolas and parabolas, each through its own samples, are up to three in a hundred off.
    #[test]
    fn tips_behind_a_servo_are_where_all_of_them_show() {
        for lag in [0.3, 0.7, 1.2] {
            let (input, tops) = drive(Some(lag));
            let single = Between::default().anew(&time(), &input);
            let found = between(&Between::default(), &time(), &input);
            assert!(found.shaped.is_some() && single.shaped.is_none());
            // The first and the last have half a flank or none on one side, and where a level ends is no tip.
            let inner = |found: Between| -> Vec<Peak> {
                let is_tip = |p: &Peak| (8..390).contains(&p.before) && p.value.abs() > 0.1;
                found.peaks.into_iter().filter(is_tip).collect()
            };
            let [single, found] = [single, found].map(inner);
            let off = [&single, &found].map(|peaks| worst(peaks, &tops));
            assert!(
                off[0] > 3e-3 && off[1] < 0.25 * off[0],
                "lag {lag}: {off:?}"
            );
            // Tips of which a sample is the top have no peak beside it.
            assert!(
                4 * found.len() > 3 * tops.len(),
                "{} of {}",
                found.len(),
                tops.len()
            );
        }
    }

    /// Small tips have a large error over their jump, and where that is noise's it speaks for no shape.
    #[test]
    fn noise_in_a_drive_rounds_no_tips() {
        let (sharp, _) = drive(None);
        for (noise, seed) in [0.01, 0.02]
            .into_iter()
            .flat_map(|n| (0..40).map(move |s| (n, s)))
        {
            let mut random = crate::record::noise::tests::drawn(seed);
            let noisy: Vec<f64> = sharp.iter().map(|x| x + noise * random()).collect();
            let found = between(&Between::default(), &time(), &noisy);
            assert!(found.shaped.is_none(), "noise {noise}, seed {seed}");
        }
    }

    /// A triangle that nothing rounds, and what a program made straight from sample to sample, stay as they are; the tops of
    /// a sine are no farther off.
    #[test]
    fn what_single_tips_show_stays_where_no_servo_rounds_them() {
        let (sharp, _) = drive(None);
        let single = Between::default().anew(&time(), &sharp);
        assert_eq!(between(&Between::default(), &time(), &sharp), single);
        let sine: Vec<f64> = (0..400).map(|i| (0.265 * f64::from(i)).sin()).collect();
        let single = Between::default().anew(&time(), &sine);
        let found = between(&Between::default(), &time(), &sine);
        assert!(found.shaped.is_none());
        let [off, before] = [found, single].map(|found| worst(&found.peaks, &[-1.0, 1.0]));
        assert!(off <= before && before < 2e-4, "{off} {before}");
        let made = Between {
            straight: true,
            ..Between::default()
        };
        assert_eq!(between(&made, &time(), &drive(Some(0.7)).0).peaks, []);
    }
}
