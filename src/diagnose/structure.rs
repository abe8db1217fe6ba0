//! Structure beyond noise: does what a model leaves repeat with the load or wander with time?

use crate::identify::weighing::whitened;
use crate::identify::{Prediction, Problem};
use crate::record::cycles::{alike, cycles};
use crate::record::noise::Noise;

/// What a model leaves, split into noise and structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// Variance that means over bins share, over the variance within bins: zero for noise.
    pub share: f64,
    /// Standard error of the share where noise alone is left, and at least what the share loses where noise is as slow as it
    /// may be.
    pub error: f64,
    /// Standard deviations by which the bins' means exceed what noise gives them, none counted for
    /// more than [`LOUDEST`].
    pub significance: f64,
    /// Correlation of neighbours in what is left within the bins, the largest of any record, beyond what repeated cycles show in
    /// its noise: first-order noise that was whitened has none.
    pub correlation: f64,
    /// The largest correlation in it of samples further apart, of either sign and beyond chance: what rings is no noise,
    /// and looks like it to its neighbours alone.
    pub ringing: f64,
    /// Bins that stand out most: record, first and last sample, deviation over its own error.
    pub places: Vec<Place>,
}

impl Structure {
    /// True where bins of the load or of a cycle stand out by more than noise explains.
    pub fn goes_with_the_load(&self) -> bool {
        self.significance > SEEN
    }

    /// True where bins stand out by more than noise explains, or neighbours go together.
    pub fn is_seen(&self) -> bool {
        self.goes_with_the_load() || self.correlation.max(self.ringing) > RANDOM
    }
}

/// Standard deviations of the bins' means below which nothing is seen in them.
const SEEN: f64 = 2.0;

/// Correlation of neighbours below which a whitened residual is as random as noise.
const RANDOM: f64 = 0.1;

/// One bin that stands out.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Index of the record.
    pub record: usize,
    /// First sample.
    pub from: usize,
    /// Last sample.
    pub to: usize,
    /// First sample and the one behind the last of the part of the cycle that the bin holds, in the first of its cycles;
    /// `None` where it holds all samples between its first and its last.
    pub part: Option<(usize, usize)>,
    /// Share of the structured variance in this bin.
    pub share: f64,
}

/// Phases a cycle is cut into.
const PHASES: usize = 16;

/// Square of the standard deviations that one bin may count for: structure is what many say, and a
/// peak that fell between two samples is not.
const LOUDEST: f64 = 25.0;

/// Standard errors that the noise of one record may be slower than it was taken for. That of several is so in all of them by
/// the less, the more of them told it each by itself.
const SLOWER: f64 = 2.0;

/// Bins the whitened residual by record × load level × phase (what repeats with the load), and by
/// record × cycle (what wanders from cycle to cycle), and compares the means with the scatter
/// within.
///
/// Noise more alike than it was taken for wanders where it should be white, so structure is what stands
/// out by the largest correlation that the noise may have as well: the lesser significance of both is told,
/// and the shares by the likeliest. Their error is at least what the shares lose by it.
pub fn structure(problem: &Problem, predictions: &[Prediction], noise: &[Noise]) -> Structure {
    let known = noise.to_vec();
    // One record may lend another its noise.
    let told = (0..noise.len()).filter(|&k| !noise[..k].contains(&noise[k]));
    let errors = SLOWER / (told.count().max(1) as f64).sqrt();
    let most = noise.iter().map(|n| Noise {
        colour: n.most_alike(errors),
        ..*n
    });
    let [taken, alike] =
        [known, most.collect()].map(|noise| whitened_by(problem, predictions, &noise));
    Structure {
        error: taken.error.max(taken.share - (alike.share - alike.error)),
        significance: taken.significance.min(alike.significance),
        ringing: taken.ringing.min(alike.ringing),
        ..taken
    }
}

/// Part of the noise's variance below which what scatters is no concern, a tenth in rms: beside less scatter than that
/// structure is nothing that matters.
const QUIET: f64 = 0.01;

