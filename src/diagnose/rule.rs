//! What records begin with as a rule: who starts one at zero has a joint without a past, and who starts elsewhere no virgin
//! one.

use super::investigation::Investigation;
use super::noise_of_all::NoiseOfAll;
use super::prepare::Bench;
use super::trials::ALARM;
use crate::identify::Problem;
use crate::identify::beginning::{Beginning, at_zero};

/// Which records start at zero.
pub(super) struct Rule {
    at_zero: Vec<bool>,
}

impl Rule {
    pub(super) fn of(train: &Problem) -> Rule {
        let records = 0..train.records.len();
        Rule {
            at_zero: records.map(|k| at_zero(train.channels(k).0)).collect(),
        }
    }

    /// True where such beginnings are the rule: a joint that goes on, or loads before every record that starts elsewhere,
    /// and there is one.
    pub(super) fn asks_for(&self, beginnings: &[Beginning]) -> bool {
        let mut both = beginnings.iter().zip(&self.at_zero);
        let mut has_past = || both.all(|(begins, at_zero)| *at_zero || !begins.turned.is_empty());
        beginnings.iter().any(|b| b.goes_on) || self.at_zero.contains(&false) && has_past()
    }

    fn is_broken_by(&self, i: &Investigation) -> bool {
        let mut both = i.beginnings().zip(&self.at_zero);
        match i.is_virgin() {
            true => self.at_zero.contains(&false),
            false if i.goes_on() => false,
            false if i.beginnings().all(|b| b.turned.is_empty()) => false,
            false => both.all(|(b, &at_zero)| b.is_virgin() || at_zero),
        }
    }

    /// True where records with another beginning are worth a search beside what was found so far: a joint that is taken for virgin
    /// against the rule needs a cause, if only for the first cycle, and a past of some records against the rule may do the work
    /// of a cause in all of them.
    pub(super) fn asks_another(&self, so_far: &Investigation, other: &Bench) -> bool {
        let broken = self.is_broken_by(so_far);
        broken && (!so_far.is_plain() || other.train.wears_on) || so_far.may_be_beaten_by(other)
    }

    /// Place of the likeliest.
    ///
    /// Where a past is the rule, a virgin joint and a cause that does its work are two oddities; so is a past where none is
    /// the rule, which may do the work of a cause, and a cause that may do the work of a past.
    pub(super) fn likeliest(&self, all: &[Investigation]) -> usize {
        if all.len() < 2 {
            return 0;
        }
        let common = NoiseOfAll::of(all);
        let unlikely = |i: &Investigation| {
            let plainly_virgin = i.is_virgin() && i.found.best.effects.is_empty();
            let oddities = match (self.is_broken_by(i), plainly_virgin) {
                (false, _) if i.is_virgin() && i.tells_of_first_turns_alone() => 2.0,
                (false, _) => 0.0,
                (true, true) => 1.0,
                (true, false) => 2.0,
            };
            i.unlikeliness(common) + oddities * ALARM
        };
        let order = all.iter().map(unlikely).enumerate();
        let least = order.min_by(|(_, a), (_, b)| a.total_cmp(b));
        least.map_or(0, |(i, _)| i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_before_a_record_are_the_rule_where_it_does_not_start_at_zero() {
        let asks = |at_zero: [bool; 2], both: [&Beginning; 2]| {
            let rule = Rule {
                at_zero: at_zero.to_vec(),
            };
            rule.asks_for(&both.map(Clone::clone))
        };
        let (virgin, moved) = (Beginning::default(), Beginning::at(0.2));
        let loaded = Beginning {
            turned: vec![-0.4],
            ..Beginning::at(0.2)
        };
        let gone_on = Beginning {
            goes_on: true,
            ..Beginning::default()
        };
        assert!(asks([true, false], [&virgin, &loaded]));
        assert!(asks([true, true], [&virgin, &gone_on]));
        // Of another record, no load at all, and where none is the rule.
        assert!(!asks([true, false], [&loaded, &virgin]));
        assert!(!asks([true, false], [&virgin, &moved]));
        assert!(!asks([true, true], [&virgin, &loaded]));
    }
}
