//! The inner loops of a march, 16 operators at a time: sums run in 16 lanes whose order is fixed, so
//! that every processor gives the same digits, and are compiled for the widest vectors it has.

use super::bonds::Bonds;
use pulp::{Arch, NullaryFnOnce};

/// Operators handled together; a bank is filled up to a multiple of it.
pub const LANES: usize = 16;

pub(super) type Lanes = [f64; LANES];

/// The operators of one march as plays, by column: a stop is its input less the play of the same threshold.
#[derive(Debug, Clone)]
pub struct Bank {
    arch: Arch,
    thresholds: Vec<Lanes>,
    weights: Vec<Lanes>,
    positions: Vec<Lanes>,
    trial: Vec<Lanes>,
    /// What is left of each operator's excess, where those that rest hold more.
    bonds: Option<Bonds>,
    /// True where nobody asks for tangents.
    explicit: bool,
    /// Plays whose limits never move.
    still: Option<Still>,
}

/// What plays whose limits never move need not be asked again: those that move with the input are the least
/// thresholds, up to one.
#[derive(Debug, Clone)]
struct Still {
    /// `Σ c P` at the last accepted sample of each group of operators and those behind it, by lane.
    from_here: Vec<Lanes>,
    /// Groups that the last trial moved.
    moved: usize,
}

#[inline(always)]
fn lower(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn upper(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

#[inline(always)]
pub(super) fn total(lanes: Lanes) -> f64 {
    let (mut sum, mut half) = (lanes, LANES / 2);
    while half > 0 {
        for i in 0..half {
            sum[i] += sum[i + half];
        }
        half /= 2;
    }
    sum[0]
}

impl Bank {
    /// Virgin operators with the given thresholds and weights, filled up with some of no weight.
    pub fn new(operators: impl Iterator<Item = (f64, f64)>) -> Bank {
        let (mut thresholds, mut weights) = (Vec::new(), Vec::new());
        for (i, (threshold, weight)) in operators.enumerate() {
            if i % LANES == 0 {
                thresholds.push([0.0; LANES]);
                weights.push([0.0; LANES]);
            }
            thresholds[i / LANES][i % LANES] = threshold;
            weights[i / LANES][i % LANES] = weight;
        }
        Bank {
            arch: Arch::new(),
            positions: vec![[0.0; LANES]; thresholds.len()],
            trial: vec![[0.0; LANES]; thresholds.len()],
            thresholds,
            weights,
            bonds: None,
            explicit: false,
            still: None,
        }
    }

    /// The bank, virgin still, whose thresholds increase, none of which holds more while it rests, and whose
    /// limits will always be `(1, 1)`.
    pub fn still(mut self) -> Bank {
        self.still = Some(Still {
            from_here: vec![[0.0; LANES]; self.thresholds.len() + 1],
            moved: 0,
        });
        self
    }

    /// The bank where its input is known beforehand: tangents are not asked for, and need not be right.
    pub fn explicit(mut self, explicit: bool) -> Bank {
        self.explicit = explicit;
        self
    }

    /// The bank, virgin still, of operators that hold more by this share while they rest.
    pub fn sticking(mut self, excess: f64) -> Bank {
        self.bonds = (excess > 0.0).then(|| Bonds::new(excess, self.thresholds.len()));
        self
    }

    /// Σ c over the operators.
    pub fn weight(&self) -> f64 {
        self.weights.as_flattened().iter().sum()
    }

    /// Positions at the last accepted sample, in the order of the thresholds.
    pub fn positions(&self) -> &[f64] {
        self.positions.as_flattened()
    }

    fn columns_mut(&mut self) -> (Arch, Columns<'_>, Option<&mut Bonds>) {
        let columns = Columns {
            thresholds: &self.thresholds,
            weights: &self.weights,
            positions: &self.positions,
            trial: &mut self.trial,
        };
        (self.arch, columns, self.bonds.as_mut())
    }

    /// Plays tried at an input: Σ c P and its tangent; `limits` scale the thresholds by direction.
    pub fn plays(&mut self, input: f64, limits: (f64, f64)) -> (f64, f64) {
        let explicit = self.explicit;
        if let Some(still) = &mut self.still {
            let rests = |(p, r): (&Lanes, &Lanes)| (input - p[0]).abs() <= r[0];
            let mut groups = self.positions.iter().zip(&self.thresholds);
            still.moved = groups.position(rests).unwrap_or(self.thresholds.len());
            let behind = &still.from_here[still.moved];
            let columns = Columns {
                thresholds: &self.thresholds[..still.moved],
                weights: &self.weights[..still.moved],
                positions: &self.positions[..still.moved],
                trial: &mut self.trial[..still.moved],
            };
            return self
                .arch
                .dispatch(Plays(columns, input, limits, (explicit, behind)));
        }
        let (arch, columns, bonds) = self.columns_mut();
        match bonds {
            None => arch.dispatch(Plays(columns, input, limits, (explicit, &[0.0; LANES]))),
            Some(bonds) => arch.dispatch(bonds.plays(columns, input, limits)),
        }
    }

    /// Energy that accepting the plays last tried dissipates \[J\].
    pub fn slid_plays(&mut self, limits: (f64, f64)) -> f64 {
        let moved = self.still.as_ref().map_or(self.trial.len(), |s| s.moved);
        let (arch, mut columns, _) = self.columns_mut();
        columns.trial = &mut columns.trial[..moved];
        arch.dispatch(SlidPlays(columns, limits))
    }

    /// Accepts what was last tried.
    pub fn accept(&mut self) {
        if let Some(still) = &mut self.still {
            let moved = still.moved;
            self.positions[..moved].copy_from_slice(&self.trial[..moved]);
            let operators = (&self.positions[..moved], &self.weights[..moved]);
            return self
                .arch
                .dispatch(FromHere(operators, &mut still.from_here));
        }
        let (arch, columns, bonds) = self.columns_mut();
        if let Some(bonds) = bonds {
            bonds.wear(arch, columns);
        }
        std::mem::swap(&mut self.positions, &mut self.trial);
    }
}

/// The columns of a bank, and the one that a trial fills.
pub(super) struct Columns<'a> {
    pub thresholds: &'a [Lanes],
    pub weights: &'a [Lanes],
    pub positions: &'a [Lanes],
    pub trial: &'a mut [Lanes],
}

struct Plays<'a>(Columns<'a>, f64, (f64, f64), (bool, &'a Lanes));

impl NullaryFnOnce for Plays<'_> {
    type Output = (f64, f64);

    #[inline(always)]
    fn call(self) -> (f64, f64) {
        let Plays(at, input, (up, down), (explicit, behind)) = self;
        // Separate loops: one that does everything is vectorised across its two sums, two wide.
        let moves = at
            .positions
            .as_flattened()
            .iter()
            .zip(at.thresholds.as_flattened());
        for (t, (p, r)) in at.trial.as_flattened_mut().iter_mut().zip(moves) {
            *t = lower(upper(*p, input - r * up), input + r * down);
        }
        let tangent = match explicit {
            true => 0.0,
            false => moved(at.trial, at.positions, at.weights),
        };
        (total(added(*behind, at.trial, at.weights)), tangent)
    }
}

/// Brings the sums of the groups that moved, and of those before them, up to date.
struct FromHere<'a>((&'a [Lanes], &'a [Lanes]), &'a mut [Lanes]);

