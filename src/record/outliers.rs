//! Samples that stand alone: a digit lost on the way, a spark in the cable, a jolt of the drive.

use super::Record;
use super::cycles::{span, turning_points};

/// What the neighbours on one side say of a sample: their mean, or the line through them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Neighbours {
    /// For residuals, that vary about a level.
    Level,
    /// For channels, that go on as they went.
    Line,
}

/// Samples next to the judged one that take no part: what stands alone may be a few samples wide.
pub(super) const APART: usize = 2;

/// Samples of one side that are asked.
const ASKED: usize = 4;

/// Typical deviations beyond which a sample stands alone: of a million normal ones none does, and a
/// fourteenfold outlier does (tests/outliers.rs).
const ALONE: f64 = 9.0;

/// Share of its deviation by which a sample that stands alone is off the chord of its neighbours too.
const OFF_CHORD: f64 = 0.5;

/// Share of the largest value that may be rounding: files have six digits and more.
const ROUNDING: f64 = 1e-6;

/// Share of the samples above which the channel is like that.
const FEW: f64 = 0.03;

/// Samples about a judged one whose deviations are compared with its own.
const AROUND: usize = 12;

/// Share of a deviation from which another one is like it, and how many of those about a sample tell that it does not stand
/// alone: of a wave of nine samples a period both sides foretell the tips, and nothing else, to lie elsewhere.
const LIKE: f64 = 1.0 / 3.0;
const COMPANY: usize = 3;

/// Levels of the drive that are told apart, each on its way up and on its way down.
const LEVELS: usize = 20;

/// Share of its range by which the other channel goes back where it turned.
const TURNED: f64 = 0.02;

/// Samples to either side of a turn that may hold what happens there.
const AT_TURN: usize = 1;

/// How many in one place, be it a level and way or the turns, and how many times more often than elsewhere, tell that
/// they are no sparks.
const GATHERED: f64 = 4.0;

/// Those that do not gather at one level of the drive on one way through it: a spark knows nothing of the
/// drive, while a contact that closes or a sensor at the end of its range shows there in every cycle.
pub fn scattered(found: Vec<(usize, f64)>, drive: &[f64]) -> Vec<(usize, f64)> {
    let lowest = drive.iter().copied().fold(f64::INFINITY, f64::min);
    let level = LEVELS as f64 / span(drive).max(f64::MIN_POSITIVE);
    let stage = |i: usize| {
        let (before, after) = (i.saturating_sub(APART), (i + APART).min(drive.len() - 1));
        let at = ((drive[i] - lowest) * level) as usize;
        2 * at.min(LEVELS - 1) + usize::from(drive[after] > drive[before])
    };
    let mut room = [0.0; 2 * LEVELS];
    (0..drive.len()).for_each(|i| room[stage(i)] += 1.0);
    let mut here = [0.0; 2 * LEVELS];
    found.iter().for_each(|(i, _)| here[stage(*i)] += 1.0);
    let of_all = found.len() as f64;
    let gathered = |stage: usize| gather((here[stage], of_all), (room[stage], drive.len() as f64));
    let kept = found.iter().filter(|(i, _)| !gathered(stage(*i)));
    kept.copied().collect()
}

/// True where those `here`, of all that were found, are more than what a place that has `room` for some of all samples
/// gets by chance.
fn gather((here, found): (f64, f64), (room, samples): (f64, f64)) -> bool {
    let elsewhere = found - here + 1.0;
    let expected = elsewhere * room / (samples - room).max(1.0);
    here >= GATHERED && here > GATHERED * expected
}

/// Those that do not gather at the turns of the other channel: a spark knows nothing of them, while a mass shows there.
fn strewn(found: Vec<(usize, f64)>, other: &[f64]) -> Vec<(usize, f64)> {
    let (of_all, samples) = (found.len() as f64, other.len() as f64);
    if of_all < GATHERED {
        return found;
    }
    let mut turns = vec![false; other.len()];
    for turn in turning_points(other, TURNED) {
        let last = (turn + AT_TURN).min(other.len() - 1);
        turns[turn.saturating_sub(AT_TURN)..=last].fill(true);
    }
    let room = turns.iter().filter(|turned| **turned).count() as f64;
    let elsewhere: Vec<_> = found.iter().copied().filter(|(i, _)| !turns[*i]).collect();
    let here = of_all - elsewhere.len() as f64;
    match gather((here, of_all), (room, samples)) {
        true => elsewhere,
        false => found,
    }
}

