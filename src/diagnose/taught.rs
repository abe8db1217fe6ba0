//! Records as a search of them teaches to read them: with the noise and on the cells that suit the causes it found.

use super::coarsely::trials_again;
use super::investigation::Investigation;
use super::prepare::Bench;
use super::search::Found;
use super::trials::{ALARM, Effort, Trial, dispersion};
use crate::identify::finer::finer;
use crate::identify::operators::{COUNT, Operators};
use crate::identify::{Fit, Problem, refit, suited, without};
use crate::joint::effect::Acting;
use crate::record::noise::Noise;
use crate::record::repeats::from_repeats;

/// Part of a deviation up to which less noise is another noise, and not the same told once more. Judged: a fifth of the
/// variance.
const LESS: f64 = 0.9;

/// Part of what a set leaves beyond noise that other cells have to take: where something else acts, cells would crowd about
/// that.
const MOST: f64 = 0.5;

/// What a set of several may leave over the noise's variance to be asked whether one of them mends the cells: beside what no
/// cause explains, cells are the least of what is wrong.
const NEARLY_NOISE: f64 = 1.5;

/// The same from which less noise finds no other set: what is compared is what sets leave, of which noise is the least part.
const FAR_FROM_NOISE: f64 = 2.0;

/// Times that cells are spread anew by what was fitted on the last ones.
const ROUNDS: usize = 3;

/// Records read otherwise, and the causes whose set that suits.
pub(super) struct Taught {
    /// The records.
    pub(super) bench: Bench,
    /// The set, or one of a cause less.
    pub(super) suits: Vec<Acting>,
    /// True where the same set would be found: of less noise it leaves much more than that.
    pub(super) finds_the_same: bool,
}

/// The records with less noise, where causes took away what repeated cycles had shown of them, and on other cells, where
/// those of the baseline suit a joint without the causes: cells crowd where the density is high, and beside a strong cause
/// the baseline's is elsewhere.
///
/// `None` where neither changes what the causes leave, or what one of several brings beside the others, by more than
/// chance.
pub(super) fn taught(bench: &Bench, best: &Fit) -> Option<Taught> {
    if best.effects.is_empty() {
        return None;
    }
    let train = &bench.train;
    let (noise, cells) = rayon::join(
        || noise_beside(bench, best),
        || cells_of_fewer(train, best).or_else(|| cells_beside(train, best)),
    );
    if noise.is_none() && cells.is_none() {
        return None;
    }
    let mut taught = Taught {
        bench: bench.clone(),
        suits: best.effects.clone(),
        finds_the_same: cells.is_none() && dispersion(train, best) > FAR_FROM_NOISE,
    };
    if let Some((suiting, fit)) = cells {
        taught.bench.whole.operators.clone_from(&suiting.operators);
        taught.bench.train.operators = suiting.operators;
        taught.suits = fit.effects;
    }
    if let Some(noise) = noise {
        taught.bench.weigh(noise);
    }
    Some(taught)
}

impl Taught {
    /// What was found, fitted to the records as they are read now. What its causes bring over what is left is as it was.
    pub(super) fn again(self, found: &Found, (first, known): (Fit, Vec<Trial>)) -> Investigation {
        let best = refit(&self.bench.train, &found.best, found.best.effects.clone());
        Investigation {
            found: Found {
                baseline: first,
                best,
                trials: known,
                rivals: found.rivals.clone(),
                evidence: found.evidence.clone(),
                unasked: found.unasked,
            },
            bench: self.bench,
        }
    }

    /// Every cause alone beside the baseline, from where it was found before; one that the records suit from where it was
    /// found beside others as well.
    pub(super) fn alone(&self, known: (&[Trial], &Operators), first: &Fit) -> Vec<Trial> {
        let Bench { train, scale, .. } = &self.bench;
        let asked = (Effort::Full, f64::INFINITY);
        let mut trials = trials_again(known, (train, scale), first, asked);
        let [one] = self.suits.as_slice() else {
            return trials;
        };
        let fit = refit(train, first, vec![one.clone()]);
        let own = |t: &&mut Trial| t.cause.name() == one.effect.name();
        if let Some(trial) = trials.iter_mut().find(own)
            && fit.misfit < trial.fit.misfit
        {
            *trial = Trial::of((train, scale), trial.cause, first, fit);
        }
        trials.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        trials
    }
}

/// Noise as cycles of what a set leaves tell it, where that is less than repeated cycles of the response or of what
/// the baseline leaves had it; `None` where it is nowhere less.
fn noise_beside(bench: &Bench, best: &Fit) -> Option<Vec<Noise>> {
    let residuals = best.residuals(&bench.whole);
    let told = residuals.iter().enumerate().map(|(k, residual)| {
        let known = bench.noise[k];
        let (input, _) = bench.whole.channels(k);
        let least = bench.resolution[k];
        from_repeats(input, residual)
            .map(|n| Noise {
                deviation: n.deviation.max(least),
                ..n
            })
            .filter(|n| known.repeated && n.deviation < LESS * known.deviation)
    });
    let told: Vec<Option<Noise>> = told.collect();
    // A record may have the noise of another.
    let lender = |known: &Noise| bench.noise.iter().position(|n| n == known);
    let lent = |known: &Noise| lender(known).and_then(|k| told[k]);
    let both = told.iter().zip(&bench.noise);
    let noise = both.map(|(own, known)| own.or_else(|| lent(known)).unwrap_or(*known));
    told.iter().any(Option::is_some).then(|| noise.collect())
}

