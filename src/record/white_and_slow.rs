//! White noise and slow noise at once, told from first-order noise where cycles repeat.

use super::blended::{Blended, MOST_ALIKE};
use super::colour::{Colour, White};

/// Correlations of neighbours that the slow part is taken for: what is faster is hardly another kind than the white
/// part, and what is slower may be what cycles do not repeat.
const SLOW: (f64, f64) = (0.6, 0.98);

/// Least share of the slow part: what is less is a concern to nothing.
const LEAST: f64 = 0.03;

/// Twice the logarithm of the likelihood that the white part has to bring: four standard errors of its share.
const CHANCE: f64 = 16.0;

/// The same without the stretches that say so most: two standard errors.
const REST: f64 = 4.0;

/// Samples of a stretch of a run of cycles whose likelihood is taken by itself: several times as long as slow noise lasts.
const STRETCH: usize = 64;

/// Fewest stretches that tell it: of fewer a single one may hold a change of the response.
const FEWEST: usize = 4;

/// Samples that are enough.
const ENOUGH: usize = 20_000;

/// First of the steps in which the likeliest is sought, and how often they are halved: to less than a hundredth.
const FIRST_STEP: f64 = 0.2;
const HALVINGS: usize = 5;

/// Deviation and colour of noise whose differences are likelier of white and of slow noise at once than of first-order noise, in
/// the sum of all stretches, and without that quarter of them that says so most; `None` of any other.
///
/// Gaussian likelihood of the differences, exact where they lie at the samples. Values read between samples make neighbours
/// more alike, never less as a white part does.
pub(super) fn white_and_slow(parts: &[&Blended]) -> Option<(f64, Colour)> {
    let samples: usize = parts.iter().map(|part| part.differences.len()).sum();
    let every = samples.div_ceil(ENOUGH).max(1);
    let parts: Vec<&Blended> = parts.iter().step_by(every).copied().collect();
    let first_order = likeliest(&parts, Colour::first_order(0.5), |c| Colour {
        share: 1.0,
        slow: c.slow.clamp(0.0, MOST_ALIKE),
    });
    let begun = Colour {
        slow: 0.85,
        share: 0.5,
    };
    let both = likeliest(&parts, begun, |c| Colour {
        slow: c.slow.clamp(SLOW.0, SLOW.1),
        share: c.share.clamp(LEAST, 1.0),
    });
    let pairs = both.each.iter().zip(&first_order.each);
    let mut gains: Vec<f64> = pairs
        .map(|(with, without)| 2.0 * (with - without))
        .collect();
    if gains.len() < FEWEST {
        return None;
    }
    let all: f64 = gains.iter().sum();
    gains.sort_by(f64::total_cmp);
    let rest: f64 = gains[..gains.len() - gains.len().div_ceil(4)].iter().sum();
    let at_bounds = both.colour.slow >= SLOW.1 || both.colour.slow <= SLOW.0;
    (all > CHANCE && rest > REST && !at_bounds).then_some((both.deviation, both.colour))
}

/// A stretch of whitened differences.
#[derive(Clone, Default)]
struct Stretch {
    squares: f64,
    /// Logarithms of their variances.
    logarithms: f64,
    samples: f64,
}

/// How likely differences are of noise of one colour.
struct Likelihood {
    colour: Colour,
    deviation: f64,
    /// Logarithm of the likelihood of every stretch of them.
    each: Vec<f64>,
}

impl Likelihood {
    fn all(&self) -> f64 {
        self.each.iter().sum()
    }

    fn of(parts: &[&Blended], colour: Colour) -> Likelihood {
        let innovation = colour.innovation().powi(2);
        let mut stretches: Vec<Stretch> = Vec::new();
        for part in parts {
            let (mut whitening, mut white) = (colour.whitening(), White::default());
            let unit = part.variance(colour) * innovation;
            let last = (part.differences.len() / STRETCH).max(1) - 1;
            let first = stretches.len();
            stretches.resize(first + last + 1, Stretch::default());
            for (i, difference) in part.differences.iter().enumerate() {
                let step = whitening.step(i == 0);
                let stretch = &mut stretches[first + (i / STRETCH).min(last)];
                stretch.squares += white.next(&step, *difference).powi(2) / unit;
                stretch.logarithms += unit.ln();
                if step.scale != 1.0 {
                    stretch.logarithms -= 2.0 * step.scale.ln();
                }
                stretch.samples += 1.0;
            }
        }
        let squares: f64 = stretches.iter().map(|s| s.squares).sum();
        let samples: f64 = stretches.iter().map(|s| s.samples).sum();
        let variance = squares / samples;
        let each =
            |s: &Stretch| -0.5 * (s.squares / variance + s.logarithms + s.samples * variance.ln());
        let each = stretches.iter().map(each).collect();
        Likelihood {
            colour,
            deviation: variance.sqrt(),
            each,
        }
    }
}

/// The likeliest colour of those that `within` leaves, from one on by steps that are halved.
fn likeliest(parts: &[&Blended], from: Colour, within: impl Fn(Colour) -> Colour) -> Likelihood {
    let mut best = Likelihood::of(parts, within(from));
    let mut step = FIRST_STEP;
    for _ in 0..=HALVINGS {
        loop {
            let Colour { slow, share } = best.colour;
            let beside = [(step, 0.0), (-step, 0.0), (0.0, step), (0.0, -step)];
            let beside = beside.map(|(a, w)| Colour {
                slow: slow + a,
                share: share + w,
            });
            let others = beside
                .into_iter()
                .map(&within)
                .filter(|c| *c != best.colour);
            let next = others
                .map(|colour| Likelihood::of(parts, colour))
                .max_by(|a, b| a.all().total_cmp(&b.all()));
            match next {
                Some(next) if next.all() > best.all() => best = next,
                _ => break,
            }
        }
        step *= 0.5;
    }
    best
}