fn whitened_by(problem: &Problem, predictions: &[Prediction], noise: &[Noise]) -> Structure {
    let mut bins: Vec<Bin> = Vec::new();
    let mut correlations: Vec<f64> = Vec::new();
    let mut ringing = 0.0_f64;
    for (k, prediction) in predictions.iter().enumerate() {
        let (input, judged) = problem.channels(k);
        let record = &problem.records[k];
        // Of records with different noise each counts by its own.
        let innovation = noise[k].innovation();
        let unit = if innovation > 0.0 { innovation } else { 1.0 };
        let errors = judged.iter().zip(&prediction.judged).enumerate();
        let left = errors.map(|(i, (y, p))| (y - p, record.counts(i)));
        let mut white = whitened(noise[k].colour, left);
        white.iter_mut().for_each(|w| *w /= unit);
        // What no fit answers for is no witness of how alike neighbours are either.
        let stretches = white.chunks_exact(STRETCH).enumerate();
        let all_count = |at: usize| (at * STRETCH..(at + 1) * STRETCH).all(|i| record.counts(i));
        let stretches = stretches.filter(|(at, _)| all_count(*at));
        let stretches: Vec<&[f64]> = stretches.map(|(_, stretch)| stretch).collect();
        correlations.push(correlation(&stretches, 1));
        let chance = CHANCE / ((STRETCH * stretches.len()).max(1) as f64).sqrt();
        // Noise that repeated cycles tell to be of another kind rings by itself.
        let farthest = if noise[k].beyond > 0.0 { 1 } else { FARTHEST };
        let lags = (2..=farthest).map(|lag| correlation(&stretches, lag).abs() - chance);
        ringing = lags.fold(ringing, f64::max);
        for Piece {
            from,
            to,
            phases,
            cuts,
        } in pieces(input)
        {
            let mut own: Vec<Bin> = (0..phases)
                .map(|phase| {
                    let (start, end) = cuts[0];
                    let at = |phase: usize| start + (phase * (end - start)).div_ceil(phases);
                    let part = (at(phase), at(phase + 1));
                    match cuts.len() {
                        1 => Bin::new(k, part, None),
                        _ => Bin::new(k, (from, to), Some(part)),
                    }
                })
                .collect();
            for (start, end) in cuts {
                for i in (start..end).filter(|&i| record.counts(i)) {
                    let phase = (i - start) * phases / (end - start).max(1);
                    own[phase.min(phases - 1)].add(white[i]);
                }
            }
            bins.append(&mut own);
        }
    }
    bins.retain(|b| b.count >= 3.0);
    let total: f64 = bins.iter().map(|b| b.count).sum();
    let within: f64 = bins
        .iter()
        .map(|b| b.square - b.sum * b.sum / b.count)
        .sum();
    let free = (total - bins.len() as f64).max(1.0);
    let variance = (within / free).max(QUIET);
    let own = correlations.iter().zip(noise).map(|(c, n)| c - n.beyond);
    let correlation = own.fold(0.0_f64, f64::max);
    if variance.is_nan() || variance <= 0.0 || bins.is_empty() {
        return Structure {
            share: 0.0,
            error: 0.0,
            significance: 0.0,
            correlation,
            ringing,
            places: Vec::new(),
        };
    }
    let between: f64 = bins.iter().map(|b| b.sum * b.sum / b.count).sum::<f64>() / variance;
    // What repeated cycles show in the noise is no structure.
    let expected: f64 = bins.iter().map(|b| noise[b.record].coloured()).sum();
    let excess = between - expected;
    let heard: f64 = bins
        .iter()
        .map(|b| {
            b.sum * b.sum
                / b.count
                / variance
                / alike_noise(correlations[b.record], &noise[b.record])
        })
        .map(|square| square.min(LOUDEST))
        .sum();
    let (mean, scatter) = quiet(&bins, variance);
    let stands_out = |b: &Bin| (b.sum * b.sum / b.count / variance - 1.0).max(0.0);
    // Bins that noise left quieter than its mean take nothing from those that stand out.
    let all = bins.iter().map(stands_out).sum::<f64>().max(1.0);
    let mut places: Vec<Place> = bins
        .iter()
        .map(|b| Place {
            record: b.record,
            from: b.from,
            to: b.to,
            part: b.part,
            share: stands_out(b) / all,
        })
        .collect();
    places.sort_by(|a, b| b.share.total_cmp(&a.share));
    places.truncate(5);
    Structure {
        share: (excess / total).max(0.0),
        error: scatter / total,
        significance: (heard - mean) / scatter,
        correlation,
        ringing,
        places,
    }
}

