//! Inner products of whitened columns, and what is left of them beside others.

use crate::identify::nonnegative::Normal;

/// Inner products `XᵀX` of the dictionary's columns followed by the shapes' columns.
///
/// Offsets of the records are taken out already, so that the products of two experiments add up.
#[derive(Debug, Clone)]
pub struct Gram {
    /// Count of columns.
    pub size: usize,
    /// `size × size`, both triangles.
    pub products: Vec<f64>,
}

/// Share of a column's own square below which nothing of it is left but rounding.
const ROUNDING: f64 = 1e-10;

impl Gram {
    /// No rows yet.
    pub fn new(size: usize) -> Gram {
        Gram {
            size,
            products: vec![0.0; size * size],
        }
    }

    /// From normal equations whose last unknowns are offsets: those are projected off.
    pub fn without_offsets(normal: &Normal, kept: usize) -> Gram {
        let mut all = Gram {
            size: normal.size,
            products: normal.gram.clone(),
        };
        all.sweep(&(kept..normal.size).collect::<Vec<_>>());
        let mut gram = Gram::new(kept);
        for i in 0..kept {
            for j in 0..kept {
                gram.products[i * kept + j] = all.at(i, j);
            }
        }
        gram
    }

    /// Product of two columns.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.products[i * self.size + j]
    }

    /// Adds another experiment's products of the same columns.
    pub fn plus(&self, other: &Gram) -> Gram {
        let mut sum = self.clone();
        let pairs = sum.products.iter_mut().zip(&other.products);
        pairs.for_each(|(a, b)| *a += b);
        sum
    }

    /// Takes an experiment's products away again.
    pub fn minus(&self, other: &Gram) -> Gram {
        let mut rest = self.clone();
        let pairs = rest.products.iter_mut().zip(&other.products);
        pairs.for_each(|(a, b)| *a -= b);
        rest
    }

    /// Projects every column off the given ones (Schur complement, one pivot after the other).
    pub fn sweep(&mut self, given: &[usize]) {
        let n = self.size;
        let own: Vec<f64> = given.iter().map(|&i| self.at(i, i)).collect();
        for (&pivot, own) in given.iter().zip(own) {
            let square = self.at(pivot, pivot);
            if square <= ROUNDING * own {
                continue;
            }
            let line: Vec<f64> = self.products[pivot * n..(pivot + 1) * n].to_vec();
            for i in 0..n {
                let factor = line[i] / square;
                if factor != 0.0 {
                    let row = &mut self.products[i * n..(i + 1) * n];
                    row.iter_mut()
                        .zip(&line)
                        .for_each(|(a, b)| *a -= factor * b);
                }
            }
        }
    }

    /// Square that is left of column `of` beside the given few columns.
    pub fn left(&self, of: usize, given: &[usize]) -> f64 {
        let places: Vec<usize> = given.iter().copied().chain([of]).collect();
        let m = places.len();
        let mut small = Gram::new(m);
        for (a, &i) in places.iter().enumerate() {
            for (b, &j) in places.iter().enumerate() {
                small.products[a * m + b] = self.at(i, j);
            }
        }
        small.sweep(&(0..m - 1).collect::<Vec<_>>());
        small.at(m - 1, m - 1).max(0.0)
    }

    /// Coefficients of the given few columns that fit column `of` best; `None` where they are not
    /// independent.
    pub fn coefficients(&self, of: usize, given: &[usize]) -> Option<Vec<f64>> {
        let m = given.len();
        let mut normal = Normal::new(m);
        for (a, &i) in given.iter().enumerate() {
            for (b, &j) in given.iter().enumerate() {
                normal.gram[a * m + b] = self.at(i, j);
            }
            normal.right[a] = self.at(i, of);
        }
        normal.square = self.at(of, of);
        let solution = normal.solve(&vec![false; m]);
        solution.iter().all(|c| c.is_finite()).then_some(solution)
    }

    /// Least square that the dictionary with non-negative coefficients and the given columns leave
    /// of `X c + size · column(of)`: the joint with the cause, seen without it.
    ///
    /// `held` marks given columns that may not turn negative either.
    pub fn refitted(
        &self,
        coefficients: &[f64],
        of: usize,
        size: f64,
        given: &[(usize, bool)],
    ) -> f64 {
        let columns = coefficients.len();
        let members: Vec<usize> = (0..columns).chain(given.iter().map(|g| g.0)).collect();
        let m = members.len();
        let mut normal = Normal::new(m);
        // Product of any column with the target.
        let target = |i: usize| -> f64 {
            let line = &self.products[i * self.size..i * self.size + columns];
            let joint: f64 = line.iter().zip(coefficients).map(|(g, c)| g * c).sum();
            joint + size * self.at(i, of)
        };
        for (a, &i) in members.iter().enumerate() {
            for (b, &j) in members.iter().enumerate() {
                normal.gram[a * m + b] = self.at(i, j);
            }
            normal.right[a] = target(i);
        }
        normal.square = coefficients
            .iter()
            .enumerate()
            .map(|(i, c)| c * target(i))
            .sum::<f64>()
            + size * target(of);
        let bounded: Vec<bool> = (0..m)
            .map(|a| a < columns || given[a - columns].1)
            .collect();
        normal.misfit(&normal.solve(&bounded))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gram(columns: &[[f64; 4]]) -> Gram {
        let mut gram = Gram::new(columns.len());
        for (i, a) in columns.iter().enumerate() {
            for (j, b) in columns.iter().enumerate() {
                gram.products[i * columns.len() + j] = a.iter().zip(b).map(|(x, y)| x * y).sum();
            }
        }
        gram
    }

    #[test]
    fn what_is_left_of_a_column_is_its_part_across_the_others() {
        let mut gram = gram(&[
            [1.0, 0.0, 0.0, 0.0],
            [1.0, 2.0, 0.0, 0.0],
            [3.0, 4.0, 5.0, 0.0],
        ]);
        assert!((gram.left(2, &[0]) - 41.0).abs() < 1e-12);
        assert!((gram.left(2, &[0, 1]) - 25.0).abs() < 1e-12);
        gram.sweep(&[0]);
        assert!((gram.left(2, &[1]) - 25.0).abs() < 1e-12);
    }

    #[test]
    fn a_refit_keeps_its_bounds() {
        // Column 2 = 2 e₀ − 3 e₁ beside a dictionary e₀, e₁ at (1, 1): the second would have to
        // fall to −2 and stops at zero.
        let gram = gram(&[
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0, 0.0],
            [2.0, -3.0, 0.0, 0.0],
            [0.0, 1.0, 1.0, 0.0],
        ]);
        assert!((gram.refitted(&[1.0, 1.0], 2, 1.0, &[]) - 4.0).abs() < 1e-9);
        // A column that may turn negative takes half of that, one that may not takes none.
        assert!((gram.refitted(&[1.0, 1.0], 2, 1.0, &[(3, false)]) - 2.0).abs() < 1e-9);
        assert!((gram.refitted(&[1.0, 1.0], 2, 1.0, &[(3, true)]) - 4.0).abs() < 1e-9);
    }
}
