//! Energy in an elastic law: the integral of a rising function that may have kinks and jumps.

/// Depth of halving: resolves a jump to 2⁻⁴⁰ of the interval.
const DEPTH: usize = 40;
/// Accepted error, relative to the largest value times the length.
const ACCURACY: f64 = 1e-13;

/// `∫_from^to law dx` by adaptive Simpson. `law` rises (or stays), as every stable law does.
pub(super) fn integral(from: f64, to: f64, law: impl Fn(f64) -> f64) -> f64 {
    if from == to {
        return 0.0;
    }
    let (left, right) = (law(from), law(to));
    if left == right {
        return left * (to - from); // a rising law between equal values is constant
    }
    let middle = law(0.5 * (from + to));
    let piece = Piece {
        from,
        to,
        left,
        middle,
        right,
    };
    let tolerance = ACCURACY * left.abs().max(right.abs()) * (to - from).abs();
    piece.refined(&law, tolerance, DEPTH)
}

struct Piece {
    from: f64,
    to: f64,
    left: f64,
    middle: f64,
    right: f64,
}

impl Piece {
    fn simpson(&self) -> f64 {
        (self.to - self.from) / 6.0 * (self.left + 4.0 * self.middle + self.right)
    }

    fn refined(&self, law: &impl Fn(f64) -> f64, tolerance: f64, depth: usize) -> f64 {
        if self.left == self.right {
            return self.left * (self.to - self.from);
        }
        let centre = 0.5 * (self.from + self.to);
        let before = Piece {
            from: self.from,
            to: centre,
            left: self.left,
            middle: law(0.5 * (self.from + centre)),
            right: self.middle,
        };
        let after = Piece {
            from: centre,
            to: self.to,
            left: self.middle,
            middle: law(0.5 * (centre + self.to)),
            right: self.right,
        };
        let halves = before.simpson() + after.simpson();
        let change = halves - self.simpson();
        if depth == 0 || change.abs() <= 15.0 * tolerance || centre == self.from {
            return halves + change / 15.0;
        }
        before.refined(law, 0.5 * tolerance, depth - 1)
            + after.refined(law, 0.5 * tolerance, depth - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::integral;

    #[test]
    fn kinks_jumps_and_cubics() {
        let gap = |x: f64| 3.0 * (x - 0.3).max(0.0);
        assert!((integral(-1.0, 1.0, gap) - 1.5 * 0.49).abs() < 1e-12);
        let seat = |x: f64| (x / 1e-9).clamp(-1.0, 1.0);
        assert!((integral(-0.25, 1.0, seat) - 0.75).abs() < 1e-9);
        assert!((integral(0.0, 2.0, |x| x * x * x) - 4.0).abs() < 1e-12);
        assert_eq!(integral(1.0, 1.0, |x| x), 0.0);
    }
}
