//! What can be said to `quasilux import`.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct ImportArguments {
    /// The model: Honeybee (.hbjson), or the files of a Radiance scene (.rad) in their order, with
    /// points (.pts) and views (.vf)
    #[arg(value_name = "MODEL", required = true)]
    pub(crate) models: Vec<PathBuf>,
    /// The project file to write, which is not there yet; files that it names come beside it
    #[arg(long, value_name = "FILE")]
    pub(crate) out: PathBuf,
    /// The weather of a year, EPW or WEA; states of the model follow it
    #[arg(long, value_name = "FILE")]
    pub(crate) weather: Option<PathBuf>,
    /// Sensor points of a Radiance scene, in lines "x y z dx dy dz"; once or more
    #[arg(long, value_name = "FILE")]
    pub(crate) points: Vec<PathBuf>,
    /// Views of a Radiance scene (.vf); once or more
    #[arg(long = "view", value_name = "FILE")]
    pub(crate) views: Vec<PathBuf>,
}
