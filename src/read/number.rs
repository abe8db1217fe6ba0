//! A cell as a number, with decimal point or decimal comma, never both in one file.

/// The decimal mark that a file has shown so far.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Only whole numbers so far.
    Unseen,
    /// `1.5`
    Point,
    /// `1,5`
    Comma,
}

/// Why a cell is no number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// Nothing in it.
    Empty,
    /// Text; with what may have happened and the way out, `; …`.
    Text(&'static str),
    /// NaN, infinite, or beyond a double.
    NotFinite,
}

const MIXED: &str =
    "; this file mixes decimal points and decimal commas: write all numbers with one of them";
const THOUSANDS: &str = "; separators of thousands are not understood: remove them";
const POWER: &str = "; write powers of ten with `e`, such as 1.5e-3";
const OTHER: &str = "; correct the cell, or cut the record there";

/// The number in a cell; `mark` remembers the file's decimal mark.
pub fn parse(cell: &str, mark: &mut Mark) -> Result<f64, Fault> {
    let cell = bare(cell);
    let (number, shown) = match cell.parse::<f64>() {
        Ok(number) => (number, cell.contains('.').then_some(Mark::Point)),
        Err(_) if cell.is_empty() => return Err(Fault::Empty),
        Err(_) => (with_comma(cell)?, Some(Mark::Comma)),
    };
    if let Some(shown) = shown {
        if *mark != Mark::Unseen && *mark != shown {
            return Err(Fault::Text(MIXED));
        }
        *mark = shown;
    }
    if number.is_finite() {
        Ok(number)
    } else {
        Err(Fault::NotFinite)
    }
}

/// A cell without the space around it, nor the quotes that a space before them has kept.
pub fn bare(cell: &str) -> &str {
    let cell = cell.trim();
    let quoted = cell.strip_prefix('"').and_then(|c| c.strip_suffix('"'));
    quoted.map_or(cell, str::trim)
}

/// True for a cell that reads as a number, finite or not.
pub fn is_one(cell: &str) -> bool {
    matches!(
        parse(cell, &mut Mark::Unseen),
        Ok(_) | Err(Fault::NotFinite)
    )
}

fn with_comma(cell: &str) -> Result<f64, Fault> {
    let commas = cell.bytes().filter(|byte| *byte == b',').count();
    let pointed = cell.replace(',', ".");
    if commas == 1
        && !cell.contains('.')
        && let Ok(number) = pointed.parse()
    {
        return Ok(number);
    }
    let digits_only = cell
        .bytes()
        .all(|b| b.is_ascii_digit() || b".,+-eE '".contains(&b));
    let is_grouped = digits_only && (commas > 0 || cell.contains([' ', '\'']));
    let with_e = pointed.replace(['D', 'd'], "e").parse::<f64>();
    Err(Fault::Text(match with_e {
        _ if is_grouped => THOUSANDS,
        Ok(_) => POWER,
        Err(_) => OTHER,
    }))
}

/// A number for a message: with few digits far from one.
pub fn written(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-4..1e6 => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// A cell for a message: trimmed, and shortened where it is long.
pub fn shown(cell: &str) -> String {
    let cell = cell.trim();
    match cell.char_indices().nth(40) {
        Some((end, _)) => format!("{}…", &cell[..end]),
        None => cell.to_string(),
    }
}
