//! What can be said to `quasilux export`.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct ExportArguments {
    /// The project file, or a model that commands read
    pub(crate) project: PathBuf,
    /// Write the scene for Radiance to this folder: a scene file for oconv, points and views
    #[arg(long, value_name = "FOLDER")]
    pub(crate) radiance: PathBuf,
}
