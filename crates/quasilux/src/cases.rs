//! Validation cases: projects with known answers, as data (validation/README.md has the format).

use crate::exit::Refusal;
use quasilux_measure::{Figure, Report, SensorReport};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// One case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) source: String,
    /// Relative to the case's file.
    pub(crate) project: PathBuf,
    /// The project's own where empty.
    #[serde(default)]
    estimators: Vec<String>,
    pub(crate) expect: Vec<Expectation>,
}

/// One expected figure.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expectation {
    pub(crate) sensor: String,
    figure: FigureName,
    /// Every point where not given.
    point: Option<usize>,
    pub(crate) value: f64,
    /// Allowed beyond the interval, as a share of `value`.
    tolerance_rel: f64,
    pub(crate) why: String,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum FigureName {
    IlluminanceLx,
    DirectLx,
    AverageLx,
    MinimumLx,
    MaximumLx,
    Uniformity,
}

/// What came of one expectation.
pub(crate) struct Verdict {
    /// What was looked at, like `floor[3] illuminance_lx`.
    pub(crate) what: String,
    pub(crate) expected: f64,
    pub(crate) got: Figure,
    pub(crate) holds: bool,
    pub(crate) why: String,
}

impl Case {
    /// Reads a case.
    pub(crate) fn read(path: &Path) -> Result<Self, Refusal> {
        let refuse =
            |error: &dyn std::fmt::Display| Refusal::new(format!("{}: {error}", path.display()));
        let text = std::fs::read_to_string(path).map_err(|error| refuse(&error))?;
        let mut case: Self = toml::from_str(&text).map_err(|error| refuse(&error))?;
        if case.expect.is_empty() {
            return Err(refuse(&"a case expects at least one value"));
        }
        case.project = path.parent().unwrap_or(Path::new("")).join(case.project);
        Ok(case)
    }

    /// The estimators to try; `None` is the project's own.
    pub(crate) fn estimators(&self) -> Vec<Option<String>> {
        match self.estimators.as_slice() {
            [] => vec![None],
            names => names.iter().cloned().map(Some).collect(),
        }
    }
}

impl Expectation {
    /// Judges a report; one verdict a point.
    pub(crate) fn judge(&self, report: &Report) -> Result<Vec<Verdict>, Refusal> {
        let sensor =
            report.sensors.iter().find(|sensor| sensor.name == self.sensor).ok_or_else(|| {
                Refusal::new(format!("no sensor \"{}\" in the project", self.sensor))
            })?;
        let points = match (self.figure.is_of_points(), self.point) {
            (false, None) => return Ok(vec![self.verdict(None, self.summary_figure(sensor))]),
            (false, Some(_)) => {
                return Err(Refusal::new("a summary figure has no point"));
            }
            (true, None) => 0..sensor.points.len(),
            (true, Some(point)) if point < sensor.points.len() => point..point + 1,
            (true, Some(point)) => {
                let message = format!("sensor \"{}\" has no point {point}", self.sensor);
                return Err(Refusal::new(message));
            }
        };
        Ok(points.map(|p| self.verdict(Some(p), self.point_figure(sensor, p))).collect())
    }

    fn verdict(&self, point: Option<usize>, got: Figure) -> Verdict {
        let needs_interval = self.figure != FigureName::DirectLx;
        let half_width = if needs_interval { got.half_width } else { Some(0.0) };
        let holds = match (got.value, half_width) {
            (Some(value), Some(half_width)) => {
                (value - self.value).abs() <= half_width + self.tolerance_rel * self.value.abs()
            }
            _ => false,
        };
        let place = point.map_or_else(String::new, |point| format!("[{point}]"));
        Verdict {
            what: format!("{}{place} {}", self.sensor, self.figure.name()),
            expected: self.value,
            got,
            holds,
            why: self.why.clone(),
        }
    }

    fn point_figure(&self, sensor: &SensorReport, point: usize) -> Figure {
        let point = &sensor.points[point];
        match self.figure {
            FigureName::DirectLx => Figure { value: point.direct_lx, half_width: None },
            _ => point.illuminance_lx,
        }
    }

    fn summary_figure(&self, sensor: &SensorReport) -> Figure {
        match self.figure {
            FigureName::MinimumLx => sensor.summary.minimum_lx,
            FigureName::MaximumLx => sensor.summary.maximum_lx,
            FigureName::Uniformity => sensor.summary.uniformity,
            _ => sensor.summary.average_lx,
        }
    }
}

impl FigureName {
    fn is_of_points(self) -> bool {
        matches!(self, Self::IlluminanceLx | Self::DirectLx)
    }

    fn name(self) -> &'static str {
        match self {
            Self::IlluminanceLx => "illuminance_lx",
            Self::DirectLx => "direct_lx",
            Self::AverageLx => "average_lx",
            Self::MinimumLx => "minimum_lx",
            Self::MaximumLx => "maximum_lx",
            Self::Uniformity => "uniformity",
        }
    }
}
