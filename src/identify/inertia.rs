//! A mass that moves with the joint where force drives: its acceleration at the end of a step.

use crate::joint::effect::Acting;

/// α of Wood, Bossak and Zienkiewicz (1980) with nothing left of motion too fast for the steps: a mass too small
/// by far would ring on, and no slope of the misfit lead from there to the right one. Motion of a tenth of a radian
/// a step errs by 0.9 %.
const ALPHA: f64 = -1.0;
const GAMMA: f64 = 0.5 - ALPHA;
const BETA: f64 = 0.25 * (1.0 - ALPHA) * (1.0 - ALPHA);

/// Steps that a record's own rate is told from before the mass takes part: it may begin in motion.
const BEGINNING: usize = 3;

/// Displacement, its rate and its acceleration.
pub(super) type Motion = [f64; 3];

/// One step of Newmark's method, which is linear in motion and displacement.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Stride {
    /// Its length \[s\].
    length: f64,
    /// False near the beginning of a record, where the rate is the displacement's and the mass rests.
    started: bool,
}

impl Stride {
    /// The motion at the end of the step, where its displacement is `u`:
    /// `a' = (u' − u − h v)/(β h²) − (1/2β − 1) a`, `v' = v + h ((1 − γ) a + γ a')`.
    pub fn end(&self, [before, velocity, acceleration]: Motion, u: f64) -> Motion {
        let h = self.length;
        match (self.started, h > 0.0) {
            (_, false) => [u, velocity, acceleration],
            (false, true) => [u, (u - before) / h, 0.0],
            (true, true) => {
                let end = (u - before - h * velocity) / (BETA * h * h)
                    - (0.5 / BETA - 1.0) * acceleration;
                let rate = velocity + h * ((1.0 - GAMMA) * acceleration + GAMMA * end);
                [u, rate, end]
            }
        }
    }

    /// True where the mass takes part.
    fn hauls(&self) -> bool {
        self.started && self.length > 0.0
    }

    /// Acceleration that the mass is moved with, `(1 − α) a' + α a` \[m/s²\].
    fn weighted(before: Motion, end: Motion) -> f64 {
        (1.0 - ALPHA) * end[2] + ALPHA * before[2]
    }
}

/// Mass between load cell and joint, with the motion at the end of the last step.
///
/// Newmark's method as Wood, Bossak and Zienkiewicz damp it: of second order, stable for any mass and step, and
/// motion near a resonance of mass and joint that the steps do not resolve dies instead of ringing on.
#[derive(Debug, Clone, Default)]
pub(super) struct Inertia {
    /// Of all effects together \[kg\].
    mass: f64,
    last: Motion,
    /// Steps so far that took time.
    passed: usize,
    /// Parts of a sample's step that it is marched in.
    pub parts: u32,
}

/// Inertia at a trial displacement.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Hauled {
    /// m Ü \[N\].
    pub force: f64,
    /// Its derivative by the displacement at the end of the step \[N/m\].
    pub slope: f64,
}

/// What a step that was taken carries on to later ones.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Carried {
    /// Derivatives of m Ü by the motion before the step.
    pub by_motion: Motion,
    /// The step.
    pub stride: Stride,
}

impl Inertia {
    /// Of the masses among a set of effects.
    pub fn of(effects: &[Acting], parts: u32) -> Inertia {
        let masses = effects.iter().filter_map(|a| a.effect.inertia(&a.values));
        Inertia {
            mass: masses.sum(),
            parts,
            ..Inertia::default()
        }
    }

    /// True where there is a mass.
    pub fn acts(&self) -> bool {
        self.mass != 0.0
    }

    /// m Ü at a displacement at the end of a step.
    pub fn at(&self, length: f64, displacement: f64) -> Hauled {
        let stride = self.stride(length);
        match self.acts() && stride.hauls() {
            true => Hauled {
                force: self.force(stride, self.last, displacement),
                slope: self.force(stride, [0.0; 3], 1.0),
            },
            false => Hauled::default(),
        }
    }

    /// Takes a step that ends at a displacement.
    pub fn take(&mut self, length: f64, displacement: f64) -> Carried {
        if !self.acts() {
            return Carried::default();
        }
        let stride = self.stride(length);
        self.last = stride.end(self.last, displacement);
        self.passed += usize::from(length > 0.0);
        let by_motion = match stride.hauls() {
            true => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
                .map(|unit| self.force(stride, unit, 0.0)),
            false => Motion::default(),
        };
        Carried { by_motion, stride }
    }

    fn stride(&self, length: f64) -> Stride {
        Stride {
            length,
            started: self.passed >= BEGINNING,
        }
    }

