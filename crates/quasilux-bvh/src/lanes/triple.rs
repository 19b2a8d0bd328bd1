//! Three coordinates of eight points or vectors.
//!
//! No closures and no `array::map`: what the compiler does not inline loses the instructions of its
//! caller, and calls them one by one.

use super::traits::Lanes;
use crate::node::WIDTH;

#[inline(always)]
pub(crate) fn load<L: Lanes>(from: &[[f32; WIDTH]; 3]) -> [L; 3] {
    [L::load(&from[0]), L::load(&from[1]), L::load(&from[2])]
}

#[inline(always)]
pub(crate) fn store<L: Lanes>(a: [L; 3]) -> [[f32; WIDTH]; 3] {
    [a[0].store(), a[1].store(), a[2].store()]
}

/// One of eight in all lanes.
#[inline(always)]
pub(crate) fn splat<L: Lanes>(of: &[[f32; WIDTH]; 3], lane: usize) -> [L; 3] {
    let lane = lane % WIDTH;
    [L::splat(of[0][lane]), L::splat(of[1][lane]), L::splat(of[2][lane])]
}

#[inline(always)]
pub(crate) fn sub<L: Lanes>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    [a[0].sub(b[0]), a[1].sub(b[1]), a[2].sub(b[2])]
}

#[inline(always)]
pub(crate) fn abs<L: Lanes>(a: [L; 3]) -> [L; 3] {
    [a[0].flip_by(a[0]), a[1].flip_by(a[1]), a[2].flip_by(a[2])]
}

#[inline(always)]
pub(crate) fn cross<L: Lanes>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    [
        a[1].mul_sub(b[2], a[2].mul(b[1])),
        a[2].mul_sub(b[0], a[0].mul(b[2])),
        a[0].mul_sub(b[1], a[1].mul(b[0])),
    ]
}

#[inline(always)]
pub(crate) fn dot<L: Lanes>(a: [L; 3], b: [L; 3]) -> L {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2].mul(b[2])))
}
