//! A record prepared for identification: one judged channel, weights, whitening.

use super::beginning::Beginning;
use super::operators::Form;
use super::tips;
use crate::record::Record;
use crate::record::colour::Colour;
use crate::record::peaks::Between;

/// One record as the fit sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Prepared {
    /// The record's name.
    pub name: String,
    /// Time \[s\], or sample numbers.
    pub time: Vec<f64>,
    /// Length of the step that ends at each sample; zero at the first.
    pub steps: Vec<f64>,
    /// Measured force \[N\].
    pub force: Vec<f64>,
    /// Measured displacement \[m\].
    pub displacement: Vec<f64>,
    /// One over the noise's innovation at each sample; zero keeps a sample out of the fit.
    pub weight: Vec<f64>,
    /// How alike neighbouring noise samples are, which is removed from rows before they are summed.
    pub colour: Colour,
    /// What the input did between samples; no samples of their own, but the joint was there.
    pub between: Between,
    /// What the joint went through before the first sample.
    pub beginning: Beginning,
}

impl Prepared {
    /// Every sample with unit weight, white; those that stood alone with none.
    pub fn new(record: &Record, form: Form) -> Prepared {
        let time = record.clock();
        let mut steps = vec![0.0; time.len()];
        for i in 1..time.len() {
            steps[i] = time[i] - time[i - 1];
        }
        let mut prepared = Prepared {
            name: record.name.clone(),
            between: Between {
                straight: record.straight,
                drawn: record.drawn,
                ..Between::default()
            },
            steps,
            force: record.force.clone(),
            displacement: record.displacement.clone(),
            weight: vec![1.0; time.len()],
            colour: Colour::WHITE,
            beginning: Beginning::default(),
            time,
        };
        for &alone in &record.alone {
            prepared.weight[alone] = 0.0;
        }
        prepared.look_between(form);
        prepared
    }

    /// Finds the input's peaks between samples and its kinks (anew, where its samples were changed).
    pub fn look_between(&mut self, form: Form) {
        self.between = tips::between(&self.between, &self.time, self.channels(form).0);
    }

    /// The record with another beginning than a virgin joint's; its input counts from the zero of that.
    pub fn begin(&mut self, form: Form, beginning: &Beginning) {
        self.beginning.clone_from(beginning);
        if beginning.zero != 0.0 {
            let input = match form {
                Form::Play => &mut self.force,
                Form::Stop => &mut self.displacement,
            };
            input.iter_mut().for_each(|x| *x -= beginning.zero);
            self.look_between(form);
        }
    }

    /// Time from the first sample to the last \[s\].
    pub fn length(&self) -> f64 {
        self.time.last().unwrap_or(&0.0) - self.time.first().unwrap_or(&0.0)
    }

    /// True where the sample is a witness: one that was struck out stands for its neighbours.
    pub fn counts(&self, sample: usize) -> bool {
        self.weight[sample] > 0.0
    }

    /// Count of samples that count.
    pub fn rows(&self) -> usize {
        self.weight.iter().filter(|w| **w > 0.0).count()
    }

    /// Measured input and measured judged channel of a form.
    pub fn channels(&self, form: Form) -> (&[f64], &[f64]) {
        match form {
            Form::Play => (&self.force, &self.displacement),
            Form::Stop => (&self.displacement, &self.force),
        }
    }
}
