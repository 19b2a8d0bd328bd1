//! A figure of a report: a finite value with half the width of its confidence interval.

use quasilux_transport::Interval;
use serde::{Deserialize, Serialize};

/// A finite value and half the width of its confidence interval, as far as they are known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// The estimate; `None` where it is undefined.
    pub value: Option<f64>,
    /// Half the width of the interval; `None` without replicates.
    pub half_width: Option<f64>,
}

impl From<Interval> for Figure {
    /// Keeps what is finite.
    fn from(interval: Interval) -> Self {
        let value = finite(interval.value);
        Self { value, half_width: value.and(interval.half_width).and_then(finite) }
    }
}

/// The number, where it is finite.
pub(crate) fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}
