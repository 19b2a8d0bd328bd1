//! `quasilux photometry FILE...`: what luminaire files say, as a summary, a document, drawings
//! or a file of another format.
//!
//! A file that cannot be read does not keep the others from being reported; the exit code is 2 all
//! the same. Warnings leave it at 0, or make it 1 with `--strict`.

mod conversion;
mod document;
mod drawing;
mod input;
mod outputs;
mod summary;
mod words;

use crate::arguments::PhotometryArguments;
use crate::exit::{CliError, Exit};
use crate::print::{print, print_document, tell};
use crate::results;
use input::{Input, Luminaire};
use outputs::Outputs;
use quasilux_photometry::GldfChoice;

/// Reads and reports all files.
pub(crate) fn photometry(arguments: &PhotometryArguments) -> Result<Exit, CliError> {
    let outputs = Outputs::prepare(arguments)?;
    let choice = GldfChoice {
        variant: arguments.variant.clone(),
        emitter: arguments.emitter.clone(),
        light_source: arguments.light_source.clone(),
        channel: arguments.channel.clone(),
        emergency: arguments.emergency,
    };
    let inputs: Vec<Input> =
        arguments.files.iter().map(|path| Input::read(path, &choice)).collect();
    for input in &inputs {
        if let Err(failure) = &input.luminaire {
            tell(format_args!("error: {failure}"));
        }
    }
    if arguments.json {
        print_document(&document::document(&inputs))?;
    } else {
        let summaries: Vec<String> =
            read(&inputs).map(|read| summary::summary(read.input, read.luminaire)).collect();
        print(&summaries.join("\n"))?;
    }
    for (i, input) in inputs.iter().enumerate() {
        if let Ok(luminaire) = &input.luminaire
            && let Some(path) = outputs.drawing(i)
        {
            let drawing = drawing::drawing(input, luminaire, arguments.diagram);
            results::write_atomic(path, drawing.as_bytes())?;
        }
    }
    if let (Some(wanted), Some(first)) = (&outputs.conversion, read(&inputs).next()) {
        conversion::convert(&first, wanted)?;
    }
    Ok(exit(&inputs, arguments.strict))
}

/// A file that could be read.
struct ReadInput<'a> {
    input: &'a Input,
    luminaire: &'a Luminaire,
}

fn read(inputs: &[Input]) -> impl Iterator<Item = ReadInput<'_>> {
    inputs.iter().filter_map(|input| {
        input.luminaire.as_ref().ok().map(|luminaire| ReadInput { input, luminaire })
    })
}

fn exit(inputs: &[Input], strict: bool) -> Exit {
    let is_odd = |read: ReadInput<'_>| read.luminaire.is_odd();
    if inputs.iter().any(|input| input.luminaire.is_err()) {
        Exit::BadInput
    } else if strict && read(inputs).any(is_odd) {
        Exit::CheckFailed
    } else {
        Exit::Done
    }
}
