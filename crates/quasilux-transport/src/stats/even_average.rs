//! Averages over points that end at different times.
//!
//! A point ends where its own half-width is small enough beside its value. What it has found
//! decides, so values of points that have ended are biased: each by a small part of its half-width,
//! but all to the same side, which the average over 10^4 points shows as many of its standard
//! errors where light is rare and the tolerance loose. Hence the average of a sensor is that of the
//! last checkpoint at which all of its points had the same number of samples, and no point ends
//! before that average is known well enough (`stats::tolerance`). In rooms it always was: averages
//! are known before their points.

use serde::{Deserialize, Serialize};

/// The average over the points of a sensor at a checkpoint at which all had the same number of
/// samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvenAverage {
    /// Illuminance in lx, by replicate.
    pub replicate_lx: Vec<f64>,
    /// The terms of the Neumann series that are listed, and the rest, in lx: by term and replicate.
    pub terms_lx: Vec<Vec<f64>>,
    /// The bound in lx on light that no sample met; `None` of estimators without one.
    pub unseen_lx: Option<f64>,
}

impl EvenAverage {
    /// Whether it is of this many replicates and terms.
    pub(crate) fn has_shape(&self, replicates: usize, terms: usize) -> bool {
        let mut rows = self.terms_lx.iter().chain([&self.replicate_lx]);
        self.terms_lx.len() == terms && rows.all(|row| row.len() == replicates)
    }
}
