//! The fit report as text: fixed sections, value ± half the 95 % interval (percent).

use super::found::Found;
use crate::identify::interval::{Boundary, Estimated};
use crate::identify::seed::{Over, Seed, Source};
use crate::joint::Drive;
use std::fmt::Write;

/// The whole report.
pub fn report(found: &Found) -> String {
    let mut out = String::new();
    section(&mut out, "Records");
    for (name, samples) in &found.files {
        row(&mut out, name, &format!("{samples} rows"));
    }
    section(&mut out, "Procedure of SAND2001-0811");
    procedure(&mut out, &found.seed);
    for (name, seed) in &found.tables {
        section(&mut out, &format!("Procedure, table {name}"));
        procedure(&mut out, seed);
    }
    if let Some(fit) = &found.fit {
        section(&mut out, "Fit");
        let judged = match fit.drive {
            Drive::Force => ("displacement under the measured force", "m"),
            Drive::Displacement => ("force under the measured displacement", "N"),
        };
        row(&mut out, "judged", judged.0);
        row(
            &mut out,
            "samples",
            &format!("{}, one offset per record", fit.samples),
        );
        let misfit = format!(
            "{:.3e} {} ({:.3} % of the channel's)",
            fit.rms,
            judged.1,
            100.0 * fit.relative_rms
        );
        row(&mut out, "rms misfit", &misfit);
        if let Some(any) = found.any_joint_rms {
            row(
                &mut out,
                "of any density",
                &format!("{any:.3e} {}", judged.1),
            );
        }
        let ended = if fit.converged {
            "settled"
        } else {
            "NOT settled"
        };
        row(
            &mut out,
            "descent",
            &format!("{ended}, {} iterations", fit.iterations),
        );
        section(&mut out, &format!("Joint: {}", fit.joint.density.family()));
        for estimate in &fit.estimates {
            estimated(&mut out, estimate);
        }
    }
    list(
        &mut out,
        "Not reached by these data",
        &found.not_identifiable,
    );
    list(&mut out, "Noticed", &found.noticed);
    if let Err(why) = &found.joint {
        list(&mut out, "No joint written", std::slice::from_ref(why));
    }
    out
}

fn procedure(out: &mut String, seed: &Seed) {
    row(out, "settled cycles", &seed.points.len().to_string());
    if let (Some(first), Some(last)) = (seed.levels.first(), seed.levels.last()) {
        let span = format!(
            "{} from {:.4} N to {:.4} N",
            seed.levels.len(),
            first.force_amplitude,
            last.force_amplitude
        );
        row(out, "load levels", &span);
    }
    if let Some(law) = &seed.dissipation {
        let (over, unit) = match law.over {
            Over::Force => ("F0", "N"),
            Over::Displacement => ("U0", "m"),
        };
        let slopes: Vec<String> = law
            .local_slopes
            .iter()
            .map(|s| format!("{:.2}", s.slope))
            .collect();
        row(out, &format!("slopes log D/log {over}"), &slopes.join(" "));
        let range = format!(
            "{} of {} levels, {:.4e} to {:.4e} {unit}",
            law.used.1 - law.used.0,
            seed.levels.len(),
            law.range.0,
            law.range.1
        );
        let label = if law.constant {
            "constant slope over"
        } else {
            "no constant slope; line over"
        };
        row(out, label, &range);
        estimated(out, &law.exponent);
        estimated(out, &law.coefficient);
    }
    if let Some(stiffness) = &seed.stiffness {
        estimated(out, &stiffness.series);
        // of a stiffness that was given nothing is known at larger loads
        if stiffness.reach.is_finite() {
            let reach = format!("{:.4} of the initial one", stiffness.reach);
            row(out, "largest secant compl.", &reach);
        }
    }
    if let Some(slip) = &seed.residual_slip {
        let text = format!(
            "{:.3} ± {:.3} of the predicted {:.3e} m",
            slip.ratio, slip.half_width, slip.predicted
        );
        row(out, "residual slip", &text);
    }
    if let Some(curve) = &seed.monotonic {
        let source = match curve.source {
            Source::Ramp => "pull from the virgin state",
            Source::Loop => "half the largest loop (Masing)",
        };
        row(out, "monotonic curve", source);
        let last = format!("{:.1} % of the first", 100.0 * curve.softening());
        row(out, "last tangent", &last);
    }
    if let Some(matching) = &seed.matching {
        row(out, "φ̄ (k = 1)", &format!("{:.3e} m", matching.limit));
        row(
            out,
            "K_T by Eq. 51",
            &format!("{:.4e} N/m", matching.stiffness),
        );
        row(
            out,
            "K_T by Λ_0(∞)",
            &format!("{:.4e} N/m", matching.stiffness_by_sum),
        );
        let closure = format!("{:+.1} %", 100.0 * matching.closure_residual());
        row(out, "closure residual", &closure);
    }
}

fn estimated(out: &mut String, estimate: &Estimated) {
    let Estimated {
        name,
        symbol,
        unit,
        value,
        ..
    } = estimate;
    let unit = if unit == "1" { "" } else { unit };
    let number = if value.is_infinite() {
        "infinite".to_string()
    } else {
        format!("{value:.6e}")
    };
    let spread = match estimate.half_width() {
        Some(half) => format!("± {half:.1e} ({})", percent(100.0 * (half / value).abs())),
        None => "(not told by the data)".to_string(),
    };
    let boundary = match estimate.at_boundary {
        Some(Boundary::Lower) => "  at lower boundary",
        Some(Boundary::Upper) => "  at upper boundary",
        None => "",
    };
    let label = format!("{name} {symbol}");
    row(out, &label, &format!("{number} {unit} {spread}{boundary}"));
}

/// Two significant digits, and no false exactness above a hundred.
fn percent(value: f64) -> String {
    match value {
        v if v > 100.0 => "more than 100 %".to_string(),
        v if v >= 10.0 => format!("{v:.0} %"),
        v if v >= 0.01 => format!("{v:.2} %"),
        v => format!("{v:.0e} %"),
    }
}

fn section(out: &mut String, title: &str) {
    let _ = writeln!(out, "[[{title}]]");
}

fn row(out: &mut String, label: &str, text: &str) {
    let _ = writeln!(out, "    {label:<36} {text}");
}

fn list(out: &mut String, title: &str, sentences: &[String]) {
    if sentences.is_empty() {
        return;
    }
    section(out, title);
    for sentence in sentences {
        let mut line = "  -".to_string();
        for word in sentence.split_whitespace() {
            if line.chars().count() + word.chars().count() > 98 {
                let _ = writeln!(out, "{line}");
                line = "   ".to_string();
            }
            line.push(' ');
            line.push_str(word);
        }
        let _ = writeln!(out, "{line}");
    }
}
