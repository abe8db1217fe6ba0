//! How far the joint answers a program: the limit of the channel that is not prescribed.

use super::design::program;
use super::program::{Block, Rig};
use crate::identify::{Fit, Form, Problem};

/// Halvings of what may still be allowed; the last is a thousandth of the range.
const HALVINGS: usize = 10;

/// The rig with its range drawn in, if need be, until the joint that was found answers within `most`
/// to either side of zero, N or m.
pub fn within(rig: Rig, most: f64, problem: &Problem, whole: &Fit) -> Rig {
    let widest = widest(&rig);
    // What is no number is no answer that stays inside.
    let stays = |rig: &Rig| farthest(rig, &widest, problem, whole) <= most;
    if stays(&rig) {
        return rig;
    }
    let (mut inside, mut outside) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let share = 0.5 * (inside + outside);
        match stays(&rig.drawn_in(share)) {
            true => inside = share,
            false => outside = share,
        }
    }
    rig.drawn_in(inside)
}

/// The blocks over the whole range in which a joint comes farthest: the fastest, the slowest, and the one that rests
/// longest at its peak.
fn widest(rig: &Rig) -> Vec<Block> {
    let whole: Vec<Block> = rig.menu();
    let whole: Vec<Block> = whole.into_iter().filter(|b| b.amplitude == 1.0).collect();
    let by = |of: fn(&Block) -> f64| whole.iter().max_by(|a, b| of(a).total_cmp(&of(b)));
    let chosen = [by(|b| b.rate), by(|b| -b.rate), by(|b| b.hold)];
    chosen.into_iter().flatten().copied().collect()
}

/// Largest magnitude of the joint's own answer.
fn farthest(rig: &Rig, blocks: &[Block], problem: &Problem, whole: &Fit) -> f64 {
    let (program, _) = program(problem, rig, blocks);
    let predicted = program.predict(&whole.coefficients, &whole.acting());
    let answers = predicted.iter().flat_map(|p| match problem.operators.form {
        Form::Play => &p.truth.displacement,
        Form::Stop => &p.truth.force,
    });
    answers.fold(0.0, |far: f64, x| match x.is_finite() {
        true => far.max(x.abs()),
        false => f64::INFINITY,
    })
}
