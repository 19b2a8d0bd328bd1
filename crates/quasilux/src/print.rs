//! Text for stdout and stderr. A reader that has gone away is no reason to fail, a full disk is; of
//! a stderr that takes nothing nobody can be told.

use crate::exit::CliError;
use quasilux_text::{printable, printable_json, printable_lines};
use std::fmt;
use std::io::{self, BufWriter, ErrorKind, Write};

/// Prints a text of lines; names in it come from files, and the terminal obeys what it is sent.
pub(crate) fn print(text: &str) -> Result<(), CliError> {
    print_styled(&printable_lines(text))
}

/// Prints a document in JSON.
pub(crate) fn print_document(document: &str) -> Result<(), CliError> {
    print_styled(&printable_json(document))
}

/// Prints a text that may command the terminal itself.
pub(crate) fn print_styled(text: &str) -> Result<(), CliError> {
    to_stdout(|out| out.write_all(text.as_bytes()))
}

/// Tells the user something beside the output; names in it come from files, and the terminal obeys
/// what it is sent.
pub(crate) fn tell(message: impl fmt::Display) {
    let message = message.to_string();
    let lines: String = message.split('\n').map(|line| printable(line) + "\n").collect();
    tell_text(&lines);
}

/// The same with line feeds of its own.
pub(crate) fn tell_text(text: &str) {
    _ = io::stderr().write_all(text.as_bytes());
}

/// Prints piece by piece.
pub(crate) fn to_stdout(
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), CliError> {
    let mut out = BufWriter::new(io::stdout().lock());
    match write(&mut out).and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(CliError::new(format!("cannot write to stdout: {error}")))
        }
        _ => Ok(()),
    }
}
