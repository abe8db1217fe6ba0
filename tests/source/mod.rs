//! Rust source as text without comments and literals: what the tests of the architecture search.

use std::fs;
use std::path::{Path, PathBuf};

/// A Rust file of the repository.
pub struct SourceFile {
    /// Path from the repository's root, with `/`.
    pub path: String,
    /// The text as it stands.
    text: String,
    /// The text with comments and literals blanked; line numbers unchanged.
    pub code: String,
}

/// The repository's root.
pub fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// All Rust files below a folder of the repository, sorted.
pub fn rust_files(folder: &str) -> Vec<SourceFile> {
    let mut files = Vec::new();
    collect(&root().join(folder), &mut files);
    files.sort_by(|a, b| a.path.cmp(&b.path));
    assert!(!files.is_empty(), "no Rust file below {folder}");
    files
}

fn collect(folder: &Path, files: &mut Vec<SourceFile>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            let path = path
                .strip_prefix(root())
                .unwrap()
                .to_string_lossy()
                .replace('\\', "/");
            files.push(SourceFile {
                path,
                code: blanked(&text),
                text,
            });
        }
    }
}

/// Identifiers of a text, in order.
pub fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .filter(|word| !word.is_empty())
}

impl SourceFile {
    /// File name without extension.
    pub fn stem(&self) -> &str {
        self.path
            .rsplit('/')
            .next()
            .unwrap()
            .trim_end_matches(".rs")
    }

    /// First folder below src/, or the file's own name where it stands there directly.
    pub fn room(&self) -> &str {
        self.path.split('/').nth(1).unwrap().trim_end_matches(".rs")
    }

    /// Count of lines before the tests at the file's end.
    pub fn lines_before_tests(&self) -> usize {
        match self.text.find("\n#[cfg(test)]\nmod ") {
            Some(end) => self.text[..=end].lines().count(),
            None => self.text.lines().count(),
        }
    }

    /// Lines of code with their numbers from 1.
    pub fn code_lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.code
            .lines()
            .enumerate()
            .map(|(index, line)| (index + 1, line))
    }

    fn line_at(&self, position: usize) -> usize {
        self.code[..position].matches('\n').count() + 1
    }

    /// Names that follow `crate::`, grouped imports taken apart, with their lines.
    pub fn crate_paths(&self) -> Vec<(usize, String)> {
        let mut found = Vec::new();
        for (position, _) in self.code.match_indices("crate::") {
            let line = self.line_at(position);
            let rest = &self.code[position + "crate::".len()..];
            for name in heads(rest) {
                found.push((line, name));
            }
        }
        found
    }

    /// First segments of all paths (`name::…`), with their lines.
    pub fn first_segments(&self) -> Vec<(usize, String)> {
        let mut found = Vec::new();
        for (position, _) in self.code.match_indices("::") {
            let before = &self.code[..position];
            let name = before
                .rsplit(|c: char| !(c.is_alphanumeric() || c == '_'))
                .next()
                .unwrap();
            if !name.is_empty() && !before[..before.len() - name.len()].ends_with("::") {
                found.push((self.line_at(position), name.to_string()));
            }
        }
        found
    }

    /// Lines where a chain of `super::` reaches the crate's root.
    pub fn escapes_by_super(&self) -> Vec<usize> {
        let below_src = self.path.split('/').count() - 1;
        let depth = if self.stem() == "mod" {
            below_src - 1
        } else {
            below_src
        };
        let mut lines = Vec::new();
        for (number, line) in self.code_lines() {
            // A module inside the file (its tests) stands one level deeper.
            let before: String = self
                .code
                .lines()
                .take(number - 1)
                .collect::<Vec<_>>()
                .join("\n");
            let inner = before
                .lines()
                .filter(|l| l.starts_with("mod ") && l.ends_with('{'))
                .count();
            let mut chain = 0;
            for word in words(line) {
                chain = if word == "super" { chain + 1 } else { 0 };
                if chain >= depth + inner.min(1) {
                    lines.push(number);
                    break;
                }
            }
        }
        lines
    }
}

/// First names of a path or of the group `{a::b, c}` that a text begins with.
fn heads(rest: &str) -> Vec<String> {
    let Some(group) = rest.strip_prefix('{') else {
        return words(rest).next().map(str::to_string).into_iter().collect();
    };
    let mut names = Vec::new();
    let mut depth = 0;
    let mut item = String::new();
    for c in group.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                names.extend(words(&std::mem::take(&mut item)).next().map(str::to_string))
            }
            _ => {}
        }
        if c != ',' || depth > 0 {
            item.push(c);
        }
    }
    names.extend(words(&item).next().map(str::to_string));
    names
}

/// Source with comments, strings and character literals replaced by spaces.
fn blanked(text: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len());
    let mut i = 0;
    while i < chars.len() {
        let end = literal_end(&chars, i);
        if end > i {
            out.extend(
                chars[i..end]
                    .iter()
                    .map(|c| if *c == '\n' { '\n' } else { ' ' }),
            );
            i = end;
        } else {
            out.push(chars[i]);
            i += 1;
        }
    }
    out
}

/// Where the comment or literal that starts at `i` ends; `i` itself where none starts.
fn literal_end(chars: &[char], i: usize) -> usize {
    let at = |j: usize| chars.get(j).copied().unwrap_or('\0');
    let find = |from: usize, pattern: &[char]| {
        (from..chars.len())
            .find(|&j| chars[j..].starts_with(pattern))
            .map_or(chars.len(), |j| j + pattern.len())
    };
    let in_word = i > 0 && (at(i - 1).is_alphanumeric() || at(i - 1) == '_');
    match at(i) {
        '/' if at(i + 1) == '/' => (i..chars.len())
            .find(|&j| at(j) == '\n')
            .unwrap_or(chars.len()),
        '/' if at(i + 1) == '*' => find(i + 2, &['*', '/']),
        '"' => {
            let mut j = i + 1;
            while j < chars.len() && at(j) != '"' {
                j += if at(j) == '\\' { 2 } else { 1 };
            }
            (j + 1).min(chars.len())
        }
        'r' if !in_word
            && (at(i + 1) == '"' || (at(i + 1) == '#' && matches!(at(i + 2), '#' | '"'))) =>
        {
            let hashes = (i + 1..).take_while(|&j| at(j) == '#').count();
            let mut close = vec!['"'];
            close.extend(std::iter::repeat_n('#', hashes));
            find(i + 2 + hashes, &close)
        }
        '\'' if at(i + 1) == '\\' => find(i + 3, &['\'']),
        '\'' if at(i + 2) == '\'' => i + 3,
        _ => i,
    }
}

#[test]
fn comments_and_literals_are_blanked() {
    let code =
        "a::b // crate::c\n/* crate::d */ let e = \"crate::f \\\" x\"; 'g' 'h: r#\"crate::i\"# 'j'";
    let left = blanked(code);
    assert_eq!(left.len(), code.len());
    assert!(!left.contains("crate"));
    assert_eq!(
        words(&left).collect::<Vec<_>>(),
        ["a", "b", "let", "e", "h"]
    );
}

#[test]
fn grouped_imports_are_taken_apart() {
    assert_eq!(heads("joint::Joint;"), ["joint"]);
    assert_eq!(
        heads("{joint::{A, B}, record, self::x};"),
        ["joint", "record", "self"]
    );
}
