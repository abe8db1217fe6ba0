//! The map of what this loading takes for what: one row per true cause, one column per rival.

use minijinja::context;
use minijinja::value::Value;

use super::wording::in_words;
use crate::diagnose::Findings;
use crate::diagnose::experiment::separability::TOLD;

/// χ² below which nothing at all tells two causes apart: the margin within which the search counts
/// them as equally good.
const SAME: f64 = 10.0;

/// χ² up to which a pair is told apart by little: four times what is needed.
const LITTLE: f64 = 4.0 * TOLD;

/// The map; `None` where no separability was computed.
pub(super) fn map(findings: &Findings) -> Option<Value> {
    let lines = &findings.outlook.separability;
    if lines.iter().all(|line| line.row.is_empty()) {
        return None;
    }
    let mut columns = vec!["none"];
    columns.extend(lines.iter().map(|line| line.name.as_str()));
    let rows = lines.iter().map(|line| {
        let fields = columns.iter().map(|column| {
            let left = line.row.iter().find(|(rival, _)| rival == column);
            field(*column == line.name, left.map(|(_, left)| *left))
        });
        context! {
            name => in_words(&line.name),
            named => findings.causes.iter().any(|cause| cause.name == line.name),
            fields => fields.collect::<Vec<_>>(),
        }
    });
    let key = |class: &str, label: String| context! { class, label };
    Some(context! {
        caption => format!(
            "If the cause of a row were at work, the χ² that the rival of a column would leave: below {SAME:.0} they look the same, from {TOLD:.0} on they are told apart. An empty field is above {LITTLE:.0}. Rows are taken at a size that would matter; a named cause (•) and its rivals as fitted."
        ),
        columns => columns.iter().map(|name| rival(name)).collect::<Vec<_>>(),
        rows => rows.collect::<Vec<_>>(),
        keys => [
            key("same", format!("looks the same (below {SAME:.0})")),
            key("doubtful", format!("not told apart (below {TOLD:.0})")),
            key("little", format!("told apart by little (below {LITTLE:.0})")),
            key("self", "the cause itself".to_owned()),
        ],
    })
}

/// Class and content of one field.
fn field(own: bool, left: Option<f64>) -> Value {
    let (class, shown) = match left {
        _ if own => ("self", String::new()),
        Some(left) if left < 1.0 => ("same", "<1".to_owned()),
        Some(left) if left < SAME => ("same", format!("{left:.0}")),
        Some(left) if left < TOLD => ("doubtful", format!("{left:.0}")),
        Some(left) if left < LITTLE => ("little", format!("{left:.0}")),
        _ => ("", String::new()),
    };
    context! { class, shown }
}

/// A rival in words.
fn rival(name: &str) -> String {
    match name {
        "none" => "the plain joint".to_owned(),
        name => in_words(name),
    }
}
