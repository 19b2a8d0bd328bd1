//! What a reader of the results must know, for programs.

use crate::Caveat;
use serde::Serialize;
use serde_json::{Map, Value, to_value};

/// One caveat: its `kind`, its figures by their names, and its sentence as `message`. Where a
/// figure is one of a kind itself, it has a `kind` of its own.
#[derive(Debug, Serialize)]
pub(super) struct CaveatEntry {
    #[serde(flatten)]
    kind_and_figures: Tagged,
    message: String,
}

/// One of a closed set: which, and what it carries.
#[derive(Debug, Default, Serialize)]
struct Tagged {
    kind: String,
    #[serde(flatten)]
    figures: Map<String, Value>,
}

impl CaveatEntry {
    pub(super) fn new(caveat: &Caveat) -> Self {
        let value = to_value(caveat).expect("a caveat has strings as keys");
        let mut kind_and_figures = Tagged::new(value);
        if let Some(Value::Array(ways)) = kind_and_figures.figures.get_mut("ways") {
            for way in ways {
                let tagged = Tagged::new(way.take());
                *way = to_value(tagged).expect("a way has strings as keys");
            }
        }
        Self { kind_and_figures, message: caveat.to_string() }
    }
}

impl Tagged {
    /// From the way in which serde writes a variant: a name, or an object of one name.
    fn new(value: Value) -> Self {
        match value {
            Value::String(kind) => Self { kind, figures: Map::new() },
            Value::Object(variant) => match variant.into_iter().next() {
                Some((kind, Value::Object(figures))) => Self { kind, figures },
                _ => Self::default(),
            },
            _ => Self::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_transport::{Caveat as OfSimulation, EstimatorKind, UnshownWay};
    use serde_json::json;

    fn entry(caveat: impl Into<Caveat>) -> Value {
        let caveat = caveat.into();
        let mut entry = to_value(CaveatEntry::new(&caveat)).unwrap();
        assert_eq!(entry["message"], caveat.to_string());
        assert_eq!(entry["kind"], caveat.kind());
        entry.as_object_mut().unwrap().remove("message");
        entry
    }

    #[test]
    fn figures_stand_beside_the_kind() {
        assert_eq!(entry(OfSimulation::OneReplicate), json!({"kind": "one_replicate"}));
        let three = OfSimulation::NoInterval { points: 3 };
        assert_eq!(entry(three), json!({"kind": "no_interval", "points": 3}));
        let ways = vec![UnshownWay::ThroughBodies, UnshownWay::OverManyMirrors { depth: 2 }];
        let expected = json!({"kind": "caustics", "ways": [
            {"kind": "through_bodies"},
            {"kind": "over_many_mirrors", "depth": 2},
        ]});
        assert_eq!(entry(OfSimulation::Caustics { ways }), expected);
    }

    #[test]
    fn those_of_reports_have_their_kinds() {
        let sensor = || "desk".to_owned();
        let (points, of_points) = (1, 4);
        let (most_lx, least_radius_m, most_radius_m) = (0.5, 0.05, 0.1);
        let blurred = Caveat::Blurred {
            sensor: sensor(),
            points,
            of_points,
            most_lx,
            least_radius_m,
            most_radius_m,
        };
        let expected = json!({
            "kind": "blurred", "sensor": "desk", "points": 1, "of_points": 4, "most_lx": 0.5,
            "least_radius_m": 0.05, "most_radius_m": 0.1,
        });
        assert_eq!(entry(blurred), expected);
        let biased = Caveat::Biased { estimator: EstimatorKind::Path };
        assert_eq!(entry(biased), json!({"kind": "biased", "estimator": "path"}));
        let figures = vec!["average"];
        for caveat in [
            Caveat::NoFiniteValue { sensor: sensor(), figures, points, of_points },
            Caveat::NoBound { sensor: sensor(), points, of_points },
            Caveat::NoCertifiedAverage { sensor: sensor() },
            Caveat::NoCertifiedLimit { sensor: sensor(), points, of_points },
        ] {
            assert_eq!(entry(caveat)["sensor"], "desk");
        }
    }
}
