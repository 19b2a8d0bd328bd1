//! What the samples of a value leave open.

use super::FigureEntry;
use crate::{CertifiedFigure, Figure, PointUnseen};
use serde::Serialize;

/// Beside the value at a point.
#[derive(Serialize)]
pub(super) struct UnseenEntry {
    unseen_lx: Option<f64>,
    merged_lx: Option<f64>,
    disc_radius_m: Option<f64>,
}

/// A figure of a summary with the light in lx at most that no sample met.
#[derive(Serialize)]
pub(super) struct BoundedEntry {
    #[serde(flatten)]
    figure: FigureEntry,
    unseen_lx: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified_lx: Option<CertifiedFigure>,
}

impl UnseenEntry {
    pub(super) fn new(unseen: PointUnseen) -> Self {
        let PointUnseen { bound_lx, merged_lx, disc_radius_m } = unseen;
        Self { unseen_lx: bound_lx, merged_lx, disc_radius_m }
    }
}

impl BoundedEntry {
    pub(super) fn new(figure: Figure, unseen_lx: Option<f64>) -> Self {
        Self { figure: FigureEntry::new(figure), unseen_lx, certified_lx: None }
    }

    pub(super) fn with_certified(self, certified_lx: Option<CertifiedFigure>) -> Self {
        Self { certified_lx, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::super::json;
    use crate::example;
    use quasilux_transport::UnseenTolerance;
    use serde_json::Value;

    #[test]
    fn bounds_stand_beside_values() {
        let report = example::with_unseen();
        let document: Value = serde_json::from_str(&json(&report)).expect("valid JSON");
        let sensor = &document["sensors"][0];
        let [lit, bright, dark] = [0, 1, 2].map(|point| &sensor["points"][point]);
        assert_eq!([&lit["unseen_lx"], &lit["merged_lx"]], [2.0, 0.5]);
        assert_eq!(lit["disc_radius_m"], 0.1);
        assert_eq!(bright["disc_radius_m"], Value::Null);
        assert_eq!([&dark["half_width_lx"], &dark["unseen_lx"]], [0.0, 0.02]);
        let summary = &sensor["summary"];
        assert_eq!(summary["average_lx"]["unseen_lx"], 0.4);
        assert!(summary["minimum_lx"]["unseen_lx"].as_f64().is_some_and(|lx| lx > 0.02));
        assert!(summary["maximum_lx"]["unseen_lx"].as_f64().is_some_and(|lx| lx > 20.0));
        assert!(summary["uniformity"].get("unseen_lx").is_none());
        let run = &document["run"];
        assert_eq!([&run["unseen_confidence"], &run["unseen_tol"]], [0.95, 0.05]);
        let classes = serde_json::json!(["lamp, glass body, point", "sun, mirror, point"]);
        assert_eq!(run["cannot_see"], classes);
    }

    #[test]
    fn without_a_bound_there_is_none() {
        let mut report = example::office();
        report.run.settings.unseen_tol = UnseenTolerance::Off;
        let document: Value = serde_json::from_str(&json(&report)).expect("valid JSON");
        let point = &document["sensors"][0]["points"][0];
        for key in ["unseen_lx", "merged_lx", "disc_radius_m"] {
            assert_eq!(point[key], Value::Null);
            assert!(point.get(key).is_some(), "{key} is there");
        }
        assert_eq!(document["sensors"][0]["summary"]["average_lx"]["unseen_lx"], Value::Null);
        assert_eq!(document["run"]["unseen_tol"], "off");
        assert_eq!(document["run"]["cannot_see"], serde_json::json!([]));
    }
}
