//! Rows summed into normal equations block by block: the sums of eight by eight unknowns stay in registers for a
//! whole block, and are compiled for the widest vectors there are. Their order is fixed, every product is added
//! unrounded, and so are their digits those of every processor.

use super::nonnegative::Normal;
use pulp::{Arch, NullaryFnOnce};

/// Rows that go in together.
const TOGETHER: usize = 32;

/// Unknowns whose products are summed together.
const TILE: usize = 8;

/// Half of them: as many sums as there are registers for on every processor.
const HALF: usize = 4;

type Sums = [[f64; TILE]; TILE];

/// Normal equations in the making.
pub struct Summed {
    arch: Arch,
    size: usize,
    rows: f64,
    /// Tiles that a row has, its target counted and filled up with zeros.
    across: usize,
    /// Products of tile by tile of the upper triangle, line by line.
    sums: Vec<Sums>,
    /// Rows that wait, each with its target behind it.
    waiting: Vec<[f64; TILE]>,
    held: usize,
}

impl Summed {
    /// Empty equations for `size` unknowns.
    pub fn new(size: usize) -> Summed {
        let across = (size + 1).div_ceil(TILE);
        Summed {
            arch: Arch::new(),
            size,
            rows: 0.0,
            across,
            sums: vec![[[0.0; TILE]; TILE]; across * (across + 1) / 2],
            waiting: vec![[0.0; TILE]; TOGETHER * across],
            held: 0,
        }
    }

    /// Adds one weighted row, its target last.
    pub fn add(&mut self, row: &[f64]) {
        let own = self.held * self.across..(self.held + 1) * self.across;
        let own = self.waiting[own].as_flattened_mut();
        own[..=self.size].copy_from_slice(row);
        self.held += 1;
        self.rows += 1.0;
        if self.held == TOGETHER {
            self.flush();
        }
    }

    fn flush(&mut self) {
        let rows = &self.waiting[..self.held * self.across];
        self.held = 0;
        self.arch.dispatch(Add {
            rows,
            across: self.across,
            sums: &mut self.sums,
        });
    }

    /// The equations of all rows, upper triangle alone.
    pub fn finish(mut self) -> Normal {
        self.flush();
        let n = self.size;
        let mut normal = Normal::new(n);
        normal.rows = self.rows;
        let pairs = (0..self.across).flat_map(|i| (i..self.across).map(move |j| (i, j)));
        for ((i, j), sums) in pairs.zip(&self.sums) {
            for (row, line) in (i * TILE..).zip(sums) {
                for (column, &sum) in (j * TILE..).zip(line) {
                    match (row, column) {
                        (r, c) if r < n && c < n && r <= c => normal.gram[r * n + c] = sum,
                        (r, c) if r < n && c == n => normal.right[r] = sum,
                        (r, c) if r == n && c == n => normal.square = sum,
                        _ => {}
                    }
                }
            }
        }
        normal
    }
}

struct Add<'a> {
    rows: &'a [[f64; TILE]],
    across: usize,
    sums: &'a mut [Sums],
}

impl NullaryFnOnce for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Add { rows, across, sums } = self;
        // Operators that never slipped in these rows have nothing to add.
        let live = |tile: usize| {
            let mut own = rows.iter().skip(tile).step_by(across);
            own.any(|values| values.iter().any(|v| *v != 0.0))
        };
        let live: Vec<bool> = (0..across).map(live).collect();
        let mut sums = sums.iter_mut();
        for i in 0..across {
            for (j, sums) in (i..across).zip(&mut sums) {
                if live[i] && live[j] {
                    let (upper, lower) = sums.split_at_mut(HALF);
                    half::<0>((rows, across), (i, j), upper);
                    half::<HALF>((rows, across), (i, j), lower);
                }
            }
        }
    }
}

/// Adds the products of half of the unknowns of tile `i` with those of tile `j` over all rows.
#[inline(always)]
fn half<const FROM: usize>(
    (rows, across): (&[[f64; TILE]], usize),
    (i, j): (usize, usize),
    sums: &mut [[f64; TILE]],
) {
    let mut own: [[f64; TILE]; HALF] = std::array::from_fn(|line| sums[line]);
    for row in rows.chunks_exact(across) {
        let (left, right) = (&row[i], &row[j]);
        for line in 0..HALF {
            for (sum, other) in own[line].iter_mut().zip(right) {
                *sum = left[FROM + line].mul_add(*other, *sum);
            }
        }
    }
    sums.copy_from_slice(&own);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without them every product is a call of the C library, four times as slow: most processors have vectors of
    /// 256 bits and none of 512, and the package has a feature for each.
    #[cfg(target_arch = "x86_64")]
    #[test]
    fn vectors_that_the_processor_has_are_used() {
        let has = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
        assert_eq!(has, !matches!(Arch::new(), Arch::Scalar));
    }

    /// Whole numbers lose no digit: rows that fill blocks and tiles, and rows that do not, zeros among them.
    #[test]
    fn sums_are_those_of_single_rows() {
        for size in [1, 3, 7, 8, 21] {
            for count in [0, 11, TOGETHER, 2 * TOGETHER + 5] {
                let mut single = Normal::new(size);
                let mut summed = Summed::new(size);
                for i in 0..count {
                    let value = |j: usize| match j % 11 {
                        9 => 0.0,
                        _ => ((7 * i + 3 * j) % 5) as f64 - 2.0,
                    };
                    let row: Vec<f64> = (0..=size).map(value).collect();
                    single.add(&row[..size], row[size]);
                    summed.add(&row);
                }
                assert_eq!(summed.finish(), single, "{size} unknowns, {count} rows");
            }
        }
    }
}
