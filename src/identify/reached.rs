//! Where a refit stands: a dictionary, effects, and what they leave.

use super::fit::{Fit, projected};
use super::problem::{Prediction, Problem};
use super::series;
use crate::joint::effect::Acting;

/// Times the size of the effect that a refit starts from is cut to a third: sizes come from a score
/// to first order.
const SMALLER: usize = 6;

/// The last of the effects a third as large.
fn shrunk(effects: &[Acting]) -> Vec<Acting> {
    let mut smaller = effects.to_vec();
    let newest = smaller.iter_mut().rev().find(|a| !series::is(a));
    if let Some(acting) = newest {
        for (value, parameter) in acting.values.iter_mut().zip(acting.effect.parameters()) {
            if let Some(zero) = parameter.vanishes_at {
                *value = zero + (*value - zero) / 3.0;
            }
        }
    }
    smaller
}

/// A model on the way down, and what it leaves.
pub(super) struct Reached {
    pub coefficients: Vec<f64>,
    pub effects: Vec<Acting>,
    pub predictions: Vec<Prediction>,
    pub misfit: f64,
    pub offsets: Vec<f64>,
}

impl Reached {
    /// Some effects with a dictionary.
    pub fn at(problem: &Problem, coefficients: Vec<f64>, effects: Vec<Acting>) -> Reached {
        let predictions = problem.predict(&coefficients, &effects);
        let (misfit, offsets) = problem.misfit(&predictions);
        Reached {
            coefficients,
            effects,
            predictions,
            misfit,
            offsets,
        }
    }

    /// The same effects with the dictionary that suits them.
    pub fn suited(&self, problem: &Problem) -> Reached {
        let (anew, _) = self.projected(problem);
        Reached::at(problem, anew, self.effects.clone())
    }

    /// The same, where it leaves less than a misfit; not marched where its linearised model foretells that it does not.
    pub fn suited_below(&self, problem: &Problem, misfit: f64) -> Option<Reached> {
        let (anew, foretold) = self.projected(problem);
        let march = || Reached::at(problem, anew, self.effects.clone());
        let suited = (foretold < misfit).then(march);
        suited.filter(|suited| suited.misfit < misfit)
    }

    fn projected(&self, problem: &Problem) -> (Vec<f64>, f64) {
        let model = (&self.coefficients[..], &self.effects[..]);
        projected(problem, model, &self.predictions)
    }

    /// A fit like another one as this is.
    pub fn fit(self, other: Fit) -> Fit {
        Fit {
            coefficients: self.coefficients,
            misfit: self.misfit,
            offsets: self.offsets,
            ..other
        }
    }

    /// The smaller start, or the better suited one, of effects that begin worse than a model without them.
    pub fn begun(mut self, problem: &Problem, before: f64) -> Reached {
        for _ in 0..SMALLER {
            if self.misfit <= before {
                break;
            }
            if let Some(suited) = self.suited_below(problem, before) {
                return suited;
            }
            let smaller = shrunk(&self.effects);
            let smaller = Reached::at(problem, self.coefficients.clone(), smaller);
            if smaller.misfit >= self.misfit {
                break;
            }
            self = smaller;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::{Form, baseline, glanced, refit, refit_below};
    use crate::joint::effect::{Effect, Place, Situation, SlipLimit};
    use crate::joint::parameters::Parameter;
    use crate::record::Record;

    struct Uneven;

    static SHARE: [Parameter; 1] = [Parameter {
        name: "share",
        symbol: "a",
        unit: "1",
        lower: -0.95,
        upper: 0.95,
        vanishes_at: Some(0.0),
        neutral: None,
        meaning: "by which limits are larger one way",
    }];

    impl Effect for Uneven {
        fn name(&self) -> &'static str {
            "uneven"
        }
        fn place(&self) -> Place {
            Place::SlipLimit
        }
        fn parameters(&self) -> &'static [Parameter] {
            &SHARE
        }
        fn slip_limit(&self, values: &[f64], _last: &Situation, _memory: &[f64]) -> SlipLimit {
            SlipLimit {
                positive: 1.0 + values[0],
                negative: 1.0 - values[0],
            }
        }
    }

    fn uneven(share: f64) -> Vec<Acting> {
        vec![Acting {
            effect: &Uneven,
            values: vec![share],
        }]
    }

    /// What a joint of a smooth density, on a grid of its own, does with limits a fifth larger one way; nearly.
    fn of_uneven_limits() -> Problem {
        let force: Vec<f64> = (0..1500)
            .map(|i| 0.004 * f64::from(i))
            .map(|t| 0.2 * (31.0 * t).sin() + 0.5 * (13.0 * t).sin() - 0.3 * (2.6 * t).sin())
            .collect();
        let mut record = Record {
            name: "uneven".to_string(),
            time: Some((0..1500).map(|i| 0.004 * f64::from(i)).collect()),
            displacement: vec![0.0; force.len()],
            force,
            ..Record::default()
        };
        let mut problem = Problem::new(Form::Play, &[record.clone()]);
        let edges: Vec<f64> = (1..=300).map(|j| 0.0033 * f64::from(j)).collect();
        let density = |r: &f64| (-0.5 * ((r / 0.8).ln() / 0.46).powi(2)).exp() / r;
        let coefficients: Vec<f64> = std::iter::once(1.0)
            .chain(edges.iter().map(|r| 0.002 * density(r)))
            .chain([0.0; crate::identify::operators::BEYOND])
            .collect();
        problem.operators = crate::identify::Operators::with_edges(Form::Play, edges);
        let exact = problem.predict(&coefficients, &uneven(0.2))[0]
            .judged
            .clone();
        let rough = |(i, u): (usize, &f64)| u + 1e-3 * (1e3 * (i * i) as f64).sin();
        record.displacement = exact.iter().enumerate().map(rough).collect();
        let mut problem = Problem::new(Form::Play, &[record]);
        problem.records[0].weight.fill(1e3);
        problem
    }

