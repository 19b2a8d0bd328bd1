//! The ways in which paths gather light, none of which is biased.

use quasilux_transport::{Estimator, Switch};

/// Alone, beside joined photons, and ending on a map that is corrected.
pub(crate) const GATHERERS: [(Estimator, Switch); 3] = [
    (Estimator::Path, Switch::Auto),
    (Estimator::Bidirectional, Switch::On),
    (Estimator::Bidirectional, Switch::Off),
];
