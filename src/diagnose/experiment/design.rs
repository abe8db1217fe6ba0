//! The next experiment: of all programs of the menu the one whose worst pair of rivals, each
//! refitted to the other, is told apart best (T-optimal).

use rayon::prelude::*;

use super::gram::Gram;
use super::program::{Block, Played, Rig};
use super::separability::swept;
use super::shape::{Shape, columns, products, shapes};
use super::standing::{Standing, least};
use crate::causes::{Cause, Scale};
use crate::identify::{Fit, Form, Prepared, Problem, refit};
use crate::joint::effect::Acting;
use crate::record::Record;

/// A question that an experiment shall settle: is it this, or the rival?
#[derive(Debug, Clone)]
pub struct Question {
    /// What acts.
    pub cause: &'static dyn Cause,
    /// How strongly.
    pub acting: Acting,
    /// Catalogue name of the rival; `none` for the baseline alone.
    pub rival: String,
    /// χ² that the map gives for the records so far, where it is from there.
    pub mapped: Option<f64>,
}

impl Question {
    /// True where both are of the same two, whichever of them acts.
    pub fn is_of_pair(&self, other: &Question) -> bool {
        let pair = |q: &Question| (q.cause.name().to_string(), q.rival.clone());
        let (one, two) = (pair(self), pair(other));
        one == two || one == (two.1, two.0)
    }
}

/// Blocks at most of a program that tells apart what is ambiguous, and of one that shows what may be hidden.
pub const BLOCKS: usize = 6;
pub const BLOCKS_TO_SHOW: usize = 4;

/// Different blocks that a program has at least, where they bring anything: what one kind of block
/// tells apart hangs on the law of the cause being true there.
const KINDS: usize = 3;

/// Blocks that are tried first behind those before them, of all that fit: the others promise less by themselves already.
const PROMISING: usize = 4;

/// Worth of half a program below which the other half will not settle what is asked.
const HOPELESS: f64 = 0.05;

/// Multiple of what is needed at which a question is surely settled: the look ahead is of first
/// order, and noise takes its share.
const SURE: f64 = 4.0;

/// What is known before the experiment, and what is asked.
pub struct Design<'a> {
    /// The loading so far.
    pub problem: &'a Problem,
    /// The joint.
    pub coefficients: &'a [f64],
    /// Questions to settle.
    pub questions: &'a [Question],
    /// Samples of the records.
    pub rows: f64,
    shapes: Vec<Shape>,
    before: Gram,
}

/// A chosen program.
pub struct Chosen {
    /// The rig that plays it.
    pub rig: Rig,
    /// Its blocks.
    pub blocks: Vec<Block>,
    /// The questions with the loading so far, to first order.
    pub before: Vec<Standing>,
    /// The questions with the program besides, to first order.
    pub after: Vec<Standing>,
}

