//! Records as a search of them teaches to read them: with the noise and on the cells that suit the causes it found.

use super::prepare::Bench;
use super::trials::{ALARM, dispersion};
use crate::identify::{Fit, Operators, Problem, suited};
use crate::record::noise::Noise;
use crate::record::repeats::from_repeats;

/// Part of a deviation up to which less noise is another noise, and not the same told once more. Judged: a fifth of the
/// variance.
const LESS: f64 = 0.9;

/// Part of what a set leaves beyond noise that other cells have to take: where something else acts, cells would crowd about
/// that.
const MOST: f64 = 0.5;

/// Times that cells are spread anew by what was fitted on the last ones.
const ROUNDS: usize = 3;

/// The records with less noise, where causes took away what repeated cycles had shown of them, and on other cells, where
/// those of the baseline suit a joint without the causes: cells crowd where the density is high, and beside a strong cause
/// the baseline's is elsewhere.
///
/// `None` where neither changes what the causes leave by more than chance.
pub(super) fn taught(bench: &Bench, best: &Fit) -> Option<Bench> {
    if best.effects.is_empty() {
        return None;
    }
    let (noise, cells) = rayon::join(
        || noise_beside(bench, best),
        || cells_beside(&bench.train, best),
    );
    if noise.is_none() && cells.is_none() {
        return None;
    }
    let mut taught = bench.clone();
    if let Some((operators, _)) = cells {
        taught.whole.operators.clone_from(&operators);
        taught.train.operators = operators;
    }
    if let Some(noise) = noise {
        taught.weigh(noise);
    }
    Some(taught)
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
    cells_beside(train, fit).map_or(fit.misfit, |(_, left)| left)
}

/// As many cells, spread by the density beside the causes of a set, and what the set leaves on them; `None` where the set, its causes as they are, does not
/// leave less on them by an alarm, and by most of what it leaves beyond noise.
fn cells_beside(train: &Problem, best: &Fit) -> Option<(Operators, f64)> {
    let cells = train.operators.edges.len();
    let mut now = (train.clone(), best.clone());
    for _ in 0..ROUNDS {
        let mut again = now.0.clone();
        again.operators = now.0.operators.adapted(&now.1.coefficients, cells);
        let start = Fit {
            coefficients: now
                .0
                .operators
                .carried(&now.1.coefficients, &again.operators),
            ..now.1.clone()
        };
        let fit = suited(&again, &start, start.effects.clone());
        if fit.misfit >= now.1.misfit {
            break;
        }
        now = (again, fit);
    }
    let (suiting, fit) = now;
    let less = best.misfit - fit.misfit;
    let beyond = best.misfit - train.rows() as f64;
    let enough = (ALARM * dispersion(&suiting, &fit)).max(MOST * beyond);
    (less > enough).then_some((suiting.operators, fit.misfit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::diagnose::gridded::tests::{SOUNDS, tone};
    use crate::diagnose::prepare::prepare;
    use crate::identify::beginning::Beginning;
    use crate::identify::{Form, baseline, refit};
    use crate::joint::effect::Acting;
    use crate::record::Record;
    use crate::record::noise::tests::drawn;

    const COUNT: usize = 6000;

    /// Ten cycles of a displacement that grows over the first two.
    fn driven() -> Vec<f64> {
        let grown = |i: f64| 2.1 * (0.0105 * i).sin() * (i / 1200.0).min(1.0);
        (0..COUNT).map(|i| grown(i as f64)).collect()
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
            time: Some((0..COUNT).map(|i| 0.0025 * i as f64).collect()),
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
            (taught(&bench, &best), bench, best)
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

    /// A sound that no cycle repeats is noise until a cause takes it away.
    #[test]
    fn what_a_cause_takes_away_is_noise_no_longer() {
        let mut noise = drawn(20261129);
        let displacement = driven();
        let sound = tone(&displacement);
        let both = joint(&displacement, (1.0, 1.0)).into_iter().zip(&sound);
        let force = both.map(|(f, s)| f + 0.5 * s + 0.2 * (noise() - 0.5));
        let bench = bench(force.collect(), displacement);
        let white = 0.2 / 12.0_f64.sqrt();
        assert!(bench.noise[0].deviation > 4.0 * white, "{:?}", bench.noise);
        let values = vec![0.5];
        let best = with(
            &bench,
            Acting {
                effect: &SOUNDS,
                values,
            },
        );
        let told = taught(&bench, &best).unwrap().noise[0];
        assert!((told.deviation / white - 1.0).abs() < 0.1, "{told:?}");
    }
}
