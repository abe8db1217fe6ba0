//! documentation/index.html: what the unit answers, and how to read it.

use crate::causes;
use crate::joint::{Drive, Joint};
use crate::variables::{Causality, Variable, Variables};
use quick_xml::escape::escape;
use std::fmt::Write as _;

/// The page, complete in itself: no script, no style or picture from elsewhere.
pub fn html(joint: &Joint, drive: Drive, variables: &Variables, guid: &str) -> String {
    let (input, output) = match drive {
        Drive::Force => ("force", "displacement"),
        Drive::Displacement => ("displacement", "force"),
    };
    let mut page = String::from(HEAD);
    // Writing to a String cannot fail.
    let _ = write!(
        page,
        "<p>{}. Exported by iwan {}; GUID {guid}.</p>\n{USE}",
        escape(super::description(joint, drive)),
        env!("CARGO_PKG_VERSION"),
    );
    let _ = writeln!(
        page,
        "<p>Input <code>{input}</code>, answer <code>{output}</code>. The value of \
         <code>{input}</code> that is set before fmi2DoStep is its value at the <em>end</em> of the \
         step. An importer that also gives the input's time derivatives \
         (fmi2SetRealInputDerivatives, orders 1 to 3) has it continued from the communication point \
         instead, and turning values inside the step are found.</p>"
    );
    let _ = write!(
        page,
        "<h2>Variables</h2>\n<table>\n<tr><th>Name</th><th>Unit</th><th>Role</th><th>Start</th>\
         <th>From</th><th>To</th><th>Meaning</th></tr>\n"
    );
    for variable in variables.iter() {
        row(&mut page, variable, joint);
    }
    page.push_str("</table>\n");
    for acting in &joint.effects {
        cause(&mut page, acting.effect.name());
    }
    page.push_str("</body>\n</html>\n");
    page
}

fn row(page: &mut String, variable: &Variable, joint: &Joint) {
    let bound = |bound: f64| {
        if bound.is_finite() {
            format!("{bound:?}")
        } else {
            String::new()
        }
    };
    let start = variable
        .start(joint)
        .map(|start| format!("{start:?}"))
        .unwrap_or_default();
    let role = match variable.causality {
        Causality::Parameter => "parameter, fixed",
        other => other.name(),
    };
    let _ = writeln!(
        page,
        "<tr><td><code>{}</code></td><td>{}</td><td>{role}</td><td>{start}</td><td>{}</td>\
         <td>{}</td><td>{}</td></tr>",
        escape(&variable.name),
        escape(variable.unit),
        bound(variable.lower),
        bound(variable.upper),
        escape(&variable.description),
    );
}

fn cause(page: &mut String, name: &str) {
    let Some(cause) = causes::find(name) else {
        return;
    };
    let about = cause.page();
    let _ = writeln!(
        page,
        "<h2>Cause <code>{}</code></h2>\n<p>{}</p>\n<p>Law: <code>{}</code>. Source: {}.</p>",
        escape(name),
        escape(about.happens),
        escape(about.formula),
        escape(about.source.trim_end_matches('.')),
    );
}

const HEAD: &str = "<!DOCTYPE html>
<html lang=\"en\">
<head>
<meta charset=\"utf-8\">
<title>IwanJoint</title>
<style>
body { font-family: sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; }
th, td { border: 1px solid #999; padding: 0.2em 0.5em; text-align: left; }
</style>
</head>
<body>
<h1>IwanJoint</h1>
";

const USE: &str = "<p>A mechanical joint after Segalman's augmented Iwan model (SAND2001-0811): a \
spring in series with a network of sliders, and the effects that a diagnosis added to it. The \
answer depends on the turning values of the input, not on the communication step. All units are \
SI. Parameters may be set before the end of Initialization Mode; the complete state can be saved, \
put back, serialized and continued in another process.</p>
";
