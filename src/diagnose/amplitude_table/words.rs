//! What a diagnosis of an amplitude table says in words.

use super::evidence::Thresholds;
use super::held_out::Unseen;
use super::levels::{Level, Levels, Over};
use super::model::Model;
use super::scatter::{LEAST_LOSS, Scatter};
use crate::diagnose::findings::{NamedCause, Verdict};
use crate::record::written::quantity;

/// The verdict in a sentence or two.
pub fn summary(verdict: Verdict, causes: &[NamedCause], ratio: f64, levels: &Levels) -> String {
    let names: Vec<String> = causes
        .iter()
        .map(|cause| match cause.ambiguous_with.is_empty() {
            true => cause.name.clone(),
            false => format!("{} (or {})", cause.name, cause.ambiguous_with.join(" or ")),
        })
        .collect();
    let names = names.join(" and ");
    let column = what(levels);
    match verdict {
        Verdict::Clean => {
            format!("A joint of some density has the {column} of every level, to the noise.")
        }
        Verdict::Explained => format!(
            "No Iwan network has the {column} of these levels; with {names} beside it only noise is left, and the error on levels left out falls to {ratio:.2} of the baseline's."
        ),
        Verdict::PartlyExplained => format!(
            "No Iwan network has the {column} of these levels; {names} beside it takes the error on levels left out to {ratio:.2} of the baseline's, and more than noise remains."
        ),
        Verdict::Unexplained => format!(
            "No Iwan network has the {column} of these levels, and no effect that a table can show predicts the levels left out better: what fits best stands among the candidates as a hypothesis."
        ),
    }
}

fn what(levels: &Levels) -> &'static str {
    if levels.over == Over::Displacement && levels.has_stiffness() {
        "loss and stiffness"
    } else {
        "loss"
    }
}

/// The judged channel.
pub fn judged(levels: &Levels) -> String {
    format!("{} per level (in units of the noise)", what(levels))
}

/// How the noise was estimated.
pub fn method(levels: &Levels, noise: &Scatter) -> String {
    let mut said = match noise.count {
        0 => "too few levels for their scatter: taken as".to_string(),
        count => format!("scatter of {count} levels about a smooth curve:"),
    };
    said.push_str(&format!(" {:.2} % of the loss", 100.0 * noise.loss));
    if noise.loss <= LEAST_LOSS {
        said.push_str(" (the least that is assumed)");
    }
    if what(levels) != "loss" {
        let of = if levels.harmonic {
            "frequency squared"
        } else {
            "stiffness"
        };
        said.push_str(&format!(", {:.3} % of the {of}", 100.0 * noise.stiffness));
    }
    said
}

/// Slopes, stiffness and misfits in numbers.
pub fn notes(
    levels: &Levels,
    baseline: &Model,
    unseen: &[Unseen],
    limits: &Thresholds,
) -> Vec<String> {
    let rows = &levels.rows;
    // Between repeats of a level there is the slope of their noise alone.
    let of_level = |rows: &&[Level]| {
        let mean = |of: fn(&Level) -> f64| rows.iter().map(|r| of(r).ln()).sum::<f64>();
        let count = rows.len() as f64;
        (mean(|r| r.amplitude) / count, mean(|r| r.loss) / count)
    };
    let means: Vec<(f64, f64)> = levels.apart().iter().map(of_level).collect();
    let slopes: Vec<f64> = means
        .windows(2)
        .map(|w| (w[1].1 - w[0].1) / (w[1].0 - w[0].0))
        .collect();
    let over = match levels.over {
        Over::Displacement => "displacement",
        Over::Force => "force",
    };
    let mut said = Vec::new();
    if let (Some(first), Some(last)) = (slopes.first(), slopes.last()) {
        said.push(format!(
            "Slope of log loss over log {over} amplitude: {first:.2} at the smallest levels, {last:.2} at the largest. A power law of break-free forces has one slope, chi + 3: between 2 and 3 for chi from -1 to 0, above 3 where strong sliders outnumber weak ones; 2 is a viscous or hysteretic loss."
        ));
    }
    if let Some(stiffness) = rows
        .iter()
        .map(|row| row.stiffness)
        .collect::<Option<Vec<f64>>>()
    {
        let lowest = stiffness.iter().copied().fold(f64::INFINITY, f64::min);
        let (first, last) = (stiffness[0], stiffness[stiffness.len() - 1]);
        let name = if levels.harmonic {
            "Frequency squared"
        } else {
            "Secant stiffness"
        };
        said.push(format!(
            "{name} falls by {:.2} % from the smallest level to its least, and is {:.2} % above its least at the largest; of an Iwan network it never rises with amplitude.",
            100.0 * (1.0 - lowest / first),
            100.0 * (last / lowest - 1.0)
        ));
        let missed: Vec<f64> = unseen.iter().filter_map(|level| level.stiffness).collect();
        let worst = missed.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        said.push(format!(
            "Levels left out: the baseline misses the stiffness by up to {:.3} %.",
            100.0 * worst
        ));
    }
    said.push(format!(
        "Misfit of the best Iwan joint {:.3} noise variances; tables simulated from it stay below {:.3} in 99 of 100.",
        baseline.misfit, limits.misfit
    ));
    if levels.mass_unknown {
        said.push(format!(
            "The modal mass is not given and was fitted with the joint (baseline: {:.3} kg): loss and fall of the frequency belong together by it, so that it absorbs part of what could be wrong.",
            baseline.mass
        ));
    }
    said
}