/// What a set leaves on the cells that suit it.
pub(super) fn left_on_own_cells(train: &Problem, fit: &Fit) -> f64 {
    cells_beside(train, fit).map_or(fit.misfit, |(_, suited)| suited.misfit)
}

/// The cells that suit a set, and the set on them; `None` where it does not leave less, its causes as they are, by
/// an alarm, and by most of what it leaves beyond noise.
fn cells_beside(train: &Problem, best: &Fit) -> Option<(Problem, Fit)> {
    let (suiting, fit) = suiting(train, best);
    let less = best.misfit - fit.misfit;
    let beyond = best.misfit - train.rows() as f64;
    let enough = (ALARM * dispersion(&suiting, &fit)).max(MOST * beyond);
    (less > enough).then_some((suiting, fit))
}

/// The cells that suit one cause less than a set of several has, where beside those it brings less than [`MOST`] of what it
/// brought: it mended the cells. With those others on them.
fn cells_of_fewer(train: &Problem, best: &Fit) -> Option<(Problem, Fit)> {
    let left = best.misfit / train.rows().max(1) as f64;
    if best.effects.len() < 2 || left > NEARLY_NOISE {
        return None;
    }
    let fewer = (0..best.effects.len()).filter_map(|place| {
        let less = without(train, best, place);
        let less = refit(train, &less, less.effects.clone());
        let (suiting, fit) = suiting(train, &less);
        let brought = less.misfit - best.misfit;
        if less.misfit - fit.misfit < (1.0 - MOST) * brought {
            return None;
        }
        let all = Fit {
            coefficients: fit.coefficients.clone(),
            ..best.clone()
        };
        let all = refit(&suiting, &all, all.effects.clone());
        let brings = fit.misfit - all.misfit;
        (brings < MOST * brought).then_some((suiting, fit))
    });
    fewer.min_by(|(_, a), (_, b)| a.misfit.total_cmp(&b.misfit))
}

/// As many cells spread by the density beside a set, or cells of half that width where they are wide, and the set on them,
/// its causes as they are: what leaves least.
fn suiting(train: &Problem, set: &Fit) -> (Problem, Fit) {
    let cells = train.operators.edges.len();
    let mut now = (train.clone(), set.clone());
    for _ in 0..ROUNDS {
        let mut again = now.0.clone();
        again.operators = now.0.operators.adapted(&now.1.coefficients, cells);
        let coarse = &now.0.operators;
        let carried = coarse.carried(&now.1.coefficients, &again.operators);
        let fit = suited_from(&again, &now.1, carried);
        if fit.misfit >= now.1.misfit {
            break;
        }
        now = (again, fit);
    }
    if cells > COUNT {
        return now;
    }
    let (half, shared) = finer(&now.0, &now.1.coefficients);
    let fit = suited_from(&half, &now.1, shared);
    match fit.misfit < now.1.misfit {
        true => (half, fit),
        false => now,
    }
}

