//! Signals and parameters in tables.

use crate::saved::SavedJoint;
use crate::variables::Variables;
use quick_xml::escape::escape;
use std::fmt::Write as _;

/// What changes with time.
pub fn signals(page: &mut String, variables: &Variables) {
    page.push_str(
        "<h2>Signals</h2>\n<table>\n<tr><th>Name</th><th>Reference</th><th>Unit</th>\
         <th>Role</th><th>Meaning</th></tr>\n",
    );
    for variable in &variables.signals {
        let _ = writeln!(
            page,
            "<tr><td><code>{}</code></td><td class=\"number\">{}</td><td>{}</td><td>{}</td>\
             <td>{}</td></tr>",
            escape(&variable.name),
            variable.reference,
            escape(variable.unit),
            variable.causality.name(),
            escape(&variable.description),
        );
    }
    page.push_str("</table>\n");
}

/// The fixed parameters with what the data say of them.
pub fn parameters(page: &mut String, saved: &SavedJoint, variables: &Variables) {
    page.push_str(
        "<h2>Parameters</h2>\n<p>Fixed; they may be set before the end of Initialization Mode. \
         The interval is what the records allow (95 %); where it is empty nothing was said.</p>\n\
         <table>\n<tr><th>Name</th><th>Reference</th><th>Unit</th><th>Start</th>\
         <th>Interval</th><th>From</th><th>To</th><th>Meaning</th></tr>\n",
    );
    for variable in &variables.parameters {
        let start = variable.start(&saved.joint).map(number);
        let interval = saved.intervals.get(&variable.name);
        let _ = writeln!(
            page,
            "<tr><td><code>{}</code></td><td class=\"number\">{}</td><td>{}</td>\
             <td class=\"number\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>\
             <td class=\"number\">{}</td><td>{}</td></tr>",
            escape(&variable.name),
            variable.reference,
            escape(variable.unit),
            start.unwrap_or_default(),
            interval.map(words).unwrap_or_default(),
            number(variable.lower),
            number(variable.upper),
            escape(&variable.description),
        );
    }
    page.push_str("</table>\n");
    derived(page, saved, variables);
}

/// What is known of the joint under names that are no parameters of it, SI units.
fn derived(page: &mut String, saved: &SavedJoint, variables: &Variables) {
    let is_parameter = |name: &str| variables.parameters.iter().any(|v| v.name == name);
    let mut others = saved
        .intervals
        .iter()
        .filter(|(name, _)| !is_parameter(name))
        .peekable();
    if others.peek().is_none() {
        return;
    }
    page.push_str(
        "<p>Also estimated from the records, of the joint or of other parametrisations of it (SI \
         units):</p>\n<ul>\n",
    );
    for (name, interval) in others {
        let _ = writeln!(
            page,
            "<li><code>{}</code>: {}</li>",
            escape(name),
            words(interval)
        );
    }
    page.push_str("</ul>\n");
}

/// Shortest text that reads back as the same number; nothing for infinity.
fn number(value: f64) -> String {
    if value.is_finite() {
        format!("{value:?}")
    } else {
        String::new()
    }
}

fn words(&(low, high): &(f64, f64)) -> String {
    match (low.is_finite(), high.is_finite()) {
        (true, true) => format!("{low:.6e} … {high:.6e}"),
        (true, false) => format!("above {low:.6e}"),
        (false, true) => format!("below {high:.6e}"),
        (false, false) => "not bounded by the data".to_owned(),
    }
}
