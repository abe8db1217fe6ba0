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
    least(channel, step(channel))
}

/// The same of a channel that drives, whose answer tells a load that goes in steps from a reading that does.
pub fn resolution_of_drive(drive: &[f64], answer: &[f64]) -> f64 {
    least(drive, step_of_drive(drive, answer))
}

/// Least deviation of a channel that is read in such steps, or in none.
fn least(channel: &[f64], step: Option<f64>) -> f64 {
    step.map_or(0.0, of_step).max(FINEST * rms(channel))
}

/// The step in which a channel that drives is read; `None` where the answer moves with its steps, and rests with it.
pub fn step_of_drive(drive: &[f64], answer: &[f64]) -> Option<f64> {
    step(drive).filter(|step| !is_felt(drive, answer, OFF * step))
}

/// Deviation `Δ/√12` of what is read in steps of `Δ`.
pub fn of_step(step: f64) -> f64 {
    step / 12.0_f64.sqrt()
}

/// Samples from a step of the drive on in which its answer shows: at once, or late by one or two.
const SHOWS: [usize; 2] = [1, 3];

/// Share of the samples so near to steps up to which rests between them tell whether they are felt.
const RARE: f64 = 0.6;

/// True where the answer goes on near steps of the drive, larger than so much, and not between them.
fn is_felt(drive: &[f64], answer: &[f64], but_for: f64) -> bool {
    SHOWS
        .iter()
        .any(|shows| goes_on_near(drive, answer, (but_for, *shows)))
}

/// The same of answers that show in so many samples from a step on.
fn goes_on_near(drive: &[f64], answer: &[f64], (but_for, shows): (f64, usize)) -> bool {
    let (mut way, mut since) = (0.0, shows);
    let (mut near, mut gone_near, mut gone) = (0.0, 0.0, 0.0);
    for (drive, answer) in drive.windows(2).zip(answer.windows(2)) {
        let moves = drive[1] - drive[0];
        since += 1;
        if moves.abs() > but_for {
            (way, since) = (moves.signum(), 0);
        }
        let goes = way * (answer[1] - answer[0]);
        gone += goes;
        if since < shows {
            near += 1.0;
            gone_near += goes;
        }
    }
    let share = near / drive.len().max(1) as f64;
    share < RARE && gone_near > 0.5 * (1.0 + share) * gone.max(0.0)
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

    /// A load that is held for twelve samples each, and one that a converter reads so.
    #[test]
    fn a_load_in_steps_is_felt_and_one_read_in_steps_is_not() {
        let swings = |i: usize| 40.0 * (0.004 * i as f64).sin();
        let held: Vec<f64> = (0..3000).map(|i| swings(i / 12 * 12).round()).collect();
        let noise = white(3000);
        let with = |motion: &dyn Fn(usize) -> f64| -> Vec<f64> {
            (0..3000).map(|i| motion(i) + 0.3 * noise[i]).collect()
        };
        assert_eq!(step(&held), Some(1.0));
        assert_eq!(step_of_drive(&held, &with(&|i| held[i])), None);
        // Late by a sample.
        assert_eq!(step_of_drive(&held, &with(&|i| held[i.max(1) - 1])), None);
        assert_eq!(step_of_drive(&held, &with(&swings)), Some(1.0));
        assert!(resolution_of_drive(&held, &with(&|i| held[i])) < 0.01);
    }

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
