//! What can be said to `quasilux check`.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// The project file, or a Honeybee model (.hbjson)
    pub(crate) project: PathBuf,
    /// Folder for the plan, plan.png and plan.svg [default: out/NAME, NAME being the project
    /// file's]
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Print a document in JSON, format "quasilux-check/1", and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Exit with code 1 where something is probably wrong
    #[arg(long)]
    pub(crate) strict: bool,
    /// Print findings and errors only
    #[arg(long)]
    pub(crate) quiet: bool,
}
