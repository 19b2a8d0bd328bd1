//! How many lux, and how sure: the command line.
//!
//! Everything that touches the machine lives here: arguments, files, threads, the clock, signals,
//! exit codes. Read on at [`commands::run`] for the main job.

mod arguments;
mod cases;
mod commands;
mod exit;
mod interrupt;
mod names;
mod project;
mod results;
mod watcher;

use arguments::{Arguments, Command};
use clap::Parser;
use exit::Exit;
use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Run(arguments) => commands::run(&arguments),
        Command::Validate(arguments) => commands::validate(&arguments),
        Command::Experiment(arguments) => commands::experiment(&arguments),
        Command::Points(arguments) => commands::points(&arguments),
        Command::Photometry(_)
        | Command::Bsdf(_)
        | Command::Plan(_)
        | Command::Shard(_)
        | Command::Merge(_)
        | Command::Resume(_) => Err(exit::Refusal::not_built("this command")),
    };
    match outcome {
        Ok(exit) => exit.into(),
        Err(refusal) => {
            eprintln!("error: {refusal}");
            Exit::BadInput.into()
        }
    }
}
