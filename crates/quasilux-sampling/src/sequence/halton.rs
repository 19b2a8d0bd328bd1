//! The Halton sequence: one prime base a dimension.
//!
//! J. H. Halton, "On the efficiency of certain quasi-random sequences of points in evaluating
//! multi-dimensional integrals" (Numer. Math. 2, 1960). Point 0 is the origin and is kept. In high
//! dimensions the bases are large, and fewer points than the product of two bases leave diagonals
//! in their plane: use [`Randomization::Owen`](crate::Randomization::Owen) there, or Sobol'.

use super::radix::Radix;
use std::sync::LazyLock;

/// How many dimensions have a base: all primes to 8161.
pub(crate) const DIMENSIONS: u32 = 1024;

/// The base of each dimension.
pub(crate) fn bases() -> &'static [Radix] {
    static BASES: LazyLock<Vec<Radix>> =
        LazyLock::new(|| first_primes().into_iter().map(Radix::new).collect());
    &BASES
}

fn first_primes() -> [u32; DIMENSIONS as usize] {
    let mut primes = (2_u32..).filter(|n| (2..).take_while(|d| d * d <= *n).all(|d| n % d != 0));
    std::array::from_fn(|_| primes.next().expect("there are infinitely many primes"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bases_are_the_first_primes() {
        let bases: Vec<_> = bases().iter().map(Radix::base).collect();
        assert_eq!(bases[..10], [2, 3, 5, 7, 11, 13, 17, 19, 23, 29]);
        assert_eq!(bases[1023], 8161);
    }
}
