//! The table of durations as README.md has it.

use std::process::Command;

const README: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/README.md");
const MARKERS: [&str; 2] = ["<!-- real time -->\n", "<!-- /real time -->"];

/// One kind of step.
pub struct Row {
    pub name: String,
    pub steps: usize,
    /// Median, 99.99 percentile and worst, in processor time.
    pub microseconds: [f64; 3],
}

/// What was measured, and where.
pub struct Machine {
    day: String,
    commit: String,
    cores: usize,
    /// Load average of the minute before: programs that wanted a core.
    load: String,
}

impl Machine {
    pub fn now() -> Machine {
        let loads = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
        Machine {
            day: answer("date", &["-u", "+%F"]),
            commit: answer("git", &["describe", "--always", "--dirty", "--exclude=*"]),
            cores: std::thread::available_parallelism().map_or(0, usize::from),
            load: loads.split(' ').next().unwrap_or_default().to_owned(),
        }
    }
}

/// First line of what a program says.
fn answer(program: &str, arguments: &[&str]) -> String {
    let mut command = Command::new(program);
    command
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"));
    let said = command.output().map(|output| output.stdout);
    let said = String::from_utf8(said.unwrap_or_default()).unwrap_or_default();
    said.lines().next().unwrap_or("unknown").to_owned()
}

/// A power of ten with two digits before it from ten thousand on.
fn count(steps: usize) -> String {
    if steps < 10_000 {
        return steps.to_string();
    }
    let power = steps.ilog10();
    let digits = power.to_string();
    let raised = digits.chars().map(|digit| match digit {
        '1' => '¹',
        '2' => '²',
        '3' => '³',
        // The others stand together, from zero on.
        _ => char::from_u32(u32::from('⁰') + digit as u32 - u32::from('0')).unwrap_or(digit),
    });
    let raised: String = raised.collect();
    let leading = (steps as f64 / 10_f64.powi(power as i32) * 10.0).round() / 10.0;
    if leading == 1.0 {
        format!("10{raised}")
    } else {
        format!("{leading}·10{raised}")
    }
}

fn duration(microseconds: f64) -> String {
    if microseconds < 9.95 {
        format!("{microseconds:.1}")
    } else {
        format!("{microseconds:.0}")
    }
}

/// The table and what it was measured on.
pub fn table(rows: &[Row], machine: &Machine) -> String {
    let mut text =
        "| step [µs] | steps | median | 99.99 % | worst |\n|---|---|---|---|---|\n".to_owned();
    for row in rows {
        let [median, tail, worst] = row.microseconds.map(duration);
        let (name, steps) = (&row.name, count(row.steps));
        text += &format!("| {name} | {steps} | {median} | {tail} | {worst} |\n");
    }
    let Machine {
        day,
        commit,
        cores,
        load,
    } = machine;
    text + &format!(
        "\nMeasured on {day} at commit {commit}, on {cores} cores, with a load average of {load} \
             when it began.\n"
    )
}

/// Puts the table between the markers of README.md.
pub fn write(table: &str) {
    let page = std::fs::read_to_string(README).expect("README.md");
    let [begin, end] = MARKERS.map(|marker| page.find(marker).expect("a marker in README.md"));
    let begin = begin + MARKERS[0].len();
    let page = [&page[..begin], table, &page[end..]].concat();
    std::fs::write(README, page).expect("README.md");
}
