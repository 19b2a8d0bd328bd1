//! What the photons in an element say about its illuminance.
//!
//! An estimate from photons at y' is a sum of kernels `k(y, y')`. Both kernels project on functions
//! that need not be continuous between elements, in the sense of least squares: on constants, `k =
//! 1 / A`, or on linear functions, `k = (12 l.l' - 3) / A`, with the barycentric weights l of y and
//! l' of y' in the element and its area A. The second follows from the mass matrix of the weights,
//! `A (1 + delta) / 12` (Strang and Fix 1973, "An Analysis of the Finite Element Method", chapter
//! 1), whose inverse is `(12 delta - 3) / A`. It is negative in places, so a value may be, but its
//! mean is not.

use crate::settings::Reconstruction;

impl Reconstruction {
    /// Numbers that are summed over the photons of an element, for each channel.
    pub(crate) fn moments(self) -> usize {
        match self {
            Self::Constant => 1,
            Self::Linear => 3,
        }
    }
}
