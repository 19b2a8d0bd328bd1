//! Eight single-precision numbers at once, or four of double precision.
//!
//! What eight are computed with differs in the last bits, for which the traversal allows; four are
//! the same everywhere, since they decide.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod portable;
mod traits;
pub(crate) mod triple;
#[cfg(target_arch = "x86_64")]
mod ymm;

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;
#[cfg(target_arch = "x86_64")]
pub(crate) use avx512::Avx512;
pub(crate) use portable::{Portable, PortableQuad};
pub(crate) use traits::{Lanes, Quad};

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use super::*;
    use crate::node::{Child, WIDTH};

    /// Numbers of all signs and sizes, some of them equal or zero, and no pattern.
    struct Numbers(u64);

    impl Numbers {
        fn next(&mut self) -> u32 {
            self.0 = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
            (self.0 >> 32) as u32
        }

        fn eight(&mut self) -> [f32; WIDTH] {
            [(); WIDTH].map(|()| {
                let number = (self.next() % 41) as f32 * 0.25 - 5.0;
                number * [1.0, 1e-6, 1e6][self.next() as usize % 3]
            })
        }
    }

    /// Every operation, in every lane and with every mask, is that of [`Portable`].
    #[inline(always)]
    fn assert_portable<L: Lanes>() {
        let numbers = &mut Numbers(5);
        for round in 0..2000 {
            let of = [(); 4].map(|()| numbers.eight());
            let [a, b, c, d] = of.map(|x| L::load(&x));
            let [e, f, g, h] = of.map(|x| Portable::load(&x));
            let (one, mask) = (of[0][round % WIDTH] + 0.1, round as u32 & 0xff);
            let (splat, one_in_all) = (L::splat(one), Portable::splat(one));
            assert_eq!(L::splat_from(&one).store(), splat.store());
            assert_eq!(splat.store(), one_in_all.store());
            assert_eq!(a.least(), e.least());
            for (got, wanted) in [
                (a.add(b), e.add(f)),
                (a.sub(b), e.sub(f)),
                (a.mul(b), e.mul(f)),
                (a.min(b), e.min(f)),
                (a.max(b), e.max(f)),
                (a.flip_by(b), e.flip_by(f)),
                (a.div(splat), e.div(one_in_all)),
                (a.or_else(mask, b), e.or_else(mask, f)),
            ] {
                assert_eq!(got.store().map(f32::to_bits), wanted.store().map(f32::to_bits));
            }
            for (sign, got) in [(1.0, a.mul_add(b, c)), (-1.0, a.mul_sub(b, c))] {
                for (i, got) in got.store().into_iter().enumerate() {
                    let product = f64::from(of[0][i]) * f64::from(of[1][i]);
                    let wanted = product + sign * f64::from(of[2][i]);
                    let error = (f64::from(got) - wanted).abs();
                    assert!(error <= 1e-7 * (product.abs() + wanted.abs()));
                }
            }
            assert_eq!(a.at_most(b), e.at_most(f));
            assert_eq!(L::any_negative([a, b, c, d]), Portable::any_negative([e, f, g, h]));
            let these = [(); WIDTH].map(|()| numbers.next() % 5);
            let (mut put, mut wanted) = (these, these);
            L::put(&mut put, mask, 77);
            Portable::put(&mut wanted, mask, 77);
            assert_eq!(put, wanted);
            let from = [1, 3, u32::from(round.is_multiple_of(2))];
            assert_eq!(L::differ(&these, from), Portable::differ(&these, from));
            assert_smallest::<L>(of[0].map(f32::abs), of[1].map(f32::abs));
            assert_compressed::<L>(of[0], mask);
        }
    }

    #[inline(always)]
    fn assert_smallest<L: Lanes>(of: [f32; WIDTH], limit: [f32; WIDTH]) {
        let counts = |i: &usize| of[*i] <= limit[*i];
        let least = (0..WIDTH).filter(counts).map(|i| of[i]).fold(f32::INFINITY, f32::min);
        let lane = L::load(&of).smallest(L::load(&limit));
        assert!(lane < WIDTH);
        if least < f32::INFINITY {
            assert!(counts(&lane) && of[lane] <= 1.01 * least, "{lane} of {of:?} up to {limit:?}");
        }
    }

    #[inline(always)]
    fn assert_compressed<L: Lanes>(of: [f32; WIDTH], mask: u32) {
        let children = [7, 6, 5, 4, 3, 2, 1, 1 << 31].map(Child);
        let mut to = [f32::NAN; WIDTH];
        let mut to_children = [Child(99); WIDTH];
        // SAFETY: there is room for eight.
        unsafe {
            L::load(&of).compress(&children, mask, to.as_mut_ptr(), to_children.as_mut_ptr());
        }
        let lanes = (0..WIDTH).filter(|i| mask >> i & 1 == 1);
        for (place, lane) in lanes.enumerate() {
            assert_eq!((to[place], to_children[place]), (of[lane], children[lane]));
        }
    }

    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    fn assert_portable_avx2() {
        assert_portable::<Avx2>();
    }

    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    fn assert_portable_avx512() {
        assert_portable::<Avx512>();
    }

    #[test]
    fn all_instructions_agree() {
        assert_portable::<Portable>();
        if Avx2::is_supported() {
            // SAFETY: the features are there.
            unsafe { assert_portable_avx2() };
        }
        if Avx512::is_supported() {
            // SAFETY: the features are there.
            unsafe { assert_portable_avx512() };
        } else {
            println!("left out: AVX-512, which this machine does not have");
        }
    }
}
