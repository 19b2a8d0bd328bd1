//! The daylight of a year.

use super::options::YearOptions;
use crate::arguments::YearArguments;
use crate::commands::{FinishedYear, YearListener, year_in_memory};
use crate::exit::CliError;
use crate::kernel;
use crate::project::Project;

/// Checked options of a year.
#[derive(Debug)]
pub struct YearOrder(YearArguments);

impl YearOrder {
    /// Checks options as `quasilux annual` does.
    ///
    /// # Errors
    /// When a value makes no sense, with the name of its field and what was expected; or when
    /// `QUASILUX_KERNEL` names no ray kernel of this machine.
    pub fn new(options: &YearOptions) -> Result<Self, CliError> {
        kernel::choose()?;
        options.arguments().map(Self)
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
