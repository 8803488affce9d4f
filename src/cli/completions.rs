//! `knotproof completions`: completion scripts for shells.

use clap::Args;
use clap_complete::{Shell, generate};

use super::Exit;
use super::failure::Failure;
use super::output::say;

/// Print the completion script of a shell
///
/// For bash: knotproof completions bash > ~/.local/share/bash-completion/completions/knotproof. For zsh: a file named _knotproof in a folder of $fpath. For fish:
/// ~/.config/fish/completions/knotproof.fish.
#[derive(Args)]
pub struct Arguments {
    /// The shell.
    #[arg(value_enum, value_name = "SHELL")]
    shell: Shell,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut super::command(), super::NAME, &mut script);
    say(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Success)
}
