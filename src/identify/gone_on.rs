//! Records of one joint in the order of its tests: each begins where the one before left the joint.
//!
//! A joint that is not taken apart between two tests remembers the loads of the first. Its second record is answered
//! by another joint than a virgin one until its own load has gone beyond, and what turned before is known, not sought.

use super::beginning::{Beginning, at_zero, wins};
use super::fit::least_misfit;
use super::problem::Problem;

/// Share of the largest reading below which a later turn is forgotten: noise turns the reading all the time.
const SMALLEST: f64 = 1e-3;

/// Beginnings of the records in the order of the tests, each with the turns that those before it left, where that leaves
/// less than virgin joints and than what is `nearest` to each record by itself; the latter too, where it leaves least.
/// Who starts at zero has no past of his own as a rule: then the order of the tests comes first. A record that leaves
/// less as a virgin joint's is one's, be it in the midst of the others.
///
/// The records of `problem` are of virgin joints.
pub(super) fn gone_on(problem: &Problem, nearest: Vec<Beginning>) -> Vec<Vec<Beginning>> {
    if problem.records.len() < 2 {
        return vec![nearest];
    }
    let left = |beginnings: &[Beginning]| least_misfit(&begun(problem, beginnings));
    let samples = problem.rows() as f64;
    let mut anew = vec![false; problem.records.len()];
    // The first is virgin where it starts at zero, as a rule.
    let first = match at_zero(problem.channels(0).0) {
        true => Beginning::default(),
        false => nearest[0].clone(),
    };
    let mut on = in_order(problem, &first, &anew);
    let mut left_on = left(&on);
    for k in 1..anew.len() {
        anew[k] = true;
        let other = in_order(problem, &first, &anew);
        let left_other = left(&other);
        match wins(left_other, left_on, samples) {
            true => (on, left_on) = (other, left_other),
            false => anew[k] = false,
        }
    }
    if !wins(left_on, least_misfit(problem), samples) {
        return vec![nearest];
    }
    let from_zero = (1..problem.records.len()).all(|k| at_zero(problem.channels(k).0));
    match (wins(left(&nearest), left_on, samples), from_zero) {
        (false, _) => vec![on],
        (true, true) => vec![on, nearest],
        (true, false) => vec![nearest, on],
    }
}

/// A joint that goes on through all records, at rest at these readings of each.
pub(super) fn from_readings(problem: &Problem, zeros: &[f64]) -> Option<Vec<Beginning>> {
    let at: Vec<Beginning> = zeros.iter().copied().map(Beginning::at).collect();
    let shifted = begun(problem, &at);
    let virgin = vec![Beginning::default(); problem.records.len()];
    let mut all = gone_on(&shifted, virgin).into_iter();
    let on = all.find(|one| one.iter().any(|b| b.goes_on))?;
    let both = on.into_iter().zip(zeros);
    let from = both.map(|(begins, &zero)| Beginning { zero, ..begins });
    Some(from.collect())
}

/// Records of virgin joints, with other beginnings.
pub(super) fn begun(problem: &Problem, beginnings: &[Beginning]) -> Problem {
    let mut begun = problem.clone();
    for (record, beginning) in begun.records.iter_mut().zip(beginnings) {
        record.begin(problem.operators.form, beginning);
    }
    begun
}

/// Beginnings of records in the order of the tests from that of the first on, joints made `anew` for some.
pub(super) fn in_order(problem: &Problem, first: &Beginning, anew: &[bool]) -> Vec<Beginning> {
    let mut turned = first.turned.clone();
    let mut all = vec![first.clone()];
    for k in 0..problem.records.len() - 1 {
        let before = &problem.records[k];
        let (input, _) = problem.channels(k);
        let mut readings = turned;
        let mut peaks = before.between.peaks.iter().peekable();
        for (i, &reading) in input.iter().enumerate() {
            let between = peaks.next_if(|peak| peak.before == i);
            readings.extend(between.map(|peak| peak.value));
            readings.push(reading);
        }
        let begins = match anew[k + 1] {
            true => Beginning::default(),
            false => Beginning {
                turned: remembered(&readings),
                goes_on: true,
                ..Beginning::default()
            },
        };
        turned = begins.turned.clone();
        all.push(begins);
    }
    all
}

