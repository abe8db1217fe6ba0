//! The same joint on a grid of half the spacing: what the grid itself does to a fit.

use super::operators::Operators;
use super::problem::Problem;

/// The problem on cells of half the width, and the coefficients that mean the same joint there.
pub fn finer(problem: &Problem, coefficients: &[f64]) -> (Problem, Vec<f64>) {
    let edges = &problem.operators.edges;
    let mut halved = Vec::with_capacity(2 * edges.len());
    let mut shared = vec![coefficients[0]];
    let mut from = 0.0;
    for (&to, &coefficient) in edges.iter().zip(&coefficients[1..]) {
        halved.extend([0.5 * (from + to), to]);
        shared.extend([0.5 * coefficient; 2]);
        from = to;
    }
    // Cells that are no edge's are the same on either grid.
    shared.extend(&coefficients[1 + edges.len()..]);
    let finer = Problem {
        operators: Operators::with_edges(problem.operators.form, halved),
        records: problem.records.clone(),
        ..*problem
    };
    (finer, shared)
}
