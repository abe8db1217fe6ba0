//! The joint with effects: against the exact response, closed forms and the balance of work.

mod cells;
mod closed_forms;
mod effects;
mod properties;
mod refusals;

use effects::{Dashpot, Kelvin, Opening, Play, Sided, Stop, Wear};
use iwan::joint::{Acting, Density, Effect, Joint, Output, Sliders};

fn acting(effect: &'static dyn Effect, values: &[f64]) -> Acting {
    Acting {
        effect,
        values: values.to_vec(),
    }
}

/// Too weak to be seen, and still an effect: takes the joint through the extended solver.
fn whisper() -> Acting {
    acting(&Dashpot, &[1e-300])
}

fn sliders(elastic: f64) -> Density {
    let slip_at: Vec<f64> = (1..=20).map(|i| 0.05 * f64::from(i)).collect();
    let weight: Vec<f64> = (1..=20)
        .map(|i| 0.2 + 0.01 * f64::from(i * i % 7))
        .collect();
    Density::Sliders(Sliders::new(weight, slip_at, elastic).unwrap())
}

fn joint(density: Density, series_stiffness: f64, effects: Vec<Acting>) -> Joint {
    Joint::new(density, series_stiffness, effects).unwrap()
}

fn times(count: usize) -> Vec<f64> {
    (0..count).map(|i| 0.1 * i as f64).collect()
}

fn assert_close(a: &[Output], b: &[Output], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        let pairs = [
            (a.force, b.force),
            (a.displacement, b.displacement),
            (a.slip_displacement, b.slip_displacement),
            (a.dissipation, b.dissipation),
            (a.stored_energy, b.stored_energy),
        ];
        for (x, y) in pairs {
            assert!((x - y).abs() <= tolerance, "{a:?}\n{b:?}");
        }
    }
}

/// An effect in series too small to be seen.
fn whisper_in_series() -> Acting {
    acting(&Play, &[1e-300])
}

fn all_effects() -> Vec<Acting> {
    vec![
        acting(&Dashpot, &[0.05]),
        acting(&Stop, &[2.0, 0.6]),
        acting(&Play, &[0.3]),
        acting(&Opening, &[0.1]),
        acting(&Sided, &[1.2, 0.8]),
        acting(&Wear, &[0.3]),
        acting(&Kelvin, &[0.05]),
    ]
}
