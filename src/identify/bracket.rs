//! Newton's iteration for the one equation of a step, held within what is known of its root.

/// What is known of where the one root of an increasing equation lies.
pub(super) struct Bracket {
    low: f64,
    high: f64,
}

impl Bracket {
    /// Nothing known yet.
    pub(super) fn new() -> Bracket {
        Bracket {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
        }
    }

    /// Newton's next trial; the middle where it leaves the bracket, or a `leap` back while one side
    /// is open.
    pub(super) fn next(&mut self, trial: f64, error: f64, slope: f64, leap: f64) -> f64 {
        if error > 0.0 {
            self.high = self.high.min(trial);
        } else {
            self.low = self.low.max(trial);
        }
        let newton = trial - error / slope;
        if newton > self.low && newton < self.high {
            newton
        } else if self.low.is_finite() && self.high.is_finite() {
            0.5 * (self.low + self.high)
        } else {
            trial - leap
        }
    }
}
