//! Words of the report that need a sentence: explained at its end, linked where they first stand.

use std::collections::BTreeSet;
use std::sync::Mutex;

use minijinja::context;
use minijinja::value::Value;

use super::symbols::escaped;

/// A term of the report.
struct Term {
    anchor: &'static str,
    /// As it heads its explanation.
    title: &'static str,
    /// How it stands in sentences.
    forms: &'static [&'static str],
    meaning: &'static str,
}

const TERMS: [Term; 7] = [
    Term {
        anchor: "baseline",
        title: "baseline, extended joint",
        forms: &["baseline joint", "baseline"],
        meaning: "The baseline is the Iwan joint that answers the records best without any further cause; the extended joint is the same with the named causes, both refitted together.",
    },
    Term {
        anchor: "unseen",
        title: "unseen data, held out",
        forms: &["unseen data", "held-out error", "held out"],
        meaning: "Whole cycles, and each record in turn, that are set aside before anything is fitted. What a model predicts of them it has not learned from them.",
    },
    Term {
        anchor: "noise-variance",
        title: "noise variances",
        forms: &["noise variances"],
        meaning: "The misfit is the sum of squared errors over all samples, each over the variance of the noise and freed of what it shares with the sample before. Noise alone leaves about 1 per independent sample; a cause of 25 is beyond doubt by chance.",
    },
    Term {
        anchor: "explainable",
        title: "explainable misfit",
        forms: &["explainable misfit", "misfit beyond the noise"],
        meaning: "What the baseline misses beyond the noise, that is, what any model could explain at all. The noise itself is no part of it.",
    },
    Term {
        anchor: "whitened",
        title: "whitened",
        forms: &["whitened"],
        meaning: "Freed of the correlation of neighbouring samples, so that every sample counts as evidence of its own and slow noise is not taken for structure.",
    },
    Term {
        anchor: "log-evidence",
        title: "log evidence",
        forms: &["Log evidence", "log evidence"],
        meaning: "Half the fall of the misfit that a cause brings, in noise variances, less what its parameters cost. Two causes that differ by 5 differ by a factor of 150 in likelihood; below zero the baseline is the better account.",
    },
    Term {
        anchor: "chi",
        title: "separability χ²",
        forms: &["χ²"],
        meaning: "If one cause were at work, the misfit, in noise variances, that another leaves of it after everything is refitted. 0: the two look the same in these records; from 25 on they are told apart.",
    },
];

/// Links terms of one page, each where it first stands.
#[derive(Debug, Default)]
pub(super) struct Glossary {
    linked: Mutex<BTreeSet<&'static str>>,
}

impl Glossary {
    /// The text, escaped, with links from the terms that no text before it had.
    pub(super) fn linked(&self, text: &str) -> Value {
        // A poisoned lock still holds the terms that were linked.
        let mut linked = self.linked.lock().unwrap_or_else(|e| e.into_inner());
        let mut page = String::new();
        let mut rest = text;
        loop {
            let found = TERMS.iter().filter(|term| !linked.contains(term.anchor));
            let found = found.flat_map(|term| {
                let places = term.forms.iter();
                places.filter_map(move |form| Some((rest.find(form)?, *form, term)))
            });
            // The first place, and there the longest form.
            let first = found.min_by_key(|(at, form, _)| (*at, usize::MAX - form.len()));
            let Some((at, form, term)) = first else { break };
            page.push_str(&escaped(&rest[..at]));
            let meaning = escaped(term.meaning);
            page.push_str(&format!(
                "<a class=\"term\" href=\"#word-{}\" title=\"{meaning}\">{}</a>",
                term.anchor,
                escaped(form)
            ));
            linked.insert(term.anchor);
            rest = &rest[at + form.len()..];
        }
        page.push_str(&escaped(rest));
        Value::from_safe_string(page)
    }
}

/// All terms with their meanings.
pub(super) fn terms() -> Vec<Value> {
    let terms = TERMS.iter();
    terms
        .map(
            |term| context! { anchor => term.anchor, title => term.title, meaning => term.meaning },
        )
        .collect()
}

#[cfg(test)]
mod tests {
    use super::Glossary;

    #[test]
    fn a_term_is_linked_once() {
        let glossary = Glossary::default();
        let first = glossary.linked("The baseline misses a < b; the baseline joint, too.");
        let first = first.to_string();
        assert!(first.starts_with("The <a class=\"term\" href=\"#word-baseline\""));
        assert!(first.ends_with(">baseline</a> misses a &lt; b; the baseline joint, too."));
        assert_eq!(glossary.linked("baseline").to_string(), "baseline");
    }
}
