//! With AVX2 and fused multiply-add.

use super::traits::{Lanes, Quad};
use super::ymm::in_256_bits;
use crate::node::{Child, WIDTH};
use std::arch::x86_64::*;

/// Eight numbers in a register.
///
/// Values exist only where [`Avx2::is_supported`] has said so: they are made inside of functions
/// that enable these features, and nowhere else.
#[derive(Clone, Copy)]
pub(crate) struct Avx2(__m256);

impl Avx2 {
    /// Whether this machine has what it takes.
    pub(crate) fn is_supported() -> bool {
        is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("fma")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt")
    }
}

/// For each mask the lanes in it, from the lowest on, as bytes.
static LANES_OF: [u64; 256] = {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut count) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask] |= lane << (8 * count);
                count += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

// SAFETY of all blocks below: the features are there, as [`Avx2`] says; loads and stores are of
// whole arrays, or as the contract of the function says.
impl Lanes for Avx2 {
    type Quad = Avx2Quad;

    in_256_bits!();

    #[inline(always)]
    fn flip_by(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_xor_ps(self.0, _mm256_and_ps(other.0, _mm256_set1_ps(-0.0))) })
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> u32 {
        // SAFETY: see above.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, other.0)) as u32 }
    }

    #[inline(always)]
    fn any_negative([a, b, c, d]: [Self; 4]) -> u32 {
        // SAFETY: see above.
        unsafe {
            let any = _mm256_or_ps(_mm256_or_ps(a.0, b.0), _mm256_or_ps(c.0, d.0));
            _mm256_movemask_ps(any) as u32
        }
    }

    #[inline(always)]
    fn differ(numbers: &[u32; WIDTH], [a, b, c]: [u32; 3]) -> u32 {
        // SAFETY: see above.
        unsafe {
            let numbers = _mm256_loadu_si256(numbers.as_ptr().cast());
            let same = |x: u32| _mm256_cmpeq_epi32(numbers, _mm256_set1_epi32(x as i32));
            let same = _mm256_or_si256(same(a), _mm256_or_si256(same(b), same(c)));
            !_mm256_movemask_ps(_mm256_castsi256_ps(same)) as u32 & 0xff
        }
    }

    #[inline(always)]
    fn smallest(self, limit: Self) -> usize {
        // SAFETY: see above.
        unsafe {
            let counts = _mm256_cmp_ps::<_CMP_LE_OQ>(self.0, limit.0);
            let ones = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
            let kept = _mm256_blendv_ps(ones, self.0, counts);
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
            let bytes = _mm_cvtsi64_si128(LANES_OF[mask as usize & 0xff] as i64);
            let lanes = _mm256_cvtepu8_epi32(bytes);
            let children = _mm256_loadu_si256(children.as_ptr().cast());
            _mm256_storeu_ps(to, _mm256_permutevar8x32_ps(self.0, lanes));
            let children = _mm256_permutevar8x32_epi32(children, lanes);
            _mm256_storeu_si256(to_children.cast(), children);
        }
    }

    #[inline(always)]
    fn or_else(self, mask: u32, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_blendv_ps(other.0, self.0, _mm256_castsi256_ps(spread(mask))) })
    }

    #[inline(always)]
    fn put(numbers: &mut [u32; WIDTH], mask: u32, number: u32) {
        // SAFETY: see above.
        unsafe {
            let to = numbers.as_mut_ptr().cast();
            let number = _mm256_set1_epi32(number as i32);
            _mm256_storeu_si256(
                to,
                _mm256_blendv_epi8(_mm256_loadu_si256(to), number, spread(mask)),
            );
        }
    }
}

/// All bits of the lanes in `mask`.
///
/// # Safety
/// The machine must have what [`Avx2::is_supported`] asks for.
#[inline(always)]
unsafe fn spread(mask: u32) -> __m256i {
    // SAFETY: see above.
    unsafe {
        let bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(mask as i32), bits), bits)
    }
}

/// Four numbers in a register, under the same condition.
#[derive(Clone, Copy)]
pub(crate) struct Avx2Quad(__m256d);

// SAFETY of all blocks below: as above.
impl Quad for Avx2Quad {
    #[inline(always)]
    fn load(from: &[f64; 4]) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_loadu_pd(from.as_ptr()) })
    }

    #[inline(always)]
    fn store(self) -> [f64; 4] {
        let mut to = [0.0; 4];
        // SAFETY: see above.
        unsafe { _mm256_storeu_pd(to.as_mut_ptr(), self.0) };
        to
    }

    #[inline(always)]
    fn splat(x: f64) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_set1_pd(x) })
    }

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_add_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_sub_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_mul_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_div_pd(self.0, other.0) })
    }

    #[inline(always)]
    fn previous(self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_permute4x64_pd::<0b11_01_00_10>(self.0) })
    }

    #[inline(always)]
    fn next(self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_permute4x64_pd::<0b11_00_10_01>(self.0) })
    }

    #[inline(always)]
    fn first(self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_broadcastsd_pd(_mm256_castpd256_pd128(self.0)) })
    }

    #[inline(always)]
    fn with_last(self, other: Self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_blend_pd::<0b1000>(self.0, other.first().0) })
    }

    #[inline(always)]
    fn below(self, other: Self) -> u32 {
        // SAFETY: see above.
        unsafe { _mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LT_OQ>(self.0, other.0)) as u32 }
    }

    #[inline(always)]
    fn from_array([a, b, c, d]: [f64; 4]) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_setr_pd(a, b, c, d) })
    }

    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: see above.
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
}
