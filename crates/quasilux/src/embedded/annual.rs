//! The daylight of a year.

use super::run::parse;
use crate::arguments::{AnnualArguments, Command};
use crate::commands::{FinishedYear, YearListener, year_in_memory};
use crate::exit::CliError;
use crate::kernel;
use crate::project::Project;
use std::ffi::OsString;
use std::path::Path;

/// Options of a year.
#[derive(Debug)]
pub struct YearOrder(AnnualArguments);

impl YearOrder {
    /// From options of `quasilux annual`, such as `--occupied=8-18`. Where results go, and whether
    /// and which part of the year is kept, is not asked.
    ///
    /// # Errors
    /// When an option is unknown or its value makes no sense, in the words of the command line; or
    /// when `QUASILUX_KERNEL` names no ray kernel of this machine.
    pub fn from_words(words: impl IntoIterator<Item = OsString>) -> Result<Self, CliError> {
        kernel::choose()?;
        match parse("annual", Path::new("scene"), words)? {
            Command::Annual(arguments) => Ok(Self(arguments)),
            _ => Err(CliError::new("no year")),
        }
    }
}

/// Simulates a year of a project, as `quasilux annual` does, or as much of it as the listener lets.
///
/// # Errors
/// When the project has no weather or no sensors, or the options make no sense for it.
pub fn annual(
    project: &Project,
    order: &YearOrder,
    listener: Option<YearListener<'_>>,
) -> Result<FinishedYear, CliError> {
    year_in_memory(project, &order.0, listener)
}
