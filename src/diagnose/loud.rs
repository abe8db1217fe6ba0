//! What a cause brings where the noise is louder than elsewhere: at large loads, in what stands alone, or where neighbours
//! vary together.

use super::trials::{dispersion, penalty};
use crate::identify::weighing::Weighing;
use crate::identify::{Fit, Problem};
use std::collections::VecDeque;

/// Standard errors up to which noise passes for no louder than its mean.
const CHANCE: f64 = 2.0;

/// Samples that slow noise behind faster noise may go together over: what first-order whitening leaves of both.
const TOGETHER: usize = 40;

/// A set's evidence against the current one where every sample counts for the noise that is heard there.
///
/// `fall/ℓ − penalty`, with `ℓ = Σ d² e² / Σ d²` over the whitened samples, `d` what the set predicts otherwise and
/// `e` what it leaves: of noise alone the fall is `ℓ` times as large as where all samples were alike (White's
/// sandwich). Unless cycles that repeat have `known` the noise, `ℓ` has `2 Σ_l (1 − l/L) Σ_t d_t d_{t+l} e_t e_{t+l} / Σ d²` as well: the
/// noise of two channels, one slow, is not of first order, and what is left of it after whitening goes together (Newey
/// and West). A mean over few samples scatters by `√(2 Σ d⁴)/Σ d²` of itself, twice of which is taken off.
///
/// Checked: `loud_noise_is_no_evidence`, `what_goes_together_is_less_evidence`.
pub(super) fn heard(
    (problem, known): (&Problem, bool),
    current: &Fit,
    (evidence, fit): (f64, &Fit),
) -> f64 {
    let paid = penalty(problem, fit.free().saturating_sub(current.free()));
    let lags = if known { 1 } else { TOGETHER };
    let loudness = loudness((problem, lags), current, fit);
    let louder = (loudness / dispersion(problem, fit)).max(1.0);
    (evidence + paid) / louder - paid
}

/// Mean square of what a set leaves, every sample weighed by the square of what the set changes there, and of neighbours
/// nearer than `lags` their products.
fn loudness((problem, lags): (&Problem, usize), current: &Fit, fit: &Fit) -> f64 {
    let before = current.predict(problem);
    let after = fit.predict(problem);
    let (mut heard, mut changed, mut fourth) = (0.0, 0.0, 0.0);
    for (k, record) in problem.records.iter().enumerate() {
        let (_, judged) = problem.channels(k);
        let mut weighing = Weighing::new(record, 2);
        // Changes and scores of the last samples, the newest first.
        let mut latest: VecDeque<[f64; 2]> = VecDeque::with_capacity(lags);
        for (i, measured) in judged.iter().enumerate() {
            let (old, new) = (before[k].judged[i], after[k].judged[i]);
            let Some(&[left, change]) = weighing.weigh(i, &[measured - new, new - old]) else {
                latest.clear();
                continue;
            };
            let score = change * left;
            heard += score.powi(2);
            changed += change.powi(2);
            fourth += change.powi(4);
            for (lag, [earlier, other]) in (1..).zip(&latest) {
                let together = 1.0 - f64::from(lag) / lags as f64;
                heard += 2.0 * together * score * other;
                fourth += 2.0 * (together * change * earlier).powi(2);
            }
            latest.push_front([change, score]);
            latest.truncate(lags - 1);
        }
    }
    match changed > 0.0 {
        true => heard / changed / (1.0 + CHANCE * (2.0 * fourth).sqrt() / changed),
        false => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::joint::effect::Acting;
    use crate::record::Record;
    use crate::record::colour::Colour;
    use crate::record::noise::Noise;
    use crate::record::noise::tests::drawn;

    /// Noise of the same mean square everywhere, that grows with the load, or half of it slow.
    #[derive(Clone, Copy)]
    enum Kind {
        Alike,
        Grows,
        Slow,
    }

    /// How loud it is where a cubic spring acts, in noise that cycles have made known or not, and that is taken for first-order
    /// noise or not.
    fn loud(kind: Kind, known: bool, first_order: bool) -> f64 {
        let mut drawn = drawn(20261126);
        let mut white = || 12.0_f64.sqrt() * (drawn() - 0.5);
        let time: Vec<f64> = (0..4000).map(|i| 0.01 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.1 * t).sin()).collect();
        let mut slow = 0.0;
        let answer = |f: &f64| {
            let noise = match kind {
                Kind::Alike => white(),
                // Of sin⁸ the mean is 35/128.
                Kind::Grows => (f / 80.0).powi(4) / (35.0_f64 / 128.0).sqrt() * white(),
                Kind::Slow => {
                    slow = 0.9 * slow + 0.19_f64.sqrt() * white();
                    0.5_f64.sqrt() * (slow + white())
                }
            };
            1e-8 * f + 1e-8 * noise
        };
        let record = Record {
            name: "loud".to_string(),
            displacement: force.iter().map(answer).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let mut bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        if first_order {
            let colour = Colour::first_order(bench.noise[0].colour.neighbours());
            bench.weigh(vec![Noise {
                colour,
                ..bench.noise[0]
            }]);
        }
        let current = baseline(&bench.train);
        let effect = find("cubic_stiffness").unwrap().effect();
        let values = vec![2e-15, 0.0, 0.0, 0.0, 0.0, 0.0];
        let fit = Fit {
            effects: vec![Acting { effect, values }],
            ..current.clone()
        };
        let scale = dispersion(&bench.train, &fit);
        let paid = penalty(&bench.train, 1);
        let heard = heard((&bench.train, known), &current, (100.0, &fit));
        (100.0 + paid) / (heard + paid) * scale
    }

    #[test]
    fn loud_noise_is_no_evidence() {
        // E sin¹⁴ / (E sin⁶ E sin⁸) is 2.45, of which twice a scatter of 0.034 is taken off.
        let (grows, alike) = (
            loud(Kind::Grows, true, false),
            loud(Kind::Alike, true, false),
        );
        assert!((2.0..2.6).contains(&grows), "{grows}");
        assert!((1.0..1.1).contains(&alike), "{alike}");
    }

    /// Half slow and half fast, neighbours go together by 0.45, samples twice as far off by 0.405 and not by its square.
    #[test]
    fn what_goes_together_is_less_evidence() {
        let (slow, taken) = (loud(Kind::Slow, false, true), loud(Kind::Slow, true, true));
        assert!(slow > 1.5 && taken < 1.1, "{slow} {taken}");
        let alike = loud(Kind::Alike, false, false);
        assert!((1.0..1.1).contains(&alike), "{alike}");
        // Whitened as what it is, nothing goes together in it.
        let both = loud(Kind::Slow, false, false);
        assert!((1.0..1.15).contains(&both), "{both}");
    }
}
