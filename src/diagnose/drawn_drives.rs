//! Noise of drives that their joint did not feel, and records drawn with such noise and nothing else.

use super::drive::{drive_noise, residuals, without_drive_noise};
use super::prepare::{Bench, prepare};
use super::smooth_drive::felt;
use crate::identify::beginning::Beginning;
use crate::identify::{Fit, Form};
use crate::record::Record;
use crate::record::calm::fastest;
use crate::record::colour::Colour;
use crate::record::cycles::rms;
use crate::record::resolution::{of_step, step_of_drive};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What the noise of a drive adds, in variances of the judged channel's, from which it may pass for something else.
const MAY: f64 = 1.0;

/// Correlation of neighbours in what a model leaves from which that may be of the drive's noise as well.
const SLOW: f64 = 0.3;

/// Draws of each kind of noise. Calming takes the noise of some and not of others: where it does of half of them, it does of
/// all by one in sixty.
pub(super) const DRAWN: u64 = 6;

/// Share of what a model leaves, in variance, that is noise of the judged channel itself, at least.
const OWN: f64 = 0.1;

/// Records whose drives are noisy.
pub(super) struct Drives<'a> {
    records: &'a [Record],
    pub(super) bench: &'a Bench,
    /// Noise of each drive, and what it may add to the misfit.
    noise: Vec<[f64; 2]>,
}

/// One draw: whether the noise is slow, of the drive or else of the judged channel, and its seed.
pub(super) type Draw = (bool, u64);

impl Drives<'_> {
    /// Records as they were read, and as they are fitted; `None` where no drive has noise that the joint did not feel.
    pub(super) fn of<'a>(records: &'a [Record], bench: &'a Bench) -> Option<Drives<'a>> {
        let noise = unfelt_noise(bench.train.operators.form, records);
        (!is_quiet(&noise)).then_some(Drives {
            records,
            bench,
            noise,
        })
    }

    /// What the noise of all drives may add to the misfit.
    pub(super) fn adds(&self) -> f64 {
        self.noise.iter().map(|[_, adds]| adds).sum()
    }

    /// True where what is left is slow, so that slow noise may be either channel's.
    pub(super) fn may_be_slow(&self) -> bool {
        self.bench
            .noise
            .iter()
            .any(|n| n.colour.neighbours() > SLOW)
    }

    /// The records as a model has them, with noise in the drive of which the joint felt nothing, read as these were: drives
    /// calmed, noise told anew, the same samples set aside.
    pub(super) fn read_anew(&self, model: &Fit, draw: Draw) -> Bench {
        let form = self.bench.train.operators.form;
        let drawn = self.drawn(model, draw);
        let begun = self.bench.train.records.iter();
        let beginnings: Vec<Beginning> = begun.map(|r| r.beginning.clone()).collect();
        let mut read = prepare(form, &without_drive_noise(form, &drawn), &beginnings);
        read.fit_also(self.bench.fitted);
        read
    }

    fn drawn(&self, model: &Fit, (slow, seed): Draw) -> Vec<Record> {
        let mut random = ChaCha8Rng::seed_from_u64(20_010_811 + seed);
        let whole = &self.bench.whole;
        let (predicted, left) = (model.predict(whole), model.residuals(whole));
        let one = |(k, record): (usize, &Record)| {
            let alike = self.bench.noise[k].colour;
            let (of_drive, of_judged) = match slow {
                true => (alike, Colour::WHITE),
                false => (Colour::WHITE, alike),
            };
            let left = rms(&left[k]);
            let prepared = &whole.records[k];
            let (drive, judged) = (whole.channels(k).0, &predicted[k].judged);
            let true_drive: Vec<f64> = drive.iter().map(|x| x + prepared.beginning.zero).collect();
            let (read, answered) =
                self.with_noise((k, record), &true_drive, (of_drive, left), &mut random);
            let own = (left * left - answered * answered).max(OWN * left * left);
            let noise = coloured(&mut random, judged.len(), of_judged, own.sqrt());
            let judged = judged.iter().zip(noise).map(|(y, f)| y + f).collect();
            let mut drawn = record.clone();
            let (of_drive, of_judged) = whole.operators.form.channels_mut(&mut drawn);
            (*of_drive, *of_judged) = (read, judged);
            drawn
        };
        self.records.iter().enumerate().map(one).collect()
    }

    /// A drive as its channel reads it, in its steps where it has such, and what a model answers to the noise beside those, at
    /// most what it leaves.
    fn with_noise(
        &self,
        (k, record): (usize, &Record),
        drive: &[f64],
        (alike, left): (Colour, f64),
        random: &mut ChaCha8Rng,
    ) -> (Vec<f64>, f64) {
        let [loud, adds] = self.noise[k];
        let (own, judged) = self.bench.train.operators.form.channels(record);
        let step = step_of_drive(own, judged);
        let steepest = (adds / drive.len() as f64).sqrt() * fastest(judged) / loud;
        let noise = coloured(random, drive.len(), alike, 1.0);
        // What steps are off by is in what the channel shows.
        let beside = loud.powi(2) - step.map_or(0.0, of_step).powi(2);
        let loud = (beside.max(0.0).sqrt() / fastest(&noise)).min(left / steepest);
        let read = drive.iter().zip(&noise).map(|(x, e)| x + loud * e);
        let read = match step {
            Some(step) => read.map(|x| (x / step).round() * step).collect(),
            None => read.collect(),
        };
        (read, steepest * loud)
    }
}

