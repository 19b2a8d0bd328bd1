//! How sure what is claimed is: 1 % for all tests of a family together.

/// The probability that any test of a family is passed by chance.
pub(super) const SIGNIFICANCE: f64 = 0.01;
/// Two setups are alike if their errors differ by less than this factor.
pub(super) const ALIKE: f64 = 1.1;

/// What that leaves for each of this many tests (Z. Sidak 1967).
pub(super) fn each_of(tests: usize) -> f64 {
    -libm::expm1(libm::log1p(-SIGNIFICANCE) / tests.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_family_of_independent_tests_has_the_stated_significance() {
        for tests in [1, 5, 40] {
            let any = 1.0 - libm::pow(1.0 - each_of(tests), tests as f64);
            assert!((any - SIGNIFICANCE).abs() < 1e-12, "{tests}");
        }
    }
}
