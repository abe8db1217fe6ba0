//! Non-negative least squares on normal equations, with free unknowns beside the bounded ones.

/// Normal equations `A x = b` of a weighted least-squares problem; `A` symmetric, row by row.
#[derive(Debug, Clone, PartialEq)]
pub struct Normal {
    /// Count of unknowns.
    pub size: usize,
    /// `XᵀX`, `size × size`, both triangles filled.
    pub gram: Vec<f64>,
    /// `Xᵀy`.
    pub right: Vec<f64>,
    /// `yᵀy`.
    pub square: f64,
    /// Count of rows that went in.
    pub rows: f64,
}

impl Normal {
    /// Empty equations for `size` unknowns.
    pub fn new(size: usize) -> Normal {
        Normal {
            size,
            gram: vec![0.0; size * size],
            right: vec![0.0; size],
            square: 0.0,
            rows: 0.0,
        }
    }

    /// Adds one weighted row; only the upper triangle is kept until [`Normal::mirror`].
    #[inline]
    pub fn add(&mut self, row: &[f64], target: f64) {
        let n = self.size;
        for (i, &value) in row.iter().enumerate() {
            if value != 0.0 {
                let line = &mut self.gram[i * n + i..(i + 1) * n];
                for (sum, &other) in line.iter_mut().zip(&row[i..]) {
                    *sum += value * other;
                }
                self.right[i] += value * target;
            }
        }
        self.square += target * target;
        self.rows += 1.0;
    }

    /// Adds other equations for the same unknowns.
    pub fn merge(&mut self, other: &Normal) {
        for (sum, value) in self.gram.iter_mut().zip(&other.gram) {
            *sum += value;
        }
        for (sum, value) in self.right.iter_mut().zip(&other.right) {
            *sum += value;
        }
        self.square += other.square;
        self.rows += other.rows;
    }

    /// The equations of the first `size` unknowns alone, both triangles as they are.
    pub fn leading(&self, size: usize) -> Normal {
        let lines = self.gram.chunks_exact(self.size.max(1)).take(size);
        Normal {
            size,
            gram: lines.flat_map(|line| &line[..size]).copied().collect(),
            right: self.right[..size].to_vec(),
            ..*self
        }
    }

    /// Fills the lower triangle.
    pub fn mirror(&mut self) {
        for i in 0..self.size {
            for j in 0..i {
                self.gram[i * self.size + j] = self.gram[j * self.size + i];
            }
        }
    }

    /// Makes moves of unknown `i` dearer by a share of its own square (Levenberg–Marquardt).
    pub fn damp(&mut self, i: usize, share: f64) {
        self.gram[i * self.size + i] *= 1.0 + share;
    }

    /// Makes moves of unknown `i` away from where it is dearer by a share of its own square.
    pub fn anchor(&mut self, i: usize, share: f64, at: f64) {
        let more = share * self.gram[i * self.size + i];
        self.gram[i * self.size + i] += more;
        self.right[i] += more * at;
        self.square += more * at * at;
    }

    /// Keeps unknown `i` at zero.
    pub fn hold(&mut self, i: usize) {
        for j in 0..self.size {
            self.gram[i * self.size + j] = 0.0;
            self.gram[j * self.size + i] = 0.0;
        }
        self.right[i] = 0.0;
    }

    /// Sum of squared residuals at `x`.
    pub fn misfit(&self, x: &[f64]) -> f64 {
        let mut sum = self.square;
        for i in 0..self.size {
            let line = &self.gram[i * self.size..(i + 1) * self.size];
            let product: f64 = line.iter().zip(x).map(|(a, b)| a * b).sum();
            sum += x[i] * (product - 2.0 * self.right[i]);
        }
        sum.max(0.0)
    }

