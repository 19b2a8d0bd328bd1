//! `quasilux experiment dimension`: what superposition and inverse transform save in coordinates and in error.
//!
//! Voloboy, Dmitriev and Kopylov (2003) bring the dimension of photons down by two means: one coordinate serves
//! a choice and then what hangs on it (modified superposition), and directions of measured luminaires take
//! two coordinates by inverse transform instead of three for each trial of rejection. Here a room with four measured luminaires is
//! lit by photons with all of it, with each feature turned off by itself, and with none; and the coordinates of the
//! paper's cube are counted.

mod cube;
mod picture;
mod report;
mod room;
mod walk;

use super::Outcome;
use super::claim::Claim;
use super::gain::Gain;
use crate::arguments::ExperimentArguments;
use cube::Cube;
use quasilux_measure::number::count;
use quasilux_sampling::{
    DimensionHistogram, PointSet, Randomization, SampleCursor, Sequence, stream_key,
};
use rayon::prelude::*;
use room::{CELLS, Room};
use walk::{Features, Walk};

/// Randomisations of each setup, unless the command line says otherwise.
const REPLICATES: u32 = 64;
/// The smallest number of photons.
const LEAST: u64 = 1 << 8;
/// The largest one, unless the command line says otherwise.
const MOST: u64 = 1 << 16;
/// The sequences that are compared, random points last.
const SEQUENCES: [Sequence; 2] = [Sequence::Sobol, Sequence::Random];
/// Standard errors that chance exceeds once in 16 000 comparisons.
const ALIKE: f64 = 4.0;

/// Photons with some features and points of one kind.
struct Setup {
    name: &'static str,
    features: Features,
    sequence: Sequence,
    /// For each number of photons.
    errors: Vec<Error>,
    dimensions: DimensionHistogram,
}

/// Of one number of photons.
struct Error {
    photons: u64,
    /// Squared error over mean illuminance squared, mean over cells, of each replicate.
    squares: Vec<f64>,
}

impl Error {
    /// Of the hits of all replicates: how far each is from the mean of all, which is without bias.
    fn new(photons: u64, hits: &[Vec<u32>]) -> Self {
        let count = hits.len() as f64;
        let mean = |cell: usize| hits.iter().map(|h| f64::from(h[cell])).sum::<f64>() / count;
        let means: Vec<f64> = (0..CELLS).map(mean).collect();
        let scale = means.iter().sum::<f64>() / CELLS as f64;
        let square = |hits: &Vec<u32>| {
            let parts = hits.iter().zip(&means).map(|(hits, mean)| f64::from(*hits) - mean);
            let sum: f64 = parts.map(|part| part * part).sum();
            sum / (CELLS as f64 * scale * scale) * count / (count - 1.0)
        };
        Self { photons, squares: hits.iter().map(square).collect() }
    }

    /// Root mean square.
    fn rms(&self) -> f64 {
        libm::sqrt(self.squares.iter().sum::<f64>() / self.squares.len() as f64)
    }

    /// How many times this error is another one.
    fn over(&self, other: &Self) -> Gain {
        Gain::of_squares(&self.squares, &other.squares)
    }
}

/// Traces all setups, and counts coordinates in the cube.
pub(super) fn run(arguments: &ExperimentArguments) -> Outcome {
    let replicates = arguments.seeds.unwrap_or(REPLICATES).max(2);
    let most = arguments.max_n.unwrap_or(MOST).max(LEAST);
    let setups = setups(most, replicates, arguments.seed);
    let cube = Cube::count(most, arguments.seed);
    let claims: Vec<Claim> = cube.claims().into_iter().chain(claims(&setups)).collect();
    let tables = report::markdown(&setups, &cube, replicates, &claims);
    Outcome::new(report::csv(&setups, &cube), tables, picture::svg(&setups), &claims)
}

