//! The steps of a march through one record: its samples, and what lies between them.

use super::late::corners;
use super::march::{March, Step};
use super::prepared::Prepared;
use crate::joint::course::Course;
use crate::joint::passed::Passed;
use crate::record::peaks::Between;

/// Parts of the steps behind a kink where something carries rates on: there it answers within steps.
const BEHIND_KINK: [u32; 4] = [8, 4, 2, 2];

/// Takes every step of a record under the given input and what it does between samples, behind the turns before it;
/// `each` sees them all, with the sample that a step ends at, or `None` where it ends between two.
pub(super) fn walk(
    record: &Prepared,
    (turned, input, between): (&[f64], &[f64], &Between),
    march: &mut March,
    mut each: impl FnMut(Option<usize>, &March, Step),
) {
    let mut peaks = between.peaks.iter().peekable();
    let mut kinks = between.kinks.iter().peekable();
    let mut since_kink = usize::MAX;
    let mut from = (0.0, 0.0);
    if !turned.is_empty() {
        march.precede(record.time.first().copied().unwrap_or(0.0), turned);
    }
    let corners = match march.hauls() {
        true => corners(&record.time, input, between),
        false => Vec::new(),
    };
    let course = Course {
        time: &record.time,
        values: input,
        corners: &corners,
    };
    let mut passed = Passed::default();
    for (i, &driven) in input.iter().enumerate() {
        let to = (record.time[i], driven);
        let mut left = record.steps[i];
        since_kink = since_kink.saturating_add(1);
        if let Some(peak) = peaks.next_if(|peak| peak.before == i) {
            from = (to.0 - peak.ahead, peak.value);
            left = peak.ahead;
            let step = march.step(from.0, record.steps[i] - left, from.1);
            each(None, march, step);
        }
        if kinks.next_if(|&&kink| kink == i).is_some() {
            march.kink();
            since_kink = 0;
        }
        let parts = match (march.follows_rates(), march.hauls()) {
            (true, _) if since_kink < BEHIND_KINK.len() => BEHIND_KINK[since_kink],
            (_, true) if i > 0 => march.hauling(),
            _ => 1,
        };
        let length = left / f64::from(parts);
        for part in 1..parts {
            let share = f64::from(part) / f64::from(parts);
            let at = |a: f64, b: f64| a + share * (b - a);
            let time = at(from.0, to.0);
            let driven = match march.hauls() {
                true => course.at(time, &mut passed),
                false => at(from.1, to.1),
            };
            let step = march.step(time, length, driven);
            each(None, march, step);
        }
        let step = march.step(to.0, length, driven);
        each(Some(i), march, step);
        from = to;
    }
}

#[cfg(test)]
mod tests {
    use crate::identify::beginning::Beginning;
    use crate::identify::gone_on::tests::Pressed;
    use crate::identify::{Form, Problem};
    use crate::joint::effect::Acting;
    use crate::record::Record;

    /// A joint under a force that turned at 1 and at 0 before its record began, and the same record from the start.
    #[test]
    fn slip_limits_follow_what_a_joint_does_on_its_way_to_turns_before_its_record() {
        let ramp = |i: usize| match i {
            0..200 => 0.005 * i as f64,
            200..400 => 2.0 - 0.005 * i as f64,
            _ => (0.01 * (i as f64 - 400.0)).sin(),
        };
        let record = |samples: std::ops::Range<usize>| Record {
            name: "pressed".to_string(),
            displacement: samples.clone().map(ramp).collect(),
            force: samples.map(ramp).collect(),
            ..Record::default()
        };
        let whole = Problem::new(Form::Play, &[record(0..1700)]);
        let begins = Beginning::behind(vec![1.0, 0.0]);
        let mut cut = whole.clone();
        cut.records = Problem::begun(Form::Play, &[record(400..1700)], &[begins]).records;
        let coefficients = vec![1.0; whole.operators.columns()];
        let effects = [Acting {
            effect: &Pressed,
            values: vec![0.5, 0.0],
        }];
        let forces = |problem: &Problem, effects: &[Acting]| {
            problem.predict(&coefficients, effects)[0].judged.clone()
        };
        let (long, short) = (forces(&whole, &effects), forces(&cut, &effects));
        let plain = forces(&whole, &[]);
        let apart = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b);
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let does = apart(&long, &plain);
        let off = apart(&long[400..], &short);
        assert!(off < 0.02 * does, "{off} of {does}");
    }
}
