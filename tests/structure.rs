//! Structure beyond noise: neither noise more alike than it was taken for, nor noise that is louder under
//! load, passes for it; a model's error does.

use iwan::diagnose::structure::{Structure, structure};
use iwan::identify::{Form, Prediction, Problem};
use iwan::record::Record;
use iwan::record::colour::Colour;
use iwan::record::noise::Noise;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const PER_CYCLE: usize = 100;
const CYCLES: usize = 40;

/// Levels of four cycles each.
fn phase(i: usize) -> (f64, f64) {
    let level = (1 + i / (4 * PER_CYCLE)) as f64;
    let angle = std::f64::consts::TAU * i as f64 / PER_CYCLE as f64;
    (level, angle)
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    let (a, b): (f64, f64) = (random.random(), random.random());
    (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos()
}

/// What is seen in a residual, with the noise said to be of a correlation told by so many samples.
fn seen(residual: &[f64], told: (f64, usize)) -> Structure {
    seen_beside(residual, told, 0.0)
}

/// The same of noise in which whitening leaves so much correlation of neighbours.
fn seen_beside(
    residual: &[f64],
    (autoregression, samples): (f64, usize),
    beyond: f64,
) -> Structure {
    let displacement: Vec<f64> = (0..residual.len())
        .map(phase)
        .map(|(level, angle)| level * angle.sin())
        .collect();
    let force: Vec<f64> = displacement
        .iter()
        .zip(residual)
        .map(|(u, e)| 10.0 * u + e)
        .collect();
    let predicted = displacement.iter().map(|u| 10.0 * u).collect();
    let record = Record {
        name: "built".into(),
        force,
        displacement,
        ..Record::default()
    };
    let noise = Noise {
        deviation: 1.0,
        colour: Colour::first_order(autoregression),
        beyond,
        samples,
        repeated: true,
    };
    let prediction = Prediction {
        judged: predicted,
        ..Prediction::default()
    };
    structure(
        &Problem::new(Form::Stop, &[record]),
        &[prediction],
        &[noise],
    )
}

/// First-order noise of unit variance.
fn alike(autoregression: f64, random: &mut ChaCha8Rng) -> Vec<f64> {
    let fresh = (1.0 - autoregression * autoregression).sqrt();
    let mut last = normal(random);
    (0..PER_CYCLE * CYCLES)
        .map(|_| {
            last = autoregression * last + fresh * normal(random);
            last
        })
        .collect()
}

#[test]
fn noise_more_alike_than_few_samples_told_is_no_structure() {
    let mut random = ChaCha8Rng::seed_from_u64(20_261_122);
    let draws = 20;
    let (mut by_few, mut by_many) = (0, 0);
    for _ in 0..draws {
        let residual = alike(0.9, &mut random);
        // 0.8 is within two standard errors of 0.9 where 200 samples told it, and far outside of 20 000.
        by_few += usize::from(seen(&residual, (0.8, 200)).significance > 3.0);
        by_many += usize::from(seen(&residual, (0.8, 20_000)).significance > 3.0);
    }
    assert_eq!(by_few, 0);
    assert!(by_many > draws / 2, "{by_many}");
}

/// Noise of unit variance that two poles of 0.8 have passed: neighbours correlate by 1.6/1.64, and by 0.62 once whitened.
#[test]
fn noise_behind_a_filter_is_no_structure_where_cycles_show_it() {
    let mut random = ChaCha8Rng::seed_from_u64(20_261_126);
    let filtered = |random: &mut ChaCha8Rng| {
        let (mut one, mut two) = (0.0, 0.0);
        let mut next = || {
            one = 0.8 * one + normal(random);
            two = 0.8 * two + one;
            // The variance of both poles is (1 + 0.64)/(1 − 0.64)³ times that of what enters.
            two * (0.36_f64.powi(3) / 1.64).sqrt()
        };
        for _ in 0..100 {
            next();
        }
        (0..PER_CYCLE * CYCLES)
            .map(|_| next())
            .collect::<Vec<f64>>()
    };
    let told = (1.6 / 1.64, 2000);
    for _ in 0..20 {
        let noise = filtered(&mut random);
        let taken_for_first_order = seen(&noise, told);
        assert!(taken_for_first_order.is_seen(), "{taken_for_first_order:?}");
        let known = seen_beside(&noise, told, 0.62);
        assert!(!known.is_seen() && known.share < 0.02, "{known:?}");
        let both = (0..noise.len()).map(|i| noise[i] + 1.5 * (3.0 * phase(i).1).cos());
        let both = seen_beside(&both.collect::<Vec<f64>>(), told, 0.62);
        assert!(both.share > 0.02 && both.significance > 6.0, "{both:?}");
    }
}

#[test]
fn noise_louder_under_load_is_no_structure() {
    let mut random = ChaCha8Rng::seed_from_u64(20_261_123);
    let draws = 200;
    let significances: Vec<f64> = (0..draws)
        .map(|_| {
            let residual: Vec<f64> = (0..PER_CYCLE * CYCLES)
                .map(phase)
                .map(|(level, angle)| level * angle.sin().abs() * normal(&mut random))
                .collect();
            seen(&residual, (0.0, 20_000)).significance
        })
        .collect();
    let mean = significances.iter().sum::<f64>() / f64::from(draws);
    let square = significances
        .iter()
        .map(|s| (s - mean).powi(2))
        .sum::<f64>();
    let deviation = (square / f64::from(draws)).sqrt();
    // Below zero on average, because correlations by chance are allowed for.
    assert!((-0.5..0.1).contains(&mean), "{mean}");
    // Less than one, because within a bin the noise is uneven too.
    assert!((0.6..1.1).contains(&deviation), "{deviation}");
}

#[test]
fn what_repeats_with_the_load_is_structure() {
    let mut random = ChaCha8Rng::seed_from_u64(20_261_124);
    for correlation in [0.0, 0.9] {
        let mut residual = alike(correlation, &mut random);
        for (i, value) in residual.iter_mut().enumerate() {
            *value += 1.5 * (3.0 * phase(i).1).cos();
        }
        for samples in [200, 20_000] {
            let found = seen(&residual, (correlation, samples));
            assert!(found.significance > 6.0, "{correlation}: {found:?}");
        }
    }
}
