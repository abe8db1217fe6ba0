//! A contact that rests holds more than one that slides: the law of a single one.
//!
//! ```text
//! limit  φ (1 + a b)      b = 1 at rest
//! sliding by s takes φ a b down by β k s, k the contact's own stiffness: its force falls as it
//! slides, but never faster than its spring gives way, so that it does not run away
//! b = 1 again once its force has come down to h φ
//! ```
//! Rabinowicz (1951): friction is higher before a first small slide, and back after the next rest.

/// β: share of the elastic force of a slide that the excess loses; at 1 the contact would run away.
pub const FALL: f64 = 0.95;

/// h: share of the limit below which a contact that slid rests again. A reversal gets there at once;
/// the noise of a measured input, which turns back at every other sample, does not.
const RESTED: f64 = 0.8;

/// Slide, as a force, of a contact that stands `beyond` its limit by this much, with so much of it
/// `excess`: `min(y/(1 − β), y + e)`, from `x = y + min(βx, e)`; zero below the limit.
#[inline(always)]
pub fn slide(beyond: f64, excess: f64) -> f64 {
    let (falling, fallen) = (beyond / (1.0 - FALL), beyond + excess);
    let slide = if falling < fallen { falling } else { fallen };
    if slide > 0.0 { slide } else { 0.0 }
}

/// Share b of the excess left after a slide, as a force; `full` is φ a, `force` the contact's own as
/// a share of its limit φ.
#[inline(always)]
pub fn left(bond: f64, slide: f64, full: f64, force: f64) -> f64 {
    let rest = bond - FALL * slide / full;
    let rest = if rest > 0.0 { rest } else { 0.0 };
    if (slide == 0.0) & (force < RESTED) & (force > -RESTED) {
        1.0
    } else {
        rest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slide_takes_the_excess_with_it_and_a_rest_brings_it_back() {
        assert_eq!(slide(-1.0, 0.5), 0.0);
        // Falling still: the limit 1.5 − 0.95 · 0.2 is what the force 1.51 − 0.2 comes to.
        assert!((slide(0.01, 0.5) - 0.2).abs() < 1e-14);
        assert!((left(1.0, 0.2, 0.5, 1.31) - 0.62).abs() < 1e-14);
        // Fallen: what is left is the sliding contact.
        assert_eq!(slide(1.0, 0.5), 1.5);
        assert_eq!(left(1.0, 1.5, 0.5, 1.0), 0.0);
        assert_eq!(left(0.0, 0.0, 0.5, 0.9), 0.0, "a wiggle is no rest");
        assert_eq!(left(0.0, 0.0, 0.5, -0.7), 1.0);
    }
}