    fn force(&self, stride: Stride, before: Motion, displacement: f64) -> f64 {
        self.mass * Stride::weighted(before, stride.end(before, displacement))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::identify::{Form, Problem};
    use crate::joint::effect::{Effect, Place};
    use crate::joint::parameters::Parameter;
    use crate::record::Record;

    /// A mass alone.
    pub struct Mass;

    impl Effect for Mass {
        fn name(&self) -> &'static str {
            "mass"
        }
        fn place(&self) -> Place {
            Place::ForceChannel
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn inertia(&self, values: &[f64]) -> Option<f64> {
            Some(values[0])
        }
    }

    fn of(mass: f64) -> Inertia {
        Inertia {
            mass,
            ..Inertia::default()
        }
    }

    /// The largest error of the inertia behind the first radian, over its largest value.
    fn error(steps_per_radian: f64) -> f64 {
        let mut inertia = of(3.0);
        let mut worst = 0.0_f64;
        for i in 0..(20.0 * steps_per_radian) as usize {
            let t = i as f64 / steps_per_radian;
            let length = if i == 0 { 0.0 } else { 1.0 / steps_per_radian };
            let hauled = inertia.at(length, t.sin());
            inertia.take(length, t.sin());
            if t > 1.0 {
                worst = worst.max((hauled.force / 3.0 + t.sin()).abs());
            }
        }
        worst
    }

    #[test]
    fn a_sine_is_accelerated_to_second_order() {
        let (coarse, fine) = (error(10.0), error(20.0));
        assert!(coarse < 0.0092, "{coarse}");
        assert!((coarse / fine - 4.0).abs() < 0.3, "{coarse}, {fine}");
    }

    #[test]
    fn it_is_linear_in_motion_and_displacement() {
        let mut inertia = of(5.0);
        for (i, u) in [0.3, 0.5, 0.4, 0.9, 0.2, 0.8].into_iter().enumerate() {
            inertia.take([0.0, 0.1, 0.1, 0.1, 0.2, 0.05][i], u);
        }
        let hauled = inertia.at(0.1, 0.7);
        let [u, v, a] = inertia.last;
        let [by_u, by_v, by_a] = inertia.take(0.1, 0.7).by_motion;
        let sum = 0.7 * hauled.slope + u * by_u + v * by_v + a * by_a;
        assert!(hauled.force.abs() > 1.0);
        assert!((sum / hauled.force - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_the_steps_do_not_resolve_dies_and_a_beginning_in_motion_is_none() {
        let mut inertia = of(1.0);
        // Loads before the record take no time.
        for turned in [3.0, -2.0, 4.0, -1.0] {
            inertia.take(0.0, turned);
        }
        // In motion from the first sample, a corner at the eighth.
        let course = |i: usize| (i as f64).min(8.0);
        let force: Vec<f64> = (0..30)
            .map(|i| {
                let length = if i == 0 { 0.0 } else { 1.0 };
                let hauled = inertia.at(length, course(i));
                inertia.take(length, course(i));
                hauled.force
            })
            .collect();
        assert!(force[..9].iter().all(|f| *f == 0.0));
        // The impulse is that of the rate's jump.
        assert!((force.iter().sum::<f64>() + 1.0).abs() < 1e-3);
        assert!(force[20..].iter().all(|f| f.abs() < 1e-2));
    }

    /// A mass that takes a tenth of the force of a joint, at first at rest: the force is its own and what moves it.
    #[test]
    fn a_mass_moves_with_the_joint() {
        let (compliance, mass, rate) = (1e-8, 2.5e4, 20.0_f64);
        let motion = |t: f64| 1e-6 * (1.0 - (-(2.0 * t).powi(4)).exp()) * (rate * t).sin();
        let time: Vec<f64> = (0..2000).map(|i| 1e-3 * f64::from(i)).collect();
        let acceleration = |t: f64| (motion(t + 1e-4) - 2.0 * motion(t) + motion(t - 1e-4)) / 1e-8;
        let record = Record {
            name: "mass".to_string(),
            displacement: time.iter().map(|t| motion(*t)).collect(),
            force: time
                .iter()
                .map(|t| motion(*t) / compliance + mass * acceleration(*t))
                .collect(),
            time: Some(time),
            ..Record::default()
        };
        let problem = Problem::new(Form::Play, &[record]);
        let mut coefficients = vec![0.0; problem.operators.columns()];
        coefficients[0] = compliance;
        let acting = Acting {
            effect: &Mass,
            values: vec![mass],
        };
        let worst = |effects: &[Acting]| {
            let predicted = &problem.predict(&coefficients, effects)[0]
                .truth
                .displacement;
            let both = predicted.iter().zip(&problem.records[0].displacement);
            both.fold(0.0_f64, |worst, (p, u)| worst.max((p - u).abs()))
        };
        assert!(worst(&[acting]) < 2e-3 * 1e-6);
        assert!(worst(&[]) > 0.08 * 1e-6);
    }
}
