//! The command behind `cargo xtask gauntlet`.

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match quasilux_gauntlet::command::run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("gauntlet: not all claims hold");
            ExitCode::FAILURE
        }
        Err(failure) => {
            eprintln!("gauntlet: {failure}");
            ExitCode::from(2)
        }
    }
}
