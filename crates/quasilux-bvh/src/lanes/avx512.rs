//! With the eight-wide instructions of AVX-512: what they add to AVX2 here are masks, and a
//! compression that needs no table.
//!
//! Tested without a machine that has it: in the emulator Bochs 2.7 as a Skylake-X, under Linux with
//! `clearcpuid=321,323`, by the test of all instructions and the example `hard_rays`, linked
//! statically.

use super::traits::Lanes;
use super::ymm::in_256_bits;
use crate::node::{Child, WIDTH};
use std::arch::x86_64::*;

/// Eight numbers in a register.
///
/// Values exist only where [`Avx512::is_supported`] has said so: they are made inside of functions
/// that enable these features, and nowhere else.
#[derive(Clone, Copy)]
pub(crate) struct Avx512(__m256);

impl Avx512 {
    /// Whether this machine has what it takes.
    pub(crate) fn is_supported() -> bool {
        super::avx2::Avx2::is_supported()
            && is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512dq")
    }
}

// SAFETY of all blocks below: the features are there, as [`Avx512`] says; loads and stores are of
// whole arrays, or as the contract of the function says.
impl Lanes for Avx512 {
    type Quad = super::avx2::Avx2Quad;

    in_256_bits!();

    #[inline(always)]
    fn flip_by(self, other: Self) -> Self {
        // SAFETY: see above.
        unsafe {
            let (number, other) = (_mm256_castps_si256(self.0), _mm256_castps_si256(other.0));
            let sign = _mm256_set1_epi32(i32::MIN);
            // The first exclusive or (the second and the third).
            Self(_mm256_castsi256_ps(_mm256_ternarylogic_epi32::<0x78>(number, other, sign)))
        }
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u32 {
        // SAFETY: see above.
        unsafe { u32::from(_mm256_cmp_ps_mask::<_CMP_LE_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn any_negative([a, b, c, d]: [Self; 4]) -> u32 {
        // SAFETY: see above.
        unsafe {
            let (a, b) = (_mm256_castps_si256(a.0), _mm256_castps_si256(b.0));
            let (c, d) = (_mm256_castps_si256(c.0), _mm256_castps_si256(d.0));
            let three = _mm256_ternarylogic_epi32::<0xfe>(a, b, c);
            u32::from(_mm256_movepi32_mask(_mm256_or_si256(three, d)))
        }
    }

    #[inline(always)]
    fn differ(numbers: &[u32; WIDTH], [a, b, c]: [u32; 3]) -> u32 {
        // SAFETY: see above.
        unsafe {
            let numbers = _mm256_loadu_si256(numbers.as_ptr().cast());
            let (a, b) = (_mm256_set1_epi32(a as i32), _mm256_set1_epi32(b as i32));
            let differ = _mm256_cmpneq_epi32_mask(numbers, a);
            let differ = _mm256_mask_cmpneq_epi32_mask(differ, numbers, b);
            let c = _mm256_set1_epi32(c as i32);
            u32::from(_mm256_mask_cmpneq_epi32_mask(differ, numbers, c))
        }
    }

    #[inline(always)]
    fn smallest(self, limit: Self) -> usize {
        // SAFETY: see above.
        unsafe {
            let counts = _mm256_cmp_ps_mask::<_CMP_LE_OQ>(self.0, limit.0);
            let ones = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
            let kept = _mm256_mask_blend_ps(counts, ones, self.0);
            // The upper halves of the bits of numbers that are not negative order as they do.
            let bits = _mm256_srli_epi32::<16>(_mm256_castps_si256(kept));
            let (low, high) = (_mm256_castsi256_si128(bits), _mm256_extracti128_si256::<1>(bits));
            let least = _mm_minpos_epu16(_mm_packus_epi32(low, high));
            _mm_extract_epi16::<1>(least) as usize
        }
    }

    #[inline(always)]
    unsafe fn compress(
        self,
        children: &[Child; WIDTH],
        mask: u32,
        to: *mut f32,
        to_children: *mut Child,
    ) {
        // SAFETY: see above, and `Child` is a `u32`.
        unsafe {
            _mm256_storeu_ps(to, _mm256_maskz_compress_ps(mask as u8, self.0));
            let children = _mm256_loadu_si256(children.as_ptr().cast());
            let children = _mm256_maskz_compress_epi32(mask as u8, children);
            _mm256_storeu_si256(to_children.cast(), children);
        }
    }

    #[inline(always)]
    fn or_else(self, mask: u32, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_mask_blend_ps(mask as u8, other.0, self.0) })
    }

    #[inline(always)]
    fn put(numbers: &mut [u32; WIDTH], mask: u32, number: u32) {
        // SAFETY: see above.
        unsafe {
            let number = _mm256_set1_epi32(number as i32);
            _mm256_mask_storeu_epi32(numbers.as_mut_ptr().cast(), mask as u8, number);
        }
    }
}
