//! What an input does between its samples: peaks that fall there, kinks where its rate jumps.

use super::cycles::turning_points;
use super::evened::median;
use super::rounded::vertex;

/// A point of the input between two samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The first sample behind it.
    pub before: usize,
    /// Time from here to that sample, in the clock's unit: clocks may be set.
    pub ahead: f64,
    /// Value, in the channel's unit.
    pub value: f64,
}

/// What the samples of an input do not show.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Between {
    /// Peaks and kinks between samples, at most one per interval, in order.
    pub peaks: Vec<Peak>,
    /// Samples up to which a difference would reach across a jump of the rate, in order.
    pub kinks: Vec<usize>,
    /// True where samples were taken out since they were found: those that are left do not show them.
    pub thinned: bool,
    /// True where the input goes straight from sample to sample: it has no peaks between them.
    pub straight: bool,
    /// True where the input was drawn by its ramps, and has the corners where they meet.
    pub drawn: bool,
    /// Where a shape that all tips share tells of them what their own samples do not: steps from a tip to where it ends.
    pub shaped: Option<f64>,
}

impl Between {
    /// What the samples do not show once they were changed.
    pub fn anew(&self, time: &[f64], channel: &[f64]) -> Between {
        let mut found = between(time, channel);
        found.drawn = self.drawn;
        if self.straight {
            found.peaks.clear();
            found.straight = true;
        }
        found
    }

    /// The same in order, at most one of a kind per interval.
    pub fn in_order(mut self) -> Between {
        self.peaks.sort_by_key(|peak| peak.before);
        self.peaks.dedup_by_key(|peak| peak.before);
        self.kinks.sort_unstable();
        self.kinks.dedup();
        self
    }

    /// The same beside the samples kept of a record, by their indices; `time` is the whole record's.
    pub fn thin(&mut self, kept: &[usize], time: &[f64]) {
        self.thinned |= kept.len() < time.len();
        let behind = |sample: usize| kept.partition_point(|&i| i < sample);
        self.peaks.retain_mut(|peak| {
            let was = peak.before;
            peak.before = behind(was);
            let sample = kept.get(peak.before);
            sample
                .inspect(|&&now| peak.ahead += time[now] - time[was])
                .is_some()
        });
        self.peaks.dedup_by_key(|peak| peak.before);
        self.kinks.iter_mut().for_each(|kink| *kink = behind(*kink));
        self.kinks.retain(|kink| *kink < kept.len());
        self.kinks.dedup();
    }
}

/// Wiggles below this share of the channel's range are no turning points.
pub const BAND: f64 = 0.005;

/// Share of the bends next to a kink, over those at it, below which two straight stretches meet.
const CORNER: f64 = 0.1;

/// Median bends of a channel that a kink exceeds.
const SHARP: f64 = 10.0;

/// Share of the bends next to a turn, over those at it, below which it is a rounded tip between straight flanks.
const ROUNDED: f64 = 0.5;

/// Share below which bends next to a turn are rounding of numbers.
const STRAIGHT: f64 = 1e-4;

/// Bends of the stretches by which their lines may go astray where they meet.
const ASTRAY: f64 = 3.0;

/// Share of a step within which a peak counts as sampled.
const SAMPLED: f64 = 1e-3;

/// Finds the kinks where straight stretches meet (a triangle's tip, the end of a ramp), and the peaks of turns: of
/// rounded tips the vertex of a hyperbola, of smooth turns that of the parabola through three samples.
///
/// A joint remembers how far it was driven: a peak missed by 10⁻³ of it leaves its whole way back
/// wrong by as much.
pub fn between(time: &[f64], channel: &[f64]) -> Between {
    let mut found = Between::default();
    if channel.len() < 8 {
        return found;
    }
    let place = |left: usize, within: f64, value: f64| Peak {
        before: left + 1,
        ahead: (1.0 - within) * (time[left + 1] - time[left]),
        value,
    };
    let turns = turning_points(channel, BAND);
    let usual = usual_bend(channel);
    let mut known = vec![false; channel.len()];
    for left in turns.iter().flat_map(|&turn| [turn.wrapping_sub(1), turn]) {
        if is_rounded(channel, left, usual)
            && let Some((within, value)) = vertex(channel, left)
        {
            found.peaks.push(place(left, within, value));
            known[left..=left + 1].fill(true);
        }
    }
    for left in corners(channel, usual) {
        let tip = known[left] || known[left + 1];
        known[left..=left + 1].fill(true);
        match meeting(channel, left) {
            Meeting::Between(within, value) => {
                if !tip {
                    found.peaks.push(place(left, within, value));
                }
                found.kinks.push(left + 1);
            }
            Meeting::Sampled(at) => found.kinks.push(at + 1),
            Meeting::Nowhere => found.kinks.extend([left + 1, left + 2]),
        }
    }
    for turn in turns {
        if turn < 1 || turn + 1 >= channel.len() || known[turn] || rests(channel, turn) {
            continue;
        }
        let rise = 0.5 * (channel[turn + 1] - channel[turn - 1]);
        let at = -rise / bend(channel, turn);
        let left = if at < 0.0 { turn - 1 } else { turn };
        if at.abs() > SAMPLED && at.abs() < 1.0 {
            let value = channel[turn] + 0.5 * rise * at;
            found.peaks.push(place(left, at.rem_euclid(1.0), value));
        }
    }
    found.in_order()
}

