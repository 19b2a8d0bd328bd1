//! The question to an experiment and its answer: options in, the contents of files out.

use crate::claim::Claim;
use std::time::Duration;

/// How much work an experiment is to do; `None` leaves a number to the experiment.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Largest number of photons or points compared, `--max-n`.
    pub max_n: Option<u64>,
    /// Runs of each setup, 2 or more, `--seeds`.
    pub seeds: Option<u32>,
    /// Time for one setup, where errors are shown against time, `--seconds-per-point`.
    pub seconds_per_point: Option<Duration>,
    /// Seed of all randomisations; the first one where there are several.
    pub seed: u64,
}

/// The results of an experiment, as the contents of files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// All figures, as CSV.
    pub csv: String,
    /// Tables and claims, as Markdown.
    pub markdown: String,
    /// The plot, as SVG.
    pub svg: String,
    /// Pictures beside the plot.
    pub pictures: Vec<PictureFile>,
    /// Whether all claims hold.
    pub passed: bool,
}

/// A picture of an experiment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PictureFile {
    /// The part of the file name between the name of the experiment and the ending.
    pub name: String,
    /// The contents of the PNG file.
    pub png: Vec<u8>,
}

impl Outcome {
    /// Passed if all claims hold; without pictures.
    pub(crate) fn new(csv: String, markdown: String, svg: String, claims: &[Claim]) -> Self {
        Self { csv, markdown, svg, pictures: Vec::new(), passed: Claim::all_hold(claims) }
    }
}
