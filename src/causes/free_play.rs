//! Free play as the load path crosses it, for the causes that have some.

use crate::joint::effect::Response;
use crate::joint::elementary::{exp, log1p, tanh};
use crate::joint::parameters::Parameter;

/// F_d; last of the values of a cause with free play.
pub(super) const DRAG: Parameter = Parameter {
    name: "drag",
    symbol: "F_d",
    unit: "N",
    lower: 0.0,
    upper: 1e9,
    vanishes_at: None,
    neutral: Some(0.0),
    meaning: "friction of the parts that cross the play: force by which the crossing lags behind",
};

/// Share of the seating force that a drag is looked for from.
const DRAGGED: f64 = 0.5;

/// Drag to begin a refinement from.
pub(super) fn drag(seating_force: f64) -> f64 {
    DRAGGED * seating_force
}

/// Force \[N\] on the seat, `y`: what is left of the force when parts that drag have moved as little as they could,
/// `|F − y| ≤ F_d`. A force that is no number, as a fit on its way may try, moves nothing.
pub(super) fn on_seat(force: f64, before: f64, drag: f64) -> f64 {
    before.max(force - drag).min(force + drag)
}

/// Way \[m\] into a play of width g under a force, `s = (g/2) tanh(y/F_s)`.
pub(super) fn crossed(
    gap: f64,
    seating_force: f64,
    force: f64,
    (before, drag): (f64, f64),
) -> Response {
    let seat = on_seat(force, before, drag);
    let shape = tanh(seat / seating_force);
    let follows = drag == 0.0 || seat != before;
    Response {
        value: 0.5 * gap * shape,
        slope: match follows {
            true => 0.5 * gap / seating_force * (1.0 - shape * shape),
            false => 0.0,
        },
        damping: 0.0,
    }
}

/// What the seat gives back \[J\], `∫ y ds`.
pub(super) fn stored(gap: f64, seating_force: f64, seat: f64) -> f64 {
    let load = (seat / seating_force).abs();
    // ln cosh x = x + ln(1 + exp(−2x)) − ln 2, without overflow.
    let ln_cosh = load + log1p(exp(-2.0 * load)) - std::f64::consts::LN_2;
    0.5 * gap * seating_force * (load * tanh(load) - ln_cosh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_play_with_drag_is_crossed_late_and_loses_what_that_takes() {
        let (gap, seating, drag) = (2e-3, 1.0, 3.0);
        let turns = [60.0, -60.0, 60.0];
        let (mut seat, mut force, mut way, mut work) = (0.0, 0.0, 0.0, 0.0);
        let mut crossings = Vec::new();
        for (leg, to) in turns.into_iter().enumerate() {
            let from: f64 = force;
            for i in 1..=20_000 {
                force = from + (to - from) * f64::from(i) / 2e4;
                let next = crossed(gap, seating, force, (seat, drag)).value;
                seat = on_seat(force, seat, drag);
                if leg > 0 && (way > 0.0) != (next > 0.0) {
                    crossings.push(force);
                }
                if leg > 0 {
                    work += force * (next - way);
                }
                way = next;
            }
        }
        // Half of it to the other side and back: what is lost is twice the drag over the whole play.
        assert!(
            crossings.iter().all(|f| (f.abs() - drag).abs() < 0.01),
            "{crossings:?}"
        );
        assert_eq!(crossings.len(), 2);
        assert!((work - 2.0 * drag * gap).abs() < 0.01 * work, "{work}");
        assert!(
            (stored(gap, seating, 50.0) - 0.5 * gap * seating * std::f64::consts::LN_2).abs()
                < 1e-12
        );
    }
}
