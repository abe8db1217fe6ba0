//! Noise from repeated cycles: of the right size whatever its colour, and none of the response in it.

use iwan::record::colour::Colour;
use iwan::record::repeats::{from_repeats, from_steady_changes};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Nearly normal noise of unit variance with the given correlation of neighbours.
fn coloured(random: &mut ChaCha8Rng, count: usize, correlation: f64) -> Vec<f64> {
    let fresh = (1.0 - correlation * correlation).sqrt();
    let mut last = 0.0;
    (0..count)
        .map(|_| {
            let normal = (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
            last = correlation * last + fresh * normal;
            last
        })
        .collect()
}

/// Six cycles at each of three levels, a hundred samples each.
fn stepped_sine() -> Vec<f64> {
    (0..1800)
        .map(|i| f64::from(1 + i / 600) * (f64::from(i) * std::f64::consts::TAU / 100.0).sin())
        .collect()
}

#[test]
fn the_noise_of_many_records_is_right_in_the_mean_whatever_its_colour() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let drive = stepped_sine();
    for correlation in [0.0, 0.5, 0.9] {
        let (mut variance, mut found) = (0.0, 0.0);
        let draws = 40;
        for _ in 0..draws {
            let noise = coloured(&mut random, drive.len(), correlation);
            let response: Vec<f64> = drive
                .iter()
                .zip(&noise)
                .map(|(d, n)| 50.0 * d + n)
                .collect();
            let told = from_repeats(&drive, &response).expect("cycles repeat");
            variance += told.deviation.powi(2) / f64::from(draws);
            found += told.colour.neighbours() / f64::from(draws);
        }
        // A draw's variance scatters by a third at a correlation of 0.9: the mean of forty by 5 %.
        assert!((variance - 1.0).abs() < 0.1, "{correlation}: {variance}");
        assert!((found - correlation).abs() < 0.05, "{correlation}: {found}");
    }
}

/// A hundred and a third samples a cycle: values between samples share those, and neighbours of white noise would seem
/// alike.
#[test]
fn reading_between_samples_makes_noise_no_slower_and_no_less() {
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let phase = |i: u32| f64::from(i) * std::f64::consts::TAU / 100.333;
    let drive: Vec<f64> = (0..1800).map(|i| phase(i).sin()).collect();
    for correlation in [0.0, 0.5, 0.9] {
        let (mut variance, mut found) = (0.0, 0.0);
        let draws = 40;
        for _ in 0..draws {
            let noise = coloured(&mut random, drive.len(), correlation);
            let both = drive.iter().zip(&noise);
            let response: Vec<f64> = both.map(|(d, n)| 50.0 * d + n).collect();
            let told = from_repeats(&drive, &response).expect("cycles repeat");
            variance += told.deviation.powi(2) / f64::from(draws);
            found += told.colour.neighbours() / f64::from(draws);
        }
        assert!((variance - 1.0).abs() < 0.1, "{correlation}: {variance}");
        assert!((found - correlation).abs() < 0.03, "{correlation}: {found}");
    }
}

/// At its larger levels the response jumps, and values between samples miss it: slow noise would seem fast.
#[test]
fn a_response_that_jumps_makes_slow_noise_no_faster() {
    let mut random = ChaCha8Rng::seed_from_u64(18);
    let phase = |i: u32| f64::from(i) * std::f64::consts::TAU / 97.5;
    let level = |i: u32| f64::from(1 + i / 700);
    let drive: Vec<f64> = (0..2100).map(|i| level(i) * phase(i).sin()).collect();
    let (mut side, mut jumps) = (1.0, Vec::new());
    for d in &drive {
        if d * side < -1.5 {
            side = -side;
        }
        jumps.push(5.0 * side);
    }
    let (mut variance, mut found) = (0.0, 0.0);
    let draws = 40;
    for _ in 0..draws {
        let noise = coloured(&mut random, drive.len(), 0.9);
        let response: Vec<f64> = (0..drive.len())
            .map(|i| 50.0 * drive[i] + jumps[i] + noise[i])
            .collect();
        let told = from_repeats(&drive, &response).expect("cycles repeat");
        variance += told.deviation.powi(2) / f64::from(draws);
        found += told.colour.neighbours() / f64::from(draws);
    }
    // A third of the samples tells the noise: the mean of forty draws scatters by 8 %.
    assert!((variance - 1.0).abs() < 0.2, "{variance}");
    assert!((found - 0.9).abs() < 0.03, "{found}");
}

#[test]
fn a_first_cycle_that_still_remembers_is_no_noise() {
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let turn = std::f64::consts::TAU / 300.0;
    let drive: Vec<f64> = (0..1136)
        .map(|i| (turn * f64::from(i - 10)).sin())
        .collect();
    let noise = coloured(&mut random, drive.len(), 0.0);
    // Until its first peak the response lies elsewhere.
    let response: Vec<f64> = (0..drive.len())
        .map(|i| drive[i] + 0.01 * noise[i] + if i < 85 { 0.2 } else { 0.0 })
        .collect();
    let told = from_repeats(&drive, &response).expect("cycles repeat");
    assert!((told.deviation / 0.01 - 1.0).abs() < 0.25, "{told:?}");
}

