//! A program for open questions, and how far it would settle each of them.

use super::answered::within;
use super::design::{BLOCKS, BLOCKS_TO_SHOW, Chosen, Design, Question, program, refitted};
use super::limits::{Limits, rigs};
use super::program::Rig;
use super::standing::{Standing, least};
use crate::causes::Cause;
use crate::diagnose::prepare::Bench;
use crate::identify::{Fit, Problem};
use crate::joint::effect::Acting;
use rayon::prelude::*;

/// What the records told.
pub struct Told<'a> {
    /// The records.
    pub bench: &'a Bench,
    /// Their loading, as a look ahead takes it.
    pub problem: &'a Problem,
    /// Causes that were fitted, with their values.
    pub known: &'a [(&'static dyn Cause, Acting)],
    /// The joint.
    pub whole: &'a Fit,
    /// True where the questions are of causes that are ambiguous, not of ones that may be hidden.
    pub ambiguous: bool,
}

/// Questions, a program for them, and how each stands without it and with it.
#[derive(Default)]
pub struct Plan {
    /// What is asked.
    pub questions: Vec<Question>,
    /// The program; `None` where none is worth running.
    pub chosen: Option<Chosen>,
    before: Vec<Standing>,
    after: Vec<Standing>,
}

impl Plan {
    /// True where every question would be settled.
    pub fn settles(&self) -> bool {
        self.chosen.is_some() && self.after.iter().all(|s| s.ratio() >= 1.0)
    }

    /// Least χ² between rivals with the records so far, as the map gives it where it does.
    pub fn before(&self) -> f64 {
        let mapped = self.questions.iter().filter_map(|q| q.mapped);
        let mapped = mapped.min_by(f64::total_cmp);
        mapped.unwrap_or_else(|| least(&self.before).map_or(f64::NAN, |s| s.lambda))
    }

    /// The question that would be settled least with the best program; `None` where none could be tried.
    pub fn after(&self) -> Option<Standing> {
        least(&self.after)
    }

    /// Whether the program is worth running for each of the questions: a pair is told apart whichever of the two acts.
    fn served(&self) -> Vec<bool> {
        let gains = |q: usize| match (self.before.get(q), self.after.get(q)) {
            (Some(before), Some(after)) => after.is_worth_more_than(before),
            _ => false,
        };
        let all = 0..self.questions.len();
        all.clone()
            .map(|q| {
                let pair = |other: &usize| self.questions[*other].is_of_pair(&self.questions[q]);
                all.clone().filter(pair).all(gains)
            })
            .collect()
    }

    /// Leaves out the questions that are not marked.
    fn keep(&mut self, marked: &[bool]) {
        fn kept<T>(all: &mut Vec<T>, marked: &[bool]) {
            let mut marks = marked.iter();
            all.retain(|_| marks.next().is_some_and(|m| *m));
        }
        kept(&mut self.questions, marked);
        kept(&mut self.before, marked);
        kept(&mut self.after, marked);
    }
}

impl Told<'_> {
    /// Rigs to try, in the order of how far they go beyond what was measured; none lets the joint answer
    /// beyond the limit of the channel that is not prescribed.
    pub fn rigs(&self, limits: &Limits) -> Vec<Rig> {
        let rigs = rigs(self.bench, limits);
        let Some(most) = limits.of_answer(self.problem.operators.form) else {
            return rigs;
        };
        let narrowed = rigs.into_par_iter();
        let narrowed = narrowed.map(|rig| within(rig, most, self.problem, self.whole));
        let mut narrowed: Vec<Rig> = narrowed.collect();
        narrowed.dedup();
        narrowed
    }

    /// The best program for those of the questions that one is worth running for, and the others.
    pub fn plan(&self, asked: Vec<Question>, rigs: &[Rig]) -> (Plan, Vec<Question>) {
        let mut plan = self.planned(asked, rigs);
        let served = plan.served();
        if !served.contains(&true) {
            plan.chosen = None;
            return (plan, Vec::new());
        }
        let marked = |mark: bool| -> Vec<Question> {
            let both = plan.questions.iter().zip(&served);
            both.filter(|(_, m)| **m == mark)
                .map(|(question, _)| question.clone())
                .collect()
        };
        let missed = marked(false);
        if !missed.is_empty() && !self.ambiguous {
            plan.keep(&served);
        } else if !missed.is_empty() {
            // A program that need not try what is hopeless does more for the rest.
            let again = self.planned(marked(true), rigs);
            match again.served().contains(&false) {
                false => plan = again,
                true => plan.keep(&served),
            }
        }
        (plan, missed)
    }

    /// True where the rigs settle the questions, to first order.
    pub fn would_settle(&self, asked: &[Question], rigs: &[Rig]) -> bool {
        let chosen = self.design(asked).choose(rigs, self.most());
        chosen.is_some_and(|chosen| chosen.after.iter().all(|s| s.ratio() >= 1.0))
    }

    fn most(&self) -> usize {
        match self.ambiguous {
            true => BLOCKS,
            false => BLOCKS_TO_SHOW,
        }
    }

    fn design<'b>(&'b self, questions: &'b [Question]) -> Design<'b> {
        let rows = self.bench.whole.rows() as f64;
        let coefficients = &self.whole.coefficients;
        Design::new(
            self.problem,
            coefficients,
            questions,
            rows,
            &self.bench.scale,
        )
    }

    fn planned(&self, questions: Vec<Question>, rigs: &[Rig]) -> Plan {
        let design = self.design(&questions);
        let chosen = design.choose(rigs, self.most());
        let (before, after) = match &chosen {
            None => (Vec::new(), Vec::new()),
            Some(chosen) if self.ambiguous => self.refits(&design, chosen),
            Some(chosen) => (chosen.before.clone(), chosen.after.clone()),
        };
        Plan {
            questions,
            chosen,
            before,
            after,
        }
    }

    /// Every question before and after, by joint refits of every rival to every other.
    fn refits(&self, design: &Design, chosen: &Chosen) -> (Vec<Standing>, Vec<Standing>) {
        let whole = self.whole;
        let mut both = design.problem.clone();
        let (program, more) = program(design.problem, &chosen.rig, &chosen.blocks);
        both.records.extend(program.records);
        let asked: Vec<&str> = design.questions.iter().map(|q| q.cause.name()).collect();
        let others: Vec<Acting> = whole
            .effects
            .iter()
            .filter(|a| !asked.contains(&a.effect.name()))
            .cloned()
            .collect();
        let standings = |problem: &Problem, rows: f64| {
            let each = design.questions.par_iter().map(|question| {
                let rival = self.known.iter().find(|k| k.0.name() == question.rival);
                let left = |rival: Option<&Acting>| {
                    refitted(problem, whole, &question.acting, rival, &others)
                };
                Standing::new(left(rival.map(|k| &k.1)), left(None), rows)
            });
            each.collect::<Vec<_>>()
        };
        (
            standings(design.problem, design.rows),
            standings(&both, design.rows + more),
        )
    }
}
