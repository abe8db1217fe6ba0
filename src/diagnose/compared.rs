//! The set that is kept beside the baseline: both refitted, predicted, and what each leaves.

use super::gain;
use super::prepare::Bench;
use super::search::Found;
use super::structure::{Structure, structure};
use super::tested::Prospect;
use crate::identify::{Fit, Prediction, baseline, refit, smoothed};

/// Share of the judged channel's variance that a joint has to answer to be one, where no repeated cycles tell the noise.
const FOLLOWS: f64 = 0.5;

/// Both models.
pub(super) struct Compared {
    /// What was found, its joints as smooth as predicts best.
    pub(super) found: Found,
    /// The set refitted to all samples, as smooth: the joint that is handed out.
    pub(super) whole: Fit,
    /// What the baseline of fitted samples predicts.
    pub(super) before: Vec<Prediction>,
    /// The same of the set.
    pub(super) after: Vec<Prediction>,
    /// What the set of all samples predicts.
    pub(super) modelled: Vec<Prediction>,
    /// Held-out rms after over before, and its 95 % interval.
    pub(super) gain: (f64, Option<(f64, f64)>),
    /// What the baseline of all samples leaves.
    pub(super) structure_before: Structure,
    /// The same of the set.
    pub(super) structure_after: Structure,
    /// Share of the judged channel's variance that the joint answers.
    pub(super) follows: f64,
}

impl Compared {
    pub(super) fn of(bench: &Bench, sober: &Found) -> Compared {
        let (found, base) = rayon::join(
            || sober.clone().smoothed(bench),
            || smoothed(&bench.whole, &baseline(&bench.whole)),
        );
        let before = found.baseline.predict(&bench.train);
        let after = found.best.predict(&bench.train);
        let whole = match found.best.effects.is_empty() {
            true => base.clone(),
            false => {
                let whole = refit(&bench.whole, &found.best, found.best.effects.clone());
                smoothed(&bench.whole, &whole)
            }
        };
        let left = |predictions: &[Prediction]| structure(&bench.whole, predictions, &bench.noise);
        let modelled = whole.predict(&bench.whole);
        Compared {
            gain: gain::ratio(bench, &before, &after),
            structure_before: left(&base.predict(&bench.whole)),
            structure_after: left(&modelled),
            follows: gain::follows(bench, &modelled),
            found,
            whole,
            before,
            after,
            modelled,
        }
    }

    /// False where nothing tells the noise but what is left, and the joint answers nothing: that leaves "noise" alone.
    pub(super) fn goes_together(&self, bench: &Bench) -> bool {
        bench.noise_is_repeated() || self.follows > FOLLOWS
    }

    /// What the joint leaves over the noise's variance; without end where the channels do not go together.
    pub(super) fn chi(&self, bench: &Bench) -> f64 {
        match self.goes_together(bench) {
            true => self.whole.misfit / bench.whole.rows().max(1) as f64,
            false => f64::INFINITY,
        }
    }

    /// Share of the baseline's structure that the set leaves, and that beyond its standard error: noise alone leaves as
    /// much now and then, and beside a small effect that is a large part of it.
    pub(super) fn left(&self) -> (f64, f64) {
        let before = self.structure_before.share;
        let of_before = |share: f64| match before > 0.0 {
            true => (share / before).clamp(0.0, 1.0),
            false => 0.0,
        };
        let Structure { share, error, .. } = self.structure_after;
        (of_before(share), of_before(share - error))
    }

    /// True where the gain on held-out data is beyond its scatter, or likelier than none: of a few cycles a bootstrap draws
    /// some that show nothing of what happens once.
    pub(super) fn is_proven(&self, bench: &Bench) -> bool {
        let (ratio, interval) = self.gain;
        let likelier = || Prospect::of(bench, &self.found.baseline, &self.found.best).is_likelier();
        interval.map_or(ratio, |(_, upper)| upper) < 1.0 || ratio < 1.0 && likelier()
    }

    /// True where a gain that is proven may count as an explanation: the noise is told apart from structure, and the joint
    /// answers the better part of the channel.
    pub(super) fn may_explain(&self, bench: &Bench) -> bool {
        self.is_proven(bench) && !bench.noise_may_be_structure() && self.follows > FOLLOWS
    }
}
