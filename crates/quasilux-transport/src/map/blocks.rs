//! Many counters of which most may stay zero: memory is taken in blocks, where something is counted.
//!
//! A counter has 32 bits that wrap and, once one of its block has wrapped, 32 more that count how
//! often. So a counter takes four bytes until it is full, and sums are exact and in any order.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};

/// Counters of a block.
const BLOCK: usize = 256;

type Words = [AtomicU32; BLOCK];

/// Counters that all threads may add to.
pub(super) struct Blocks {
    blocks: Vec<OnceLock<Box<Block>>>,
}

struct Block {
    low: Words,
    high: OnceLock<Box<Words>>,
}

impl Blocks {
    /// Counters that are zero.
    pub(super) fn new(counters: usize) -> Self {
        Self { blocks: (0..counters.div_ceil(BLOCK)).map(|_| OnceLock::new()).collect() }
    }

    /// Adds to a counter.
    pub(super) fn add(&self, counter: usize, amount: u64) {
        let block = self.blocks[counter / BLOCK].get_or_init(Block::new);
        let (low, high) = (amount as u32, (amount >> 32) as u32);
        let before = block.low[counter % BLOCK].fetch_add(low, Ordering::Relaxed);
        let carry = high.saturating_add(u32::from(before.checked_add(low).is_none()));
        if carry > 0 {
            let high = block.high.get_or_init(|| Box::new(zeros()));
            high[counter % BLOCK].fetch_add(carry, Ordering::Relaxed);
        }
    }

    /// A counter's value, while nothing is added.
    pub(super) fn get(&self, counter: usize) -> u64 {
        let Some(block) = self.blocks[counter / BLOCK].get() else { return 0 };
        let word = |words: &Words| u64::from(words[counter % BLOCK].load(Ordering::Relaxed));
        word(&block.low) | block.high.get().map_or(0, |high| word(high) << 32)
    }
}

impl Block {
    fn new() -> Box<Self> {
        Box::new(Self { low: zeros(), high: OnceLock::new() })
    }
}

fn zeros() -> Words {
    [const { AtomicU32::new(0) }; BLOCK]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counters_carry() {
        const MOST: u64 = u32::MAX as u64;
        let blocks = Blocks::new(1000);
        for (counter, amount) in
            [(0, 5), (999, MOST), (999, 1), (999, 7), (998, MOST), (3, 5 << 32)]
        {
            blocks.add(counter, amount);
        }
        let counters = [0, 1, 3, 998, 999].map(|counter| blocks.get(counter));
        assert_eq!(counters, [5, 0, 5 << 32, MOST, (1 << 32) + 7]);
    }

    #[test]
    fn memory_is_taken_where_something_is_counted() {
        let blocks = Blocks::new(100 * BLOCK);
        blocks.add(17 * BLOCK, 1);
        let taken = |blocks: &Blocks| blocks.blocks.iter().filter(|b| b.get().is_some()).count();
        assert_eq!(taken(&blocks), 1);
    }
}
