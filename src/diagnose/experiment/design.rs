//! The next experiment: of all programs of the menu the one whose worst pair of rivals, each
//! refitted to the other, is told apart best (T-optimal).

use rayon::prelude::*;

use super::gram::Gram;
use super::program::{Block, Rig};
use super::separability::{TOLD, swept};
use super::shape::{Shape, columns, products, shapes};
use crate::causes::{Cause, Scale};
use crate::diagnose::search::NEARLY;
use crate::identify::{Fit, Form, Prepared, Problem, refit};
use crate::joint::effect::Acting;

/// A question that an experiment shall settle: is it this, or the rival?
#[derive(Debug, Clone)]
pub struct Question {
    /// What acts.
    pub cause: &'static dyn Cause,
    /// How strongly.
    pub acting: Acting,
    /// Catalogue name of the rival; `none` for the baseline alone.
    pub rival: String,
}

/// Blocks of a program at most.
const BLOCKS: usize = 6;

/// χ² at which a program is long enough: four times what tells two causes apart.
const ENOUGH: f64 = 4.0 * TOLD;

/// Multiple of [`NEARLY`] beyond which a larger share is no better.
const CLEARLY: f64 = 2.0;

/// What is known before the experiment, and what is asked.
pub struct Design<'a> {
    /// The loading so far.
    pub problem: &'a Problem,
    /// The joint.
    pub coefficients: &'a [f64],
    /// Questions to settle.
    pub questions: &'a [Question],
    /// The rig.
    pub rig: Rig,
    shapes: Vec<Shape>,
    before: Gram,
}

/// A chosen program.
pub struct Chosen {
    /// Its blocks.
    pub blocks: Vec<Block>,
    /// χ² per question with the loading so far, and with the program besides (first order).
    pub lambdas: Vec<(f64, f64)>,
    /// Least share that a rival leaves, with the program, of what the cause brings.
    pub share: f64,
}

impl<'a> Design<'a> {
    /// Prepares the columns of everything that is asked about.
    pub fn new(
        problem: &'a Problem,
        coefficients: &'a [f64],
        questions: &'a [Question],
        rig: Rig,
        scale: &Scale,
    ) -> Design<'a> {
        let mut asked: Vec<&'static dyn Cause> = Vec::new();
        let mut fitted: Vec<(&'static dyn Cause, Acting)> = Vec::new();
        for question in questions {
            fitted.push((question.cause, question.acting.clone()));
            let rival = crate::causes::find(&question.rival);
            asked.extend(rival.filter(|r| !asked.iter().any(|a| a.name() == r.name())));
        }
        let shapes = shapes(&asked, scale, &fitted);
        let before = products(
            problem,
            coefficients,
            &columns(problem, coefficients, &shapes),
        );
        Design {
            problem,
            coefficients,
            questions,
            rig,
            shapes,
            before,
        }
    }

    /// χ² of every question for the given products, and its share of what the cause brings.
    fn lambdas(&self, gram: &Gram) -> Vec<(f64, f64)> {
        let swept = swept(gram, self.coefficients);
        let columns = self.coefficients.len();
        let each = self.questions.iter().enumerate().map(|(q, question)| {
            // Shapes begin with those of the questions, in order.
            let of = columns + self.shapes[q].first;
            let rivals = self
                .shapes
                .iter()
                .filter(|s| s.cause.name() == question.rival);
            let alone = swept.at(of, of).max(0.0);
            let left = rivals
                .map(|rival| {
                    let given = rival.members(columns);
                    swept.left(of, &given.iter().map(|m| m.0).collect::<Vec<_>>())
                })
                .fold(alone, f64::min);
            match question.rival.as_str() {
                "none" => (left, 1.0),
                _ => (left, left / alone.max(f64::MIN_POSITIVE)),
            }
        });
        each.collect()
    }

    fn with(&self, blocks: &[Block]) -> Vec<(f64, f64)> {
        let program = program(self.problem, &self.rig, blocks);
        let extra = columns(&program, self.coefficients, &self.shapes);
        self.lambdas(
            &self
                .before
                .plus(&products(&program, self.coefficients, &extra)),
        )
    }

