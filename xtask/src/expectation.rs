//! The numbers an example promises: `expected.toml`, and its check against a `result.json`.
//!
//! The tables `[[expect]]` have the form that `validation/README.md` describes.

use serde::Deserialize;
use serde_json::Value;
use xtask::workspace::Failure;

/// The file `expected.toml`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expected {
    /// The promised numbers.
    pub(crate) expect: Vec<Expectation>,
}

/// One promised number.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expectation {
    /// The project file whose number it is; without it, all of the folder.
    pub(crate) project: Option<String>,
    /// Name of the sensor.
    pub(crate) sensor: String,
    /// `illuminance_lx` or `direct_lx` of points, or the key of a summary figure, or `mean_` with
    /// the key of a point's measure over a year.
    pub(crate) figure: String,
    /// Index of the point; without it, a point figure is promised at every point.
    pub(crate) point: Option<usize>,
    /// The promised value, in the unit that the figure's name ends with.
    pub(crate) value: f64,
    /// Allowed distance beyond the reported interval, relative to `value`.
    pub(crate) tolerance_rel: f64,
    /// Where the value comes from.
    pub(crate) why: String,
}

/// A reported value with the half-width of its interval.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reported {
    value: f64,
    half_width: f64,
}

impl Expected {
    /// Reads the file's text.
    pub(crate) fn parse(text: &str) -> Result<Self, Failure> {
        let expected: Self = toml::from_str(text).map_err(|error| error.to_string())?;
        if expected.expect.is_empty() {
            return Err("no [[expect]]: an example promises at least one number".into());
        }
        if let Some(bare) = expected.expect.iter().find(|e| e.why.trim().is_empty()) {
            return Err(format!("{} does not say why", bare.label()));
        }
        Ok(expected)
    }
}

impl Expectation {
    /// Checks the promise against a result document.
    pub(crate) fn check(&self, result: &Value) -> Result<(), Failure> {
        let reported = self
            .reported(result)
            .ok_or_else(|| format!("{}: not in the result, or not a number", self.label()))?;
        for Reported { value, half_width } in reported {
            let allowed = half_width + self.tolerance_rel * self.value.abs();
            let distance = (value - self.value).abs();
            if distance.is_nan() || distance > allowed {
                return Err(format!(
                    "{}: {value} +- {half_width} is {distance:.4} away from {}, allowed \
                     {allowed:.4}",
                    self.label(),
                    self.value
                ));
            }
        }
        Ok(())
    }

    fn reported(&self, result: &Value) -> Option<Vec<Reported>> {
        let sensors = result["sensors"].as_array()?;
        let sensor = sensors.iter().find(|sensor| sensor["name"] == self.sensor.as_str())?;
        let points = sensor["points"].as_array()?;
        let at = |point: &Value| self.reported_at(point);
        match (self.figure.as_str(), self.point) {
            ("illuminance_lx" | "direct_lx", Some(index)) => Some(vec![at(points.get(index)?)?]),
            ("illuminance_lx" | "direct_lx", None) if points.is_empty() => None,
            ("illuminance_lx" | "direct_lx", None) => points.iter().map(at).collect(),
            (figure, None) => {
                let summary = &sensor["summary"][figure];
                let mean = figure.strip_prefix("mean_");
                let mean = || mean_over(points, mean?);
                Some(vec![reported_in(summary).or_else(mean)?])
            }
            (_, Some(_)) => None,
        }
    }

    fn reported_at(&self, point: &Value) -> Option<Reported> {
        let half_width = match self.figure.as_str() {
            "illuminance_lx" => point["half_width_lx"].as_f64()?,
            _ => 0.0,
        };
        Some(Reported { value: point[self.figure.as_str()].as_f64()?, half_width })
    }

    fn label(&self) -> String {
        let point = self.point.map_or(String::new(), |index| format!(" of point {index}"));
        format!("sensor {:?}, {}{point}", self.sensor, self.figure)
    }
}

/// A summary figure with its half-width, or a share of points with its bounds.
fn reported_in(summary: &Value) -> Option<Reported> {
    let number = |key: &str| summary[key].as_f64();
    let value = number("value")?;
    let farther = || Some((number("high")? - value).max(value - number("low")?));
    Some(Reported { value, half_width: number("half_width").or_else(farther)? })
}

/// The mean of a measure over points, with the mean of their half-widths.
fn mean_over(points: &[Value], measure: &str) -> Option<Reported> {
    let mean = |key: &str| {
        let values: Option<Vec<f64>> = points.iter().map(|point| point[key].as_f64()).collect();
        Some(values?.iter().sum::<f64>() / points.len() as f64)
    };
    let half_width = mean(&format!("{measure}_half_width"))?;
    Some(Reported { value: mean(measure)?, half_width })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn result() -> Value {
        json!({"sensors": [{
            "name": "desk",
            "points": [
                {"illuminance_lx": 500.0, "half_width_lx": 2.0, "direct_lx": 300.0},
                {"illuminance_lx": 510.0, "half_width_lx": 2.0, "direct_lx": 300.0},
            ],
            "summary": {"average_lx": {"value": 505.0, "half_width": 1.0}},
        }]})
    }

    fn expect(figure: &str, point: Option<usize>, value: f64) -> Expectation {
        let (sensor, why) = ("desk".to_owned(), "made up".to_owned());
        let (figure, project) = (figure.into(), None);
        Expectation { project, sensor, figure, point, value, tolerance_rel: 0.002, why }
    }

    #[test]
    fn the_interval_widened_by_the_tolerance_is_accepted_and_no_more() {
        assert_eq!(expect("average_lx", None, 507.0).check(&result()), Ok(()));
        assert!(expect("average_lx", None, 507.1).check(&result()).is_err());
        assert_eq!(expect("illuminance_lx", Some(0), 502.9).check(&result()), Ok(()));
        assert!(expect("illuminance_lx", Some(0), 503.1).check(&result()).is_err());
    }

    #[test]
    fn without_an_index_every_point_counts() {
        assert_eq!(expect("direct_lx", None, 300.0).check(&result()), Ok(()));
        assert!(expect("illuminance_lx", None, 500.0).check(&result()).is_err());
    }

    #[test]
    fn what_is_missing_or_not_a_number_fails() {
        for (figure, point) in
            [("median_lx", None), ("average_lx", Some(0)), ("direct_lx", Some(2))]
        {
            assert!(expect(figure, point, 300.0).check(&result()).is_err());
        }
        let null = json!({"sensors": [{"name": "desk", "points": [],
            "summary": {"average_lx": {"value": 507.0, "half_width": null}}}]});
        assert!(expect("average_lx", None, 507.0).check(&null).is_err());
        assert!(expect("direct_lx", None, 300.0).check(&null).is_err());
        assert!(expect("average_lx", None, f64::NAN).check(&result()).is_err());
    }

    #[test]
    fn a_file_without_reasons_or_promises_is_refused() {
        assert!(Expected::parse("expect = []").is_err());
        let bare = "[[expect]]\nsensor = 'a'\nfigure = 'average_lx'\nvalue = 1.0\n\
                    tolerance_rel = 0.0\nwhy = ' '";
        assert!(Expected::parse(bare).unwrap_err().contains("why"));
    }
}
