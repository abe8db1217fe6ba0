//! λ_sep of every cause on the records' own loading: the least χ² that any rival, refitted with
//! the baseline, leaves of what the cause alone would add, free of noise.
//!
//! To first order in the rival: its signature and a bend of it for each of its parameters enter as
//! columns beside the dictionary, whose coefficients stay non-negative. A bend may go further than
//! the rival's law would, so that λ_sep errs to the low side.

use rayon::prelude::*;

use super::gram::Gram;
use super::shape::{Shape, columns, products, shapes};
use crate::causes::{Cause, Scale};
use crate::diagnose::gain::energy;
use crate::identify::Problem;
use crate::joint::effect::Acting;
use crate::record::cycles::cycles;
use crate::record::cycles::rms;

/// χ² from which on two causes are told apart safely: at 25 a likelihood ratio of exp(−12).
pub const TOLD: f64 = 25.0;

/// Share of the energy per cycle that matters.
pub const ENERGY: f64 = 0.05;

/// Share of the judged channel's rms that matters.
pub const MOTION: f64 = 0.02;

/// Separability of one cause.
#[derive(Debug, Clone, PartialEq)]
pub struct Separable {
    /// Catalogue name.
    pub name: String,
    /// True where it was taken as fitted; false where at a size that would matter.
    pub fitted: bool,
    /// The values it was taken at: glossary name, value, unit.
    pub values: Vec<(String, f64, String)>,
    /// Least χ² that any rival leaves.
    pub lambda: f64,
    /// χ² that the refitted baseline alone leaves.
    pub baseline: f64,
    /// What it is mistaken for: rivals that leave less than [`TOLD`], or the nearest one, with the
    /// χ² that each leaves; `none` for the baseline alone.
    pub rivals: Vec<(String, f64)>,
    /// The χ² that every rival leaves, `none` first: a row of the map. Beside the nearest ones
    /// without regard to the bounds of the dictionary, so that it errs to the low side.
    pub row: Vec<(String, f64)>,
}

/// The map, and what the design of an experiment needs of it.
pub struct Map {
    /// One line per cause.
    pub lines: Vec<Separable>,
    /// The shape behind each line, at the line's size.
    pub shown: Vec<Acting>,
}

