//! What an experiment is for, in words.

use super::design::Question;
use super::instead::listed;

/// What is to be told from what; `found` are the names of causes that were found. What was found is no more to be
/// shown: it is what something else hides behind.
pub fn purpose(questions: &[Question], ambiguous: bool, found: &[String]) -> String {
    let mut acting: Vec<&str> = Vec::new();
    let mut rivals: Vec<&str> = Vec::new();
    for question in questions {
        let name = question.cause.name();
        if !acting.contains(&name) {
            acting.push(name);
        }
    }
    for question in questions {
        let rival = question.rival.as_str();
        if rival != "none" && !acting.contains(&rival) && !rivals.contains(&rival) {
            rivals.push(rival);
        }
    }
    if ambiguous {
        let all: Vec<&str> = acting.into_iter().chain(rivals).collect();
        return format!("To tell {} apart", all.join(" and "));
    }
    let is_found = |rival: &str| found.iter().any(|name| name == rival);
    let (it, they) = match acting.len() {
        1 => ("it", "it"),
        _ => ("them", "they"),
    };
    let shown = listed(&acting, "and");
    let (behind, beside): (Vec<&str>, Vec<&str>) = rivals.into_iter().partition(|r| is_found(r));
    let behind = match behind.len() {
        0 => None,
        1 => Some(format!("the {} that was found", behind[0])),
        _ => Some(format!("the {} that were found", listed(&behind, "and"))),
    };
    if let (Some(behind), true) = (&behind, questions.iter().all(|q| is_found(&q.rival))) {
        return format!("To tell {shown}, should {they} be there, from {behind}");
    }
    let others: Vec<String> = beside
        .iter()
        .map(|b| (*b).to_string())
        .chain(behind)
        .collect();
    let told = match others.is_empty() {
        true => String::new(),
        false => format!(" and tell {it} from {}", listed(&others, "and")),
    };
    format!("To show {shown} at a size that would matter{told}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::causes::find;
    use crate::joint::effect::Acting;

    fn asked(pairs: &[(&str, &str)]) -> Vec<Question> {
        let question = |(name, rival): &(&str, &str)| {
            let cause = find(name)?;
            Some(Question {
                cause,
                acting: Acting {
                    effect: cause.effect(),
                    values: Vec::new(),
                },
                rival: (*rival).to_string(),
                mapped: None,
            })
        };
        pairs.iter().filter_map(question).collect()
    }

    #[test]
    fn what_was_found_is_not_to_be_shown() {
        let found = ["sensor_delay".to_string()];
        let lag = asked(&[("viscous_damping", "sensor_delay")]);
        assert_eq!(
            purpose(&lag, false, &found),
            "To tell viscous_damping, should it be there, from the sensor_delay that was found"
        );
        assert_eq!(
            purpose(&lag, false, &[]),
            "To show viscous_damping at a size that would matter and tell it from sensor_delay"
        );
        let more = asked(&[
            ("viscous_damping", "sensor_delay"),
            ("asymmetric_friction", "none"),
        ]);
        assert_eq!(
            purpose(&more, false, &found),
            "To show viscous_damping and asymmetric_friction at a size that would matter and tell \
             them from the sensor_delay that was found"
        );
        let both = asked(&[
            ("viscous_damping", "sensor_delay"),
            ("sensor_delay", "viscous_damping"),
        ]);
        assert_eq!(
            purpose(&both, true, &[]),
            "To tell viscous_damping and sensor_delay apart"
        );
    }
}
