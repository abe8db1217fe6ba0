//! The nearest root of a function that rises at first and may fall beyond: by strides, then by halving.

use super::root::{Excess, NoRoot, Scales};

/// Growth of the strides.
const GROWTH: f64 = 2.0;

/// The first x from `start` on, towards the target, where `excess` crosses zero without having been seen to fall: what
/// a load that grows slowly comes to. Where it falls short of the target, the x of its peak is said. Asks `excess`
/// at most `most` times.
pub(super) fn nearest_root(
    start: f64,
    Scales {
        mut reach,
        farthest,
        ..
    }: Scales,
    most: usize,
    mut excess: impl FnMut(f64) -> Excess,
) -> Result<f64, NoRoot> {
    // The side of the target from which it comes, the last point known to be short of it and rising, and one
    // beyond the root (true) or the peak.
    let (mut below, mut near, mut far) = (None, start, None);
    let mut point = start;
    for _ in 0..most {
        let here = excess(point);
        if here.value.is_nan() {
            return Err(NoRoot::NotANumber);
        }
        let falls = here.slope < 0.0;
        if here.value.abs() <= here.noise && !falls {
            return Ok(point);
        }
        let from_below = *below.get_or_insert(here.value < 0.0);
        let crossed = (here.value < 0.0) != from_below;
        if crossed || falls {
            far = Some((point, crossed));
        } else {
            near = point;
        }
        point = match far {
            Some((far, crossed)) => {
                let middle = near + 0.5 * (far - near);
                if middle == near || middle == far {
                    return if crossed {
                        Ok(near)
                    } else {
                        Err(NoRoot::Falls {
                            at: near,
                            beyond: far,
                        })
                    };
                }
                middle
            }
            None if reach > farthest => return Err(NoRoot::OutOfReach),
            None => {
                let stride = if from_below { reach } else { -reach };
                reach *= GROWTH;
                start + stride
            }
        };
    }
    Err(NoRoot::NotRising)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FREE: Scales = Scales {
        reach: 1e-3,
        farthest: 1e12,
        digit: 0.0,
    };

    /// x − x³/3 less a target: rises to 2/3 at 1, falls beyond, and comes from minus 2/3 at −1.
    fn arch(target: f64) -> impl Fn(f64) -> Excess {
        move |x| Excess {
            value: x - x * x * x / 3.0 - target,
            slope: 1.0 - x * x,
            noise: 1e-16,
            blur: 0.0,
        }
    }

    #[test]
    fn the_root_this_side_of_the_peak_is_found_from_both_sides() {
        for target in [-0.66, -0.1, 0.1, 0.5, 0.66] {
            let root = nearest_root(0.0, FREE, 400, arch(target)).unwrap();
            assert!(arch(target)(root).value.abs() < 1e-15 && root.abs() < 1.0);
        }
    }

    #[test]
    fn a_peak_below_the_target_is_told() {
        for side in [-1.0, 1.0] {
            let peak = nearest_root(0.0, FREE, 400, arch(0.7 * side));
            assert!(
                matches!(peak, Err(NoRoot::Falls { at, .. }) if (at - side).abs() < 1e-15),
                "{peak:?}"
            );
        }
        let at_once = nearest_root(1.5, FREE, 400, arch(2.0));
        assert_eq!(
            at_once,
            Err(NoRoot::Falls {
                at: 1.5,
                beyond: 1.5
            })
        );
    }

    #[test]
    fn a_plateau_is_walked_over_and_one_without_end_is_out_of_reach() {
        let stairs = |top: f64| {
            move |x: f64| Excess {
                value: x.min(1.0) + (x - 50.0).clamp(0.0, top) - 2.0,
                slope: if (1.0..=50.0).contains(&x) { 0.0 } else { 1.0 },
                noise: 1e-16,
                blur: 0.0,
            }
        };
        let root = nearest_root(0.0, FREE, 400, stairs(9.0));
        assert!(root.is_ok_and(|x| (x - 51.0).abs() < 1e-13), "{root:?}");
        let none = nearest_root(0.0, FREE, 400, stairs(0.5));
        assert_eq!(none, Err(NoRoot::OutOfReach));
    }

    #[test]
    fn the_work_has_a_bound() {
        let mut asked = 0;
        let root = nearest_root(0.0, FREE, 7, |x| {
            asked += 1;
            arch(0.5)(x)
        });
        assert_eq!((root, asked), (Err(NoRoot::NotRising), 7));
    }
}
