//! Which rows hold the numbers that `--columns` looks for.

use super::options::{Choice, Options};
use super::{number, quantity};
use csv::StringRecord;

/// How many of the chosen numbers a row holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Held {
    /// None of them.
    None,
    /// Some: the first row of numbers with a fault in it, or a row above them that happens to have one there.
    Some,
    /// All of them.
    All,
}

/// The chosen columns, and where those stand that are chosen by their names, once a row has shown it.
pub struct Chosen<'a> {
    columns: Vec<(&'a Choice, Option<usize>)>,
}

impl<'a> Chosen<'a> {
    /// Of the options.
    pub fn of(options: &'a Options) -> Chosen<'a> {
        let place = |choice: &Choice| match choice {
            Choice::Number(number) => Some(number - 1),
            Choice::Name(_) => None,
        };
        let columns = options.columns.iter();
        Chosen {
            columns: columns.map(|(_, choice)| (choice, place(choice))).collect(),
        }
    }

    /// What a row holds, below those that were asked about before it.
    pub fn held_by(&mut self, row: &StringRecord) -> Held {
        let mut held = 0;
        for (choice, place) in &mut self.columns {
            if let Choice::Name(wanted) = choice {
                *place = row
                    .iter()
                    .position(|cell| is_called(cell, wanted))
                    .or(*place);
            }
            held += usize::from(match place {
                Some(place) => row.get(*place).is_some_and(number::is_one),
                // A header is still to come, or the name is none of it.
                None => row.iter().any(number::is_one),
            });
        }
        let unseen = self.columns.iter().any(|(_, place)| place.is_none());
        match held {
            0 => Held::None,
            all if all == self.columns.len() && !unseen => Held::All,
            _ => Held::Some,
        }
    }
}

fn is_called(cell: &str, wanted: &str) -> bool {
    let same = |text: &str| quantity::plain(text) == quantity::plain(wanted);
    same(cell) || same(quantity::name_and_unit(cell).0)
}