/// Share of the step to a turning point below which the next two are none: of a parabola one of them is half as large.
const RESTS: f64 = 0.25;

/// True where a channel rests before a turning point or behind it, after a jump or slowly: the parabola through what is
/// there reaches beyond what the channel ever was.
fn rests(channel: &[f64], turn: usize) -> bool {
    let step = |i: usize| (channel[i + 1] - channel[i]).abs();
    let none =
        |one: usize, other: usize, beside: usize| step(one).max(step(other)) < RESTS * step(beside);
    let behind = turn + 2 < channel.len() && none(turn, turn + 1, turn - 1);
    let before = turn >= 2 && none(turn - 1, turn - 2, turn);
    behind || before
}

/// True for a share of a step that lies between its samples.
pub fn is_between(within: f64) -> bool {
    within > SAMPLED && within < 1.0 - SAMPLED
}

fn bend(channel: &[f64], i: usize) -> f64 {
    channel[i - 1] - 2.0 * channel[i] + channel[i + 1]
}

/// Median of a channel's bends.
fn usual_bend(channel: &[f64]) -> f64 {
    median(
        (1..channel.len() - 1)
            .map(|i| bend(channel, i).abs())
            .collect(),
    )
}

/// First samples of the intervals in or next to which two straight stretches meet.
fn corners(channel: &[f64], usual: f64) -> Vec<usize> {
    let bend = |i: usize| bend(channel, i);
    let both = |i: usize| (bend(i) + bend(i + 1)).abs();
    (2..channel.len() - 3)
        .filter(|&i| both(i) > SHARP * usual && both(i) >= both(i - 1).max(both(i + 1)))
        .filter(|&i| bend(i - 1).abs() + bend(i + 2).abs() < CORNER * both(i))
        .collect()
}

/// True where a tip is as sharp as a corner, but turns the same way beside its interval as well, by more than usual.
fn is_rounded(channel: &[f64], left: usize, usual: f64) -> bool {
    if left < 2 || left > channel.len().saturating_sub(4) {
        return false;
    }
    let [before, start, end, behind] =
        [left - 1, left, left + 1, left + 2].map(|i| bend(channel, i));
    let both = start + end;
    let beside = (before + behind).abs();
    both.abs() > SHARP * usual
        && before * both >= 0.0
        && behind * both >= 0.0
        && beside < ROUNDED * both.abs()
        && beside > (2.0 * ASTRAY * usual).max(STRAIGHT * both.abs())
}

/// Where the straight stretches about an interval meet.
enum Meeting {
    /// Inside the interval: share of it, and the value there.
    Between(f64, f64),
    /// At a sample.
    Sampled(usize),
    /// Neither: more happens here than one kink.
    Nowhere,
}

