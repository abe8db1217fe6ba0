//! Samples that stand alone are found; noise, kinks and smooth channels are left as they are.

use iwan::identify::{Form, Problem, baseline};
use iwan::record::Record;
use iwan::record::colour::Colour;
use iwan::record::outliers::{Neighbours, outliers, scattered, struck_out};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Nearly normal noise of unit variance: the sum of twelve uniform numbers.
fn normal(random: &mut ChaCha8Rng) -> f64 {
    (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0
}

#[test]
fn a_spike_is_found_and_neither_noise_nor_a_kink_is() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    for neighbours in [Neighbours::Level, Neighbours::Line] {
        let mut channel: Vec<f64> = (0..1_000_000).map(|_| normal(&mut random)).collect();
        assert_eq!(outliers(&channel, neighbours), Vec::new());
        channel[777] += 25.0;
        channel[778] += 20.0;
        let found: Vec<usize> = outliers(&channel, neighbours).iter().map(|o| o.0).collect();
        assert_eq!(found, [777, 778]);
    }
    let triangle: Vec<f64> = (0..4000)
        .map(|i| ((i % 200) as f64 - 100.0).abs() + 0.01 * normal(&mut random))
        .collect();
    assert_eq!(outliers(&triangle, Neighbours::Line), Vec::new());
    // Without noise, as a controller commands it, and then at rest: only rounding separates a flank from its line.
    let commanded: Vec<f64> = (0..4000)
        .map(|i| match i < 1012 {
            true => 850.05099 - 36.95874 * f64::from(i % 46 - 23).abs(),
            false => 0.0,
        })
        .collect();
    assert_eq!(outliers(&commanded, Neighbours::Line), Vec::new());
    let mut sine: Vec<f64> = (0..4000).map(|i| (0.06 * i as f64).sin()).collect();
    assert_eq!(outliers(&sine, Neighbours::Line), Vec::new());
    sine[1234] += 0.5;
    let found = outliers(&sine, Neighbours::Line);
    assert_eq!(found.len(), 1);
    assert!((found[0].1 - (0.06_f64 * 1234.0).sin()).abs() < 1e-3);
}

/// A mass in a triangle's load cell shows at every turn, at levels of the load that grow, and stays; readings that a
/// logger lost in both channels at once do not make turns of each other.
#[test]
fn what_comes_back_at_every_turn_is_no_spark() {
    let way = |i: usize| (i % 80) as f64 / 40.0 - 1.0;
    let displacement: Vec<f64> = (0..4000)
        .map(|i| (1.0 + i as f64 / 4000.0) * (2.0 * way(i).abs() - 1.0))
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut force: Vec<f64> = displacement
        .iter()
        .map(|u| 100.0 * u + 0.01 * normal(&mut random))
        .collect();
    for turn in (40..4000).step_by(40) {
        force[turn] += if turn % 80 == 0 { -80.0 } else { 80.0 };
    }
    let mut record = Record {
        force,
        displacement,
        ..Record::default()
    };
    assert_eq!(outliers(&record.force, Neighbours::Line).len(), 99);
    assert_eq!(struck_out(&record), record);
    let lost = [411, 1207, 1750, 2334, 3341];
    for i in lost {
        (record.force[i], record.displacement[i]) = (-9999.0, -9999.0);
    }
    assert_eq!(struck_out(&record).alone, lost);
}

/// Of a residual with one spike a cycle, always at the same load, and of sparks anywhere, the sparks alone
/// are struck out: the filter once took what a saturated sensor left for sparks.
#[test]
fn what_comes_back_at_one_load_of_every_cycle_is_no_spark() {
    let drive: Vec<f64> = (0..4000)
        .map(|i| (std::f64::consts::TAU * f64::from(i) / 80.0).sin())
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut residual: Vec<f64> = (0..4000).map(|_| normal(&mut random)).collect();
    (0..50).for_each(|cycle| residual[80 * cycle + 19] += 40.0);
    let sparks = [411, 1203, 1750, 2334, 3340];
    sparks.iter().for_each(|&i| residual[i] += 40.0);
    let found = outliers(&residual, Neighbours::Level);
    let all: Vec<usize> = found.iter().map(|o| o.0).collect();
    assert!(all.contains(&(80 * 20 + 19)), "{all:?}");
    let left: Vec<usize> = scattered(found, &drive).iter().map(|o| o.0).collect();
    assert_eq!(left, sparks);
}

