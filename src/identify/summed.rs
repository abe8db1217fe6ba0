//! Rows summed into normal equations four at a time: the sums are read and written once for four rows,
//! and compiled for the widest vectors there are. Their order is fixed, and so are their digits.

use super::nonnegative::Normal;
use pulp::{Arch, NullaryFnOnce};

/// Rows that go in together.
const TOGETHER: usize = 4;

/// Normal equations in the making.
pub struct Summed {
    arch: Arch,
    normal: Normal,
    /// Rows that wait, each with its target behind it.
    waiting: [Vec<f64>; TOGETHER],
    held: usize,
}

impl Summed {
    /// Empty equations for `size` unknowns.
    pub fn new(size: usize) -> Summed {
        Summed {
            arch: Arch::new(),
            normal: Normal::new(size),
            waiting: std::array::from_fn(|_| vec![0.0; size + 1]),
            held: 0,
        }
    }

    /// Adds one weighted row, its target last.
    pub fn add(&mut self, row: &[f64]) {
        self.waiting[self.held].copy_from_slice(row);
        self.held += 1;
        self.normal.rows += 1.0;
        if self.held == TOGETHER {
            self.flush();
        }
    }

    fn flush(&mut self) {
        for row in &mut self.waiting[self.held..] {
            row.fill(0.0);
        }
        self.held = 0;
        let Summed {
            normal, waiting, ..
        } = self;
        self.arch.dispatch(Add(normal, waiting));
    }

    /// The equations of all rows, upper triangle alone.
    pub fn finish(mut self) -> Normal {
        self.flush();
        self.normal
    }
}

struct Add<'a>(&'a mut Normal, &'a [Vec<f64>; TOGETHER]);

impl NullaryFnOnce for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Add(normal, rows) = self;
        let n = normal.size;
        let [a, b, c, d] = rows.each_ref().map(Vec::as_slice);
        let target = [a[n], b[n], c[n], d[n]];
        for i in 0..n {
            let [p, q, r, s] = [a[i], b[i], c[i], d[i]];
            if p == 0.0 && q == 0.0 && r == 0.0 && s == 0.0 {
                continue;
            }
            let line = &mut normal.gram[i * n + i..(i + 1) * n];
            let (a, b, c, d) = (&a[i..n], &b[i..n], &c[i..n], &d[i..n]);
            for ((((sum, a), b), c), d) in line.iter_mut().zip(a).zip(b).zip(c).zip(d) {
                *sum += (p * a + q * b) + (r * c + s * d);
            }
            normal.right[i] += (p * target[0] + q * target[1]) + (r * target[2] + s * target[3]);
        }
        normal.square += target.iter().map(|y| y * y).sum::<f64>();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_are_those_of_single_rows() {
        let rows: Vec<[f64; 4]> = (0..11)
            .map(|i| std::array::from_fn(|j| f64::from((7 * i + 3 * j as i32) % 5 - 2)))
            .collect();
        let mut single = Normal::new(3);
        let mut summed = Summed::new(3);
        for row in &rows {
            single.add(&row[..3], row[3]);
            summed.add(row);
        }
        assert_eq!(summed.finish(), single);
    }
}