/// The record with samples that stand alone in either channel replaced by what their neighbours say, and marked: a spike
/// of the input would send a model's memory elsewhere for good, and any of them passes for a range or for noise.
pub fn struck_out(record: &Record) -> Record {
    let found = |channel: &[f64]| {
        let ends = wild_ends(channel);
        let mut all = outliers(&without(channel, &ends), Neighbours::Line);
        all.extend(ends);
        all
    };
    let (of_force, of_displacement) = (found(&record.force), found(&record.displacement));
    // Readings that both channels lost at once make no turns of each other.
    let force = without(&record.force, &of_force);
    let displacement = without(&record.displacement, &of_displacement);
    let of_force = strewn(of_force, &displacement);
    let of_displacement = strewn(of_displacement, &force);
    let mut struck = record.clone();
    struck.force = without(&record.force, &of_force);
    struck.displacement = without(&record.displacement, &of_displacement);
    let alone = of_force.iter().chain(&of_displacement);
    struck.alone.extend(alone.map(|(i, _)| *i));
    struck.alone.sort_unstable();
    struck.alone.dedup();
    struck
}

/// Samples at either end that lie farther from zero than all between the ends by more than those lie apart, with the
/// nearest of the others instead: an amplifier that was not ready, a number that was cut off. Neither a ring that dies
/// away nor a load that is put on at once is like that; what most of an end is like is no spark.
fn wild_ends(channel: &[f64]) -> Vec<(usize, f64)> {
    let (count, end) = (channel.len(), APART + ASKED);
    if count < 4 * end + 2 * AROUND {
        return Vec::new();
    }
    let between = &channel[end..count - end];
    let beyond = between.iter().fold(0.0_f64, |most, x| most.max(x.abs())) + span(between);
    let wild = |i: &usize| channel[*i].abs() > beyond;
    let one_end = |near: Vec<usize>, inward: usize| {
        let found: Vec<usize> = near.iter().copied().filter(wild).collect();
        let instead = |i: usize| {
            let nearest = near.iter().filter(|j| !wild(j));
            let nearest = nearest.min_by_key(|j| j.abs_diff(i));
            channel[nearest.copied().unwrap_or(inward)]
        };
        match 2 * found.len() > near.len() {
            true => Vec::new(),
            false => found.iter().map(|&i| (i, instead(i))).collect(),
        }
    };
    let mut all = one_end((0..end).collect(), end);
    all.extend(one_end((count - end..count).collect(), count - end - 1));
    all
}

/// The channel with what its neighbours say in the place of samples that stand alone.
fn without(channel: &[f64], alone: &[(usize, f64)]) -> Vec<f64> {
    let mut channel = channel.to_vec();
    alone.iter().for_each(|&(i, instead)| channel[i] = instead);
    channel
}

/// What is said of a record of which so many samples stand alone.
pub fn stand_alone(name: &str, count: usize, samples: usize) -> String {
    format!(
        "Record {name}: {count} of {samples} samples stand alone against their neighbours on both sides and were left out."
    )
}

