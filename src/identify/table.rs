//! What an amplitude table lacks and the engineer knows: the stiffness of the joint at small load,
//! or the modal mass of a table taken at phase resonance.

use super::interval::Estimated;
use super::seed::{self, Seed, SeedError, Stiffness};
use crate::record::AmplitudeTable;
use std::f64::consts::{PI, TAU};

/// Known beside the table.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Known {
    /// Stiffness of the joint at small load \[N/m\].
    pub stiffness: Option<f64>,
    /// Modal mass \[kg\], for tables taken at phase resonance.
    pub modal_mass: Option<f64>,
}

/// Ratio of the loss to `π F X` that says that force and motion are a quarter of a cycle apart. A joint
/// in deep slip passes through this range on its way to 4/π, but not with every level.
const QUARTER: std::ops::RangeInclusive<f64> = 0.85..=1.15;

/// True where `D ≈ π F X` at every level that has all three: the force is then the exciter's at phase resonance, which
/// balances the loss alone, and not the joint's own.
pub fn at_resonance(table: &AmplitudeTable) -> bool {
    let Some(displacement) = &table.displacement_amplitude else {
        return false;
    };
    let levels = table.force_amplitude.iter().zip(displacement);
    let sines: Vec<f64> = levels
        .zip(&table.dissipation)
        .filter(|((force, displacement), loss)| {
            **force > 0.0 && **displacement > 0.0 && **loss > 0.0
        })
        .map(|((force, displacement), loss)| loss / (PI * force * displacement))
        .collect();
    !sines.is_empty() && sines.iter().all(|sine| QUARTER.contains(sine))
}

/// The joint's own force amplitude \[N\] of a table at phase resonance, `F = m ω² X`, where the modal
/// mass is known, or follows from the stiffness at the smallest level, `m = K/ω_1²`. `None` for a
/// table that has the joint's own force already, or where neither is known.
///
/// Without frequencies the stiffness is taken as constant, `F = K X`.
pub fn own_force(table: &AmplitudeTable, known: &Known) -> Option<AmplitudeTable> {
    if !at_resonance(table) {
        return None;
    }
    let displacement = table.displacement_amplitude.as_ref()?;
    let moves = (0..displacement.len()).filter(|&i| displacement[i] > 0.0);
    let smallest = moves.min_by(|&a, &b| displacement[a].total_cmp(&displacement[b]))?;
    let square = |hertz: f64| (TAU * hertz).powi(2);
    let force: Vec<f64> = match (&table.frequency, known) {
        (Some(hertz), known) => {
            let mass = known
                .modal_mass
                .or(known.stiffness.map(|k| k / square(hertz[smallest])))?;
            let rows = hertz.iter().zip(displacement);
            rows.map(|(f, x)| mass * square(*f) * x).collect()
        }
        (None, Known { stiffness, .. }) => {
            let stiffness = (*stiffness)?;
            displacement.iter().map(|x| stiffness * x).collect()
        }
    };
    Some(AmplitudeTable {
        force_amplitude: force,
        ..table.clone()
    })
}

/// The report's procedure on a table with what is known beside it.
///
/// # Errors
/// As [`seed::of_table`].
pub fn seed(table: &AmplitudeTable, known: &Known) -> Result<Seed, SeedError> {
    let own = own_force(table, known);
    let mut seed = seed::of_table(own.as_ref().unwrap_or(table))?;
    if own.is_some() {
        let resonance = seed::frequency_finding(&seed::table_levels(table));
        seed.findings.extend(resonance);
    }
    if let (None, Some(stiffness), Some(law)) =
        (&seed.stiffness, known.stiffness, &seed.dissipation)
        && law.over == seed::Over::Force
    {
        seed.stiffness = Some(Stiffness {
            series: Estimated::symmetric(
                "joint_stiffness",
                "K_1 K_T/(K_1+K_T)",
                "N/m",
                stiffness,
                f64::INFINITY,
            ),
            reach: f64::NAN,
        });
        seed.not_identifiable.push(format!(
            "The stiffness {stiffness:.4e} N/m is given, not measured; so the interval of the joint's \
             displacement is as good as it."
        ));
    }
    Ok(seed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At phase resonance the exciter's force is `F = D/(πX)` whatever the joint's own.
    fn resonant() -> AmplitudeTable {
        let amplitude = vec![1e-5, 2e-5, 4e-5];
        let loss: Vec<f64> = amplitude.iter().map(|x: &f64| 1e6 * x.powi(3)).collect();
        AmplitudeTable {
            name: "mode".into(),
            force_amplitude: loss
                .iter()
                .zip(&amplitude)
                .map(|(d, x)| d / (PI * x))
                .collect(),
            dissipation: loss,
            displacement_amplitude: Some(amplitude),
            frequency: Some(vec![50.0, 49.9, 49.8]),
        }
    }

    #[test]
    fn the_modal_mass_gives_the_joint_its_own_force() {
        let table = resonant();
        assert!(at_resonance(&table));
        // At rest nothing is a quarter of a cycle apart.
        let mut rested = table.clone();
        rested.force_amplitude.push(0.0);
        rested.dissipation.push(0.0);
        let rests = |column: &mut Option<Vec<f64>>, value| column.as_mut().map(|c| c.push(value));
        rests(&mut rested.displacement_amplitude, 0.0);
        rests(&mut rested.frequency, 200.0);
        assert!(at_resonance(&rested));
        let known = |stiffness: f64| Known {
            stiffness: Some(stiffness),
            ..Known::default()
        };
        let own = |table: &AmplitudeTable| own_force(table, &known(1e5)).map(|t| t.force_amplitude);
        let both = own(&table).zip(own(&rested));
        assert!(both.is_some_and(|(own, rested)| own == rested[..3]));
        assert_eq!(own_force(&table, &Known::default()), None);
        let known = Known {
            modal_mass: Some(2.0),
            ..Known::default()
        };
        let Some(own) = own_force(&table, &known) else {
            unreachable!("mass and frequency are there")
        };
        let expected = 2.0 * (TAU * 49.9_f64).powi(2) * 2e-5;
        assert!((own.force_amplitude[1] / expected - 1.0).abs() < 1e-14);
        assert!(!at_resonance(&own));
        let stiffness = 2.0 * (TAU * 50.0_f64).powi(2);
        let same = own_force(
            &table,
            &Known {
                stiffness: Some(stiffness),
                ..Known::default()
            },
        );
        let Some(same) = same else {
            unreachable!("stiffness is there")
        };
        assert!((same.force_amplitude[2] / own.force_amplitude[2] - 1.0).abs() < 1e-14);
    }
}
