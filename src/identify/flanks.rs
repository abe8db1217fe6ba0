//! A tip between two flanks of a triangle.

use super::tips::Shape;

/// Steepest flank of a tip over its flattest.
const UNLIKE: f64 = 3.0;

/// A tip between two straight flanks; times in steps.
#[derive(Clone)]
pub(super) struct Tip {
    /// The sample that turns, and the turns beside it: before, itself, behind.
    pub about: [usize; 3],
    /// Steps from other turns to the nearest samples that draw the flanks.
    reach: f64,
    /// Steps to the farthest samples that draw the flanks.
    far: f64,
    /// Lines of the flanks: value where the sample is that turns, slope per step.
    lines: [[f64; 2]; 2],
    /// Its samples: steps from the corner, and how far they stay behind the mean of both lines, over the jump of the slope.
    pub samples: Vec<[f64; 2]>,
}

impl Tip {
    /// The tip about a turn, drawn by the samples as near and as far from it as given; none where those are no flanks of a
    /// triangle.
    pub fn about(samples: &[[f64; 2]], about: [usize; 3], [near, far]: [f64; 2]) -> Option<Tip> {
        let start = samples[about[1]][0];
        let points = (about[0]..=about[2]).map(|i| [samples[i][0] - start, samples[i][1]]);
        Tip::drawn(samples, (about, near), (0.0, [near, far]), points)
    }

    /// The same tip, drawn by what its samples were had nothing rounded its corner.
    pub fn anew(&self, samples: &[[f64; 2]], shape: &Shape, near: f64) -> Option<Tip> {
        let (start, corner) = (samples[self.about[1]][0], self.corner());
        let points = (self.about[0]..=self.about[2]).map(|i| {
            let at = samples[i][0] - start;
            let off = at - corner;
            let rounded = match off.abs() <= shape.reach {
                true => shape.at(off) - 0.5 * off.abs(),
                false => 0.0,
            };
            [at, samples[i][1] + self.jump() * rounded]
        });
        Tip::drawn(
            samples,
            (self.about, self.reach),
            (corner, [near, self.far]),
            points,
        )
    }

    fn drawn(
        samples: &[[f64; 2]],
        (about, reach): ([usize; 3], f64),
        (corner, [near, far]): (f64, [f64; 2]),
        points: impl Iterator<Item = [f64; 2]>,
    ) -> Option<Tip> {
        let [before, turn, behind] = about;
        let from = |i: usize| samples[i][0] - samples[turn][0];
        let (first, last) = (from(before) + reach, from(behind) - reach);
        let is_on = |p: &[f64; 2]| {
            let off = (p[0] - corner).abs();
            off >= near && off <= far && p[0] >= first && p[0] <= last
        };
        let points: Vec<[f64; 2]> = points.filter(is_on).collect();
        let (rise, fall): (Vec<_>, Vec<_>) = points.into_iter().partition(|p| p[0] < corner);
        let lines = [line(&rise)?, line(&fall)?];
        let alike = (lines[0][1] / lines[1][1]).abs();
        if lines[0][1] * lines[1][1] >= 0.0 || !(1.0 / UNLIKE..=UNLIKE).contains(&alike) {
            return None;
        }
        let mut tip = Tip {
            about,
            reach,
            far,
            lines,
            samples: Vec::new(),
        };
        let corner = tip.corner();
        let all = (before..=behind).map(|i| (from(i), samples[i][1]));
        let is_own = |(at, _): &(f64, f64)| {
            let off = (at - corner).abs();
            off <= reach + 1.0 || off <= far && *at >= first && *at <= last
        };
        tip.samples = all
            .filter(is_own)
            .map(|(at, value)| [at - corner, (tip.mean(at) - value) / tip.jump()])
            .collect();
        Some(tip)
    }

    /// Steps from the sample that turns to where the lines meet.
    fn corner(&self) -> f64 {
        (self.lines[1][0] - self.lines[0][0]) / self.jump()
    }

    /// What the slope loses at the corner, per step.
    pub fn jump(&self) -> f64 {
        self.lines[0][1] - self.lines[1][1]
    }

    /// One for a tip that is the highest of its samples, less one for the lowest.
    pub fn sense(&self) -> f64 {
        self.jump().signum()
    }

    /// Mean of both lines.
    fn mean(&self, at: f64) -> f64 {
        let [rise, fall] = self.lines;
        0.5 * (rise[0] + fall[0] + (rise[1] + fall[1]) * at)
    }

    /// Steps from the sample that turns, and value, farthest along the tip's sense.
    pub fn top(&self, shape: &Shape) -> (f64, f64) {
        let corner = self.corner();
        let at = |t: f64| self.mean(t) - self.jump() * shape.at(t - corner);
        let [mut low, mut high] = [corner - shape.reach, corner + shape.reach];
        // A tip has one top: a third of the rest goes with each look.
        while high - low > 1e-4 {
            let [left, right] = [1.0, 2.0].map(|third| low + third * (high - low) / 3.0);
            match self.sense() * (at(left) - at(right)) > 0.0 {
                true => high = right,
                false => low = left,
            }
        }
        let top = 0.5 * (low + high);
        (top, at(top))
    }
}

/// Value at zero and slope of the line through points by least squares; none through fewer than two.
fn line(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / count;
    let [t, y] = [mean(0), mean(1)];
    let product = |k: usize, m: f64| -> f64 {
        let products = points.iter().map(|p| (p[0] - t) * (p[k] - m));
        products.sum()
    };
    let slope = product(1, y) / product(0, t);
    (points.len() >= 2).then_some([y - slope * t, slope])
}
