//! Trials beside a set that are known from before: of the place of the cause that was taken from them, or of its place
//! before noise or cells were known better.

use super::coarsely::{BEHIND, trials_again};
use super::forms::form;
use super::trials::{Effort, Trial};
use crate::causes::Scale;
use crate::identify::operators::Operators;
use crate::identify::{Fit, Problem};
use crate::joint::effect::Acting;

/// Every cause that was tried beside these.
#[derive(Debug, Clone)]
pub struct Beside {
    /// The others of the set.
    others: Vec<Acting>,
    /// Every cause tried beside them, best first.
    trials: Vec<Trial>,
    /// The cells that they were fitted on.
    cells: Operators,
    /// Misfit below which all have been followed, on the records as they were then.
    below: f64,
}

impl Beside {
    /// Trials beside a set, as it was when they were made.
    pub(super) fn of(problem: &Problem, set: &Fit, trials: Vec<Trial>) -> Beside {
        let plausible = trials.iter().filter(|t| t.plausible);
        let lowest = plausible.fold(set.misfit, |least, t| least.min(t.fit.misfit));
        Beside {
            below: lowest + BEHIND * (set.misfit - lowest),
            ..Beside::asked(problem, set.effects.clone(), trials)
        }
    }

    /// Trials of a place that was asked for every cause below the misfit that its set had to be exchanged for.
    pub(super) fn asked(problem: &Problem, others: Vec<Acting>, trials: Vec<Trial>) -> Beside {
        Beside {
            others,
            trials,
            cells: problem.operators.clone(),
            below: f64::INFINITY,
        }
    }

    /// Those beside the same causes in the same forms, fitted anew from where they ended, as far as they come near a misfit
    /// that is `wanted`; `None` where none is known, or not all below that were followed.
    pub(super) fn again(
        known: &[Beside],
        (problem, scale): (&Problem, &Scale),
        set: &Fit,
        wanted: f64,
    ) -> Option<Vec<Trial>> {
        let forms = |effects: &[Acting]| -> Vec<_> { effects.iter().map(form).collect() };
        let asked = forms(&set.effects);
        let same = |one: &&Beside| wanted <= one.below && forms(&one.others) == asked;
        let one = known.iter().find(same)?;
        let full = (Effort::Full, wanted);
        Some(trials_again(
            (&one.trials, &one.cells),
            (problem, scale),
            set,
            full,
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::coarsely::trials;
    use crate::diagnose::search::tests::dashpot;
    use crate::identify::{baseline, refit};

    /// Beside the same cause in the same form, below what was followed.
    #[test]
    fn what_was_tried_beside_a_set_is_known_again() {
        let bench = dashpot(20261201);
        let place = (&bench.train, &bench.scale);
        let plain = baseline(&bench.train);
        let set = |name: &str, value: f64| {
            let effect = find(name).unwrap().effect();
            let mut values = vec![0.0; effect.parameters().len()];
            values[0] = value;
            refit(&bench.train, &plain, vec![Acting { effect, values }])
        };
        let drift = set("displacement_drift", 1e-10);
        let asked = (Effort::Full, f64::INFINITY);
        let tried = trials(place.0, place.1, true, &drift, asked);
        let first = tried[0].clone();
        assert!(first.fit.misfit < 0.5 * drift.misfit);
        let known = [Beside::of(&bench.train, &drift, tried)];
        let near = first.fit.misfit + 0.5 * BEHIND * (drift.misfit - first.fit.misfit);
        let again = Beside::again(&known, place, &drift, near).unwrap();
        assert_eq!(again[0].cause.name(), first.cause.name());
        assert!((again[0].fit.misfit - first.fit.misfit).abs() < 1.0);
        // Refits were given up where more was left.
        assert!(Beside::again(&known, place, &drift, drift.misfit).is_none());
        let other = set("asymmetric_friction", 0.1);
        assert!(Beside::again(&known, place, &other, near).is_none());
        // A place was asked as far as an exchange may be worth.
        let [known] = known;
        let asked = Beside::asked(&bench.train, known.others, known.trials);
        assert!(Beside::again(&[asked], place, &drift, drift.misfit).is_some());
    }
}
