//! The command line: one file per subcommand, results on stdout, messages on stderr.

mod causes;
mod check;
mod diagnose;
mod export;
mod fewest;
mod gaps;
mod identify;
pub mod input;
mod noticed;
pub mod output;
mod preload;
mod progress;
mod provenance;
mod signs;
mod simulate;
mod stiffness;

use clap::{Parser, Subcommand};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

/// Exit status of bad input or usage: the user can mend it.
const BAD_INPUT: u8 = 2;
/// Exit status of a defect: the program is wrong.
const DEFECT: u8 = 3;

/// Input or usage that the user can mend, where no typed error of a room says so.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct BadInput(pub String);

/// Segalman's augmented Iwan joint: identified from measured force and displacement, diagnosed,
/// exported as an FMI co-simulation unit.
#[derive(Parser)]
#[command(name = "iwan", version, propagate_version = true, after_help = EXIT_STATUS)]
struct CommandLine {
    #[command(subcommand)]
    command: Command,
}

const EXIT_STATUS: &str = "Exit status: 0 done, 2 bad input or usage, 3 defect of the program.";

#[derive(Subcommand)]
enum Command {
    Identify(identify::Identify),
    Diagnose(diagnose::Diagnose),
    Simulate(simulate::Simulate),
    Export(export::Export),
    Check(check::Check),
    Causes(causes::Causes),
}

/// Runs the command line: 0 done, 2 bad input or usage, 3 defect.
pub fn main() -> ExitCode {
    let command = match CommandLine::try_parse() {
        Ok(line) => line.command,
        Err(refusal) => {
            if refusal.use_stderr() {
                let _ = refusal.print();
                return BAD_INPUT.into();
            }
            // `--help` and `--version` come this way, too
            return conclude(|| output::print(&refusal.render().to_string())).into();
        }
    };
    std::panic::set_hook(Box::new(|panic| {
        let place = panic
            .location()
            .map_or(String::new(), |at| format!(" at {at}"));
        let message = panic.payload_as_str().unwrap_or("no message");
        output::tell(&format!("iwan: defect{place}: {message}"));
        output::tell(
            "iwan: the program is wrong here, not the input; please report the command line and this message",
        );
    }));
    conclude(|| run(&command)).into()
}

/// The exit status of a run; says on stderr what went wrong (the panic hook has spoken already).
fn conclude(run: impl FnOnce() -> anyhow::Result<()>) -> u8 {
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(())) => 0,
        Ok(Err(error)) => {
            output::tell(&format!("iwan: {error:#}"));
            status(&error)
        }
        Err(_) => DEFECT,
    }
}

fn run(command: &Command) -> anyhow::Result<()> {
    match command {
        Command::Identify(arguments) => identify::run(arguments),
        Command::Diagnose(arguments) => diagnose::run(arguments),
        Command::Simulate(arguments) => simulate::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Causes(arguments) => causes::run(arguments),
    }
}

/// 2 where any error in the chain is one of the user's making, else 3.
fn status(error: &anyhow::Error) -> u8 {
    let is_bad_input = |cause: &(dyn std::error::Error + 'static)| {
        cause.is::<BadInput>()
            || cause.is::<crate::read::ReadError>()
            || cause.is::<crate::joint::JointError>()
            || cause.is::<crate::saved::SavedError>()
    };
    if error.chain().any(is_bad_input) {
        BAD_INPUT
    } else {
        DEFECT
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::{Options, file};
    use anyhow::Context;

    #[test]
    fn the_exit_status_tells_bad_input_from_defects() {
        assert_eq!(conclude(|| Ok(())), 0);
        assert_eq!(
            conclude(|| anyhow::bail!("an error that no room knows")),
            DEFECT
        );
        assert_eq!(conclude(|| panic!("a bug")), DEFECT);
        assert_eq!(
            conclude(|| Err(BadInput("no".into())).context("around it")),
            BAD_INPUT
        );
        let unread = || file("there/is/none".as_ref(), &Options::default());
        assert_eq!(
            conclude(|| unread().map(drop).context("around it")),
            BAD_INPUT
        );
    }

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        CommandLine::command().debug_assert();
    }
}
