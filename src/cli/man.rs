//! `knotproof man`: manual pages.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, Command};
use clap_mangen::Man;

use super::Exit;
use super::failure::Failure;
use super::output::say;

/// Print the manual page, or write those of all subcommands
///
/// To read it: knotproof man | man -l -
#[derive(Args)]
pub struct Arguments {
    /// Write knotproof.1 and a page for each subcommand into this folder. It is made where there is none.
    #[arg(long, short, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let mut command = super::command().disable_help_subcommand(true);
    command.build();
    let Some(folder) = &arguments.output else {
        say(&text(&command)?)?;
        return Ok(Exit::Success);
    };
    fs::create_dir_all(folder).map_err(|error| Failure::io(folder.display(), "cannot be made", &error))?;
    write(&command, super::NAME, folder)?;
    Ok(Exit::Success)
}

/// The page of a command.
fn text(command: &Command) -> Result<String, Failure> {
    let mut page = Vec::new();
    let rendered = Man::new(command.clone()).render(&mut page);
    rendered.map_err(|error| Failure::io("manual page", "cannot be written", &error))?;
    Ok(String::from_utf8_lossy(&page).into_owned())
}

/// Writes the pages of a command and of its subcommands.
fn write(command: &Command, name: &str, folder: &Path) -> Result<(), Failure> {
    let path = folder.join(format!("{name}.1"));
    fs::write(&path, text(command)?).map_err(|error| Failure::io(path.display(), "cannot be written", &error))?;
    for each in command.get_subcommands() {
        write(each, &format!("{name}-{}", each.get_name()), folder)?;
    }
    Ok(())
}
