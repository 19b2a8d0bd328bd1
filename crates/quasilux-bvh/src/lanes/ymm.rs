//! What AVX2 and AVX-512 do alike in a register of 256 bits.

/// The operations of [`super::Lanes`] that need no mask, for a tuple of one `__m256`, which exists
/// only where AVX2 and fused multiply-add are there.
macro_rules! in_256_bits {
    () => {
        #[inline(always)]
        fn load(from: &[f32; WIDTH]) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_loadu_ps(from.as_ptr()) })
        }

        #[inline(always)]
        fn store(self) -> [f32; WIDTH] {
            let mut to = [0.0; WIDTH];
            // SAFETY: the type exists only where these instructions are.
            unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) };
            to
        }

        #[inline(always)]
        fn splat(x: f32) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_set1_ps(x) })
        }

        #[inline(always)]
        fn add(self, other: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_add_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn sub(self, other: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_sub_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn mul(self, other: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_mul_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn mul_add(self, a: Self, b: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_fmadd_ps(self.0, a.0, b.0) })
        }

        #[inline(always)]
        fn mul_sub(self, a: Self, b: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_fmsub_ps(self.0, a.0, b.0) })
        }

        #[inline(always)]
        fn min(self, other: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_min_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn max(self, other: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_max_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn splat_from(x: &f32) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_broadcast_ss(x) })
        }

        #[inline(always)]
        fn div(self, other: Self) -> Self {
            // SAFETY: the type exists only where these instructions are.
            Self(unsafe { _mm256_div_ps(self.0, other.0) })
        }

        #[inline(always)]
        fn least(self) -> f32 {
            // SAFETY: the type exists only where these instructions are.
            unsafe {
                let four =
                    _mm_min_ps(_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0));
                let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
                _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)))
            }
        }
    };
}

pub(super) use in_256_bits;