    /// Minimises the sum of squares with `x_j ≥ 0` wherever `bounded[j]` (Lawson and Hanson's
    /// active set on normal equations; free unknowns are always in the passive set).
    ///
    /// Ends at a point that satisfies the Karush–Kuhn–Tucker conditions to rounding, checked by the
    /// tests below.
    pub fn solve(&self, bounded: &[bool]) -> Vec<f64> {
        let n = self.size;
        let scale = self.scale();
        let mut x = vec![0.0; n];
        let free: Vec<usize> = (0..n).filter(|&i| !bounded[i] && scale[i] > 0.0).collect();
        let mut passive = self.factor(&free);
        let tolerance = 1e-11 * self.square.sqrt();
        self.settle(&mut x, &mut passive, bounded);
        // Unknowns that were tried and came straight back: nearly equal columns do that to rounding.
        // They wait until another one has moved the solution.
        let mut waiting = vec![false; n];
        for _ in 0..4 * n {
            let gradient = |i: usize| -> f64 {
                let line = &self.gram[i * n..(i + 1) * n];
                (self.right[i] - dot(line, &x)) * scale[i]
            };
            let best = (0..n)
                .filter(|&i| bounded[i] && !passive.has(i) && !waiting[i] && scale[i] > 0.0)
                .map(|i| (i, gradient(i)))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            match best {
                Some((i, slope)) if slope > tolerance => {
                    passive.push(self, i);
                    let before = x.clone();
                    self.settle(&mut x, &mut passive, bounded);
                    if x == before {
                        if passive.has(i) {
                            passive = passive.without(self, |j| j == i);
                        }
                        waiting[i] = true;
                    } else {
                        waiting.iter_mut().for_each(|w| *w = false);
                    }
                }
                _ => break,
            }
        }
        x
    }

    /// Solves on the passive set, stepping back to the boundary whenever a bounded unknown would
    /// turn negative.
    fn settle(&self, x: &mut [f64], passive: &mut Factor, bounded: &[bool]) {
        while let Some(trial) = passive.solve(&self.right) {
            let both = || passive.members.iter().zip(&trial);
            let mut step = 1.0_f64;
            for (&i, &value) in both() {
                if bounded[i] && value <= 0.0 {
                    let fraction = x[i] / (x[i] - value);
                    step = step.min(if fraction.is_finite() { fraction } else { 0.0 });
                }
            }
            for (&i, &value) in both() {
                x[i] += step * (value - x[i]);
            }
            if step >= 1.0 {
                return;
            }
            let mut gone = vec![false; self.size];
            for (&i, &value) in both() {
                if bounded[i] && value <= 0.0 && x[i] <= 1e-14 * value.abs() {
                    (x[i], gone[i]) = (0.0, true);
                }
            }
            *passive = passive.without(self, |i| gone[i]);
        }
    }

    /// The equations of the given unknowns alone, ready to be solved for many right-hand sides.
    pub(super) fn factor(&self, members: &[usize]) -> Factor {
        let mut factor = Factor {
            members: Vec::with_capacity(self.size),
            is_member: vec![false; self.size],
            scale: self.scale(),
            rows: Vec::with_capacity(self.size * (self.size + 1) / 2),
        };
        members.iter().for_each(|&i| factor.push(self, i));
        factor
    }

    /// One over the root of the diagonal; zero where a column is empty.
    fn scale(&self) -> Vec<f64> {
        (0..self.size)
            .map(|i| {
                let diagonal = self.gram[i * self.size + i];
                if diagonal > 0.0 {
                    diagonal.sqrt().recip()
                } else {
                    0.0
                }
            })
            .collect()
    }
}

/// Cholesky factor of the equations of some unknowns, each scaled to unit diagonal.
pub(super) struct Factor {
    members: Vec<usize>,
    /// Of every unknown.
    is_member: Vec<bool>,
    /// Of every unknown.
    scale: Vec<f64>,
    /// Lower triangle, row by row.
    rows: Vec<f64>,
}

impl Factor {
    fn has(&self, i: usize) -> bool {
        self.is_member[i]
    }

    /// Row of a member, its diagonal last.
    fn row(&self, place: usize) -> &[f64] {
        let begins = place * (place + 1) / 2;
        &self.rows[begins..=begins + place]
    }

    /// Takes one more unknown in.
    fn push(&mut self, normal: &Normal, i: usize) {
        let line = &normal.gram[i * normal.size..(i + 1) * normal.size];
        let mut own: Vec<f64> = Vec::with_capacity(self.members.len() + 1);
        for (place, &j) in self.members.iter().enumerate() {
            let (diagonal, before) = self.row(place).split_last().unwrap_or((&1.0, &[]));
            let entry = line[j] * self.scale[i] * self.scale[j];
            own.push((entry - dot(&own, before)) / diagonal);
        }
        // Far below what the data resolve, so that nearly equal columns cannot break it.
        let entry = line[i] * self.scale[i] * self.scale[i] + 1e-12;
        own.push((entry - dot(&own, &own)).max(1e-13).sqrt());
        self.is_member[i] = true;
        self.members.push(i);
        self.rows.append(&mut own);
    }

