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
mod print;
mod project;
mod results;
mod watcher;

use arguments::{Arguments, Command};
use clap::Parser;
use exit::{Exit, Refusal};
use std::process::ExitCode;

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Run(arguments) => commands::run(&arguments),
        Command::Validate(arguments) => commands::validate(&arguments),
        Command::Experiment(arguments) => commands::experiment(&arguments),
        Command::Points(arguments) => commands::points(&arguments),
        Command::Photometry(arguments) => commands::photometry(&arguments),
        Command::Bsdf(_) => Err(Refusal::not_built("quasilux bsdf")),
        Command::Plan(_) => Err(Refusal::not_built("quasilux plan")),
        Command::Shard(_) => Err(Refusal::not_built("quasilux shard")),
        Command::Merge(_) => Err(Refusal::not_built("quasilux merge")),
        Command::Resume(_) => Err(Refusal::not_built("quasilux resume")),
    };
    match outcome {
        Ok(exit) => exit.into(),
        Err(refusal) => {
            eprintln!("error: {refusal}");
            Exit::BadInput.into()
        }
    }
}
