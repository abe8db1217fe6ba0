//! A prepared record with fewer samples: a densely sampled cycle says no more than a well sampled one.

use super::operators::Form;
use super::prepared::Prepared;

impl Prepared {
    /// Every sample before `whole`, then each `every`-th and every turning point up to `length`.
    pub fn thin(&mut self, form: Form, (whole, every, length): (usize, usize, usize)) {
        let (input, _) = self.channels(form);
        let turns = |i: usize| {
            i > 0
                && i + 1 < length
                && (input[i] - input[i - 1]) * (input[i + 1] - input[i]) < 0.0
                && every > 1
        };
        let stays = |&i: &usize| {
            i < whole || i.is_multiple_of(every) || turns(i) && turns_far(input, i, every)
        };
        let weighs = |i: usize| (i, if i < whole { 1 } else { every });
        let kept: Vec<(usize, usize)> = (0..length).filter(stays).map(weighs).collect();
        self.keep(&kept);
    }

    /// Leaves the given samples, each standing for as many: where one stands for more than itself, noise of
    /// correlation `a` counts as white with variance `σ² (1+a)/((1−a) m)`.
    pub fn keep(&mut self, kept: &[(usize, usize)]) {
        let indices: Vec<usize> = kept.iter().map(|(i, _)| *i).collect();
        let pick = |channel: &[f64]| indices.iter().map(|&i| channel[i]).collect::<Vec<f64>>();
        self.between.thin(&indices, &self.time);
        let a = self.autoregression;
        self.time = pick(&self.time);
        self.force = pick(&self.force);
        self.displacement = pick(&self.displacement);
        self.steps = std::iter::once(0.0)
            .chain(self.time.windows(2).map(|pair| pair[1] - pair[0]))
            .collect();
        self.weight = pick(&self.weight);
        if kept.iter().any(|(_, every)| *every > 1) {
            // weight = 1/innovation, innovation² = σ² (1 − a²)
            for (weight, (_, every)) in self.weight.iter_mut().zip(kept) {
                *weight *= ((1.0 - a) * (1.0 - a) * *every as f64).sqrt();
            }
            self.autoregression = 0.0;
        }
    }
}

/// True where a sample is the extreme of its neighbourhood and no wiggle of the noise.
fn turns_far(input: &[f64], i: usize, reach: usize) -> bool {
    let (from, to) = (i.saturating_sub(reach), (i + reach).min(input.len() - 1));
    let around = &input[from..=to];
    around.iter().all(|x| *x <= input[i]) || around.iter().all(|x| *x >= input[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::Record;

    /// Ten cycles of a hundred samples, with turns at 25 and 75 of each.
    fn prepared() -> Prepared {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / 100.0;
        let force: Vec<f64> = (0..1000).map(|i| angle(i).sin()).collect();
        let record = Record {
            displacement: vec![0.0; force.len()],
            time: Some((0..1000).map(|i| 0.01 * i as f64).collect()),
            force,
            ..Record::default()
        };
        Prepared::new(&record, Form::Play)
    }

    #[test]
    fn a_thinned_record_keeps_its_beginning_its_turns_and_its_weight() {
        let mut few = prepared();
        few.autoregression = 0.5;
        few.thin(Form::Play, (100, 7, 1000));
        let tenth = |i: f64| (100.0 * i).round() as usize;
        let kept: Vec<usize> = few.time.iter().map(|t| tenth(*t)).collect();
        assert!((0..100).all(|i| kept[i] == i));
        let turns = (1..10).flat_map(|cycle| [100 * cycle + 25, 100 * cycle + 75]);
        assert!(
            turns.into_iter().all(|turn| kept.contains(&turn)),
            "{kept:?}"
        );
        assert!(kept.len() < 100 + 900 / 7 + 40, "{}", kept.len());
        let passed: f64 = few.steps.iter().sum();
        assert!((passed - (few.time[kept.len() - 1] - few.time[0])).abs() < 1e-12);
        // Noise of this correlation weighs a quarter as white noise, and as often as the sample stands for others.
        let squares = |from: usize| few.weight[from].powi(2);
        assert!((squares(0) - 0.25).abs() < 1e-12 && (squares(100) - 0.25 * 7.0).abs() < 1e-12);
        assert_eq!(few.autoregression, 0.0);
    }
}
