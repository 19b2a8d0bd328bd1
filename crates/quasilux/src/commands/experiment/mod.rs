//! `quasilux experiment NAME`: the experiments of the paper and our own, each a folder of its own once
//! built.

mod batwing;
mod bsdf_rejection;
mod building;
mod claim;
mod closed_box;
mod contrast;
mod course;
mod coverage;
mod cube;
mod dimension;
mod emission;
mod error_plot;
mod first_shot;
mod flights;
mod neumann;
mod octant;
mod periodicity;
mod points;
mod rejection;
mod significance;
mod timing;

use crate::arguments::ExperimentArguments;
use crate::exit::{Exit, Refusal};
use crate::print::print;
use crate::{digest, results};
use claim::Claim;
use std::path::{Path, PathBuf};

/// Experiments that can be run, with what they show.
const BUILT: [Experiment; 10] = [
    Experiment {
        name: "cube",
        shows: "the diffuse cube, tables 4 and 5 of the paper",
        takes: ALL,
        run: cube::run,
    },
    Experiment {
        name: "dimension",
        shows: "what superposition and inverse transform save",
        takes: COUNTED,
        run: dimension::run,
    },
    Experiment { name: "points", shows: "figures 5 and 6", takes: &[SEEDS], run: points::run },
    Experiment {
        name: "periodicity",
        shows: "coherent groups, table 2",
        takes: &[MAX_N],
        run: periodicity::run,
    },
    Experiment {
        name: "rejection",
        shows: "inverse transform against rejection",
        takes: &[MAX_N],
        run: rejection::run,
    },
    Experiment {
        name: "bsdf-rejection",
        shows: "inverse transform against rejection on measured surfaces",
        takes: COUNTED,
        run: bsdf_rejection::run,
    },
    Experiment {
        name: "coverage",
        shows: "how often the intervals hold the truth",
        takes: &[SEEDS],
        run: coverage::run,
    },
    Experiment {
        name: "octant",
        shows: "the mirror octant, table 3",
        takes: ALL,
        run: octant::run,
    },
    Experiment {
        name: "first-shot",
        shows: "direct light taken out of the integral",
        takes: ALL,
        run: first_shot::run,
    },
    Experiment {
        name: "neumann",
        shows: "pictures of the Neumann terms, table 1",
        takes: COUNTED,
        run: neumann::run,
    },
];

/// Options that not all experiments have a use for.
const MAX_N: &str = "--max-n";
const SEEDS: &str = "--seeds";
const SECONDS_PER_POINT: &str = "--seconds-per-point";
const COUNTED: &[&str] = &[MAX_N, SEEDS];
const ALL: &[&str] = &[MAX_N, SEEDS, SECONDS_PER_POINT];

/// An experiment.
struct Experiment {
    name: &'static str,
    shows: &'static str,
    /// Which of the options it heeds.
    takes: &'static [&'static str],
    run: fn(&ExperimentArguments) -> Outcome,
}

/// What an experiment found, as files.
struct Outcome {
    /// All figures, for programs.
    csv: String,
    /// The same for people, with what is seen in them.
    markdown: String,
    /// The plot.
    svg: String,
    /// Pictures beside it: what comes between the name of the experiment and the ending, and a PNG file.
    pictures: Vec<(String, Vec<u8>)>,
    /// Whether what it checks holds.
    passed: bool,
}

impl Experiment {
    /// The first of the options given that changes nothing here.
    fn unheeded(&self, arguments: &ExperimentArguments) -> Option<&'static str> {
        let given = [
            (MAX_N, arguments.max_n.is_some()),
            (SEEDS, arguments.seeds.is_some()),
            (SECONDS_PER_POINT, arguments.seconds_per_point.is_some()),
        ];
        let unheeded =
            |(option, is_given): &(&str, bool)| *is_given && !self.takes.contains(option);
        given.into_iter().find(unheeded).map(|(option, _)| option)
    }
}

impl Outcome {
    /// Passed if all claims hold; without pictures.
    fn new(csv: String, markdown: String, svg: String, claims: &[Claim]) -> Self {
        Self { csv, markdown, svg, pictures: Vec::new(), passed: Claim::all_hold(claims) }
    }
}

/// Runs an experiment, writes its files and prints its table.
pub(crate) fn experiment(arguments: &ExperimentArguments) -> Result<Exit, Refusal> {
    let name = arguments.name.as_str();
    let Some(experiment) = BUILT.iter().find(|experiment| experiment.name == name) else {
        return Err(refused(name));
    };
    if let Some(option) = experiment.unheeded(arguments) {
        eprintln!("warning: the experiment \"{name}\" takes no heed of {option}");
    }
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("out").join(name));
    results::prepare(&folder)?;
    let outcome = (experiment.run)(arguments);
    let file = |ending: &str| -> PathBuf { folder.join(format!("{name}.{ending}")) };
    results::write_whole(&file("csv"), outcome.csv.as_bytes())?;
    // So that tables and figures are known to belong together, and to be as they were written.
    let [csv, text] =
        [&outcome.csv, &outcome.markdown].map(|text| digest::sha256_hex(text.as_bytes()));
    let tables = format!(
        "{}\n<!-- SHA-256 of {name}.csv: {csv}, of the text before: {text} -->\n",
        outcome.markdown
    );
    results::write_whole(&file("md"), tables.as_bytes())?;
    results::write_whole(&file("svg"), outcome.svg.as_bytes())?;
    for (what, png) in &outcome.pictures {
        results::write_whole(&folder.join(format!("{name}-{what}.png")), png)?;
    }
    print(&format!("{}\nFiles: {}\n", outcome.markdown, file("{csv,md,svg}").display()))?;
    Ok(if outcome.passed { Exit::Done } else { Exit::CheckFailed })
}

fn refused(name: &str) -> Refusal {
    let list = BUILT.iter().map(|built| format!("{} ({})", built.name, built.shows));
    let list = list.collect::<Vec<_>>().join(", ");
    Refusal::new(format!("unknown experiment \"{name}\"; there is {list}"))
}