/// A hum of ten samples a period beneath white noise, and a residual that goes to and fro by thirty times its noise: of most
/// samples one side foretells more and the other less, and those that both foretell wrongly are noise all the same.
#[test]
fn what_swings_beneath_noise_is_no_spark() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut swinging = |loud: f64, per_period: f64| -> Vec<f64> {
        let swing = |i: i32| loud * (std::f64::consts::TAU * f64::from(i) / per_period).sin();
        (0..12_000)
            .map(|i| swing(i) + normal(&mut random))
            .collect()
    };
    for neighbours in [Neighbours::Level, Neighbours::Line] {
        for (loud, per_period) in [(6.0, 10.0), (30.0, 60.0), (30.0, 200.0)] {
            let found = outliers(&swinging(loud, per_period), neighbours);
            assert_eq!(found, Vec::new(), "{neighbours:?} {loud} {per_period}");
        }
    }
}

/// A slider at its limit until the drive turns: the force is level and then falls ever faster. Most of the
/// record is slow and small, so that the bend exceeds what its samples are used to.
#[test]
fn the_knee_behind_a_turn_is_no_spark() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let (mut force, mut last) = (0.0_f64, 0.0);
    let mut channel: Vec<f64> = (0..6000)
        .map(|i| {
            let (amplitude, per_cycle) = if i < 5000 { (0.4, 400.0) } else { (6.0, 70.0) };
            let driven = amplitude * (std::f64::consts::TAU * f64::from(i) / per_cycle).sin();
            force = (force + 300.0 * (driven - last)).clamp(-600.0, 600.0);
            last = driven;
            force + normal(&mut random)
        })
        .collect();
    assert_eq!(outliers(&channel, Neighbours::Line), Vec::new());
    channel[5511] += 200.0;
    let found: Vec<usize> = outliers(&channel, Neighbours::Line)
        .iter()
        .map(|o| o.0)
        .collect();
    assert_eq!(found, [5511]);
}

/// A sweep that ends at nine samples a period: most of it is smooth, and both sides foretell the last tips to lie
/// elsewhere. What had been written over them sent the joint to loads that no sensor had read.
#[test]
fn the_tips_at_the_end_of_a_sweep_are_no_sparks() {
    let mut random = ChaCha8Rng::seed_from_u64(23);
    let mut turn = 0.0;
    let mut channel: Vec<f64> = (0..1850)
        .map(|i| {
            turn += std::f64::consts::TAU / 80.0 * (80.0_f64 / 9.0).powf(f64::from(i) / 1850.0);
            100.0 * turn.sin() + 0.1 * normal(&mut random)
        })
        .collect();
    let found = |channel: &[f64]| -> Vec<usize> {
        let found = outliers(channel, Neighbours::Line);
        found.iter().map(|o| o.0).collect()
    };
    assert!(found(&channel).is_empty(), "{:?}", found(&channel));
    channel[411] += 200.0;
    assert_eq!(found(&channel), vec![411]);
}

/// What was written over a sample that was struck out does not matter, to it or to its neighbours, in
/// noise that is whitened.
#[test]
fn a_struck_sample_leaves_its_neighbours_alone() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let force: Vec<f64> = (0..800)
        .map(|i| 900.0 * (0.05 * f64::from(i)).sin())
        .collect();
    let record = Record {
        name: "struck".into(),
        displacement: force
            .iter()
            .map(|f| 1e-8 * f + 1e-9 * normal(&mut random))
            .collect(),
        force,
        ..Record::default()
    };
    let misfit = |written: f64| {
        let mut problem = Problem::new(Form::Play, std::slice::from_ref(&record));
        let prepared = &mut problem.records[0];
        prepared.colour = Colour::first_order(0.8);
        prepared.weight[300] = 0.0;
        prepared.displacement[300] += written;
        baseline(&problem).misfit
    };
    let (untouched, overwritten) = (misfit(0.0), misfit(1e-5));
    assert!((overwritten / untouched - 1.0).abs() < 1e-9);
}

/// An amplifier that was not ready for its first sample: that alone is off, and no transient is.
#[test]
fn a_first_or_last_sample_alone_is_found_and_no_transient_is() {
    let mut random = ChaCha8Rng::seed_from_u64(17);
    let noise: Vec<f64> = (0..2000).map(|_| normal(&mut random)).collect();
    let found = |channel: &[f64], neighbours| -> Vec<usize> {
        outliers(channel, neighbours).iter().map(|o| o.0).collect()
    };
    let mut ends = noise.clone();
    ends[0] -= 300.0;
    ends[1999] += 40.0;
    assert_eq!(found(&ends, Neighbours::Level), [0, 1999]);
    // What a channel does as it begins is not judged before a model has followed it.
    assert_eq!(found(&ends, Neighbours::Line), [0; 0]);
    let decaying = |(i, x): (usize, &f64)| x + 300.0 * (-(i as f64) / 2.0).exp();
    let transient: Vec<f64> = noise.iter().enumerate().map(decaying).collect();
    assert_eq!(found(&transient, Neighbours::Level), [0; 0]);
}

