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
            let power = rest.strip_prefix('^').unwrap_or("");
            let (raised, end) = match bracketed(power) {
                Some(number) => (number, number.len() + 2),
                None => (self::word(power), self::word(power).len()),
            };
            if raised.is_empty() {
                push_escaped(&mut page, first);
                rest = &rest[first.len_utf8()..];
            } else {
                page.push_str(&format!("<sup>{raised}</sup>"));
                rest = &power[end..];
            }
            continue;
        }
        rest = &rest[word.len()..];
        if let Some((before, power, after)) = derivative(word) {
            page.push_str(&format!("{before}<sup>{power}</sup>{after}"));
            continue;
        }
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

/// A number in brackets at the beginning, as a unit has it: `N^(2.65)`.
fn bracketed(text: &str) -> Option<&str> {
    let number = text.strip_prefix('(')?.split(')').next()?;
    let digits = number
        .chars()
        .all(|c| c.is_ascii_digit() || "+-.".contains(c));
    (digits && text.len() > number.len() + 1).then_some(number)
}

/// Letters and digits at the beginning.
fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric());
    &text[..end.unwrap_or(text.len())]
}

/// `d2U` and `dt2` in pieces: the order of a derivative, raised.
fn derivative(word: &str) -> Option<(&str, &str, &str)> {
    let order = word.strip_prefix('d')?.find(|c: char| c.is_ascii_digit())? + 1;
    let (before, raised) = word.split_at(order);
    let (power, after) = raised.split_at(1);
    let single = |text: &str| text.chars().count() == 1 && text.chars().all(char::is_alphabetic);
    // Either dⁿ before its variable, or the variable before its power.
    let upper = before == "d" && single(after);
    let lower = after.is_empty() && before.strip_prefix('d').is_some_and(single);
    (upper || lower).then_some((before, power, after))
}

/// A word, or the sign of a side: `g_+`.
fn subscript(text: &str) -> &str {
    match word(text) {
        "" if text.starts_with(['+', '-']) => &text[..1],
        word => word,
    }
}

/// The text with the characters of markup escaped.
pub(super) fn escaped(text: &str) -> String {
    let mut page = String::with_capacity(text.len());
    for character in text.chars() {
        push_escaped(&mut page, character);
    }
    page
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
    fn orders_of_derivatives_are_raised() {
        assert_eq!(
            page("F + m d2U/dt2, d2 and dose2"),
            "F + m d<sup>2</sup>U/dt<sup>2</sup>, d2 and dose2"
        );
        assert_eq!(page("nJ/N^(2.650) or x^(a"), "nJ/N<sup>2.650</sup> or x^(a");
    }

    #[test]
    fn names_stay_names() {
        let text = "sensor_delay, rate_dependent_friction, a_ and 3 ^ 4";
        assert_eq!(page(text), text);
    }
}