impl NullaryFnOnce for FromHere<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let FromHere((positions, weights), from_here) = self;
        let mut sum = from_here[positions.len()];
        for ((p, w), from) in positions.iter().zip(weights).zip(from_here).rev() {
            for i in 0..LANES {
                sum[i] += w[i] * p[i];
            }
            *from = sum;
        }
    }
}

#[inline(always)]
pub(super) fn sum(trial: &[Lanes], weights: &[Lanes]) -> f64 {
    total(added([0.0; LANES], trial, weights))
}

/// Lanes with weighted positions added.
#[inline(always)]
fn added(mut output: Lanes, trial: &[Lanes], weights: &[Lanes]) -> Lanes {
    for (t, w) in trial.iter().zip(weights) {
        for i in 0..LANES {
            output[i] += w[i] * t[i];
        }
    }
    output
}

/// Weights of the operators whose position changed.
#[inline(always)]
fn moved(trial: &[Lanes], positions: &[Lanes], weights: &[Lanes]) -> f64 {
    let mut tangent = [0.0; LANES];
    for ((t, p), w) in trial.iter().zip(positions).zip(weights) {
        for i in 0..LANES {
            tangent[i] += if t[i] != p[i] { w[i] } else { 0.0 };
        }
    }
    total(tangent)
}

struct SlidPlays<'a>(Columns<'a>, (f64, f64));

impl NullaryFnOnce for SlidPlays<'_> {
    type Output = f64;

    #[inline(always)]
    fn call(self) -> f64 {
        let SlidPlays(at, (up, down)) = self;
        let mut sum = [0.0; LANES];
        for (((t, p), r), c) in at
            .trial
            .iter()
            .zip(at.positions)
            .zip(at.thresholds)
            .zip(at.weights)
        {
            for i in 0..LANES {
                let moved = t[i] - p[i];
                sum[i] += c[i] * r[i] * upper(moved * up, -moved * down);
            }
        }
        total(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Forty operators and inputs drawn afresh for each of them: output, tangent and energy are those of a bank that asks
    /// every operator.
    #[test]
    fn plays_whose_limits_never_move_need_not_all_be_asked() {
        let mut drawn = crate::record::noise::tests::drawn(20261126);
        let mut noise = || 2.0 * drawn() - 1.0;
        let operators = || (1..=40).map(|j| (0.1 * f64::from(j), 1.0 + f64::from(j * j % 7)));
        let (mut all, mut still) = (Bank::new(operators()), Bank::new(operators()).still());
        let limits = (1.0, 1.0);
        let mut rested = 0;
        for _ in 0..2000 {
            // A trial that is not accepted leaves nothing behind.
            still.plays(2.0 * noise(), limits);
            let input = 2.0 * noise();
            let (one, other) = (all.plays(input, limits), still.plays(input, limits));
            assert!((one.0 - other.0).abs() < 1e-9 && (one.1 - other.1).abs() < 1e-9);
            let slid = all.slid_plays(limits) - still.slid_plays(limits);
            assert!(slid.abs() < 1e-9, "{slid}");
            let moved = still.still.as_ref().map_or(0, |s| s.moved);
            rested += usize::from(moved < still.thresholds.len());
            all.accept();
            still.accept();
            let both = all.positions().iter().zip(still.positions()).take(40);
            both.for_each(|(a, b)| assert!((a - b).abs() < 1e-12));
        }
        assert!(rested > 100, "{rested} steps left operators alone");
    }
}
