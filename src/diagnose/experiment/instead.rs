//! What would settle a question, where no program within the rig's limits does.

use super::design::Question;
use super::limits::Limits;
use super::plan::Told;
use super::program::Rig;
use crate::causes::{Kind, find};

/// Multiples of what a rig does that are tried, one limit at a time.
const LONGER: [f64; 3] = [3.0, 10.0, 30.0];
const FARTHER: [f64; 2] = [1.5, 3.0];
const FASTER: [f64; 2] = [3.0, 10.0];

/// What would settle the questions, in a clause that ends in a full stop: the limits that bind, found by trying
/// others, and what is no matter of the rig.
pub fn instead(told: &Told, asked: &[Question], limits: &Limits, dummy_is_there: bool) -> String {
    // What may merely be hidden is not worth the search, unless the rig has no program at all.
    let sought = told.ambiguous || told.rigs(limits).iter().all(|rig| rig.menu().is_empty());
    let mut ways = match sought {
        true => wider(told, asked, limits),
        false => Vec::new(),
    };
    let binds = !ways.is_empty() || !sought;
    let is = |kind: Kind| {
        asked.iter().any(|question| {
            let rival = find(&question.rival);
            question.cause.kind() == kind || rival.is_some_and(|r| r.kind() == kind)
        })
    };
    let (joint, chain) = (is(Kind::Joint), is(Kind::Measurement));
    if chain && !dummy_is_there {
        let dummy = "a monolithic dummy measured through the same chain (--dummy FILE)";
        ways.push(dummy.to_string());
    }
    ways.push(match chain {
        true => "a second displacement sensor of another kind".to_string(),
        false => "a second sensor at the slipping faces".to_string(),
    });
    let (drive, _) = told.problem.operators.form.input();
    let hardly = match (binds, joint) {
        (false, true) => format!("; more {drive}, rate or time alone hardly would"),
        _ => String::new(),
    };
    format!("{} would{hardly}.", listed(&ways, "or"))
}

/// Words in a row, the last after a conjunction.
pub fn listed<T: AsRef<str>>(words: &[T], conjunction: &str) -> String {
    let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    match words.split_last() {
        Some((last, [])) => (*last).to_string(),
        Some((last, rest)) => format!("{} {conjunction} {last}", rest.join(", ")),
        None => String::new(),
    }
}

/// The limits that keep the rig from settling the questions, each with a value that would let it.
fn wider(told: &Told, asked: &[Question], limits: &Limits) -> Vec<String> {
    let form = told.problem.operators.form;
    let farthest = |limits: &Limits| told.rigs(limits).pop();
    let Some(now) = farthest(limits) else {
        return Vec::new();
    };
    let reach = now.upper.max(-now.lower);
    let (drive, answer) = (form.input().0, form.judged().0);
    let longest = |rig: &Rig| rig.longest() > 1.01 * now.longest();
    let any = |_: &Rig| true;
    let tried = |multiples: &[f64],
                 of: f64,
                 set: &dyn Fn(&mut Limits, f64),
                 goes: &dyn Fn(&Rig) -> bool| {
        let settles = |multiple: &f64| {
            let value = rounded(multiple * of);
            let mut wider = *limits;
            set(&mut wider, value);
            let rig = farthest(&wider).filter(|rig| goes(rig))?;
            told.would_settle(asked, &[rig]).then_some(value)
        };
        // What the most does not settle, less will not: all but the last are tried for how much it takes.
        let (most, less) = multiples.split_last()?;
        let enough = settles(most)?;
        less.iter().find_map(settles).or(Some(enough))
    };
    let duration = tried(
        &LONGER,
        now.duration,
        &|l, v| l.duration = Some(v),
        &longest,
    );
    let force = tried(&FARTHER, reach, &|l, v| *l.of_drive(form) = Some(v), &any);
    let rate = tried(&FASTER, now.rate, &|l, v| l.rate = Some(v), &any);
    let answered = limits.of_answer(form).and_then(|most| {
        let set = |l: &mut Limits, v| match form {
            crate::identify::Form::Play => l.displacement = Some(v),
            crate::identify::Form::Stop => l.force = Some(v),
        };
        tried(&FARTHER, most, &set, &any)
    });
    let ways = [
        duration.map(|v| format!("a longer test (--limit-duration {v})")),
        force.map(|v| format!("more {drive} to either side (--limit-{drive} {v})")),
        answered.map(|v| format!("more {answer} (--limit-{answer} {v})")),
        rate.map(|v| format!("faster cycles (--limit-rate {v})")),
    ];
    ways.into_iter().flatten().collect()
}

/// A value as one would give it on a command line: two digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_advised_in_two_digits() {
        assert_eq!(rounded(14.96), 15.0);
        assert_eq!(format!("{}", rounded(2.763e-5)), "0.000028");
        assert_eq!(listed(&["a", "b", "c"], "or"), "a, b or c");
        assert_eq!(listed(&["a"], "or"), "a");
    }
}
