//! A mass that was found, marched in shorter steps or with more turns.

use super::prepare::Bench;
use crate::identify::weighing::whiten;
use crate::identify::{Fit, refit};

/// Parts of a step in which a mass that was found moves with the joint, and turns in which its share of a prescribed
/// force is taken off.
const HAULING: (u32, usize) = (4, 12);

/// Whitened square that counts at most, of three standard deviations: where a load breaks off, neither a coarse nor a
/// fine pass follows, and how far each is off there tells nothing of the mass.
const MOST: f64 = 9.0;

/// The set on a bench that marches in shorter steps or more turns, where it has a mass and they suit all samples
/// better, held-out ones included.
pub(super) fn finely(bench: &mut Bench, best: Fit) -> Fit {
    if !best.effects.iter().any(|a| a.effect.follows_motion()) {
        return best;
    }
    let coarse = (bench.train.hauling, bench.train.turns);
    let left = capped(bench, &best);
    bench.haul(HAULING);
    let finer = refit(&bench.train, &best, best.effects.clone());
    if capped(bench, &finer) < left {
        return finer;
    }
    bench.haul(coarse);
    best
}

/// Sum of the whitened squares of what a model leaves of all samples, each counted up to [`MOST`].
fn capped(bench: &Bench, fit: &Fit) -> f64 {
    let whole = &bench.whole;
    let of_record = |(k, residuals): (usize, &Vec<f64>)| {
        let record = &whole.records[k];
        let mut before = None;
        let each = residuals.iter().zip(&record.weight).map(|(residual, w)| {
            let (white, _) = whiten(record.autoregression, *residual, before);
            before = (*w > 0.0).then_some(*residual);
            (w * white).powi(2).min(MOST)
        });
        each.sum::<f64>()
    };
    fit.residuals(whole).iter().enumerate().map(of_record).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    /// Of noise alone nearly all is counted; a jump that no joint makes counts no more than its samples.
    #[test]
    fn what_no_model_follows_counts_by_its_samples() {
        let mut noise = drawn(20261125);
        let time: Vec<f64> = (0..3000).map(|i| 0.01 * f64::from(i)).collect();
        let force: Vec<f64> = time.iter().map(|t| 80.0 * (5.0 * t).sin()).collect();
        let record = Record {
            name: "jump".to_string(),
            displacement: force.iter().map(|f| 1e-8 * f + 1e-9 * noise()).collect(),
            force,
            time: Some(time),
            ..Record::default()
        };
        let mut bench = prepare(Form::Play, &[record], &[Beginning::default()]);
        let fit = baseline(&bench.train);
        let rows = bench.whole.rows() as f64;
        let calm = capped(&bench, &fit);
        assert!((calm / rows - 1.0).abs() < 0.1, "{calm} of {rows}");
        let jump = 1000..1010;
        let displacement = &mut bench.whole.records[0].displacement;
        displacement[jump.clone()]
            .iter_mut()
            .for_each(|u| *u += 1e-6);
        let jumped = capped(&bench, &fit);
        let most = MOST * (jump.len() + 1) as f64;
        assert!(jumped > calm && jumped < calm + most, "{calm}, {jumped}");
    }
}
