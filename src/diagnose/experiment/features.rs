//! Named features of a record from which a correction may be learned.

use crate::diagnose::prepare::Bench;
use crate::identify::{Form, Prediction};
use crate::record::cycles::cycles;

/// One feature: its name, and one value per sample and record, over its own largest magnitude.
pub struct Feature {
    /// What it is, in words.
    pub name: String,
    /// Values per record.
    pub values: Vec<Vec<f64>>,
}

/// Widths of the plays of the response, over its largest magnitude.
const PLAYS: [f64; 3] = [0.05, 0.15, 0.4];

/// Memories of what fades, in cycles.
const MEMORIES: [f64; 3] = [0.1, 1.0, 5.0];

/// All features of the records, as a model answers them, the measuring chain aside.
///
/// Sizes are those of all records together, so that a coefficient means the same in each.
pub fn features(bench: &Bench, predictions: &[Prediction]) -> Vec<Feature> {
    let problem = &bench.whole;
    let force_driven = problem.operators.form == Form::Play;
    let names = match force_driven {
        true => ("force", "displacement"),
        false => ("displacement", "force"),
    };
    let mut all: Vec<Feature> = Vec::new();
    let largest = |of: &dyn Fn(usize) -> Vec<f64>| {
        let each = (0..predictions.len()).flat_map(of);
        each.fold(0.0_f64, |a, b| a.max(b.abs()))
    };
    // As the joint answers: where a sensor's zero stands has no part in a square or a cube.
    let answered = |k: usize| match force_driven {
        true => &predictions[k].truth.displacement,
        false => &predictions[k].truth.force,
    };
    let scale_in = largest(&|k| problem.channels(k).0.to_vec());
    let scale_out = largest(&|k| answered(k).clone());
    for k in 0..predictions.len() {
        let history = History {
            x: over(problem.channels(k).0, scale_in),
            y: over(answered(k), scale_out),
            steps: &problem.records[k].steps,
        };
        for (place, (name, values)) in history.features(names).into_iter().enumerate() {
            match all.get_mut(place) {
                Some(feature) => feature.values.push(values),
                None => all.push(Feature {
                    name,
                    values: vec![values],
                }),
            }
        }
    }
    for feature in &mut all {
        let largest = feature.values.iter().flatten();
        let largest = largest.fold(0.0_f64, |a, b| a.max(b.abs()));
        for values in &mut feature.values {
            *values = over(values, largest);
        }
    }
    all
}

/// One record's prescribed channel and the joint's answer, over their largest magnitudes.
struct History<'a> {
    x: Vec<f64>,
    y: Vec<f64>,
    steps: &'a [f64],
}

