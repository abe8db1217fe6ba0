//! The true input behind a measured one.

use super::late::{lateness, read_ahead};
use super::march::added;
use super::operators::Form;
use super::prepared::Prepared;
use super::tips;
use crate::joint::effect::{Acting, Trajectory};
use crate::record::peaks::Between;

/// Rounds in which what a sensor added to the displacement is taken off, at most.
const MOST_ROUNDS: usize = 8;

/// The input that a joint had, as far as it follows from the measured one alone, and what it did between samples;
/// it is left in `truth` as well.
///
/// What a sensor adds to its own channel is taken off, by the effects that are `correcting` it. Of a
/// displacement that comes late under a prescribed force, the joint's answer is that to the force as late.
pub(super) fn true_input(
    (form, record): (Form, &Prepared),
    effects: &[Acting],
    correcting: &[Acting],
    truth: &mut Trajectory,
) -> (Vec<f64>, Between) {
    let (measured, _) = record.channels(form);
    let ahead = |measured: (&[f64], &Between), late: f64| read_ahead(&record.time, measured, late);
    let as_measured = (measured, &record.between);
    let undone = |truth: &mut Trajectory| match correcting.is_empty() {
        true => (measured.to_vec(), record.between.clone()),
        false => {
            let added = undone(form, correcting, truth, measured);
            corrected(&record.time, as_measured, &added)
        }
    };
    let read = match form {
        Form::Play => {
            let times = effects.iter().filter_map(|a| a.effect.lateness(&a.values));
            let late: f64 = times.sum();
            let (input, found) = undone(truth);
            match late == 0.0 {
                true => (input, found),
                false => ahead((&input, &found), -late),
            }
        }
        Form::Stop => match lateness(correcting) {
            Some(late) => ahead(as_measured, late),
            None => undone(truth),
        },
    };
    driving(form, truth).clone_from(&read.0);
    read
}

/// Readings at which the load turned before a record, as the joint had them: what a sensor adds to a reading, whenever that
/// was, it has added to these.
pub(super) fn true_turns(form: Form, readings: &[f64], correcting: &[Acting]) -> Vec<f64> {
    let at_once = correcting.iter().filter(|a| a.effect.follows_reading());
    let at_once: Vec<Acting> = at_once.cloned().collect();
    if at_once.is_empty() {
        return readings.to_vec();
    }
    let mut truth = Trajectory {
        time: vec![0.0; readings.len()],
        force: readings.to_vec(),
        displacement: readings.to_vec(),
        ..Trajectory::default()
    };
    let added = undone(form, &at_once, &mut truth, readings);
    readings.iter().zip(&added).map(|(r, a)| r - a).collect()
}

/// The channel that drives.
fn driving(form: Form, truth: &mut Trajectory) -> &mut Vec<f64> {
    match form {
        Form::Play => &mut truth.force,
        Form::Stop => &mut truth.displacement,
    }
}

/// What a sensor added to the measured channel that drives; leaves the true one in `truth`.
///
/// What depends on the past alone is undone ever better (a slow loss of an amplifier by the factorial of
/// the rounds); where the correction no longer falls, it is noise that is raised, and the last is kept.
fn undone(form: Form, effects: &[Acting], truth: &mut Trajectory, measured: &[f64]) -> Vec<f64> {
    let place = form.input_place();
    let mut last = vec![0.0; measured.len()];
    let mut change = f64::INFINITY;
    for _ in 0..MOST_ROUNDS {
        let Some(next) = added(effects, place, truth) else {
            return last;
        };
        let moves = next.iter().zip(&last).map(|(a, b)| (a - b).abs());
        let moved = moves.fold(0.0, f64::max);
        if moved >= change || moved == 0.0 {
            return last;
        }
        let samples = driving(form, truth).iter_mut().zip(measured).zip(&next);
        samples.for_each(|((u, m), a)| *u = m - a);
        (last, change) = (next, moved);
    }
    last
}

