//! The terms of the Neumann series in the result document.

use crate::{Figure, TermReport};
use serde::{Serialize, Serializer};

/// `{"bounces": 0, "value": .., "half_width": ..}`.
#[derive(Serialize)]
pub(super) struct TermEntry {
    #[serde(serialize_with = "bounces_or_rest")]
    bounces: Option<u32>,
    value: Option<f64>,
    half_width: Option<f64>,
}

impl TermEntry {
    /// All terms of a sensor, of each the figure that `pick` takes.
    pub(super) fn all(terms: &[TermReport], pick: impl Fn(&TermReport) -> Figure) -> Vec<Self> {
        let entry = |term: &TermReport| {
            let Figure { value, half_width } = pick(term);
            Self { bounces: term.bounces, value, half_width }
        };
        terms.iter().map(entry).collect()
    }
}

#[expect(clippy::ref_option, reason = "serde asks for a reference to the field")]
fn bounces_or_rest<S: Serializer>(bounces: &Option<u32>, serializer: S) -> Result<S::Ok, S::Error> {
    match bounces {
        Some(bounces) => bounces.serialize(serializer),
        None => "rest".serialize(serializer),
    }
}
