//! Energy in an elastic law: the integral of a rising function that may have kinks and jumps.

/// Positive nodes of Kronrod's rule of 15 points, every second one of Gauss's of 7, then zero.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
/// Weights of Kronrod's rule.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_56,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_82,
];
/// Weights of Gauss's rule, zero at the nodes that are Kronrod's alone.
const GAUSS: [f64; 8] = [
    0.0,
    0.129_484_966_168_869_7,
    0.0,
    0.279_705_391_489_276_7,
    0.0,
    0.381_830_050_505_118_9,
    0.0,
    0.417_959_183_673_469_4,
];
/// Depth of halving: resolves a jump to 2⁻⁴⁰ of the interval.
const DEPTH: usize = 40;
/// Intervals after which no more are halved: a kink takes some 80, so that a law with a dozen of
/// them does not come near, and the work of a step has a bound whatever the law.
const INTERVALS: usize = 1000;
/// Accepted error, relative to the largest value times the length.
const ACCURACY: f64 = 1e-13;

/// `∫_from^to law dx` by adaptive Gauss–Kronrod quadrature. `law` rises (or stays), as every
/// stable law does; it is asked at most 15 (INTERVALS + DEPTH) + 2 times. Two equal jumps that mirror
/// each other could hide from the rule's own error; no law has two.
pub(super) fn integral(from: f64, to: f64, law: impl Fn(f64) -> f64) -> f64 {
    if from == to {
        return 0.0;
    }
    let (left, right) = (law(from), law(to));
    if left == right {
        return left * (to - from); // a rising law between equal values is constant
    }
    let tolerance = ACCURACY * left.abs().max(right.abs()) * (to - from).abs();
    let mut left = INTERVALS;
    halved((from, to), &law, tolerance, DEPTH, &mut left)
}

fn halved(
    (from, to): (f64, f64),
    law: &impl Fn(f64) -> f64,
    tolerance: f64,
    depth: usize,
    left: &mut usize,
) -> f64 {
    let (centre, half) = (0.5 * (from + to), 0.5 * (to - from));
    let (mut coarse, mut fine) = (0.0, 0.0);
    for ((node, kronrod), gauss) in NODES.iter().zip(KRONROD).zip(GAUSS) {
        let mut value = law(centre + half * node);
        if *node > 0.0 {
            value += law(centre - half * node);
        }
        fine += kronrod * value;
        coarse += gauss * value;
    }
    (coarse, fine) = (half * coarse, half * fine);
    // The difference is the error of the coarse rule; the fine one is far better where smooth.
    let close = (fine - coarse).abs() <= 1e3 * tolerance;
    *left = left.saturating_sub(1);
    if close || depth == 0 || *left == 0 || centre == from || centre == to {
        return fine;
    }
    halved((from, centre), law, 0.5 * tolerance, depth - 1, left)
        + halved((centre, to), law, 0.5 * tolerance, depth - 1, left)
}

#[cfg(test)]
mod tests {
    use super::{DEPTH, INTERVALS, integral};
    use std::cell::Cell;

    #[test]
    fn kinks_jumps_and_cubics() {
        let gap = |x: f64| 3.0 * (x - 0.3).max(0.0);
        assert!((integral(-1.0, 1.0, gap) - 1.5 * 0.49).abs() < 1e-11);
        let seat = |x: f64| (x / 1e-9).clamp(-1.0, 1.0);
        assert!((integral(-0.25, 1.0, seat) - 0.75).abs() < 1e-9);
        assert!((integral(0.0, 2.0, |x| x * x * x) - 4.0).abs() < 1e-12);
        let tanh = integral(-0.3, 2.0, |x| (x / 0.05).tanh());
        let exact = 0.05 * ((2.0_f64 / 0.05).cosh().ln() - (0.3_f64 / 0.05).cosh().ln());
        assert!((tanh - exact).abs() < 1e-12, "{tanh} {exact}");
        assert_eq!(integral(1.0, 1.0, |x| x), 0.0);
    }

    /// How often a law of so many growing jumps is asked, and its integral.
    fn asked(jumps: f64) -> (usize, f64) {
        let count = Cell::new(0);
        let stairs = |x: f64| {
            count.set(count.get() + 1);
            ((jumps * x).floor() / jumps).powi(2)
        };
        let area = integral(0.0, 1.0, stairs);
        (count.get(), area)
    }

    #[test]
    fn the_work_has_a_bound_that_a_dozen_jumps_do_not_touch() {
        let most = 15 * (INTERVALS + DEPTH) + 2;
        let (few, area) = asked(11.3);
        assert!(few < most - 15 * DEPTH, "{few} of {most}");
        let squares: f64 = (0..11).map(|k| f64::from(k * k)).sum();
        let exact = (squares + 0.3 * 11.0 * 11.0) / 11.3_f64.powi(3);
        assert!((area - exact).abs() < 1e-10, "{area} {exact}");
        let (many, area) = asked(1e5);
        assert!(many <= most && many > most / 2, "{many}");
        assert!((area - 1.0 / 3.0).abs() < 1e-4, "{area}");
    }
}
