//! Why a joint, a step or a saved state is refused.

/// A number for a message: with few digits far from one, where all of them would be three hundred.
pub fn shown(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-4..1e6 => value.to_string(),
        size if size.is_finite() => format!("{value:e}"),
        _ => value.to_string(),
    }
}

/// The values that two bounds admit, in words. A bound at the end of what numbers can tell is none.
pub fn admitted(lower: f64, upper: f64) -> String {
    let above = match lower {
        f64::MIN_POSITIVE => Some("above 0".to_owned()),
        lower if lower > f64::MIN => Some(format!("at least {}", shown(lower))),
        _ => None,
    };
    let below = (upper < f64::MAX).then(|| format!("at most {}", shown(upper)));
    match (above, below) {
        (Some(above), Some(below)) => format!("{above} and {below}"),
        (None, None) => "a finite number".to_owned(),
        (above, below) => above.or(below).unwrap_or_default(),
    }
}

/// A number to five digits.
fn roughly(value: f64) -> f64 {
    format!("{value:.4e}").parse().unwrap_or(value)
}

/// An effect as the one to look at.
fn blamed(cause: Option<&str>) -> String {
    cause.map_or("one of its causes".to_owned(), |name| format!("`{name}`"))
}

/// Why a step or a joint was refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum JointError {
    /// A force at or beyond full slip: no displacement answers it.
    #[error(
        "force {} N reaches full slip at {} N: no displacement answers it; drive the joint in displacement or lower the load",
        shown(*.force),
        shown(*.full_slip)
    )]
    BeyondFullSlip {
        /// The force asked for [N].
        force: f64,
        /// F_S [N].
        full_slip: f64,
    },
    /// A parameter outside its glossary's range.
    #[error("parameter `{name}` is {}: it must be {}", shown(*.value), admitted(*.lower, *.upper))]
    OutOfRange {
        /// Glossary name.
        name: String,
        /// The value refused.
        value: f64,
        /// Smallest admissible.
        lower: f64,
        /// Largest admissible.
        upper: f64,
    },
    /// An input that is no number.
    #[error("input {value} at t = {} s is not a finite number", shown(*.time))]
    NotFinite {
        /// Time [s].
        time: f64,
        /// The value refused.
        value: f64,
    },
    /// An input so large that the equation of the joint has no finite root.
    #[error("input {} at t = {} s is beyond all that this joint can answer in numbers", shown(*.value), shown(*.time))]
    OutOfReach {
        /// Time [s].
        time: f64,
        /// The value refused.
        value: f64,
    },
    /// A force that the joint does not carry: where it softens, its force falls beyond a peak.
    #[error(
        "no displacement answers {} N at t = {} s: {} lets the joint carry about {} N at most; drive it in displacement, lower the load or soften it less",
        shown(*.force),
        shown(*.time),
        blamed(*.cause),
        shown(roughly(*.most))
    )]
    NoEquilibrium {
        /// Time [s].
        time: f64,
        /// The force asked for [N].
        force: f64,
        /// The force from which it falls [N].
        most: f64,
        /// The effect that softens it most there, where one is to be told.
        cause: Option<&'static str>,
    },
    /// A point that a spring law has no stable answer for: displacement would fall where force rises.
    #[error(
        "input {} at t = {} s: {} takes away more compliance than joint and spring have, and displacement would fall as the force rises; lower the load or stiffen it less",
        shown(*.value),
        shown(*.time),
        blamed(*.cause)
    )]
    TurnsBack {
        /// Time [s].
        time: f64,
        /// The input asked for [N or m].
        value: f64,
        /// The effect that takes the most, where one is to be told.
        cause: Option<&'static str>,
    },
    /// Time running back.
    #[error("time runs back from {} s to {} s", shown(*.from), shown(*.to))]
    TimeRunsBack {
        /// Last accepted time [s].
        from: f64,
        /// Time asked for [s].
        to: f64,
    },
    /// Vectors or counts that do not fit together.
    #[error("{what}: {found} values where {expected} are needed")]
    WrongCount {
        /// What was counted.
        what: String,
        /// Count found.
        found: usize,
        /// Count needed.
        expected: usize,
    },
    /// An error at one sample of a record.
    #[error("at t = {} s (sample {sample}): {reason}", shown(*.time))]
    AtSample {
        /// Time [s].
        time: f64,
        /// Number of the sample, from 0.
        sample: usize,
        /// What was refused.
        reason: Box<JointError>,
    },
    /// A saved state that does not belong to this joint.
    #[error("saved state does not fit this joint: {reason}")]
    ForeignState {
        /// What differs.
        reason: String,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_number_of_a_message_has_three_hundred_digits() {
        assert_eq!(shown(0.0), "0");
        assert_eq!(shown(-150.0), "-150");
        assert_eq!(shown(1e-4), "0.0001");
        assert_eq!(shown(1.5e-5), "1.5e-5");
        assert_eq!(shown(-1e300), "-1e300");
        assert_eq!(shown(f64::INFINITY), "inf");
        let range = |lower, upper| JointError::OutOfRange {
            name: "compliance".into(),
            value: 0.0,
            lower,
            upper,
        };
        for (lower, upper, said) in [
            (f64::MIN_POSITIVE, f64::INFINITY, "above 0"),
            (f64::MIN_POSITIVE, f64::MAX, "above 0"),
            (-1.0, 4.0, "at least -1 and at most 4"),
            (f64::NEG_INFINITY, 1e300, "at most 1e300"),
            (f64::MIN, f64::MAX, "a finite number"),
        ] {
            let message = range(lower, upper).to_string();
            let expected = format!("parameter `compliance` is 0: it must be {said}");
            assert_eq!(message, expected);
        }
        let far = JointError::OutOfReach {
            time: 1e-300,
            value: 1e300,
        };
        assert!(far.to_string().len() < 100, "{far}");
    }
}
