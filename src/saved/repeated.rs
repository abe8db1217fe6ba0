//! Names that stand twice in one object of a JSON text, where a parser keeps the last and says nothing.

use std::collections::BTreeSet;

/// A name that stands twice.
#[derive(Debug, PartialEq)]
pub struct Repeated {
    /// JSON path.
    pub place: String,
    /// Line and column of the second, from 1.
    pub line: usize,
    pub column: usize,
}

/// An object with the names read so far, or a list, and what of it is being read.
enum Level {
    Object {
        names: BTreeSet<String>,
        name: String,
        named: bool,
    },
    List {
        item: usize,
    },
}

/// The first name that stands twice in its object; `text` is well-formed JSON.
pub fn repeated(text: &str) -> Option<Repeated> {
    let mut levels: Vec<Level> = Vec::new();
    let mut from = 0;
    while let Some(found) = text[from..].find(['{', '[', '}', ']', ',', '"']) {
        let at = from + found;
        from = at + 1;
        match (text.as_bytes()[at], levels.last_mut()) {
            (b'{', _) => levels.push(Level::Object {
                names: BTreeSet::new(),
                name: String::new(),
                named: false,
            }),
            (b'[', _) => levels.push(Level::List { item: 0 }),
            (b'}' | b']', _) => drop(levels.pop()),
            (b',', Some(Level::List { item })) => *item += 1,
            (b',', Some(Level::Object { named, .. })) => *named = false,
            (b'"', level) => {
                from = after_string(text, at);
                if let Some(Level::Object { names, name, named }) = level
                    && !*named
                {
                    // As a parser reads it: `\u0061` is an a.
                    *name = serde_json::from_str(&text[at..from]).ok()?;
                    *named = true;
                    if !names.insert(name.clone()) {
                        let line = text[..at].rsplit('\n').next().unwrap_or_default();
                        return Some(Repeated {
                            place: place(&levels),
                            line: text[..at].matches('\n').count() + 1,
                            column: line.chars().count() + 1,
                        });
                    }
                }
            }
            _ => (),
        }
    }
    None
}

/// Where the string that begins at this quote has ended.
fn after_string(text: &str, quote: usize) -> usize {
    let mut escaped = false;
    let end = text.bytes().skip(quote + 1).position(|byte| {
        let ends = byte == b'"' && !escaped;
        escaped = byte == b'\\' && !escaped;
        ends
    });
    end.map_or(text.len(), |length| quote + 1 + length + 1)
}

fn place(levels: &[Level]) -> String {
    let steps = levels.iter().map(|level| match level {
        Level::Object { name, .. } => format!(".{name}"),
        Level::List { item } => format!("[{item}]"),
    });
    format!("${}", steps.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_refused_where_it_stands_twice_and_there_only() {
        let found = |text: &str| {
            let value: Result<serde_json::Value, _> = serde_json::from_str(text);
            assert!(value.is_ok(), "{text}");
            repeated(text).map(|twice| (twice.place, twice.line, twice.column))
        };
        for text in [
            "{}",
            "3",
            r#""a""#,
            r#"{"a": {"a": 1}, "b": {"a": 1}, "c": [{"a": "a"}, {"a": "b"}, ["a", "a"]]}"#,
            r#"{"a": "\"a\": 1, \"a\": {", "b": "a", "\\": 1, "c": ",\\"}"#,
        ] {
            assert_eq!(found(text), None, "{text}");
        }
        for (text, place, line, column) in [
            (r#"{"a": 1, "a": 1}"#, "$.a", 1, 10),
            ("{\"a\": 1,\n  \"\\u0061\": 2}", "$.a", 2, 3),
            (
                r#"{"ü": [[], {"b": [1, 2], "c": 0, "b": 3}]}"#,
                "$.ü[1].b",
                1,
                34,
            ),
            (r#"[{"a": 1}, {"a": {"x": "}"}, "a": 1}]"#, "$[1].a", 1, 30),
        ] {
            assert_eq!(found(text), Some((place.into(), line, column)), "{text}");
        }
    }
}