/// Mean and standard deviation of the sum of the bins' squares, in the pooled variance, where bins differ by
/// noise alone, which may be louder in some: `Σ v` and `√(2 Σ v² n/(n+1))`, without bias for the normal
/// distribution.
fn quiet(bins: &[Bin], pooled: f64) -> (f64, f64) {
    let own = |b: &Bin| (b.square - b.sum * b.sum / b.count) / (b.count - 1.0) / pooled;
    let mean = bins.iter().map(own).sum();
    let square = |b: &Bin| 2.0 * own(b).powi(2) * b.count / (b.count + 1.0);
    (mean, bins.iter().map(square).sum::<f64>().sqrt())
}

/// Samples over which neighbours are looked for.
const FARTHEST: usize = 8;

/// Standard errors of a correlation that chance may give the largest of them.
const CHANCE: f64 = 3.0;

/// Correlation of samples `lag` apart about the means of short stretches, so that slow structure does not pass
/// for it.
fn correlation(stretches: &[&[f64]], lag: usize) -> f64 {
    let (mut square, mut product) = (0.0, 0.0);
    for stretch in stretches {
        let mean = stretch.iter().sum::<f64>() / STRETCH as f64;
        square += stretch.iter().map(|w| (w - mean).powi(2)).sum::<f64>();
        let pairs = stretch.iter().zip(&stretch[lag..]);
        product += pairs.map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>();
    }
    match square > 0.0 {
        // A stretch's own mean takes a share of 1/STRETCH of every product.
        true => {
            let pairs = (STRETCH - lag) as f64 / (STRETCH - 1) as f64;
            product / square / pairs + 1.0 / STRETCH as f64
        }
        false => 0.0,
    }
}

/// Samples over whose mean neighbours are compared.
const STRETCH: usize = 32;

/// Variance of a mean of noise whose neighbours are still somewhat alike, over that of independent
/// samples; no more than twice, for what is more alike than that is no noise, unless repeated cycles show it in the noise.
fn alike_noise(correlation: f64, noise: &Noise) -> f64 {
    let left = correlation.clamp(0.0, 1.0 / 3.0);
    ((1.0 + left) / (1.0 - left)).max(noise.coloured())
}

#[derive(Debug, Clone)]
struct Bin {
    record: usize,
    from: usize,
    to: usize,
    part: Option<(usize, usize)>,
    count: f64,
    sum: f64,
    square: f64,
}

impl Bin {
    fn new(record: usize, (from, to): (usize, usize), part: Option<(usize, usize)>) -> Bin {
        Bin {
            record,
            from,
            to,
            part,
            count: 0.0,
            sum: 0.0,
            square: 0.0,
        }
    }
    fn add(&mut self, value: f64) {
        self.count += 1.0;
        self.sum += value;
        self.square += value * value;
    }
}

/// A load level or what lies between two, `from..to`.
struct Piece {
    from: usize,
    to: usize,
    /// Phases to fold it over.
    phases: usize,
    /// Its cycles; the piece itself where it holds none.
    cuts: Vec<(usize, usize)>,
}