/// Samples that both sides foretell to lie elsewhere, in the same direction, by more than
/// deviations scatter in the record and about the sample; with what their sides say instead.
///
/// A kink (reversal of a triangle, onset of contact) is foretold by one side and stays. Empty where
/// more than [`FEW`] of the samples would be struck out.
pub fn outliers(channel: &[f64], neighbours: Neighbours) -> Vec<(usize, f64)> {
    let reach = APART + ASKED;
    let count = channel.len();
    if count < 4 * reach + 2 * AROUND {
        return Vec::new();
    }
    let judged = reach..count - reach;
    let sides: Vec<(f64, f64)> = judged
        .clone()
        .map(|i| {
            let left = foretold(|j| channel[i - APART - 1 - j], neighbours);
            let right = foretold(|j| channel[i + APART + 1 + j], neighbours);
            (left, right)
        })
        .collect();
    let deviations: Vec<f64> = judged
        .clone()
        .zip(&sides)
        .map(|(i, (left, right))| {
            let (left, right) = (channel[i] - left, channel[i] - right);
            match left * right > 0.0 {
                true => left.signum() * left.abs().min(right.abs()),
                false => 0.0,
            }
        })
        .collect();
    let largest = channel.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let rounding = ROUNDING * largest;
    let usual = typical(deviations.iter().map(|d| d.abs()).collect());
    // A sharp bend lies beyond what its sides foretell, and on the other side of its chord.
    let bends = |k: usize| {
        let (before, after) = (k + reach - APART - 1, k + reach + APART + 1);
        let off_chord = channel[k + reach] - 0.5 * (channel[before] + channel[after]);
        off_chord * deviations[k].signum() <= OFF_CHORD * deviations[k].abs()
    };
    // As many at an end, where they lie to one side.
    let about = |k: usize, reach: usize| {
        let last = deviations.len().saturating_sub(2 * reach + 1);
        let from = k.saturating_sub(reach).min(last);
        from..(from + 2 * reach + 1).min(deviations.len())
    };
    let mut found: Vec<(usize, f64)> = (0..deviations.len())
        .filter(|&k| deviations[k].abs() > (ALONE * usual).max(rounding))
        // Where the sides differ by more than the sample does from one of them, that side holds it:
        // next to the tip of a noiseless triangle its own side is off by rounding only.
        .filter(|&k| (sides[k].0 - sides[k].1).abs() < deviations[k].abs())
        .filter(|&k| !bends(k))
        .filter(|&k| {
            let others = about(k, AROUND).filter(|j| j.abs_diff(k) > APART);
            let others = others.map(|j| deviations[j].abs()).collect();
            deviations[k].abs() > ALONE * quantile(others, 0.75)
        })
        .filter(|&k| {
            let (all, like) = (about(k, 2 * AROUND), LIKE * deviations[k].abs());
            let alike =
                all.filter(|&j| j.abs_diff(k) > APART + ASKED && deviations[j].abs() > like);
            neighbours == Neighbours::Level || alike.filter(|&j| !bends(j)).count() < COMPANY
        })
        .map(|k| match neighbours {
            Neighbours::Level => (k + reach, 0.5 * (sides[k].0 + sides[k].1)),
            Neighbours::Line => (k + reach, bridged(channel, k + reach)),
        })
        .collect();
    if neighbours == Neighbours::Level {
        let first = lonely_end(|i| channel[i]);
        let last = lonely_end(|i| channel[count - 1 - i]);
        let ends = [(0, first), (count - 1, last)];
        let beyond = |(i, level): &(usize, f64)| (channel[*i] - level).abs() > ALONE * usual;
        let both = ends.map(|(i, level)| level.map(|level| (i, level)));
        found.extend(both.into_iter().flatten().filter(beyond));
    }
    match found.len() as f64 > FEW * count as f64 {
        true => Vec::new(),
        false => found,
    }
}

/// Level that a record comes to at once behind its first sample (or before its last), where that alone is elsewhere: an
/// amplifier that was not ready yet. None where others about it deviate too, as a transient's do.
fn lonely_end(at: impl Fn(usize) -> f64) -> Option<f64> {
    let beside: Vec<f64> = (1..=2 * AROUND).map(&at).collect();
    let level = quantile(beside.clone(), 0.5);
    let farthest = beside.iter().map(|x| (x - level).abs()).fold(0.0, f64::max);
    ((at(0) - level).abs() > 0.5 * ALONE * farthest).then_some(level)
}

/// Value at the judged sample from those of one side, the nearest first.
fn foretold(at: impl Fn(usize) -> f64, neighbours: Neighbours) -> f64 {
    let mean = (0..ASKED).map(&at).sum::<f64>() / ASKED as f64;
    if neighbours == Neighbours::Level {
        return mean;
    }
    let middle = 0.5 * (ASKED - 1) as f64;
    let (mut along, mut spread) = (0.0, 0.0);
    for j in 0..ASKED {
        let from_middle = j as f64 - middle;
        along += from_middle * at(j);
        spread += from_middle * from_middle;
    }
    mean - along / spread * (middle + (APART + 1) as f64)
}

/// Value at a sample from those of both sides, by the cubic that comes nearest to them: where a channel bends, both
/// sides' lines miss it on one side.
fn bridged(channel: &[f64], i: usize) -> f64 {
    // Odd powers vanish in the means of pairs at one distance.
    let square = |j: usize| ((APART + 1 + j) as f64).powi(2);
    let pair = |j: usize| 0.5 * (channel[i - APART - 1 - j] + channel[i + APART + 1 + j]);
    let count = ASKED as f64;
    let middle = (0..ASKED).map(square).sum::<f64>() / count;
    let mean = (0..ASKED).map(pair).sum::<f64>() / count;
    let along: f64 = (0..ASKED).map(|j| (square(j) - middle) * pair(j)).sum();
    let spread: f64 = (0..ASKED).map(|j| (square(j) - middle).powi(2)).sum();
    mean - along / spread * middle
}

/// The size of most deviations: their upper quartile, for half of them are zero by construction where a channel is
/// noise; no less than the median of the others, for where it rises or bends by more than its noise nearly all are zero. (About one
/// sample the others are what that sample does to its neighbours' prospects.)
pub(super) fn typical(deviations: Vec<f64>) -> f64 {
    let seen = deviations.iter().copied().filter(|d| *d > 0.0).collect();
    quantile(deviations, 0.75).max(quantile(seen, 0.5))
}

fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let place = (share * (values.len().max(1) - 1) as f64).round() as usize;
    values.get(place).copied().unwrap_or(0.0)
}
