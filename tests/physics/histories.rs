//! Load histories: random with deep nesting, reproducible from a seed.

/// SplitMix64: numbers for histories, the same on every machine.
pub struct Random(pub u64);

impl Random {
    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform in [−1, 1).
    pub fn symmetric(&mut self) -> f64 {
        2.0 * self.uniform() - 1.0
    }
}

/// `steps` values within ±1: a random walk between random targets, with ring-downs of 60 to 80
/// shrinking cycles that the network has to remember whole, and rising ones that close them.
pub fn random_nested(seed: u64, steps: usize) -> Vec<f64> {
    let mut random = Random(seed);
    let mut history = Vec::with_capacity(steps);
    let mut now = 0.0;
    while history.len() < steps {
        if random.uniform() < 0.06 {
            let (swings, centre) = (120.0 + 40.0 * random.uniform(), 0.2 * random.symmetric());
            let mut swing = 0.75 + 0.05 * random.uniform();
            let shrink = swing / swings;
            let mut sign = 1.0;
            while swing > 0.0 {
                history.push(centre + sign * (swing - 0.3 * shrink * random.uniform()));
                (swing, sign) = (swing - shrink, -sign);
            }
        } else {
            let target = random.symmetric();
            let pieces = 1 + (6.0 * random.uniform()) as usize;
            for i in 1..=pieces {
                history.push(now + (target - now) * i as f64 / pieces as f64);
            }
        }
        now = history.last().copied().unwrap_or(0.0);
    }
    history.truncate(steps);
    history
}