#[test]
fn a_sine_that_grows_tells_its_noise_beside_a_response_that_is_not_linear() {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    // 97.3 samples a cycle: no cycle is sampled like the one before.
    let phase = |i: usize| i as f64 * std::f64::consts::TAU / 97.3;
    let drive: Vec<f64> = (0..2140)
        .map(|i| i as f64 / 2140.0 * phase(i).sin())
        .collect();
    for correlation in [0.0, 0.8] {
        let (mut variance, mut found) = (0.0, 0.0);
        let draws = 40;
        for _ in 0..draws {
            let noise = coloured(&mut random, drive.len(), correlation);
            let both = drive.iter().zip(&noise);
            let response: Vec<f64> = both
                .map(|(d, n)| 50.0 * d + 40.0 * d * d + 60.0 * d * d * d + n)
                .collect();
            let told = from_steady_changes(&drive, &response).expect("cycles change steadily");
            variance += told.deviation.powi(2) / f64::from(draws);
            found += told.colour.neighbours() / f64::from(draws);
        }
        // A draw's variance scatters by a quarter at a correlation of 0.8: the mean of forty by 4 %.
        assert!((variance - 1.0).abs() < 0.1, "{correlation}: {variance}");
        assert!((found - correlation).abs() < 0.05, "{correlation}: {found}");
    }
}

#[test]
fn what_is_not_smooth_over_the_cycles_is_not_told_as_noise() {
    let mut random = ChaCha8Rng::seed_from_u64(15);
    // Ten cycles, each a step larger: of the drive every third difference is nothing.
    let drive: Vec<f64> = (0..1000)
        .map(|i| f64::from(1 + i / 100) * (f64::from(i) * std::f64::consts::TAU / 100.0).sin())
        .collect();
    let noise = coloured(&mut random, drive.len(), 0.0);
    let response = |exponent: f64| -> Vec<f64> {
        let both = drive.iter().zip(&noise);
        both.map(|(d, n)| 100.0 * d * d.abs().powf(exponent) + n)
            .collect()
    };
    let told = |exponent: f64| from_steady_changes(&drive, &response(exponent));
    let square = told(1.0).expect("a square has no third differences either");
    assert!((0.8..1.2).contains(&square.deviation), "{square:?}");
    // Third differences of this power are many times the noise, and fourth ones still twice.
    let steeper = told(1.8);
    assert!(steeper.is_none_or(|n| n.deviation < 1.5), "{steeper:?}");
}

/// Equal parts of white noise and of slow noise, as a converter's and an amplifier's: first-order noise with such neighbours would
/// have a quarter of its density where it is slow.
#[test]
fn white_noise_beside_slow_noise_is_told_from_first_order_noise() {
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let drive = stepped_sine();
    let (mut told_both, mut independence) = (0, 0.0);
    let draws = 40;
    let expected = Colour {
        slow: 0.9,
        share: 0.5,
    };
    for _ in 0..draws {
        let slow = coloured(&mut random, drive.len(), expected.slow);
        let white = coloured(&mut random, drive.len(), 0.0);
        let parts = drive.iter().zip(slow.iter().zip(&white));
        let response: Vec<f64> = parts
            .map(|(d, (s, w))| 50.0 * d + (s + w) / 2.0_f64.sqrt())
            .collect();
        let told = from_repeats(&drive, &response).expect("cycles repeat");
        told_both += usize::from(told.colour.share < 1.0);
        independence += told.colour.independence() / f64::from(draws);
    }
    assert!(told_both > 36, "{told_both}");
    let ratio = independence / expected.independence();
    // By neighbours alone it would be four times that.
    assert!((0.8..1.3).contains(&ratio), "{ratio}");
}

#[test]
fn noise_of_the_first_order_is_taken_for_nothing_else() {
    let mut random = ChaCha8Rng::seed_from_u64(21);
    for samples in [100.0, 100.333] {
        let phase = |i: u32| f64::from(i) * std::f64::consts::TAU / samples;
        let drive: Vec<f64> = (0..1800).map(|i| phase(i).sin()).collect();
        for correlation in [0.0, 0.5, 0.9] {
            for _ in 0..40 {
                let noise = coloured(&mut random, drive.len(), correlation);
                let both = drive.iter().zip(&noise);
                let response: Vec<f64> = both.map(|(d, n)| 50.0 * d + n).collect();
                let told = from_repeats(&drive, &response).expect("cycles repeat");
                assert_eq!(told.colour.share, 1.0, "{correlation}: {told:?}");
            }
        }
    }
}

/// White noise, and a gain that falls with the cycles: what second differences leave of that is slow.
#[test]
fn a_response_that_changes_is_no_slow_noise() {
    let mut random = ChaCha8Rng::seed_from_u64(22);
    let drive = stepped_sine();
    let mut told_both = 0;
    for tenth in 0..40 {
        let lasts = 100.0 + 20.0 * f64::from(tenth);
        let noise = coloured(&mut random, drive.len(), 0.0);
        let falls = |i: usize| 1.0 - 0.05 * (1.0 - (-(i as f64) / lasts).exp());
        let response: Vec<f64> = (0..drive.len())
            .map(|i| 50.0 * falls(i) * drive[i] + noise[i])
            .collect();
        let told = from_repeats(&drive, &response).expect("cycles repeat");
        told_both += usize::from(told.colour.share < 1.0);
    }
    assert!(told_both < 3, "{told_both}");
}
