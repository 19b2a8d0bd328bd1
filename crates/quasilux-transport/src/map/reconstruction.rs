//! What the photons in an element say about its illuminance.
//!
//! An estimate from photons at y' is a sum of kernels `k(y, y')`. Both kernels project on functions
//! that need not be continuous between elements, in the sense of least squares: on constants,
//! `k = 1 / A`, or on linear functions, `k = (12 l.l' - 3) / A`, with the barycentric weights l of y
//! and l' of y' in the element and its area A. The second follows from the mass matrix of the weights,
//! `A (1 + delta) / 12` (Strang and Fix 1973, "An Analysis of the Finite Element Method", chapter 1), whose
//! inverse is `(12 delta - 3) / A`. It is negative in places, so a value may be, but its mean is not.

/// What the photons in an element of the illumination map say about its illuminance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reconstruction {
    /// It is the same all over the element.
    Constant,
    /// It is linear in the element; neighbours need not meet.
    Linear,
}

impl Reconstruction {
    /// All of them, with their names in project files.
    pub const NAMES: [(&'static str, Self); 2] =
        [("constant", Self::Constant), ("linear", Self::Linear)];

    /// The name in project files and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Linear => "linear",
        }
    }

    /// Numbers that are summed over the photons of an element, for each channel.
    pub(crate) fn moments(self) -> usize {
        match self {
            Self::Constant => 1,
            Self::Linear => 3,
        }
    }

    /// The kernel times the element's area, a density in units of the even one; its mean over either
    /// place is 1.
    pub(crate) fn kernel_times_area(self, [a, b, c]: [f64; 3], of_photon: [f64; 3]) -> f64 {
        match self {
            Self::Constant => 1.0,
            Self::Linear => 12.0 * (a * of_photon[0] + b * of_photon[1] + c * of_photon[2]) - 3.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rule with three places inside a triangle that is exact for quadratic functions.
    const GAUSS: [[f64; 3]; 3] = {
        let (far, near) = (2.0 / 3.0, 1.0 / 6.0);
        [[far, near, near], [near, far, near], [near, near, far]]
    };

    #[test]
    fn kernels_reproduce_what_they_project_on() {
        let functions: [fn([f64; 3]) -> f64; 4] =
            [|_| 1.0, |[a, _, _]| a, |[_, b, _]| b, |[a, b, c]| 3.0 * a - 2.0 * b + 0.7 * c];
        for at in [[1.0, 0.0, 0.0], [0.2, 0.5, 0.3], [0.0, 0.5, 0.5]] {
            for (number, function) in functions.iter().enumerate() {
                let mean = |kernel: Reconstruction| {
                    let at_photon = |y| function(y) * kernel.kernel_times_area(at, y);
                    GAUSS.map(at_photon).iter().sum::<f64>() / 3.0
                };
                assert!((mean(Reconstruction::Linear) - function(at)).abs() < 1e-14);
                let plain = GAUSS.map(function).iter().sum::<f64>() / 3.0;
                assert!((mean(Reconstruction::Constant) - plain).abs() < 1e-14);
                assert!(number > 0 || (plain - 1.0).abs() < 1e-15);
            }
        }
    }
}
