//! In plain Rust, for every machine.

use super::traits::{Lanes, Quad};
use crate::node::{Child, WIDTH};
use std::array::from_fn;

/// Eight numbers that the compiler puts where it likes.
#[derive(Clone, Copy)]
pub(crate) struct Portable([f32; WIDTH]);

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(from_fn(|i| f(self.0[i], other.0[i])))
    }
}

impl Lanes for Portable {
    type Quad = PortableQuad;

    #[inline(always)]
    fn load(from: &[f32; WIDTH]) -> Self {
        Self(*from)
    }

    #[inline(always)]
    fn store(self) -> [f32; WIDTH] {
        self.0
    }

    #[inline(always)]
    fn splat(x: f32) -> Self {
        Self([x; WIDTH])
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    fn mul_add(self, a: Self, b: Self) -> Self {
        self.mul(a).add(b)
    }

    #[inline(always)]
    fn mul_sub(self, a: Self, b: Self) -> Self {
        self.mul(a).sub(b)
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn flip_by(self, other: Self) -> Self {
        const SIGN: u32 = 1 << 31;
        self.zip(other, |a, b| f32::from_bits(a.to_bits() ^ (b.to_bits() & SIGN)))
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u32 {
        (0..WIDTH).fold(0, |mask, i| mask | u32::from(self.0[i] <= other.0[i]) << i)
    }

    #[inline(always)]
    fn any_negative(of: [Self; 4]) -> u32 {
        let bits = |i: usize| of.iter().fold(0, |bits, lanes| bits | lanes.0[i].to_bits());
        (0..WIDTH).fold(0, |mask, i| mask | bits(i) >> 31 << i)
    }

    #[inline(always)]
    fn differ(numbers: &[u32; WIDTH], from: [u32; 3]) -> u32 {
        let differs = |i: usize| !from.contains(&numbers[i]);
        (0..WIDTH).fold(0, |mask, i| mask | u32::from(differs(i)) << i)
    }

    #[inline(always)]
    fn smallest(self, limit: Self) -> usize {
        let mut best = (f32::INFINITY, 0);
        for i in 0..WIDTH {
            if self.0[i] <= limit.0[i] && self.0[i] < best.0 {
                best = (self.0[i], i);
            }
        }
        best.1
    }

    #[inline(always)]
    unsafe fn compress(
        self,
        children: &[Child; WIDTH],
        mask: u32,
        to: *mut f32,
        to_children: *mut Child,
    ) {
        let (mut left, mut count) = (mask, 0);
        while left != 0 {
            let lane = left.trailing_zeros() as usize % WIDTH;
            // SAFETY: at most eight elements are written, for which there is room.
            unsafe {
                to.add(count).write(self.0[lane]);
                to_children.add(count).write(children[lane]);
            }
            left &= left - 1;
            count += 1;
        }
    }

    #[inline(always)]
    fn splat_from(x: &f32) -> Self {
        Self::splat(*x)
    }

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }

    #[inline(always)]
    fn or_else(self, mask: u32, other: Self) -> Self {
        Self(from_fn(|i| if mask >> i & 1 == 1 { self.0[i] } else { other.0[i] }))
    }

    #[inline(always)]
    fn put(numbers: &mut [u32; WIDTH], mask: u32, number: u32) {
        for (i, to) in numbers.iter_mut().enumerate() {
            *to = if mask >> i & 1 == 1 { number } else { *to };
        }
    }

    #[inline(always)]
    fn least(self) -> f32 {
        self.0.into_iter().fold(f32::INFINITY, f32::min)
    }
}

/// Four numbers that the compiler puts where it likes.
#[derive(Clone, Copy)]
pub(crate) struct PortableQuad([f64; 4]);

impl PortableQuad {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(from_fn(|i| f(self.0[i], other.0[i])))
    }
}

impl Quad for PortableQuad {
    #[inline(always)]
    fn load(from: &[f64; 4]) -> Self {
        Self(*from)
    }

    #[inline(always)]
    fn store(self) -> [f64; 4] {
        self.0
    }

    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self([x; 4])
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }

    #[inline(always)]
    fn previous(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([c, a, b, d])
    }

    #[inline(always)]
    fn next(self) -> Self {
        let [a, b, c, d] = self.0;
        Self([b, c, a, d])
    }

    #[inline(always)]
    fn first(self) -> Self {
        Self([self.0[0]; 4])
    }

    #[inline(always)]
    fn with_last(self, other: Self) -> Self {
        let [a, b, c, _] = self.0;
        Self([a, b, c, other.0[0]])
    }

    #[inline(always)]
    fn below(self, other: Self) -> u32 {
        (0..4).fold(0, |mask, i| mask | u32::from(self.0[i] < other.0[i]) << i)
    }

    #[inline(always)]
    fn from_array(numbers: [f64; 4]) -> Self {
        Self(numbers)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.map(f64::abs))
    }
}