fn setups(most: u64, replicates: u32, seed: u64) -> Vec<Setup> {
    let room = Room::furnished();
    let all = SEQUENCES.into_iter().flat_map(|s| Features::ALL.map(move |named| (s, named)));
    all.map(|(sequence, (name, features))| {
        let one =
            |replicate| trace(&room, features, sequence, most, stream_key(seed, replicate, 0));
        let traced: Vec<(Vec<Vec<u32>>, DimensionHistogram)> =
            (0..replicates).into_par_iter().map(one).collect();
        let mut dimensions = DimensionHistogram::new();
        traced.iter().for_each(|(_, own)| dimensions.merge(own));
        let error = |(k, photons): (usize, u64)| {
            let hits: Vec<Vec<u32>> = traced.iter().map(|(hits, _)| hits[k].clone()).collect();
            Error::new(photons, &hits)
        };
        let errors = counts(most).enumerate().map(error).collect();
        Setup { name, features, sequence, errors, dimensions }
    })
    .collect()
}

/// Powers of four.
fn counts(most: u64) -> impl Iterator<Item = u64> {
    std::iter::successors(Some(LEAST), |count| Some(4 * count)).take_while(move |n| *n <= most)
}

/// Hits of each cell after each number of photons, and the coordinates of all of them.
fn trace(
    room: &Room,
    features: Features,
    sequence: Sequence,
    most: u64,
    key: u64,
) -> (Vec<Vec<u32>>, DimensionHistogram) {
    let randomization = match sequence {
        Sequence::Random => Randomization::None,
        _ => Randomization::Owen,
    };
    let points = PointSet::new(sequence, randomization, key);
    let walk = Walk { room, features };
    let mut dimensions = DimensionHistogram::new();
    let mut hits = vec![0; CELLS];
    let mut index = 0;
    let all = counts(most).map(|photons| {
        while index < photons {
            let mut cursor = SampleCursor::new(&points, index);
            walk.photon(&mut cursor, |cell| hits[cell] += 1);
            dimensions.record(cursor.used());
            index += 1;
        }
        hits.clone()
    });
    (all.collect(), dimensions)
}

fn claims(setups: &[Setup]) -> Vec<Claim> {
    let of = |sequence: Sequence| {
        let own: Vec<&Setup> = setups.iter().filter(|setup| setup.sequence == sequence).collect();
        own
    };
    let last = |setup: &Setup| -> usize { setup.errors.len() - 1 };
    let mut claims = Vec::new();
    let sobol = of(Sequence::Sobol);
    let (full, others) = sobol.split_first().expect("all features are the first setup");
    let best = &full.errors[last(full)];
    for setup in others {
        let error = &setup.errors[last(setup)];
        let gain = error.over(best);
        let coordinates = setup.dimensions.mean() - full.dimensions.mean();
        let asked = if setup.features.must_show() {
            ", which is more than 1 at a significance of 1 %"
        } else {
            ", of which nothing is asked"
        };
        claims.push(Claim {
            text: format!(
                "With Sobol' points {} costs {coordinates:.1} coordinates a photon and {} times the error at N = \
                 {} (95 %){asked}",
                setup.name,
                gain.text(),
                count(error.photons),
            ),
            holds: coordinates > 0.0 && (gain.is_sure() || !setup.features.must_show()),
        });
    }
    let random = of(Sequence::Random);
    let plain = &random[0].errors[last(random[0])];
    let off = |setup: &&Setup| setup.errors[last(setup)].over(plain).standard_errors().abs();
    let most = random[1..].iter().map(off).fold(0.0, f64::max);
    claims.push(Claim {
        text: format!(
            "Random points do not care: no setup is further than {most:.1} standard errors from the one with all \
             features (4 allowed)"
        ),
        holds: most < ALIKE,
    });
    let gain = plain.over(best);
    claims.push(Claim {
        text: format!(
            "With all features Sobol' points divide the error of random ones by {} (95 %) at N = {}, by more than \
             1 at a significance of 1 %",
            gain.text(),
            count(best.photons),
        ),
        holds: gain.is_sure(),
    });
    claims
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_claimed_holds() {
        let setups = setups(1 << 12, 32, 0);
        let claims: Vec<Claim> =
            Cube::count(1 << 13, 0).claims().into_iter().chain(claims(&setups)).collect();
        assert_eq!(claims.len(), 4 + 4 + 2);
        let failed: Vec<&str> =
            claims.iter().filter(|claim| !claim.holds).map(|claim| claim.text.as_str()).collect();
        assert!(failed.is_empty(), "{failed:?}");
    }
}
