//! What the user says about a foreign file: `--columns` and `--units`.

use super::error::ReadError;
use super::quantity::{self, Quantity};
use super::unit::{self, Unit};

/// Where a quantity stands in a foreign file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Choice {
    /// Column number, counted from 1.
    Number(usize),
    /// The header's text, with or without its unit.
    Name(String),
}

impl std::fmt::Display for Choice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Choice::Number(number) => write!(f, "{number}"),
            Choice::Name(name) => write!(f, "`{name}`"),
        }
    }
}

/// What is known of a file beyond its header. The default trusts the header.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Options {
    /// Columns to take; others are found by their header.
    pub columns: Vec<(Quantity, Choice)>,
    /// Units, which prevail over the header's.
    pub units: Vec<(Quantity, &'static Unit)>,
}

impl Options {
    /// From the command line: `force=2,displacement=1` (columns counted from 1, or header texts)
    /// and `force=kN,displacement=mm`.
    ///
    /// # Errors
    /// [`ReadError::Option`] for an entry that is no `quantity=value`, a quantity or unit that is
    /// not known, one given twice, column 0; an option without any entry.
    pub fn from_arguments(
        columns: Option<&str>,
        units: Option<&str>,
    ) -> Result<Options, ReadError> {
        let columns = entries("--columns", columns, |_, value| {
            match value.parse::<usize>() {
                Ok(0) => Err("columns are counted from 1".to_string()),
                Ok(number) => Ok(Choice::Number(number)),
                Err(_) => Ok(Choice::Name(value.to_string())),
            }
        })?;
        let units = entries("--units", units, |quantity, value| {
            unit::find(value, quantity.dimension()).ok_or_else(|| {
                let known = unit::known(quantity);
                format!(
                    "unknown unit `{value}` for {}; known: {known}",
                    quantity.name()
                )
            })
        })?;
        Ok(Options { columns, units })
    }

    /// The unit given for that quantity.
    pub(super) fn unit(&self, quantity: Quantity) -> Option<&'static Unit> {
        self.units
            .iter()
            .find(|(of, _)| *of == quantity)
            .map(|(_, unit)| *unit)
    }
}

/// `a=1,b=2` taken apart, each value read by `value_of`.
fn entries<T>(
    option: &'static str,
    text: Option<&str>,
    value_of: impl Fn(Quantity, &str) -> Result<T, String>,
) -> Result<Vec<(Quantity, T)>, ReadError> {
    let mut found: Vec<(Quantity, T)> = Vec::new();
    let Some(text) = text else {
        return Ok(found);
    };
    for entry in text.split(',').map(str::trim).filter(|e| !e.is_empty()) {
        let refuse = |reason: String| ReadError::Option {
            option,
            text: entry.to_string(),
            reason,
        };
        let (name, value) = entry
            .split_once('=')
            .ok_or_else(|| refuse("write quantity=value, such as force=2".to_string()))?;
        let quantity = Quantity::named(name, Some(value)).ok_or_else(|| {
            let known = Quantity::ALL.map(Quantity::name).join(", ");
            refuse(format!(
                "`{}` is no quantity; known: {known}",
                quantity::plain(name)
            ))
        })?;
        if found.iter().any(|(of, _)| *of == quantity) {
            return Err(refuse(format!("{} is given twice", quantity.name())));
        }
        found.push((quantity, value_of(quantity, value.trim()).map_err(refuse)?));
    }
    if found.is_empty() {
        return Err(ReadError::Option {
            option,
            text: text.to_string(),
            reason: "nothing is named; write quantity=value, such as force=2, or leave it out"
                .to_string(),
        });
    }
    Ok(found)
}