    /// Values that go far leave their dictionary behind, and another one suits them.
    #[test]
    fn a_value_goes_far_beside_a_dictionary_that_must_follow_it() {
        let problem = of_uneven_limits();
        let start = baseline(&problem);
        let far = Reached::at(&problem, start.coefficients.clone(), uneven(0.2));
        let near = far.suited(&problem);
        // Of a joint under force limits that are given leave a linear problem: one step ends at its least.
        assert!(far.misfit > 10.0 * near.misfit);
        let below = |share: f64| far.suited_below(&problem, share * near.misfit);
        assert!(below(0.99).is_none() && below(1.01).is_some_and(|b| b.misfit == near.misfit));
        for share in [0.02, -0.1, 0.4] {
            let fit = refit(&problem, &start, uneven(share));
            let found = fit.effects[0].values[0];
            assert!((found - 0.2).abs() < 0.005, "from {share}: {found}");
            assert!(near.misfit < 1.01 * fit.misfit);
        }
    }

    /// Of what is wanted of it the first step has gone as far as any hopeless refit does.
    #[test]
    fn a_refit_that_its_linearised_model_gives_no_prospect_ends_after_its_first_step() {
        let problem = of_uneven_limits();
        let start = baseline(&problem);
        let stepped = |steps| glanced(&problem, &start, uneven(0.02), steps).misfit;
        let wanting = |bound: f64| refit_below(&problem, &start, uneven(0.02), bound).misfit;
        let (first, least) = (stepped(1), wanting(f64::INFINITY));
        assert!(stepped(2) < first && least < 0.9 * first);
        assert_eq!(wanting(-1e3 * start.misfit), first);
        assert_eq!(wanting(1.01 * least), least);
    }

    /// Friction that falls by a share over a path of the slip.
    struct Fading;

    static FADES: [Parameter; 2] = [
        SHARE[0],
        Parameter {
            name: "per_path",
            symbol: "1/L",
            unit: "1/m",
            lower: 0.0,
            upper: 1e15,
            vanishes_at: None,
            neutral: None,
            meaning: "one over the path",
        },
    ];

    impl Effect for Fading {
        fn name(&self) -> &'static str {
            "fading"
        }
        fn place(&self) -> Place {
            Place::SlipLimit
        }
        fn parameters(&self) -> &'static [Parameter] {
            &FADES
        }
        fn memory(&self) -> usize {
            2
        }
        fn remember(&self, _values: &[f64], now: &Situation, memory: &mut [f64]) {
            memory[0] += (now.slip - memory[1]).abs();
            memory[1] = now.slip;
        }
        fn slip_limit(&self, values: &[f64], _last: &Situation, memory: &[f64]) -> SlipLimit {
            SlipLimit::either_way(1.0 - values[0] * (1.0 - (-values[1] * memory[0]).exp()))
        }
    }

    /// Near full slip a loss and the joint beside which it is sought change each other's answer by far more than first order
    /// tells: the dictionary follows every step, and different starts come to one end.
    #[test]
    fn a_joint_near_full_slip_follows_friction_that_falls() {
        let force: Vec<f64> = (0..2400)
            .map(|i| (0.0065 * f64::from(i), (f64::from(i) / 1200.0).ceil() / 2.0))
            .map(|(t, level)| level * (0.33 * (20.0 * t).sin() + 0.37 * (13.0 * t).sin() - 0.28))
            .collect();
        let mut record = Record {
            name: "fading".to_string(),
            time: Some((0..2400).map(|i| 0.0065 * f64::from(i)).collect()),
            displacement: vec![0.0; force.len()],
            force,
            ..Record::default()
        };
        let fading = |share: f64, per_path: f64| {
            vec![Acting {
                effect: &Fading,
                values: vec![share, per_path],
            }]
        };
        let mut problem = Problem::new(Form::Play, &[record.clone()]);
        let edges: Vec<f64> = (1..=300).map(|j| 0.0034 * f64::from(j)).collect();
        // Compliance grows without end as the last contacts let go.
        let coefficients: Vec<f64> = std::iter::once(1.0)
            .chain(edges.iter().map(|r| 0.01 / (1.05 - r).powi(2)))
            .chain([0.0; crate::identify::operators::BEYOND])
            .collect();
        problem.operators = crate::identify::Operators::with_edges(Form::Play, edges);
        let exact = problem.predict(&coefficients, &fading(0.06, 0.01))[0]
            .judged
            .clone();
        let size = exact.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
        let rough = |(i, u): (usize, &f64)| u + 4e-3 * size * (1e3 * (i * i) as f64).sin();
        record.displacement = exact.iter().enumerate().map(rough).collect();
        let mut problem = Problem::new(Form::Play, &[record]);
        problem.records[0].weight.fill(1.0 / (4e-3 * size));
        let start = baseline(&problem);
        let ends: Vec<Fit> = [(0.02, 0.1), (0.06, 0.1), (0.02, 0.01), (0.06, 1e-3)]
            .map(|(share, per_path)| refit(&problem, &start, fading(share, per_path)))
            .to_vec();
        let least = ends
            .iter()
            .fold(f64::INFINITY, |least, fit| least.min(fit.misfit));
        assert!(least < 0.01 * start.misfit);
        // Along the valley, a larger loss over a longer path, steps end where each takes a hundredth.
        for fit in ends {
            assert!(fit.misfit < 1.05 * least, "{:?}", fit.effects[0].values);
        }
    }
}
