//! `quasilux man`: the manual, a page for the program and for each command.

use crate::arguments::{Arguments, ManArguments, unknown_command};
use crate::exit::{CliError, Exit};
use crate::print::{print, to_stdout};
use crate::results;
use clap_mangen::Man;

/// Prints a page, or writes all of them.
pub(crate) fn man(arguments: &ManArguments) -> Result<Exit, CliError> {
    let program = Arguments::definition();
    match (&arguments.out, &arguments.command) {
        (Some(folder), _) => {
            results::prepare(folder)?;
            let commands = Arguments::commands();
            let commands = commands.iter().filter_map(|name| program.find_subcommand(name));
            let mut count = 0;
            for page in std::iter::once(&program).chain(commands).map(Page::new) {
                results::write_atomic(&folder.join(page.name), &page.roff)?;
                count += 1;
            }
            print(&format!("{count} pages in {}\n", folder.display()))?;
        }
        (None, Some(name)) => {
            let command = program
                .find_subcommand(name)
                .ok_or_else(|| CliError::new(unknown_command(name)))?;
            to_stdout(|out| out.write_all(&Page::new(command).roff))?;
        }
        (None, None) => to_stdout(|out| out.write_all(&Page::new(&program).roff))?,
    }
    Ok(Exit::Done)
}

/// A page of section 1.
struct Page {
    name: String,
    roff: Vec<u8>,
}

impl Page {
    fn new(command: &clap::Command) -> Self {
        let man = Man::new(command.clone().disable_help_subcommand(true));
        let mut roff = Vec::new();
        man.render(&mut roff).expect("bytes take everything");
        Self { name: man.get_filename(), roff }
    }
}