/// Load levels, of four equal cycles at most, and what lies between them.
fn pieces(input: &[f64]) -> Vec<Piece> {
    let found = cycles(input);
    let between = |from: usize, to: usize, phases: usize| Piece {
        from,
        to,
        phases,
        cuts: vec![(from, to)],
    };
    let mut pieces = Vec::new();
    let mut at = 0;
    let mut i = 0;
    while i < found.len() {
        let mut j = i + 1;
        while j < found.len() && j - i < 4 && alike(&found[j - 1], &found[j]) {
            j += 1;
        }
        if found[i].start > at {
            pieces.push(between(at, found[i].start, PHASES));
        }
        let level = &found[i..j];
        pieces.push(Piece {
            from: found[i].start,
            to: found[j - 1].end,
            phases: PHASES,
            cuts: level.iter().map(|c| (c.start, c.end)).collect(),
        });
        at = found[j - 1].end;
        i = j;
    }
    if at < input.len() {
        let phases = if found.is_empty() { 100 } else { PHASES };
        pieces.push(between(at, input.len(), phases));
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::Form;
    use crate::record::Record;
    use crate::record::colour::Colour;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// White noise of unit variance that so many repeated samples told.
    fn known(samples: usize) -> Noise {
        Noise {
            deviation: 1.0,
            colour: Colour::WHITE,
            beyond: 0.0,
            samples,
            repeated: true,
        }
    }

    /// A model that predicts nothing of so many samples.
    fn nothing(samples: usize) -> Prediction {
        Prediction {
            judged: vec![0.0; samples],
            ..Prediction::default()
        }
    }

    #[test]
    fn noise_leaves_a_share_beyond_its_standard_error_once_in_six_times() {
        let time: Vec<f64> = (0..1200).map(|i| 0.01 * f64::from(i)).collect();
        let mut random = ChaCha8Rng::seed_from_u64(20261122);
        let mut record = Record {
            force: time
                .iter()
                .map(|t| t * (std::f64::consts::TAU * t).sin())
                .collect(),
            displacement: vec![0.0; time.len()],
            time: Some(time),
            ..Record::default()
        };
        let white = known(1_000_000);
        let nothing = nothing(record.displacement.len());
        let mut beyond = 0;
        for _ in 0..300 {
            for value in &mut record.displacement {
                // Of twelve even variables the sum has a variance of one.
                *value = (0..12).map(|_| random.random::<f64>() - 0.5).sum();
            }
            let problem = Problem::new(Form::Play, std::slice::from_ref(&record));
            let seen = structure(
                &problem,
                std::slice::from_ref(&nothing),
                std::slice::from_ref(&white),
            );
            beyond += usize::from(seen.share > seen.error);
        }
        // One in 6.3 is 48; three standard deviations of that are 19.
        assert!((29..=67).contains(&beyond), "{beyond}");
    }

    /// What is left of a record of which `alike` of each sample goes on in the next, and a ringing this loud.
    fn left(alike: f64, loud: f64, random: &mut ChaCha8Rng) -> (Record, Noise) {
        let mut last = 0.0;
        let left: Vec<f64> = (0..1200)
            .map(|i| {
                let normal: f64 = (0..12).map(|_| random.random::<f64>() - 0.5).sum();
                last = alike * last + (1.0 - alike * alike).sqrt() * normal;
                last + loud * (0.55 * f64::from(i)).sin()
            })
            .collect();
        let time: Vec<f64> = (0..1200).map(|i| 0.01 * f64::from(i)).collect();
        let noise = crate::record::noise::from_residual(&left);
        let record = Record {
            force: time.iter().map(|t| t * (5.0 * t).sin()).collect(),
            displacement: left,
            time: Some(time),
            ..Record::default()
        };
        (record, noise)
    }

    #[test]
    fn what_rings_is_no_noise_and_noise_does_not_ring() {
        let mut random = ChaCha8Rng::seed_from_u64(20261123);
        let nothing = nothing(1200);
        let mut seen = |alike: f64, loud: f64| {
            let (record, noise) = left(alike, loud, &mut random);
            let problem = Problem::new(Form::Play, &[record]);
            let found = structure(&problem, std::slice::from_ref(&nothing), &[noise]);
            found.ringing > RANDOM
        };
        for alike in [0.0, 0.5, 0.9] {
            let alarms = (0..200).filter(|_| seen(alike, 0.0)).count();
            // Of 1400 correlations none comes by chance to what is 6.5 standard errors.
            assert_eq!(alarms, 0, "{alike}");
            assert!(seen(alike, 2.0), "{alike}");
        }
    }

    /// First-order noise of 0.8 that few repeated samples told as 0.65, two standard errors off.
    #[test]
    fn noise_slower_than_it_was_told_leaves_no_share_that_counts() {
        let mut random = ChaCha8Rng::seed_from_u64(20261129);
        let nothing = nothing(1200);
        let mut counts = |samples: usize| {
            let (record, noise) = left(0.8, 0.0, &mut random);
            let told = Noise {
                colour: Colour::first_order(0.65),
                samples,
                repeated: true,
                ..noise
            };
            let problem = Problem::new(Form::Play, &[record]);
            let seen = structure(&problem, std::slice::from_ref(&nothing), &[told]);
            usize::from(seen.share > seen.error)
        };
        let few: usize = (0..100).map(|_| counts(200)).sum();
        let many: usize = (0..100).map(|_| counts(200_000)).sum();
        // One in six of noise that is as slow as that.
        assert!(few < 30 && many > 90, "{few} {many}");
    }

    /// Two records of six equal cycles, and white noise of a deviation in each, with an event of so many of them in one cycle.
    fn two_records(
        (quiet, loud): (f64, f64),
        (record, cycle, event): (usize, usize, f64),
    ) -> Structure {
        let mut random = ChaCha8Rng::seed_from_u64(20261127);
        let mut normal = || (0..12).map(|_| random.random::<f64>() - 0.5).sum::<f64>();
        let of =
            |deviation: f64, event_in: Option<usize>, normal: &mut dyn FnMut() -> f64| Record {
                force: (0..1210)
                    .map(|i| (std::f64::consts::TAU * f64::from(i - 5) / 200.0).sin())
                    .collect(),
                displacement: (0..1210)
                    .map(|i| {
                        let inside = event_in
                            .is_some_and(|cycle| (5 + 200 * cycle..105 + 200 * cycle).contains(&i));
                        deviation * (normal() + if inside { event } else { 0.0 })
                    })
                    .collect(),
                time: Some((0..1210).map(|i| 0.01 * f64::from(i)).collect()),
                ..Record::default()
            };
        let deviations = [quiet, loud];
        let records: Vec<Record> = (0..2)
            .map(|k| of(deviations[k], (k == record).then_some(cycle), &mut normal))
            .collect();
        let nothing = nothing(1210);
        let noise = deviations.map(|deviation| Noise {
            deviation,
            ..known(1200)
        });
        structure(
            &Problem::new(Form::Play, &records),
            &[nothing.clone(), nothing],
            &noise,
        )
    }

    #[test]
    fn what_happens_in_the_last_of_equal_cycles_is_seen_as_in_the_first() {
        assert!(!two_records((1.0, 1.0), (0, 0, 0.0)).is_seen());
        for cycle in 0..5 {
            assert!(
                two_records((1.0, 1.0), (0, cycle, 2.0)).is_seen(),
                "{cycle}"
            );
        }
    }

    #[test]
    fn structure_of_a_quiet_record_is_seen_beside_a_loud_one() {
        for record in 0..2 {
            let seen = two_records((1.0, 50.0), (record, 2, 2.0));
            assert!(seen.is_seen(), "{record}: {seen:?}");
            assert!(seen.places[0].record == record, "{seen:?}");
        }
    }

    /// What no fit answers for is smooth and large: neighbours of the noise are no more alike for it.
    #[test]
    fn samples_that_do_not_count_are_no_witnesses_of_noise() {
        let mut random = ChaCha8Rng::seed_from_u64(20261128);
        let (mut record, noise) = left(0.0, 0.0, &mut random);
        for (i, value) in record.displacement.iter_mut().enumerate().take(300) {
            *value += 100.0 * (0.01 * i as f64).cos();
        }
        let mut problem = Problem::new(Form::Play, &[record]);
        problem.records[0].weight[..300].fill(0.0);
        let nothing = nothing(1200);
        let seen = structure(&problem, &[nothing], &[noise]);
        assert!(seen.correlation < RANDOM, "{seen:?}");
    }

    /// A tone of a quarter of the sampling rate, to which neighbours say nothing, beside noise that repeated cycles told.
    #[test]
    fn a_tone_beside_known_noise_is_seen() {
        let mut random = ChaCha8Rng::seed_from_u64(20261124);
        let nothing = nothing(1200);
        let mut ringing = |loud: f64| {
            let (mut record, _) = left(0.0, 0.0, &mut random);
            for (i, value) in record.displacement.iter_mut().enumerate() {
                *value += loud * (std::f64::consts::FRAC_PI_2 * i as f64).sin();
            }
            let problem = Problem::new(Form::Play, &[record]);
            structure(&problem, std::slice::from_ref(&nothing), &[known(1200)])
        };
        assert!(!ringing(0.0).is_seen());
        let toned = ringing(3.0);
        assert!(toned.correlation < RANDOM && toned.is_seen(), "{toned:?}");
    }
}
