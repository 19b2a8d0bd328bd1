//! What can be said to `quasilux photometry`.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct PhotometryArguments {
    /// Luminaire files (IES LM-63, EULUMDAT, TM-33, GLDF), told apart by their content; - is stdin
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Draw the planes C0-C180 and C90-C270: a file that ends in .svg, or a folder for one drawing
    /// of each FILE
    #[arg(long, value_name = "PATH")]
    pub(crate) svg: Option<PathBuf>,
    /// What to draw
    #[arg(long, value_name = "KIND", default_value = "both", requires = "svg")]
    pub(crate) diagram: DiagramName,
    /// Write the luminaire of one FILE in the format that this name ends in: .ies (LM-63-2002; 2019
    /// stays 2019) or .ldt
    #[arg(long, value_name = "OUT")]
    pub(crate) convert: Option<PathBuf>,
    /// Choose the variant of a GLDF container, by its id or name
    #[arg(long, value_name = "NAME")]
    pub(crate) variant: Option<String>,
    /// Choose the emitter of the variant, by its id, its object in the 3D model, or its name
    #[arg(long, value_name = "NAME")]
    pub(crate) emitter: Option<String>,
    /// Choose the light source, of several that can be exchanged, by its id, name or number
    #[arg(long, value_name = "NAME")]
    pub(crate) light_source: Option<String>,
    /// Choose the channel of a light source that has several, by its name or number
    #[arg(long, value_name = "NAME")]
    pub(crate) channel: Option<String>,
    /// Take the light that a GLDF container has in an emergency
    #[arg(long)]
    pub(crate) emergency: bool,
    /// Print a document in JSON, format "quasilux-photometry/1", and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Exit with code 1 where a file has warnings, the luminaire's losses not counted
    #[arg(long)]
    pub(crate) strict: bool,
}

/// Kinds of diagrams.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DiagramName {
    /// As in data sheets, gamma = 0 down
    Polar,
    /// Candela over gamma
    Cartesian,
    /// Side by side
    Both,
}
