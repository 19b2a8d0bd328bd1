//! Experiments on quasi-Monte Carlo light transport: those of Voloboy, Dmitriev and Kopylov (2003),
//! and our own on coverage and kinds of intervals, rejection sampling and next-event estimation of
//! photons.
//!
//! An [`Experiment`] takes [`Options`] and gives an [`Outcome`]: tables, plots and pictures as
//! bytes, and whether what it claims holds. It reads the clock where it compares times, and touches
//! no file.

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
mod intervals;
mod markdown;
mod neumann;
mod octant;
mod outcome;
mod periodicity;
mod points;
mod rejection;
mod significance;
mod timing;

pub use outcome::{Options, Outcome, PictureFile};

/// All experiments.
pub static EXPERIMENTS: [Experiment; 11] = [
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
        name: "intervals",
        shows: "kinds of intervals in rooms with jumps and heavy tails",
        takes: &[SEEDS],
        run: intervals::run,
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
pub struct Experiment {
    /// Its name on the command line and in its files.
    pub name: &'static str,
    /// Its subject in a few words.
    pub shows: &'static str,
    /// Which of the options it heeds.
    takes: &'static [&'static str],
    run: fn(&Options) -> Outcome,
}

impl Experiment {
    /// The experiment of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        EXPERIMENTS.iter().find(|experiment| experiment.name == name)
    }

    /// Runs the experiment, which takes seconds to minutes on all threads of the current `rayon`
    /// pool.
    #[must_use]
    pub fn run(&self, options: &Options) -> Outcome {
        let outcome = (self.run)(options);
        Outcome { markdown: markdown::filled(&outcome.markdown), ..outcome }
    }

    /// The first of the options given that changes nothing here, as it is spelt on the command
    /// line.
    #[must_use]
    pub fn unheeded(&self, options: &Options) -> Option<&'static str> {
        let given = [
            (MAX_N, options.max_n.is_some()),
            (SEEDS, options.seeds.is_some()),
            (SECONDS_PER_POINT, options.seconds_per_point.is_some()),
        ];
        let unheeded =
            |(option, is_given): &(&str, bool)| *is_given && !self.takes.contains(option);
        given.into_iter().find(unheeded).map(|(option, _)| option)
    }
}

/// Tests the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
