//! `quasilux experiment NAME`: the experiments of the paper, each a file of its own once built.

use crate::arguments::ExperimentArguments;
use crate::exit::{Exit, Refusal};

/// Experiments that are planned, with what they show.
const PLANNED: [(&str, &str); 8] = [
    ("cube", "the diffuse cube, tables 4 and 5 of the paper"),
    ("octant", "the mirror octant, table 3"),
    ("neumann", "pictures of the Neumann terms, table 1"),
    ("points", "figures 5 and 6"),
    ("periodicity", "coherent groups, table 2"),
    ("rejection", "inverse transform against rejection"),
    ("dimension", "what superposition and inverse transform save"),
    ("first-shot", "direct light taken out of the integral"),
];

/// Runs an experiment.
pub(crate) fn experiment(arguments: &ExperimentArguments) -> Result<Exit, Refusal> {
    let name = arguments.name.as_str();
    match PLANNED.iter().find(|(planned, _)| *planned == name) {
        Some((_, what)) => Err(Refusal::not_built(format!("the experiment \"{name}\" ({what})"))),
        None => {
            let names: Vec<&str> = PLANNED.iter().map(|(planned, _)| *planned).collect();
            Err(Refusal::new(format!(
                "unknown experiment \"{name}\"; planned are {}",
                names.join(", ")
            )))
        }
    }
}
