//! How the program ends.

use quasilux_scene::{LoadError, Position};
use std::fmt;
use std::process::ExitCode;

/// Exit codes, part of the contract with scripts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exit {
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

impl Exit {
    /// What the operating system is told.
    #[must_use]
    pub fn code(self) -> u8 {
        self as u8
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// Why the program refuses to do what it was told: one clear message, with the place in a file
/// where there is one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CliError {
    file: Option<String>,
    place: Option<Position>,
    message: String,
}

impl CliError {
    pub(crate) fn new(message: impl fmt::Display) -> Self {
        Self { file: None, place: None, message: message.to_string() }
    }

    /// What is wrong with a file, at a place in it where there is one; `file` is what messages call
    /// it.
    pub(crate) fn in_file(
        file: impl fmt::Display,
        place: Option<Position>,
        message: impl fmt::Display,
    ) -> Self {
        Self { file: Some(file.to_string()), place, message: message.to_string() }
    }

    /// The same, with more to say behind it.
    pub(crate) fn with_advice(mut self, advice: &str) -> Self {
        self.message += advice;
        self
    }

    /// The file that is wrong, as messages call it.
    #[must_use]
    pub fn file(&self) -> Option<&str> {
        self.file.as_deref()
    }

    /// The place in that file.
    #[must_use]
    pub fn place(&self) -> Option<Position> {
        self.place
    }

    /// What is wrong and what was expected, without the place.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }
}

impl std::error::Error for CliError {}

impl fmt::Display for CliError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, place, message } = self;
        match (file, place) {
            (Some(file), Some(place)) => write!(f, "{file}:{place}: {message}"),
            (Some(file), None) => write!(f, "{file}: {message}"),
            (None, _) => f.write_str(message),
        }
    }
}

impl From<LoadError> for CliError {
    fn from(error: LoadError) -> Self {
        let suggestion = error.suggestion().map(|name| format!("; did you mean \"{name}\"?"));
        let message = format!("{}{}", error.message(), suggestion.unwrap_or_default());
        Self::in_file(error.file(), error.place(), message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scripts know the line of the command line, programs its parts.
    #[test]
    fn errors_of_loading_keep_their_text_and_their_parts() {
        struct Nothing;
        impl quasilux_scene::Files for Nothing {
            fn read(&self, _: &str, _: quasilux_scene::FileKind) -> std::io::Result<Vec<u8>> {
                Err(std::io::ErrorKind::NotFound.into())
            }
        }
        let load = || quasilux_scene::load("a.toml", b"\n[scene]\ngeomtry = 1", &Nothing);
        let error = load().expect_err("a refusal");
        let told = CliError::from(error.clone());
        assert_eq!(told.to_string(), error.to_string());
        assert_eq!((told.file(), told.place()), (Some("a.toml"), error.place()));
        assert!(told.message().ends_with("did you mean \"geometry\"?"), "{told}");
        assert_eq!(CliError::new("x").to_string(), "x");
    }
}
