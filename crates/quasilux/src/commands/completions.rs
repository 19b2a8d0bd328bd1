//! `quasilux completions SHELL`: what a shell needs to complete commands, options and names.

use crate::arguments::{Arguments, CompletionsArguments};
use crate::exit::{CliError, Exit};
use crate::print::to_stdout;

/// Prints the script of a shell.
pub(crate) fn completions(arguments: &CompletionsArguments) -> Result<Exit, CliError> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut Arguments::definition(), "quasilux", &mut script);
    to_stdout(|out| out.write_all(&script))?;
    Ok(Exit::Done)
}
