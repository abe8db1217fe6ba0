//! What a cause brings on a finer grid: a coarse one is wrong by a little everywhere, and a cause may mend that.

use super::prepare::Bench;
use super::trials::{ALARM, alarm, dispersion};
use crate::identify::finer::finer;
use crate::identify::{Fit, Problem, baseline, refit};

/// Evidence, over [`ALARM`], up to which a cause is looked at on a grid of half the spacing: the grid is chosen so
/// that what it is wrong by is far below the noise, and that makes no more.
const LITTLE: f64 = 10.0;

/// The baseline on a grid adapted to it, as long as that lowers the misfit.
pub(super) fn fitted(mut problem: Problem) -> (Problem, Fit) {
    let mut fit = baseline(&problem);
    let cells = problem.operators.edges.len();
    for _ in 0..3 {
        let mut finer = problem.clone();
        finer.operators = problem.operators.adapted(&fit.coefficients, cells);
        let refitted = baseline(&finer);
        if refitted.misfit >= fit.misfit {
            break;
        }
        (problem, fit) = (finer, refitted);
    }
    (problem, fit)
}

/// Halves the spacing of the grid where that takes from the baseline what is evident: a joint that slips all at once has
/// corners which no coarse one has.
pub(super) fn resolve(bench: &mut Bench) {
    let coarse = baseline(&bench.train);
    let (half, _) = finer(&bench.train, &coarse.coefficients);
    let halved = baseline(&half);
    let beyond = halved.misfit - bench.train.rows() as f64;
    let (fine, refitted) = match beyond < LITTLE * ALARM {
        true => at_corners(half, halved),
        // More than any grid is wrong by: cells would crowd where something else acts.
        false => (half, halved),
    };
    if coarse.misfit - refitted.misfit > ALARM * dispersion(&fine, &refitted) {
        bench.whole.operators.clone_from(&fine.operators);
        bench.train = fine;
    }
}

/// As many cells, crowded where a grid of half their spacing shows a corner, if they leave less.
fn at_corners(grid: Problem, fit: Fit) -> (Problem, Fit) {
    let (fine, _) = finer(&grid, &fit.coefficients);
    let seen = baseline(&fine).coefficients;
    let cells = grid.operators.edges.len();
    let mut crowded = grid.clone();
    crowded.operators = fine.operators.adapted(&seen, cells);
    let refitted = baseline(&crowded);
    match refitted.misfit < fit.misfit {
        true => (crowded, refitted),
        false => (grid, fit),
    }
}