/// An input, and what it does between samples, without what was added.
///
/// Both are found anew: hum upon a turn has tops of its own, and a rate that is told from those is none of the
/// joint's. Of a record that was thinned the samples do not show them; what was found moves with its neighbours. A shape
/// that all tips share is a servo's: what no servo rounded has none once it is corrected.
pub(super) fn corrected(
    time: &[f64],
    (measured, found): (&[f64], &Between),
    added: &[f64],
) -> (Vec<f64>, Between) {
    let input: Vec<f64> = measured.iter().zip(added).map(|(m, a)| m - a).collect();
    if !found.thinned {
        let found = match found.shaped {
            Some(_) => tips::between(found, time, &input),
            None => found.anew(time, &input),
        };
        return (input, found);
    }
    let mut moved = found.clone();
    for peak in &mut moved.peaks {
        peak.value -= 0.5 * (added[peak.before - 1] + added[peak.before]);
    }
    (input, moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint::effect::{Effect, Place};
    use crate::joint::parameters::Parameter;
    use crate::record::peaks::between;

    /// A load cell whose curve is bent, or one that drifts with what it went through.
    struct Cell {
        bent: bool,
    }

    impl Effect for Cell {
        fn name(&self) -> &'static str {
            "cell"
        }
        fn place(&self) -> Place {
            Place::ForceChannel
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn follows_reading(&self) -> bool {
            self.bent
        }
        fn channel(&self, values: &[f64], _place: Place, truth: &Trajectory) -> Vec<f64> {
            truth.force.iter().map(|f| values[0] * f * f).collect()
        }
    }

    #[test]
    fn turns_before_a_record_are_read_by_the_same_sensor() {
        static BENT: Cell = Cell { bent: true };
        static DRIFTS: Cell = Cell { bent: false };
        let acting = |effect: &'static Cell| Acting {
            effect,
            values: vec![0.02],
        };
        let turned = [3.0_f64, -2.0, 1.0];
        let read = turned.map(|f| f + 0.02 * f * f);
        let found = true_turns(Form::Play, &read, &[acting(&BENT), acting(&DRIFTS)]);
        let off = found.iter().zip(turned).map(|(f, t)| (f - t).abs());
        assert!(off.fold(0.0, f64::max) < 1e-6, "{found:?}");
        // What hangs on time did something else then.
        assert_eq!(true_turns(Form::Play, &read, &[acting(&DRIFTS)]), read);
    }

    /// A sine with hum of a hundredth of it, sampled a hundred times a cycle: without the hum its tips are where
    /// they were; moved with their neighbours they are off by a good part of it.
    #[test]
    fn tips_beneath_hum_are_found_where_it_is_taken_off() {
        let time: Vec<f64> = (0..800).map(|i| 0.01 * f64::from(i)).collect();
        let of = |wave: &dyn Fn(f64) -> f64| time.iter().map(|t| wave(*t)).collect::<Vec<f64>>();
        let hums = |t: f64| 0.01 * (23.7 * std::f64::consts::TAU * t).sin();
        let hum = of(&hums);
        let clean = of(&|t| (std::f64::consts::TAU * (t + 0.003)).sin());
        let read: Vec<f64> = clean.iter().zip(&hum).map(|(u, h)| u + h).collect();
        let found = between(&time, &read);
        let worst = |found: &Between| {
            let off = found.peaks.iter().map(|p| (p.value.abs() - 1.0).abs());
            (found.peaks.len(), off.fold(0.0, f64::max))
        };
        let (input, anew) = corrected(&time, (&read, &found), &hum);
        let back = input.iter().zip(&clean).map(|(a, b)| (a - b).abs());
        assert!(back.fold(0.0, f64::max) < 1e-15);
        let (tips, off) = worst(&anew);
        assert_eq!((tips, off < 1e-5), (16, true), "{off}");
        let mut thinned = between(&time, &clean);
        thinned.thinned = true;
        for tip in &mut thinned.peaks {
            tip.value += hums(time[tip.before] - tip.ahead);
        }
        let (_, off) = worst(&corrected(&time, (&read, &thinned), &hum).1);
        assert!(off > 1e-3, "{off}");
    }

    /// Drift of the cell that drives, taken off tips that a servo rounded, and off such that nothing did.
    #[test]
    fn tips_that_a_servo_rounds_keep_their_shape_where_a_drift_is_taken_off() {
        use crate::identify::tips::tests::{drive, time};
        let time = time();
        let drift: Vec<f64> = time.iter().map(|t| 0.01 * t).collect();
        for lag in [Some(0.7), None] {
            let (input, _) = drive(lag);
            let read: Vec<f64> = input.iter().zip(&drift).map(|(u, d)| u + d).collect();
            let found = tips::between(&Between::default(), &time, &read);
            let (back, anew) = corrected(&time, (&read, &found), &drift);
            assert_eq!(found.shaped.is_some(), lag.is_some());
            assert_eq!(found.shaped, anew.shaped);
            let single = Between::default().anew(&time, &back);
            assert_eq!(anew == single, lag.is_none());
        }
    }
}
