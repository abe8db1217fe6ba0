//! A channel whose tops are cut: it stands still at the end of its range while what it answers to, or answers, goes on.

use super::cycles::span;
use super::noise::from_differences;
use super::resolution::step;

/// Samples that stand at the end of the range in a top that is cut.
const LONG: usize = 3;

/// Tops that tell a range from chance.
const TOPS: usize = 2;

/// Standard deviations of noise by which the other channel, in all tops together, goes on and comes back.
const BEYOND: f64 = 5.0;

/// Steps of the channel's converter that a top may be flat by.
const STEPS: f64 = 2.0;

/// Standard deviations of a channel's own noise within which it stands at the end of its range: the largest of all samples
/// at the end is five above the mean of them, and the least of a top five below.
const STANDS: f64 = 10.0;

/// True where a channel holds its largest or least reading for some samples, but for noise, within which the other one goes
/// on and comes back, in most of the tops of a side that reach it: a command that is held makes the other stay, or creep one way.
pub fn is_cut(channel: &[f64], other: &[f64]) -> bool {
    let low = channel.iter().copied().fold(f64::INFINITY, f64::min);
    let high = channel.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    // Written so that what is no number is not cut.
    let ranges = high > low;
    if !ranges {
        return false;
    }
    let window = STANDS * from_differences(channel).deviation;
    let stands = |end: f64| {
        channel
            .windows(LONG)
            .any(|few| few.iter().all(|x| (*x - end).abs() <= window))
    };
    // Few records stand anywhere without noise, and of those alone a step is looked for.
    if !(stands(low) || stands(high)) {
        return false;
    }
    let step = step(channel).unwrap_or(0.0).max(window);
    let flat = STEPS * step * span(other) / (high - low);
    let noise = from_differences(other).deviation;
    let side = |(end, sign): (f64, f64)| {
        let at_end = |x: &f64| (x - end).abs() <= window;
        let mut tops = 0;
        let mut further = Vec::new();
        let mut from = 0;
        for stretch in channel.chunk_by(|a, b| at_end(a) == at_end(b)) {
            let during = &other[from..from + stretch.len()];
            from += stretch.len();
            if !at_end(&stretch[0]) {
                continue;
            }
            tops += 1;
            if stretch.len() >= LONG {
                further.push(goes_on(during, sign));
            }
        }
        let (count, all) = (further.len(), further.iter().sum::<f64>());
        let held = count >= TOPS && 2 * count > tops;
        held && all > flat * count as f64 && all > BEYOND * noise * (2.0 * count as f64).sqrt()
    };
    [(low, -1.0), (high, 1.0)].into_iter().any(side)
}

/// How much further than at both ends of a top the other channel is in its middle third.
fn goes_on(during: &[f64], sign: f64) -> f64 {
    let third = during.len() / 3;
    let between = &during[third..during.len() - third];
    let mean = between.iter().sum::<f64>() / between.len() as f64;
    let (first, last) = (sign * during[0], sign * during[during.len() - 1]);
    sign * mean - first.max(last)
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
        // The noise of an amplifier behind the cut, and that of a sensor that reads all.
        let noise = white(2000);
        let heard = |t: f64| 2e-4 * noise[(200.0 * t) as usize];
        let few = |t: f64| 1.02 * sine(t);
        assert!(cycles(|t| few(t).clamp(-0.95, 0.95) + heard(t), few));
        assert!(!cycles(|t| sine(t) + heard(t), sine));
        // The force of a contact that slides while the displacement that drives it goes on, and is let go where it turns.
        let driven: Vec<f64> = (0..2000).map(|i| sine(f64::from(i) / 200.0)).collect();
        let (mut held, mut last) = (0.0_f64, 0.0);
        let force = driven.iter().zip(&noise).map(|(u, n)| {
            held = (held + 5.0 * (u - last)).clamp(-1.0, 1.0);
            last = *u;
            held + 0.01 * n
        });
        assert!(!is_cut(&force.collect::<Vec<f64>>(), &driven));
        // A converter of seven bits.
        let read = |t: f64| (64.0 * sine(t)).round() / 64.0;
        assert!(!cycles(read, sine));
        // The largest of growing cycles alone.
        let grows = |t: f64| 0.1 * t * sine(t);
        assert!(!cycles(|t| grows(t).clamp(-0.9, 0.9), grows));
        assert!(!is_cut(&[], &[]) && !is_cut(&[1.0; 9], &[1.0; 9]));
    }
}