fn meeting(channel: &[f64], left: usize) -> Meeting {
    let right = left + 1;
    let (rise, fall) = (
        channel[left] - channel[left - 1],
        channel[right + 1] - channel[right],
    );
    let within = (channel[right] - fall - channel[left]) / (rise - fall);
    let value = channel[left] + rise * within;
    // Stretches that bend, or noise, carry their lines past a kink that was sampled.
    let astray = ASTRAY
        * bend(channel, left - 1)
            .abs()
            .max(bend(channel, right + 1).abs());
    let nearest = if within < 0.5 { left } else { right };
    if (within - (nearest - left) as f64).abs() * (rise - fall).abs() <= astray {
        Meeting::Sampled(nearest)
    } else if is_between(within) {
        Meeting::Between(within, value)
    } else {
        Meeting::Nowhere
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(wave: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        let time: Vec<f64> = (0..600).map(|i| 0.0167 * f64::from(i)).collect();
        let channel = time.iter().map(|t| wave(*t)).collect();
        (time, channel)
    }

    /// What rests is driven no farther than where it rests, however it came there.
    #[test]
    fn a_jump_and_a_stop_have_no_tip_beyond_them() {
        let jump = |t: f64| if t < 5.0 { 1.0 } else { 0.0 };
        let stop = |t: f64| (0.4 * t.min(2.5 * std::f64::consts::FRAC_PI_2)).sin();
        for wave in [&jump as &dyn Fn(f64) -> f64, &stop] {
            let (time, channel) = sampled(wave);
            assert_eq!(between(&time, &channel).peaks, []);
        }
    }

    #[test]
    fn tips_of_sines_and_triangles_are_found_between_samples() {
        let sine = |t: f64| (std::f64::consts::TAU * t).sin();
        let triangle = |t: f64| 4.0 * (t - 0.25 - (t - 0.25).round()).abs() - 1.0;
        for (wave, off, kinks) in [
            (&sine as &dyn Fn(f64) -> f64, 3e-6, 0),
            (&triangle, 1e-12, 20),
        ] {
            let (time, channel) = sampled(wave);
            let Between {
                peaks,
                kinks: found,
                ..
            } = between(&time, &channel);
            assert!((17..=21).contains(&peaks.len()), "{}", peaks.len());
            assert!(found.len().abs_diff(kinks) <= 2, "{}", found.len());
            for peak in &peaks {
                assert!((peak.value.abs() - 1.0).abs() < off, "{peak:?}");
                assert!(peak.ahead > 0.0 && peak.ahead < 0.0167, "{peak:?}");
            }
        }
    }

    /// asin(r·sin) is a triangle rounded over 0.14 rad, 1.4 samples of these 60 a cycle: lines meet 1.3 % beyond its
    /// tip, parabolas 0.1 % off it.
    #[test]
    fn rounded_tips_of_triangles_are_found_between_samples() {
        let tip = 0.99_f64.asin();
        let rounded =
            |t: f64| (0.99 * (std::f64::consts::TAU * t).sin()).asin() / tip * (1.0 + 0.02 * t);
        let (time, channel) = sampled(rounded);
        let peaks = between(&time, &channel).peaks;
        assert!((17..=21).contains(&peaks.len()), "{}", peaks.len());
        for peak in &peaks {
            let at = time[peak.before] - peak.ahead;
            assert!(
                (peak.value.abs() - (1.0 + 0.02 * at)).abs() < 2e-4,
                "{peak:?}"
            );
        }
    }

    #[test]
    fn the_end_of_a_ramp_is_a_kink_wherever_it_lies() {
        for end in [300.0, 300.3] {
            let time: Vec<f64> = (0..600).map(f64::from).collect();
            let channel: Vec<f64> = time.iter().map(|t| t.min(end)).collect();
            let Between { peaks, kinks, .. } = between(&time, &channel);
            assert_eq!(kinks, [301]);
            match end == 300.0 {
                true => assert_eq!(peaks, []),
                false => assert!((peaks[0].value - end).abs() < 1e-9, "{peaks:?}"),
            }
        }
    }

    #[test]
    fn a_sampled_tip_has_no_peak_and_a_clipped_sine_none_above_its_clip() {
        let clipped = |t: f64| (std::f64::consts::TAU * t).sin().clamp(-0.8, 0.8);
        let (time, channel) = sampled(clipped);
        for peak in between(&time, &channel).peaks {
            assert!(peak.value.abs() <= 0.8 + 0.02, "{peak:?}");
        }
        let time: Vec<f64> = (0..200).map(f64::from).collect();
        let tips: Vec<f64> = time.iter().map(|t| (t % 20.0 - 10.0).abs()).collect();
        let Between { peaks, kinks, .. } = between(&time, &tips);
        assert_eq!(peaks, []);
        assert!(kinks.iter().all(|kink| kink % 10 == 1) && kinks.len() > 15);
    }
}