    /// Adds the block that helps most until every question is settled or the time is used up.
    pub fn choose(&self) -> Option<Chosen> {
        let before = self.lambdas(&self.before);
        let menu = self.rig.menu();
        let mut blocks: Vec<Block> = Vec::new();
        let mut best = before.clone();
        for _ in 0..BLOCKS {
            // The way back to zero at the end takes a cycle of the last block.
            let lasts = |b: &Block| b.seconds(&self.rig) + 1.0 / (b.rate * self.rig.rate);
            let used: f64 = blocks.iter().map(|b| b.seconds(&self.rig)).sum();
            let next = menu
                .par_iter()
                .filter(|block| used + lasts(block) <= self.rig.longest())
                .map(|block| {
                    let mut longer = blocks.clone();
                    longer.push(*block);
                    let lambdas = self.with(&longer);
                    (worth(&lambdas), longer, lambdas)
                })
                .max_by(|a, b| a.0.total_cmp(&b.0));
            let Some((gained, longer, lambdas)) = next else {
                break;
            };
            if gained <= worth(&best) {
                break;
            }
            (blocks, best) = (longer, lambdas);
            if best
                .iter()
                .all(|l| l.0 >= ENOUGH && l.1 >= CLEARLY * NEARLY)
            {
                break;
            }
        }
        (!blocks.is_empty()).then(|| Chosen {
            blocks,
            share: best.iter().map(|l| l.1).fold(f64::INFINITY, f64::min),
            lambdas: before.iter().zip(&best).map(|(b, a)| (b.0, a.0)).collect(),
        })
    }
}

/// The worst question first, beyond that the others: how far each is settled in χ² and as a share
/// of what its cause brings.
fn worth(lambdas: &[(f64, f64)]) -> f64 {
    let settled = || {
        let each = lambdas.iter();
        each.map(|l| l.0.min(ENOUGH) * (l.1 / NEARLY).min(CLEARLY))
    };
    let worst = settled().fold(f64::INFINITY, f64::min);
    worst + 0.1 * settled().sum::<f64>() / lambdas.len().max(1) as f64
}

/// A program as a problem of its own, measured as the records are.
pub fn program(problem: &Problem, rig: &Rig, blocks: &[Block]) -> Problem {
    let (time, values) = rig.play(blocks);
    let record = problem.records.iter().max_by(|a, b| {
        // The noisiest of the records: nothing is promised beyond it.
        let heavy = |r: &Prepared| r.weight.iter().copied().fold(0.0, f64::max);
        heavy(b).total_cmp(&heavy(a))
    });
    let weight = record.map_or(1.0, |r| r.weight.iter().copied().fold(0.0, f64::max));
    let autoregression = record.map_or(0.0, |r| r.autoregression);
    let count = values.len();
    let (force, displacement) = match problem.operators.form {
        Form::Play => (values, vec![0.0; count]),
        Form::Stop => (vec![0.0; count], values),
    };
    Problem {
        operators: problem.operators.clone(),
        records: vec![Prepared {
            name: "next_experiment".to_string(),
            steps: std::iter::once(0.0)
                .chain(std::iter::repeat_n(rig.step, count - 1))
                .collect(),
            time,
            force,
            displacement,
            weight: vec![weight; count],
            autoregression,
        }],
    }
}

/// χ² that a rival leaves when it is refitted, beside the `others`, to what `acting` would give
/// under the loading of the problem; no first order about it.
pub fn refitted(
    problem: &Problem,
    whole: &Fit,
    acting: &Acting,
    rival: Option<&Acting>,
    others: &[Acting],
) -> f64 {
    let with =
        |more: Option<&Acting>| -> Vec<Acting> { others.iter().chain(more).cloned().collect() };
    let acting = Fit {
        effects: with(Some(acting)),
        ..whole.clone()
    };
    let truth = problem.predict(&whole.coefficients, &acting.acting());
    let mut simulated = problem.clone();
    for (record, truth) in simulated.records.iter_mut().zip(truth) {
        match problem.operators.form {
            Form::Play => record.displacement = truth.judged,
            Form::Stop => record.force = truth.judged,
        }
    }
    let start = Fit {
        offsets: vec![0.0; problem.records.len()],
        effects: Vec::new(),
        misfit: f64::INFINITY,
        errors: Vec::new(),
        ..whole.clone()
    };
    refit(&simulated, &start, with(rival)).misfit
}
