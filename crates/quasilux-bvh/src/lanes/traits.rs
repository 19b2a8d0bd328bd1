//! The vector operations that the traversal and the intersection test need.

use crate::node::{Child, WIDTH};

/// Four double-precision numbers at once, to the same bits everywhere.
pub(crate) trait Quad: Copy {
    fn load(from: &[f64; 4]) -> Self;
    fn store(self) -> [f64; 4];
    fn splat(x: f64) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    /// The numbers of lanes 2, 0, 1 and 3.
    fn previous(self) -> Self;
    /// The numbers of lanes 1, 2, 0 and 3.
    fn next(self) -> Self;
    /// The number of lane 0 in all of them.
    fn first(self) -> Self;
    /// The first three numbers, and the first of another.
    fn with_last(self, other: Self) -> Self;
    /// A bit for each lane where `self < other`.
    fn below(self, other: Self) -> u32;
    fn from_array(numbers: [f64; 4]) -> Self;
    /// Without signs.
    fn abs(self) -> Self;
}

/// Eight numbers, and the few operations that the traversal needs.
pub(crate) trait Lanes: Copy {
    /// Four numbers, on the same machine.
    type Quad: Quad;

    fn load(from: &[f32; WIDTH]) -> Self;
    fn store(self) -> [f32; WIDTH];
    fn splat(x: f32) -> Self;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    /// `self * a + b`, rounded once or twice.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// `self * a - b`, rounded once or twice.
    fn mul_sub(self, a: Self, b: Self) -> Self;
    fn min(self, other: Self) -> Self;
    fn max(self, other: Self) -> Self;
    /// `self`, with its sign flipped where `other` has one.
    fn flip_by(self, other: Self) -> Self;
    /// A bit for each lane where `self <= other`.
    fn at_most(self, other: Self) -> u32;
    /// A bit for each lane where any of the four is negative.
    fn any_negative(of: [Self; 4]) -> u32;
    /// A bit for each lane where a number is none of three.
    fn differ(numbers: &[u32; WIDTH], from: [u32; 3]) -> u32;
    /// The lane of (nearly) the smallest number among those at most `limit`, none of which is
    /// negative; any lane if there are none.
    fn smallest(self, limit: Self) -> usize;
    /// Writes numbers and children of the lanes in `mask` to the starts of two lists with room for
    /// eight each; what lies behind them in the room is overwritten.
    ///
    /// # Safety
    /// Both pointers must be valid for writes of eight elements.
    unsafe fn compress(
        self,
        children: &[Child; WIDTH],
        mask: u32,
        to: *mut f32,
        to_children: *mut Child,
    );
    /// [`Self::splat`] of a number in memory.
    fn splat_from(x: &f32) -> Self;
    fn div(self, other: Self) -> Self;
    /// `self` in the lanes of `mask`, `other` elsewhere.
    fn or_else(self, mask: u32, other: Self) -> Self;
    /// Sets the numbers in the lanes of `mask`.
    fn put(numbers: &mut [u32; WIDTH], mask: u32, number: u32);
    /// The smallest of the eight, none of which is not a number.
    fn least(self) -> f32;
}
