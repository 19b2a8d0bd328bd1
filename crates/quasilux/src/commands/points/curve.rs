//! Convergence curves: the root mean square of a measure against the number of points, and its
//! slope.

use super::setup::{Measure, Setup};

/// Slopes are fitted from this many points on.
pub(super) const FIT_FROM: f64 = 64.0;

/// What was measured of one setup.
#[derive(Clone, Debug)]
pub(super) struct Curve {
    pub(super) measure: Measure,
    pub(super) setup: Setup,
    /// (N, root mean square over the replicates).
    pub(super) points: Vec<[f64; 2]>,
    /// The order of convergence, where there are enough points for it.
    pub(super) slope: Option<f64>,
}
