//! The ways in which paths gather light, none of which is biased.

use quasilux_transport::{EstimatorKind, Switch};

/// Alone, beside connected photons, and ending on a map that is corrected.
pub(crate) const PATH_ESTIMATORS: [(EstimatorKind, Switch); 4] = [
    (EstimatorKind::Path, Switch::Auto),
    (EstimatorKind::Bidirectional, Switch::Auto),
    (EstimatorKind::Selected, Switch::On),
    (EstimatorKind::Selected, Switch::Off),
];
