//! From what coordinates were drawn for to blocks of them.

use super::{Block, Use};
use crate::purpose::{DimensionUse, Purpose};
use std::collections::BTreeMap;

/// More blocks than this are one.
const MAX_BLOCKS: usize = 12;
/// Coordinates that fewer samples get to belong to the last block.
const MIN_REACHED: f64 = 1.0 / 64.0;

/// The blocks of `samples` samples that drew these dimensions.
pub(super) fn from_uses(uses: &BTreeMap<DimensionUse, u64>, samples: u64) -> Vec<Block> {
    let end = uses.keys().next_back().map_or(0, |used| used.dimension + 1);
    let of_dimension = |dimension: u32| {
        let first = |dimension| DimensionUse { dimension, purpose: FIRST_PURPOSE };
        let own = uses.range(first(dimension)..first(dimension + 1));
        own.map(|(used, &count)| (used.purpose, count))
    };
    let mut blocks: Vec<Block> = Vec::new();
    let mut last_purpose = None;
    for dimension in 0..end {
        let drawn: u64 = of_dimension(dimension).map(|(_, count)| count).sum();
        let reached = drawn as f64 / samples as f64;
        let most = of_dimension(dimension).max_by_key(|&(_, count)| count);
        let purpose = most.map(|(purpose, _)| purpose);
        let is_rest = reached < MIN_REACHED;
        match blocks.last_mut() {
            Some(block) if !is_rest && purpose == last_purpose => block.dimensions.end += 1,
            _ => {
                let dimensions = dimension..dimension + 1;
                let (alone, total, smoothness) = (None, None, None);
                let uses = Vec::new();
                blocks.push(Block { dimensions, uses, reached, alone, total, smoothness });
            }
        }
        last_purpose = purpose;
        if is_rest || blocks.len() == MAX_BLOCKS {
            break;
        }
    }
    if let Some(last) = blocks.last_mut() {
        last.dimensions.end = u32::MAX;
    }
    for block in &mut blocks {
        let mut counts = BTreeMap::<Purpose, u64>::new();
        let own = block.dimensions.start..block.dimensions.end.min(end);
        for (purpose, count) in own.flat_map(of_dimension) {
            *counts.entry(purpose).or_default() += count;
        }
        let all: u64 = counts.values().sum();
        let part = |(purpose, count)| Use { purpose, share: count as f64 / all as f64 };
        block.uses = counts.into_iter().map(part).collect();
        block.uses.sort_by(|a, b| b.share.total_cmp(&a.share));
    }
    blocks
}

/// The first in their order.
const FIRST_PURPOSE: Purpose = Purpose::Emission;