/// Noise of each drive, and what it may add to the misfit; none that the joint felt, which is told of the drives as they were
/// read: of calmed ones a model makes nothing of their noise.
fn unfelt_noise(form: Form, records: &[Record]) -> Vec<[f64; 2]> {
    let mut noise: Vec<[f64; 2]> = records.iter().map(|r| drive_noise(form, r)).collect();
    if is_quiet(&noise) {
        return noise;
    }
    let residuals = residuals(form, records);
    for ((noise, record), residual) in noise.iter_mut().zip(records).zip(&residuals) {
        let (drive, judged) = form.channels(record);
        if felt(drive, judged, residual) {
            *noise = [0.0; 2];
        }
    }
    noise
}

fn is_quiet(noise: &[[f64; 2]]) -> bool {
    noise.iter().all(|[_, adds]| *adds < MAY)
}

/// Noise of a deviation whose neighbours go together.
fn coloured(random: &mut ChaCha8Rng, count: usize, alike: Colour, deviation: f64) -> Vec<f64> {
    // Twelve uniform numbers have the variance one, and a sum that is nearly normal.
    let mut white = || (0..12).map(|_| random.random::<f64>()).sum::<f64>() - 6.0;
    let Colour { slow, share } = alike;
    let mut last = 0.0;
    let mut next = || {
        last = slow * last + (1.0 - slow * slow).sqrt() * white();
        let beside = match share < 1.0 {
            true => (1.0 - share).sqrt() * white(),
            false => 0.0,
        };
        deviation * (share.sqrt() * last + beside)
    };
    (0..count).map(|_| next()).collect()
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::diagnose::gridded::tests::slid;
    use crate::identify::baseline;
    use crate::record::noise::tests::drawn;

    /// Cycles of 79 samples that fall, slow noise in the displacement that drives and noise as loud in the force, which a
    /// cell reads so many samples late.
    pub(in crate::diagnose) fn falling(seed: u64, late: usize) -> Record {
        let mut random = drawn(seed);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let limits: Vec<f64> = (1..=40).map(|j| 0.03 * f64::from(j)).collect();
        let swings = |i: usize| {
            let t = i as f64;
            (0.3 + 0.7 * (-t / 900.0).exp()) * (std::f64::consts::TAU * t / 79.0).sin()
        };
        let displacement: Vec<f64> = (0..2000).map(swings).collect();
        let force = slid(&limits, &displacement);
        let largest = force.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
        let mut slow = 0.0;
        let mut read = |x: &f64| {
            slow = 0.66 * slow + 0.75 * white();
            x + 0.015 * slow
        };
        let displacement = displacement.iter().map(&mut read).collect();
        let at = |i: usize| force[i.saturating_sub(late)];
        Record {
            name: "falling".to_string(),
            force: (0..2000)
                .map(|i| at(i) + 0.009 * largest * white())
                .collect(),
            displacement,
            time: Some((0..2000).map(|i| 4e-4 * i as f64).collect()),
            ..Record::default()
        }
    }

    /// Noise of a channel is not felt, be a drive that is calmed without it.
    #[test]
    fn noise_that_was_read_alone_is_not_felt() {
        for seed in 1..=4 {
            let record = [falling(seed, 0)];
            let [_, adds] = unfelt_noise(Form::Stop, &record)[0];
            assert!(adds > MAY, "{seed}: {adds}");
            let calm = without_drive_noise(Form::Stop, &record);
            assert_ne!(calm[0].displacement, record[0].displacement);
        }
        // A joint that moves as its displacement is read feels all of it.
        let read = falling(1, 0);
        let felt = Record {
            force: slid(&[0.5, 1.0], &read.displacement),
            ..read
        };
        assert_eq!(unfelt_noise(Form::Stop, &[felt]), [[0.0; 2]]);
    }

    /// A load cell whose steps are as large as its noise: draws show both.
    #[test]
    fn noise_of_a_drive_that_is_read_in_steps_is_drawn() {
        let mut random = drawn(20_261_130);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let force: Vec<f64> = (0..3000)
            .map(|i| 100.0 * (0.04 * f64::from(i)).sin())
            .collect();
        let record = Record {
            name: "stepped".to_string(),
            displacement: force.iter().map(|f| 1e-8 * (f + 1.5 * white())).collect(),
            force: force.iter().map(|f| (f + white()).round()).collect(),
            time: Some((0..3000).map(|i| 1e-3 * f64::from(i)).collect()),
            ..Record::default()
        };
        let records = [record];
        let calm = without_drive_noise(Form::Play, &records);
        let bench = prepare(Form::Play, &calm, &[Beginning::default()]);
        let drives = Drives::of(&records, &bench).unwrap();
        let drawn = drives.drawn(&baseline(&bench.train), (false, 0));
        let force = &drawn[0].force;
        assert!(force.iter().all(|f| f.round() == *f));
        let [own, again] = [&records[0].force, force].map(|f| fastest(f));
        assert!((again / own - 1.0).abs() < 0.2, "{again} {own}");
    }
}
