//! A weak cause beside slow noise: a variance that few cycles tell too small is no structure that speaks against it.

mod plays;

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::{Findings, Verdict};
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// Seeds of the noise; printed with every failure. That of the last one is told 7 % too small by its cycles, which was
/// taken for structure that the jump leaves.
const SEEDS: [u64; 4] = [1, 2, 5, 9];

const CYCLE: usize = 90;
const CYCLES: usize = 44;

/// Deviation of the noise \[m\], its correlation from sample to sample, and the jump of the sensor \[m\].
const NOISE: f64 = 2e-8;
const ALIKE: f64 = 0.75;
const JUMP: f64 = 0.7 * NOISE;

/// Forty plays in series under cycles of force of two levels; the sensor slips in the middle of the record.
fn record(seed: u64, jump: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut new = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let count = CYCLES * CYCLE;
    let mut noise = 0.0;
    let bears =
        |i: usize| [300.0, 500.0][(i / CYCLE / 4) % 2] * (TAU * i as f64 / CYCLE as f64).sin();
    let force: Vec<f64> = (0..count).map(bears).collect();
    let reads = |(i, u): (usize, f64)| {
        noise = ALIKE * noise + NOISE * (1.0 - ALIKE * ALIKE).sqrt() * new();
        let slipped = if i > count / 2 { jump } else { 0.0 };
        u + slipped + noise
    };
    let truth = plays::displacement(&force).into_iter();
    let displacement = truth.enumerate().map(reads).collect();
    plays::record("slow", force, displacement)
}

fn named(findings: &Findings) -> Vec<&str> {
    findings.causes.iter().map(|c| c.name.as_str()).collect()
}

#[test]
fn a_small_jump_is_found_beneath_slow_noise_and_none_where_there_is_none() {
    for seed in SEEDS {
        for (jump, expected) in [(0.0, &[][..]), (JUMP, &["offset_step"][..])] {
            let findings = diagnose(&[record(seed, jump)], |_| ()).unwrap();
            assert_eq!(named(&findings), expected, "seed {seed}, {jump}");
        }
    }
}

/// The same plays, whose friction falls with the way they have gone.
fn worn(seed: u64, falls: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut new = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let count = CYCLES * CYCLE;
    let (mut noise, mut way, mut before) = (0.0, 0.0, 0.0);
    let mut plays = [0.0_f64; 40];
    let (mut force, mut displacement) = (Vec::new(), Vec::new());
    for i in 0..count {
        let bears = [300.0, 500.0][(i / CYCLE / 4) % 2] * (TAU * i as f64 / CYCLE as f64).sin();
        let friction = 1.0 - falls * (1.0 - (-way / 5e-4_f64).exp());
        for (j, play) in plays.iter_mut().enumerate() {
            let threshold = 15.0 * (j + 1) as f64 * friction;
            *play = play.clamp(bears - threshold, bears + threshold);
        }
        let slipped = 1e-9 * plays.iter().sum::<f64>();
        way += (slipped - before).abs();
        before = slipped;
        noise = ALIKE * noise + NOISE * (1.0 - ALIKE * ALIKE).sqrt() * new();
        force.push(bears);
        displacement.push(1e-8 * bears + slipped + noise);
    }
    plays::record("worn", force, displacement)
}

/// Of seeds 1 to 8 those whose fall of the misfit stays below 90 and whose held-out cycles alone, by their bootstrap, do not
/// prove the cause.
const TOGETHER: [u64; 4] = [2, 4, 5, 8];

#[test]
fn samples_that_were_set_aside_witness_for_a_weak_cause() {
    for seed in TOGETHER {
        let findings = diagnose(&[worn(seed, 0.007)], |_| ()).unwrap();
        assert_eq!(named(&findings), ["preload_loss"], "seed {seed}");
    }
}

/// Of seeds 1 to 24 of the noise two, in which a jump was named where such noise was taken for first-order noise, and two more.
const BOTH: [u64; 4] = [1, 2, 3, 19];

#[test]
fn noise_that_is_white_and_slow_at_once_is_no_cause() {
    for seed in BOTH {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut new = || NOISE * ((0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0);
        let mut read = record(seed, 0.0);
        let mut slow = 0.0;
        let truth = plays::displacement(&read.force);
        for (read, u) in read.displacement.iter_mut().zip(truth) {
            slow = 0.95 * slow + (1.0 - 0.95_f64.powi(2)).sqrt() * new();
            *read = u + slow + new();
        }
        let findings = diagnose(&[read], |_| ()).unwrap();
        assert_eq!(
            findings.verdict,
            Verdict::Clean,
            "seed {seed}: {:?}",
            named(&findings)
        );
    }
}

/// Cycles none of which is like another one, under such noise; and a sensor that bends by so much of it at the end of its range.
fn unlike(seed: u64, bend: f64) -> Record {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut new = || NOISE * ((0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0);
    let bears = |i: usize| {
        let t = i as f64 / 200.0;
        let level = 350.0 + 150.0 * (0.9 * t).sin();
        level * (TAU * t * (1.0 + 0.01 * t)).sin() + 60.0 * (2.3 * t).sin()
    };
    let force: Vec<f64> = (0..6600).map(bears).collect();
    let mut displacement = plays::displacement(&force);
    let most = displacement
        .iter()
        .fold(0.0_f64, |most, u| most.max(u.abs()));
    let mut slow = 0.0;
    for read in &mut displacement {
        slow = 0.93 * slow + (1.0 - 0.93_f64.powi(2)).sqrt() * new();
        *read += bend * NOISE * (*read / most).powi(2) + slow + new();
    }
    plays::record("unlike", force, displacement)
}

/// Where nothing repeats it is told by what does not come back with the load, and a bend does.
#[test]
fn such_noise_is_no_structure_where_nothing_repeats_and_a_bend_is_a_cause() {
    for seed in 1..=2 {
        let findings = diagnose(&[unlike(seed, 0.0)], |_| ()).unwrap();
        assert_eq!(
            findings.verdict,
            Verdict::Clean,
            "seed {seed}: {:?}",
            named(&findings)
        );
        let by = &findings.noise.method;
        assert!(by.starts_with("residual"), "seed {seed}: {by}");
        let bent = diagnose(&[unlike(seed, 3.0)], |_| ()).unwrap();
        assert_eq!(named(&bent), ["sensor_nonlinearity"], "seed {seed}");
    }
}
