//! The linear density on [0, 1].

/// The place below which lies `fraction` of the density that runs linearly from `at_0` to `at_1`.
///
/// Both are non-negative; where both are zero the density counts as uniform. The root of the
/// quadratic is taken in the form that never subtracts, so it holds for equal, nearly equal and
/// zero ends.
pub(super) fn linear_quantile(at_0: f64, at_1: f64, fraction: f64) -> f64 {
    let scale = at_0.max(at_1);
    if scale <= 0.0 {
        return fraction;
    }
    let (a, b) = (at_0 / scale, at_1 / scale);
    let root = (a * a * (1.0 - fraction) + b * b * fraction).sqrt();
    if a + root > 0.0 { (fraction * (a + b) / (a + root)).min(1.0) } else { 0.0 }
}

/// The part of the same density, 0 to 1, that lies below `x`.
pub(super) fn linear_fraction(at_0: f64, at_1: f64, x: f64) -> f64 {
    let sum = at_0 + at_1;
    if sum > 0.0 { x * (at_0 * (2.0 - x) + at_1 * x) / sum } else { x }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantile_and_fraction_are_inverse() {
        for (a, b) in
            [(1.0, 1.0), (0.0, 2.0), (3.0, 0.0), (1.0, 1.0 + 1e-15), (1e-300, 1e-290), (0.0, 0.0)]
        {
            for i in 0..=100 {
                let u = f64::from(i) / 100.0;
                let x = linear_quantile(a, b, u);
                assert!((0.0..=1.0).contains(&x));
                assert!((linear_fraction(a, b, x) - u).abs() < 1e-14, "{a} {b} {u}");
            }
        }
    }
}
