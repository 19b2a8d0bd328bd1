//! How many lux, and how sure: the command line.
//!
//! Everything that touches the machine lives here: arguments, files, threads, the clock, signals,
//! exit codes. Read on at [`commands::run`] for the main job.

mod arguments;
mod atomic_file;
mod build;
mod cases;
mod checkpoint;
mod commands;
mod container;
mod digest;
mod door;
mod exit;
mod forecast;
mod interrupt;
mod names;
mod plan;
mod print;
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
        Command::Check(arguments) => commands::check(&arguments),
        Command::Experiment(arguments) => commands::experiment(&arguments),
        Command::Points(arguments) => commands::points(&arguments),
        Command::Photometry(arguments) => commands::photometry(&arguments),
        Command::Bsdf(arguments) => commands::bsdf(&arguments),
        Command::Plan(arguments) => commands::plan(&arguments),
        Command::Shard(arguments) => commands::shard(&arguments),
        Command::Merge(arguments) => commands::merge(&arguments),
        Command::Resume(arguments) => commands::resume(&arguments),
    };
    match outcome {
        Ok(exit) => exit.into(),
        Err(error) => {
            eprintln!("error: {error}");
            Exit::BadInput.into()
        }
    }
}
