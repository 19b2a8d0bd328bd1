//! How many lux, and how sure: the command line.
//!
//! Everything that touches the machine lives here: arguments, files, threads, the clock, signals,
//! exit codes. Read on at `commands::run` for the main job, and at [`embedded`] for programs that
//! carry this one in them.

#![warn(clippy::print_stdout, clippy::print_stderr)]

mod arguments;
mod atomic_file;
mod build;
mod cases;
mod checkpoint;
mod commands;
mod container;
mod digest;
mod door;
pub mod embedded;
mod exit;
mod forecast;
mod heartbeat;
mod input;
mod interrupt;
mod kernel;
mod machine;
mod meter;
mod names;
mod npy;
mod plan;
mod print;
mod project;
mod results;
mod source;
mod time_left;
mod watcher;
mod year_file;

use arguments::{Arguments, Command};
use clap::Parser;
use exit::CliError;
pub use exit::Exit;
use print::tell;
use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};

/// Does what a command line asks for; the first of its words is the name of the program.
pub fn command_line(words: impl IntoIterator<Item = OsString>) -> Exit {
    interrupt::survive_file_limits();
    if let Err(refusal) = kernel::choose() {
        return refuse(&refusal);
    }
    let arguments = match Arguments::try_parse_from(words) {
        Ok(arguments) => arguments,
        Err(message) => return explain(&message),
    };
    let outcome = match arguments.command {
        Command::Run(arguments) => commands::run(&arguments),
        Command::Validate(arguments) => commands::validate(&arguments),
        Command::Annual(arguments) => commands::annual(&arguments),
        Command::Check(arguments) => commands::check(&arguments),
        Command::Sky(arguments) => commands::sky(&arguments),
        Command::Experiment(arguments) => commands::experiment(&arguments),
        Command::Points(arguments) => commands::points(&arguments),
        Command::Photometry(arguments) => commands::photometry(&arguments),
        Command::Bsdf(arguments) => commands::bsdf(&arguments),
        Command::Plan(arguments) => commands::plan(&arguments),
        Command::Shard(arguments) => commands::shard(&arguments),
        Command::Merge(arguments) => commands::merge(&arguments),
        Command::Resume(arguments) => commands::resume(&arguments),
        Command::Import(arguments) => commands::import(&arguments),
        Command::Export(arguments) => commands::export(&arguments),
        Command::Keys(arguments) => commands::keys(&arguments),
        Command::Completions(arguments) => commands::completions(&arguments),
        Command::Man(arguments) => commands::man(&arguments),
    };
    match outcome {
        Ok(exit) => exit,
        Err(error) => refuse(&error),
    }
}

fn refuse(error: &CliError) -> Exit {
    tell(format_args!("error: {error}"));
    Exit::BadInput
}

/// What is wrong with the arguments, or the help or version that they ask for.
fn explain(message: &clap::Error) -> Exit {
    if let Some(what) = arguments::refusal(message) {
        return refuse(&CliError::new(what));
    }
    let is_error = message.use_stderr();
    match message.print().and_then(|()| io::stdout().flush()) {
        Err(error) if !is_error && error.kind() != ErrorKind::BrokenPipe => {
            refuse(&CliError::new(format!("cannot write to stdout: {error}")))
        }
        _ if is_error => Exit::BadInput,
        _ => Exit::Done,
    }
}
