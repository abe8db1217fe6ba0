//! documentation/index.html: what the unit is, where its numbers come from, and how to use it.

mod equations;
mod origin;
mod tables;
mod use_of_it;

use super::FmiVersion;
use crate::joint::Drive;
use crate::saved::SavedJoint;
use crate::variables::Variables;
use quick_xml::escape::escape;
use std::fmt::Write as _;

/// The page, complete in itself: no script, no style or picture from elsewhere but the archive's
/// own icon.
pub fn html(
    version: FmiVersion,
    saved: &SavedJoint,
    drive: Drive,
    variables: &Variables,
    guid: &str,
) -> String {
    let mut page = String::from(HEAD);
    // Writing to a String cannot fail.
    let _ = writeln!(
        page,
        "<p>{}. Exported by iwan {} for co-simulation by FMI {}; {} <code>{guid}</code>.</p>",
        escape(super::description(&saved.joint, drive)),
        env!("CARGO_PKG_VERSION"),
        version.number(),
        match version {
            FmiVersion::Two => "GUID",
            FmiVersion::Three => "instantiation token",
        },
    );
    origin::section(&mut page, &saved.provenance);
    equations::section(&mut page, &saved.joint);
    tables::signals(&mut page, variables);
    tables::parameters(&mut page, saved, variables);
    use_of_it::section(&mut page, version, drive, &saved.provenance);
    page.push_str(SOURCES);
    page
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
td.number { text-align: right; font-family: monospace; }
pre { background: #f3f4f6; padding: 0.6em; overflow-x: auto; }
</style>
</head>
<body>
<h1>IwanJoint</h1>
";

const SOURCES: &str = "<h2>Sources</h2>
<ul>
<li>D. J. Segalman, An Initial Overview of Iwan Modeling for Mechanical Joints, SAND2001-0811,
Sandia National Laboratories, 2001: the model, its equations by number, the identification.</li>
<li>D. J. Segalman, A Four-Parameter Iwan Model for Lap-Type Joints, J. Appl. Mech. 72 (2005):
the family <code>four_parameter</code>.</li>
<li>The numbers: the records named above, by the SHA-256 of their files; the intervals say which
parameters the records did not reach.</li>
</ul>
<p>Licences: <a href=\"licenses/license.txt\">licenses/license.txt</a>.</p>
</body>
</html>
";
