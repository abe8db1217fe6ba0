//! What a joint went through before its tests, sought by all records together: a pull at its assembly, or a cycle.
//!
//! Such a joint is at rest where its records begin, and no virgin one. One record alone hardly shows it: its first cycles
//! are few, and a joint is soon found that suits them.

use super::beginning::{Beginning, at_zero, wins};
use super::fit::least_misfit;
use super::gone_on::{begun, in_order};
use super::past::finely_moved;
use super::problem::Problem;
use rayon::prelude::*;

/// Largest load before the tests over the largest in them, as tried.
const SHARES: [f64; 5] = [0.35, 0.6, 0.85, 1.1, 1.5];

/// Independent samples by which the load before is sought.
const ENOUGH: usize = 1500;

/// The other beginnings of the records, and the one behind a load before the tests that all records tell of, where that
/// leaves less than virgin joints do: before the others, where it leaves less than these. Behind one of a joint that goes on
/// the same without such a load, whose work a cause may do.
///
/// Either each record is of a joint that was made new and went through the same, or the joint of the first goes on. A
/// single turn is sought, or two to either side of rest; records that do not begin at zero have pasts of their own.
pub(super) fn before_all(problem: &Problem, others: Vec<Vec<Beginning>>) -> Vec<Vec<Beginning>> {
    if !(0..problem.records.len()).all(|k| at_zero(problem.channels(k).0)) {
        return others;
    }
    let few = problem.coarser((ENOUGH, ENOUGH));
    let few = few.as_ref().unwrap_or(problem);
    let left = |beginnings: &[Beginning]| least_misfit(&begun(few, beginnings));
    let loads = loads(few);
    let tried = loads.par_iter().flat_map(|load| {
        let orders = orders(few);
        orders.into_par_iter().map(move |order| (load, order))
    });
    let tried = tried.map(|(load, order)| (left(&order.beginnings(few, load)), load, order));
    let Some((_, load, order)) = tried.min_by(|(a, ..), (b, ..)| a.total_cmp(b)) else {
        return others;
    };
    let (least, load) = finely_moved(load.clone(), |load| left(&order.beginnings(few, load)));
    let samples = few.independent_rows();
    let is_beaten = |other: &[Beginning]| wins(least, left(other), samples);
    if !is_beaten(&vec![Beginning::default(); problem.records.len()]) {
        return others;
    }
    let mut all = others;
    let place = all.iter().position(|other| is_beaten(other));
    let place = place.unwrap_or(all.len());
    all.insert(place, order.beginnings(problem, &load));
    // What a cause does may pass for a load before a joint that goes on without one.
    if let Order::GoesOn = order {
        let without = order.beginnings(problem, &Beginning::default());
        if !all.contains(&without) {
            all.insert(place + 1, without);
        }
    }
    all
}

/// Loads before the tests: one turn, or as far the other way first.
fn loads(problem: &Problem) -> Vec<Beginning> {
    let inputs = (0..problem.records.len()).flat_map(|k| problem.channels(k).0);
    let largest = inputs.fold(0.0_f64, |most, x| most.max(x.abs()));
    let turns = SHARES
        .into_iter()
        .flat_map(|share| [share * largest, -share * largest]);
    let loads = turns.flat_map(|turn| [vec![turn], vec![-turn, turn]]);
    loads.map(Beginning::behind).collect()
}

/// Whose load it was.
#[derive(Clone, Copy)]
enum Order {
    /// That of each joint, one for every record.
    Anew,
    /// That of the one joint, before the first of its records.
    GoesOn,
}

impl Order {
    fn beginnings(self, problem: &Problem, load: &Beginning) -> Vec<Beginning> {
        let count = problem.records.len();
        match self {
            Order::Anew => vec![load.clone(); count],
            Order::GoesOn => in_order(problem, load, &vec![false; count]),
        }
    }
}

/// A single record has no order.
fn orders(problem: &Problem) -> Vec<Order> {
    match problem.records.len() {
        1 => vec![Order::Anew],
        _ => vec![Order::Anew, Order::GoesOn],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::Form;
    use crate::record::Record;

    /// Two tests of a joint, noise of a hundredth of what it gives way by; what its load had been before the first of them,
    /// and before the second where that is another joint.
    fn tested(before: &[f64], anew: bool) -> Problem {
        let mut random = crate::record::noise::tests::drawn(20261128);
        let cycles = |i: usize| (std::f64::consts::TAU * i as f64 / 60.0).sin();
        let test = |level: f64| -> Vec<f64> { (0..=480).map(|i| level * cycles(i)).collect() };
        let mut reached = [0.0_f64; 20];
        let records = [600.0, 1000.0].map(|level| {
            let force = test(level);
            let mut give = |force: f64| -> f64 {
                for (j, play) in reached.iter_mut().enumerate() {
                    let limit = 60.0 * (j + 1) as f64;
                    *play = play.clamp(force - limit, force + limit);
                }
                1e-9 * (force + reached.iter().sum::<f64>() / 10.0)
            };
            if anew || level == 600.0 {
                before.iter().for_each(|force| {
                    give(*force);
                });
            }
            let displacement = force.iter().map(|f| give(*f) + 1e-8 * random()).collect();
            if anew {
                reached.fill(0.0);
            }
            Record {
                displacement,
                time: Some((0..force.len()).map(|i| 0.01 * i as f64).collect()),
                force,
                ..Record::default()
            }
        });
        Problem::new(Form::Play, &records)
    }

    #[test]
    fn a_pull_before_the_tests_is_told_by_all_of_them() {
        for (before, anew, within) in [
            (vec![700.0, 0.0], true, 0.03),
            (vec![-1250.0, 0.0], true, 0.03),
            (vec![800.0, -800.0, 0.0], true, 0.03),
            // A pull that the first test exceeds is seen in its first cycle alone.
            (vec![500.0, 0.0], false, 0.2),
        ] {
            let problem = tested(&before, anew);
            let found = before_all(&problem, Vec::new());
            let turn = |k: usize| *found[0][k].turned.last().unwrap();
            let truth = before[before.len() - 2];
            assert!(
                (turn(0) - truth).abs() < within * truth.abs(),
                "{before:?}: {found:?}"
            );
            assert_eq!(found[0][0] == found[0][1], anew);
            assert_eq!(found[0][1].goes_on, !anew);
            // A joint that goes on may have done so without a pull.
            let without = found.get(1).map(|one| (one[0].is_virgin(), one[1].goes_on));
            assert_eq!(without, (!anew).then_some((true, true)));
            let left = |begins: &[Beginning]| least_misfit(&begun(&problem, begins));
            let virgin = left(&[Beginning::default(), Beginning::default()]);
            assert!(left(&found[0]) < 0.7 * virgin);
        }
    }

    #[test]
    fn virgin_joints_have_no_load_before_their_tests() {
        assert_eq!(
            before_all(&tested(&[], true), Vec::new()),
            Vec::<Vec<Beginning>>::new()
        );
    }
}
