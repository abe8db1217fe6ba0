//! The operator dictionary: a fixed grid of thresholds on which any Masing joint is linear.

use crate::joint::effect::Place;
use crate::record::Record;

/// Which of the two dual forms a record is judged in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Force in, displacement judged: play operators with compliances (THEORY: the dual).
    Play,
    /// Displacement in, force judged: stop operators with stiffnesses; for deep slip.
    Stop,
}

impl Form {
    /// The input: its name and unit.
    pub fn input(self) -> (&'static str, &'static str) {
        match self {
            Form::Play => ("force", "N"),
            Form::Stop => ("displacement", "m"),
        }
    }

    /// What is judged: its name and unit.
    pub fn judged(self) -> (&'static str, &'static str) {
        match self {
            Form::Play => Form::Stop.input(),
            Form::Stop => Form::Play.input(),
        }
    }

    /// Input and judged channel of a record.
    pub fn channels(self, record: &Record) -> (&[f64], &[f64]) {
        match self {
            Form::Play => (&record.force, &record.displacement),
            Form::Stop => (&record.displacement, &record.force),
        }
    }

    /// The same to be changed.
    pub fn channels_mut(self, record: &mut Record) -> (&mut Vec<f64>, &mut Vec<f64>) {
        match self {
            Form::Play => (&mut record.force, &mut record.displacement),
            Form::Stop => (&mut record.displacement, &mut record.force),
        }
    }

    /// The input's channel, as a place where effects act.
    pub fn input_place(self) -> Place {
        match self {
            Form::Play => Place::ForceChannel,
            Form::Stop => Place::DisplacementChannel,
        }
    }

    /// The judged channel, as such a place.
    pub fn judged_place(self) -> Place {
        match self {
            Form::Play => Place::DisplacementChannel,
            Form::Stop => Place::ForceChannel,
        }
    }
}

/// Cells of thresholds, in units of the input channel.
///
/// One coefficient stands for a whole cell, shared evenly by [`SHARED`] thresholds in it: a density
/// constant over the cell. Point masses at the cells' edges would need the square of as many
/// columns for the same error near full slip, where compliance rises steeply.
#[derive(Debug, Clone, PartialEq)]
pub struct Operators {
    /// Play or stop.
    pub form: Form,
    /// Upper edges of the cells within the range of the input, increasing; the first cell starts
    /// at zero. [`BEYOND`] more lie above the last.
    pub edges: Vec<f64>,
    /// `r_j` \[N\] for plays, `d_j` \[m\] for stops; [`SHARED`] per cell, increasing, those of
    /// the cells beyond the range last.
    pub thresholds: Vec<f64>,
}

/// Thresholds that share one coefficient.
pub const SHARED: usize = 4;

/// Count of cells: fine enough that the virgin curve errs by far less than the noise of any record
/// (checked on noise-free records by the tests of this room).
pub const COUNT: usize = 40;

/// Cells beyond the range of the input, for effects that let operators slip which the input alone
/// would not reach: limits that depend on direction, rate or history, and corrected inputs.
pub const BEYOND: usize = 8;

/// Ratio of the edges of neighbouring cells beyond the range: limits down to 0.4 of the virgin ones
/// are covered.
const WIDER: f64 = 1.12;

impl Operators {
    /// Grid for an input whose largest magnitude is `range`.
    ///
    /// Plays crowd towards the largest force, `(j/N)^1.4`, because compliance rises there; stops
    /// are spread geometrically over three decades because stiffness falls from the start.
    pub fn grid(form: Form, range: f64) -> Operators {
        let edges = match form {
            Form::Play => (1..=COUNT)
                .map(|j| range * (j as f64 / COUNT as f64).powf(1.4))
                .collect(),
            Form::Stop => {
                let small = COUNT * 2 / 3;
                let large = COUNT - small;
                let mut grid: Vec<f64> = (0..small)
                    .map(|j| range * 1e-3_f64.powf(1.0 - j as f64 / small as f64))
                    .chain((1..=large).map(|j| range * (j as f64 / large as f64)))
                    .collect();
                grid.sort_by(f64::total_cmp);
                grid
            }
        };
        Operators::with_edges(form, edges)
    }

    pub(super) fn with_edges(form: Form, edges: Vec<f64>) -> Operators {
        let mut from = 0.0;
        let mut thresholds = Vec::with_capacity((edges.len() + BEYOND) * SHARED);
        let top = edges.last().copied().unwrap_or(0.0);
        let beyond = (1..=BEYOND).map(|j| top * WIDER.powi(j as i32));
        for to in edges.iter().copied().chain(beyond) {
            for part in 0..SHARED {
                thresholds.push(from + (to - from) * (part as f64 + 0.5) / SHARED as f64);
            }
            from = to;
        }
        Operators {
            form,
            edges,
            thresholds,
        }
    }