/// True where a set's evidence against the current one stays as both have a grid of half the spacing.
pub fn stays_on_a_finer_grid(
    problem: &Problem,
    current: &Fit,
    (evidence, fit): (f64, &Fit),
) -> bool {
    if evidence > LITTLE * ALARM {
        return true;
    }
    let again = |set: &Fit| {
        let (fine, coefficients) = finer(problem, &set.coefficients);
        let start = Fit {
            coefficients,
            misfit: f64::INFINITY,
            effects: Vec::new(),
            ..set.clone()
        };
        refit(&fine, &start, set.effects.clone())
    };
    let (without, with) = rayon::join(|| again(current), || again(fit));
    let fall = |less: &Fit, more: &Fit| (less.misfit - more.misfit) / dispersion(problem, more);
    let lost = fall(current, fit) - fall(&without, &with);
    evidence - lost >= alarm(problem)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::identify::Form;
    use crate::identify::beginning::Beginning;
    use crate::joint::effect::{Acting, Effect, Place, Trajectory};
    use crate::joint::parameters::Parameter;
    use crate::record::{Record, noise};

    static SIZE: [Parameter; 1] = [Parameter {
        name: "size",
        symbol: "a",
        unit: "1",
        lower: -1.0,
        upper: 1.0,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "of what the load cell adds",
    }];

    /// Force of sliders of unit stiffness that let go at these displacements.
    pub fn slid(limits: &[f64], displacement: &[f64]) -> Vec<f64> {
        let mut reached = vec![0.0_f64; limits.len()];
        let mut before = 0.0;
        let moved = displacement.iter().map(|&u| {
            for (d, limit) in reached.iter_mut().zip(limits) {
                *d = (*d + u - before).clamp(-limit, *limit);
            }
            before = u;
            reached.iter().sum()
        });
        moved.collect()
    }

    /// A joint as sharp as no grid has it: sliders that let go nearly at once, between two edges.
    fn sharp(displacement: &[f64]) -> Vec<f64> {
        slid(&[1.20, 1.23, 1.26], displacement)
    }

    pub fn tone(displacement: &[f64]) -> Vec<f64> {
        (0..displacement.len())
            .map(|i| (2.9 * i as f64).sin())
            .collect()
    }

    /// What a load cell adds, by a law of the displacement.
    pub struct Adds(pub fn(&[f64]) -> Vec<f64>);

    impl Effect for Adds {
        fn name(&self) -> &'static str {
            "adds"
        }
        fn place(&self) -> Place {
            Place::ForceChannel
        }
        fn parameters(&self) -> &'static [Parameter] {
            &SIZE
        }
        fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
            let added = (self.0)(&truth.displacement);
            added.iter().map(|x| values[0] * x).collect()
        }
    }

    /// Whether an effect stays that begins at `from`, in a record of the sharp joint and as much of the tone;
    /// samples weigh as much as makes of what the effect takes the evidence.
    fn stays(effect: &'static Adds, from: f64, heard: f64, evidence: f64) -> bool {
        let displacement: Vec<f64> = (0..600)
            .map(|i| 2.1 * (0.07 * f64::from(i)).sin() * f64::from(i.min(300)) / 300.0)
            .collect();
        let both = sharp(&displacement).into_iter().zip(tone(&displacement));
        let record = Record {
            name: "sharp".to_string(),
            force: both.map(|(force, tone)| force + heard * tone).collect(),
            displacement,
            ..Record::default()
        };
        let mut problem = Problem::new(Form::Stop, &[record]);
        let fitted = |problem: &Problem| {
            let current = baseline(problem);
            let values = vec![from];
            let fit = refit(problem, &current, vec![Acting { effect, values }]);
            (current, fit)
        };
        let (current, fit) = fitted(&problem);
        let weight = (evidence / (current.misfit - fit.misfit)).sqrt();
        problem.records[0].weight.fill(weight);
        let (current, fit) = fitted(&problem);
        stays_on_a_finer_grid(&problem, &current, (evidence, &fit))
    }

    /// Cells of a bench of forty sliders spread out, ten cycles of it with noise so loud.
    fn cells(loud: f64) -> usize {
        let displacement: Vec<f64> = (0..1500)
            .map(|i| 2.1 * (0.0419 * f64::from(i)).sin() * f64::from(i.min(600)) / 600.0)
            .collect();
        let limits: Vec<f64> = (0..40).map(|j| 0.2 + 0.05 * f64::from(j)).collect();
        let mut noise = noise::tests::drawn(20261125);
        let force = slid(&limits, &displacement);
        let record = Record {
            name: "spread".to_string(),
            time: Some((0..1500).map(|i| 0.01 * f64::from(i)).collect()),
            force: force.iter().map(|f| f + loud * noise()).collect(),
            displacement,
            ..Record::default()
        };
        let bench = prepare(Form::Stop, &[record], &[Beginning::default()]);
        assert_eq!(bench.whole.operators, bench.train.operators);
        bench.train.operators.edges.len()
    }

    #[test]
    fn a_grid_is_halved_where_noise_does_not_hide_what_it_is_wrong_by() {
        let (quiet, loud) = (cells(0.02), cells(2.0));
        assert_eq!(quiet, 2 * loud);
    }

    static MENDS: Adds = Adds(sharp);
    pub static SOUNDS: Adds = Adds(tone);

    /// What cells of half the spacing leave, and those of the bench, of a joint of which half slips at one threshold.
    fn at_once(threshold: f64) -> [f64; 2] {
        let displacement: Vec<f64> = (0..6000)
            .map(|i| 2.1 * (0.0105 * f64::from(i)).sin())
            .collect();
        let limits: Vec<f64> = (0..20)
            .map(|j| (0.06 * f64::from(j)).min(threshold))
            .collect();
        let mut noise = noise::tests::drawn(20261126);
        let spread = slid(&limits, &displacement);
        let at_once = slid(&[threshold], &displacement);
        let both = spread.iter().zip(&at_once);
        let record = Record {
            name: "at once".to_string(),
            time: Some((0..6000).map(|i| 0.0025 * f64::from(i)).collect()),
            force: both
                .map(|(s, o)| s + 20.0 * o + 0.02 * (noise() - 0.5))
                .collect(),
            displacement,
            ..Record::default()
        };
        let bench = prepare(
            Form::Stop,
            std::slice::from_ref(&record),
            &[Beginning::default()],
        );
        let (problem, coarse) = fitted(Problem::new(Form::Stop, &[record]));
        let (mut half, _) = finer(&problem, &coarse.coefficients);
        assert_eq!(
            bench.whole.operators.edges.len(),
            half.operators.edges.len()
        );
        half.records.clone_from(&bench.whole.records);
        [&half, &bench.whole].map(|problem| baseline(problem).misfit / problem.rows() as f64)
    }

    #[test]
    fn cells_crowd_where_a_joint_slips_all_at_once() {
        for threshold in [1.03, 1.071, 1.137] {
            let [half, crowded] = at_once(threshold);
            assert!(crowded < 0.97 * half, "{threshold}: {crowded} of {half}");
        }
    }

    #[test]
    fn what_mends_the_grid_goes_and_what_acts_stays() {
        assert!(!stays(&MENDS, 0.9, 0.0, 2.0 * ALARM));
        assert!(stays(&SOUNDS, 0.01, 0.1, 2.0 * ALARM));
        // No grid is wrong by so much.
        assert!(stays(&MENDS, 0.9, 0.0, 11.0 * ALARM));
    }
}
