//! What a channel resolves at best: noise below it is none that a record can show.

use super::cycles::rms;

/// Share of a channel's rms below which nothing is asked for: no law of a joint is right to it (of 200 sliders in series,
/// read as the smooth density that they sample, it leaves 3e-5), and no effect of that size matters to anybody.
const FINEST: f64 = 1e-4;

/// Share of the steps between neighbouring values that are whole multiples of the smallest one where values are read
/// in steps.
const WHOLE: f64 = 0.95;

/// Part of the smallest step by which a multiple of it may be off and count as whole.
const OFF: f64 = 0.02;

/// Share of the largest magnitude within which two values are one: files have nine digits and more.
const ONE: f64 = 1e-9;

/// Least deviation that noise of a channel is taken for: `1e-4` of its rms, or `Δ/√12` where it is read in steps of `Δ`.
pub fn resolution(channel: &[f64]) -> f64 {
    of_steps(channel).unwrap_or(0.0).max(FINEST * rms(channel))
}

/// Deviation `Δ/√12` of what a channel that is read in steps of `Δ` is off by; `None` of others.
pub fn of_steps(channel: &[f64]) -> Option<f64> {
    step(channel).map(|step| step / 12.0_f64.sqrt())
}

/// Share of the samples that move from which on, if the next one moves as far, values are whole multiples apart because the
/// channel goes straight: one that is read in steps and bends does so in half of them.
const STRAIGHT: f64 = 0.75;

/// The step in which a channel is read; `None` where its values are not whole multiples of one apart, or are because it goes
/// straight from turn to turn, as often from sample to sample as a command is written.
pub fn step(channel: &[f64]) -> Option<f64> {
    let largest = channel.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut values = channel.to_vec();
    values.sort_by(f64::total_cmp);
    let apart = values.windows(2).map(|pair| pair[1] - pair[0]);
    let steps: Vec<f64> = apart.filter(|step| *step > ONE * largest).collect();
    let least = steps.iter().copied().reduce(f64::min)?;
    let is_whole = |step: &&f64| (*step / least - (*step / least).round()).abs() < OFF;
    let whole = steps.iter().filter(is_whole).count();
    let in_steps = steps.len() > 2 && whole as f64 > WHOLE * steps.len() as f64;
    (in_steps && !goes_straight(channel, OFF * least)).then_some(least)
}

/// True where nearly every sample that moves is followed by one that moves as far, but for so much.
fn goes_straight(channel: &[f64], but_for: f64) -> bool {
    let moves: Vec<f64> = channel.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let moving = moves.windows(2).filter(|pair| pair[0].abs() > but_for);
    let (mut all, mut same) = (0.0, 0.0);
    for pair in moving {
        all += 1.0;
        same += f64::from((pair[1] - pair[0]).abs() <= but_for);
    }
    same > STRAIGHT * all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::noise::tests::white;

    #[test]
    fn what_is_read_in_steps_is_told_from_what_is_not() {
        let smooth: Vec<f64> = (0..3000)
            .map(|i| 4e-6 * (0.01 * f64::from(i)).sin())
            .collect();
        assert_eq!(step(&smooth), None);
        assert_eq!(step(&white(3000)), None);
        let read = |step: f64| -> Vec<f64> {
            let steps = smooth.iter().map(|x| (x / step).round() * step);
            // As a file of nine digits has it.
            steps.map(|x| format!("{x:.8e}").parse().unwrap()).collect()
        };
        for fine in [2e-9, 2e-8, 3.7e-7] {
            let found = step(&read(fine)).unwrap();
            assert!((found / fine - 1.0).abs() < 1e-3, "{found} for {fine}");
            let least = resolution(&read(fine));
            assert!((least / fine * 12.0_f64.sqrt() - 1.0).abs() < 1e-3);
        }
        assert!((resolution(&smooth) / (1e-4 * rms(&smooth)) - 1.0).abs() < 1e-12);
        // From turn to turn in as many samples each time, a twelfth of a sample's step off.
        let turns = |i: i32| (f64::from((i + 20).rem_euclid(80)) - 40.0).abs() - 20.0;
        let written = |i: i32| 24.459_473 * (turns(i) + 1.0 / 12.0);
        let straight: Vec<f64> = (0..3000).map(written).collect();
        assert_eq!(step(&straight), None);
        // The same load slower than a converter's steps.
        let steps = (0..3000).map(|i| (0.13 * turns(i)).round() * 1e-3);
        let found = step(&steps.collect::<Vec<f64>>()).unwrap();
        assert!((found / 1e-3 - 1.0).abs() < 1e-3, "{found}");
        assert_eq!(resolution(&[]), 0.0);
    }
}
