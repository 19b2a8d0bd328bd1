//! Photons in a closed box: what they hit after each number of them, in each randomisation, and how
//! far that is from the mean of all.

use super::closed_box::CELLS;
use super::contrast::Contrast;
use quasilux_sampling::{
    DimensionHistogram, PointSet, Randomization, Sampler, Sequence, stream_key,
};
use rayon::prelude::*;

/// The smallest number of photons.
pub(super) const MIN: u64 = 1 << 8;

/// What photons of one kind did.
pub(super) struct Flights {
    pub(super) sequence: Sequence,
    /// For each number of photons.
    pub(super) errors: Vec<Error>,
    /// Coordinates that photons used.
    pub(super) dimensions: DimensionHistogram,
}

/// Of one number of photons.
pub(super) struct Error {
    pub(super) photons: u64,
    /// Squared error over mean illuminance squared, mean over cells, of each replicate.
    squares: Vec<f64>,
}

/// How many photons fly, and how often.
#[derive(Clone, Copy)]
pub(super) struct Effort {
    /// The largest number of photons.
    pub(super) most: u64,
    pub(super) replicates: u32,
    pub(super) seed: u64,
}

/// Hits of each cell after each number of photons, and the coordinates of all of them.
struct Replicate {
    hits: Vec<Vec<u32>>,
    dimensions: DimensionHistogram,
}

impl Flights {
    /// Sends photons, each of which tells of every cell that it lands in.
    pub(super) fn trace(
        photon: impl Fn(&mut Sampler<'_>, &mut dyn FnMut(usize)) + Sync,
        sequence: Sequence,
        effort: Effort,
    ) -> Self {
        let one = |replicate| {
            let randomization = match sequence {
                Sequence::Independent => Randomization::None,
                _ => Randomization::Owen,
            };
            let key = stream_key(effort.seed, replicate, 0);
            Replicate::trace(&photon, &PointSet::new(sequence, randomization, key), effort.most)
        };
        let traced: Vec<Replicate> = (0..effort.replicates).into_par_iter().map(one).collect();
        let mut dimensions = DimensionHistogram::new();
        traced.iter().for_each(|replicate| dimensions.merge(&replicate.dimensions));
        let error = |(k, photons): (usize, u64)| {
            let hits: Vec<&[u32]> = traced.iter().map(|one| one.hits[k].as_slice()).collect();
            Error::new(photons, &hits)
        };
        let errors = counts(effort.most).enumerate().map(error).collect();
        Self { sequence, errors, dimensions }
    }

    /// (N, root mean square error).
    pub(super) fn points(&self) -> Vec<[f64; 2]> {
        self.errors.iter().map(|error| [error.photons as f64, error.rms()]).collect()
    }

    /// With the most photons.
    pub(super) fn last(&self) -> &Error {
        self.errors.last().expect("there is a least number")
    }
}

impl Replicate {
    fn trace(
        photon: &impl Fn(&mut Sampler<'_>, &mut dyn FnMut(usize)),
        points: &PointSet,
        most: u64,
    ) -> Self {
        let mut dimensions = DimensionHistogram::new();
        let mut hits = vec![0; CELLS];
        let mut index = 0;
        let all = counts(most).map(|photons| {
            while index < photons {
                let mut sampler = Sampler::new(points, index);
                photon(&mut sampler, &mut |cell| hits[cell] += 1);
                dimensions.record(sampler.used());
                index += 1;
            }
            hits.clone()
        });
        let hits = all.collect();
        Self { hits, dimensions }
    }
}

impl Error {
    /// Of the hits of all replicates: how far each is from the mean of all, which is without bias.
    fn new(photons: u64, hits: &[&[u32]]) -> Self {
        let count = hits.len() as f64;
        let mean = |cell: usize| hits.iter().map(|h| f64::from(h[cell])).sum::<f64>() / count;
        let means: Vec<f64> = (0..CELLS).map(mean).collect();
        let scale = means.iter().sum::<f64>() / CELLS as f64;
        let square = |hits: &&[u32]| {
            let parts = hits.iter().zip(&means).map(|(hits, mean)| f64::from(*hits) - mean);
            let sum: f64 = parts.map(|part| part * part).sum();
            sum / (CELLS as f64 * scale * scale) * count / (count - 1.0)
        };
        Self { photons, squares: hits.iter().map(square).collect() }
    }

    /// Root mean square.
    pub(super) fn rms(&self) -> f64 {
        libm::sqrt(self.squares.iter().sum::<f64>() / self.squares.len() as f64)
    }

    /// How many times this error is another one.
    pub(super) fn over(&self, other: &Self) -> Contrast {
        Contrast::gain(&self.squares, &other.squares)
    }
}

/// Powers of four.
fn counts(most: u64) -> impl Iterator<Item = u64> {
    std::iter::successors(Some(MIN), |count| Some(4 * count)).take_while(move |n| *n <= most)
}
