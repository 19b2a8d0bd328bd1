//! One pass over a picture: how many paths each of its blocks gets.
//!
//! Where a tolerance is wanted, a block goes on until its pixels are known well enough, and takes
//! no prediction of how many paths that needs. The mean square of the relative half-widths of all
//! pixels is to be the square of the tolerance. With a variance of `v` a path, the number of paths
//! is least where each block gets a number in proportion to `sqrt(v)`, so its share of the square
//! is in proportion to `sqrt(v)`, too. What an earlier pass knows of `v` steers this one, which
//! takes none of its indices.

use crate::stats::picture::{Pixel, mean_square};

/// The part of the tolerance that all blocks get alike, so that none waits for what an earlier pass
/// did not meet.
const EVEN_PART: f64 = 0.1;
/// A pass is to be enough with some room to spare, since the mean luminance varies.
const MARGIN: f64 = 1.02;

/// Binary digits other than 0 in a number of paths after which pixels are looked at.
const DIGITS: u32 = 3;

/// One pass: numbers of paths of each pixel in each replicate.
#[derive(Clone, Debug)]
pub(super) struct Pass {
    /// The index of the first path.
    pub(super) first: u64,
    /// No block has fewer paths.
    pub(super) least: u64,
    /// No block has more.
    pub(super) most: u64,
    /// Errors that blocks are to reach; without any, each gets the most paths.
    targets: Option<Targets>,
}

/// Errors that the blocks of a picture are to reach.
#[derive(Clone, Debug)]
struct Targets {
    /// All together.
    rel_tol: f64,
    mean_cd_m2: f64,
    of_blocks: Vec<BlockTarget>,
}

#[derive(Clone, Copy, Debug)]
struct BlockTarget {
    /// The mean square of the relative half-widths of its pixels.
    square: f64,
    /// Paths that are probably needed.
    samples: f64,
}

/// Error of a block in an earlier pass, and its paths.
#[derive(Clone, Debug)]
pub(super) struct KnownBlock {
    pub(super) pixels: usize,
    /// Paths that it had.
    pub(super) samples: u64,
    /// Whether it was known well enough then.
    pub(super) is_enough: bool,
    /// The mean square of the relative half-widths of its pixels; 0 where none has one.
    pub(super) square: f64,
}

impl Pass {
    /// A pass with this many paths of each pixel.
    pub(super) fn of_all(samples: u64) -> Self {
        Self { first: 0, least: samples, most: samples, targets: None }
    }

    /// One with these limits whose indices come after those of this one.
    pub(super) fn followed_by(&self, least: u64, most: u64) -> Self {
        let first = (self.first + self.most).next_multiple_of(most.next_power_of_two());
        Self { first, least, most, targets: None }
    }

    /// Up to a tolerance, by what an earlier pass knows of the blocks of a picture with this mean
    /// luminance; `self` has the limits.
    pub(super) fn up_to(self, rel_tol: f64, mean_cd_m2: f64, blocks: &[KnownBlock]) -> Self {
        let square = (rel_tol / MARGIN) * (rel_tol / MARGIN);
        let spread = |block: &KnownBlock| (block.samples as f64 * block.square).sqrt();
        let pixels: f64 = blocks.iter().map(|block| block.pixels as f64).sum();
        let mean = |of_block: &dyn Fn(&KnownBlock) -> f64| {
            blocks.iter().map(|block| block.pixels as f64 * of_block(block)).sum::<f64>() / pixels
        };
        let mean_spread = mean(&spread);
        let square_of = |block: &KnownBlock| {
            let by_spread = if mean_spread > 0.0 { spread(block) / mean_spread } else { 1.0 };
            square * (EVEN_PART + (1.0 - EVEN_PART) * by_spread)
        };
        let of_block = |block: &KnownBlock| {
            let square = square_of(block);
            let samples = block.samples as f64 * block.square / square;
            BlockTarget { square, samples: samples.clamp(self.least as f64, self.most as f64) }
        };
        let of_blocks = blocks.iter().map(of_block).collect();
        Self { targets: Some(Targets { rel_tol, mean_cd_m2, of_blocks }), ..self }
    }

