//! `quasilux bsdf FILE...`: what files of measured surfaces say, as a summary, a document or
//! drawings.
//!
//! As with luminaires, a file that cannot be read does not keep the others from being reported; the
//! exit code is 2 all the same. Warnings leave it at 0, or make it 1 with `--strict`.

mod document;
mod drawing;
mod input;
mod summary;

use super::drawings;
use crate::arguments::BsdfArguments;
use crate::exit::{CliError, Exit};
use crate::print::{print, print_document, tell};
use crate::results;
use input::{Input, Surface};

/// Reads and reports all files.
pub(crate) fn bsdf(arguments: &BsdfArguments) -> Result<Exit, CliError> {
    let drawings = match &arguments.svg {
        Some(path) => drawings::plan(path, &arguments.files)?,
        None => Vec::new(),
    };
    let inputs: Vec<Input> = arguments.files.iter().map(|path| Input::read(path)).collect();
    for input in &inputs {
        if let Err(failure) = &input.surface {
            tell(format_args!("error: {failure}"));
        }
    }
    let incidences = &arguments.incidences;
    if arguments.json {
        print_document(&document::document(&inputs, incidences))?;
    } else {
        let summary = |read: ReadInput<'_>| summary::summary(read.input, read.surface, incidences);
        print(&read(&inputs).map(summary).collect::<Vec<String>>().join("\n"))?;
    }
    for (input, path) in inputs.iter().zip(&drawings) {
        if let Ok(surface) = &input.surface {
            let drawing = drawing::drawing(input, surface, incidences);
            results::write_atomic(path, drawing.as_bytes())?;
        }
    }
    let is_odd = |read: ReadInput<'_>| !read.surface.warnings.is_empty();
    Ok(if inputs.iter().any(|input| input.surface.is_err()) {
        Exit::BadInput
    } else if arguments.strict && read(&inputs).any(is_odd) {
        Exit::CheckFailed
    } else {
        Exit::Done
    })
}

/// A file that could be read.
struct ReadInput<'a> {
    input: &'a Input,
    surface: &'a Surface,
}

fn read(inputs: &[Input]) -> impl Iterator<Item = ReadInput<'_>> {
    inputs
        .iter()
        .filter_map(|input| input.surface.as_ref().ok().map(|surface| ReadInput { input, surface }))
}
