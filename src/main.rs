//! The command line of knotproof.

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
