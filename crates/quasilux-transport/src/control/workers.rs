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

    /// Paths of the smallest block: with fewer, sending it takes longer than tracing it. Work of
    /// few such blocks is not handed out. The same in all runs that are to have the same blocks.
    fn min_paths(&self) -> u64 {
        MIN_PATHS
    }
}

/// Message from workers.
#[derive(Clone, Copy, Debug)]
pub enum Received<'b> {
    /// The bytes that came of a block, by its number.
    Block {
        /// Its number among those that were asked for.
        number: usize,
        /// Result of [`crate::BlockTracer::trace`].
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

/// Paths of the smallest block, some hundredths of a second, and of the largest, some seconds, so
/// that losing one does not hurt.
const MIN_PATHS: u64 = 1 << 13;
const MAX_PATHS: u64 = 1 << 22;

/// Less work than this many of the smallest blocks is done here: in the many short phases that a
/// run begins with, all would wait for the last block of the slowest.
const FEW: u64 = 32;

/// Blocks get shorter as work runs out, so that no worker waits for long for the last one: C. D.
/// Polychronopoulos and D. J. Kuck, "Guided self-scheduling" (IEEE Trans. Comput. C-36, 1987). Each
/// is a part of what is left that leaves work for many workers, but not shorter than several of the
/// smallest ones while two workers have enough.
const MANY: u64 = 256;
const SEVERAL: u64 = 8;
const OF_TWO: u64 = 4;

/// The blocks of `work`; none where there is little or nothing. The cut depends on the work alone,
/// so that blocks that were kept serve any other number of workers.
pub(crate) fn blocks(work: &Range<u64>, size: BlockSize, min_paths: u64) -> Vec<Range<u64>> {
    let each = size.paths;
    let least = min_paths.max(size.sums.saturating_mul(PATHS_OF_A_SUM));
    let paths_to_end = |start: u64| (work.end - start).saturating_mul(each);
    if each == 0 || paths_to_end(work.start) <= least.max(min_paths.saturating_mul(FEW)) {
        return Vec::new();
    }
    let several = least.saturating_mul(SEVERAL);
    let most = least.max(MAX_PATHS);
    let next = |start: u64| {
        let left = paths_to_end(start);
        let paths = (left / OF_TWO).min(several).max(left / MANY).clamp(least, most);
        let length = (paths.next_power_of_two() / each).max(1);
        (start < work.end).then(|| start..work.end.min(start + length))
    };
    std::iter::successors(next(work.start), |block| next(block.end)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_fill_the_work_and_are_neither_small_nor_large() {
        let works =
            [(3..700_000, 1), (0..1 << 30, 1), (5..900, 1 << 12), (0..7, 1 << 30), (9..80_000, 6)];
        for (work, each) in works {
            let all = blocks(&work, BlockSize { paths: each, sums: 0 }, MIN_PATHS);
            assert_eq!((all[0].start, all[all.len() - 1].end), (work.start, work.end));
            assert!(all.windows(2).all(|pair| pair[0].end == pair[1].start));
            let lengths = || all.iter().map(|block| block.end - block.start);
            let longest = lengths().max().unwrap();
            assert!(longest == 1 || (MIN_PATHS..=MAX_PATHS).contains(&(longest * each)));
            // The last one may be short of its length.
            assert!(all.len() < 3000 && lengths().rev().skip(1).is_sorted(), "{work:?}");
        }
        let size = BlockSize { paths: 10, sums: 0 };
        assert_eq!(blocks(&(0..MIN_PATHS * FEW / 10), size, MIN_PATHS), []);
        assert_eq!(blocks(&(0..1 << 30), BlockSize { paths: 0, sums: 0 }, MIN_PATHS), []);
        let many = BlockSize { paths: 1, sums: 1 << 18 };
        let smallest = blocks(&(0..1 << 26), many, MIN_PATHS).into_iter().next_back().unwrap();
        assert_eq!(smallest.end - smallest.start, 1 << 20);
    }
}
