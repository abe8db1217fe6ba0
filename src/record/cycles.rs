//! Cycles of a channel: cut at upward crossings of the running mean, marked steady where they
//! repeat their neighbour.

/// One cycle of a channel, samples `start..end`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// First sample.
    pub start: usize,
    /// One past the last sample (the first of the next cycle).
    pub end: usize,
    /// Half the peak-to-peak value.
    pub amplitude: f64,
    /// Mid value.
    pub mean: f64,
    /// True where the next or the previous cycle has the same amplitude, mean and length.
    pub steady: bool,
}

impl Cycle {
    /// Count of samples.
    pub fn len(&self) -> usize {
        self.end - self.start
    }
    /// True where it holds no sample (never from [`cycles`]).
    pub fn is_empty(&self) -> bool {
        self.end <= self.start
    }
}

/// Relative difference up to which two cycles count as the same load level.
const SAME_LEVEL: f64 = 0.03;

/// Cuts a channel into cycles at upward crossings of its mid value, with a dead band of 5 % of the
/// range of the surrounding samples so that noise does not cut.
pub fn cycles(channel: &[f64]) -> Vec<Cycle> {
    let turns = turning_points(channel, 0.02);
    if turns.len() < 3 {
        return Vec::new();
    }
    let mut starts = Vec::new();
    // A rising half is cut at the mid value of the falling half behind it: a half that changes the
    // level, or the first one from rest, has another mid value than the cycles it belongs to.
    for (k, pair) in turns.windows(2).enumerate() {
        let (from, to) = (pair[0], pair[1]);
        if channel[to] > channel[from] {
            let mid = match (turns.get(k + 2), k.checked_sub(1)) {
                (Some(&behind), _) => 0.5 * (channel[to] + channel[behind]),
                (None, Some(before)) => 0.5 * (channel[turns[before]] + channel[from]),
                (None, None) => 0.5 * (channel[from] + channel[to]),
            }
            .max(channel[from]);
            if let Some(at) = (from..to).find(|&i| channel[i] <= mid && channel[i + 1] > mid) {
                starts.push(at + 1);
            }
        }
    }
    let mut found: Vec<Cycle> = starts
        .windows(2)
        .map(|pair| {
            let part = &channel[pair[0]..pair[1]];
            let high = part.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let low = part.iter().copied().fold(f64::INFINITY, f64::min);
            Cycle {
                start: pair[0],
                end: pair[1],
                amplitude: 0.5 * (high - low),
                mean: 0.5 * (high + low),
                steady: false,
            }
        })
        .collect();
    for i in 1..found.len() {
        if alike(&found[i - 1], &found[i]) {
            found[i - 1].steady = true;
            found[i].steady = true;
        }
    }
    found
}

/// Same amplitude, mean and length, within [`SAME_LEVEL`] and two samples.
pub fn alike(a: &Cycle, b: &Cycle) -> bool {
    let level = a.amplitude.max(b.amplitude);
    (a.amplitude - b.amplitude).abs() <= SAME_LEVEL * level
        && (a.mean - b.mean).abs() <= SAME_LEVEL * level
        && as_long(a, b)
}

/// Same length, within [`SAME_LEVEL`] and two samples.
pub fn as_long(a: &Cycle, b: &Cycle) -> bool {
    let length = a.len().max(b.len()) as f64;
    (a.len() as f64 - b.len() as f64).abs() <= (SAME_LEVEL * length).max(2.0)
}

/// Highest less lowest value of a channel, in its unit.
pub fn span(channel: &[f64]) -> f64 {
    let high = channel.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = channel.iter().copied().fold(f64::INFINITY, f64::min);
    high - low
}

/// Indices of turning points, ignoring wiggles below `band` of the channel's largest range; the
/// first and last samples count as turning points.
pub fn turning_points(channel: &[f64], band: f64) -> Vec<usize> {
    let dead = band * span(channel);
    let mut turns = vec![0];
    if dead <= 0.0 || channel.len() < 2 {
        return turns;
    }
    let mut rising: Option<bool> = None;
    let (mut top, mut bottom) = (0, 0);
    for i in 1..channel.len() {
        if channel[i] > channel[top] {
            top = i;
        }
        if channel[i] < channel[bottom] {
            bottom = i;
        }
        match rising {
            Some(true) if channel[top] - channel[i] > dead => {
                turns.push(top);
                rising = Some(false);
                bottom = i;
            }
            Some(false) if channel[i] - channel[bottom] > dead => {
                turns.push(bottom);
                rising = Some(true);
                top = i;
            }
            None if channel[i] - channel[bottom] > dead => {
                if bottom > 0 {
                    turns.push(bottom);
                }
                rising = Some(true);
                top = i;
            }
            None if channel[top] - channel[i] > dead => {
                if top > 0 {
                    turns.push(top);
                }
                rising = Some(false);
                bottom = i;
            }
            _ => {}
        }
    }
    match rising {
        Some(true) => turns.push(top),
        Some(false) => turns.push(bottom),
        None => {}
    }
    if turns.last() != Some(&(channel.len() - 1)) {
        turns.push(channel.len() - 1);
    }
    turns
}

/// Root mean square about the mean.
pub fn rms(values: &[f64]) -> f64 {
    let count = values.len().max(1) as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / count).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stepped_sine_is_cut_into_its_cycles() {
        let channel: Vec<f64> = (0..1000)
            .map(|i| {
                let level = if i < 500 { 1.0 } else { 2.0 };
                level * (i as f64 * std::f64::consts::TAU / 100.0).sin()
            })
            .collect();
        let found = cycles(&channel);
        assert_eq!(found.len(), 9);
        assert!(found.iter().filter(|c| c.steady).count() >= 7);
        assert!((found[0].amplitude - 1.0).abs() < 1e-3);
        assert!((found[8].amplitude - 2.0).abs() < 2e-3);
    }

    #[test]
    fn noise_does_not_cut_cycles() {
        let channel: Vec<f64> = (0..1000)
            .map(|i| {
                (i as f64 * std::f64::consts::TAU / 100.0).sin()
                    + 0.004 * ((i * 7919 % 13) as f64 - 6.0) / 6.0
            })
            .collect();
        assert_eq!(cycles(&channel).len(), 9);
    }
}
