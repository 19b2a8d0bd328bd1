//! How the program ends.

use std::fmt;
use std::process::ExitCode;

/// Exit codes, part of the contract with scripts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Done, and the tolerance reached.
    Done = 0,
    /// A check failed.
    CheckFailed = 1,
    /// Bad arguments or input; nothing was computed.
    BadInput = 2,
    /// A limit came before the tolerance; results are written.
    Limited = 3,
    /// Interrupted; results of the last checkpoint are written.
    Interrupted = 130,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// Why the program refuses to do what it was told: one clear message.
#[derive(Debug)]
pub(crate) struct CliError(String);

impl CliError {
    pub(crate) fn new(message: impl fmt::Display) -> Self {
        Self(message.to_string())
    }
}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl From<quasilux_scene::LoadError> for CliError {
    fn from(error: quasilux_scene::LoadError) -> Self {
        Self::new(error)
    }
}
