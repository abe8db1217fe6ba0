//! A channel whose tops are cut: it stands still at the end of its range while what it answers to, or answers, goes on.

use super::cycles::span;
use super::noise::from_differences;
use super::resolution::step;

/// Samples that stand at the end of the range in a top that is cut.
const LONG: usize = 3;

/// Tops that tell a range from chance.
const TOPS: usize = 2;

/// Standard deviations of noise by which the other channel goes on and comes back: the largest of hundreds of samples
/// exceeds the mean of two by five.
const BEYOND: f64 = 8.0;

/// Steps of the channel's converter that a top may be flat by.
const STEPS: f64 = 2.0;

/// True where a channel's largest or least reading holds for some samples within which the other one goes on and comes
/// back, in most of the tops of a side that reach it: a command that is held makes the other stay, or creep one way.
pub fn is_cut(channel: &[f64], other: &[f64]) -> bool {
    let low = channel.iter().copied().fold(f64::INFINITY, f64::min);
    let high = channel.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let stands = |end: f64| {
        channel
            .windows(LONG)
            .any(|few| few.iter().all(|x| *x == end))
    };
    // Written so that what is no number is not cut; few records stand anywhere, and of those alone a step is looked for.
    let may_be = high > low && (stands(low) || stands(high));
    if !may_be {
        return false;
    }
    let flat = STEPS * step(channel).unwrap_or(0.0) * span(other) / (high - low);
    let beyond = (BEYOND * from_differences(other).deviation).max(flat);
    let side = |(end, sign): (f64, f64)| {
        let (mut tops, mut cut) = (0, 0);
        let mut from = 0;
        for stretch in channel.chunk_by(|a, b| a == b) {
            let during = &other[from..from + stretch.len()];
            from += stretch.len();
            if stretch[0] != end {
                continue;
            }
            tops += 1;
            let (first, last) = (sign * during[0], sign * during[during.len() - 1]);
            let most = during
                .iter()
                .fold(f64::NEG_INFINITY, |m, x| m.max(sign * x));
            cut += usize::from(stretch.len() >= LONG && most - first.max(last) > beyond);
        }
        cut >= TOPS && 2 * cut > tops
    };
    [(low, -1.0), (high, 1.0)].into_iter().any(side)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::white;
    use std::f64::consts::TAU;

    /// Ten cycles of 200 samples, and their answer with some noise.
    fn cycles(of: impl Fn(f64) -> f64, answer: impl Fn(f64) -> f64) -> bool {
        let time = (0..2000).map(|i| f64::from(i) / 200.0);
        let (drive, mut other): (Vec<f64>, Vec<f64>) = time.map(|t| (of(t), answer(t))).unzip();
        let noise = white(2000);
        other
            .iter_mut()
            .zip(noise)
            .for_each(|(y, n)| *y += 1e-3 * n);
        is_cut(&drive, &other)
    }

    #[test]
    fn what_goes_on_while_the_other_stands_at_its_end_is_cut() {
        let sine = |t: f64| (TAU * t).sin();
        assert!(cycles(|t| sine(t).clamp(-0.95, 0.95), sine));
        assert!(cycles(|t| sine(t).min(0.95), sine));
        assert!(!cycles(sine, sine));
        // A command that is held, and what creeps under it.
        let held = |t: f64| sine(t).clamp(-0.9, 0.9);
        let creeps = |t: f64| held(t) * (1.0 + 0.2 * t.fract());
        assert!(!cycles(held, held) && !cycles(held, creeps));
        // A converter of seven bits.
        let read = |t: f64| (64.0 * sine(t)).round() / 64.0;
        assert!(!cycles(read, sine));
        // The largest of growing cycles alone.
        let grows = |t: f64| 0.1 * t * sine(t);
        assert!(!cycles(|t| grows(t).clamp(-0.9, 0.9), grows));
        assert!(!is_cut(&[], &[]) && !is_cut(&[1.0; 9], &[1.0; 9]));
    }
}
