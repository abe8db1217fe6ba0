//! The reversals that a network remembers, in a stack of unbounded or of fixed size.

/// A reversal that the network still remembers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turning {
    /// F_r \[N\].
    pub force: f64,
    /// u_r \[m\].
    pub slip: f64,
    /// Loss on the open branches up to here \[J\].
    pub open: f64,
    /// Stored energy here \[J\].
    pub stored: f64,
}

/// Fewest turning points of a bounded stack: the loop to forget lies between two others.
const FEWEST: usize = 4;

/// Reversals from the outermost loop to the innermost; each loop lies within the one before it.
///
/// Without a bound it grows as the history asks. With one its memory is reserved beforehand, for
/// clones too, and nothing is ever allocated afterwards.
#[derive(Debug, PartialEq)]
pub(super) struct Turnings {
    list: Vec<Turning>,
    most: Option<usize>,
}

/// A loop taken out of the stack, and the reversals between which it lay.
#[derive(Debug, Clone, Copy)]
pub(super) struct Forgotten {
    pub outside: Turning,
    pub loop_ends: [Turning; 2],
    pub inside: Turning,
    /// Place of `inside` in the stack now.
    pub place: usize,
}

impl Turnings {
    /// An empty stack of at most `most` turning points (four at least), or without bound.
    pub fn new(most: Option<usize>) -> Turnings {
        let most = most.map(|most| most.max(FEWEST));
        Turnings {
            list: Vec::with_capacity(most.map_or(0, |most| most + 1)),
            most,
        }
    }

    /// Remembers a reversal. Beyond the bound the loop goes that is missed least.
    pub fn remember(&mut self, here: Turning) -> Option<Forgotten> {
        self.list.push(here);
        if self.most.is_none_or(|most| self.list.len() <= most) {
            return None;
        }
        let place = self.missed_least();
        let &[outside, first, second, inside] = self.list.get(place - 1..place + 3)? else {
            return None;
        };
        self.list.drain(place..place + 2);
        Some(Forgotten {
            outside,
            loop_ends: [first, second],
            inside,
            place,
        })
    }

    /// Where the loop begins that lies closest between its neighbours: slip from the reversal before
    /// it to its end, times slip from its beginning to the reversal after it. The gap that it
    /// leaves grows with this product.
    fn missed_least(&self) -> usize {
        let mut least = (f64::INFINITY, 1);
        for (index, four) in self.list.windows(4).enumerate() {
            let gap = (four[0].slip - four[2].slip) * (four[1].slip - four[3].slip);
            if gap.abs() < least.0 {
                least = (gap.abs(), index + 1);
            }
        }
        least.1
    }

    /// Takes `loss` \[J\] off the open branches of all reversals from `place` on.
    pub fn book(&mut self, place: usize, loss: f64) {
        for turning in self.list.iter_mut().skip(place) {
            turning.open -= loss;
        }
    }

    /// All, outermost first.
    pub fn as_slice(&self) -> &[Turning] {
        &self.list
    }

    /// The reversal from which the present branch comes.
    pub fn last(&self) -> Option<&Turning> {
        self.list.last()
    }

    /// Forgets the innermost loop.
    pub fn forget_loop(&mut self) {
        self.list.truncate(self.list.len().saturating_sub(2));
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.list.clear();
    }

    /// True where this count of turning points finds room.
    pub fn holds(&self, count: usize) -> bool {
        self.most.is_none_or(|most| count <= most)
    }

    /// Takes these in place of what was there.
    pub fn replace(&mut self, turnings: impl Iterator<Item = Turning>) {
        self.list.clear();
        self.list.extend(turnings);
    }
}

impl Clone for Turnings {
    fn clone(&self) -> Turnings {
        let mut copy = Turnings::new(self.most);
        copy.replace(self.list.iter().copied());
        copy
    }
}
