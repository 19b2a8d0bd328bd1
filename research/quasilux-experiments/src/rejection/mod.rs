//! `quasilux experiment rejection`: photons of a measured luminaire by inverse transform and by
//! rejection, each with random and with Sobol' points.
//!
//! Voloboy, Dmitriev and Kopylov (2003) hold that rejection spoils quasi-Monte Carlo points: each
//! trial takes coordinates of its own, and the test of acceptance is a jump in the integrand. Here
//! one batwing luminaire lights a floor and nothing is reflected, so that the error is all of the
//! photons' directions.

mod claims;
mod floor;
mod picture;
mod report;

use super::batwing::Luminaire;
use super::contrast::Contrast;
use super::emission::Method;
use crate::outcome::{Options, Outcome};
use floor::Floor;
use quasilux_sampling::quality::fit_power_law;
use quasilux_sampling::{
    DimensionHistogram, PointSet, Randomization, Sampler, Sequence, stream_key,
};
use rayon::prelude::*;

/// Randomisations of each setup.
const REPLICATES: u32 = 32;
/// The smallest number of photons.
const MIN: u64 = 1 << 6;
/// The largest one, unless the command line says otherwise.
const MAX: u64 = 1 << 18;
/// Slopes are fitted from here on: below, cells of the floor are empty.
const FIT_FROM: f64 = 1024.0;

/// A way to make directions, with points of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Setup {
    method: Method,
    sequence: Sequence,
}

/// What one setup did.
struct Curve {
    setup: Setup,
    errors: Vec<Error>,
    /// The order of convergence, where there are points enough for it.
    slope: Option<f64>,
    /// Coordinates that photons used.
    dimensions: DimensionHistogram,
}

/// After one number of photons.
struct Error {
    photons: u64,
    /// Squared error over the floor's mean squared, mean over its cells, of each replicate.
    squares: Vec<f64>,
}

/// One replicate of one setup.
struct Replicate {
    /// Mean of the squared errors, for each number of photons.
    mean_squares: Vec<f64>,
    dimensions: DimensionHistogram,
}

impl Setup {
    /// The four setups, those of the paper's claim last.
    const ALL: [Self; 4] = [
        Self { method: Method::Rejection, sequence: Sequence::Independent },
        Self { method: Method::InverseTransform, sequence: Sequence::Independent },
        Self { method: Method::Rejection, sequence: Sequence::Sobol },
        Self { method: Method::InverseTransform, sequence: Sequence::Sobol },
    ];

    fn points(self, seed: u64, replicate: u32) -> PointSet {
        let randomization = match self.sequence {
            Sequence::Independent => Randomization::None,
            _ => Randomization::Owen,
        };
        PointSet::new(self.sequence, randomization, stream_key(seed, replicate, 0))
    }
}

impl Curve {
    /// (N, root mean square).
    fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.errors.iter().map(Error::point)
    }

    /// With the most photons.
    fn last(&self) -> &Error {
        self.errors.last().expect("there is a least number")
    }
}

impl Error {
    /// N, and the root mean square over floor cells and replicates.
    fn point(&self) -> [f64; 2] {
        let mean = self.squares.iter().sum::<f64>() / self.squares.len() as f64;
        [self.photons as f64, mean.sqrt()]
    }

    /// How many times smaller this error is than another.
    fn under(&self, worse: &Self) -> Contrast {
        Contrast::gain(&worse.squares, &self.squares)
    }
}

/// Measures the four curves.
pub(super) fn run(arguments: &Options) -> Outcome {
    let counts = counts(arguments.max_n.unwrap_or(MAX));
    let luminaire = Luminaire::batwing();
    let floor = Floor::under(&luminaire.photometry);
    let curves = Setup::ALL.map(|setup| curve(setup, &luminaire, &floor, &counts, arguments.seed));
    let claims = claims::claims(&curves);
    let tables = report::markdown(&curves, &luminaire, &floor, &claims);
    Outcome::new(report::csv(&curves), tables, picture::svg(&curves), &claims)
}

/// Powers of two.
fn counts(most: u64) -> Vec<u64> {
    std::iter::successors(Some(MIN), |count| Some(2 * count))
        .take_while(|count| *count <= most.max(MIN))
        .collect()
}

fn curve(setup: Setup, luminaire: &Luminaire, floor: &Floor, counts: &[u64], seed: u64) -> Curve {
    let replicates: Vec<Replicate> = (0..REPLICATES)
        .into_par_iter()
        .map(|number| {
            replicate(setup.method, &setup.points(seed, number), luminaire, floor, counts)
        })
        .collect();
    let mut dimensions = DimensionHistogram::new();
    for replicate in &replicates {
        dimensions.merge(&replicate.dimensions);
    }
    let error = |(k, photons): (usize, &u64)| {
        let squares = replicates.iter().map(|replicate| replicate.mean_squares[k]).collect();
        Error { photons: *photons, squares }
    };
    let errors: Vec<Error> = counts.iter().enumerate().map(error).collect();
    let points = errors.iter().map(Error::point);
    let fitted: Vec<[f64; 2]> = points.filter(|[n, _]| *n >= FIT_FROM).collect();
    let slope = fit_power_law(&fitted).map(|law| law.exponent);
    Curve { setup, errors, slope, dimensions }
}

fn replicate(
    method: Method,
    points: &PointSet,
    luminaire: &Luminaire,
    floor: &Floor,
    counts: &[u64],
) -> Replicate {
    let mut hits = floor.hits();
    let mut dimensions = DimensionHistogram::new();
    let mut index = 0;
    let mean_squares = counts
        .iter()
        .map(|count| {
            while index < *count {
                let mut sampler = Sampler::new(points, index);
                hits.record(method.direction(luminaire, &mut sampler));
                dimensions.record(sampler.used());
                index += 1;
            }
            hits.mean_square_error(*count)
        })
        .collect();
    Replicate { mean_squares, dimensions }
}
