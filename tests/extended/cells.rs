//! Sliders that stand for a continuous density, against its exact response.

use iwan::joint::{Acting, Density, Drive, FourParameter, PowerLaw};

use super::{joint, times, whisper};

/// Relative error of the loss in the second cycle at some share of the range.
fn loss_error(density: Density, amplitude: f64) -> f64 {
    let cycle = |effects: Vec<Acting>| {
        let joint = joint(density.clone(), f64::INFINITY, effects);
        let path = [amplitude, -amplitude, amplitude];
        let answers = joint
            .simulate(Drive::Displacement, &times(3), &path)
            .unwrap();
        answers[2].dissipation - answers[0].dissipation
    };
    let exact = cycle(vec![]);
    (cycle(vec![whisper()]) - exact) / exact
}

#[test]
fn cells_of_a_continuous_density_come_close_at_any_amplitude() {
    for exponent in [-0.7, -0.3, 0.0, 0.5] {
        let four = FourParameter::new(100.0, 1e6, exponent, 0.4).unwrap();
        let range = four.largest_slip();
        let power = PowerLaw::new(4.0, exponent, 0.5, f64::INFINITY, 1000.0).unwrap();
        for share in [1.3, 0.77, 0.1, 0.0123, 1e-3, 1e-4] {
            let error = loss_error(Density::FourParameter(four), share * range);
            let allowed = match share {
                share if share > 0.5 => 1e-4,
                share if share > 0.05 => 5e-4,
                _ => 3e-3,
            };
            assert!(error.abs() < allowed, "{exponent} {share} {error}");
        }
        // No limit: the range is a million times what a test uses.
        let error = loss_error(Density::PowerLaw(power), 1e-3);
        assert!(error.abs() < 2e-2, "{exponent} {error}");
    }
}
