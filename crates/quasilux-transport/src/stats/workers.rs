//! Other processes that trace blocks of a run.

use std::ops::Range;

/// Other processes, on this machine or on others, that trace blocks of a run
/// ([`crate::simulate_with_workers`]).
///
/// A block is a range of the work that a frame describes. What comes of it is a function of scene,
/// settings, frame and range, whoever traces it and however often; sums of blocks add up in any
/// order, so that no bit of a result depends on the workers.
pub trait Workers {
    /// Has `blocks` traced, each by [`crate::BlockTracer::trace`] with this frame, the scene and
    /// the settings of the run, and hands `done` what came of each: in any order, each block once.
    /// `done` says whether to go on, also while nothing comes. Returns whether no block is missing,
    /// or `done` wanted no more.
    fn trace(
        &mut self,
        frame: &[u8],
        blocks: &[Range<u64>],
        done: &mut dyn FnMut(Received<'_>) -> bool,
    ) -> bool;

    /// Paths of the smallest block: with fewer, sending it takes longer than tracing it. The same
    /// in all runs that are to have the same blocks.
    fn min_paths(&self) -> u64 {
        MIN_PATHS
    }
}

/// What workers hand over.
#[derive(Clone, Copy, Debug)]
pub enum Received<'b> {
    /// The bytes that came of a block, by its number.
    Block {
        /// Its number among those that were asked for.
        number: usize,
        /// What [`crate::BlockTracer::trace`] gave.
        bytes: &'b [u8],
    },
    /// Nothing yet: a sign of life, about once a second.
    Nothing,
}

/// How large blocks of some work are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockSize {
    /// Paths that take about as long as a unit of the work.
    pub(crate) paths: u64,
    /// Sums that come of each block, whatever its length.
    pub(crate) sums: u64,
}

/// Paths of a block for each sum that comes of it: adding them takes far less time than tracing.
const PATHS_OF_A_SUM: u64 = 4;

/// Blocks of some work: as many as are needed to keep many workers busy, of some hundredths of a
/// second at least, and of some seconds at most, so that losing one does not hurt. The cut depends
/// on the work alone, so that blocks that were kept serve any other number of workers.
const BLOCKS: u64 = 256;
const MIN_PATHS: u64 = 1 << 14;
const MAX_PATHS: u64 = 1 << 22;

/// The blocks of `work`; none where there is less than a block of `min_paths`.
pub(crate) fn blocks(work: &Range<u64>, size: BlockSize, min_paths: u64) -> Vec<Range<u64>> {
    let each = size.paths.max(1);
    let min_paths = min_paths.max(size.sums.saturating_mul(PATHS_OF_A_SUM));
    let paths = (work.end - work.start).saturating_mul(each);
    if paths <= min_paths {
        return Vec::new();
    }
    let of_block = (paths / BLOCKS).min(MAX_PATHS).max(min_paths).next_power_of_two();
    let length = (of_block / each).max(1);
    let starts = (work.start..work.end).step_by(length as usize);
    starts.map(|start| start..work.end.min(start + length)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_fill_the_work_and_are_neither_small_nor_large() {
        for (work, each) in [(3..70_000, 1), (0..1 << 30, 1), (5..900, 1 << 12), (0..7, 1 << 30)] {
            let all = blocks(&work, BlockSize { paths: each, sums: 0 }, MIN_PATHS);
            assert_eq!((all[0].start, all[all.len() - 1].end), (work.start, work.end));
            assert!(all.windows(2).all(|pair| pair[0].end == pair[1].start));
            let longest = all.iter().map(|block| block.end - block.start).max().unwrap();
            assert!(longest == 1 || (MIN_PATHS..=MAX_PATHS).contains(&(longest * each)));
        }
        assert_eq!(blocks(&(0..100), BlockSize { paths: 10, sums: 0 }, MIN_PATHS), []);
        let many = BlockSize { paths: 1, sums: 1 << 20 };
        assert_eq!(blocks(&(0..1 << 26), many, MIN_PATHS).len(), 16);
    }
}