/// Turns that a joint at rest at zero remembers after these readings, oldest first, and the last reading.
///
/// The largest wipes out what came before it; of what follows, the farthest the other way; and so on (Masing, Madelung).
fn remembered(readings: &[f64]) -> Vec<f64> {
    let Some(&last) = readings.last() else {
        return Vec::new();
    };
    let largest = |x: f64, y: &f64| x.max(y.abs());
    let least = SMALLEST * readings.iter().fold(0.0, largest);
    let latest = |key: &dyn Fn(f64) -> f64, from: usize| {
        let places = (from..readings.len()).map(|i| (i, key(readings[i])));
        places.max_by(|(_, a), (_, b)| a.total_cmp(b))
    };
    let mut turns = Vec::new();
    let Some((mut place, _)) = latest(&f64::abs, 0) else {
        return turns;
    };
    let mut way = readings[place].signum();
    loop {
        turns.push(readings[place]);
        way = -way;
        match latest(&|x| way * x, place) {
            Some((next, _)) if (readings[next] - readings[place]).abs() > least => place = next,
            _ => break,
        }
    }
    if turns.last() != Some(&last) {
        turns.push(last);
    }
    turns
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::identify::beginning::beginnings;
    use crate::identify::{Form, baseline};
    use crate::joint::effect::{Acting, Effect, Place, Situation, SlipLimit};
    use crate::joint::parameters::Parameter;
    use crate::record::Record;

    fn record(force: &[f64]) -> Record {
        Record {
            displacement: vec![0.0; force.len()],
            time: Some((0..force.len()).map(|i| 0.01 * i as f64).collect()),
            force: force.to_vec(),
            ..Record::default()
        }
    }

    /// A load, and a displacement, that press the contacts together.
    pub(in crate::identify) struct Pressed;

    impl Effect for Pressed {
        fn name(&self) -> &'static str {
            "pressed"
        }
        fn place(&self) -> Place {
            Place::SlipLimit
        }
        fn parameters(&self) -> &'static [Parameter] {
            &[]
        }
        fn slip_limit(&self, values: &[f64], last: &Situation, _memory: &[f64]) -> SlipLimit {
            SlipLimit::either_way(1.0 + values[0] * last.force + values[1] * last.displacement)
        }
    }

    /// Limits that follow the load creep one way cycle by cycle: where the load has turned does not tell where that
    /// has led to.
    #[test]
    fn a_joint_goes_on_as_it_stood_whatever_its_limits_follow() {
        let bears = |i: usize| 800.0 * (std::f64::consts::TAU * i as f64 / 100.0).sin();
        let long: Vec<f64> = (0..=1200).map(bears).collect();
        let whole = Problem::new(Form::Play, &[record(&long)]);
        let mut joint = vec![1e-10; whole.operators.columns()];
        joint[0] = 1e-9;
        let pressed = || {
            vec![Acting {
                effect: &Pressed,
                values: vec![3e-4, 1e5],
            }]
        };
        // At rest and on the way down; nothing at work, and limits that go where the step does.
        for cut in [700, 740] {
            let records = [record(&long[..=cut]), record(&long[cut..])];
            let parted = Problem::new(Form::Play, &records);
            let virgin = vec![Beginning::default(); 2];
            let on = in_order(&parted, &virgin[0], &[false; 2]);
            let mut parted = begun(&parted, &on);
            parted.wears_on = true;
            for effects in [Vec::new(), pressed()] {
                let tail = &whole.predict(&joint, &effects)[0].judged[cut..];
                let one = &parted.predict(&joint, &effects)[1].judged;
                let off = one.iter().zip(tail).map(|(a, b)| (a - b).abs());
                let off = off.fold(0.0, f64::max);
                let largest = tail.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
                assert!(
                    off < 1e-9 * largest,
                    "{cut}, {} effects: {off}",
                    effects.len()
                );
                // In records of virgin joints it is another.
                let mut anew = Problem::new(Form::Play, &records);
                anew.operators = parted.operators.clone();
                let other = &anew.predict(&joint, &effects)[1].judged;
                let off = other.iter().zip(tail).map(|(a, b)| (a - b).abs());
                assert!(off.fold(0.0, f64::max) > 1e-3 * largest);
            }
        }
    }

    /// A load cell whose zero is off in both tests of a joint, by the same or set anew for each: neither a virgin joint
    /// nor one that goes on from zero.
    #[test]
    fn a_joint_goes_on_from_where_a_sensor_reads_no_zero() {
        let bears = |i: usize| {
            let largest = if i < 700 { 800.0 } else { 500.0 };
            largest * (std::f64::consts::TAU * i as f64 / 100.0).sin()
        };
        let long: Vec<f64> = (0..=1200).map(bears).collect();
        let whole = Problem::new(Form::Play, &[record(&long)]);
        let mut joint = vec![1e-10; whole.operators.columns()];
        joint[0] = 1e-9;
        let answer = &whole.predict(&joint, &[])[0].judged;
        let part = |places: std::ops::RangeInclusive<usize>, zero: f64| {
            let read: Vec<f64> = long[places.clone()].iter().map(|f| f + zero).collect();
            let mut part = record(&read);
            part.displacement = answer[places].to_vec();
            part
        };
        // The second test begins at rest, or where the first has left the load.
        for (cut, zeros) in [
            (700, [20.0, 20.0]),
            (700, [20.0, -35.0]),
            (740, [20.0, -35.0]),
        ] {
            let parts = [part(0..=cut, zeros[0]), part(cut..=1200, zeros[1])];
            let problem = Problem::new(Form::Play, &parts);
            let told = beginnings(&problem, &baseline(&problem), true);
            let at = zeros.map(Beginning::at);
            // A sine is zero at its last turn but for its last digit.
            let goes_on = |one: &&Vec<Beginning>| {
                let same = (one[1].zero - zeros[1]).abs() < 1e-9;
                one[0] == at[0] && one[1].goes_on && same
            };
            let found = told.iter().find(goes_on).unwrap();
            let left = |beginnings: &[Beginning]| least_misfit(&begun(&problem, beginnings));
            assert!(left(found) < 0.1 * left(&at));
        }
    }

    #[test]
    fn a_joint_remembers_the_largest_load_and_what_was_nested_in_it() {
        let loads = [0.0, 3.0, -2.0, 5.0, -4.0, 2.0, -1.0, 1.0, 0.5];
        assert_eq!(
            remembered(&loads),
            [5.0, -4.0, 2.0, -1.0, 1.0, 0.5],
            "all are nested"
        );
        // A later load that goes as far wipes out what was nested within.
        assert_eq!(remembered(&[0.0, 5.0, -4.0, 2.0, -5.0]), [-5.0]);
        assert_eq!(
            remembered(&[0.0, 5.0, -4.0, 2.0, -4.5, 0.0]),
            [5.0, -4.5, 0.0]
        );
        assert_eq!(remembered(&[]), [0.0; 0]);
    }
}
