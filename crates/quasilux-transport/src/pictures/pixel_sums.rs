//! What the paths of pixels found: exact sums.

use crate::estimator::bidirectional::{PixelSink, Sink};
use crate::spectrum::Spectrum;
use crate::stats::tally::{Quantum, Sum};

/// Channels of a picture.
const RGB: usize = 3;

/// Sums over the paths of a block.
pub(super) struct BlockSums {
    /// Of pixel p in replicate r at `p * replicates + r`.
    pub(super) sums: Vec<PixelSums>,
    /// Of each pixel, the smallest disc that photons count on, in m^2; `None` where nothing is
    /// seen.
    pub(super) least_disc_m2: Vec<Option<f64>>,
}

/// Sums over the paths of one pixel in one replicate.
#[derive(Clone, Copy, Default)]
pub(super) struct PixelSums {
    channels: [Sum; RGB],
    /// The part of their luminance that photons brought.
    merged: Sum,
    /// Paths that came to a surface that reflects.
    pub(super) reflected: u64,
}

/// Sums over the pixels of a picture.
pub(super) struct PictureSums {
    /// Of the luminances, in cd/m^2, one a replicate.
    pub(super) cd_m2: Vec<f64>,
    /// Of the part that photons brought, over all replicates, in cd/m^2.
    pub(super) merged_cd_m2: f64,
    pub(super) invalid: u64,
}

/// Takes what paths of one replicate find.
pub(super) struct TileSink<'t> {
    pub(super) found: &'t mut BlockSums,
    pub(super) replicate: u32,
    pub(super) replicates: u32,
    pub(super) quantum: Quantum,
}

impl TileSink<'_> {
    /// Of a pixel of the block.
    fn sums(&mut self, pixel: usize) -> &mut PixelSums {
        &mut self.found.sums[pixel * self.replicates as usize + self.replicate as usize]
    }
}

impl<S: Spectrum> Sink<S> for TileSink<'_> {
    fn add(&mut self, pixel: usize, _bounces: u32, light: S) {
        let quantum = self.quantum;
        self.sums(pixel).add(light, quantum);
    }

    fn add_merged(&mut self, pixel: usize, bounces: u32, light: S) {
        self.add(pixel, bounces, light);
        let quantum = self.quantum;
        self.sums(pixel).merged.add(light.luminance(), quantum);
    }
}

impl<S: Spectrum> PixelSink<S> for TileSink<'_> {
    fn arrive(&mut self, pixel: usize, disc_m2: f64) {
        self.sums(pixel).reflected += 1;
        let least_m2 = &mut self.found.least_disc_m2[pixel];
        *least_m2 = Some(least_m2.map_or(disc_m2, |least_m2| least_m2.min(disc_m2)));
    }
}

impl PictureSums {
    pub(super) fn new(replicates: u32) -> Self {
        Self { cd_m2: vec![0.0; replicates as usize], merged_cd_m2: 0.0, invalid: 0 }
    }

    /// Adds a block with this many paths of each pixel in each replicate.
    pub(super) fn add<S: Spectrum>(&mut self, block: &BlockSums, samples: u64, quantum: Quantum) {
        let mut of_block = vec![PixelSums::default(); self.cd_m2.len()];
        for own in block.sums.chunks_exact(of_block.len()) {
            of_block.iter_mut().zip(own).for_each(|(sum, own)| sum.merge(*own));
        }
        for (cd_m2, own) in self.cd_m2.iter_mut().zip(&of_block) {
            *cd_m2 += own.mean::<S>(samples, quantum).luminance();
            self.merged_cd_m2 += quantum.value(own.merged) / samples as f64;
            self.invalid += own.channels.map(|sum| sum.invalid).iter().sum::<u64>();
        }
    }
}

impl PixelSums {
    fn add<S: Spectrum>(&mut self, light: S, quantum: Quantum) {
        for (c, channel) in self.channels.iter_mut().enumerate().take(S::CHANNELS) {
            channel.add(light.channel(c), quantum);
        }
    }

    /// The mean of this many paths.
    pub(super) fn mean<S: Spectrum>(&self, samples: u64, quantum: Quantum) -> S {
        S::from_channels(|channel| quantum.value(self.channels[channel]) / samples as f64)
    }

    pub(super) fn is_zero(&self) -> bool {
        self.channels.iter().all(Sum::is_zero)
    }

    fn merge(&mut self, other: Self) {
        self.channels.iter_mut().zip(other.channels).for_each(|(sum, other)| *sum += other);
        self.merged += other.merged;
        self.reflected += other.reflected;
    }
}
