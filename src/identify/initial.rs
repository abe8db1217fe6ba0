//! The stiffness at small amplitude and what the records say of it.

use super::fit::Fit;
use super::interval::student_95;
use super::linearised::{Linearised, STRETCHES_OF_FACTOR};
use super::nonnegative::Normal;
use super::operators::Form;
use super::problem::Problem;
use super::series;

/// `K_0 = K_1 K_T/(K_1 + K_T)` of the fitted joint \[N/m\] with its 95 % interval; a bound that the
/// records do not give is zero or infinite.
///
/// The interval is that of the profile: with K_0 held, everything else (thresholds, offsets, the
/// effects' values) is solved for, non-negative as it has to be, and the misfit may rise by
/// `t² × inflation`. Linear in the compliances of the plays (`1/K_0 = c_0 + 1/K_1`) and in the
/// stiffnesses of the stops (`K_0 = Σ w`). Where the records start to slip far above the smallest
/// threshold, a stiffer joint that slips at once looks the same: the interval is then open above.
pub fn initial_stiffness(problem: &Problem, fit: &Fit) -> (f64, (f64, f64)) {
    let acting = fit.acting();
    let step = Linearised::new(problem, &fit.coefficients, &acting);
    let columns = problem.operators.columns();
    let mut direction = vec![0.0; step.normal.size];
    let mut held = 0.0;
    match problem.operators.form {
        Form::Play => {
            direction[0] = 1.0;
            for (k, slope) in step.slopes.iter().enumerate() {
                if series::is(&acting[slope.effect]) {
                    direction[step.first() + k] = slope.unit;
                }
            }
            held = fit.series.unwrap_or(0.0);
        }
        Form::Stop => direction[..columns].fill(1.0),
    }
    let along = |x: &[f64]| -> f64 { x.iter().zip(&direction).map(|(x, d)| x * d).sum() };
    let best = along(&step.solution);
    let influence = step.influence(&direction);
    let inflation = step.inflation(std::slice::from_ref(&influence))[0];
    let rise = student_95(STRETCHES_OF_FACTOR - 1).powi(2) * inflation;
    let profile = Profile {
        normal: &step.normal,
        direction: &direction,
        bounded: step.bounded(),
        least: step.misfit,
        scale: best.abs().max(f64::MIN_POSITIVE),
    };
    let start = (rise * influence.variance).sqrt();
    let below = profile.end(best, -start, rise).map(|x| x + held);
    let above = profile.end(best, start, rise).map(|x| x + held);
    match problem.operators.form {
        Form::Play => (
            1.0 / (best + held),
            (
                above.map_or(0.0, f64::recip),
                below.filter(|c| *c > 0.0).map_or(f64::INFINITY, f64::recip),
            ),
        ),
        Form::Stop => {
            // A spring in series makes both ends softer alike.
            let behind = |k: f64| 1.0 / (1.0 / k + fit.series.unwrap_or(0.0));
            (
                behind(best),
                (
                    below.map_or(0.0, behind),
                    above.map_or(f64::INFINITY, behind),
                ),
            )
        }
    }
}

/// Misfit over one linear combination of the unknowns.
struct Profile<'a> {
    normal: &'a Normal,
    direction: &'a [f64],
    bounded: Vec<bool>,
    least: f64,
    scale: f64,
}

/// Weight of the row that holds the combination, over what the data weigh.
const HELD: f64 = 1e4;

/// Factor beyond which an end of the interval counts as open.
const OPEN: f64 = 30.0;

/// Evaluations of an end.
const ROUNDS: usize = 12;

impl Profile<'_> {
    /// Rise of the misfit where the combination is held at `value`.
    fn rise(&self, value: f64) -> f64 {
        let mut normal = self.normal.clone();
        let weight = HELD * self.normal.rows.sqrt() / self.scale;
        let row: Vec<f64> = self.direction.iter().map(|d| d * weight).collect();
        normal.add(&row, value * weight);
        normal.mirror();
        let solution = normal.solve(&self.bounded);
        (self.normal.misfit(&solution) - self.least).max(0.0)
    }

    /// Where the misfit has risen by `wanted`, on the side that `step` points to; `None` where it
    /// does not between a thousandth and [`OPEN`] times the best value.
    fn end(&self, best: f64, step: f64, wanted: f64) -> Option<f64> {
        let last = match step > 0.0 {
            true => (OPEN - 1.0) * self.scale,
            false => -0.999 * self.scale,
        };
        let clip = |way: f64| {
            if step > 0.0 {
                way.min(last)
            } else {
                way.max(last)
            }
        };
        // The root of the rise goes nearly straight.
        let root = |way: f64| self.rise(best + way).sqrt() / wanted.sqrt();
        let mut inside = (0.0, 0.0);
        let mut outside = None;
        let mut way = clip(step);
        for _ in 0..ROUNDS {
            let here = root(way);
            if (here - 1.0).abs() < 0.02 {
                return Some(best + way);
            }
            if here > 1.0 {
                outside = Some((way, here));
            } else if way == last {
                return None;
            } else {
                inside = (way, here);
            }
            way = match outside {
                None => clip(2.0 * way),
                Some((far, high)) => {
                    let share: f64 = (1.0 - inside.1) / (high - inside.1);
                    inside.0 + (far - inside.0) * share.clamp(0.1, 0.9)
                }
            };
        }
        Some(best + way)
    }
}
