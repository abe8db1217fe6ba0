//! Which column holds what, in which unit.

use super::error::ReadError;
use super::head::Head;
use super::options::{Choice, Options};
use super::quantity::{self, Quantity};
use super::source::Source;
use super::spot::Spot;
use super::unit::{self, Unit};

/// A column that will be read.
#[derive(Debug, Clone)]
pub struct Column {
    /// What it holds.
    pub quantity: Quantity,
    /// Its place, from 0.
    pub index: usize,
    /// Its header, or the quantity's name where there is none.
    pub name: String,
    /// Its unit.
    pub unit: &'static Unit,
}

/// A table's columns as header or options name them, before units are looked at.
pub struct Layout<'a> {
    source: &'a Source,
    head: &'a Head,
    options: &'a Options,
    found: Vec<(Quantity, usize)>,
}

impl<'a> Layout<'a> {
    /// Matches the choices of `--columns`, and then the other header cells, to quantities. Of each pair in
    /// `apart` the second is not looked for where the first was chosen: it would change what the table is taken for.
    ///
    /// # Errors
    /// [`ReadError::Twice`], [`ReadError::NoSuchColumn`], [`ReadError::SameColumn`].
    pub fn new(
        source: &'a Source,
        head: &'a Head,
        options: &'a Options,
        apart: &[(Quantity, Quantity)],
    ) -> Result<Layout<'a>, ReadError> {
        let mut layout = Layout {
            source,
            head,
            options,
            found: Vec::new(),
        };
        for (quantity, choice) in &options.columns {
            let index = layout.chosen(*quantity, choice)?;
            if let Some((first, _)) = layout.found.iter().find(|(_, taken)| *taken == index) {
                return Err(ReadError::SameColumn {
                    spot: layout.spot(index),
                    first: *first,
                    second: *quantity,
                });
            }
            layout.found.push((*quantity, index));
        }
        let excluded: Vec<Quantity> = apart
            .iter()
            .filter(|(chosen, _)| layout.has(*chosen))
            .map(|(_, other)| *other)
            .collect();
        let chosen: Vec<usize> = layout.found.iter().map(|(_, index)| *index).collect();
        for quantity in Quantity::ALL {
            if layout.has(quantity) || excluded.contains(&quantity) {
                continue;
            }
            if let Some(index) = layout.in_header(quantity, &chosen)? {
                layout.found.push((quantity, index));
            }
        }
        Ok(layout)
    }

    /// True where a column holds that quantity.
    pub fn has(&self, quantity: Quantity) -> bool {
        self.found.iter().any(|(of, _)| *of == quantity)
    }

    /// The columns of `required`, which must be there, and those of `optional` that are and have
    /// a unit. Says in `notes` which columns are left out.
    ///
    /// # Errors
    /// [`ReadError::MissingColumn`]; [`ReadError::MissingUnit`], [`ReadError::UnknownUnit`] for
    /// the required ones and for time, unless others are chosen and time is not.
    pub fn columns(
        &self,
        required: &[Quantity],
        optional: &[Quantity],
        notes: &mut Vec<String>,
    ) -> Result<Vec<Column>, ReadError> {
        if let Some(missing) = required.iter().find(|quantity| !self.has(**quantity)) {
            return Err(self.missing(missing.name()));
        }
        let (mut columns, mut left_out) = (Vec::<Column>::new(), Vec::new());
        for (quantity, index) in &self.found {
            // Who chooses columns and leaves time out has said how much of it is needed.
            let asked = self.options.columns.is_empty();
            let asked = asked || self.options.columns.iter().any(|(of, _)| of == quantity);
            let is_needed = required.contains(quantity) || *quantity == Quantity::Time && asked;
            let is_of_use = *quantity == Quantity::Time || optional.contains(quantity);
            if !is_needed && !is_of_use {
                continue;
            }
            match self.unit(*quantity, *index) {
                Ok(unit) => {
                    notes.extend(self.remark(*quantity, *index, unit));
                    let name = match self.head.names.is_empty() {
                        true => quantity.name().to_string(),
                        false => self.name(*index),
                    };
                    columns.push(Column {
                        quantity: *quantity,
                        index: *index,
                        name,
                        unit,
                    });
                }
                Err(error) if is_needed => return Err(error),
                Err(error) => {
                    notes.push(format!("left out: {error}"));
                    left_out.push(*index);
                }
            }
        }
        let named = self
            .head
            .names
            .iter()
            .enumerate()
            .filter(|(_, name)| !name.is_empty());
        let ignored: Vec<String> = named
            .filter(|(index, _)| !columns.iter().any(|c| c.index == *index))
            .filter(|(index, _)| !left_out.contains(index))
            .map(|(_, name)| format!("`{name}`"))
            .collect();
        if !ignored.is_empty() {
            notes.push(format!("columns not used: {}", ignored.join(", ")));
        }
        Ok(columns)
    }

    /// The error for a column that is not there.
    pub fn missing(&self, wanted: &str) -> ReadError {
        ReadError::MissingColumn {
            file: self.source.file.clone(),
            line: self.head.line,
            wanted: wanted.to_string(),
            found: self.all_names(),
        }
    }

    fn all_names(&self) -> String {
        let columns = 0..self.head.width;
        columns
            .map(|i| format!("{} `{}`", i + 1, self.name(i)))
            .collect::<Vec<_>>()
            .join(", ")
    }

    fn name(&self, index: usize) -> String {
        self.head
            .names
            .get(index)
            .cloned()
            .unwrap_or_else(|| format!("column {}", index + 1))
    }

    fn spot(&self, index: usize) -> Spot {
        let file = self.source.file.clone();
        Spot {
            file,
            line: self.head.line,
            column: index + 1,
            name: self.name(index),
        }
    }

    /// The column whose header names the quantity, the `chosen` ones left out; the contract's own name before
    /// its aliases.
    fn in_header(&self, quantity: Quantity, chosen: &[usize]) -> Result<Option<usize>, ReadError> {
        let mut matching = Vec::new();
        let cells = self.head.names.iter().enumerate();
        for (index, cell) in cells.filter(|(index, _)| !chosen.contains(index)) {
            let (name, in_cell) = quantity::name_and_unit(cell);
            let below = self.head.units.get(index).map(|cell| bare(cell));
            if Quantity::named(name, in_cell.or(below)) == Some(quantity) {
                matching.push((index, quantity::plain(name) == quantity.name()));
            }
        }
        let has_own_name = matching.iter().any(|(_, is_own)| *is_own);
        matching.retain(|(_, is_own)| *is_own == has_own_name);
        match matching[..] {
            [] => Ok(None),
            [(index, _)] => Ok(Some(index)),
            [(first, _), (second, _), ..] => Err(ReadError::Twice {
                second: self.spot(second),
                first: first + 1,
                first_name: self.name(first),
                quantity,
            }),
        }
    }

    fn chosen(&self, quantity: Quantity, choice: &Choice) -> Result<usize, ReadError> {
        let index = match choice {
            Choice::Number(number) => Some(number - 1).filter(|index| *index < self.head.width),
            Choice::Name(wanted) => self.called(quantity, wanted)?,
        };
        index.ok_or_else(|| ReadError::NoSuchColumn {
            file: self.source.file.clone(),
            line: self.head.line,
            quantity,
            choice: choice.to_string(),
            found: self.all_names(),
        })
    }

    /// The column whose whole header that is, or else the one that is called so, its unit left out; `None` where none is.
    fn called(&self, quantity: Quantity, wanted: &str) -> Result<Option<usize>, ReadError> {
        let same = |text: &str| quantity::plain(text) == quantity::plain(wanted);
        let cells = || self.head.names.iter().enumerate();
        let whole = cells().find(|(_, cell)| same(cell));
        let mut called = cells().filter(|(_, cell)| same(quantity::name_and_unit(cell).0));
        match (whole, called.next(), called.next()) {
            (Some((index, _)), ..) | (None, Some((index, _)), None) => Ok(Some(index)),
            (None, Some((first, _)), Some((second, _))) => Err(ReadError::Twice {
                second: self.spot(second),
                first: first + 1,
                first_name: self.name(first),
                quantity,
            }),
            (None, None, _) => Ok(None),
        }
    }

    fn unit_in_header(&self, index: usize) -> Option<&str> {
        let cell = self.head.names.get(index)?;
        quantity::name_and_unit(cell).1
    }

    /// Unit in the header cell, else in the row below it.
    fn written_unit(&self, index: usize) -> Option<&str> {
        let below = self.head.units.get(index).map(|cell| bare(cell));
        let written = self.unit_in_header(index).or(below);
        written.filter(|unit| !unit.is_empty())
    }

    /// The column, at the line where its unit is to be corrected.
    fn spot_of_unit(&self, index: usize) -> Spot {
        let line = match self.unit_in_header(index) {
            Some(_) => self.head.line,
            None => self.head.units_line,
        };
        Spot {
            line,
            ..self.spot(index)
        }
    }

    /// What to say of a column's unit, if anything.
    fn remark(&self, quantity: Quantity, index: usize, unit: &Unit) -> Option<String> {
        if let Some(remark) = unit.remark {
            return Some(format!("{}: {remark}", self.name(index)));
        }
        let other = self.written_unit(index).filter(|written| {
            self.options.unit(quantity).is_some()
                && unit::find(written, quantity.dimension()) != Some(unit)
        })?;
        let name = self.name(index);
        Some(format!(
            "{name}: read in {} as --units says, not in {other}",
            unit.spelling
        ))
    }

    /// Unit by `--units`, else by the header cell, else by the row below it.
    fn unit(&self, quantity: Quantity, index: usize) -> Result<&'static Unit, ReadError> {
        if let Some(unit) = self.options.unit(quantity) {
            return Ok(unit);
        }
        let Some(written) = self.written_unit(index) else {
            return Err(ReadError::MissingUnit {
                spot: self.spot(index),
                quantity,
                example: quantity.example_unit(),
            });
        };
        unit::find(written, quantity.dimension()).ok_or_else(|| ReadError::UnknownUnit {
            spot: self.spot_of_unit(index),
            unit: written.to_string(),
            measures: unit::measures(written).map(unit::Dimension::name),
            quantity,
        })
    }
}

/// A unit cell without brackets.
fn bare(cell: &str) -> &str {
    let (name, bracketed) = quantity::name_and_unit(cell);
    bracketed.unwrap_or(name)
}
