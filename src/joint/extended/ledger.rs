//! Where the work goes in the extended joint: kept by the effects, or dissipated.

use super::laws::{Law, Laws};
use super::quadrature::integral;
use crate::joint::effect::{Place, Situation};

/// Energy account of the effects and of the spring; the network keeps its own.
///
/// For each effect `work = kept + lost`, where the work of a step is
///
/// ```text
/// beside slip    ∫ p(u,0) du + [p(u,v) − p(u,0)] Δu    beside joint   ∫ f(U,0) dU + [f(U,V) − f(U,0)] ΔU
/// spring         ∫ F dδ                                in series      F_old [s(F_old, step) − s_old] + ∫ F ds
/// ```
/// and the kept part is the effect's own [`stored_energy`](crate::joint::Effect::stored_energy), or
/// the integral where the law depends on its argument alone. Losses are added up with their sign,
/// and the dissipation told is their largest sum so far: it never falls, and what a law gives back
/// beyond its stored energy appears as a debt of the stored energy instead of vanishing.
#[derive(Debug, Clone)]
pub(super) struct Ledger {
    /// Loss of network and effects so far, with its sign \[J\].
    lost: f64,
    /// Largest loss so far \[J\].
    dissipation: f64,
    /// Energy that each effect keeps \[J\].
    kept: Vec<f64>,
    /// Displacement of each effect in series \[m\], zero for the others.
    series: Vec<f64>,
    /// Work of the step that is being booked; a place that is made once.
    works: Vec<Work>,
}

/// The two ends of an accepted step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    pub from: Situation,
    pub to: Situation,
}

impl Ledger {
    /// An account at rest under zero force.
    pub fn new(laws: &Laws) -> Ledger {
        let series = laws
            .iter()
            .map(|(law, memory)| match law.acts_at(Place::InSeries) {
                true => law.in_series(0.0, 0.0, memory).value,
                false => 0.0,
            });
        Ledger {
            lost: 0.0,
            dissipation: 0.0,
            kept: vec![0.0; laws.len()],
            series: series.collect(),
            works: vec![Work::default(); laws.len()],
        }
    }

    /// Dissipated since the start \[J\], never falling.
    pub fn dissipation(&self) -> f64 {
        self.dissipation
    }

    /// Kept by the effects \[J\], less any debt.
    pub fn stored(&self) -> f64 {
        self.kept.iter().sum::<f64>() - (self.dissipation - self.lost)
    }

    /// Takes down the work of a step that `laws` have not yet remembered; their stored energy must
    /// still be set against it, see [`Ledger::close`].
    pub fn work(&mut self, laws: &Laws, leg: &Leg) {
        let accounts = self.series.iter_mut().zip(&mut self.works);
        for ((series, work), (law, memory)) in accounts.zip(laws.iter()) {
            *work = Work::default();
            for place in law.places() {
                let one = work_of(place, (law, memory), leg, series);
                work.elastic += one.elastic;
                work.other += one.other;
            }
        }
    }

    /// True while less has been lost than was told before: the difference is owed.
    pub fn owes(&self) -> bool {
        self.dissipation > self.lost
    }

    /// Books the step for good, after the effects have remembered it.
    pub fn close(&mut self, laws: &Laws, now: &Situation, network_loss: f64) {
        self.lost += network_loss;
        let accounts = self.kept.iter_mut().zip(&self.works);
        for ((kept, work), (law, memory)) in accounts.zip(laws.iter()) {
            let next = law
                .stored_energy(now, memory)
                .unwrap_or(*kept + work.elastic);
            self.lost += work.elastic + work.other - (next - *kept);
            *kept = next;
        }
        self.dissipation = self.dissipation.max(self.lost);
    }

    /// Count of numbers of state for this count of effects.
    pub fn state_length(&self) -> usize {
        2 + 2 * self.kept.len()
    }

    /// Appends the account.
    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.lost, self.dissipation]);
        state.extend_from_slice(&self.kept);
        state.extend_from_slice(&self.series);
    }

    /// Puts back what [`Ledger::save`] appended; `state` has [`Ledger::state_length`] numbers.
    pub fn restore(&mut self, state: &[f64]) {
        let count = self.kept.len();
        if let [lost, dissipation, rest @ ..] = state {
            (self.lost, self.dissipation) = (*lost, *dissipation);
            self.kept.copy_from_slice(&rest[..count]);
            self.series.copy_from_slice(&rest[count..]);
        }
    }
}

/// Work done on one effect within a step \[J\].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Work {
    /// Along its law at fixed time and history.
    pub elastic: f64,
    /// All other.
    pub other: f64,
}

fn work_of(place: Place, (law, memory): (&Law, &[f64]), leg: &Leg, series: &mut f64) -> Work {
    let (from, to) = (&leg.from, &leg.to);
    match place {
        Place::BesideSlip => {
            let still = |slip| law.beside_slip((slip, 0.0), memory).value;
            let moving = law.beside_slip((to.slip, to.slip_rate), memory).value;
            beside((from.slip, to.slip), still, moving)
        }
        Place::BesideJoint => {
            let still = |displacement| law.beside_joint(displacement, 0.0).value;
            let moving = law.beside_joint(to.displacement, to.velocity).value;
            beside((from.displacement, to.displacement), still, moving)
        }
        Place::Spring => Work {
            elastic: complement(from.force, to.force, |force| law.spring(force).value),
            other: 0.0,
        },
        Place::InSeries => {
            let over = |force| law.in_series(force, to.step, memory).value;
            let crept = over(from.force) - *series;
            *series = over(to.force);
            Work {
                elastic: complement(from.force, to.force, over),
                other: from.force * crept,
            }
        }
        Place::SlipLimit | Place::ForceChannel | Place::DisplacementChannel => Work::default(),
    }
}

/// Work on a force beside something that goes a way: along its law at rest, and of what its rate adds at the end.
fn beside((from, to): (f64, f64), still: impl Fn(f64) -> f64, moving: f64) -> Work {
    let other = (moving - still(to)) * (to - from);
    Work {
        elastic: integral(from, to, still),
        other,
    }
}

/// `∫ F ds` along a law s(F): what it takes up between two forces.
fn complement(from: f64, to: f64, law: impl Fn(f64) -> f64) -> f64 {
    if from == to {
        return 0.0;
    }
    to * law(to) - from * law(from) - integral(from, to, &law)
}