impl<'a> Design<'a> {
    /// Prepares the columns of everything that is asked about.
    pub fn new(
        problem: &'a Problem,
        coefficients: &'a [f64],
        questions: &'a [Question],
        rows: f64,
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
            rows,
            shapes,
            before,
        }
    }

    /// Every question for the given products of so many samples.
    fn standings(&self, gram: &Gram, rows: f64) -> Vec<Standing> {
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
            Standing::new(left, alone, rows)
        });
        each.collect()
    }

    /// Products of the samples of a program, and how many it has.
    fn products(&self, rig: &Rig, blocks: &[Block]) -> (Gram, f64) {
        let (program, samples) = program(self.problem, rig, blocks);
        let extra = columns(&program, self.coefficients, &self.shapes);
        let products = products(&program, self.coefficients, &extra);
        (products, samples)
    }

    /// Every question with such products besides.
    fn with(&self, (products, samples): &(Gram, f64)) -> Vec<Standing> {
        self.standings(&self.before.plus(products), self.rows + samples)
    }

    /// The program, of so many blocks at most, of the first rig that surely settles every question, else of the rig that comes
    /// nearest to it. Rigs come in the order of how far they go beyond what was measured: laws are
    /// truest near where they were fitted.
    pub fn choose(&self, rigs: &[Rig], most: usize) -> Option<Chosen> {
        let ratio = |chosen: &Chosen| least(&chosen.after).map_or(0.0, |s| s.ratio());
        let mut best: Option<Chosen> = None;
        for rig in rigs {
            let Some(chosen) = self.grown(*rig, most) else {
                continue;
            };
            if ratio(&chosen) > best.as_ref().map_or(0.0, ratio) {
                best = Some(chosen);
            }
            if best.as_ref().map_or(0.0, ratio) >= SURE {
                break;
            }
        }
        best
    }

    /// Adds the block that helps most until every question is settled or the time is used up: of those of which what
    /// each gives by itself, from a virgin joint, promises most beside the blocks before it.
    fn grown(&self, rig: Rig, most: usize) -> Option<Chosen> {
        let before = self.standings(&self.before, self.rows);
        let menu = rig.menu();
        let alone: Vec<(Gram, f64)> = menu
            .par_iter()
            .map(|block| self.products(&rig, &[*block]))
            .collect();
        let mut blocks: Vec<Block> = Vec::new();
        let mut so_far = (Gram::new(self.before.size), 0.0);
        let mut best = before.clone();
        while blocks.len() < most {
            // The way back to zero at the end takes a cycle of the last block.
            let lasts = |b: &Block| b.seconds(&rig) + 1.0 / (b.rate * rig.rate);
            let used: f64 = blocks.iter().map(|b| b.seconds(&rig)).sum();
            let fitting = menu
                .iter()
                .zip(&alone)
                .filter(|(block, _)| used + lasts(block) <= rig.longest())
                .filter(|(block, _)| blocks.len() >= KINDS || !blocks.contains(block));
            let mut promising: Vec<(f64, Block, &(Gram, f64))> = fitting
                .map(|(block, alone)| {
                    let both = (so_far.0.plus(&alone.0), so_far.1 + alone.1);
                    (worth(&self.with(&both)), *block, alone)
                })
                .collect();
            promising.sort_by(|a, b| b.0.total_cmp(&a.0));
            let other = promising.split_off(PROMISING.min(promising.len()));
            let helps = |tried: &(f64, Block, (Gram, f64))| tried.0 > worth(&best);
            let better = |some: &[(f64, Block, &(Gram, f64))]| {
                let tried = some.par_iter().map(|(_, block, alone)| {
                    let products = match blocks.is_empty() {
                        true => (*alone).clone(),
                        false => self.products(&rig, &[&blocks[..], &[*block]].concat()),
                    };
                    (worth(&self.with(&products)), *block, products)
                });
                let best = tried.max_by(|a, b| a.0.total_cmp(&b.0));
                best.filter(helps)
            };
            // What a block does behind others may be more than by itself, to wear above all.
            let Some((_, block, products)) = better(&promising).or_else(|| better(&other)) else {
                break;
            };
            blocks.push(block);
            best = self.with(&products);
            so_far = products;
            if blocks.len() == KINDS && worth(&best) < HOPELESS {
                break;
            }
            if blocks.len() >= KINDS && best.iter().all(|s| s.ratio() >= SURE) {
                break;
            }
        }
        (!blocks.is_empty()).then_some(Chosen {
            rig,
            blocks,
            before,
            after: best,
        })
    }
}

/// The worst question first, beyond that the others; beyond what is sure a larger χ² still counts,
/// but little.
fn worth(standings: &[Standing]) -> f64 {
    let settled = || {
        standings.iter().map(|s| {
            let ratio = s.ratio() / SURE;
            ratio.min(1.0) + 0.05 * ratio.max(1.0).ln()
        })
    };
    let worst = settled().fold(f64::INFINITY, f64::min);
    worst + 0.1 * settled().sum::<f64>() / standings.len().max(1) as f64
}

/// A program as a problem of its own, measured as the records are, by the samples that show its course; and
/// how many it has in all.
pub fn program(problem: &Problem, rig: &Rig, blocks: &[Block]) -> (Problem, f64) {
    let Played {
        time,
        values,
        shown,
    } = rig.play(blocks);
    let count = values.len();
    let (force, displacement) = match problem.operators.form {
        Form::Play => (values, vec![0.0; count]),
        Form::Stop => (vec![0.0; count], values),
    };
    let played = Record {
        name: "next_experiment".to_string(),
        time: Some(time),
        force,
        displacement,
        ..Record::default()
    };
    let mut record = Prepared {
        weight: vec![rig.weight; count],
        colour: rig.colour,
        ..Prepared::new(&played, problem.operators.form)
    };
    record.keep(&shown);
    let program = Problem {
        operators: problem.operators.clone(),
        records: vec![record],
        ..*problem
    };
    (program, count as f64)
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
        ..whole.clone()
    };
    refit(&simulated, &start, with(rival)).misfit
}
