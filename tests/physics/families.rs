//! One density of each kind and of each shape that matters, with the slip range worth testing.

use iwan::joint::{Density, FourParameter, PowerLaw, PowerLawTable, Sliders};

/// A density to test and the largest slip \[m\] that is interesting for it.
pub struct Case {
    pub label: &'static str,
    pub density: Density,
    pub range: f64,
}

pub fn every_family() -> Vec<Case> {
    let mut cases = parametric();
    let (weight, slip_at) = slider_set();
    let set = |elastic| Sliders::new(weight.clone(), slip_at.clone(), elastic).unwrap();
    cases.push(Case {
        label: "sliders with full slip",
        density: Density::Sliders(set(0.0)),
        range: 3e-5,
    });
    cases.push(Case {
        label: "sliders with elastic remainder",
        density: Density::Sliders(set(1e5)),
        range: 3e-5,
    });
    cases
}

/// The families whose curve is smooth but for one corner at most.
pub fn parametric() -> Vec<Case> {
    let power_law = |chi, limit, stiffness| {
        PowerLaw::new(2e12, chi, 1.0, limit, stiffness).map(Density::PowerLaw)
    };
    let four = |chi, beta| FourParameter::new(400.0, 1e7, chi, beta).map(Density::FourParameter);
    let table = |density: Vec<f64>, stiffness| {
        let places = vec![2e-6, 4e-6, 5e-6, 1e-5];
        PowerLawTable::new(2e10, -0.3, 1.0, stiffness, places, density).map(Density::PowerLawTable)
    };
    [
        (
            "power law, endless",
            power_law(0.0, f64::INFINITY, 1e7),
            8e-6,
        ),
        (
            "power law, -0.3, endless",
            power_law(-0.3, f64::INFINITY, 1e9),
            1e-5,
        ),
        ("power law, 0.5, limited", power_law(0.5, 2e-6, 1e5), 6e-6),
        ("four parameters, -0.6, jump", four(-0.6, 2.0), 1e-4),
        ("four parameters, 0, no jump", four(0.0, 0.0), 1.2e-4),
        (
            "four parameters, -0.2, small jump",
            four(-0.2, 0.05),
            1.2e-4,
        ),
        (
            "table, elastic remainder",
            table(vec![1e12, 3e12, 0.0, 1e12], 2e7),
            2e-5,
        ),
    ]
    .into_iter()
    .map(|(label, density, range)| Case {
        label,
        density: density.unwrap_or_else(|error| panic!("{label}: {error}")),
        range,
    })
    .collect()
}

/// Sixty sliders over two decades of slip, unevenly weighted.
pub fn slider_set() -> (Vec<f64>, Vec<f64>) {
    let weight = (0..60).map(|j| 1e5 * (1.0 + 0.9 * (2.3 * j as f64).sin()));
    let slip_at = (0..60).map(|j| 1e-7 * 1.08_f64.powi(j));
    (weight.collect(), slip_at.collect())
}