/// A set, its causes as they are, with the dictionary that suits it from given coefficients on.
fn suited_from(problem: &Problem, set: &Fit, coefficients: Vec<f64>) -> Fit {
    let start = Fit {
        coefficients,
        ..set.clone()
    };
    suited(problem, &start, start.effects.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::gridded::tests::{Adds, SOUNDS, tone};
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline};
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    const SAMPLES: usize = 6000;

    /// Ten cycles of a displacement that grows over the first two.
    fn driven() -> Vec<f64> {
        let grown = |i: f64| 2.1 * (0.0105 * i).sin() * (i / 1200.0).min(1.0);
        (0..SAMPLES).map(|i| grown(i as f64)).collect()
    }

    /// Force of sliders, two thirds of which let go at nearly the same place; these shares of their limits hold upwards
    /// and downwards.
    fn joint(displacement: &[f64], (up, down): (f64, f64)) -> Vec<f64> {
        let spread = (1..=20).map(|j| 0.06 * f64::from(j));
        let together = (0..40).map(|j| 0.55 + 0.002 * f64::from(j));
        let limits: Vec<f64> = spread.chain(together).collect();
        let mut reached = vec![0.0_f64; limits.len()];
        let mut before = 0.0;
        let moved = displacement.iter().map(|&u| {
            for (d, limit) in reached.iter_mut().zip(&limits) {
                *d = (*d + u - before).clamp(-down * limit, up * limit);
            }
            before = u;
            reached.iter().sum()
        });
        moved.collect()
    }

    fn bench(force: Vec<f64>, displacement: Vec<f64>) -> Bench {
        let record = Record {
            name: "taught".to_string(),
            time: Some((0..SAMPLES).map(|i| 0.0025 * i as f64).collect()),
            force,
            displacement,
            ..Record::default()
        };
        prepare(Form::Stop, &[record], &[Beginning::default()])
    }

    fn with(bench: &Bench, acting: Acting) -> Fit {
        refit(&bench.train, &baseline(&bench.train), vec![acting])
    }

    /// The baseline smears what lets go at once over what either side holds.
    #[test]
    fn cells_crowd_where_the_joint_beside_a_cause_asks_for_them() {
        let mut noise = drawn(20261129);
        let mut asymmetric = |share: f64| {
            let displacement = driven();
            let force = joint(&displacement, (1.0 + share, 1.0 - share));
            let force = force.iter().map(|f| f + 0.02 * (noise() - 0.5)).collect();
            let bench = bench(force, displacement);
            let effect = find("asymmetric_friction").unwrap().effect();
            let values = vec![share];
            let best = with(&bench, Acting { effect, values });
            (taught(&bench, &best).map(|t| t.bench), bench, best)
        };
        let (suiting, asked, best) = asymmetric(0.24);
        let suiting = suiting.unwrap();
        assert!(suiting.train.operators != asked.train.operators);
        assert_eq!(suiting.train.operators, suiting.whole.operators);
        let again = with(&suiting, best.effects[0].clone());
        let left = |bench: &Bench, fit: &Fit| fit.misfit * bench.innovation_square();
        let both = [left(&suiting, &again), left(&asked, &best)];
        assert!(both[0] < 0.9 * both[1], "{both:?}");
        // Without asymmetry the baseline's own cells are as good.
        assert!(asymmetric(1e-3).0.is_none());
    }

    static MENDS: Adds = Adds(|displacement| joint(displacement, (1.24, 0.76)));

    /// What adds the joint itself stands for cells that suit it; a sound stands for itself.
    #[test]
    fn cells_of_fewer_causes_are_those_beside_which_a_further_one_only_mended_cells() {
        let mut noise = drawn(20261129);
        let mut suits = |heard: f64, second: &'static Adds, value: f64| {
            let displacement = driven();
            let both = joint(&displacement, (1.24, 0.76))
                .into_iter()
                .zip(tone(&displacement));
            let force = both.map(|(f, sound)| f + heard * sound + 0.02 * (noise() - 0.5));
            let bench = bench(force.collect(), displacement);
            let one = Acting {
                effect: find("asymmetric_friction").unwrap().effect(),
                values: vec![0.24],
            };
            let two = Acting {
                effect: second,
                values: vec![value],
            };
            let first = baseline(&bench.train);
            let best = refit(&bench.train, &first, vec![one, two]);
            cells_of_fewer(&bench.train, &best).map(|(_, fit)| fit.effects)
        };
        let kept = suits(0.0, &MENDS, 0.5).unwrap();
        assert_eq!(kept.len(), 1);
        assert_eq!(kept[0].effect.name(), "asymmetric_friction");
        assert!(suits(0.02, &SOUNDS, 0.02).is_none());
    }

    /// A sound that no cycle repeats is noise until a cause takes it away, beside what no cause explains too: that alone is
    /// compared then.
    #[test]
    fn what_a_cause_takes_away_is_noise_no_longer() {
        let told = |unexplained: f64| {
            let mut noise = drawn(20261129);
            let displacement = driven();
            let sound = tone(&displacement);
            let both = joint(&displacement, (1.0, 1.0)).into_iter().zip(&sound);
            let force = both.map(|(f, s)| f + 0.5 * s + 0.2 * (noise() - 0.5));
            let even = displacement.iter().map(|u| unexplained * u.cos());
            let force = force.zip(even).map(|(f, e)| f + e).collect();
            let bench = bench(force, displacement);
            let white = 0.2 / 12.0_f64.sqrt();
            assert!(bench.noise[0].deviation > 4.0 * white, "{:?}", bench.noise);
            let sounds = Acting {
                effect: &SOUNDS,
                values: vec![0.5],
            };
            let best = with(&bench, sounds);
            let told = taught(&bench, &best).unwrap();
            let deviation = told.bench.noise[0].deviation;
            assert!((deviation / white - 1.0).abs() < 0.1, "{deviation}");
            (told, best)
        };
        // Another cause may be beneath the noise that was.
        assert!(!told(0.0).0.finds_the_same);
        let (told, best) = told(3.0);
        assert!(told.finds_the_same);
        let first = baseline(&told.bench.train);
        let found = Found::unasked(first.clone(), best, Vec::new());
        let again = told.again(&found, (first, Vec::new()));
        assert_eq!(again.found.best.effects.len(), 1);
        assert!(again.dispersion() > FAR_FROM_NOISE);
    }
}
