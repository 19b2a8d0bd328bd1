//! Sparse counters: blocks of them are allocated where something is counted.
//!
//! A counter has 32 bits that wrap and, once one of its block has wrapped, 32 more that count how
//! often. So a counter takes four bytes until it is full, and sums are exact and in any order.

use crate::codec::{Reader, StateError, Stored, Writer};
use serde::{Deserialize, Serialize};
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

/// A block where something was counted.
#[derive(Serialize, Deserialize)]
struct StoredBlock {
    number: usize,
    low: Vec<u32>,
    high: Option<Vec<u32>>,
}

impl Stored for Blocks {
    fn put(&self, out: &mut Writer) {
        let taken =
            || self.blocks.iter().enumerate().filter_map(|(i, cell)| Some((i, cell.get()?)));
        let words = |words: &Words| words.iter().map(|word| word.load(Ordering::Relaxed)).collect();
        out.value(&taken().count());
        for (number, block) in taken() {
            let (low, high) = (words(&block.low), block.high.get().map(|high| words(high)));
            out.value(&StoredBlock { number, low, high });
        }
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        for _ in 0..from.value::<usize>()? {
            let StoredBlock { number, low, high } = from.value()?;
            let high = high.unwrap_or_else(|| vec![0; BLOCK]);
            if number >= self.blocks.len() || [low.len(), high.len()] != [BLOCK; 2] {
                return Err(StateError::Unfit("an illumination map"));
            }
            for (at, (low, high)) in low.into_iter().zip(high).enumerate() {
                self.add(number * BLOCK + at, u64::from(low) | u64::from(high) << 32);
            }
        }
        Ok(())
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
        const MAX: u64 = u32::MAX as u64;
        let blocks = Blocks::new(1000);
        for (counter, amount) in [(0, 5), (999, MAX), (999, 1), (999, 7), (998, MAX), (3, 5 << 32)]
        {
            blocks.add(counter, amount);
        }
        let counters = [0, 1, 3, 998, 999].map(|counter| blocks.get(counter));
        assert_eq!(counters, [5, 0, 5 << 32, MAX, (1 << 32) + 7]);
    }

    #[test]
    fn counters_come_back_and_add_up() {
        let (mut all, counters) = (Blocks::new(1000), [0, 255, 256, 999]);
        for amounts in [[3, 1 << 40, 7, 0], [4, u64::from(u32::MAX), 0, 9]] {
            let part = Blocks::new(1000);
            counters
                .into_iter()
                .zip(amounts)
                .for_each(|(counter, amount)| part.add(counter, amount));
            let mut out = Writer::default();
            part.put(&mut out);
            let bytes = out.finish();
            let mut from = Reader::new(&bytes);
            assert_eq!(all.merge_from(&mut from).and_then(|()| from.end()), Ok(()));
            let cut = &bytes[..bytes.len() - 1];
            assert!(Blocks::new(1000).merge_from(&mut Reader::new(cut)).is_err());
            assert!(Blocks::new(700).merge_from(&mut Reader::new(&bytes)).is_err());
        }
        let sums = counters.map(|counter| all.get(counter));
        assert_eq!(sums, [7, (1 << 40) + u64::from(u32::MAX), 7, 9]);
    }

    #[test]
    fn memory_is_taken_where_something_is_counted() {
        let blocks = Blocks::new(100 * BLOCK);
        blocks.add(17 * BLOCK, 1);
        let taken = |blocks: &Blocks| blocks.blocks.iter().filter(|b| b.get().is_some()).count();
        assert_eq!(taken(&blocks), 1);
    }
}
