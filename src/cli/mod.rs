//! The command line: its arguments, one file for each subcommand, exit codes.

#[cfg(any(feature = "prove", feature = "import"))]
mod atomic_file;
#[cfg(feature = "prove")]
mod batch;
mod bounds;
#[cfg(feature = "prove")]
mod cases;
#[cfg(feature = "prove")]
mod certify;
mod check;
#[cfg(feature = "prove")]
mod compare;
mod completions;
mod curvature_words;
mod deviation_words;
mod domain_words;
mod embedding_words;
mod failure;
#[cfg(feature = "import")]
mod import;
mod input;
mod man;
mod motion_words;
mod output;
mod pool;
#[cfg(feature = "import")]
mod reading;
#[cfg(feature = "prove")]
mod show;
mod thickness_words;
#[cfg(feature = "prove")]
mod validate;
mod values_words;

use std::process::ExitCode;

use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};

/// The program's name.
const NAME: &str = "knotproof";

const EXIT_CODES: &str = "Exit codes: 0 proved or accepted, 1 refuted or rejected, 2 wrong usage or a file that cannot be \
read or written, 3 undecided.";

#[cfg(not(feature = "prove"))]
const CHECKER_ALONE: &str = "This is the checker alone, built without the feature `prove`: it checks certificates and cannot make them.\n\n\
Exit codes: 0 accepted, 1 rejected, 2 wrong usage or a file that cannot be read.";

/// Exact spline geometry with certificates.
#[derive(Parser)]
#[command(name = NAME, version, about, after_help = EXIT_CODES)]
#[cfg_attr(not(feature = "prove"), command(after_help = CHECKER_ALONE))]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    #[cfg(feature = "prove")]
    Certify(certify::Arguments),
    #[cfg(feature = "prove")]
    Batch(batch::Arguments),
    Check(check::Arguments),
    #[cfg(feature = "import")]
    Import(import::Arguments),
    #[cfg(feature = "prove")]
    Validate(validate::Arguments),
    #[cfg(feature = "prove")]
    Cases(cases::Arguments),
    #[cfg(feature = "prove")]
    Show(show::Arguments),
    #[cfg(feature = "prove")]
    Compare(Box<compare::Arguments>),
    Completions(completions::Arguments),
    Man(man::Arguments),
}

/// What every subcommand prints.
#[derive(Args, Clone, Copy)]
struct Printing {
    /// Print JSON on standard output, exact numbers as strings.
    #[arg(long)]
    json: bool,
    /// Print nothing but errors (and JSON, with --json); the exit code tells the result.
    #[arg(long, short)]
    quiet: bool,
}

/// The result of a run that came to its end, worst last.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Exit {
    /// Proved or accepted.
    Success,
    /// Refuted or rejected.
    Refuted,
    /// Wrong usage, or a file that cannot be read or written.
    Unusable,
    /// What was asked is neither proved nor refuted.
    #[cfg(feature = "prove")]
    Undecided,
}

impl Exit {
    /// The exit code.
    fn code(self) -> u8 {
        match self {
            Exit::Success => 0,
            Exit::Refuted => 1,
            Exit::Unusable => 2,
            #[cfg(feature = "prove")]
            Exit::Undecided => 3,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> ExitCode {
        ExitCode::from(exit.code())
    }
}

/// The command line.
fn command() -> clap::Command {
    Arguments::command()
}

/// Parses the arguments, runs the subcommand, prints an error if there is one.
pub fn run() -> ExitCode {
    let matches = command().get_matches();
    let arguments = Arguments::from_arg_matches(&matches).unwrap_or_else(|error| error.exit());
    let outcome = match arguments.command {
        #[cfg(feature = "prove")]
        Command::Certify(arguments) => match matches.subcommand() {
            Some((_, matches)) => certify::run(arguments, matches),
            None => Ok(Exit::Unusable),
        },
        #[cfg(feature = "prove")]
        Command::Batch(arguments) => batch::run(arguments),
        Command::Check(arguments) => check::run(&arguments),
        #[cfg(feature = "import")]
        Command::Import(arguments) => import::run(&arguments),
        #[cfg(feature = "prove")]
        Command::Validate(arguments) => validate::run(&arguments),
        #[cfg(feature = "prove")]
        Command::Cases(arguments) => cases::run(&arguments),
        #[cfg(feature = "prove")]
        Command::Show(arguments) => show::run(&arguments),
        #[cfg(feature = "prove")]
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments),
        Command::Man(arguments) => man::run(&arguments),
    };
    outcome
        .unwrap_or_else(|failure| {
            output::complain(&failure);
            Exit::Unusable
        })
        .into()
}