/// Levels that the model misses most.
pub fn places(levels: &Levels, unseen: &[Unseen]) -> Vec<String> {
    let total: f64 = unseen.iter().map(|level| level.square).sum();
    let mut order: Vec<usize> = (0..unseen.len()).collect();
    order.sort_by(|&a, &b| unseen[b].square.total_cmp(&unseen[a].square));
    let unit = match levels.over {
        Over::Displacement => "m",
        Over::Force => "N",
    };
    order
        .into_iter()
        .take(3)
        .filter(|&i| unseen[i].square > 0.1 * total)
        .map(|i| {
            let level = &unseen[i];
            let stiffness = level.stiffness.map_or(String::new(), |error| {
                format!(", stiffness by {:+.3} %", 100.0 * error)
            });
            format!(
                "level {} ({}), left out: loss missed by {:+.1} %{stiffness}",
                level.row + 1,
                quantity(levels.rows[level.row].amplitude, unit),
                100.0 * level.loss
            )
        })
        .collect()
}

/// What an amplitude table cannot show.
pub fn not_identifiable(levels: &Levels, missing: Option<&String>) -> Vec<String> {
    let mut said: Vec<String> = missing
        .map(|m| format!("No joint is written: {m}."))
        .into_iter()
        .collect();
    if what(levels) == "loss" {
        said.push("Slip and a viscous or quadratic loss: without a stiffness beside it a loss that grows with a slope between 1 and 3 is that of some population of sliders. The fall of the stiffness, or a second frequency, tells them apart.".to_string());
    }
    said.push("Whatever acts within a cycle or from cycle to cycle (asymmetry, free play, wear, running-in, drift, the measuring chain): a table keeps one number per level. A time history shows it.".to_string());
    said.push(
        "The split of the stiffness into K_1 and K_T, and F_S and beta below full slip."
            .to_string(),
    );
    if levels.over == Over::Displacement && levels.has_stiffness() {
        said.push("Pinning with a gap below the smallest level, free play in series and a stiffening of the structure look alike: all raise the secant stiffness with amplitude.".to_string());
    }
    said
}

/// What to measure next.
pub fn next_experiment(verdict: Verdict, causes: &[NamedCause], levels: &Levels) -> Option<String> {
    let ambiguous = causes.iter().any(|cause| !cause.ambiguous_with.is_empty());
    if verdict == Verdict::Clean && what(levels) != "loss" {
        return None;
    }
    let mut said = "Keep one time history of force and displacement at the largest level: its loop shows where in the cycle the joint stiffens or loses energy.".to_string();
    if what(levels) == "loss" {
        said.push_str(" Keep the displacement amplitude of every level.");
    } else if ambiguous || verdict == Verdict::Unexplained {
        said.push_str(" More levels where the stiffness turns: a gap sets in at one amplitude, a cube grows from the smallest on; and the same levels at a second frequency separate viscous loss from slip.");
    }
    Some(said)
}
