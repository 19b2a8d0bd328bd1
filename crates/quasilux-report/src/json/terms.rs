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

#[cfg(test)]
mod tests {
    use crate::example;
    use crate::json::json;
    use serde_json::{Value, json as value};

    #[test]
    fn terms_are_listed_by_bounces_where_there_are_any() {
        let document: Value =
            serde_json::from_str(&json(&example::with_terms())).expect("valid JSON");
        let sensor = &document["sensors"][0];
        let wanted = value!([
            {"bounces": 0, "value": 200.0, "half_width": 0.5},
            {"bounces": "rest", "value": 100.0, "half_width": 0.5},
        ]);
        assert_eq!(sensor["points"][1]["terms_lx"], wanted);
        assert_eq!(sensor["summary"]["average_terms_lx"][1]["value"], 60.0);
        let document: Value = serde_json::from_str(&json(&example::office())).expect("valid JSON");
        assert!(document["sensors"][0]["points"][0].get("terms_lx").is_none());
        assert!(document.get("explain").is_none());
    }
}
