//! What a cause brings where the noise is louder than elsewhere: at large loads, or in what stands alone.

use super::trials::{dispersion, penalty};
use crate::identify::weighing::Weighing;
use crate::identify::{Fit, Problem};

/// Standard errors up to which noise passes for no louder than its mean.
const CHANCE: f64 = 2.0;

/// A set's evidence against the current one where every sample counts for the noise that is heard there.
///
/// `fall/ℓ − penalty`, with `ℓ = Σ d² e² / Σ d²` over the whitened samples, `d` what the set predicts otherwise and
/// `e` what it leaves: of noise alone the fall is `ℓ` times as large as where all samples were alike (White's
/// sandwich). A mean over few samples scatters by `√(2 Σ d⁴)/Σ d²` of itself, twice of which is taken off.
///
/// Checked: `loud_noise_is_no_evidence`.
pub(super) fn heard(problem: &Problem, current: &Fit, (evidence, fit): (f64, &Fit)) -> f64 {
    let paid = penalty(problem, fit.free().saturating_sub(current.free()));
    let louder = (loudness(problem, current, fit) / dispersion(problem, fit)).max(1.0);
    (evidence + paid) / louder - paid
}

/// Mean square of what a set leaves, every sample weighed by the square of what the set changes there.
fn loudness(problem: &Problem, current: &Fit, fit: &Fit) -> f64 {
    let before = current.predict(problem);
    let after = fit.predict(problem);
    let (mut heard, mut changed, mut fourth) = (0.0, 0.0, 0.0);
    for (k, record) in problem.records.iter().enumerate() {
        let (_, judged) = problem.channels(k);
        let mut weighing = Weighing::new(record, 2);
        for (i, measured) in judged.iter().enumerate() {
            let (old, new) = (before[k].judged[i], after[k].judged[i]);
            let Some(&[left, change]) = weighing.weigh(i, &[measured - new, new - old]) else {
                continue;
            };
            heard += (change * left).powi(2);
            changed += change.powi(2);
            fourth += change.powi(4);
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
    use crate::record::noise::tests::drawn;

    /// How loud it is where a cubic spring acts, in noise that grows with the load or in noise of the same mean square
    /// that does not.
    fn loud(grows: bool) -> f64 {
        let mut noise = drawn(20261126);
        let time: Vec<f64> = (0..4000).map(|i| 0.01 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.1 * t).sin()).collect();
        let answer = |f: &f64| {
            // Of sin⁸ the mean is 35/128.
            let loud = match grows {
                true => (f / 80.0).powi(4) / (35.0_f64 / 128.0).sqrt(),
                false => 1.0,
            };
            1e-8 * f + 1e-8 * loud * 12.0_f64.sqrt() * (noise() - 0.5)
        };
        let record = Record {
            name: "loud".to_string(),
            displacement: force.iter().map(answer).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        let current = baseline(&bench.train);
        let effect = find("cubic_stiffness").unwrap().effect();
        let values = vec![2e-15, 0.0, 0.0, 0.0, 0.0, 0.0];
        let fit = Fit {
            effects: vec![Acting { effect, values }],
            ..current.clone()
        };
        let scale = dispersion(&bench.train, &fit);
        let paid = penalty(&bench.train, 1);
        let heard = heard(&bench.train, &current, (100.0, &fit));
        (100.0 + paid) / (heard + paid) * scale
    }

    #[test]
    fn loud_noise_is_no_evidence() {
        // E sin¹⁴ / (E sin⁶ E sin⁸) is 2.45, of which twice a scatter of 0.034 is taken off.
        let (grows, alike) = (loud(true), loud(false));
        assert!((2.0..2.6).contains(&grows), "{grows}");
        assert!((1.0..1.1).contains(&alike), "{alike}");
    }
}