    /// Thresholds with their weights, from one coefficient per cell; of the first cells where fewer are
    /// given, and of those alone whose coefficient is `wanted`.
    pub fn spread<'a>(
        &'a self,
        cells: &'a [f64],
        wanted: impl Fn(f64) -> bool + 'a,
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.thresholds
            .chunks_exact(SHARED)
            .zip(cells)
            .filter(move |(_, coefficient)| wanted(**coefficient))
            .flat_map(|(cell, c)| cell.iter().map(move |&r| (r, c / SHARED as f64)))
    }

    /// A grid of so many cells, spread so that each cell holds as much of the cube root of the
    /// identified density: a piecewise-linear virgin curve errs by spacing² × curvature, and its
    /// squared error over the range is least when spacing³ × curvature is everywhere the same.
    ///
    /// `coefficients` are those fitted on this grid, the elastic one first. A third of the cells
    /// stays where it was, so that no part of the range is left without thresholds.
    pub fn adapted(&self, coefficients: &[f64], cells: usize) -> Operators {
        let n = self.edges.len();
        let Some(&top) = self.edges.last() else {
            return self.clone();
        };
        let edge = |j: usize| if j == 0 { 0.0 } else { self.edges[j - 1] };
        let width = |j: usize| self.edges[j] - edge(j);
        // Averaged over neighbours: a continuous density comes out of non-negative least squares
        // as separate cells.
        let density: Vec<f64> = (0..n)
            .map(|j| {
                let (from, to) = (j.saturating_sub(2), (j + 2).min(n - 1));
                let mass: f64 = coefficients[1 + from..=1 + to].iter().sum();
                (mass / (self.edges[to] - edge(from))).cbrt()
            })
            .collect();
        let total: f64 = (0..n).map(|j| density[j] * width(j)).sum();
        if total <= 0.0 {
            return self.clone();
        }
        let kept = 1.0 / 3.0;
        let mut reached = 0.0;
        let mut edges = Vec::with_capacity(cells);
        let mut next = 1;
        for (j, own) in density.iter().enumerate() {
            let share = kept / n as f64 + (1.0 - kept) * own * width(j) / total;
            while next <= cells && (next as f64 / cells as f64) <= reached + share + 1e-12 {
                let fraction = ((next as f64 / cells as f64) - reached) / share;
                edges.push((edge(j) + fraction * width(j)).min(top));
                next += 1;
            }
            reached += share;
        }
        Operators::with_edges(self.form, edges)
    }

    /// Coefficients of the same joint on other cells of the same range: what a cell holds is spread evenly over it.
    pub fn carried(&self, coefficients: &[f64], to: &Operators) -> Vec<f64> {
        let edges = self.edges.len();
        let mut sums = vec![0.0];
        for cell in &coefficients[1..=edges] {
            sums.push(sums[sums.len() - 1] + cell);
        }
        let up_to = |edge: f64| {
            let cell = self.edges.partition_point(|e| *e < edge).min(edges - 1);
            let from = if cell == 0 { 0.0 } else { self.edges[cell - 1] };
            let share = ((edge - from) / (self.edges[cell] - from)).clamp(0.0, 1.0);
            sums[cell] + share * (sums[cell + 1] - sums[cell])
        };
        let mut carried = vec![coefficients[0]];
        let mut before = 0.0;
        for edge in &to.edges {
            let sum = up_to(*edge);
            carried.push(sum - before);
            before = sum;
        }
        carried.extend(&coefficients[1 + edges..]);
        carried
    }

    /// Count of columns: the elastic one and one per cell.
    pub fn columns(&self) -> usize {
        self.thresholds.len() / SHARED + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one joint every grid has the same compliance up to an edge that both share, and none loses any.
    #[test]
    fn a_joint_is_carried_to_other_cells_whole() {
        let grid = Operators::grid(Form::Play, 10.0);
        let coefficients: Vec<f64> = (0..grid.columns()).map(|j| 1.0 + j as f64 % 3.0).collect();
        let same = grid.carried(&coefficients, &grid);
        let off = same.iter().zip(&coefficients).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 1e-12);
        let edges: Vec<f64> = (1..=25).map(|j| 0.4 * f64::from(j)).collect();
        let other = Operators::with_edges(Form::Play, edges);
        let carried = grid.carried(&coefficients, &other);
        assert_eq!(carried.len(), other.columns());
        let whole = |c: &[f64]| c.iter().sum::<f64>();
        assert!((whole(&carried) - whole(&coefficients)).abs() < 1e-9);
        // A cell that holds the first one of the grid whole and a part of the next.
        let [first, second] = [grid.edges[0], grid.edges[1]];
        let coarse = Operators::with_edges(Form::Play, vec![0.5 * (first + second), 10.0]);
        let part = grid.carried(&coefficients, &coarse)[1];
        assert!((part - coefficients[1] - 0.5 * coefficients[2]).abs() < 1e-12);
    }
}
