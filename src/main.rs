//! The binary `iwan`.

fn main() -> std::process::ExitCode {
    iwan::cli::main()
}