/// The range and the noise of a channel are not those of one sample that a logger lost: the joint is judged as it is
/// without, and the sample is no witness.
/// Readings of a channel that was not ready, or was cut off in its last number, in the first samples and the last.
#[test]
fn wild_ends_are_struck_out_and_loads_put_on_at_once_stay() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let sine = |i: usize| 2e-5 * (0.06 * i as f64).sin();
    let displacement: Vec<f64> = (0..2000)
        .map(|i| sine(i) + 5e-8 * normal(&mut random))
        .collect();
    let record = |spoil: &dyn Fn(&mut Vec<f64>)| {
        let mut displacement = displacement.clone();
        spoil(&mut displacement);
        Record {
            force: (0..2000).map(|i| 1e8 * sine(i)).collect(),
            displacement,
            ..Record::default()
        }
    };
    let cases: [(&[usize], f64); 5] = [
        (&[0], 0.01),
        (&[1], 0.5),
        (&[0, 1], 1e-3),
        (&[1998], 0.5),
        (&[1999], -2.1),
    ];
    for (places, value) in cases {
        let struck = struck_out(&record(&|u| places.iter().for_each(|&i| u[i] = value)));
        assert_eq!(struck.alone, places, "{value}");
        for &i in places {
            let off = struck.displacement[i] - sine(i);
            assert!(off.abs() < 5e-6, "{i}: {off}");
        }
    }
    // A constant load put on behind the first sample, and one of which four samples show more.
    let put_on = |u: &mut Vec<f64>| {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let level = |i: usize| if i == 0 { 0.0 } else { 1.0 };
        let held = u.iter_mut().enumerate();
        held.for_each(|(i, u)| *u = level(i) + 1e-3 * normal(&mut random));
    };
    assert_eq!(struck_out(&record(&put_on)).alone, [0_usize; 0]);
    let higher = |u: &mut Vec<f64>| u[..4].fill(1.0);
    assert_eq!(struck_out(&record(&higher)).alone, [0_usize; 0]);
}

#[test]
fn a_lost_sample_changes_no_verdict() {
    let mut random = ChaCha8Rng::seed_from_u64(20261125);
    let level = |i: usize| [0.4, 0.7, 1.0, 0.6][i / 500];
    let force: Vec<f64> = (0..2000)
        .map(|i| level(i) * (std::f64::consts::TAU * i as f64 / 100.0).sin())
        .collect();
    let mut reached = [0.0_f64; 20];
    let mut answer = |f: f64| {
        for (j, p) in reached.iter_mut().enumerate() {
            let limit = 0.06 * (j + 1) as f64;
            *p = p.clamp(f - limit, f + limit);
        }
        3.0 * f + 0.2 * reached.iter().sum::<f64>() + 0.01 * normal(&mut random)
    };
    let displacement: Vec<f64> = force.iter().map(|f| 1e-6 * answer(*f)).collect();
    let whole = Record {
        name: "whole".to_string(),
        time: Some((0..2000).map(|i| 0.01 * f64::from(i)).collect()),
        force,
        displacement,
        ..Record::default()
    };
    let found = |record: &Record| {
        let found = iwan::diagnose::diagnose(std::slice::from_ref(record), |_| {}).unwrap();
        (found.verdict, found.judged, found.noise.rms)
    };
    let (verdict, judged, noise) = found(&whole);
    for (channel, lost) in [(1, -9999.0), (1, 3e-5), (0, 40.0)] {
        let mut spiked = whole.clone();
        match channel {
            1 => spiked.displacement[1234] = lost,
            _ => spiked.force[1234] = lost,
        }
        assert_eq!(struck_out(&spiked).alone, [1234]);
        let (spiked_verdict, spiked_judged, spiked_noise) = found(&spiked);
        assert_eq!(
            (spiked_verdict, &spiked_judged),
            (verdict, &judged),
            "{lost}"
        );
        assert!(
            (spiked_noise / noise - 1.0).abs() < 0.02,
            "{lost}: {spiked_noise} of {noise}"
        );
    }
}
