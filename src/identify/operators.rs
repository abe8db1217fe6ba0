//! The operator dictionary: a fixed grid of thresholds on which any Masing joint is linear.

/// Which of the two dual forms a record is judged in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Force in, displacement judged: play operators with compliances (THEORY: the dual).
    Play,
    /// Displacement in, force judged: stop operators with stiffnesses; for deep slip.
    Stop,
}

/// Thresholds of the operators, in units of the input channel, increasing.
#[derive(Debug, Clone, PartialEq)]
pub struct Operators {
    /// Play or stop.
    pub form: Form,
    /// `r_j` \[N\] for plays, `d_j` \[m\] for stops.
    pub thresholds: Vec<f64>,
}

/// Count of thresholds: fine enough that the piecewise-linear virgin curve errs by far less than
/// the noise of any record (checked on noise-free records by the tests of this room).
const COUNT: usize = 40;

impl Operators {
    /// Grid for an input whose largest magnitude is `range`.
    ///
    /// Plays crowd towards the largest force, `(j/N)^1.4`, because compliance rises there; stops
    /// are spread geometrically over three decades because stiffness falls from the start.
    pub fn grid(form: Form, range: f64) -> Operators {
        let thresholds = match form {
            Form::Play => (1..COUNT)
                .map(|j| range * (j as f64 / COUNT as f64).powf(1.4))
                .collect(),
            Form::Stop => {
                let mut grid: Vec<f64> = (0..COUNT * 2 / 3)
                    .map(|j| range * 1e-3_f64.powf(1.0 - j as f64 / (COUNT * 2 / 3) as f64))
                    .chain((1..COUNT / 3).map(|j| range * (j as f64 / (COUNT / 3) as f64)))
                    .collect();
                grid.sort_by(f64::total_cmp);
                grid
            }
        };
        Operators { form, thresholds }
    }

    /// Count of columns: the elastic one and one per threshold.
    pub fn columns(&self) -> usize {
        self.thresholds.len() + 1
    }
}
