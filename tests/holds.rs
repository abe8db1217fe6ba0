//! A drive that jumps back after its last hold, read without any noise, and a joint that answers to where it was alone.

use iwan::diagnose::diagnose;
use iwan::diagnose::findings::Verdict;
use iwan::record::Record;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Ramps to levels of either sign, a hold at each, and the way back to nothing within one sample.
fn course(random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut at = 0.0;
    let mut course = vec![0.0; 40];
    for hold in 0..14 {
        let side = if hold % 2 == 0 { 1.0 } else { -1.0 };
        let level = side * 1e-6 * (4.0 + 4.0 * random.random::<f64>());
        course.extend((1..=60).map(|i| at + (level - at) * f64::from(i) / 60.0));
        course.extend([level; 100]);
        at = level;
    }
    course.extend([0.0; 30]);
    course
}

#[test]
fn a_jump_back_at_the_end_is_no_hum() {
    for seed in 20_261_124..20_261_130 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let displacement = course(&mut random);
        let mut reached = [0.0_f64; 60];
        let (mut before, mut slow) = (0.0, 0.0);
        let mut force = Vec::new();
        for u in &displacement {
            for (j, d) in reached.iter_mut().enumerate() {
                let most = 1.7e-7 * (j + 1) as f64;
                *d = (*d + u - before).clamp(-most, most);
            }
            before = *u;
            let normal = (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
            slow = 0.9 * slow + 0.3 * (1.0_f64 - 0.81).sqrt() * normal;
            force.push(2e6 * reached.iter().sum::<f64>() + slow);
        }
        let record = Record {
            name: "holds".to_string(),
            time: Some((0..force.len()).map(|i| 8.3e-4 * i as f64).collect()),
            force,
            displacement,
            ..Record::default()
        };
        let findings = diagnose(&[record], |_| ()).unwrap();
        let named: Vec<&str> = findings.causes.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(findings.verdict, Verdict::Clean, "seed {seed}: {named:?}");
    }
}