impl History<'_> {
    fn features(&self, names: (&str, &str)) -> Vec<(String, Vec<f64>)> {
        let (x, y) = (&self.x, &self.y);
        let mut own: Vec<(String, Vec<f64>)> = Vec::new();
        let mut put = |name: String, values: Vec<f64>| own.push((name, values));
        let each = |a: &[f64], of: fn(f64) -> f64| a.iter().map(|a| of(*a)).collect::<Vec<f64>>();
        let by = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).collect::<Vec<f64>>();
        for (name, channel) in [(names.0, x), (names.1, y)] {
            put(name.to_owned(), channel.clone());
            put(format!("square of the {name}"), each(channel, |v| v * v));
            put(format!("cube of the {name}"), each(channel, |v| v * v * v));
            put(format!("magnitude of the {name}"), each(channel, f64::abs));
            let rate = self.rate(channel);
            put(
                format!("acceleration of the {name}"),
                self.smooth(&self.rate(&rate)),
            );
            put(format!("rate of the {name}"), rate);
        }
        for width in PLAYS {
            put(
                format!("play of the {} by {:.0} %", names.1, 100.0 * width),
                play(y, width),
            );
        }
        let direction = each(&self.rate(x), f64::signum);
        put(format!("direction of the {}", names.0), direction.clone());
        put(
            format!("direction times magnitude of the {}", names.0),
            by(&direction, &each(x, f64::abs)),
        );
        let age = self.age();
        let most = age.last().copied().unwrap_or(1.0).max(1.0);
        let late = over(&age, most);
        put("cycle number".to_owned(), late.clone());
        put(format!("cycle number times the {}", names.0), by(&late, x));
        let first = each(&late, |n| 1.0 - (-5.0 * n).exp());
        put(format!("first cycles times the {}", names.0), by(&first, x));
        put(
            "first cycles times the direction".to_owned(),
            by(&first, &direction),
        );
        let so_far = running_largest(x);
        put(format!("largest {} so far", names.0), so_far.clone());
        put(
            format!("largest {} so far times the {}", names.0, names.1),
            by(&so_far, y),
        );
        // What the joint slips: the response less its elastic part.
        let slip = slip(x, y);
        put("slip".to_owned(), slip.clone());
        let speed: Vec<f64> = slip.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
        let power: Vec<f64> = speed
            .iter()
            .zip(&x[1..])
            .map(|(v, x)| v * x.abs())
            .collect();
        let work = summed(&power);
        let worn = over(&work, work.last().copied().unwrap_or(0.0));
        put("work so far times the slip".to_owned(), by(&worn, &slip));
        put(format!("work so far times the {}", names.0), by(&worn, x));
        for memory in MEMORIES {
            let heat = self.faded(&power, &age, memory);
            put(
                format!("work of the last {memory} cycles times the slip"),
                by(&heat, &slip),
            );
            put(
                format!("work of the last {memory} cycles times the {}", names.0),
                by(&heat, x),
            );
            let rested = self.faded(&speed, &age, memory);
            put(
                format!("slip of the last {memory} cycles times the direction"),
                by(&rested, &direction),
            );
        }
        own
    }

    /// Backward differences per step.
    fn rate(&self, values: &[f64]) -> Vec<f64> {
        (0..values.len())
            .map(|i| match i > 0 && self.steps[i] > 0.0 {
                true => (values[i] - values[i - 1]) / self.steps[i],
                false => 0.0,
            })
            .collect()
    }

    /// Means over five samples: second differences of a noisy channel are noise.
    fn smooth(&self, values: &[f64]) -> Vec<f64> {
        let last = values.len().saturating_sub(1);
        (0..values.len())
            .map(|i| {
                let around = &values[i.saturating_sub(2)..=(i + 2).min(last)];
                around.iter().sum::<f64>() / around.len() as f64
            })
            .collect()
    }

    /// Cycles passed, growing within each.
    fn age(&self) -> Vec<f64> {
        let mut age = vec![0.0; self.x.len()];
        let found = cycles(&self.x);
        for (n, cycle) in found.iter().enumerate() {
            let length = cycle.len().max(1) as f64;
            for (i, age) in age[cycle.start..cycle.end].iter_mut().enumerate() {
                *age = n as f64 + i as f64 / length;
            }
        }
        if let Some(end) = found.last().map(|c| c.end) {
            age[end..].fill(found.len() as f64);
        }
        age
    }

    /// What was added per sample, forgotten over so many cycles.
    fn faded(&self, added: &[f64], age: &[f64], memory: f64) -> Vec<f64> {
        let mut kept = 0.0;
        let mut all = vec![0.0];
        for (i, add) in added.iter().enumerate() {
            kept = kept * (-(age[i + 1] - age[i]).max(0.0) / memory).exp() + add;
            all.push(kept);
        }
        all
    }
}

/// Over a magnitude; zero where that is zero.
fn over(values: &[f64], largest: f64) -> Vec<f64> {
    let scale = if largest > 0.0 { largest.recip() } else { 0.0 };
    values.iter().map(|v| v * scale).collect()
}

/// Running sum, from zero.
fn summed(added: &[f64]) -> Vec<f64> {
    let mut sum = 0.0;
    let each = added.iter().map(|add| {
        sum += add;
        sum
    });
    std::iter::once(0.0).chain(each).collect()
}

/// What follows a channel with a play of half-width `width`.
fn play(channel: &[f64], width: f64) -> Vec<f64> {
    let mut at = 0.0_f64;
    channel
        .iter()
        .map(|v| {
            at = at.max(v - width).min(v + width);
            at
        })
        .collect()
}

/// Largest magnitude up to each sample.
fn running_largest(channel: &[f64]) -> Vec<f64> {
    let mut largest = 0.0_f64;
    channel
        .iter()
        .map(|v| {
            largest = largest.max(v.abs());
            largest
        })
        .collect()
}

/// Response less the part that is linear in the prescribed channel.
fn slip(x: &[f64], y: &[f64]) -> Vec<f64> {
    let product: f64 = x.iter().zip(y).map(|(x, y)| x * y).sum();
    let square: f64 = x.iter().map(|x| x * x).sum();
    let slope = if square > 0.0 { product / square } else { 0.0 };
    x.iter().zip(y).map(|(x, y)| y - slope * x).collect()
}
