//! How many lux, and how sure: the program.

use std::process::ExitCode;

fn main() -> ExitCode {
    quasilux::command_line(std::env::args_os()).into()
}
