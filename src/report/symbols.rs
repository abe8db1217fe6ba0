//! Symbols of plain text (`K_1`, `phi_0`, `b F^3`) as a page shows them.

use minijinja::value::Value;

/// Names of Greek letters that stand for themselves in the texts of the catalogue.
const GREEK: [(&str, &str); 13] = [
    ("alpha", "α"),
    ("beta", "β"),
    ("chi", "χ"),
    ("gamma", "γ"),
    ("lambda", "λ"),
    ("mu", "μ"),
    ("omega", "ω"),
    ("phi", "φ"),
    ("pi", "π"),
    ("rho", "ρ"),
    ("sigma", "σ"),
    ("tau", "τ"),
    ("theta", "θ"),
];

/// The text with every other character escaped: `K_1` → K₁, `F^3` → F³, `phi` → φ.
///
/// A subscript follows a single letter or a Greek one, so that the names of causes
/// (`sensor_delay`) stay as they are.
pub(super) fn marked_up(text: &str) -> Value {
    let mut page = String::with_capacity(text.len() + 32);
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let word = word(rest);
        if word.is_empty() {
            let raised = rest.strip_prefix('^').map_or("", self::word);
            if raised.is_empty() {
                push_escaped(&mut page, first);
                rest = &rest[first.len_utf8()..];
            } else {
                page.push_str(&format!("<sup>{raised}</sup>"));
                rest = &rest[1 + raised.len()..];
            }
            continue;
        }
        rest = &rest[word.len()..];
        let letter = GREEK.iter().find(|(name, _)| *name == word);
        page.push_str(letter.map_or(word, |(_, letter)| letter));
        let lowered = rest.strip_prefix('_').map_or("", subscript);
        if lowered.is_empty() {
            // The rest of a longer name is taken with it.
            while let Some(more) = rest.strip_prefix('_') {
                let next = self::word(more);
                page.push('_');
                page.push_str(next);
                rest = &more[next.len()..];
            }
        } else if letter.is_some() || word.chars().count() == 1 {
            page.push_str(&format!("<sub>{lowered}</sub>"));
            rest = &rest[1 + lowered.len()..];
        } else {
            page.push('_');
            page.push_str(lowered);
            rest = &rest[1 + lowered.len()..];
        }
    }
    Value::from_safe_string(page)
}

/// Letters and digits at the beginning.
fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric());
    &text[..end.unwrap_or(text.len())]
}

/// A word, or the sign of a side: `g_+`.
fn subscript(text: &str) -> &str {
    match word(text) {
        "" if text.starts_with(['+', '-']) => &text[..1],
        word => word,
    }
}

fn push_escaped(page: &mut String, character: char) {
    match character {
        '&' => page.push_str("&amp;"),
        '<' => page.push_str("&lt;"),
        '>' => page.push_str("&gt;"),
        '"' => page.push_str("&quot;"),
        other => page.push(other),
    }
}

#[cfg(test)]
mod tests {
    use super::marked_up;

    fn page(text: &str) -> String {
        marked_up(text).to_string()
    }

    #[test]
    fn symbols_are_set_and_everything_else_is_escaped() {
        assert_eq!(
            page("k_p max(u - g_+, 0) < F_network"),
            "k<sub>p</sub> max(u - g<sub>+</sub>, 0) &lt; F<sub>network</sub>"
        );
        assert_eq!(
            page("phi_0 exp(-(s/d)^2), 2 pi f_c & dl/dt"),
            "φ<sub>0</sub> exp(-(s/d)<sup>2</sup>), 2 π f<sub>c</sub> &amp; dl/dt"
        );
    }

    #[test]
    fn names_stay_names() {
        let text = "sensor_delay, rate_dependent_friction, a_ and 3 ^ 4";
        assert_eq!(page(text), text);
    }
}