    /// The equations without the members that are `gone`.
    fn without(&self, normal: &Normal, gone: impl Fn(usize) -> bool) -> Factor {
        let stay: Vec<usize> = self.members.iter().copied().filter(|&i| !gone(i)).collect();
        normal.factor(&stay)
    }

    /// `A⁻¹v` by member, of a right-hand side `v` of all unknowns; `None` where one is no number.
    pub(super) fn solve(&self, v: &[f64]) -> Option<Vec<f64>> {
        let m = self.members.len();
        let mut solution: Vec<f64> = self.members.iter().map(|&i| v[i] * self.scale[i]).collect();
        for a in 0..m {
            let row = self.row(a);
            solution[a] = (solution[a] - dot(&row[..a], &solution[..a])) / row[a];
        }
        for a in (0..m).rev() {
            let row = self.row(a);
            solution[a] /= row[a];
            let own = solution[a];
            let before = solution[..a].iter_mut().zip(row);
            before.for_each(|(value, entry)| *value -= entry * own);
        }
        let scaled = solution.iter_mut().zip(&self.members);
        scaled.for_each(|(value, &i)| *value *= self.scale[i]);
        solution.iter().all(|v| v.is_finite()).then_some(solution)
    }

    /// For a column with the inner products `cross`: how much of its square and of its product with the target the
    /// members account for, `(vᵀA⁻¹v, vᵀA⁻¹b)`, `b` by `right`.
    pub(super) fn project(&self, cross: &[f64], right: &[f64]) -> Option<(f64, f64)> {
        let solution = self.solve(cross)?;
        let sum = |of: &[f64]| -> f64 {
            let both = self.members.iter().zip(&solution);
            both.map(|(&i, v)| v * of[i]).sum()
        };
        Some((sum(cross), sum(right)))
    }
}

/// Sum of products, in four sums side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (left, right) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = left
        .remainder()
        .iter()
        .zip(right.remainder())
        .map(|(x, y)| x * y)
        .sum();
    let mut sums = [0.0; 4];
    for (x, y) in left.zip(right) {
        for (sum, (x, y)) in sums.iter_mut().zip(x.iter().zip(y)) {
            *sum += x * y;
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn equations(rows: &[([f64; 3], f64)]) -> Normal {
        let mut normal = Normal::new(3);
        for (row, target) in rows {
            normal.add(row, *target);
        }
        normal.mirror();
        normal
    }

    #[test]
    fn an_interior_solution_is_the_least_squares_one() {
        let normal = equations(&[
            ([1.0, 0.0, 0.0], 1.0),
            ([0.0, 1.0, 0.0], 2.0),
            ([0.0, 0.0, 1.0], 3.0),
            ([1.0, 1.0, 1.0], 6.0),
        ]);
        let x = normal.solve(&[true, true, true]);
        for (value, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
            assert!((value - expected).abs() < 1e-9);
        }
        assert!(normal.misfit(&x) < 1e-12);
    }

    #[test]
    fn optimality_conditions_hold_on_random_problems() {
        let mut seed = 12345_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
        };
        for _ in 0..50 {
            let mut normal = Normal::new(8);
            for _ in 0..30 {
                let row: Vec<f64> = (0..8).map(|_| random()).collect();
                let target = random();
                normal.add(&row, target);
            }
            normal.mirror();
            let bounded = [true, true, true, true, true, true, false, false];
            let x = normal.solve(&bounded);
            for i in 0..8 {
                let line = &normal.gram[i * 8..(i + 1) * 8];
                let gradient: f64 =
                    line.iter().zip(&x).map(|(a, b)| a * b).sum::<f64>() - normal.right[i];
                if bounded[i] {
                    assert!(
                        x[i] >= 0.0 && gradient > -1e-8,
                        "x {} gradient {gradient}",
                        x[i]
                    );
                    assert!((x[i] * gradient).abs() < 1e-8);
                } else {
                    assert!(gradient.abs() < 1e-8);
                }
            }
        }
    }
}