/// The map for the loading of a problem, about the joint of the given coefficients.
pub fn map(
    problem: &Problem,
    coefficients: &[f64],
    causes: &[&'static dyn Cause],
    scale: &Scale,
    named: &[(&'static dyn Cause, Acting)],
) -> Map {
    let shapes = shapes(causes, scale, named);
    let extra = columns(problem, coefficients, &shapes);
    let gram = products(problem, coefficients, &extra);
    let look = Look {
        coefficients,
        swept: swept(&gram, coefficients),
        gram,
        shapes: &shapes,
    };
    let sizes = sizes(problem, coefficients, &shapes, &extra);
    let lines: Vec<(Separable, Acting)> = causes
        .par_iter()
        .filter_map(|cause| {
            let own = |fitted: bool| {
                let all = shapes.iter().zip(&sizes);
                all.filter(move |(s, _)| s.cause.name() == cause.name() && s.fitted == fitted)
            };
            // As fitted where it is; else at the shape that shows best.
            let lines: Vec<(Separable, Acting)> = if own(true).next().is_some() {
                own(true).map(|(shape, _)| look.line(shape, 1.0)).collect()
            } else {
                let far = own(false).map(|(shape, size)| (look.far(shape, *size), shape, size));
                let best = far.max_by(|a, b| a.0.total_cmp(&b.0));
                best.map(|(_, shape, size)| look.line(shape, *size))
                    .into_iter()
                    .collect()
            };
            lines
                .into_iter()
                .max_by(|a, b| a.0.lambda.total_cmp(&b.0.lambda))
        })
        .collect();
    let (lines, shown) = lines.into_iter().unzip();
    Map { lines, shown }
}

/// The products with the dictionary's columns in use projected off.
pub(super) fn swept(gram: &Gram, coefficients: &[f64]) -> Gram {
    let used: Vec<usize> = (0..coefficients.len())
        .filter(|&i| coefficients[i] > 0.0)
        .collect();
    let mut swept = gram.clone();
    swept.sweep(&used);
    swept
}

struct Look<'a> {
    coefficients: &'a [f64],
    gram: Gram,
    swept: Gram,
    shapes: &'a [Shape],
}

/// Rivals that are looked at with the bounds of the dictionary, nearest first.
const CLOSELY: usize = 4;

impl Look<'_> {
    fn place(&self, shape: &Shape) -> usize {
        self.coefficients.len() + shape.first
    }

    /// Least χ² beside any rival shape, without regard to bounds.
    fn far(&self, of: &Shape, size: f64) -> f64 {
        let place = self.place(of);
        self.rivals(of)
            .map(|rival| self.left(place, rival))
            .fold(self.swept.at(place, place), f64::min)
            .max(0.0)
            * size
            * size
    }

    fn rivals<'b>(&'b self, of: &'b Shape) -> impl Iterator<Item = &'b Shape> {
        let shapes = self.shapes.iter();
        shapes.filter(|s| s.cause.name() != of.cause.name())
    }

    fn left(&self, of: usize, rival: &Shape) -> f64 {
        let given: Vec<usize> = rival
            .members(self.coefficients.len())
            .iter()
            .map(|m| m.0)
            .collect();
        self.swept.left(of, &given)
    }

    fn line(&self, of: &Shape, size: f64) -> (Separable, Acting) {
        let place = self.place(of);
        let refitted =
            |given: &[(usize, bool)]| self.gram.refitted(self.coefficients, place, size, given);
        let baseline = refitted(&[]);
        // Best shape of every rival.
        let mut near: Vec<(f64, &Shape)> = Vec::new();
        for rival in self.rivals(of) {
            let left = self.left(place, rival) * size * size;
            match near
                .iter_mut()
                .find(|n| n.1.cause.name() == rival.cause.name())
            {
                Some(known) if left < known.0 => *known = (left, rival),
                Some(_) => {}
                None => near.push((left, rival)),
            }
        }
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        let left = near.iter().enumerate().map(|(k, (far, rival))| {
            let left = match k < CLOSELY || *far < TOLD {
                true => refitted(&rival.members(self.coefficients.len())),
                false => *far,
            };
            (rival.cause.name().to_string(), left.min(baseline))
        });
        let row: Vec<(String, f64)> = std::iter::once(("none".to_string(), baseline))
            .chain(left)
            .collect();
        let mut rivals = row.clone();
        rivals.sort_by(|a, b| a.1.total_cmp(&b.1));
        if baseline < TOLD {
            // What the baseline takes as its own is no matter of rivals.
            rivals.retain(|r| r.0 == "none");
        }
        let lambda = rivals.first().map_or(0.0, |r| r.1);
        let told = rivals.iter().filter(|r| r.1 < TOLD).count().max(1);
        rivals.truncate(told);
        let acting = sized(&of.acting, size);
        let values = of.acting.effect.parameters().iter().zip(&acting.values);
        let line = Separable {
            name: of.cause.name().to_string(),
            fitted: of.fitted,
            values: values
                .map(|(p, value)| (p.name.to_string(), *value, p.unit.to_string()))
                .collect(),
            lambda,
            baseline,
            rivals,
            row,
        };
        (line, acting)
    }
}

/// The effect with its size multiplied, inside its bounds.
fn sized(acting: &Acting, size: f64) -> Acting {
    let mut sized = acting.clone();
    for (value, parameter) in sized.values.iter_mut().zip(acting.effect.parameters()) {
        if let Some(zero) = parameter.vanishes_at {
            *value = (zero + size * (*value - zero)).clamp(parameter.lower, parameter.upper);
        }
    }
    sized
}

/// By how much each shape's start has to be multiplied to matter: to change the energy per cycle
/// by [`ENERGY`] or the judged channel by [`MOTION`] of its rms, whichever takes less, and no
/// further than its bounds allow.
fn sizes(
    problem: &Problem,
    coefficients: &[f64],
    shapes: &[Shape],
    extra: &[Vec<Vec<f64>>],
) -> Vec<f64> {
    let without = problem.predict(coefficients, &[]);
    let form = problem.operators.form;
    let turns: Vec<_> = (0..problem.records.len())
        .map(|k| cycles(problem.channels(k).0))
        .collect();
    shapes
        .iter()
        .map(|shape| {
            let own = &extra[shape.first];
            let (mut energies, mut count) = (0.0, 0.0);
            let (mut moved, mut all) = (0.0, 0.0);
            for (k, without) in without.iter().enumerate() {
                let (input, _) = problem.channels(k);
                for cycle in &turns[k] {
                    let before = energy(form, input, &without.judged, cycle.start, cycle.end);
                    // Energy is linear in the judged channel.
                    let change = energy(form, input, &own[k], cycle.start, cycle.end);
                    if before > 0.0 {
                        energies += (change / before).abs();
                        count += 1.0;
                    }
                }
                let samples = own[k].len() as f64;
                moved += samples * rms(&own[k]).powi(2);
                all += samples * rms(&without.judged).powi(2);
            }
            let by_energy = ENERGY * count / energies;
            let by_motion = MOTION * (all / moved).sqrt();
            let mut size = if by_energy.is_finite() {
                by_energy.min(by_motion)
            } else {
                by_motion
            };
            let parameters = shape.acting.effect.parameters().iter();
            for (parameter, value) in parameters.zip(&shape.acting.values) {
                if let Some(zero) = parameter.vanishes_at.filter(|zero| zero != value) {
                    let bound = if *value > zero {
                        parameter.upper
                    } else {
                        parameter.lower
                    };
                    size = size.min((bound - zero) / (value - zero));
                }
            }
            if size.is_finite() { size } else { 0.0 }
        })
        .collect()
}
