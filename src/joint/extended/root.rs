//! The root of a rising function: safeguarded Newton that survives kinks, jumps and plateaus, and says so where the
//! function does not rise.

/// A rising function at one point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Excess {
    /// Value minus target.
    pub value: f64,
    /// Derivative on the side towards which the search goes; zero on a plateau.
    pub slope: f64,
    /// Below this, `value` is rounding.
    pub noise: f64,
    /// Rounding of all lengths that `value` is made of, in units of the argument.
    pub blur: f64,
}

impl Excess {
    /// True where a search that nothing encloses may end: a step of Newton's would move rounding alone.
    fn is_rounding(&self) -> bool {
        self.value.abs() <= (DIGITS * self.noise).max(DIGITS * self.blur * self.slope.abs())
    }
}

/// Lengths of a search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scales {
    /// First step where the slope gives none.
    pub reach: f64,
    /// How far a root may lie.
    pub farthest: f64,
    /// Rounding of the argument.
    pub digit: f64,
}

/// Why there is no root.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum NoRoot {
    /// The function stays on one side of the target however far one goes.
    OutOfReach,
    /// The function has no value.
    NotANumber,
    /// Signs contradict each other, as where the function falls, or the trials are used up.
    NotRising,
    /// From here on the function falls, short of the target.
    Falls {
        /// The last argument at which it rises, to rounding.
        at: f64,
        /// The first at which it falls.
        beyond: f64,
    },
}

/// Growth of the reach while the root is not yet enclosed.
const GROWTH: f64 = 4.0;
/// Newton steps that may fall short before the reach takes over.
const PATIENCE: usize = 6;
/// Units of rounding that two ways to the same point may lie apart by.
const DIGITS: f64 = 32.0;
/// Trials of the slip, within a step of a joint with effects, before the search is given up;
/// halving alone needs about 60.
pub const MOST_TRIALS: usize = 400;

/// The x where `excess` crosses zero, to rounding: from `start`, by Newton's steps while they
/// help, by a growing `reach` while nothing encloses the root, by halving where Newton fails.
/// Steps within `digit` are none; gives up beyond `farthest` from `start`, and never asks `excess`
/// more than [`MOST_TRIALS`] times. Where the function falls it may be misled: what ends a search without
/// being a root is [`NoRoot::NotRising`], and [`nearest_root`](super::nearest::nearest_root) may know more.
pub(super) fn rising_root(
    start: f64,
    Scales {
        mut reach,
        farthest,
        digit,
    }: Scales,
    mut excess: impl FnMut(f64) -> Excess,
) -> Result<f64, NoRoot> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let (mut best, mut least) = (start, f64::INFINITY);
    let finest = f64::EPSILON * reach;
    let (mut rounding, mut digits) = (false, finest);
    let mut point = start;
    for evaluation in 0..MOST_TRIALS {
        let here = excess(point);
        if here.value.is_nan() {
            return Err(NoRoot::NotANumber);
        }
        if here.value.abs() <= here.noise {
            return Ok(point);
        }
        let helped = here.value.abs() <= 0.5 * least;
        if here.value.abs() < least {
            (best, least) = (point, here.value.abs());
            rounding = here.is_rounding();
            digits = finest.max(DIGITS * here.blur);
        }
        if here.value < 0.0 {
            low = point
        } else {
            high = point
        }
        let newton = point - here.value / here.slope;
        if (newton - point).abs() <= digit && here.slope.is_finite() {
            return Ok(point);
        }
        point = if low.is_finite() && high.is_finite() {
            let middle = low + 0.5 * (high - low);
            if middle <= low || middle >= high {
                break;
            }
            if newton > low && newton < high && (helped || evaluation < PATIENCE) {
                newton
            } else {
                middle
            }
        } else {
            let wanted = newton - point;
            let step = if wanted.is_finite() && evaluation < PATIENCE {
                wanted
            } else {
                reach *= GROWTH;
                let least_step = if wanted.is_finite() {
                    wanted.abs()
                } else {
                    0.0
                };
                reach.max(least_step).copysign(-here.value)
            };
            if (point + step - start).abs() > farthest {
                return Err(NoRoot::OutOfReach);
            }
            point + step
        };
    }
    // A jump across the target is enclosed to the last digits, in which rounding may turn low and high about.
    let digits = digits.max(f64::EPSILON * low.abs().max(high.abs()));
    let enclosed = (high - low).abs() <= digits && (best - low).abs() <= digits;
    if enclosed || rounding {
        Ok(best)
    } else {
        Err(NoRoot::NotRising)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: Scales = Scales {
        reach: 1.0,
        farthest: 1e12,
        digit: 0.0,
    };

    fn line_with_kink(x: f64) -> Excess {
        let (value, slope) = if x < 1.0 {
            (x, 1.0)
        } else {
            (1.0 + 1e-9 * (x - 1.0), 1e-9)
        };
        Excess {
            value: value - 1.5,
            slope,
            noise: 1e-16,
            blur: 0.0,
        }
    }

    #[test]
    fn crosses_a_kink_into_a_near_plateau() {
        let root = rising_root(0.0, FREE, line_with_kink);
        assert!(
            root.is_ok_and(|x| (x - 500_000_001.0).abs() < 1e-6 * x),
            "{root:?}"
        );
    }

    #[test]
    fn a_plateau_without_end_is_out_of_reach() {
        let root = rising_root(0.0, FREE, |x| {
            let inside = x.abs() < 1.0;
            let slope = if inside { 1.0 } else { 0.0 };
            Excess {
                value: x.clamp(-1.0, 1.0) - 2.0,
                slope,
                noise: 1e-16,
                blur: 0.0,
            }
        });
        assert_eq!(root, Err(NoRoot::OutOfReach));
    }

    #[test]
    fn a_jump_is_found_to_the_last_digit() {
        let jump = 0.3;
        let root = rising_root(0.0, FREE, |x| Excess {
            value: if x < jump { -1.0 + x } else { 1.0 + x },
            slope: 1.0,
            noise: 1e-16,
            blur: 0.0,
        });
        assert!(
            root.is_ok_and(|x| (x - jump).abs() <= 2.0 * f64::EPSILON),
            "{root:?}"
        );
    }

    /// A slope that leads astray and a value that is never near enough: a bound holds all the same.
    #[test]
    fn the_work_has_a_bound() {
        let mut asked = 0;
        let _ = rising_root(0.0, FREE, |x| {
            asked += 1;
            Excess {
                value: 1e300 * (x - 1e11).signum(),
                slope: 1e300,
                noise: 0.0,
                blur: 0.0,
            }
        });
        assert!(asked > 40 && asked <= MOST_TRIALS, "{asked}");
    }

    #[test]
    fn no_number_is_said_so() {
        let root = rising_root(0.0, FREE, |_| Excess {
            value: f64::NAN,
            slope: 1.0,
            noise: 0.0,
            blur: 0.0,
        });
        assert_eq!(root, Err(NoRoot::NotANumber));
    }
}
