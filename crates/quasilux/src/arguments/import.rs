//! What can be said to `quasilux import`.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct ImportArguments {
    /// The model: Honeybee (.hbjson)
    #[arg(value_name = "MODEL")]
    pub(crate) model: PathBuf,
    /// The project file to write, which is not there yet; files that it names come beside it
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// The weather of a year, EPW or WEA; states of the model follow it
    #[arg(long, value_name = "FILE")]
    pub(crate) weather: Option<PathBuf>,
}