    /// Whether it goes up to this tolerance.
    pub(super) fn is_up_to(&self, rel_tol: f64) -> bool {
        self.targets.as_ref().is_some_and(|targets| targets.rel_tol <= rel_tol)
    }

    /// Paths of a pixel that a block probably takes.
    pub(super) fn expected(&self, block: usize) -> f64 {
        self.targets.as_ref().map_or(self.most as f64, |targets| targets.of_blocks[block].samples)
    }

    /// Whether pixels are looked at after this many paths: points of nets are balanced best in
    /// numbers with few binary digits other than 0.
    pub(super) fn is_look(&self, samples: u64) -> bool {
        let is_balanced = samples >= self.most || samples.count_ones() <= DIGITS;
        self.targets.is_some() && samples >= self.least && is_balanced
    }

    /// Whether a block is known well enough.
    pub(super) fn is_known(&self, block: usize, pixels: &[Pixel]) -> bool {
        let Some(Targets { mean_cd_m2, of_blocks, .. }) = &self.targets else { return false };
        square_of(pixels.iter(), *mean_cd_m2) <= of_blocks[block].square
    }
}

/// The mean square of the relative half-widths of the pixels that have one.
pub(super) fn square_of<'p>(pixels: impl Iterator<Item = &'p Pixel>, mean_cd_m2: f64) -> f64 {
    mean_square(pixels.filter_map(|pixel| pixel.relative_half_width(mean_cd_m2)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks together get the square of the tolerance, and noisy ones are let be noisier.
    #[test]
    fn blocks_share_the_tolerance() {
        let blocks = [(256, 0.04), (256, 0.01), (128, 0.0), (64, 0.16)]
            .map(|(pixels, square)| KnownBlock { pixels, samples: 2, is_enough: false, square });
        let limits = Pass { least: 2, most: 4096, ..Pass::of_all(0) };
        let pass = limits.up_to(0.02, 10.0, &blocks);
        let of_blocks = &pass.targets.as_ref().unwrap().of_blocks;
        let squares: Vec<f64> = of_blocks.iter().map(|of_block| of_block.square).collect();
        let sum: f64 = squares.iter().zip(&blocks).map(|(it, of)| it * of.pixels as f64).sum();
        let together = (0.02 / MARGIN) * (0.02 / MARGIN);
        assert!((sum / (704.0 * together) - 1.0).abs() < 1e-12);
        assert!(squares[3] > squares[0] && squares[0] > squares[1] && squares[1] > squares[2]);
        assert!(squares[2] >= EVEN_PART * together);
        // One number for all would be the mean of squares over that of the tolerance.
        let even = 2.0 * (256.0 * 0.05 + 64.0 * 0.16) / 704.0 / together;
        let expected = of_blocks.iter().zip(&blocks).map(|(it, of)| it.samples * of.pixels as f64);
        let expected = expected.sum::<f64>() / 704.0;
        assert!(expected < 0.95 * even, "{expected} of {even}");
    }

    #[test]
    fn blocks_are_looked_at_where_nets_are_balanced() {
        let pass = Pass { least: 2, most: 16, ..Pass::of_all(0) };
        let pass = pass.up_to(0.02, 1.0, &[]);
        let looks: Vec<u64> = (1..=16).filter(|samples| pass.is_look(*samples)).collect();
        assert_eq!(looks, [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 16]);
    }

    /// Nothing but black, and nothing known at all.
    #[test]
    fn dark_blocks_are_known() {
        let block = KnownBlock { pixels: 2, samples: 1, is_enough: false, square: 0.0 };
        let pass = Pass { least: 2, most: 64, ..Pass::of_all(0) }.up_to(0.02, 0.0, &[block]);
        let unknown = [Pixel::default(); 2];
        let black = [Pixel { half_width_cd_m2: Some(0.0), ..Pixel::default() }; 2];
        assert!(pass.is_known(0, &unknown) && pass.is_known(0, &black));
        assert!((pass.expected(0) - 2.0).abs() < 1e-12);
    }
}
